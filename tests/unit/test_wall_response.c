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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(areas_add_up, check_make_context, check_drop_context),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
