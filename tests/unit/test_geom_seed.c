/* Fractions and seeding against exact areas, volumes and centroids. */
#include "check.h"

#include "base/memory.h"
#include "geom/seed.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

/* A shape of the registry with its parameters as a list in the order of its struct. */
static shape shape_of(const char *name, double *par)
{
    const shape_model *model = shape_find(name);
    assert_non_null(model);
    return (shape){.model = model, .par = par};
}

static seed_spec spec_of(int dim, double lower, double h, int n, int per_cell, seed_method method)
{
    seed_spec spec = {.dim = dim, .method = method, .merge = 0.3};
    for (int k = 0; k < 3; k++) {
        spec.lower[k] = lower;
        spec.h[k] = h;
        spec.n[k] = k < dim ? n : 1;
        spec.per_cell[k] = per_cell;
    }
    return spec;
}

typedef struct totals {
    double volume, first[3], least;
} totals;

/* Sums, checking on the way that every point is in its cell. */
static totals totals_of(const seed_list *list, const seed_spec *spec)
{
    totals t = {.least = INFINITY};
    for (size_t i = 0; i < list->n; i++) {
        t.volume += list->volume[i];
        t.least = fmin(t.least, list->volume[i]);
        for (int k = 0; k < spec->dim; k++) {
            const double x = list->x[k][i], corner = spec->lower[k] + spec->h[k] * list->cell[k][i];
            t.first[k] += list->volume[i] * x;
            check_true(list->cell[k][i] >= 0 && list->cell[k][i] < spec->n[k]);
            check_true(x >= corner - 1e-12 && x <= corner + spec->h[k] + 1e-12);
            check_close(list->half[k][i], 0.5 * spec->h[k] / spec->per_cell[k], 1e-15);
        }
    }
    return t;
}

static totals seed_totals(const shape *s, const seed_spec *spec)
{
    context *ctx = context_create();
    seed_list list;
    check_ok(ctx, seed_shape(&list, ctx, s, spec));
    const totals t = totals_of(&list, spec);
    seed_list_free(ctx, &list);
    assert_int_equal(memory_read_account(ctx).live_bytes, 0);
    context_destroy(&ctx);
    return t;
}

/* A straight cut is exact, whatever its slope: the triangle under x/a + y/b = 1, and with weight r. */
static void test_linear_cut(void **state)
{
    (void)state;
    double par[6] = {0.8, 0, 0, 1.0 / 0.8, 1.0 / 0.5, 0}, x[3];
    const shape s = shape_of("halfspace", par);
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    for (int depth = 0; depth < 4; depth++) {
        check_close(shape_fraction(&s, 2, lo, hi, false, depth, x), 0.5 * 0.8 * 0.5, 1e-15);
        check_close(x[0], 0.8 / 3.0, 1e-14);
        check_close(x[1], 0.5 / 3.0, 1e-14);
        /* integral of r is a^2 b / 6, of r^2 a^3 b / 12, of r z a^2 b^2 / 24; of the whole box 1/2 */
        check_close(shape_fraction(&s, 2, lo, hi, true, depth, x), 0.64 * 0.5 / 3.0, 1e-15);
        check_close(x[0], 0.8 / 2.0, 1e-14);
        check_close(x[1], 0.5 / 4.0, 1e-14);
    }
    double par3[6] = {0.8, 0, 0, 1.0 / 0.8, 1.0 / 0.5, 1.0 / 0.9};
    const shape s3 = shape_of("halfspace", par3);
    for (int depth = 0; depth < 4; depth++) {
        check_close(shape_fraction(&s3, 3, lo, hi, false, depth, x), 0.8 * 0.5 * 0.9 / 6.0, 1e-15);
        check_close(x[2], 0.9 / 4.0, 1e-14);
    }
}

/* All of a box, nothing of it, and one that ends on its faces. */
static void test_trivial_fractions(void **state)
{
    (void)state;
    double par[6] = {0.25, 0.25, 0.25, 0.75, 0.75, 0.75}, x[3];
    const shape s = shape_of("box", par);
    const double lo[3] = {0.25, 0.25, 0.25}, hi[3] = {0.5, 0.5, 0.5}, far[3] = {0.75, 0.25, 0.25},
                 end[3] = {1, 0.5, 0.5};
    for (int dim = 1; dim <= 3; dim++) {
        check_close(shape_fraction(&s, dim, lo, hi, false, 3, x), 1.0, 1e-13);
        for (int k = 0; k < dim; k++) check_close(x[k], 0.375, 1e-13);
        check_close(shape_fraction(&s, dim, far, end, false, 3, x), 0.0, 0.0);
    }
}

/* A disc: with smallest boxes of h, chords alone would lose h^2/(6 R^2) of the area, 1.0 / 4^depth here; the correction for
 * curvature leaves less than a twentieth of that, and falls faster. Seeded at 20 cells across and 2 points a cell, the area
 * is right to 1e-8. */
static void test_disc_area(void **state)
{
    (void)state;
    double par[4] = {0.513, 0.487, 0, 0.4}, centroid[3];
    const shape s = shape_of("ball", par);
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    for (int depth = 4; depth <= 9; depth++) {
        const double error = fabs(shape_fraction(&s, 2, lo, hi, false, depth, centroid) / (PI * 0.16) - 1.0);
        check_true(error < 0.05 * pow(0.25, depth));
        check_close(centroid[0], 0.513, 0.05 * pow(0.25, depth));
    }
    const seed_spec spec = spec_of(2, 0.0, 0.04, 25, 2, SEED_FITTED);
    const totals t = seed_totals(&s, &spec);
    check_close_relative(t.volume, PI * 0.16, 1e-8);
    check_close_relative(t.first[0], 0.513 * PI * 0.16, 1e-8);
    check_close_relative(t.first[1], 0.487 * PI * 0.16, 1e-8);
}

/* The quarter annulus on a mesh that cuts it: first moment (R^3 - r^3)/3 along both axes. */
static void test_quarter_annulus(void **state)
{
    (void)state;
    double par[5] = {0, 0, 0, 0.5, 1.0};
    const shape s = shape_of("annulus", par);
    for (int per = 1; per <= 4; per++) {
        const seed_spec spec = spec_of(2, 0.0, 0.05, 24, per, SEED_FITTED);
        const totals t = seed_totals(&s, &spec);
        check_close_relative(t.volume, PI * 0.75 / 4.0, 3e-6);
        check_close_relative(t.first[0], 0.875 / 3.0, 3e-6);
        check_close_relative(t.first[1], 0.875 / 3.0, 3e-6);
        /* no sliver is left: what is under 0.3 of a sub-cell has joined a neighbour */
        check_true(t.least >= 0.3 * 0.05 * 0.05 / (per * per));
    }
    const seed_spec lattice = spec_of(2, 0.0, 0.05, 24, 2, SEED_LATTICE);
    const totals t = seed_totals(&s, &lattice);
    check_close_relative(t.volume, PI * 0.75 / 4.0, 0.01);
    check_close(t.least, 0.025 * 0.025, 1e-17);
}

/* Merging changes neither volume nor first moments. */
static void test_merge_conserves(void **state)
{
    (void)state;
    double par[4] = {0.53, 0.47, 0.51, 0.33};
    const shape s = shape_of("ball", par);
    for (int dim = 1; dim <= 3; dim++) {
        seed_spec spec = spec_of(dim, 0.0, 0.1, 10, 2, SEED_FITTED);
        spec.merge = 0.0;
        const totals split = seed_totals(&s, &spec);
        const double merges[3] = {0.1, 0.3, 1.0};
        for (int m = 0; m < 3; m++) {
            spec.merge = merges[m];
            const totals merged = seed_totals(&s, &spec);
            check_close_relative(merged.volume, split.volume, 1e-14);
            for (int k = 0; k < dim; k++) check_close_relative(merged.first[k], split.first[k], 1e-14);
            check_true(merged.least >= split.least);
            if (dim > 1 && m > 0) check_true(merged.least > split.least);
        }
    }
}

/* A body of small volume fractions alone, all alike: they end in one point at its centre, and the choice between equals
 * ends. */
static void test_only_slivers(void **state)
{
    (void)state;
    context *ctx = context_create();
    double par[4] = {0.5, 0.5, 0.5, 0.04};
    const shape s = shape_of("ball", par);
    for (int dim = 1; dim <= 3; dim++) {
        seed_list list;
        seed_spec spec = spec_of(dim, 0.0, 0.25, 4, 1, SEED_FITTED);
        check_ok(ctx, seed_shape(&list, ctx, &s, &spec));
        assert_int_equal(list.n, 1);
        for (int k = 0; k < dim; k++) check_close(list.x[k][0], 0.5, 1e-9);
        seed_list_free(ctx, &list);
    }
    context_destroy(&ctx);
}

/* What lies between two bodies that share a face is round-off of its place: no point. A layer of any width that is meant has its points. */
static void test_round_off(void **state)
{
    (void)state;
    context *ctx = context_create();
    const double width[2] = {4e-16, 1e-6};
    for (int w = 0; w < 2; w++) {
        double par[6] = {0.5, 0.1, 0.0, 0.5 + width[w], 0.9, 1.0};
        const shape s = shape_of("box", par);
        seed_list list;
        const seed_spec spec = spec_of(2, 0.0, 0.25, 4, 2, SEED_FITTED);
        check_ok(ctx, seed_shape(&list, ctx, &s, &spec));
        assert_int_equal(list.n > 0, w == 1);
        seed_list_free(ctx, &list);
    }
    context_destroy(&ctx);
}

static void test_solids_3d(void **state)
{
    (void)state;
    double ball[4] = {0.5, 0.5, 0.5, 0.4}, tube[8] = {0.2, 0.3, 0.4, 0.8, 0.7, 0.6, 0.2, 0.1};
    const shape sphere = shape_of("ball", ball), cylinder = shape_of("cylinder", tube);
    const seed_spec spec = spec_of(3, 0.0, 0.04, 25, 1, SEED_FITTED);
    const totals t = seed_totals(&sphere, &spec);
    check_close_relative(t.volume, 4.0 / 3.0 * PI * 0.064, 1e-7);
    for (int k = 0; k < 3; k++) check_close_relative(t.first[k], 0.5 * t.volume, 1e-7);
    /* along its edges a tenth or so of the section of the smallest boxes is lost */
    const totals c = seed_totals(&cylinder, &spec);
    check_close_relative(c.volume, PI * 0.03 * sqrt(0.36 + 0.16 + 0.04), 5e-4);
}

/* Per radian: a sphere on the axis holds 2 R^3 / 3, a cylinder R^2 H / 2; the integral of r dV is pi R^4 / 8 and
 * R^3 H / 3. */
static void test_axisymmetric(void **state)
{
    (void)state;
    double ball[4] = {0.0, 0.5, 0, 0.4}, box[6] = {0, 0.21, 0, 0.37, 0.83, 0};
    const shape sphere = shape_of("ball", ball), cylinder = shape_of("box", box);
    seed_spec spec = spec_of(2, 0.0, 0.04, 25, 2, SEED_FITTED);
    spec.axisymmetric = true;
    const totals s = seed_totals(&sphere, &spec);
    check_close_relative(s.volume, 2.0 / 3.0 * 0.064, 3e-6);
    check_close_relative(s.first[0], PI * 0.0256 / 8.0, 3e-6);
    check_close_relative(s.first[1], 0.5 * s.volume, 3e-6);
    const totals c = seed_totals(&cylinder, &spec);
    check_close_relative(c.volume, 0.5 * 0.37 * 0.37 * 0.62, 3e-6);
    check_close_relative(c.first[0], 0.37 * 0.37 * 0.37 * 0.62 / 3.0, 3e-6);
    /* on the lattice a mesh-aligned cylinder is exact too */
    double whole[6] = {0, 0.2, 0, 0.4, 0.8, 0};
    const shape aligned = shape_of("box", whole);
    spec.method = SEED_LATTICE;
    check_close_relative(seed_totals(&aligned, &spec).volume, 0.5 * 0.16 * 0.6, 1e-13);
}

/* A mesh-aligned body gets the same points from both methods: cell by cell, then sub-cell by sub-cell. */
static void test_aligned_order(void **state)
{
    (void)state;
    context *ctx = context_create();
    double par[6] = {0.5, 0.25, 0, 1.0, 0.75, 0};
    const shape s = shape_of("box", par);
    seed_spec spec = spec_of(2, 0.0, 0.25, 5, 2, SEED_LATTICE);
    seed_list a, b;
    check_ok(ctx, seed_shape(&a, ctx, &s, &spec));
    spec.method = SEED_FITTED;
    check_ok(ctx, seed_shape(&b, ctx, &s, &spec));
    assert_int_equal(a.n, 16);
    assert_int_equal(b.n, 16);
    for (size_t i = 0; i < 16; i++) {
        const int cell = (int)i / 4, sub = (int)i % 4;
        check_close(a.x[0][i], 0.5 + 0.25 * (cell % 2) + 0.125 * (sub % 2) + 0.0625, 0.0);
        check_close(a.x[1][i], 0.25 + 0.25 * (cell / 2) + 0.125 * (sub / 2) + 0.0625, 0.0);
        assert_int_equal(a.cell[0][i], 2 + cell % 2);
        assert_int_equal(a.cell[1][i], 1 + cell / 2);
        for (int k = 0; k < 2; k++) {
            check_close(a.x[k][i], b.x[k][i], 1e-15);
            assert_int_equal(a.cell[k][i], b.cell[k][i]);
        }
        check_close_relative(a.volume[i], b.volume[i], 1e-14);
    }
    seed_list_free(ctx, &a);
    seed_list_free(ctx, &b);
    context_destroy(&ctx);
}

/* Bodies outside the mesh, and without bounds. */
static void test_edges(void **state)
{
    (void)state;
    double far[4] = {1e30, 0, 0, 0.1}, plane[6] = {0.3, 0, 0, 2.0, 0, 0};
    const shape away = shape_of("ball", far), half = shape_of("halfspace", plane);
    for (int method = SEED_LATTICE; method <= SEED_FITTED; method++) {
        const seed_spec spec = spec_of(2, 0.0, 0.1, 10, 2, (seed_method)method);
        check_close(seed_totals(&away, &spec).volume, 0.0, 0.0);
        check_close(seed_totals(&half, &spec).volume, 0.3, 1e-14);
    }
}

/* Impossible parameters are named. */
static void test_checks(void **state)
{
    (void)state;
    double box[6] = {0, 0, 0, 1, 0, 1}, ring[5] = {0, 0, 0, 2, 1}, tube[8] = {1, 1, 1, 1, 1, 1, 1, 0}, plane[6] = {0};
    check_true(shape_find("box")->check(box, 1) == NULL);
    check_true(shape_find("box")->check(box, 2) != NULL);
    check_true(shape_find("annulus")->check(ring, 2) != NULL);
    check_true(shape_find("cylinder")->check(tube, 3) != NULL);
    check_true(shape_find("halfspace")->check(plane, 2) != NULL);
    check_true(shape_find("no such shape") == NULL);
}

/* Whichever allocation fails, it is reported and nothing is kept. */
static void test_out_of_memory(void **state)
{
    (void)state;
    double par[4] = {0.53, 0.47, 0, 0.33};
    const shape s = shape_of("ball", par);
    const seed_spec spec = spec_of(2, 0.0, 0.05, 20, 2, SEED_FITTED);
    context *ctx = context_create();
    for (uint64_t n = 1;; n++) {
        seed_list list;
        memory_inject_failure(ctx, n);
        const floe_status status = seed_shape(&list, ctx, &s, &spec);
        memory_inject_failure(ctx, 0);
        if (status == FLOE_OK) {
            check_true(n > 10);
            seed_list_free(ctx, &list);
            break;
        }
        check_fails(ctx, status, FLOE_NO_MEMORY);
        assert_int_equal(list.n, 0);
        assert_int_equal(memory_read_account(ctx).live_bytes, 0);
    }
    assert_int_equal(memory_read_account(ctx).live_bytes, 0);
    context_destroy(&ctx);
}

/* Lattices may be moved against the mesh: points then lie off the middle of their sub-cells, and none comes from outside. */
static void test_offset(void **state)
{
    (void)state;
    double par[6] = {0.0, 0, 0, 5.0, 1, 1};
    const shape s = shape_of("box", par);
    context *ctx = context_create();
    for (int per = 1; per <= 3; per++) {
        for (double offset = -0.375; offset < 0.5; offset += 0.125) {
            seed_spec spec = spec_of(1, 0.0, 1.0, 5, per, SEED_LATTICE);
            seed_list list;
            spec.offset[0] = offset;
            check_ok(ctx, seed_shape(&list, ctx, &s, &spec));
            const size_t n = (size_t)(5 * per);
            assert_int_equal(list.n, n);
            for (size_t i = 0; i < n; i++) {
                const double x = ((double)i + 0.5 + offset) / per;
                check_close(list.x[0][i], x, 1e-14);
                check_close(list.volume[i], 1.0 / per, 1e-14);
                if (per < 3) assert_int_equal(list.cell[0][i], (int)floor(x)); /* thirds are rounded */
            }
            seed_list_free(ctx, &list);
        }
    }
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_linear_cut),      cmocka_unit_test(test_trivial_fractions),
        cmocka_unit_test(test_disc_area),       cmocka_unit_test(test_quarter_annulus),
        cmocka_unit_test(test_merge_conserves), cmocka_unit_test(test_solids_3d),
        cmocka_unit_test(test_axisymmetric),    cmocka_unit_test(test_aligned_order),
        cmocka_unit_test(test_only_slivers),    cmocka_unit_test(test_round_off),
        cmocka_unit_test(test_edges),           cmocka_unit_test(test_checks),
        cmocka_unit_test(test_out_of_memory),   cmocka_unit_test(test_offset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
