/* Domains that deform with their points (CPDI): blocks that are turned, stretched and sheared stay tiled, so that a uniform stress pushes
 * no node inside, to round-off, where domains that stay boxes (GIMP) overlap and gape. */
#include "math/tensor.h" /* before a type takes the name of one of its variables */

#include "mpm_fixture.h"

typedef struct affine {
    const char *name;
    int dim;
    double F[9];
    double gimp; /* least error of GIMP's boxes, of the stress times a face */
} affine;

static const double middle[3] = {2.0, 2.0, 2.0};

/* The reference place that a place comes from. */
static void reference_of(const affine *m, const double x[3], double X[3])
{
    double inverse[9], r[3];
    (void)tensor_inverse(m->F, inverse);
    for (int a = 0; a < 3; ++a) r[a] = x[a] - middle[a];
    tensor_apply(inverse, r, X);
}

static void move_point(void *user, const fields *f, int body, size_t k)
{
    static const int slot[3][9] = {{0, 4, 8}, {0, 1, 3, 4, 8}, {0, 1, 2, 3, 4, 5, 6, 7, 8}};
    const affine *m = user;
    double X[3] = {0.0}, x[3];
    for (int a = 0; a < m->dim; ++a) X[a] = field_get(f, P_POS, body, a)[k] - middle[a];
    tensor_apply(m->F, X, x);
    for (int a = 0; a < m->dim; ++a) {
        field_get(f, P_POS, body, a)[k] = middle[a] + x[a];
        field_get(f, P_STRESS, body, a)[k] = 1.0;
    }
    field_get(f, P_J, body, 0)[k] = tensor_det(m->F);
    for (int c = 0; fields_has(f, P_F, body) && c < field_component_count(FIELD_DEFORM, m->dim); ++c)
        field_get(f, P_F, body, c)[k] = m->F[slot[m->dim - 1][c]];
}

static const double h = 0.1, block_half = 0.5;

/* A node all of whose points are inside: two cells about it come from inside the block. */
static bool is_inside(const affine *m, const double x[3])
{
    for (int corner = 0; corner < 1 << m->dim; ++corner) {
        double at[3] = {middle[0], middle[1], middle[2]}, X[3];
        for (int a = 0; a < m->dim; ++a) at[a] = x[a] + ((corner >> a) & 1 ? 2.0 : -2.0) * h;
        reference_of(m, at, X);
        for (int a = 0; a < m->dim; ++a)
            if (fabs(X[a]) > block_half) return false;
    }
    return true;
}

/* Largest force at nodes inside, over stress times face. */
static double force_inside(const affine *m, const char *basis)
{
    trial t;
    const double size[3] = {4.0, 4.0, 4.0};
    double lo[3] = {0.0}, hi[3] = {0.0}, worst = 0.0;
    for (int a = 0; a < m->dim; ++a) {
        lo[a] = middle[a] - block_half;
        hi[a] = middle[a] + block_half;
    }
    trial_begin(&t, m->dim, size, h);
    set_method(&t, basis, STRESS_USL, 1.0);
    scene_body *body = add_body(&t, add_solid(&t, "linear_elastic", 3.0, 1.0, 1.0), make_box(&t, lo, hi), 2);
    body->per_cell[0] = 4;
    trial_start(&t);
    affine copy = *m;
    visit_points(&t, 0, move_point, &copy);
    check_ok(t.ctx, mpm_resort(t.sim->mpm));
    t.sim->mpm->dt = 1e-3;
    check_ok(t.ctx, mpm_begin_step(t.sim->mpm));
    check_ok(t.ctx, mpm_points_to_nodes(t.sim->mpm));
    const mesh *grid = &t.sim->mesh;
    int inside = 0;
    for (int k = 0; k < grid->n[2]; ++k)
        for (int j = 0; j < grid->n[1]; ++j)
            for (int i = 0; i < grid->n[0]; ++i) {
                const double x[3] = {mesh_node(grid, 0, i), mesh_node(grid, 1, j), mesh_node(grid, 2, k)};
                if (!is_inside(m, x)) continue;
                inside++;
                for (int a = 0; a < m->dim; ++a)
                    worst = fmax(worst, fabs(field_get(t.sim->domain->fields[0], N_FORCE, 0,
                                                       a)[mesh_index(&grid->block[0], i, j, k)]));
            }
    assert_true(inside > 3);
    trial_end(&t);
    return worst / pow(h, m->dim - 1);
}

#define C30 0.86602540378443865
static const affine maps[] = {
    {"stretched 3 times", 1, {3.0, 0, 0, 0, 1, 0, 0, 0, 1}, 0.05},
    {"turned by 30 degrees", 2, {C30, -0.5, 0, 0.5, C30, 0, 0, 0, 1}, 0.01},
    {"turned by 90 degrees", 2, {0, -1, 0, 1, 0, 0, 0, 0, 1}, 0.0},
    {"stretched 3 times", 2, {3, 0, 0, 0, 1, 0, 0, 0, 1}, 0.05},
    {"stretched and turned", 2, {2 * C30, -0.6, 0, 1.0, 1.2 * C30, 0, 0, 0, 1}, 0.05},
    {"sheared by 1 across its rows", 2, {1, 0, 0, 1, 1, 0, 0, 0, 1}, 0.0},
    {"stretched, sheared and turned", 3, {2 * C30, -0.6, 0.3, 1.0, 1.2 * C30, 0, 0.1, 0, 1.5}, 0.05},
};

static void test_uniform_stress(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof maps / sizeof *maps; ++k) {
        const double cpdi = force_inside(&maps[k], "cpdi"), gimp = force_inside(&maps[k], "gimp");
        print_message("%d-D, %s: cpdi %.1e, gimp %.1e\n", maps[k].dim, maps[k].name, cpdi, gimp);
        check_true(cpdi <= 2e-13); /* sums of some hundred terms of order one */
        check_true(gimp >= maps[k].gimp);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniform_stress),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
