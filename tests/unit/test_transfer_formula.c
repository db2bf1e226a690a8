/* Every transfer between nodes and cells against its own formula (coupling/node_cell_transfer.h), summed cell by cell and node by node with the weights
 * 2^-d, twice that for each side that a node lies on. Values of fields are random numbers that hang on the place alone, so that they are known twice. */
#include "transfer_fixture.h"

enum {
    MASS = 1,
    VELOCITY,
    LAGRANGIAN,
    HEAT,
    BURNT,
    BURNT_ENERGY,
    BURNT_MOMENTUM,
    CHANGE,
    WARMER,
    CAPACITY,
    PRESSURE,
    REACTED,
    BEFORE
};

static const double share_most = 0.5; /* of its solid a cell loses at most in a step */

static double number(const rig *r, const int at[3], int what, int which, int component)
{
    return noise(&r->mesh, at, 1000 * what + 10 * which + component);
}

static double node_mass(const rig *r, const int node[3], int group)
{
    const double x = number(r, node, MASS, group, 0);
    return !in_domain(r, node) || x < -0.6 ? 0.0 : 1.0 + x;
}

static double weight_of(const rig *r, const int node[3])
{
    double w = 1.0;
    for (int a = 0; a < r->mesh.dim; ++a)
        w *= !r->mesh.periodic[a] && (node[a] == 0 || node[a] == r->mesh.n[a]) ? 1.0 : 0.5;
    return w;
}

/* What is summed over the nodes of a cell. */
typedef double node_value(const rig *r, const int node[3], int group, int component);

static double sum_nodes(const rig *r, const int cell[3], node_value *value, int group, int component)
{
    double sum = 0.0;
    for (int k = 0; k < 1 << r->mesh.dim; ++k) {
        const int node[3] = {cell[0] + (k & 1), cell[1] + (k >> 1 & 1), cell[2] + (k >> 2 & 1)};
        sum += weight_of(r, node) * value(r, node, group, component);
    }
    return sum;
}

typedef double cell_value(const rig *r, const int cell[3], int which, int component);

static double sum_cells(const rig *r, const int node[3], cell_value *value, int which, int component)
{
    double sum = 0.0;
    for (int k = 0; k < 1 << r->mesh.dim; ++k) {
        const int cell[3] = {node[0] - (k & 1), node[1] - (k >> 1 & 1), node[2] - (k >> 2 & 1)};
        bool there = true;
        for (int a = 0; a < r->mesh.dim; ++a)
            there = there && (r->mesh.periodic[a] || (cell[a] >= 0 && cell[a] < r->mesh.n[a]));
        if (there) sum += weight_of(r, node) * value(r, cell, which, component);
    }
    return sum;
}

static double mass_value(const rig *r, const int node[3], int group, int component)
{
    (void)component;
    return node_mass(r, node, group);
}

static double momentum_value(const rig *r, const int node[3], int group, int component)
{
    return node_mass(r, node, group) * number(r, node, VELOCITY, group, component);
}

static double lagrangian_value(const rig *r, const int node[3], int group, int component)
{
    return node_mass(r, node, group) * number(r, node, LAGRANGIAN, group, component);
}

static double heat_value(const rig *r, const int node[3], int group, int component)
{
    return node_mass(r, node, group) * (400.0 + number(r, node, HEAT, group, component));
}

static double burnt_value(const rig *r, const int node[3], int group, int component)
{
    return number(r, node, BURNT, group, component);
}

static double burnt_energy_value(const rig *r, const int node[3], int group, int component)
{
    return number(r, node, BURNT_ENERGY, group, component);
}

static double burnt_momentum_value(const rig *r, const int node[3], int group, int component)
{
    return number(r, node, BURNT_MOMENTUM, group, component);
}

static double change_value(const rig *r, const int cell[3], int material, int component)
{
    return number(r, cell, CHANGE, material, component);
}

static double warmer_value(const rig *r, const int cell[3], int material, int component)
{
    return number(r, cell, WARMER, material, component);
}

static double pressure_value(const rig *r, const int cell[3], int unused, int component)
{
    return 1e5 + number(r, cell, PRESSURE, unused, component);
}

static double cell_density(const rig *r, const int cell[3], int group)
{
    return sum_nodes(r, cell, mass_value, group, 0) / mesh_cell_volume(&r->mesh, cell[0]);
}

/* Of the solid of a reaction, which is the first. */
static double share_value(const rig *r, const int cell[3], int group, int component)
{
    const double reacted = number(r, cell, REACTED, 0, component), rho = cell_density(r, cell, group);
    return reacted > 0.0 ? fmin(reacted / rho, share_most) : 0.0;
}

static void set_nodes(void *user, const rig *r, const fields *f, const block *b, const int node[3], ptrdiff_t at)
{
    (void)user, (void)b;
    for (int g = 0; g < SOLIDS; ++g) {
        field_get(f, N_MASS, g, 0)[at] = node_mass(r, node, g);
        field_get(f, N_HEAT, g, 0)[at] = heat_value(r, node, g, 0);
        field_get(f, N_CAPACITY, g, 0)[at] = number(r, node, CAPACITY, g, 0) > 0.0 ? 2.0 : 0.0;
        field_get(f, N_TEMP_CHANGE, g, 0)[at] = 0.25;
        field_get(f, N_BURNT, g, 0)[at] = burnt_value(r, node, g, 0);
        field_get(f, N_BURNT_ENERGY, g, 0)[at] = burnt_energy_value(r, node, g, 0);
        for (int a = 0; a < r->mesh.dim; ++a) {
            field_get(f, N_MOMENTUM, g, a)[at] = momentum_value(r, node, g, a);
            field_get(f, N_VEL_L, g, a)[at] = number(r, node, LAGRANGIAN, g, a);
            field_get(f, N_BURNT_MOMENTUM, g, a)[at] = burnt_momentum_value(r, node, g, a);
        }
    }
}

static void set_cells(void *user, const rig *r, const fields *f, const block *b, const int cell[3], ptrdiff_t at)
{
    (void)user, (void)b;
    field_get(f, C_PRESSURE_ADVANCED, 0, 0)[at] = pressure_value(r, cell, 0, 0);
    field_get(f, C_REACTED, 0, 0)[at] = number(r, cell, REACTED, 0, 0);
    for (int m = 0; m < SOLIDS; ++m) {
        field_get(f, C_TEMP_CHANGE, m, 0)[at] = warmer_value(r, cell, m, 0);
        for (int a = 0; a < r->mesh.dim; ++a) {
            field_get(f, C_VELOCITY_CHANGE, m, a)[at] = change_value(r, cell, m, a);
            field_next(f, C_STRESS_ACCEL, m, a)[at] = number(r, cell, BEFORE, m, a);
        }
    }
}

/* Round-off of a sum of eight numbers of such a size. */
static void check_number(double found, double expected, double size)
{
    check_close(found, expected, 4e-15 * (size + fabs(expected)));
}

static void check_cells(void *user, const rig *r, const fields *f, const block *b, const int cell[3], ptrdiff_t at)
{
    (void)user, (void)b;
    for (int p = 0; p < SOLIDS; ++p) {
        const transfer_pair *pair = &r->t.pair[p];
        const int m = pair->material, g = pair->group;
        const double rho = cell_density(r, cell, g), mass = rho * mesh_cell_volume(&r->mesh, cell[0]);
        check_number(field_get(f, C_RHO, m, 0)[at], rho, 0.0);
        check_close(field_next(f, C_RHO, m, 0)[at], field_get(f, C_RHO, m, 0)[at], 0.0);
        check_number(field_get(f, C_TEMP, m, 0)[at],
                     pair->warms && mass > 0.0 ? sum_nodes(r, cell, heat_value, g, 0) / (mass * pair->specific_heat)
                                               : pair->temperature,
                     1.0);
        for (int a = 0; a < r->mesh.dim; ++a) {
            const double u = mass > 0.0 ? sum_nodes(r, cell, momentum_value, g, a) / mass : 0.0;
            const double after = sum_nodes(r, cell, lagrangian_value, g, a);
            check_number(field_get(f, C_VEL, m, a)[at], u, 1.0);
            check_close(field_next(f, C_VEL, m, a)[at], field_get(f, C_VEL, m, a)[at], 0.0);
            check_number(field_get(f, C_MOMENTUM_L, m, a)[at], after, 4.0);
            /* The second momentum is the first here, of which the step before had another. */
            const double impulse = (after - mass * u) + (after - number(r, cell, BEFORE, m, a));
            const double most = mass > 0.0 ? 8.0 / (mass * r->t.dt) : 0.0;
            check_number(field_next(f, C_STRESS_ACCEL, m, a)[at],
                         mass > 0.0 ? impulse / (mass * r->t.dt) - r->t.gravity[a] : 0.0, most + 10.0);
        }
    }
}

static void check_before(void *user, const rig *r, const fields *f, const block *b, const int cell[3], ptrdiff_t at)
{
    (void)user, (void)b;
    for (int p = 0; p < SOLIDS; ++p)
        for (int a = 0; a < r->mesh.dim; ++a)
            check_number(field_next(f, C_STRESS_ACCEL, r->t.pair[p].material, a)[at],
                         sum_nodes(r, cell, lagrangian_value, r->t.pair[p].group, a), 4.0);
}

static void check_nodes(void *user, const rig *r, const fields *f, const block *b, const int node[3], ptrdiff_t at)
{
    (void)user;
    if (!counts(r, b, node)) return;
    check_number(field_get(f, N_PRESSURE, 0, 0)[at], sum_cells(r, node, pressure_value, 0, 0) - r->t.reference_pressure,
                 2e5);
    check_number(field_get(f, N_BURNT_SHARE, r->t.pair[0].group, 0)[at],
                 sum_cells(r, node, share_value, r->t.pair[0].group, 0), 1.0);
    for (int p = 0; p < SOLIDS; ++p) {
        const transfer_pair *pair = &r->t.pair[p];
        const int m = pair->material, g = pair->group;
        const bool warm = pair->exchanges && number(r, node, CAPACITY, g, 0) > 0.0;
        check_number(field_get(f, N_TEMP_CHANGE, g, 0)[at],
                     0.25 + (warm ? sum_cells(r, node, warmer_value, m, 0) : 0.0), 1.0);
        for (int a = 0; a < r->mesh.dim; ++a)
            check_number(field_get(f, N_VEL_L, g, a)[at],
                         number(r, node, LAGRANGIAN, g, a) +
                             (node_mass(r, node, g) > 0.0 ? sum_cells(r, node, change_value, m, a) : 0.0),
                         1.0);
    }
}

static void check_shares(void *user, const rig *r, const fields *f, const block *b, const int cell[3], ptrdiff_t at)
{
    (void)user, (void)b;
    check_number(field_get(f, C_REACTED, 0, 0)[at], share_value(r, cell, r->t.pair[0].group, 0), 0.0);
}

static void check_burnt(void *user, const rig *r, const fields *f, const block *b, const int cell[3], ptrdiff_t at)
{
    (void)user, (void)b;
    const double volume = mesh_cell_volume(&r->mesh, cell[0]);
    const int g = r->t.pair[0].group;
    check_number(field_get(f, C_REACTED, 0, 0)[at], sum_nodes(r, cell, burnt_value, g, 0) / volume, 1.0 / volume);
    check_number(field_get(f, C_BURNT_ENERGY, 0, 0)[at], sum_nodes(r, cell, burnt_energy_value, g, 0) / volume,
                 1.0 / volume);
    for (int a = 0; a < r->mesh.dim; ++a)
        check_number(field_get(f, C_BURNT_MOMENTUM, 0, a)[at], sum_nodes(r, cell, burnt_momentum_value, g, a) / volume,
                     1.0 / volume);
}

static void transfers(const rig_case *c)
{
    rig r;
    rig_make(&r, c);
    r.t.pair[0].warms = r.t.pair[1].exchanges = true;
    r.t.pair[0].specific_heat = 1.25;
    r.t.pair[0].reaction = 0;
    r.t.dt = 0.125;
    r.t.gravity[0] = 1.0;
    r.t.gravity[1] = -9.0;
    r.t.gravity[2] = 3.0;
    visit(&r, true, set_nodes, NULL);
    visit(&r, false, set_cells, NULL);
    check_ok(r.ctx, transfer_nodes_to_cells(&r.t));
    check_ok(r.ctx, transfer_momentum_to_cells(&r.t));
    check_ok(r.ctx, transfer_pressure_to_nodes(&r.t));
    check_ok(r.ctx, transfer_change_to_nodes(&r.t));
    check_ok(r.ctx, transfer_temperature_to_nodes(&r.t));
    check_ok(r.ctx, transfer_share_to_nodes(&r.t));
    visit(&r, true, check_nodes, NULL);
    visit(&r, false, check_shares, NULL);
    check_ok(r.ctx, transfer_burnt_to_cells(&r.t));
    visit(&r, false, check_burnt, NULL);
    visit(&r, true, set_nodes, NULL); /* without what the cells gave */
    check_ok(r.ctx, transfer_stress_to_cells(&r.t));
    visit(&r, false, check_cells, NULL);
    check_ok(r.ctx, transfer_momentum_before(&r.t));
    visit(&r, false, check_before, NULL);
    rig_free(&r);
}

static void every_transfer_is_its_formula(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 2; ++dim)
        for (int blocks = 1; blocks <= 2; ++blocks) {
            transfers(&(const rig_case){dim, blocks, 0u, MESH_CARTESIAN});
            transfers(&(const rig_case){dim, blocks, 1u << (dim - 1), MESH_CARTESIAN});
        }
    transfers(&(const rig_case){2, 2, 0u, MESH_AXISYMMETRIC});
    transfers(&(const rig_case){3, 2, 2u, MESH_CARTESIAN});
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_transfer_is_its_formula)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
