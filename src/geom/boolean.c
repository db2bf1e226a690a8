#include "geom/boolean.h"

#include "geom/bounds.h"

#include <math.h>
#include <stdio.h>

enum { PROBES = 14 };

/* Shares of the extent: surfaces this near are one, and what lies between two that are one is this far from them; steps of
 * gradients and probes. */
static const double one_surface = 1e-9, apart = 1e-8, small_step = 5e-9;
/* Cosine below which two normals are opposite. */
static const double opposite = -0.999;

static const shape *operand(const boolean_operands *o, size_t k)
{
    return o->first && k == 0 ? o->first : &o->part[k - (o->first ? 1 : 0)];
}

/* Of what lies outside a shape all is negative. */
static double operand_sign(const boolean_operands *o, size_t k)
{
    return o->outside && operand(o, k) != o->first ? -1.0 : 1.0;
}

static double operand_level(const boolean_operands *o, size_t k, int dim, const double x[3])
{
    return operand_sign(o, k) * shape_level(operand(o, k), dim, x);
}

static size_t count_operands(const boolean_operands *o)
{
    return o->n + (o->first ? 1 : 0);
}

static double greatest_level(const boolean_operands *o, int dim, const double x[3])
{
    const size_t n = count_operands(o);
    double level = -HUGE_VAL;
    for (size_t k = 0; k < n; k++) level = fmax(level, operand_level(o, k, dim, x));
    return level;
}

/* Unit normal of an operand's surface. */
static void operand_normal(const boolean_operands *o, size_t k, int dim, const double x[3], double n[3])
{
    shape_differences(operand(o, k), dim, x, small_step * o->extent, n);
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int a = 0; a < 3; a++) n[a] *= length > 0.0 ? operand_sign(o, k) / length : 0.0;
}

/* Whether nothing about x is inside, asked in directions that no side is likely to have. */
static bool is_empty_about(const boolean_operands *o, int dim, const double x[3])
{
    for (int p = 0; p < PROBES; p++) {
        const double up = dim < 3 ? 0.0 : 1.0 - (2.0 * p + 1.0) / PROBES, out = sqrt(1.0 - up * up);
        const double angle = 0.237 + (dim < 3 ? 6.283185307179586 * p / PROBES : 2.399963229728653 * p);
        const double direction[3] = {dim == 1 ? 1.0 - 2.0 * (p % 2) : out * cos(angle), out * sin(angle), up};
        double y[3] = {0.0};
        for (int a = 0; a < dim; a++) y[a] = x[a] + small_step * o->extent * direction[a];
        if (!(greatest_level(o, dim, y) > 0.0)) return false;
    }
    return true;
}

/* Whether operands whose surfaces pass x lie on opposite sides of it. */
static bool meet_from_opposite_sides(const boolean_operands *o, int dim, const double x[3])
{
    const size_t n = count_operands(o);
    size_t passing = 0;
    for (size_t k = 0; k < n; k++) {
        double normal[3] = {0.0};
        if (!(fabs(operand_level(o, k, dim, x)) <= one_surface * o->extent)) continue;
        operand_normal(o, k, dim, x, normal);
        passing++;
        for (size_t j = 0; j < k; j++) {
            double other[3] = {0.0}, cosine = 0.0;
            if (!(fabs(operand_level(o, j, dim, x)) <= one_surface * o->extent)) continue;
            operand_normal(o, j, dim, x, other);
            for (int a = 0; a < dim; a++) cosine += normal[a] * other[a];
            if (cosine < opposite) return true;
        }
    }
    return passing > 2 && is_empty_about(o, dim, x);
}

double boolean_level(const boolean_operands *o, int dim, const double x[3])
{
    const double level = greatest_level(o, dim, x);
    if (!(fabs(level) <= one_surface * o->extent)) return level;
    return meet_from_opposite_sides(o, dim, x) ? apart * o->extent : level;
}

bool boolean_bounds(const boolean_operands *o, int dim, double lo[3], double hi[3])
{
    const size_t n = o->outside ? (o->first ? 1 : 0) : count_operands(o);
    bool bounded = false;
    for (size_t k = 0; k < n; k++) {
        const shape *s = operand(o, k);
        double from[3], to[3];
        if (!s->model->bounds(s->par, dim, from, to)) continue;
        for (int a = 0; a < dim; a++) {
            lo[a] = bounded ? fmax(lo[a], from[a]) : from[a];
            hi[a] = bounded ? fmin(hi[a], to[a]) : to[a];
        }
        bounded = true;
    }
    return bounded;
}

bool boolean_bounds_of_all(const boolean_operands *o, int dim, double lo[3], double hi[3])
{
    for (size_t k = 0; k < o->n; k++) {
        double from[3], to[3];
        if (!shape_bounds(&o->part[k], dim, from, to)) return false;
        for (int a = 0; a < dim; a++) {
            lo[a] = k > 0 ? fmin(lo[a], from[a]) : from[a];
            hi[a] = k > 0 ? fmax(hi[a], to[a]) : to[a];
        }
    }
    return true;
}

double boolean_extent(const boolean_operands *o, int dim)
{
    double most = o->first ? shape_extent(o->first, dim) : 0.0;
    for (size_t k = 0; k < o->n; k++) most = fmax(most, shape_extent(&o->part[k], dim));
    return most;
}

void boolean_check(const boolean_operands *o, int dim, char why[SHAPE_WHY])
{
    double lo[3], hi[3];
    if (!boolean_bounds(o, dim, lo, hi)) return;
    for (int a = 0; a < dim; a++)
        if (!(lo[a] < hi[a])) (void)snprintf(why, SHAPE_WHY, "its shapes have nothing in common");
}
