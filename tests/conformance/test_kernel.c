/* The kernels of every basis, dimension and geometry, with points anywhere, whose domains have any shape that F gives them: a scalar that
 * is linear in space comes to the points as it is, its gradient too; what points give sums to what they have, about their own places;
 * and no weight is negative. Every version of the kernels has the same bits. */
#include "check.h"

#include "mpm/transfer/kernels.h"
#include "mpm/transfer/lanes.h"
#include "mpm/transfer/point_arrays.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 400, DEFORM = 9, WINDOW = 343 * MPM_MAX_RECORD };

static const double h[3] = {0.1, 0.08, 0.125}; /* m */

typedef struct cloud {
    mesh mesh;
    tile_box tile;
    kernel_set kernel;
    point_arrays p;
    double x[3][POINTS], half[3][POINTS], v[3][POINTS], deform[DEFORM][POINTS], one[POINTS], zero[POINTS];
    int window[3], nodes, reach;
} cloud;

/* A tile in the middle of a mesh (1), or in its lowest (0) or highest corner (2). */
static void set_tile(cloud *c, context *ctx, int dim, int place)
{
    mesh_spec spec = {.dim = dim};
    const int width = mesh_tile_width(dim);
    for (int a = 0; a < dim; ++a) {
        spec.lower[a] = -0.3;
        spec.cell[a] = h[a];
        spec.upper[a] = spec.lower[a] + 3 * width * h[a];
    }
    check_ok(ctx, mesh_init(&c->mesh, ctx, &spec));
    c->tile = (tile_box){.cells = {1, 1, 1}};
    c->nodes = 1;
    for (int a = 0; a < 3; ++a) {
        c->tile.first[a] = a < dim ? place * width : 0;
        c->tile.cells[a] = a < dim ? width : 1;
        c->window[a] = a < dim ? width + 1 + 2 * c->reach : 1;
        c->nodes *= c->window[a];
    }
}

/* Stretched, sheared and turned as much as a factor of about four. */
static void set_points(cloud *c, int dim)
{
    static const int unit[3][3] = {{0}, {0, 3}, {0, 4, 8}};
    const int stored = dim == 1 ? 3 : dim == 2 ? 5 : 9;
    uint64_t seed = 5;
    for (size_t k = 0; k < POINTS; ++k) {
        for (int a = 0; a < dim; ++a) {
            const double from = mesh_node(&c->mesh, a, c->tile.first[a]);
            c->x[a][k] = check_random(&seed, from, from + c->tile.cells[a] * h[a]);
            c->half[a][k] = check_random(&seed, 0.05, 0.5) * h[a];
            c->v[a][k] = 0.0;
        }
        for (int i = 0; i < stored; ++i) c->deform[i][k] = k % 4 ? check_random(&seed, -2.0, 2.0) : 0.0;
        for (int a = 0; a < dim && k % 4 == 0; ++a) c->deform[unit[dim - 1][a]][k] = 1.0;
        c->one[k] = 1.0;
        c->zero[k] = 0.0;
    }
    c->p = (point_arrays){.mass = c->one, .volume0 = c->one, .J = c->one, .domain_limit = 1.0};
    for (int a = 0; a < 3; ++a) {
        c->p.x[a] = c->x[a];
        c->p.v[a] = c->v[a];
        c->p.half[a] = c->half[a];
        c->p.linear_side[a][0] = c->mesh.lower[a];
        c->p.linear_side[a][1] = c->mesh.upper[a];
    }
    for (int i = 0; i < stored; ++i) c->p.deform[i] = c->deform[i];
    for (int i = 0; i < 6; ++i) c->p.stress[i] = c->zero;
}

static cloud *make_cloud(context *ctx, const basis_model *b, int dim, mesh_geometry geometry, int place)
{
    cloud *c = calloc(1, sizeof *c);
    assert_non_null(c);
    c->reach = b->reach;
    set_tile(c, ctx, dim, place);
    c->kernel = *kernels_of(dim, geometry, b);
    set_points(c, dim);
    return c;
}

static double linear(const double x[3])
{
    return 0.7 + 1.3 * x[0] - 0.9 * x[1] + 0.4 * x[2];
}
static const double slope[3] = {1.3, -0.9, 0.4};

/* `components` values of a field that is linear in space in the record of each node of the window, which has `record` doubles. */
static double *linear_window(const cloud *c, int components, int record)
{
    double *window = calloc((size_t)(c->nodes * record), sizeof *window);
    assert_non_null(window);
    for (int n = 0, rest = 0; n < c->nodes; ++n, rest = n) {
        double x[3] = {0.0};
        for (int a = 0; a < c->mesh.dim; ++a) {
            x[a] = mesh_node(&c->mesh, a, c->tile.first[a] - c->reach + rest % c->window[a]);
            rest /= c->window[a];
        }
        for (int i = 0; i < components; ++i) window[n * record + i] = (i + 1) * linear(x);
    }
    return window;
}

static void place_of(const cloud *c, size_t k, double x[3])
{
    for (int a = 0; a < 3; ++a) x[a] = a < c->mesh.dim ? c->x[a][k] : 0.0;
}

/* Values of order one; differences over small volume fractions of 1e-4 cells lose four digits more. */
static void check_samples(const cloud *c)
{
    double out[POINTS], x[3], *window = linear_window(c, 1, 1);
    c->kernel.sample(&c->mesh, &c->tile, &c->p, 0, POINTS, window, out);
    for (size_t k = 0; k < POINTS; ++k) {
        place_of(c, k, x);
        check_close(out[k], linear(x), 2e-13);
    }
    free(window);
}

static void check_gradients(const cloud *c, gather_mode mode)
{
    const int dim = c->mesh.dim;
    static double L[9][POINTS];
    gather_result out = {.L = {0}};
    for (int i = 0; i < 9; ++i) out.L[i] = L[i];
    double *window = linear_window(c, dim, lanes_of(dim));
    const gather_step step = {.kick = 0.0};
    c->kernel.gather[mode](&c->mesh, &c->tile, &c->p, 0, POINTS, window, &step, &out);
    for (size_t k = 0; k < POINTS; ++k)
        for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b) check_close(L[3 * a + b][k], (a + 1) * slope[b], 1e-9);
    free(window);
}

/* One point at a time: its weights on the nodes are its mass there. */
static void check_weights(const cloud *c)
{
    const int record = lanes_of(1 + c->mesh.dim);
    double *out = calloc((size_t)(c->nodes * record), sizeof *out), *nodes = linear_window(c, 1, 1);
    assert_non_null(out);
    for (size_t k = 0; k < POINTS; ++k) {
        double sum = 0.0, moment = 0.0, x[3];
        memset(out, 0, (size_t)(c->nodes * record) * sizeof *out);
        c->kernel.scatter[SCATTER_MOMENTUM](&c->mesh, &c->tile, &c->p, k, k + 1, out);
        for (int n = 0; n < c->nodes; ++n) {
            check_true(out[n * record] >= -1e-13); /* a place is known to 192 eps of a cell */
            sum += out[n * record];
            moment += out[n * record] * nodes[n];
        }
        place_of(c, k, x);
        check_close(sum, 1.0, 1e-14);
        check_close(moment, linear(x), 2e-13);
    }
    free(out);
    free(nodes);
}

/* Folds the ghosts of a window beyond the sides of the mesh to the nodes inside, linearly (wall.c). */
static void fold_window(const cloud *c, int axis, int record, double *window)
{
    const int width = c->window[axis], stride = axis == 0 ? 1 : axis == 1 ? c->window[0] : c->window[0] * c->window[1];
    for (int n = 0; n < c->nodes; ++n) {
        const int i = n / stride % width;
        const bool lower = i == 0 && c->tile.first[axis] == 0,
                   upper = i == c->tile.cells[axis] + 2 && c->tile.first[axis] + c->tile.cells[axis] == c->mesh.n[axis];
        if (!lower && !upper) continue;
        const int inward = record * (lower ? stride : -stride);
        for (int k = 0; k < record; ++k) {
            double *ghost = window + n * record + k;
            ghost[inward] += 2.0 * *ghost;
            ghost[2 * inward] -= *ghost;
            *ghost = 0.0;
        }
    }
}

/* A point that carries the gradient of a linear field gives every node that field times its mass, next to sides too. */
static void check_affine(cloud *c)
{
    const int dim = c->mesh.dim, record = lanes_of(1 + dim);
    static double v[3][POINTS], C[9][POINTS];
    double *out = calloc((size_t)(c->nodes * record), sizeof *out), *field = linear_window(c, 1, 1);
    assert_non_null(out);
    point_arrays p = c->p;
    for (size_t k = 0; k < POINTS; ++k) {
        double x[3];
        place_of(c, k, x);
        for (int a = 0; a < dim; ++a) {
            v[a][k] = (a + 1) * linear(x);
            for (int b = 0; b < dim; ++b) C[dim * a + b][k] = (a + 1) * slope[b];
        }
    }
    for (int a = 0; a < dim; ++a) p.v[a] = v[a];
    for (int i = 0; i < dim * dim; ++i) p.affine[i] = C[i];
    for (size_t k = 0; k < POINTS; ++k) {
        memset(out, 0, (size_t)(c->nodes * record) * sizeof *out);
        c->kernel.scatter[SCATTER_MOMENTUM](&c->mesh, &c->tile, &p, k, k + 1, out);
        for (int a = 0; a < dim && c->reach > 0; ++a) fold_window(c, a, record, out);
        for (int n = 0; n < c->nodes; ++n)
            for (int a = 0; a < dim; ++a)
                check_close(out[n * record + 1 + a], out[n * record] * (a + 1) * field[n], 4e-13);
    }
    free(out);
    free(field);
}

/* Of a linear field points take its value and gradient, and give back what points that carry these do. */
static void check_projection(cloud *c)
{
    const int dim = c->mesh.dim, record = lanes_of(1 + dim), back = lanes_of(dim);
    static double v[3][POINTS], C[9][POINTS];
    double *given = calloc((size_t)(c->nodes * record), sizeof *given),
           *out = calloc((size_t)(c->nodes * back), sizeof *out), *field = linear_window(c, dim, back);
    assert_non_null(given);
    assert_non_null(out);
    point_arrays p = c->p;
    for (int a = 0; a < dim; ++a) p.v[a] = v[a];
    for (int i = 0; i < dim * dim; ++i) p.affine[i] = C[i];
    for (size_t k = 0; k < POINTS; ++k) {
        double x[3];
        place_of(c, k, x);
        for (int a = 0; a < dim; ++a) {
            v[a][k] = (a + 1) * linear(x);
            for (int b = 0; b < dim; ++b) C[dim * a + b][k] = (a + 1) * slope[b];
        }
        memset(given, 0, (size_t)(c->nodes * record) * sizeof *given);
        memset(out, 0, (size_t)(c->nodes * back) * sizeof *out);
        c->kernel.scatter[SCATTER_MOMENTUM](&c->mesh, &c->tile, &p, k, k + 1, given);
        c->kernel.project(&c->mesh, &c->tile, &p, k, k + 1, field, out);
        for (int n = 0; n < c->nodes; ++n)
            for (int a = 0; a < dim; ++a) check_close(out[n * back + a], given[n * record + 1 + a], 4e-12);
    }
    free(given);
    free(out);
    free(field);
}

/* Everything that kernels write, from windows of the same numbers. */
typedef struct kernel_output {
    double x[3][POINTS], v[3][POINTS], L[9][POINTS], sample[POINTS];
    double window[SCATTER_MODES + 2][WINDOW];
} kernel_output;

static void run_kernels(const cloud *c, const kernel_set *kernel, bool moments, kernel_output *out)
{
    const int dim = c->mesh.dim;
    gather_result to = {.L = {0}};
    for (int a = 0; a < 3; ++a) {
        to.x_next[a] = out->x[a];
        to.v_next[a] = out->v[a];
    }
    for (int i = 0; i < 9; ++i) to.L[i] = out->L[i];
    double *mass = linear_window(c, 1, 1), *both = linear_window(c, 2 * dim, lanes_reserved(lanes_of(2 * dim)));
    const gather_step step = {0.3, 0.2, 0.9, mass};
    if (moments) kernel->gather[GATHER_MOMENTS](&c->mesh, &c->tile, &c->p, 0, POINTS, both, &step, &to);
    kernel->gather[GATHER_BOTH](&c->mesh, &c->tile, &c->p, 0, moments ? POINTS / 2 : POINTS, both, &step, &to);
    kernel->sample(&c->mesh, &c->tile, &c->p, 0, POINTS, mass, out->sample);
    for (int mode = 0; mode < SCATTER_MODES; ++mode)
        kernel->scatter[mode](&c->mesh, &c->tile, &c->p, 0, POINTS, out->window[mode]);
    kernel->fill(&c->mesh, &c->tile, &c->p, 0, POINTS, out->window[SCATTER_MODES]);
    kernel->project(&c->mesh, &c->tile, &c->p, 0, POINTS, both, out->window[SCATTER_MODES + 1]);
    free(mass);
    free(both);
}

/* Points with stresses, velocities and masses of their own: kernels for wide registers have the bits of those for any machine. */
static void check_bits(cloud *c, const basis_model *b, mesh_geometry geometry)
{
    if (!floe_has_quads()) return;
    const kernel_set any = *kernels_pairs(c->mesh.dim, geometry, b), wide = *kernels_quads(c->mesh.dim, geometry, b);
    kernel_output *one = calloc(1, sizeof *one), *other = calloc(1, sizeof *other);
    assert_non_null(one);
    assert_non_null(other);
    uint64_t seed = 11;
    for (size_t k = 0; k < POINTS; ++k)
        for (int a = 0; a < 3; ++a) c->v[a][k] = check_random(&seed, -1.0, 1.0);
    for (int i = 0; i < 6; ++i) c->p.stress[i] = c->v[i % 3];
    c->p.mass = c->half[0];
    for (int carried = 0; carried <= 1; ++carried) {
        for (int i = 0; i < 9; ++i) c->p.affine[i] = carried ? c->deform[i] : NULL;
        run_kernels(c, &any, !basis_is(b, "linear"), one);
        run_kernels(c, &wide, !basis_is(b, "linear"), other);
        assert_memory_equal(one, other, sizeof *one);
    }
    free(one);
    free(other);
}

static void check_kernels(const basis_model *b, int dim, mesh_geometry geometry, int place)
{
    context *ctx = context_create();
    cloud *c = make_cloud(ctx, b, dim, geometry, place);
    check_samples(c);
    check_weights(c);
    check_affine(c);
    check_projection(c);
    check_gradients(c, GATHER_GRADIENT);
    if (!basis_is(b, "linear")) check_gradients(c, GATHER_MOMENTS); /* with the linear basis it is the gradient */
    check_bits(c, b, geometry);
    free(c);
    context_destroy(&ctx);
}

static void test_kernels(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int place = 0; place <= 2; ++place) {
            for (int dim = 1; dim <= 3; ++dim) check_kernels(basis_registry[i], dim, MESH_CARTESIAN, place);
            check_kernels(basis_registry[i], 2, MESH_AXISYMMETRIC, place);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_kernels)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
