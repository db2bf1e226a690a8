/* What the cells begin with: which materials they have, and which fluid lies nearest to a cell inside a solid. */
#include "verification/coupled_fixture.h"

#include "ice/start/ice_start.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_state.h"

/* A material is used that a body, the ambient, a reaction or an open side is of, and no other: the list of bodies ends where it ends. */
static void test_used(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    scene *s;
    bool used[4];
    check_ok(ctx, scene_create(&s, ctx));
    s->mesh.dim = 1;
    s->n_materials = 4;
    for (int r = 0; r < 4; ++r) s->material[r].kind = r == 2 ? MATERIAL_SOLID : MATERIAL_FLUID;
    for (int with_points = 0; with_points < 2; ++with_points)
        for (int ambient = -1; ambient < 4; ++ambient) {
            s->n_bodies = 2;
            s->body[0].material = 2;
            s->body[1].material = 3;
            s->has_ambient = ambient >= 0 && ambient != 2;
            s->ambient_material = s->has_ambient ? ambient : 0;
            for (int r = 0; r < 4; ++r) used[r] = false;
            ice_find_used(s, with_points, used);
            for (int r = 0; r < 4; ++r)
                assert_int_equal(used[r], r == 3 || (r == 2 && with_points) || (s->has_ambient && r == ambient));
        }
    scene_destroy(&s);
    context_destroy(&ctx);
}

static double square_distance(const mesh *m, int first, int second)
{
    double sum = 0.0;
    for (int a = 0, row = 1; a < m->dim; row *= m->n[a++]) {
        int steps = abs(first / row % m->n[a] - second / row % m->n[a]);
        if (m->periodic[a] && 2 * steps > m->n[a]) steps = m->n[a] - steps;
        sum += steps * steps * m->h[a] * m->h[a];
    }
    return sum;
}

/* Against all cells, one by one: a cell that no solid covers is its own nearest. In micrometres as in metres. */
static void test_nearest(void **unused)
{
    (void)unused;
    for (int dim = 1; dim <= 3; ++dim)
        for (int periodic = 0; periodic < 2; ++periodic) {
            trial t;
            const double unit = dim == 2 ? 1e-6 : 1.0; /* m */
            const double size[3] = {unit, 0.8 * unit, 0.6 * unit}, centre[3] = {0.1 * unit, 0.5 * unit, 0.3 * unit};
            coupled_begin(&t, dim, size, unit * (dim == 3 ? 0.1 : 0.04));
            if (dim > 1) t.scene->mesh.cell[1] *= 2.0;
            if (periodic) set_sides(&t, 0, BC_PERIODIC, BC_PERIODIC);
            t.scene->coupling = COUPLING_ICE_MPM;
            t.scene->method.interface = INTERFACE_SMEARED;
            coupled_body(&t, coupled_solid(&t, 2e7, 1e7, 1000.0), make_ball(&t, centre, 0.27 * unit), 2);
            coupled_start(&t);
            const mesh *m = &t.sim->mesh;
            int *nearest, covered = 0;
            check_ok(t.ctx, ice_nearest_find(t.sim->ice, &nearest));
            const int cells = (int)mesh_cells(m);
            for (int k = 0; k < cells; ++k) {
                double away = 0.0;
                for (int a = 0, row = 1; a < dim; row *= m->n[a++])
                    away += pow(mesh_centre(m, a, k / row % m->n[a]) - centre[a], 2.0);
                if (away > 0.27 * 0.27 * unit * unit) {
                    assert_int_equal(nearest[k], k);
                    continue;
                }
                covered++;
                double best = INFINITY;
                for (int n = 0; n < cells; ++n)
                    if (nearest[n] == n) best = fmin(best, square_distance(m, k, n));
                check_close_relative(square_distance(m, k, nearest[k]), best, 1e-12);
                assert_int_equal(nearest[nearest[k]], nearest[k]);
            }
            check_true(covered > 2);
            memory_free(t.ctx, &nearest);
            trial_end(&t);
        }
}

/* Places of cells and of their sides, in blocks. */
static void test_places(void **unused)
{
    (void)unused;
    trial t;
    coupled_begin(&t, 2, (const double[3]){1.6, 0.8, 0.0}, 0.05);
    for (int a = 0; a < 2; ++a) t.scene->mesh.blocks[a] = 2;
    t.scene->mesh.lower[0] = -0.8;
    t.scene->coupling = COUPLING_ICE;
    coupled_body(&t, t.scene->ambient_material, make_ball(&t, (const double[3]){0.0, 0.4, 0.0}, 0.1), 2)->pressure =
        COUPLED_PRESSURE;
    coupled_start(&t);
    const mesh *m = &t.sim->mesh;
    assert_int_equal(m->n_blocks, 4);
    for (int id = 0; id < m->n_blocks; ++id) {
        const block *b = &m->block[id];
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i) {
                double x[3], side[3];
                int cell[3];
                ice_cell_of(b, mesh_index(b, i, j, 0), cell);
                assert_int_equal(cell[0], i);
                assert_int_equal(cell[1], j);
                ice_place_of(t.sim->ice, b, cell, x);
                check_close(x[0], -0.8 + 0.05 * (b->lo[0] + i + 0.5), 1e-14);
                check_close(x[1], 0.05 * (b->lo[1] + j + 0.5), 1e-14);
                check_true(x[2] == 0.0);
                for (int axis = 0; axis < 2; ++axis)
                    for (int upper = 0; upper < 2; ++upper) {
                        ice_side_place(t.sim->ice, b, axis, upper, cell, side);
                        check_close(side[axis], x[axis] + (upper - 0.5) * 0.05, 1e-14);
                        check_true(side[1 - axis] == x[1 - axis]);
                    }
            }
    }
    trial_end(&t);
}

/* Two fluids side by side on whole cells: where one is not, it has no mass, volume, energy or velocity, and what is there has its own. */
static void test_absent(void **unused)
{
    (void)unused;
    trial t;
    coupled_begin(&t, 1, (const double[3]){1.0, 0.0, 0.0}, 0.1);
    set_sides(&t, 0, BC_PERIODIC, BC_PERIODIC);
    t.scene->coupling = COUPLING_ICE;
    scene_body *b = coupled_body(&t, add_gas(&t, 1.6, 500.0),
                                 make_box(&t, (const double[3]){0.3, 0.0, 0.0}, (const double[3]){0.7, 1.0, 1.0}), 2);
    b->pressure = COUPLED_PRESSURE;
    b->velocity[0] = 3.0;
    coupled_start(&t);
    const fields *f = t.sim->domain->fields[0];
    for (int i = 0; i < 10; ++i)
        for (int r = 0; r < 2; ++r) {
            const ptrdiff_t at = mesh_index(&t.sim->mesh.block[0], i, 0, 0);
            const bool here = (i >= 3 && i < 7) == (r == 1);
            assert_int_equal(field_get(f, C_RHO, r, 0)[at] > 0.0, here);
            check_close(field_get(f, C_VEL, r, 0)[at], here && r == 1 ? 3.0 : 0.0, here ? 1e-14 : 0.0);
            check_close_relative(field_get(f, C_ENERGY, r, 0)[at],
                                 here ? (r ? 500.0 : 717.5) * COUPLED_TEMPERATURE : 0.0, 1e-12);
            assert_int_equal(field_get(f, C_VOL, r, 0)[at] > 0.0, here);
        }
    trial_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_used), cmocka_unit_test(test_nearest),
                                       cmocka_unit_test(test_absent), cmocka_unit_test(test_places)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
