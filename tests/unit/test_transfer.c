/* Between nodes and cells: what goes one way comes back the other with the same weights, at every kind of side, so that mass
 * and momentum are kept to round-off; a uniform velocity stays uniform; blocks do not show. */
#include "transfer_fixture.h"

/* Masses over ten decades, some none. */
static double mass_of(const mesh *m, const int node[3], int group)
{
    const double x = noise(m, node, group);
    return x < -0.8 ? 0.0 : pow(10.0, 5.0 * x);
}

static void set_node(void *user, const rig *r, const fields *f, const block *b, const int node[3], ptrdiff_t at)
{
    const double *uniform = user;
    (void)b;
    for (int g = 0; g < SOLIDS; ++g) {
        const double mass = in_domain(r, node) ? mass_of(&r->mesh, node, g) : 0.0;
        field_get(f, N_MASS, g, 0)[at] = mass;
        for (int a = 0; a < r->mesh.dim; ++a) {
            const double v = uniform ? uniform[a] : noise(&r->mesh, node, 10 + 3 * g + a);
            field_get(f, N_MOMENTUM, g, a)[at] = mass * v;
            field_get(f, N_VEL_L, g, a)[at] = uniform ? uniform[a] : noise(&r->mesh, node, 20 + 3 * g + a);
        }
    }
}

/* Sums over cells and over nodes, of what must agree, and of sizes. */
typedef struct sums {
    double mass[SOLIDS], momentum[SOLIDS][3], lagrangian[SOLIDS][3], size;
    double worst, uniform[3];
} sums;

static void sum_node(void *user, const rig *r, const fields *f, const block *b, const int node[3], ptrdiff_t at)
{
    sums *s = user;
    if (!counts(r, b, node)) return;
    for (int g = 0; g < SOLIDS; ++g) {
        const double mass = field_get(f, N_MASS, g, 0)[at];
        s->mass[g] += mass;
        s->size += mass;
        for (int a = 0; a < r->mesh.dim; ++a) {
            s->momentum[g][a] += field_get(f, N_MOMENTUM, g, a)[at];
            s->lagrangian[g][a] += mass * field_get(f, N_VEL_L, g, a)[at];
        }
    }
}

static void sum_cell(void *user, const rig *r, const fields *f, const block *b, const int cell[3], ptrdiff_t at)
{
    sums *s = user;
    (void)b;
    for (int p = 0; p < SOLIDS; ++p) {
        const transfer_pair *pair = &r->t.pair[p];
        const double mass = field_get(f, C_RHO, pair->material, 0)[at] * mesh_cell_volume(&r->mesh, cell[0]);
        s->mass[pair->group] += mass;
        if (!(field_get(f, C_TEMP, pair->material, 0)[at] == pair->temperature)) s->worst = NAN;
        for (int a = 0; a < r->mesh.dim; ++a) {
            const double u = field_get(f, C_VEL, pair->material, a)[at];
            s->momentum[pair->group][a] += mass * u;
            s->lagrangian[pair->group][a] += field_get(f, C_MOMENTUM_L, pair->material, a)[at];
            if (mass > 0.0) s->worst = !(fabs(u - s->uniform[a]) <= s->worst) ? fabs(u - s->uniform[a]) : s->worst;
        }
    }
}

static void to_cells(const rig_case *c)
{
    rig r;
    rig_make(&r, c);
    visit(&r, true, set_node, NULL);
    check_ok(r.ctx, transfer_nodes_to_cells(&r.t));
    check_ok(r.ctx, transfer_momentum_to_cells(&r.t));
    sums nodes = {.size = 0.0}, cells = {.size = 0.0};
    visit(&r, true, sum_node, &nodes);
    visit(&r, false, sum_cell, &cells);
    for (int g = 0; g < SOLIDS; ++g) {
        check_close(cells.mass[g], nodes.mass[g], 1e-14 * nodes.size);
        for (int a = 0; a < c->dim; ++a) {
            check_close(cells.momentum[g][a], nodes.momentum[g][a], 1e-14 * nodes.size);
            check_close(cells.lagrangian[g][a], nodes.lagrangian[g][a], 1e-14 * nodes.size);
        }
    }
    double velocity[3] = {3.0, -7.0, 0.3};
    visit(&r, true, set_node, velocity);
    check_ok(r.ctx, transfer_nodes_to_cells(&r.t));
    sums uniform = {.uniform = {3.0, -7.0, 0.3}};
    visit(&r, false, sum_cell, &uniform);
    check_true(uniform.worst <= 1e-14);
    rig_free(&r);
}

/* Cells with random changes; those of a mixed sign would hide a wrong weight less than those of one. */
static void set_change(void *user, const rig *r, const fields *f, const block *b, const int cell[3], ptrdiff_t at)
{
    const bool *one = user;
    (void)b;
    for (int m = 0; m < SOLIDS; ++m)
        for (int a = 0; a < r->mesh.dim; ++a)
            field_get(f, C_VELOCITY_CHANGE, m, a)[at] = *one ? 1.0 : noise(&r->mesh, cell, 40 + 3 * m + a);
}

static void clear_velocity(void *user, const rig *r, const fields *f, const block *b, const int node[3], ptrdiff_t at)
{
    (void)user, (void)b, (void)node;
    for (int g = 0; g < SOLIDS; ++g)
        for (int a = 0; a < r->mesh.dim; ++a) field_get(f, N_VEL_L, g, a)[at] = 0.0;
}

static void sum_change(void *user, const rig *r, const fields *f, const block *b, const int cell[3], ptrdiff_t at)
{
    sums *s = user;
    (void)b;
    for (int p = 0; p < SOLIDS; ++p) {
        const transfer_pair *pair = &r->t.pair[p];
        const double mass = field_get(f, C_RHO, pair->material, 0)[at] * mesh_cell_volume(&r->mesh, cell[0]);
        for (int a = 0; a < r->mesh.dim; ++a)
            s->lagrangian[pair->group][a] += mass * field_get(f, C_VELOCITY_CHANGE, pair->material, a)[at];
    }
}

/* The weights of every node with mass sum to one, ghosts that neighbours see included. */
static void check_weights(void *user, const rig *r, const fields *f, const block *b, const int node[3], ptrdiff_t at)
{
    (void)user, (void)b;
    for (int g = 0; g < SOLIDS && in_domain(r, node); ++g)
        for (int a = 0; a < r->mesh.dim; ++a)
            check_close(field_get(f, N_VEL_L, g, a)[at], field_get(f, N_MASS, g, 0)[at] > 0.0 ? 1.0 : 0.0, 0.0);
}

static void to_nodes(const rig_case *c)
{
    rig r;
    bool one = false;
    rig_make(&r, c);
    visit(&r, true, set_node, NULL);
    check_ok(r.ctx, transfer_nodes_to_cells(&r.t));
    visit(&r, false, set_change, &one);
    visit(&r, true, clear_velocity, NULL);
    check_ok(r.ctx, transfer_change_to_nodes(&r.t));
    sums nodes = {.size = 0.0}, cells = {.size = 0.0};
    visit(&r, true, sum_node, &nodes);
    visit(&r, false, sum_change, &cells);
    for (int g = 0; g < SOLIDS; ++g)
        for (int a = 0; a < c->dim; ++a)
            check_close(cells.lagrangian[g][a], nodes.lagrangian[g][a], 1e-14 * nodes.size);
    one = true;
    visit(&r, false, set_change, &one);
    visit(&r, true, clear_velocity, NULL);
    check_ok(r.ctx, transfer_change_to_nodes(&r.t));
    visit(&r, true, check_weights, NULL);
    rig_free(&r);
}

static double linear(const rig *r, const int at[3], double shift)
{
    double p = 1e5;
    for (int a = 0; a < r->mesh.dim; ++a)
        if (!r->mesh.periodic[a]) p += 1e4 * (a + 1) * (at[a] + shift);
    return p;
}

static void set_pressure(void *user, const rig *r, const fields *f, const block *b, const int cell[3], ptrdiff_t at)
{
    (void)user, (void)b;
    field_get(f, C_PRESSURE_ADVANCED, 0, 0)[at] = linear(r, cell, 0.5);
}

/* Gauge; linear pressures are exact inside, and on a side the mean of the cells there is. */
static void check_pressure(void *user, const rig *r, const fields *f, const block *b, const int node[3], ptrdiff_t at)
{
    (void)user;
    double expected = linear(r, node, 0.0) - 1e5;
    if (!counts(r, b, node)) return;
    for (int a = 0; a < r->mesh.dim; ++a) {
        if (r->mesh.periodic[a]) continue;
        if (node[a] == 0) expected += 0.5e4 * (a + 1);
        if (node[a] == r->mesh.n[a]) expected -= 0.5e4 * (a + 1);
    }
    check_close(field_get(f, N_PRESSURE, 0, 0)[at], expected, 1e-9);
}

static void pressures(const rig_case *c)
{
    rig r;
    rig_make(&r, c);
    visit(&r, false, set_pressure, NULL);
    check_ok(r.ctx, transfer_pressure_to_nodes(&r.t));
    visit(&r, true, check_pressure, NULL);
    rig_free(&r);
}

/* Every periodic or closed combination of sides, in one block and in 2, 2x2, 2x2x2. */
static void for_cases(void (*check)(const rig_case *))
{
    for (int dim = 1; dim <= 3; ++dim)
        for (unsigned periodic = 0; periodic < 1u << dim; ++periodic)
            for (int blocks = 1; blocks <= 2; ++blocks) {
                check(&(const rig_case){dim, blocks, periodic, MESH_CARTESIAN});
                if (dim == 2 && !(periodic & 1u)) check(&(const rig_case){dim, blocks, periodic, MESH_AXISYMMETRIC});
            }
}

static void test_to_cells(void **state)
{
    (void)state;
    for_cases(to_cells);
}

static void test_to_nodes(void **state)
{
    (void)state;
    for_cases(to_nodes);
}

static void test_pressures(void **state)
{
    (void)state;
    for_cases(pressures);
}

/* The bits of a cell or node, wherever it lies: one block against many. */
typedef struct copy_job {
    double *out;
    const field_id *ids;
    int n_ids;
} copy_job;

enum { WORDS = 32, PLACES = 2000 };

static void copy_place(void *user, const rig *r, const fields *f, const block *b, const int global[3], ptrdiff_t at)
{
    const copy_job *job = user;
    int word = 0;
    for (int a = 0; a < r->mesh.dim; ++a)
        if (global[a] < b->lo[a] || global[a] >= b->lo[a] + b->n[a]) return;
    const int row = global[0] + r->mesh.n[0] * (global[1] + r->mesh.n[1] * global[2]);
    assert_in_range(row, 0, PLACES - 1);
    for (int k = 0; k < job->n_ids; ++k)
        for (int i = 0; i < SOLIDS; ++i)
            for (int c = 0; fields_has(f, job->ids[k], i) && c < FIELD_MAX_COMPONENTS; ++c)
                if (field_get(f, job->ids[k], i, c)) {
                    assert_true(word < WORDS);
                    job->out[row * WORDS + word++] = field_get(f, job->ids[k], i, c)[at];
                }
}

static void test_blocks(void **state)
{
    (void)state;
    static const field_id ids[] = {C_RHO, C_VEL, C_MOMENTUM_L, N_PRESSURE, N_VEL_L};
    static double bits[2][PLACES * WORDS];
    bool one = false;
    for (int dim = 1; dim <= 3; ++dim)
        for (unsigned periodic = 0; periodic < 1u << dim; ++periodic) {
            memset(bits, 0, sizeof bits);
            for (int blocks = 1; blocks <= 2; ++blocks) {
                rig r;
                rig_make(&r, &(const rig_case){dim, blocks, periodic, MESH_CARTESIAN});
                visit(&r, true, set_node, NULL);
                visit(&r, false, set_pressure, NULL);
                visit(&r, false, set_change, &one);
                check_ok(r.ctx, transfer_nodes_to_cells(&r.t));
                check_ok(r.ctx, transfer_pressure_to_nodes(&r.t));
                check_ok(r.ctx, transfer_momentum_to_cells(&r.t));
                check_ok(r.ctx, transfer_change_to_nodes(&r.t));
                copy_job job = {bits[blocks - 1], ids, (int)(sizeof ids / sizeof *ids)};
                visit(&r, true, copy_place, &job);
                rig_free(&r);
            }
            assert_memory_equal(bits[0], bits[1], sizeof bits[0]);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_to_cells),
        cmocka_unit_test(test_to_nodes),
        cmocka_unit_test(test_pressures),
        cmocka_unit_test(test_blocks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
