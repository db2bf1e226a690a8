/* Surfaces of solids beside gas of the cells: which fluid each part of one faces, and which of its ends stay on a side of the mesh. */
#include "verification/coupled_fixture.h"

#include "mpm/surface/boundary.h"
#include "mpm/surface/surfaces.h"

static const double inner = 0.35, outer = 0.63;

/* A shell about the corner of a box, whose sides through that corner are mirrors; lengths in units. */
static void make_shell(trial *t, int dim, double h, double unit)
{
    const double size = 0.8 * unit;
    coupled_begin(t, dim, (const double[3]){size, size, size}, h * unit);
    for (int a = 0; a < dim; ++a) set_sides(t, a, BC_SYMMETRY, BC_SLIP);
    t->scene->method.interface = INTERFACE_SHARP;
    coupled_body(t, coupled_solid(t, 1e7, 6e6, 1000.0), make_ring(t, inner * unit, outer * unit), 2);
}

/* One gas about the shell, and another, a body that comes after it, inside: a part of the surface faces the one that it touches, however small the scene. */
static void test_facing(void **unused)
{
    (void)unused;
    for (int dim = 2; dim <= 3; ++dim)
        for (double unit = 1.0; unit > 1e-4; unit *= 1e-3) {
            trial t;
            mesh m;
            int n[3];
            make_shell(&t, dim, 0.1, unit);
            const int gas[2] = {t.scene->ambient_material, add_gas(&t, 1.6, 500.0)};
            coupled_body(&t, gas[1], make_ball(&t, (const double[3]){0.0, 0.0, 0.0}, inner * unit), 2);
            check_ok(t.ctx, mesh_init(&m, t.ctx, &t.scene->mesh));
            for (int k = 0; k < 3; ++k) {
                cut_surface c;
                check_ok(t.ctx, cut_create(&c, t.ctx, &m));
                check_ok(t.ctx, mpm_boundary_add(t.scene, &m, &t.scene->body[0], k < 2 ? gas[k] : -1, &c));
                n[k] = dim == 2 ? c.n_chains : c.n_triangles;
                for (int part = 0; k < 2 && part < n[k]; ++part) {
                    const double *x = c.vertex[dim == 2 ? c.chain[part].first : c.triangle[part].vertex[0]].x;
                    check_close_relative(sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), (k ? inner : outer) * unit,
                                         0.01);
                }
                cut_destroy(&c);
            }
            check_true(n[0] > 0 && n[1] > 0);
            assert_int_equal(n[0] + n[1], n[2]);
            trial_end(&t);
        }
}

/* Markers on a mirror, where the surface ends, stay on it: no others do. */
static void test_pins(void **unused)
{
    (void)unused;
    for (int k = 0; k < 4; ++k) {
        trial t;
        const int dim = 2 + k / 2;
        const double corner = k % 2 ? 0.8 : 0.0;
        make_shell(&t, dim, 0.1, 1.0);
        for (int a = 0; a < dim; ++a) {
            set_sides(&t, a, BC_SYMMETRY, BC_SYMMETRY);
            shape_number(&t.scene->body[0].shape, "centre", a, corner);
        }
        coupled_start(&t);
        const double *end = k % 2 ? t.sim->mesh.upper : t.sim->mesh.lower;
        const surface_markers *m = &t.sim->mpm->surfaces->markers;
        int pinned = 0;
        for (size_t i = 0; i < m->n; ++i) {
            int wanted = 0;
            for (int a = 0; a < dim; ++a) wanted |= m->now[i].x[a] == end[a] ? 1 << a : 0;
            assert_int_equal(m->pin[i], wanted);
            pinned += wanted > 0;
        }
        check_true(pinned >= (dim == 2 ? 4 : 30) && pinned < (int)m->n);
        trial_end(&t);
    }
}

/* Gas at rest about the shell, cut cells included, has one density and energy; what one puts into closed cells lies beyond, in any block. */
static void test_gas_beside(void **unused)
{
    (void)unused;
    for (int blocks = 1; blocks <= 2; ++blocks) {
        trial t;
        double beyond = 0.0;
        int cut = 0;
        make_shell(&t, 2, 0.05, 1.0);
        for (int a = 0; a < 2; ++a) t.scene->mesh.blocks[a] = blocks;
        coupled_start(&t);
        for (int id = 0; id < t.sim->mesh.n_blocks; ++id) {
            const block *b = &t.sim->mesh.block[id];
            const fields *f = t.sim->domain->fields[id];
            for (int k = 0; k < b->n[0] * b->n[1]; ++k) {
                const ptrdiff_t at = mesh_index(b, k % b->n[0], k / b->n[0], 0);
                const double open = field_get(f, C_OPEN, 0, 0)[at];
                double *rho = &field_get(f, C_RHO, 0, 0)[at];
                cut += open > 0.0 && open < 1.0;
                if (open > 0.0) {
                    check_close_relative(*rho, COUPLED_PRESSURE / (0.4 * 717.5 * COUPLED_TEMPERATURE), 1e-12);
                    check_close_relative(field_get(f, C_ENERGY, 0, 0)[at], 717.5 * COUPLED_TEMPERATURE, 1e-12);
                } else {
                    *rho = 2.0 + id;
                    beyond += *rho * 0.0025;
                }
            }
        }
        check_true(cut > 8 && beyond > 0.1);
        check_close_relative(ice_mass_beyond(t.sim->ice, 0), beyond, 1e-12);
        trial_end(&t);
    }
}

/* The force on a body is the sum of what its markers take. */
static void test_force(void **unused)
{
    (void)unused;
    for (int dim = 2; dim <= 3; ++dim) {
        trial t;
        uint64_t seed = 6;
        double sum[3] = {0.0}, found[3] = {7.0, 7.0, 7.0};
        make_shell(&t, dim, 0.1, 1.0);
        coupled_start(&t);
        surface_markers *m = &t.sim->mpm->surfaces->markers;
        for (size_t i = 0; i < 3 * m->n; ++i) sum[i % 3] += m->force[i] = check_random(&seed, -1.0, 2.0);
        check_true(mpm_boundary_sum_force(t.sim->mpm, 0, found));
        for (int a = 0; a < 3; ++a) check_close(found[a], sum[a], 0.0);
        mpm_boundary_clear(t.sim->mpm);
        check_true(mpm_boundary_sum_force(t.sim->mpm, 0, found));
        for (int a = 0; a < 3; ++a) check_close(found[a], 0.0, 0.0);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_facing), cmocka_unit_test(test_pins),
                                       cmocka_unit_test(test_gas_beside), cmocka_unit_test(test_force)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
