/* Surfaces in space: areas, where the points of a membrane lie and what they weigh, mirrors that cut them, and what is refused. */
#include "check.h"

#include "base/memory.h"
#include "geom/sheet_seeding.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* A cube of cells. */
static seed_spec grid_of(double lower, double upper, double h)
{
    seed_spec g = {.dim = 3};
    for (int k = 0; k < 3; k++) {
        g.lower[k] = lower;
        g.h[k] = h;
        g.n[k] = (int)lround((upper - lower) / h);
    }
    return g;
}

typedef struct layer {
    size_t n;
    double area, first[3], nearest,
        widest; /* first moments of area; least distance, and largest of a point to its nearest */
} layer;

static layer measure(context *ctx, const sheet_surface *s, const sheet_seeding *how, const seed_spec *grid)
{
    seed_list list;
    check_ok(ctx, seed_sheet(&list, ctx, s, how, grid));
    layer out = {.n = list.n, .nearest = INFINITY};
    for (size_t i = 0; i < list.n; i++) {
        double near = INFINITY;
        out.area += list.volume[i] / how->thickness;
        for (int a = 0; a < 3; a++) out.first[a] += list.volume[i] / how->thickness * list.x[a][i];
        check_close_relative(list.volume[i], list.volume[0], 1e-14);
        for (size_t j = 0; j < list.n; j++) {
            double square = 0.0;
            for (int a = 0; a < 3; a++) square += pow(list.x[a][i] - list.x[a][j], 2.0);
            if (j != i) near = fmin(near, sqrt(square));
        }
        out.nearest = fmin(out.nearest, near);
        out.widest = fmax(out.widest, near);
    }
    seed_list_free(ctx, &list);
    return out;
}

/* Even: the nearest neighbour of no point is closer than half of the spacing sqrt(area / n), nor farther than 1.4 of it. */
static void check_even(const layer *l)
{
    const double spacing = sqrt(l->area / (double)l->n);
    check_true(l->nearest > 0.5 * spacing);
    check_true(l->widest < 1.4 * spacing);
}

/* A sphere as a whole, in halves and eighths: exact areas, first moments (pi R^3 / 4 along each axis of an eighth) to the order of the spacing squared. */
static void spheres(void **state)
{
    (void)state;
    context *ctx = context_create();
    const sheet_surface s = {.kind = SHEET_SPHERE, .axis = 2, .radius = 0.5};
    const sheet_seeding how = {.per_cell = 2, .thickness = 0.01};
    const seed_spec whole = grid_of(-0.6, 0.6, 0.1), eighth = grid_of(0.0, 0.6, 0.1), other = grid_of(-0.6, 0.0, 0.1);
    const layer all = measure(ctx, &s, &how, &whole), part = measure(ctx, &s, &how, &eighth),
                behind = measure(ctx, &s, &how, &other);
    check_close_relative(all.area, pi, 1e-13);
    check_close_relative(part.area, pi / 8.0, 1e-13);
    check_close_relative(behind.area, pi / 8.0, 1e-13);
    check_close_relative((double)all.n, pi * 400.0, 0.03);
    check_close_relative((double)part.n, pi * 50.0, 0.05);
    for (int a = 0; a < 3; a++) {
        check_close(all.first[a], 0.0, 1e-12);
        check_close_relative(part.first[a], 0.25 * pi * 0.125, 5e-3);
        check_close_relative(behind.first[a], -0.25 * pi * 0.125, 5e-3);
    }
    check_even(&all);
    check_even(&part);
    context_destroy(&ctx);
}

/* A cylinder and its quarter; a curve turned about each axis that it may be: a cone, and an arc that makes a hemisphere. */
static void revolutions(void **state)
{
    (void)state;
    context *ctx = context_create();
    const sheet_seeding how = {.number = 900, .thickness = 0.01};
    const seed_spec whole = grid_of(-0.6, 0.6, 0.1), eighth = grid_of(0.0, 0.6, 0.1);
    for (int axis = 0; axis < 3; axis++) {
        const sheet_surface shell = {.kind = SHEET_CYLINDER, .axis = axis, .radius = 0.4, .from = 0.5, .to = 0.1};
        const layer l = measure(ctx, &shell, &how, &whole), quarter = measure(ctx, &shell, &how, &eighth);
        check_close_relative(l.area, 2.0 * pi * 0.4 * 0.4, 1e-13);
        check_close_relative(quarter.area, 0.5 * pi * 0.4 * 0.4, 1e-13);
        check_close_relative(l.first[axis], 0.3 * l.area, 1e-12);
        check_even(&l);
        check_even(&quarter);
        double vertex[9] = {0};
        vertex[axis] = -0.3; /* on the axis */
        vertex[3 + axis] = 0.1;
        vertex[3 + (axis + 1) % 3] = 0.3;
        vertex[6 + axis] = 0.5;
        vertex[6 + (axis + 1) % 3] = 0.3;
        const sheet_surface cone = {
            .kind = SHEET_REVOLVED, .axis = axis, .curve = {.kind = CURVE_POLYLINE, .vertex = vertex, .n_vertices = 3}};
        const layer turned = measure(ctx, &cone, &how, &whole);
        check_close_relative(turned.area, pi * 0.3 * 0.5 + 2.0 * pi * 0.3 * 0.4, 1e-13);
    }
    for (int axis = 0; axis < 2; axis++) {
        const double from = axis == 0 ? 0.5 * pi : 0.0;
        const sheet_surface cap = {
            .kind = SHEET_REVOLVED,
            .axis = axis,
            .curve = {.kind = CURVE_ARC, .radius = 0.5, .angle_from = from, .angle_to = 0.5 * pi - from}};
        const layer l = measure(ctx, &cap, &how, &whole);
        check_close_relative(l.area, 2.0 * pi * 0.25, 1e-13);
        check_close_relative(l.first[axis], pi * 0.125, 5e-3);
        check_even(&l);
    }
    context_destroy(&ctx);
}

static void planes(void **state)
{
    (void)state;
    context *ctx = context_create();
    const sheet_surface s = {
        .kind = SHEET_PLANE, .corner = {0.1, 0.1, 0.2}, .first = {0.8, 0.0, 0.0}, .second = {0.2, 0.4, 0.3}};
    const sheet_seeding how = {.per_cell = 2, .thickness = 0.01};
    const seed_spec grid = grid_of(0.0, 1.2, 0.1);
    const layer l = measure(ctx, &s, &how, &grid);
    check_close_relative(l.area, 0.8 * 0.5, 1e-13);
    check_close_relative(l.first[0], 0.6 * l.area, 1e-12);
    check_close_relative(l.first[2], 0.35 * l.area, 1e-12);
    context_destroy(&ctx);
}

static void expect_bad(const sheet_surface *s, int number, const seed_spec *grid, const char *words)
{
    context *ctx = context_create();
    const sheet_seeding how = {.number = number, .thickness = 0.01};
    seed_list list;
    assert_int_equal(seed_sheet(&list, ctx, s, &how, grid), FLOE_BAD_INPUT);
    assert_non_null(strstr(context_message(ctx), words));
    context_destroy(&ctx);
}

static void refusals(void **state)
{
    (void)state;
    const seed_spec grid = grid_of(0.0, 0.6, 0.1);
    const sheet_surface sphere = {.kind = SHEET_SPHERE, .axis = 2, .radius = 0.5};
    const sheet_surface large = {.kind = SHEET_SPHERE, .axis = 2, .radius = 0.7};
    const sheet_surface flat = {.kind = SHEET_PLANE, .first = {0.1, 0.0, 0.0}, .second = {0.2, 0.0, 0.0}};
    const sheet_surface across = {.kind = SHEET_REVOLVED,
                                  .axis = 1,
                                  .curve = {.kind = CURVE_ARC, .radius = 0.3, .angle_from = 0.0, .angle_to = 3.0}};
    expect_bad(&sphere, 20, &grid,
               "m apart, more than a cell of 0.1 m: the membrane would be torn; give it more points");
    expect_bad(&large, 900, &grid, "lies outside the domain");
    expect_bad(&flat, 900, &grid, "the surface has no area");
    expect_bad(&across, 900, &grid, "its curve crosses the axis about which it is turned");
    const sheet_surface thread = {.kind = SHEET_PLANE, .first = {1e-20, 0.0, 0.0}, .second = {0.0, 1e20, 0.0}};
    const sheet_surface endless = {.kind = SHEET_SPHERE, .axis = 2, .radius = 1e19};
    const char *const too_many = "more points than the 1e+08 that one membrane can have";
    expect_bad(&thread, 100, &grid, too_many);
    expect_bad(&endless, 1000000000, &grid, too_many);
}

/* A list of the points of a sphere has their positions and volumes; its area is given, and its points must not be torn
 * from each other. */
static void test_list(void **state)
{
    (void)state;
    context *ctx = context_create();
    const seed_spec grid = grid_of(0.0, 1.0, 0.1);
    const sheet_surface sphere = {.kind = SHEET_SPHERE, .radius = 0.5, .axis = 2};
    const sheet_seeding how = {.per_cell = 3, .thickness = 0.01};
    seed_list own, again;
    double place[3 * 1024];
    check_ok(ctx, seed_sheet(&own, ctx, &sphere, &how, &grid));
    assert_true(own.n > 100 && own.n <= 1024);
    for (size_t i = 0; i < own.n; i++)
        for (int a = 0; a < 3; a++) place[3 * i + (size_t)a] = own.x[a][i];
    sheet_surface list = {
        .kind = SHEET_POINTS, .curve = {.vertex = place, .n_vertices = (int)own.n}, .area = sheet_area(&sphere, &grid)};
    check_ok(ctx, seed_sheet(&again, ctx, &list, &how, &grid));
    assert_int_equal(again.n, own.n);
    for (size_t i = 0; i < own.n; i++) {
        for (int a = 0; a < 3; a++) check_close(again.x[a][i], own.x[a][i], 0.0);
        check_close_relative(again.volume[i], own.volume[i], 1e-14);
    }
    seed_list_free(ctx, &again);
    list.curve.n_vertices = 30;
    assert_int_equal(seed_sheet(&again, ctx, &list, &how, &grid), FLOE_BAD_INPUT);
    context_clear(ctx);
    place[0] = 1.5;
    list.curve.n_vertices = (int)own.n;
    assert_int_equal(seed_sheet(&again, ctx, &list, &how, &grid), FLOE_BAD_INPUT);
    context_clear(ctx);
    seed_list_free(ctx, &own);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_list), cmocka_unit_test(spheres),  cmocka_unit_test(revolutions),
        cmocka_unit_test(planes),    cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
