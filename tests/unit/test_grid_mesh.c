/* The mesh: cells, tiles and blocks fit each other for any sizes; what cannot be is refused with a way out. */
#include "check.h"

#include "grid/mesh.h"

#include <math.h>
#include <string.h>

static mesh_spec spec_of(int dim, const int cells[3], const int blocks[3])
{
    mesh_spec s = {.dim = dim};
    for (int a = 0; a < dim; ++a) {
        s.lower[a] = -0.3;
        s.cell[a] = 0.1;
        s.upper[a] = -0.3 + 0.1 * cells[a];
        s.blocks[a] = blocks[a];
    }
    return s;
}

/* Every cell lies in one block and one tile; linear indices of a block's cells and ghosts are distinct and in range. */
static void check_cover(const mesh *m)
{
    int seen = 0;
    for (int b = 0; b < m->n_blocks; ++b) {
        const block *k = &m->block[b];
        int cell[3];
        for (cell[2] = k->lo[2]; cell[2] < k->lo[2] + k->n[2]; ++cell[2])
            for (cell[1] = k->lo[1]; cell[1] < k->lo[1] + k->n[1]; ++cell[1])
                for (cell[0] = k->lo[0]; cell[0] < k->lo[0] + k->n[0]; ++cell[0], ++seen) {
                    assert_int_equal(mesh_block_of(m, cell), b);
                    const int tile = mesh_tile_of(m, cell);
                    assert_in_range(tile, 0, m->tiles[0] * m->tiles[1] * m->tiles[2] - 1);
                }
        const int g[3] = {MESH_GHOST, m->dim > 1 ? MESH_GHOST : 0, m->dim > 2 ? MESH_GHOST : 0};
        assert_int_equal(mesh_index(k, -g[0], -g[1], -g[2]), 0);
        const int top[3] = {k->n[0] + MESH_GHOST, m->dim > 1 ? k->n[1] + MESH_GHOST : 0,
                            m->dim > 2 ? k->n[2] + MESH_GHOST : 0};
        assert_int_equal(mesh_index(k, top[0], top[1], top[2]), k->size - 1);
    }
    assert_int_equal(seen, mesh_cells(m));
}

static void test_cover(void **state)
{
    (void)state;
    context *ctx = context_create();
    const int sizes[][3] = {{1, 1, 1}, {8, 8, 8}, {9, 17, 5}, {64, 3, 4}, {130, 41, 13}};
    for (int dim = 1; dim <= 3; ++dim)
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s)
            for (int n = 1; n <= 3; ++n) {
                int blocks[3] = {1, 1, 1};
                for (int a = 0; a < dim; ++a) {
                    const int tiles = (sizes[s][a] + mesh_tile_width(dim) - 1) / mesh_tile_width(dim);
                    const int last = sizes[s][a] - (tiles - 1) * mesh_tile_width(dim);
                    blocks[a] = n < tiles || (n == tiles && (n == 1 || last >= 4)) ? n : 1;
                }
                mesh m;
                const mesh_spec spec = spec_of(dim, sizes[s], blocks);
                check_ok(ctx, mesh_init(&m, ctx, &spec));
                check_cover(&m);
            }
    context_destroy(&ctx);
}

static void test_cell_of(void **state)
{
    (void)state;
    context *ctx = context_create();
    mesh m;
    const mesh_spec spec = spec_of(1, (const int[]){30, 1, 1}, (const int[]){1, 1, 1});
    check_ok(ctx, mesh_init(&m, ctx, &spec));
    for (int i = 0; i < 30; ++i) assert_int_equal(mesh_cell_of(&m, 0, mesh_centre(&m, 0, i)), i);
    assert_int_equal(mesh_cell_of(&m, 0, m.upper[0]), 29); /* the upper wall belongs to the last cell */
    assert_int_equal(mesh_cell_of(&m, 0, m.lower[0]), 0);
    assert_int_equal(mesh_cell_of(&m, 0, m.lower[0] - 1e-12), -1);
    assert_true(mesh_cell_of(&m, 0, m.upper[0] + 1e-9) >= 30);
    assert_true(mesh_cell_of(&m, 0, (double)NAN) < 0);
    assert_true(mesh_cell_of(&m, 0, 1e300) >= 30);
    assert_true(mesh_cell_of(&m, 0, -1e300) < 0);
    check_close(mesh_node(&m, 0, 30), m.upper[0], 1e-15);
    context_destroy(&ctx);
}

static void test_axisymmetric(void **state)
{
    (void)state;
    context *ctx = context_create();
    mesh m;
    mesh_spec spec = {.dim = 2, .geometry = MESH_AXISYMMETRIC, .upper = {1.0, 2.0}, .cell = {0.1, 0.1}};
    check_ok(ctx, mesh_init(&m, ctx, &spec));
    double volume = 0.0;
    for (int i = 0; i < 10; ++i) volume += 20.0 * mesh_cell_volume(&m, i);
    check_close(volume, 0.5 * 2.0, 1e-14); /* per radian */
    check_close(mesh_face_area(&m, 0, 0), 0.0, 0.0);
    check_close(mesh_face_area(&m, 0, 10), 0.1, 1e-15);
    spec.lower[0] = -0.1;
    check_fails(ctx, mesh_init(&m, ctx, &spec), FLOE_BAD_INPUT);
    context_destroy(&ctx);
}

static void refuse(mesh_spec spec, const char *words)
{
    context *ctx = context_create();
    mesh m;
    assert_int_equal(mesh_init(&m, ctx, &spec), FLOE_BAD_INPUT);
    assert_non_null(strstr(context_message(ctx), words));
    context_destroy(&ctx);
}

static void test_refusals(void **state)
{
    (void)state;
    const mesh_spec good = {.dim = 2, .upper = {1.0, 1.0}, .cell = {0.1, 0.1}};
    mesh_spec s = good;
    s.cell[0] = 0.3;
    refuse(s, "not a whole number");
    s = good;
    s.cell[1] = 0.0;
    refuse(s, "m along y");
    s = good;
    s.cell[1] = (double)NAN;
    refuse(s, "m along y");
    s = good;
    s.upper[0] = -1.0;
    refuse(s, "upper must lie above lower");
    s = good;
    s.dim = 4;
    refuse(s, "domain.dim: 4");
    s = good;
    s.blocks[0] = 3;
    refuse(s, "3 blocks along x");
    s = good;
    s.upper[0] = 0.3;
    s.periodic[0] = true;
    refuse(s, "at least 4 cells");
    s = good;
    s.upper[0] = 1e12;
    refuse(s, "1e9");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cover),
        cmocka_unit_test(test_cell_of),
        cmocka_unit_test(test_axisymmetric),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
