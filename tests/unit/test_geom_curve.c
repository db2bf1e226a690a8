/* Curves: lengths, where the points of a membrane lie and what they weigh, and what is refused. */
#include "check.h"

#include "base/memory.h"
#include "geom/curve.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static seed_spec grid_of(int dim, double size, double h)
{
    seed_spec g = {.dim = dim, .n = {1, 1, 1}};
    for (int k = 0; k < dim; k++) {
        g.h[k] = h;
        g.n[k] = (int)lround(size / h);
    }
    return g;
}

static double sum(const double *x, size_t n)
{
    double s = 0.0;
    for (size_t i = 0; i < n; i++) s += x[i];
    return s;
}

static void segment_has_points_in_the_middle_of_pieces(void **state)
{
    (void)state;
    context *ctx = context_create();
    const curve_line c = {.kind = CURVE_SEGMENT, .from = {0.2, 0.5}, .to = {0.8, 0.5}};
    const curve_seeding how = {.number = 6, .thickness = 0.01, .length = NAN};
    const seed_spec grid = grid_of(2, 1.0, 0.25);
    seed_list list;
    check_ok(ctx, seed_curve(&list, ctx, &c, &how, &grid));
    assert_int_equal(list.n, 6);
    for (int i = 0; i < 6; i++) {
        check_close(list.x[0][i], 0.25 + 0.1 * i, 1e-15);
        check_close(list.x[1][i], 0.5, 0.0);
        check_close(list.volume[i], 1e-3, 1e-17);
        assert_int_equal(list.cell[0][i], (int)((0.25 + 0.1 * i) / 0.25 + 1e-12));
        assert_int_equal(list.cell[1][i], 2);
    }
    seed_list_free(ctx, &list);
    context_destroy(&ctx);
}

/* A circle's points lie on it, evenly; about the axis a half circle's volumes add up to the sphere's surface (4 pi R^2 over 2 pi a
 * radian), to the second order of midpoints. */
static void circles(void **state)
{
    (void)state;
    context *ctx = context_create();
    const curve_line c = {.kind = CURVE_CIRCLE, .centre = {0.5, 0.5}, .radius = 0.4};
    const curve_line arc = {
        .kind = CURVE_ARC, .centre = {0.0, 0.5}, .radius = 0.4, .angle_from = -0.5 * pi, .angle_to = 0.5 * pi};
    curve_seeding how = {.number = 40, .thickness = 2.0, .length = NAN};
    seed_spec grid = grid_of(2, 1.0, 0.1);
    seed_list list;
    check_true(curve_is_closed(&c) && !curve_is_closed(&arc));
    check_close_relative(curve_length(&c, 2), 0.8 * pi, 1e-15);
    check_ok(ctx, seed_curve(&list, ctx, &c, &how, &grid));
    for (size_t i = 0; i < list.n; i++) check_close(hypot(list.x[0][i] - 0.5, list.x[1][i] - 0.5), 0.4, 1e-15);
    check_close_relative(sum(list.volume, list.n), 1.6 * pi, 1e-14);
    seed_list_free(ctx, &list);
    grid.axisymmetric = true;
    for (int k = 0; k < 2; k++) {
        how.number = 40 << k;
        check_ok(ctx, seed_curve(&list, ctx, &arc, &how, &grid));
        const double step = pi / how.number; /* midpoints of a cosine: 1 + step^2 / 24 */
        check_close_relative(sum(list.volume, list.n), 2.0 * 0.4 * 0.4 * 2.0 * (1.0 + step * step / 24.0), 1e-6);
        seed_list_free(ctx, &list);
    }
    context_destroy(&ctx);
}

static void polylines_and_points(void **state)
{
    (void)state;
    context *ctx = context_create();
    double square[] = {0.2, 0.2, 0.0, 0.6, 0.2, 0.0, 0.6, 0.6, 0.0, 0.2, 0.6, 0.0};
    curve_line c = {.kind = CURVE_POLYLINE, .vertex = square, .n_vertices = 4};
    curve_seeding how = {.number = 12, .thickness = 1.0, .length = NAN};
    const seed_spec grid = grid_of(2, 1.0, 0.2);
    seed_list list;
    check_close_relative(curve_length(&c, 2), 1.2, 1e-15);
    c.closed = true;
    how.number = 16;
    check_close_relative(curve_length(&c, 2), 1.6, 1e-15);
    check_ok(ctx, seed_curve(&list, ctx, &c, &how, &grid));
    check_close(list.x[0][15], 0.2, 1e-14); /* on the way back to the first vertex */
    check_close(list.x[1][15], 0.25, 1e-14);
    seed_list_free(ctx, &list);
    c.kind = CURVE_POINTS;
    c.closed = false;
    const seed_spec coarse = grid_of(2, 1.0, 0.5);
    check_ok(ctx, seed_curve(&list, ctx, &c, &how, &coarse));
    assert_int_equal(list.n, 4);
    check_close(list.volume[0], 0.2, 1e-15);
    check_close(list.volume[1], 0.4, 1e-15);
    seed_list_free(ctx, &list);
    how.length = 2.0;
    check_ok(ctx, seed_curve(&list, ctx, &c, &how, &coarse));
    check_close(list.volume[0], 0.5, 1e-15);
    seed_list_free(ctx, &list);
    context_destroy(&ctx);
}

static void bad_membranes_are_refused(void **state)
{
    (void)state;
    context *ctx = context_create();
    const curve_seeding sparse = {.number = 3, .thickness = 1.0, .length = NAN};
    const seed_spec grid = grid_of(2, 1.0, 0.1);
    const curve_line inside = {.kind = CURVE_SEGMENT, .from = {0.1, 0.5}, .to = {0.9, 0.5}};
    const curve_line outside = {.kind = CURVE_SEGMENT, .from = {0.1, 0.5}, .to = {0.3, 1.5}};
    const curve_line circle = {.kind = CURVE_CIRCLE, .centre = {0.5, 0.5}, .radius = 0.4};
    const curve_seeding fine = {.number = 50, .thickness = 1.0, .length = NAN};
    seed_list list;
    assert_int_equal(seed_curve(&list, ctx, &inside, &sparse, &grid), FLOE_BAD_INPUT);
    assert_non_null(strstr(context_message(ctx), "points 1 and 2, about (0.233333, 0.5), are 0.266667 m apart"));
    context_clear(ctx);
    assert_int_equal(seed_curve(&list, ctx, &outside, &fine, &grid), FLOE_BAD_INPUT);
    assert_non_null(strstr(context_message(ctx), "lies outside the domain"));
    context_clear(ctx);
    assert_int_equal(seed_curve(&list, ctx, &circle, &sparse, &grid), FLOE_BAD_INPUT);
    context_clear(ctx);
    const curve_line endless = {.kind = CURVE_SEGMENT, .from = {0.1, 0.5}, .to = {0.1, 1e19}};
    const curve_seeding all = {.number = curve_count(&endless, 0, 2, &grid), .thickness = 1.0, .length = NAN};
    assert_int_equal(seed_curve(&list, ctx, &endless, &all, &grid), FLOE_BAD_INPUT);
    assert_non_null(strstr(context_message(ctx), "more points than the 1e+08 that one membrane can have"));
    context_clear(ctx);
    memory_inject_failure(ctx, 2);
    check_fails(ctx, seed_curve(&list, ctx, &inside, &fine, &grid), FLOE_NO_MEMORY);
    memory_inject_failure(ctx, 0);
    check_true(list.volume == NULL && list.n == 0);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segment_has_points_in_the_middle_of_pieces),
        cmocka_unit_test(circles),
        cmocka_unit_test(polylines_and_points),
        cmocka_unit_test(bad_membranes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
