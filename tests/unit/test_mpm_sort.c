/* The order of points: by tile, then cell, then id, from any order; tiles know their ranges; the fields of a point stay together. */
#include "verification/mpm_fixture.h"

static int cell_in_tile(const mesh *m, const int cell[3])
{
    int number = 0, row = 1;
    for (int a = 0; a < m->dim; ++a) {
        number += row * (cell[a] % m->tile[a]);
        row *= m->tile[a];
    }
    return number;
}

/* Tile, cell and id of every point ascend, and each point lies in the range of its tile. */
static void check_order(const trial *t)
{
    const mesh *m = &t->sim->mesh;
    for (int b = 0; b < m->n_blocks; ++b) {
        const fields *f = t->sim->domain->fields[b];
        const mpm_points *p = &t->sim->mpm->points[b][0];
        size_t k = 0;
        for (int tile = 0; tile < m->block[b].n_tiles; ++tile) {
            assert_int_equal(p->tile_start[tile], k);
            int last_cell = -1, number = -1;
            double last_id = -1.0;
            for (; k < p->tile_start[tile + 1]; ++k) {
                int cell[3] = {0, 0, 0};
                for (int a = 0; a < m->dim; ++a) cell[a] = mesh_cell_of(m, a, field_get(f, P_POS, 0, a)[k]);
                assert_int_equal(mesh_block_of(m, cell), b);
                if (number < 0) number = mesh_tile_of(m, cell);
                assert_int_equal(mesh_tile_of(m, cell), number);
                const int in_tile = cell_in_tile(m, cell);
                const double id = field_get(f, P_ID, 0, 0)[k];
                assert_true(in_tile > last_cell || (in_tile == last_cell && id > last_id));
                last_cell = in_tile;
                last_id = id;
                check_close(field_get(f, P_VEL, 0, 0)[k], 0.25 * id, 0.0); /* fields move together */
            }
        }
        assert_int_equal(k, p->n);
    }
}

static void test_order(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; ++dim) {
        trial t;
        const double size[3] = {1.0, 1.0, 1.0}, lo[3] = {0.0, 0.0, 0.0}, hi[3] = {1.0, 1.0, 1.0};
        trial_begin(&t, dim, size, dim == 1 ? 1.0 / 200 : dim == 2 ? 1.0 / 20 : 1.0 / 10);
        add_body(&t, add_solid(&t, "linear_elastic", 3.0, 1.0, 1.0), make_box(&t, lo, hi), 2);
        trial_start(&t);
        uint64_t seed = 5;
        const fields *f = t.sim->domain->fields[0];
        const size_t n = mpm_count(t.sim->mpm);
        for (int pass = 0; pass < 3; ++pass) {
            for (size_t k = 0; k < n; ++k) {
                field_get(f, P_VEL, 0, 0)[k] = 0.25 * field_get(f, P_ID, 0, 0)[k];
                for (int a = 0; a < dim; ++a) field_get(f, P_POS, 0, a)[k] = check_random(&seed, 0.0, 1.0);
            }
            check_ok(t.ctx, mpm_resort(t.sim->mpm));
            assert_int_equal(mpm_count(t.sim->mpm), n);
            check_order(&t);
        }
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
