/* Area or volume that a membrane encloses, if it is closed or its ends lie on mirrors; for a surface in space that of its triangles. */
#include "grid/tile_box.h"
#include "mpm/membrane/membrane_curve.h"
#include "mpm/surface/membrane_boundary.h"
#include "mpm/transfer/scratch.h"

#include <math.h>
#include <string.h>

bool mpm_membrane_encloses(const mpm *s, int body)
{
    if (s->mesh->dim == 3) return membrane_is_joined(s, body);
    if (s->mesh->dim != 2 || !s->body[body].membrane.model) return false;
    const membrane_curve *curve = &s->curve[body];
    return curve->n > 2 && curve->ordered && (curve->closed || (curve->end[0].axis >= 0 && curve->end[1].axis >= 0));
}

/* The enclosed region: the points of the membrane, and whether the scene is axisymmetric. */
typedef struct contour {
    const membrane_curve *curve;
    bool radial;
} contour;

static contour contour_of(const mpm *s, int body)
{
    return (contour){&s->curve[body], s->mesh->geometry == MESH_AXISYMMETRIC};
}

/* A corner of the enclosed area: which of its coordinates are those of a point. */
typedef struct corner {
    double x[2];
    size_t point;
    bool own[2];
} corner;

static void fix_corner(corner *c, int axis, double value)
{
    c->x[axis] = value;
    c->own[axis] = false;
}

/* Corners n to n + 3 of the area enclosed by n points: where the last meets its mirror, where the mirrors meet or,
 * about an axis, both ends' feet on it, and where the first meets its mirror. */
static corner corner_of(const contour *o, size_t k)
{
    const membrane_curve *curve = o->curve;
    const size_t last = curve->n - 1, at = k <= last ? k : k <= curve->n + 1 ? last : 0;
    corner c = {{curve->x[3 * at], curve->x[3 * at + 1]}, at, {true, true}};
    if (k <= last) return c;
    fix_corner(&c, curve->end[at == last].axis, curve->end[at == last].plane);
    if (k == curve->n || k == curve->n + 3) return c;
    if (o->radial)
        fix_corner(&c, 0, 0.0);
    else
        fix_corner(&c, curve->end[at != last].axis, curve->end[at != last].plane);
    return c;
}

static size_t corner_count(const contour *o)
{
    return o->curve->n + (o->curve->closed ? 0 : 4);
}

static bool is_inside(const contour *o, double x, double y)
{
    const size_t n = corner_count(o);
    corner a = corner_of(o, n - 1);
    bool inside = false;
    for (size_t k = 0; k < n; ++k) {
        const corner b = corner_of(o, k);
        if ((a.x[1] > y) != (b.x[1] > y) && x < a.x[0] + (b.x[0] - a.x[0]) * (y - a.x[1]) / (b.x[1] - a.x[1]))
            inside = !inside;
        a = b;
    }
    return inside;
}

/* What a side adds to the area, or about an axis to the volume per radian, the integral of r^2/2 dz; slopes by a and
 * b. */
static double side_of(const contour *o, const double a[2], const double b[2], double by_a[2], double by_b[2])
{
    const double up = b[1] - a[1];
    if (!o->radial) {
        by_a[0] = 0.5 * b[1];
        by_a[1] = -0.5 * b[0];
        by_b[0] = -0.5 * a[1];
        by_b[1] = 0.5 * a[0];
        return 0.5 * (a[0] * b[1] - b[0] * a[1]);
    }
    const double square = (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) / 6.0;
    by_a[0] = (2.0 * a[0] + b[0]) / 6.0 * up;
    by_a[1] = -square;
    by_b[0] = (a[0] + 2.0 * b[0]) / 6.0 * up;
    by_b[1] = square;
    return square * up;
}

static void add_slope(const corner *c, const double by[2], double *gradient)
{
    for (int a = 0; a < 2 && gradient; ++a)
        if (c->own[a]) gradient[2 * c->point + (size_t)a] += by[a];
}

/* Area or volume, and its gradient if requested. */
static double size_of(const contour *o, double *gradient)
{
    const size_t n = corner_count(o);
    corner a = corner_of(o, n - 1);
    double sum = 0.0;
    if (gradient) memset(gradient, 0, 2 * o->curve->n * sizeof *gradient);
    for (size_t k = 0; k < n; ++k) {
        const corner b = corner_of(o, k);
        double by_a[2], by_b[2];
        sum += side_of(o, a.x, b.x, by_a, by_b);
        add_slope(&a, by_a, gradient);
        add_slope(&b, by_b, gradient);
        a = b;
    }
    for (size_t k = 0; gradient && sum < 0.0 && k < 2 * o->curve->n; ++k) gradient[k] = -gradient[k];
    return fabs(sum);
}

double membrane_measure(const mpm *s, int body, double *gradient)
{
    const contour o = contour_of(s, body);
    return size_of(&o, gradient);
}

enum { SUM_PRESSURE, SUM_OUTSIDE, SUM_STRESS, SUM_HOOP, SUM_VOLUME, MEMBRANE_SUMS };

static void add_fluid(const mpm *s, int blk, int tile, int body, const contour *o, double *sum)
{
    const fields *f = s->domain->fields[blk];
    const size_t *at = s->points[blk][body].tile_start;
    const double *volume0 = field_get(f, P_VOLUME0, body, 0), *J = field_get(f, P_J, body, 0), *stress[3];
    const double *x = field_get(f, P_POS, body, 0), *y = field_get(f, P_POS, body, 1);
    for (int c = 0; c < 3; ++c) stress[c] = field_get(f, P_STRESS, body, c);
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        const double gauge = -(stress[0][k] + stress[1][k] + stress[2][k]) / 3.0;
        sum[SUM_PRESSURE] += volume0[k] * J[k] * (gauge + s->scene->reference_pressure);
        if (!is_inside(o, x[k], y[k])) sum[SUM_OUTSIDE] += field_get(f, P_MASS, body, 0)[k];
    }
}

static void add_membrane(const mpm *s, int blk, int tile, int body, double *sum)
{
    const fields *f = s->domain->fields[blk];
    const size_t *at = s->points[blk][body].tile_start;
    const double *volume0 = field_get(f, P_VOLUME0, body, 0), *stress[3];
    const bool surface = s->mesh->dim == 3;
    for (int c = 0; c < 3; ++c) stress[c] = field_get(f, P_STRESS, body, c);
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        sum[SUM_STRESS] +=
            volume0[k] * (surface ? 0.5 * (stress[0][k] + stress[1][k] + stress[2][k]) : stress[0][k] + stress[1][k]);
        sum[SUM_HOOP] += volume0[k] * stress[2][k];
        sum[SUM_VOLUME] += volume0[k];
    }
}

typedef struct enclosure_sum {
    const contour *o;
    int body;
} enclosure_sum;

static void add_membrane_tile(mpm *s, int blk, int tile, void *user, double *sum)
{
    const enclosure_sum *e = user;
    for (int k = 0; k < s->n_bodies && s->mesh->dim == 2; ++k)
        if (s->body[k].fluid) add_fluid(s, blk, tile, k, e->o, sum);
    add_membrane(s, blk, tile, e->body, sum);
}

void mpm_membrane_enclosure(mpm *s, int body, membrane_enclosure *out)
{
    const contour o = contour_of(s, body);
    double sum[MEMBRANE_SUMS];
    membrane_curve_update(s, body, false);
    sum_over_tiles(s, MEMBRANE_SUMS, add_membrane_tile, &(enclosure_sum){&o, body}, sum);
    out->size = s->mesh->dim == 3 ? membrane_volume(s, body) : size_of(&o, NULL);
    out->pressure = sum[SUM_PRESSURE] / out->size;
    out->outside = sum[SUM_OUTSIDE];
    out->stress = sum[SUM_STRESS] / sum[SUM_VOLUME];
    out->hoop = sum[SUM_HOOP] / sum[SUM_VOLUME];
}
