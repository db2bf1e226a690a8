/* Pushes of cells on vertices: areas of one vertex of a cell add up, those of others stay apart, and lists outgrow what was reserved. */
#include "check.h"

#include "coupling/wall_response.h"

#include <string.h>

enum { CELLS = 300, VERTICES = 7 };

/* A whole number of a cell, a vertex and a component, so that sums are exact. */
static double part(int cell, int vertex, int a, int times)
{
    return (double)(100 * cell + 10 * vertex + a + 1) * times;
}

static void fill(wall_response *w, context *ctx)
{
    for (int k = 0; k < CELLS; k += 3) check_ok(ctx, wall_response_add_cells(w, 3));
    assert_int_equal(w->n_cells, CELLS);
    for (int times = 1; times <= 2; ++times)
        for (int vertex = 0; vertex < VERTICES; ++vertex)
            for (int cell = vertex % 2; cell < CELLS; cell += 2) {
                double area[3];
                for (int a = 0; a < 3; ++a) area[a] = part(cell, vertex, a, times);
                check_ok(ctx, wall_response_add_push(w, cell, vertex, area));
            }
}

static void check_lists(const wall_response *w)
{
    int all = 0;
    for (int cell = 0; cell < CELLS; ++cell) {
        bool seen[VERTICES] = {false};
        for (int k = w->cell[cell].first; k >= 0; k = w->push[k].next, ++all) {
            const int vertex = w->push[k].vertex;
            assert_in_range(vertex, 0, VERTICES - 1);
            check_true(!seen[vertex] && vertex % 2 == cell % 2);
            seen[vertex] = true;
            for (int a = 0; a < 3; ++a) check_close(w->push[k].area[a], part(cell, vertex, a, 3), 0.0);
        }
        for (int vertex = 0; vertex < VERTICES; ++vertex) assert_int_equal(seen[vertex], vertex % 2 == cell % 2);
    }
    assert_int_equal(all, w->n_pushes);
}

static void areas_add_up(void **state)
{
    context *ctx = *state;
    wall_response w = {.ctx = ctx};
    for (int times = 0; times < 2; ++times) {
        fill(&w, ctx);
        check_lists(&w);
        assert_true(w.reserved_cells < 3 * CELLS && w.reserved_pushes < 3 * w.n_pushes); /* and no more than needed */
        wall_response_clear(&w);
        assert_int_equal(w.n_cells, 0);
        assert_int_equal(w.n_pushes, 0);
    }
    wall_response_free(&w);
}

/* What a cell's pressure does as more flows out of it, and its slope. */
static void pressure_falls_with_flux(void **unused)
{
    (void)unused;
    uint64_t seed = 3;
    for (int n = 0; n < 1000; ++n) {
        const wall_cell c = {.stiffness = check_random(&seed, 1.0, 3.0),
                             .squeeze = check_random(&seed, -2.0, 2.0),
                             .per_flux = check_random(&seed, 0.5, 2.0),
                             .linear = check_random(&seed, 1.0, 2.0),
                             .square = check_random(&seed, 0.5, 1.0)};
        const double y = check_random(&seed, -2.0, 2.0), was = fmax(c.squeeze, 0.0),
                     is = fmax(c.squeeze - c.per_flux * y, 0.0);
        const double bulk = c.linear * (is - was) + c.square * (is * is - was * was), step = 1e-4;
        check_close(wall_pressure_change(&c, y), bulk - c.stiffness * y, 1e-14 * 50.0);
        check_close(wall_pressure_change(&c, 0.0), 0.0, 0.0);
        const double from = c.squeeze - c.per_flux * (y - step), to = c.squeeze - c.per_flux * (y + step);
        if ((from > 0.0) != (to > 0.0)) continue; /* across the kink there is no one slope */
        check_close((wall_pressure_change(&c, y - step) - wall_pressure_change(&c, y + step)) / (2.0 * step),
                    wall_pressure_slope(&c, y), 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressure_falls_with_flux),
        cmocka_unit_test_setup_teardown(areas_add_up, check_make_context, check_drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
