/* The order of points: by tile, then cell, then id, from any order; tiles know their ranges; the fields of a point stay together. */
#include "verification/mpm_fixture.h"

#include "mpm/mpm.h"

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

/* Beyond a periodic end a point comes back by the period, beyond a wall onto it, and beyond an open side it is lost with what it had. */
static void test_beyond(void **state)
{
    (void)state;
    trial t;
    const double upper[3] = {0.75, 0.5, 0.25}, lower[3] = {-0.5, 0.125, -1.0}, all[3] = {1.0, 1.0, 1.0};
    trial_begin(&t, 3, upper, 0.125);
    for (int a = 0; a < 3; ++a) t.scene->mesh.lower[a] = lower[a];
    set_sides(&t, 0, BC_PERIODIC, BC_PERIODIC);
    set_sides(&t, 1, BC_SLIP, BC_NO_SLIP);
    set_sides(&t, 2, BC_OUTLET, BC_FREE);
    add_body(&t, add_solid(&t, "linear_elastic", 3.0, 1.0, 1.0), make_box(&t, lower, all), 1);
    trial_start(&t);
    const fields *f = t.sim->domain->fields[0];
    const size_t n = mpm_count(t.sim->mpm);
    double *x[3], *mass = field_get(f, P_MASS, 0, 0), wanted[64][3], lost = 0.0;
    size_t left = 0;
    assert_int_equal(n, 10 * 3 * 10);
    for (int a = 0; a < 3; ++a) x[a] = field_get(f, P_POS, 0, a);
    for (size_t k = 0; k < 64; ++k) { /* inside, below and above, along each axis */
        const double share[3] = {0.0, -0.375, 0.25};
        for (int a = 0; a < 3; ++a) {
            const int kind = (int)(a == 0 ? k : a == 1 ? k / 3 : k / 9) % 3;
            const double inside = 0.5 * (lower[a] + upper[a]), end = kind == 1 ? lower[a] : upper[a];
            x[a][k] = kind == 0 ? inside : end + share[kind] * (upper[a] - lower[a]);
            wanted[k][a] = kind == 0 || a == 2 ? x[a][k] : a == 1 ? end : x[a][k] + (kind == 1 ? 1.25 : -1.25);
        }
        left += k / 9 % 3 > 0;
        lost += k / 9 % 3 > 0 ? mass[k] : 0.0;
        field_get(f, P_ID, 0, 0)[k] = (double)k;
    }
    for (size_t k = 64; k < n; ++k) field_get(f, P_ID, 0, 0)[k] = (double)k;
    const mesh *m = &t.sim->mesh;
    for (int k = 0; k < m->tiles[0] * m->tiles[1] * m->tiles[2]; ++k) t.sim->mpm->moved[k] = 1;
    check_ok(t.ctx, mpm_commit(t.sim->mpm));
    assert_int_equal(mpm_count(t.sim->mpm), n - left);
    assert_int_equal(t.sim->ledger.pending_count[COUNT_POINTS_LOST], left);
    check_close(t.sim->ledger.pending[LEDGER_MASS][LEDGER_BOUNDARY], -lost, 1e-15);
    int seen = 0;
    for (size_t k = 0; k < n - left; ++k) {
        const size_t id = (size_t)field_get(f, P_ID, 0, 0)[k];
        if (id >= 64) continue;
        for (int a = 0; a < 3; ++a) check_close(field_get(f, P_POS, 0, a)[k], wanted[id][a], 0.0);
        seen++;
    }
    assert_int_equal(seen, 64 - left);
    trial_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_order), cmocka_unit_test(test_beyond)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
