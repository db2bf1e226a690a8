#include "surface/isosurface.h"

#include "math/tensor.h"
#include "surface/spline.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { TRIES = 8 };

static const double fair_condition = 1e3, fair_evenness = 0.5;
/* What chi may miss where the surface is taken for flat: far above round-off, far below what an angle is wanted to. */
static const double flat = 1e-9;
static const double least_gradient = 0.1; /* of the largest in the cell */

void isosurface_begin(isosurface *f, surface_solver solver, int dim, int degree, const double lower[3],
                      const double size[3])
{
    f->dim = dim;
    f->degree = degree;
    f->functions = 1;
    for (int a = 0; a < 3; ++a) {
        if (a < dim) f->functions = degree > 0 ? f->functions * (degree + 1) : dim + 1;
        f->lower[a] = lower[a];
        f->size[a] = size[a];
    }
    f->condition = f->residual = NAN;
    f->rank = f->kept = 0;
    least_squares_begin(&f->rows, solver, f->functions);
}

/* 1 and the places along the axes. */
static void plain_functions(const isosurface *f, const double x[3], double *value, double (*gradient)[3])
{
    value[0] = 1.0;
    for (int a = 0; a < f->dim; ++a) value[1 + a] = (x[a] - f->lower[a]) / f->size[a];
    for (int k = 0; gradient && k < f->functions; ++k)
        for (int a = 0; a < 3; ++a) gradient[k][a] = k == 1 + a ? 1.0 / f->size[a] : 0.0;
}

/* Values of all functions at x, and their gradients (1/m) where `gradient` is not NULL. */
static void functions_at(const isosurface *f, const double x[3], double *value, double (*gradient)[3])
{
    spline_values along[3];
    const int per_axis = f->degree + 1;
    if (f->degree == 0) {
        plain_functions(f, x, value, gradient);
        return;
    }
    for (int a = 0; a < f->dim; ++a) along[a] = spline_of(f->degree, (x[a] - f->lower[a]) / f->size[a]);
    for (int k = 0; k < f->functions; ++k) {
        int at[3], rest = k;
        value[k] = 1.0;
        for (int a = 0; a < f->dim; ++a) {
            at[a] = rest % per_axis;
            rest /= per_axis;
            value[k] *= along[a].w[at[a]];
        }
        for (int a = 0; gradient && a < 3; ++a) {
            gradient[k][a] = a < f->dim ? along[a].dw[at[a]] / f->size[a] : 0.0;
            for (int b = 0; b < f->dim; ++b)
                if (b != a) gradient[k][a] *= along[b].w[at[b]];
        }
    }
}

void isosurface_row(const isosurface *f, const double x[3], double *row)
{
    functions_at(f, x, row, NULL);
}

void isosurface_add(isosurface *f, const double x[3])
{
    double row[SURFACE_MAX_FUNCTIONS];
    functions_at(f, x, row, NULL);
    least_squares_add(&f->rows, row, 1.0);
    if (f->kept < ISOSURFACE_KEPT) memcpy(f->place[f->kept++], x, sizeof f->place[0]);
}

/* Least squares of all rows and one more: the function is 0 at a point away from the surface, on which it is 1. */
static bool solve_with(const isosurface *f, const double away[3], least_squares_solution *found)
{
    least_squares all = f->rows;
    double row[SURFACE_MAX_FUNCTIONS];
    functions_at(f, away, row, NULL);
    least_squares_add(&all, row, 0.0);
    return least_squares_solve(&all, found);
}

static void take_coefficients(isosurface *f, const least_squares_solution *found)
{
    memcpy(f->chi, found->x, sizeof f->chi);
    f->rank = found->rank;
    f->condition = found->condition;
    f->residual = found->residual;
}

bool isosurface_solve(isosurface *f, const double away[3])
{
    least_squares_solution found;
    if (!solve_with(f, away, &found)) return false;
    take_coefficients(f, &found);
    return true;
}

/* The k-th of a sequence of numbers in [0, 1) (splitmix64; Steele, Lea, Flood 2014). */
static double random_number(uint64_t k)
{
    uint64_t z = (k + 1) * UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

void isosurface_away(const isosurface *f, int k, double away[3])
{
    for (int a = 0; a < 3; ++a)
        away[a] = a < f->dim ? f->lower[a] + f->size[a] * random_number(3 * (uint64_t)k + (uint64_t)a) : 0.0;
}

double isosurface_normal(const isosurface *f, const double x[3], double n[3])
{
    double value[SURFACE_MAX_FUNCTIONS], gradient[SURFACE_MAX_FUNCTIONS][3];
    functions_at(f, x, value, gradient);
    for (int a = 0; a < 3; ++a) n[a] = 0.0;
    for (int k = 0; k < f->functions; ++k) vec_add_scaled(f->chi[k], gradient[k], n);
    return vec_normalize(n);
}

/* Least over largest gradient at the points. */
static double gradient_ratio(const isosurface *f)
{
    double least = INFINITY, most = 0.0;
    for (int k = 0; k < f->kept; ++k) {
        double n[3];
        const double size = isosurface_normal(f, f->place[k], n);
        least = fmin(least, size);
        most = fmax(most, size);
    }
    return most > 0.0 ? least / most : 0.0;
}

bool isosurface_find(isosurface *f)
{
    least_squares_solution found, best = {.rank = 0};
    double best_score = -1.0;
    for (int k = 0; k < TRIES; ++k) {
        double away[3];
        isosurface_away(f, k, away);
        if (!solve_with(f, away, &found) || found.rank < best.rank) continue;
        take_coefficients(f, &found);
        const double score = f->degree == 0 ? 1.0 / found.condition : gradient_ratio(f);
        if (found.rank == best.rank && !(score > best_score)) continue;
        best = found;
        best_score = score;
        if (found.rank == f->functions && score > (f->degree == 0 ? 1.0 / fair_condition : fair_evenness)) break;
    }
    take_coefficients(f, &best);
    return best_score >= 0.0;
}

/* Normals of the points of a cell, from a function that has been solved. Where its gradient is a small part of what it
 * is at other points, chi has an extreme near the surface, and the direction is no more than a chance. */
static void put_normals(const surface_set *s, const surface_cell *c, const isosurface *f, surface_basis basis,
                        surface_estimate *out)
{
    double normal[3], most = 0.0;
    for (size_t k = 0; k < c->n; ++k) most = fmax(most, isosurface_normal(f, s->points.entry[c->first + k].x, normal));
    for (size_t k = 0; k < c->n; ++k) {
        const surface_entry *e = &s->points.entry[c->first + k];
        surface_estimate *to = &out[e->number];
        if (e->image != 0 || !(isosurface_normal(f, e->x, normal) > least_gradient * most)) continue;
        memcpy(to->normal, normal, sizeof normal);
        to->condition = f->condition;
        to->basis = basis;
    }
}

static void add_cell_equations(const surface_set *s, const surface_cell *c, isosurface *f)
{
    for (size_t k = 0; c && k < c->n; ++k) isosurface_add(f, s->points.entry[c->first + k].x);
}

/* The element of `width` cells along each axis, the first of them at `at`. */
static void begin_element(const surface_set *s, const int at[3], int width, int degree, isosurface *f)
{
    double lower[3], size[3];
    for (int a = 0; a < 3; ++a) {
        lower[a] = mesh_node(s->mesh, a, at[a]);
        size[a] = width * s->mesh->h[a];
    }
    isosurface_begin(f, SOLVE_QR, s->mesh->dim, degree, lower, size);
}

/* Cells that are joined: `width` along each axis from `at` on. */
typedef struct joined_cells {
    int at[3], width;
    size_t points;
} joined_cells;

typedef void cell_visitor(const surface_set *s, const surface_cell *c, void *user);

static void visit_joined(const surface_set *s, const joined_cells *j, cell_visitor *visit, void *user)
{
    int width[3], at[3];
    for (int a = 0; a < 3; ++a) width[a] = a < s->mesh->dim ? j->width : 1;
    for (int z = 0; z < width[2]; ++z)
        for (int y = 0; y < width[1]; ++y)
            for (int x = 0; x < width[0]; ++x) {
                at[0] = j->at[0] + x;
                at[1] = j->at[1] + y;
                at[2] = j->at[2] + z;
                const surface_cell *c = surface_cell_at(&s->points, at);
                if (c) visit(s, c, user);
            }
}

static void count_points(const surface_set *s, const surface_cell *c, void *user)
{
    (void)s;
    *(size_t *)user += c->n;
}

static void add_point_equations(const surface_set *s, const surface_cell *c, void *user)
{
    add_cell_equations(s, c, user);
}

/* Of the groups of `width` cells about a cell (which lies in its middle, as near as can be) the one with the most
 * points. */
static joined_cells join_cells(const surface_set *s, const surface_cell *c, int width)
{
    joined_cells best = {.points = 0};
    for (int corner = 0; corner < 1 << s->mesh->dim; ++corner) {
        joined_cells j = {.width = width};
        for (int a = 0; a < 3; ++a) {
            const int below = a < s->mesh->dim ? width / 2 - ((corner >> a) & 1) : 0;
            j.at[a] = c->at[a] - below;
        }
        visit_joined(s, &j, count_points, &j.points);
        if (j.points > best.points) best = j;
    }
    return best;
}

/* The cells on which a cell's function stands: itself, or as many as are enough. */
static joined_cells gather_cells(const surface_set *s, const surface_cell *c, size_t enough)
{
    joined_cells j = {.at = {c->at[0], c->at[1], c->at[2]}, .width = 1, .points = c->n};
    for (int width = 2; width <= 2 * SURFACE_RINGS && j.points < enough; width *= 2) j = join_cells(s, c, width);
    return j;
}

/* With constant gradients the rank is full unless the points lie on top of each other or, in space, on a line. */
static bool find_on(const surface_set *s, const joined_cells *j, int degree, isosurface *f)
{
    begin_element(s, j->at, j->width, degree, f);
    visit_joined(s, j, add_point_equations, f);
    /* Quadratic functions that vanish on a line are that line times others, and have its normal: any of the solutions
     * will do. */
    return isosurface_find(f) && (degree == 2 || f->rank == f->functions);
}

bool isosurface_of_cell(const surface_set *s, const surface_cell *c, int degree, size_t enough, surface_estimate *out)
{
    const joined_cells j = gather_cells(s, c, enough);
    isosurface f;
    if (j.points < enough && degree == 2) return false;
    const bool plain = find_on(s, &j, 0, &f);
    if (!plain || f.residual > flat) {
        const bool found = find_on(s, &j, degree, &f);
        if (!found && (!plain || degree == 2 || !find_on(s, &j, 0, &f))) return false;
    }
    put_normals(s, c, &f, j.width > 1 ? SURFACE_JOINED : SURFACE_METHOD, out);
    return true;
}

size_t isosurface_enough(int dim, int degree)
{
    size_t functions = 1;
    for (int a = 0; a < dim; ++a) functions *= (size_t)degree + 1;
    return functions - 1;
}
