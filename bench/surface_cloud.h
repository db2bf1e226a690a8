/* Points with their exact normals, and the angles by which estimates are off them: what the benchmarks of normals
 * share. */
#ifndef BENCH_SURFACE_CLOUD_H
#define BENCH_SURFACE_CLOUD_H

#include "base/memory.h"
#include "math/tensor.h"
#include "surface/isosurface.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;
enum { MOST = 4096, DRAWS = 100 };

/* Points with their exact normals. */
typedef struct cloud {
    int n;
    double x[MOST][3], normal[MOST][3];
} cloud;

static inline cloud *add(cloud *c, double x, double y, double z, double nx, double ny, double nz)
{
    const double at[3] = {x, y, z};
    double n[3] = {nx, ny, nz};
    vec_normalize(n);
    memcpy(c->x[c->n], at, sizeof at);
    memcpy(c->normal[c->n++], n, sizeof n);
    return c;
}

static inline double angle(const double a[3], const double b[3])
{
    double c[3];
    vec_cross(a, b, c);
    return atan2(vec_norm(c), fabs(vec_dot(a, b))) * 180.0 / pi;
}

/* Largest, root mean square. */
typedef struct errors {
    double most, square;
    int n;
} errors;

static inline void enter(errors *e, double degrees)
{
    e->most = fmax(e->most, degrees);
    e->square += degrees * degrees;
    e->n++;
}

static inline double rms(const errors *e)
{
    return sqrt(e->square / e->n);
}

/* ---- one element of the size of one ---- */

/* The function on the element for a point off the surface, or for the best of a few (NULL). False: no solution. */
static inline bool solve(const cloud *c, int dim, int degree, surface_solver solver, const double *away, isosurface *f)
{
    const double lower[3] = {0}, size[3] = {1, 1, 1};
    isosurface_begin(f, solver, dim, degree, lower, size);
    for (int k = 0; k < c->n; ++k) isosurface_add(f, c->x[k]);
    return away ? isosurface_solve(f, away) : isosurface_find(f);
}

static inline errors errors_of(const cloud *c, const isosurface *f)
{
    errors e = {0};
    for (int k = 0; k < c->n; ++k) {
        double n[3];
        (void)isosurface_normal(f, c->x[k], n);
        enter(&e, angle(n, c->normal[k]));
    }
    return e;
}

static inline int ascending(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static inline double median(double *x, int n)
{
    qsort(x, (size_t)n, sizeof *x, ascending);
    return 0.5 * (x[(n - 1) / 2] + x[n / 2]);
}

/* ---- whole methods, on a mesh ---- */

/* A context, a mesh of cells h over [-half, half], and estimates. */
typedef struct field {
    context *ctx;
    mesh m;
    surface_set set;
    surface_estimate estimate[MOST];
} field;

static inline void begin(field *f, int dim, double half, double h)
{
    mesh_spec spec = {.dim = dim};
    f->ctx = context_create();
    for (int a = 0; a < 3; ++a) {
        spec.lower[a] = -half;
        spec.upper[a] = half;
        spec.cell[a] = h;
    }
    if (mesh_init(&f->m, f->ctx, &spec) != FLOE_OK) {
        fprintf(stderr, "%s\n", context_message(f->ctx));
        exit(1);
    }
    surface_set_init(&f->set, f->ctx, &f->m);
    f->set.closed = true;
}

static inline void end(field *f)
{
    surface_set_free(&f->set);
    context_destroy(&f->ctx);
}

static inline errors measure(field *f, const cloud *c, const surface_method *method, const double *par)
{
    errors e = {0};
    if (surface_set_points(&f->set, (size_t)c->n, &c->x[0][0]) != FLOE_OK) exit(1);
    surface_normals(&f->set, method, par, f->estimate);
    for (int k = 0; k < c->n; ++k) enter(&e, angle(f->estimate[k].normal, c->normal[k]));
    return e;
}

/* ---- tables ---- */

typedef struct bench_table {
    const char *name, *doc;
    void (*print)(void);
} bench_table;

/* The table that the command line names; a list of all without a name. */
static inline int print_table(int argc, char **argv, size_t n, const bench_table *table)
{
    for (size_t k = 0; k < n; ++k) {
        if (argc < 2) printf("%-12s %s\n", table[k].name, table[k].doc);
        if (argc != 2 || strcmp(argv[1], table[k].name) != 0) continue;
        table[k].print();
        return 0;
    }
    return argc < 2 ? 0 : 2;
}

#endif
