#include "surface/height.h"

#include "math/tensor.h"
#include "surface/least_squares.h"

#include <math.h>
#include <string.h>

/* A pivot below this share of its diagonal entry: the square of a condition of a thousand. */
static const double small_pivot = 1e-6;

/* Of a neighbour, over the reach: its place in the plane, its height, and its weight. */
typedef struct sample {
    double u, v, height, weight;
} sample;

typedef struct surroundings {
    int n;
    sample s[1 + SURFACE_MOST_NEAR];
} surroundings;

static void project_neighbours(int dim, int n, const surface_neighbour *near, double reach, const surface_frame *f,
                               surroundings *out)
{
    const double scale = 1.0 / reach;
    out->n = n + 1;
    out->s[0] = (sample){.weight = 1.0};
    for (int k = 0; k < n; ++k) {
        const double *d = near[k].d;
        out->s[k + 1] = (sample){scale * vec_dot(d, f->u), dim == 3 ? scale * vec_dot(d, f->v) : 0.0,
                                 scale * vec_dot(d, f->n), surface_weight(near[k].square * scale * scale)};
    }
}

/* Monomials of u and v up to a degree; how many there are. */
static int fill_monomials(int dim, int degree, double u, double v, double row[HEIGHT_TERMS])
{
    const double all[HEIGHT_TERMS] = {1.0, u, dim == 3 ? v : u * u, dim == 3 ? u * u : u * u * u, u * v, v * v};
    memcpy(row, all, sizeof all);
    return dim == 3 ? (degree + 1) * (degree + 2) / 2 : degree + 1;
}

/* ---- normal equations ---- */

typedef struct equations {
    double a[HEIGHT_TERMS][HEIGHT_TERMS], b[HEIGHT_TERMS]; /* lower triangle; right-hand side */
} equations;

static void add_equations(const surroundings *about, int dim, equations *e)
{
    *e = (equations){0};
    for (int k = 0; k < about->n; ++k) {
        const sample *s = &about->s[k];
        double row[HEIGHT_TERMS];
        (void)fill_monomials(dim, 2, s->u, s->v, row);
        for (int i = 0; i < HEIGHT_TERMS; ++i) {
            const double weighted = s->weight * row[i];
            for (int j = 0; j <= i; ++j) e->a[i][j] += weighted * row[j];
            e->b[i] += weighted * s->height;
        }
    }
}

/* The triangle in place; false where a pivot is small. */
static bool factorize_normal_matrix(int terms, double a[HEIGHT_TERMS][HEIGHT_TERMS])
{
    for (int j = 0; j < terms; ++j) {
        double pivot = a[j][j];
        for (int k = 0; k < j; ++k) pivot -= a[j][k] * a[j][k];
        if (!(pivot > small_pivot * a[j][j])) return false;
        a[j][j] = sqrt(pivot);
        for (int i = j + 1; i < terms; ++i) {
            double sum = a[i][j];
            for (int k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
            a[i][j] = sum / a[j][j];
        }
    }
    return true;
}

static bool solve_equations(int terms, equations *e, height_fit *out)
{
    double least = INFINITY, most = 0.0;
    if (!factorize_normal_matrix(terms, e->a)) return false;
    for (int i = 0; i < terms; ++i) {
        double sum = e->b[i];
        for (int k = 0; k < i; ++k) sum -= e->a[i][k] * out->x[k];
        out->x[i] = sum / e->a[i][i];
        least = fmin(least, e->a[i][i]);
        most = fmax(most, e->a[i][i]);
    }
    for (int i = terms - 1; i >= 0; --i) {
        double sum = out->x[i];
        for (int k = i + 1; k < terms; ++k) sum -= e->a[k][i] * out->x[k];
        out->x[i] = sum / e->a[i][i];
    }
    out->condition = most / least;
    return true;
}

/* ---- the triangle, and lower degrees ---- */

static bool fit_heights(const surroundings *about, int dim, int degree, height_fit *out)
{
    double row[HEIGHT_TERMS];
    least_squares l;
    least_squares_solution found;
    const int terms = fill_monomials(dim, degree, 0.0, 0.0, row);
    if (about->n < terms) return false;
    least_squares_begin(&l, SOLVE_QR, terms);
    for (int k = 0; k < about->n; ++k) {
        const sample *s = &about->s[k];
        const double root = sqrt(s->weight);
        (void)fill_monomials(dim, degree, s->u, s->v, row);
        for (int i = 0; i < terms; ++i) row[i] *= root;
        least_squares_add(&l, row, root * s->height);
    }
    if (!least_squares_solve(&l, &found) || found.rank < terms) return false;
    memcpy(out->x, found.x, (size_t)terms * sizeof *out->x);
    out->condition = found.condition;
    return true;
}

bool height_find(int dim, int n, const surface_neighbour *near, double reach, const surface_frame *f, height_fit *out)
{
    surroundings about;
    equations e;
    const int highest = dim == 3 ? 2 : 3, terms = dim == 3 ? 6 : 4;
    *out = (height_fit){.condition = 1.0};
    project_neighbours(dim, n, near, reach, f, &about);
    if (about.n >= terms) {
        add_equations(&about, dim, &e);
        if (solve_equations(terms, &e, out)) return true;
    }
    for (int degree = highest; degree > 0; --degree) {
        memset(out->x, 0, sizeof out->x);
        if (fit_heights(&about, dim, degree, out)) return true;
    }
    return false;
}
