/* A line of nodes across a wall between fluid points and a solid: one velocity of both there, impulses that are equal and opposite, and as heat what they lose. */
#include "check.h"

#include "mpm/fluid/wetted_parts.h"

#include <math.h>
#include <string.h>

enum { MOST = 5 };
typedef enum slip_rule { STICKS, SLIPS, DAMPED, SLIP_RULES } slip_rule;

typedef struct wall {
    mpm s;
    mesh m;
    scene scene;
    mpm_wetted wetted;
    wetted_node node[MOST];
    int member[MOST], first[2];
    double normal[3], ended;
} wall;

static void random_vector(uint64_t *seed, double v[3])
{
    for (int c = 0; c < 3; ++c) v[c] = check_random(seed, -1.0, 1.0);
}

/* Nodes whose areas are all along one normal. */
static void make_wall(wall *w, context *ctx, uint64_t *seed, int n, slip_rule rule)
{
    const mesh_spec spec = {.dim = 3, .upper = {1.0, 1.0, 1.0}, .cell = {0.1, 0.1, 0.1}};
    memset(w, 0, sizeof *w);
    check_ok(ctx, mesh_init(&w->m, ctx, &spec));
    w->ended = rule == STICKS ? 1.0 : rule == SLIPS ? 0.0 : 1.0 - 1.0 / (1.0 + 0.2 * 3.0);
    w->scene.damping.rate = rule == DAMPED ? 3.0 : 0.0;
    w->scene.damping.end = INFINITY;
    w->s = (mpm){.ctx = ctx, .scene = &w->scene, .mesh = &w->m, .kick = 0.2, .wetted = &w->wetted};
    w->wetted =
        (mpm_wetted){.viscous = rule == STICKS, .node = w->node, .member = w->member, .first = w->first, .n = n};
    w->first[1] = n;
    random_vector(seed, w->normal);
    const double size = sqrt(wetted_dot(w->normal, w->normal));
    for (int k = 0; k < n; ++k) {
        wetted_node *node = &w->node[k];
        const double area = check_random(seed, 0.01, 0.03);
        *node = (wetted_node){.at = {5, 5, 3 + k}};
        w->member[k] = k;
        for (int g = 0; g < 2; ++g) {
            node->mass[g] = node->inertia[g] = check_random(seed, 0.1, 3.0);
            random_vector(seed, node->before[g]);
            random_vector(seed, node->gained[g]);
            for (int c = 0; c < 3; ++c) node->v[g][c] = node->before[g][c] + node->gained[g][c];
        }
        random_vector(seed, node->force);
        for (int c = 0; c < 3; ++c) node->area[c] = area * w->normal[c] / size;
    }
    for (int c = 0; c < 3; ++c) w->normal[c] /= size;
}

/* Sum over the line of what the fluid moves relative to the solid, by areas: along the normal, and across it. */
static double sum_slip(const wall *w, double across[3])
{
    double sum[3] = {0.0};
    for (int k = 0; k < w->wetted.n; ++k) {
        const wetted_node *n = &w->node[k];
        for (int c = 0; c < 3; ++c) sum[c] += sqrt(wetted_dot(n->area, n->area)) * (n->v[FLUID][c] - n->v[SOLID][c]);
    }
    const double along = wetted_dot(sum, w->normal);
    for (int c = 0; c < 3; ++c) across[c] = sum[c] - along * w->normal[c];
    return along;
}

/* Momenta of fluid and solid together at each node are what they were; returns the work that the impulses have taken, as velocities are now. */
static double check_momenta(const wall *w, const wetted_node *was)
{
    double lost = 0.0;
    for (int k = 0; k < w->wetted.n; ++k)
        for (int c = 0; c < 3; ++c) {
            double change[2];
            for (int g = 0; g < 2; ++g) {
                change[g] = w->node[k].mass[g] * (w->node[k].v[g][c] - was[k].v[g][c]);
                lost -= change[g] * w->node[k].v[g][c];
            }
            check_close(change[FLUID], -change[SOLID], 1e-14);
        }
    return lost;
}

/* Along a wall nothing closes, and a rule says what of the slip remains. */
static void test_wall(void **state)
{
    (void)state;
    context *ctx = context_create();
    uint64_t seed = 7;
    int hot = 0;
    for (int trial = 0; trial < 60; ++trial)
        for (int rule = 0; rule < SLIP_RULES; ++rule) {
            wall w;
            wetted_node was[MOST];
            double before[3], after[3], fluid = 0.0;
            make_wall(&w, ctx, &seed, 2 + trial % (MOST - 1), (slip_rule)rule);
            memcpy(was, w.node, sizeof was);
            (void)sum_slip(&w, before);
            wetted_constrain_line(&w.s, 0);
            check_close(sum_slip(&w, after), 0.0, 1e-15);
            for (int c = 0; c < 3; ++c) check_close(after[c], (1.0 - w.ended) * before[c], 1e-15);
            const double lost = check_momenta(&w, was);
            for (int k = 0; k < w.wetted.n; ++k) fluid += w.node[k].mass[FLUID];
            for (int k = 0; k < w.wetted.n; ++k) check_close(w.node[k].heat, fmax(lost, 0.0) / fluid, 1e-14);
            hot += lost > 0.0;
        }
    check_true(hot > 60);
    context_destroy(&ctx);
}

/* Nodes with almost nothing of one of the two have one velocity; so have, where there is no wall, those with enough of the solid. */
static void test_merged(void **state)
{
    (void)state;
    context *ctx = context_create();
    uint64_t seed = 8;
    for (int trial = 0; trial < 60; ++trial)
        for (int no_wall = 0; no_wall < 2; ++no_wall) {
            wall w;
            wetted_node was[MOST];
            const int n = 2 + trial % (MOST - 1), light = trial % n, part = trial % 2 ? FLUID : SOLID;
            make_wall(&w, ctx, &seed, n, SLIPS);
            w.wetted.density = 1e4; /* a tenth of a cell's mass is 1 kg */
            for (int k = 0; k < n && no_wall; ++k)
                for (int c = 0; c < 3; ++c) w.node[k].area[c] *= 0.01;
            if (!no_wall) w.node[light].inertia[part] = w.node[light].mass[part] *= 1e-6;
            memcpy(was, w.node, sizeof was);
            wetted_constrain_line(&w.s, 0);
            (void)check_momenta(&w, was);
            for (int k = 0; k < n; ++k) {
                const bool merged = no_wall ? was[k].mass[SOLID] > 1.0 : k == light;
                const wetted_node *m = &w.node[k];
                const bool same = fabs(m->v[FLUID][0] - m->v[SOLID][0]) + fabs(m->v[FLUID][1] - m->v[SOLID][1]) == 0.0;
                assert_int_equal(same, merged);
            }
        }
    context_destroy(&ctx);
}

/* A pressure that is uniform drives none of the fluid's nodes, whatever their masses: the solid has its force. */
static void test_pressure(void **state)
{
    (void)state;
    context *ctx = context_create();
    uint64_t seed = 9;
    for (int trial = 0; trial < 20; ++trial) {
        wall w;
        const double pressure = check_random(&seed, 10.0, 20.0);
        make_wall(&w, ctx, &seed, 1 + trial % MOST, STICKS);
        w.wetted.density = 1e9;
        for (int k = 0; k < w.wetted.n; ++k)
            for (int c = 0; c < 3; ++c) {
                wetted_node *m = &w.node[k];
                m->area[c] *= 0.01; /* no wall, along which more would be asked for */
                m->force[c] = pressure * m->area[c];
                m->v[SOLID][c] = 0.0;
                m->v[FLUID][c] = w.s.kick * m->force[c] / m->mass[FLUID];
            }
        wetted_constrain_line(&w.s, 0);
        for (int k = 0; k < w.wetted.n; ++k)
            for (int c = 0; c < 3; ++c) {
                const wetted_node *m = &w.node[k];
                check_close(m->v[FLUID][c], 0.0, 1e-15);
                check_close(m->v[SOLID][c], w.s.kick * pressure * m->area[c] / m->mass[SOLID], 1e-15);
            }
    }
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_wall), cmocka_unit_test(test_merged),
                                       cmocka_unit_test(test_pressure)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
