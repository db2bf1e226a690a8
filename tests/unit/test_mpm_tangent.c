/* Statics of points: the matrix of a load increment is the derivative of its forces, which are what the weights of the points make of their stresses. In every
 * geometry, for bases with weights along the axes, beside walls, mirrors and free or periodic sides; the state is one under load, the direction random. */
#include "verification/coupled_fixture.h"

#include "mpm/implicit/implicit.h"
#include "mpm/surface/surface_facets.h"
#include "mpm/surface/surfaces.h"
#include "mpm/surface/traction.h"

typedef struct tangent_case {
    int dim;
    bool radial;
    bc_kind lower, upper;
    bool periodic; /* along the last axis */
} tangent_case;

/* Forces of stress and of edges at a displacement, of the components that points reach. */
static void forces_at(mpm *s, const double *u, double *out)
{
    const struct mpm_implicit *w = s->implicit;
    check_ok(s->ctx, implicit_strain(s, u));
    implicit_internal_force(s, out);
    implicit_edge_force(s, u, out);
    for (size_t k = 0; k < w->components; ++k)
        if (!w->reached[k]) out[k] = 0.0;
}

/* K x against (f(u - e x) - f(u + e x))/(2 e), over the largest force. */
static void check_derivative(trial *t)
{
    mpm *s = t->sim->mpm;
    struct mpm_implicit *w = s->implicit;
    uint64_t seed = 4;
    const double h = s->mesh->h[0], step = 1e-5;
    double *part[5]; /* u, direction, both forces, K x */
    check_ok(t->ctx, implicit_locate(s));
    check_ok(t->ctx, implicit_find_edges(s));
    implicit_constrain(s);
    implicit_find_reached(s);
    for (int k = 0; k < 5; ++k) check_ok(t->ctx, memory_new(t->ctx, &part[k], w->components, sizeof **part));
    for (size_t k = 0; k < w->components; ++k) {
        part[0][k] = w->reached[k] ? 1e-3 * h * check_random(&seed, -1.0, 1.0) : 0.0;
        part[1][k] = w->reached[k] ? check_random(&seed, -1.0, 1.0) : 0.0;
    }
    node_matrix *m = multigrid_matrix(w->solver);
    check_ok(t->ctx, implicit_strain(s, part[0]));
    check_ok(t->ctx, implicit_tangents(s, part[0]));
    check_ok(t->ctx, node_matrix_shape(m, w->row));
    implicit_assemble(s, m, w->tangent);
    implicit_assemble_edges(s, m);
    node_matrix_apply(m, part[1], part[4]);
    for (size_t k = 0; k < w->components; ++k) part[0][k] += step * h * part[1][k];
    forces_at(s, part[0], part[2]);
    for (size_t k = 0; k < w->components; ++k) part[0][k] -= 2.0 * step * h * part[1][k];
    forces_at(s, part[0], part[3]);
    double largest = 0.0, off = 0.0;
    for (size_t k = 0; k < w->components; ++k) {
        const double pull = (part[3][k] - part[2][k]) / (2.0 * step * h);
        largest = fmax(largest, fabs(pull));
        if (w->reached[k]) off = fmax(off, fabs(pull - part[4][k]));
    }
    check_true(largest > 0.0);
    check_close(off / largest, 0.0, 2e-7);
    for (int k = 0; k < 5; ++k) memory_free(t->ctx, &part[k]);
}

/* Weights give the place itself from the places of the nodes, and a gradient of one, beside every side: what a mirror takes from beyond is the image of
 * what there is, and what other sides take goes on along a line. Along walls that mirror, velocities are even. */
static void check_weights(const trial *t, const tangent_case *c)
{
    mpm *s = t->sim->mpm;
    const struct mpm_implicit *w = s->implicit;
    weighted_node node[IMPLICIT_NODES];
    const bool mirrors = c->lower == BC_SLIP || c->lower == BC_SYMMETRY || c->radial;
    for (size_t k = 0; k < w->points; ++k) {
        const int n = implicit_nodes(s, &w->weights[k], node);
        for (int u = 0; u < c->dim; ++u)
            for (int along = 0; along < c->dim; ++along) {
                double at = 0.0, slope[3] = {0.0};
                if ((c->periodic && along == c->dim - 1) || (mirrors && along != u)) continue;
                for (int i = 0; i < n; ++i) {
                    const double x = mesh_node(s->mesh, along, node[i].node[along]);
                    at += node[i].S[u] * x;
                    for (int a = 0; a < c->dim; ++a) slope[a] += node[i].slope[u][a] * x;
                }
                check_close(at, field_get(s->domain->fields[0], P_POS, 0, along)[k], 1e-14);
                for (int a = 0; a < c->dim; ++a) check_close(slope[a], a == along ? 1.0 : 0.0, 1e-13);
            }
    }
}

/* Loads without stress: the weight of all points is what the nodes have of it, component by component, where no side takes a part. */
static void check_weight(trial *t)
{
    mpm *s = t->sim->mpm;
    struct mpm_implicit *w = s->implicit;
    double given[SCENE_MAX_BODIES][3] = {{1.0, -2.0, 3.0}}, *force, sum[3] = {0.0}, mass = 0.0;
    check_ok(t->ctx, memory_new(t->ctx, &force, w->components, sizeof *force));
    implicit_body_force(s, given, false, force);
    for (int c = 0; c < s->mesh->dim; ++c)
        for (size_t k = 0; k < w->grid.size; ++k) sum[c] += force[implicit_index(w, 0, c, (int)k)];
    mass = sum_body_points(t, 0, NULL).mass;
    for (int c = 0; c < s->mesh->dim; ++c) check_close(sum[c], mass * given[0][c], 1e-12 * mass);
    memory_free(t->ctx, &force);
}

static void check_case(const tangent_case *c, const basis_model *basis, double penalty)
{
    trial t;
    const double size[3] = {0.6, 0.5, 0.4};
    trial_begin(&t, c->dim, size, 0.1);
    if (c->radial) t.scene->mesh.geometry = MESH_AXISYMMETRIC;
    for (int a = 0; a < c->dim; ++a) set_sides(&t, a, c->radial && a == 0 ? BC_SYMMETRY : c->lower, c->upper);
    t.scene->mesh.periodic[c->dim - 1] = c->periodic;
    set_method(&t, basis->name, STRESS_USL, 1.0);
    t.scene->method.edge_penalty = penalty;
    t.scene->time.solver = SOLVER_STATIC;
    t.scene->time.increments = 2;
    t.scene->time.end = 1.0;
    const bool free = c->lower == BC_FREE;
    add_body(&t, add_solid(&t, "neo_hookean", 6.0, 3.0, 1.0),
             make_box(&t, free ? (const double[3]){0.1, 0.1, 0.1} : (const double[3]){0.0, 0.0, 0.0},
                      c->periodic ? (const double[3]){0.5, 0.5, 0.5} : (const double[3]){0.5, 0.4, 0.3}),
             2);
    scene_load *weight = add_load(&t, LOAD_BODY_FORCE, 0);
    for (int a = 0; a < c->dim && !free; ++a) weight->vector[a] = 0.3 + 0.1 * a;
    trial_start(&t);
    if (!free) trial_steps(&t, 1);
    check_derivative(&t);
    check_weights(&t, c);
    if (free && !c->radial) check_weight(&t);
    trial_end(&t);
}

static void matrices_are_derivatives(void **unused)
{
    (void)unused;
    static const tangent_case cases[] = {
        {1, false, BC_SLIP, BC_FREE, false},     {2, false, BC_NO_SLIP, BC_FREE, false},
        {2, false, BC_SYMMETRY, BC_FREE, false}, {2, true, BC_SLIP, BC_FREE, false},
        {2, true, BC_NO_SLIP, BC_FREE, false},   {2, false, BC_FREE, BC_FREE, false},
        {2, false, BC_NO_SLIP, BC_FREE, true},   {3, false, BC_SLIP, BC_FREE, false},
        {3, false, BC_FREE, BC_FREE, false},
    };
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (size_t k = 0; k < sizeof cases / sizeof *cases && !basis_is(basis_registry[i], "cpdi"); ++k)
            check_case(&cases[k], basis_registry[i], k % 2 ? 0.0 : 0.05);
}

/* Twice the area (m2) that a surface in the plane has between it and the origin. */
static double area_within(const mpm *s)
{
    double sum = 0.0;
    for (size_t k = 0; k < s->surfaces->n_facets; ++k) {
        double x[3], area[3];
        centre_of_facet(s, s->surfaces->corner, &s->surfaces->facet[k], x);
        area_of_facet(s, s->surfaces->corner, &s->surfaces->facet[k], area);
        sum += x[0] * area[0] + x[1] * area[1];
    }
    return sum;
}

/* Gas in a quarter of a ring: a displacement in proportion to the place makes twice the area of it more; its pressure follows the isentrope, and its stiffness is
 * the derivative of its forces. */
static void gas_is_isentropic(void **unused)
{
    (void)unused;
    trial t;
    trial_begin(&t, 2, (const double[3]){0.8, 0.8, 0.0}, 0.05);
    for (int a = 0; a < 2; ++a) set_sides(&t, a, BC_SYMMETRY, BC_FREE);
    set_method(&t, "quadratic", STRESS_USL, 1.0);
    t.scene->time.solver = SOLVER_STATIC;
    t.scene->time.increments = 2;
    t.scene->time.end = 1.0;
    t.scene->reference_pressure = 0.4;
    const int gas = add_gas(&t, 1.4, 1.0);
    add_body(&t, add_solid(&t, "neo_hookean", 60.0, 30.0, 1.0), make_ring(&t, 0.4, 0.6), 2);
    scene_body *b = add_body(&t, gas, make_ball(&t, (const double[3]){0.0, 0.0, 0.0}, 0.4), 2);
    b->pressure = 1.0;
    b->density = 1.0;
    trial_start(&t);
    mpm *s = t.sim->mpm;
    const double first = area_within(s);
    check_close_relative(first, 0.5 * acos(-1.0) * 0.16, 1e-4);
    trial_steps(&t, 1);
    struct mpm_implicit *w = s->implicit;
    assert_int_equal(w->n_gases, 1);
    check_close(-2.0 * surface_swept(s, 0), area_within(s) - first, 1e-15); /* now back: places have been exchanged */
    memset(w->u, 0, w->components * sizeof *w->u);
    implicit_load_surfaces(s, w->u, w->external);
    enclosed_gas *r = &w->gas_set[0];
    check_ok(t.ctx, enclosed_gases_begin(s));
    double *part[5], gain = 0.0;
    uint64_t seed = 2;
    for (int k = 0; k < 5; ++k) check_ok(t.ctx, memory_new(t.ctx, &part[k], w->components, sizeof **part));
    for (int j = 0; j < w->grid.n[1]; ++j)
        for (int i = 0; i < w->grid.n[0]; ++i)
            for (int c = 0; c < 2; ++c) {
                const int node = (int)(w->grid.origin + i * w->grid.stride[0] + j * w->grid.stride[1]);
                const size_t n = implicit_index(w, 0, c, node);
                gain += r->unit_force[n] * 0.05 * (c == 0 ? i : j);
                part[0][n] = w->constrained[n] ? 0.0 : 1e-3 * check_random(&seed, -1.0, 1.0);
                part[1][n] = w->constrained[n] ? 0.0 : check_random(&seed, -1.0, 1.0);
            }
    check_close_relative(gain, area_within(s), 1e-13); /* the gradient of the volume, along the places */
    for (double more = -0.2; more < 0.3; more += 0.1) {
        check_ok(t.ctx, enclosed_gas_set(s, r, more * r->volume_first));
        const double pressure = r->pressure_first * pow(1.0 + more, -1.4);
        const double second = 0.2 * fabs(more * more * more) + 1e-14; /* the rule of the middle */
        check_close_relative(r->pressure, pressure, second);
        check_close_relative(r->stiffness, 1.4 * pressure / r->volume, second);
        check_close_relative(r->mass * r->energy, pressure * r->volume / 0.4, second);
    }
    double pressure[2], by_stiffness = 0.0, swept = 0.0;
    for (int side = 0; side < 2; ++side) {
        for (size_t k = 0; k < w->components; ++k) part[4][k] = part[0][k] + (side ? 1e-5 : -1e-5) * part[1][k];
        implicit_load_surfaces(s, part[4], w->external);
        check_ok(t.ctx, enclosed_gases_force(s, part[4], part[2]));
        pressure[side] = r->pressure;
    }
    implicit_load_surfaces(s, part[0], w->external);
    check_ok(t.ctx, enclosed_gases_force(s, part[0], part[2]));
    memset(part[3], 0, w->components * sizeof **part);
    enclosed_gases_stiffness(w, part[1], part[3]);
    for (size_t k = 0; k < w->components; ++k) {
        by_stiffness += part[3][k] * part[1][k];
        swept += w->constrained[k] ? 0.0 : r->unit_force[k] * part[1][k];
    }
    check_close_relative(by_stiffness, -(pressure[1] - pressure[0]) / 2e-5 * swept, 1e-7);
    for (int k = 0; k < 5; ++k) memory_free(t.ctx, &part[k]);
    trial_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(matrices_are_derivatives), cmocka_unit_test(gas_is_isentropic)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
