/* A body of points with random velocities: momentum is kept, and axes that are exchanged, or run the other way, exchange and turn the results. In every
 * number of dimensions, for every basis, scheme of stress and transfer, solids and a gas, beside sides of every kind. */
#include "mpm_fixture.h"

enum { MOST_POINTS = 20 * 20 * 20, HELD = 10 }; /* velocities, stresses, density */

typedef struct turn {
    int shift,
        mirrors; /* axis a of the new box is axis (a + shift) of the old one, the other way round where bit a is set */
} turn;

static bool mirrors(const turn *t, int a)
{
    return t->mirrors >> a & 1;
}

/* Edges of the cells of the first box. */
static const double edge[3] = {0.1, 0.125, 0.08};

static int cells_along(int dim)
{
    return dim == 3 ? 6 : 8;
}

/* Numbers of the places of a seeded lattice, two to a cell, in the first box. */
static size_t place_of(const fields *f, int body, int dim, size_t k, const turn *t, int old[3])
{
    const int n = 2 * cells_along(dim);
    size_t at = 0;
    old[0] = old[1] = old[2] = 0;
    for (int a = 0; a < dim; ++a) {
        const int i = (int)floor(field_get(f, P_POS, body, a)[k] / (0.5 * edge[(a + t->shift) % dim]));
        old[(a + t->shift) % dim] = mirrors(t, a) ? n - 1 - i : i;
    }
    for (int a = dim - 1; a >= 0; --a) at = at * (size_t)n + (size_t)old[a];
    return at;
}

static double noise(const int place[3], int what)
{
    uint64_t seed = (uint64_t)(place[0] + 100 * (place[1] + 100 * (place[2] + 100 * what)) + 99);
    return check_random(&seed, -1.0, 1.0);
}

typedef struct way {
    const char *basis;
    stress_scheme stress;
    const char *transfer;
    const char *law; /* NULL: a gas */
    bc_kind lower[3], upper[3];
    double penalty;
    bool contact; /* of two bodies, side by side along the first axis of the first box */
} way;

static int component_at(int i, int j)
{
    return i == j ? i : i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

static void run_body(int dim, const way *w, const turn *t, double *out)
{
    trial r;
    double size[3] = {0.0};
    for (int a = 0; a < dim; ++a) size[a] = cells_along(dim) * edge[(a + t->shift) % dim];
    trial_begin(&r, dim, size, 0.1);
    for (int a = 0; a < dim; ++a) {
        const int old = (a + t->shift) % dim;
        r.scene->mesh.cell[a] = edge[old];
        const bool turned = mirrors(t, a);
        set_sides(&r, a, turned ? w->upper[old] : w->lower[old], turned ? w->lower[old] : w->upper[old]);
    }
    set_method(&r, w->basis, w->stress, w->transfer ? (double)NAN : 0.9);
    if (w->transfer) snprintf(r.scene->method.transfer, sizeof r.scene->method.transfer, "%s", w->transfer);
    r.scene->method.edge_penalty = w->penalty;
    double lo[3], hi[3];
    for (int a = 0; a < dim; ++a) { /* at the lower sides of the first box, one cell from the others */
        const int old = (a + t->shift) % dim;
        const double from = w->lower[old] == BC_FREE ? 2.0 * edge[old] : 0.0,
                     to = w->upper[old] == BC_FREE ? size[a] - 2.0 * edge[old] : size[a];
        lo[a] = mirrors(t, a) ? size[a] - to : from;
        hi[a] = mirrors(t, a) ? size[a] - from : to;
    }
    for (int part = 0; part <= w->contact; ++part) {
        double from[3], to[3];
        for (int a = 0; a < 3; ++a) {
            const bool cut = w->contact && a < dim && (a + t->shift) % dim == 0,
                       upper = mirrors(t, a) ? part == 0 : part == 1;
            const double middle = 0.5 * (lo[a] + hi[a]);
            from[a] = cut && upper ? middle : lo[a];
            to[a] = cut && !upper ? middle : hi[a];
        }
        scene_body *b = add_body(&r, w->law ? add_solid(&r, w->law, 3e5, 1e5, 1000.0) : add_gas(&r, 1.4, 700.0),
                                 make_box(&r, from, to), 2);
        if (!w->law) {
            b->pressure = 1e5;
            b->temperature = 300.0;
        }
    }
    r.scene->contact.enabled = w->contact;
    r.scene->contact.kind = CONTACT_FRICTION;
    r.scene->contact.friction = 0.3;
    trial_start(&r);
    const fields *f = r.sim->domain->fields[0];
    size_t n[2] = {0, 0};
    for (int body = 0; body <= w->contact; ++body) {
        n[body] = r.sim->mpm->points[0][body].n;
        for (size_t k = 0; k < n[body]; ++k) {
            int old[3];
            (void)place_of(f, body, dim, k, t, old);
            for (int a = 0; a < dim; ++a)
                field_get(f, P_VEL, body, a)[k] = (mirrors(t, a) ? -1.0 : 1.0) * noise(old, (a + t->shift) % dim);
        }
    }
    check_ok(r.ctx, sim_update_ledger(r.sim));
    memcpy(r.sim->ledger.initial, r.sim->ledger.total, sizeof r.sim->ledger.initial);
    for (int k = 0; k < 3; ++k) check_ok(r.ctx, sim_step(r.sim, 2e-4 * (k + 1)));
    for (int body = 0; body <= w->contact; ++body) assert_int_equal(r.sim->mpm->points[0][body].n, n[body]);
    check_ok(r.ctx, sim_update_ledger(r.sim));
    const double mass = r.sim->ledger.total[LEDGER_MASS]; /* of speeds up to one */
    for (int q = LEDGER_MASS; q <= LEDGER_MOMENTUM_Z; ++q)
        check_close(ledger_excess(&r.sim->ledger, (ledger_quantity)q), 0.0, 1e-13 * mass);
    for (int body = 0; body <= w->contact; ++body)
        for (size_t k = 0; k < n[body]; ++k) {
            int old[3];
            double *to = out + HELD * place_of(f, body, dim, k, t, old);
            for (int a = 0; a < dim; ++a)
                to[(a + t->shift) % dim] = (mirrors(t, a) ? -1.0 : 1.0) * field_get(f, P_VEL, body, a)[k];
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j <= i; ++j) {
                    const int from_i = i < dim ? (i + t->shift) % dim : i, from_j = j < dim ? (j + t->shift) % dim : j;
                    const double sign =
                        (i < dim && mirrors(t, i) ? -1.0 : 1.0) * (j < dim && mirrors(t, j) ? -1.0 : 1.0);
                    if (i != j && i >= dim) continue;
                    to[3 + component_at(from_i, from_j)] =
                        sign * field_get(f, P_STRESS, body, component_at(i, j))[k] / 1e5;
                }
            to[9] = field_get(f, P_J, body, 0)[k];
        }
    trial_end(&r);
}

static void bodies_keep_and_turn(void **unused)
{
    (void)unused;
    static const way ways[] = {
        {"linear",
         STRESS_USL,
         NULL,
         "linear_elastic",
         {BC_FREE, BC_FREE, BC_FREE},
         {BC_FREE, BC_FREE, BC_FREE},
         0.0,
         false},
        {"gimp",
         STRESS_USF,
         NULL,
         "linear_elastic",
         {BC_FREE, BC_FREE, BC_FREE},
         {BC_FREE, BC_FREE, BC_FREE},
         0.0,
         false},
        {"quadratic",
         STRESS_MUSL,
         NULL,
         "neo_hookean",
         {BC_SLIP, BC_NO_SLIP, BC_SYMMETRY},
         {BC_FREE, BC_FREE, BC_FREE},
         0.0,
         false},
        {"cubic",
         STRESS_MUSL,
         NULL,
         "linear_elastic",
         {BC_SYMMETRY, BC_SLIP, BC_NO_SLIP},
         {BC_FREE, BC_FREE, BC_FREE},
         0.0,
         false},
        {"cpdi",
         STRESS_MUSL,
         NULL,
         "neo_hookean",
         {BC_FREE, BC_FREE, BC_FREE},
         {BC_FREE, BC_FREE, BC_FREE},
         0.0,
         false},
        {"quadratic",
         STRESS_MUSL,
         "apic",
         "neo_hookean",
         {BC_FREE, BC_FREE, BC_FREE},
         {BC_FREE, BC_FREE, BC_FREE},
         0.0,
         false},
        {"quadratic",
         STRESS_MUSL,
         "tpic",
         "linear_elastic",
         {BC_FREE, BC_FREE, BC_FREE},
         {BC_SLIP, BC_FREE, BC_SYMMETRY},
         0.0,
         false},
        {"quadratic",
         STRESS_MUSL,
         "xpic",
         "linear_elastic",
         {BC_SLIP, BC_FREE, BC_FREE},
         {BC_FREE, BC_FREE, BC_SLIP},
         0.0,
         false},
        {"quadratic",
         STRESS_MUSL,
         "afmpm",
         "linear_elastic",
         {BC_FREE, BC_FREE, BC_FREE},
         {BC_FREE, BC_FREE, BC_FREE},
         0.0,
         false},
        {"gimp",
         STRESS_MUSL,
         NULL,
         NULL,
         {BC_SYMMETRY, BC_SLIP, BC_SYMMETRY},
         {BC_SLIP, BC_SYMMETRY, BC_SLIP},
         0.0,
         false},
        {"quadratic",
         STRESS_USL,
         NULL,
         NULL,
         {BC_SYMMETRY, BC_SLIP, BC_SYMMETRY},
         {BC_SLIP, BC_SYMMETRY, BC_SLIP},
         0.0,
         false},
        {"linear",
         STRESS_MUSL,
         NULL,
         "linear_elastic",
         {BC_FREE, BC_FREE, BC_FREE},
         {BC_FREE, BC_FREE, BC_FREE},
         0.0,
         true},
        {"gimp",
         STRESS_USL,
         NULL,
         "linear_elastic",
         {BC_FREE, BC_SLIP, BC_FREE},
         {BC_FREE, BC_FREE, BC_SLIP},
         0.0,
         true},
    };
    static double first[MOST_POINTS * HELD], turned[MOST_POINTS * HELD];
    for (int dim = 1; dim <= 3; ++dim)
        for (size_t k = 0; k < sizeof ways / sizeof *ways; ++k) {
            memset(first, 0, sizeof first);
            run_body(dim, &ways[k], &(const turn){0, 0}, first);
            for (int n = 1; n < 2 * dim; ++n) {
                const turn t = {n / 2, n % 2 << n / 2};
                double worst = 0.0;
                memset(turned, 0, sizeof turned);
                run_body(dim, &ways[k], &t, turned);
                for (size_t i = 0; i < sizeof first / sizeof *first; ++i)
                    worst = fmax(worst, fabs(turned[i] - first[i]));
                check_close(worst, 0.0, ways[k].contact ? 1e-9 : 1.2e-12); /* round-off over nodes that bear little */
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bodies_keep_and_turn)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
