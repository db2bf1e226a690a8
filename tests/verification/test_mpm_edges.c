/* Edges of solids held by the penalty (mpm/edge/edge.h): what it must leave alone, what it must keep, and what it is for: the thick cylinder of
 * Guilkey et al. (2003), section 3, under a traction on its bore, whose error lies in nodes that points fill in part. */
#include "coupled_fixture.h"

#include "io/checkpoint/checkpoint.h"
#include "io/io.h"

#include <unistd.h>

static const double pi = 3.14159265358979323846, penalty = 0.05;

/* Differences are half of what is remembered in a plane: four numbers a node, before two of its acceleration and two of lines; the last two are of the group. */
static double largest_difference(const trial *t)
{
    size_t n = 0;
    const double *difference = mpm_edges_state(t->sim->mpm, &n);
    double largest = 0.0;
    assert_true(n % 8 == 2);
    for (size_t k = 0; k < n / 2; ++k) largest = fmax(largest, fabs(difference[k]));
    return largest;
}

typedef struct sums {
    double momentum[2], spin, largest_stress, largest_error;
    double flight[2];
} sums;

static void add_point(void *user, const fields *f, int body, size_t k)
{
    sums *s = user;
    const double m = field_get(f, P_MASS, body, 0)[k];
    double x[2], v[2];
    for (int a = 0; a < 2; ++a) {
        x[a] = field_get(f, P_POS, body, a)[k];
        v[a] = field_get(f, P_VEL, body, a)[k];
        s->momentum[a] += m * v[a];
        s->largest_error = fmax(s->largest_error, fabs(v[a] - s->flight[a]));
    }
    s->spin += m * (x[0] * v[1] - x[1] * v[0]);
    for (int c = 0; c < 4; ++c) s->largest_stress = fmax(s->largest_stress, fabs(field_get(f, P_STRESS, body, c)[k]));
}

static sums sum_points(const trial *t, const double flight[2])
{
    sums s = {.spin = 0.0, .flight = {flight[0], flight[1]}};
    for (int body = 0; body < t->scene->n_bodies; ++body) visit_points(t, body, add_point, &s);
    return s;
}

static void begin_disc(trial *t, const char *basis, const char *transfer)
{
    const double size[3] = {3.0, 2.0, 0.0};
    trial_begin(t, 2, size, 0.1);
    set_method(t, basis, STRESS_USL, 1.0);
    snprintf(t->scene->method.transfer, sizeof t->scene->method.transfer, "%s", transfer);
    t->scene->method.edge_penalty = penalty;
    add_body(t, add_solid(t, "linear_elastic", 5.0, 2.0, 1.0), make_ball(t, (const double[]){0.6, 0.6, 0.0}, 0.4), 2)
        ->seeding = SEED_FITTED;
}

/* A disc that flies across many cells is left alone by it, with every basis. */
static void test_flight(void **unused)
{
    (void)unused;
    const double v[2] = {0.8, 0.31};
    for (size_t i = 0; i < basis_registry_size; ++i) {
        trial t;
        begin_disc(&t, basis_registry[i]->name, "flip");
        memcpy(t.scene->body[0].velocity, v, sizeof v);
        trial_start(&t);
        trial_run(&t, 1.5);
        const sums after = sum_points(&t, v);
        check_true(after.largest_error <= 1e-11);
        check_true(after.largest_stress <= 1e-10);
        check_true(largest_difference(&t) <= 1e-12);
        trial_end(&t);
    }
}

static double spin_of_disc(void *user, initial_quantity quantity, int component, const double x[3])
{
    (void)user;
    if (quantity == INITIAL_STRESS) return 0.0;
    return component == 0 ? 0.6 - x[1] : component == 1 ? x[0] - 0.6 : 0.0;
}

/* Motion that is linear in space has no differences: a disc that begins to turn, by a transfer that knows linear motion. */
static void test_linear(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        trial t;
        begin_disc(&t, basis_registry[i]->name, "tpic");
        t.scene->body[0].initial_from_exact = true;
        t.scene->initial = spin_of_disc;
        trial_start(&t);
        trial_steps(&t, 1);
        check_true(largest_difference(&t) <= 1e-13);
        trial_end(&t);
    }
}

static double kinetic(const trial *t)
{
    sim_totals totals;
    check_ok(t->ctx, sim_sum(t->sim, &totals));
    return totals.kinetic;
}

/* Two discs meet and part: momentum to round-off, and no more energy than they came with. What lines take is in the ledger: of the energy 2.1 % (USF)
 * and 0.44 % (MUSL) are missing there; USL loses 9 % of its own. */
static void test_collision(void **unused)
{
    (void)unused;
    for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme) {
        trial t;
        const double size[3] = {2.0, 2.0, 0.0}, none[2] = {0.0, 0.0};
        trial_begin(&t, 2, size, 0.1);
        set_method(&t, "quadratic", (stress_scheme)scheme, 1.0);
        t.scene->method.edge_penalty = penalty;
        const int solid = add_solid(&t, "neo_hookean", 5.0, 2.0, 1.0),
                  other = add_solid(&t, "linear_elastic", 8.0, 3.0, 1.0);
        scene_body *a = add_body(&t, solid, make_ball(&t, (const double[]){0.6, 0.65, 0.0}, 0.3), 3);
        scene_body *b = add_body(&t, other, make_ball(&t, (const double[]){1.4, 1.25, 0.0}, 0.3), 3);
        a->velocity[0] = a->velocity[1] = 0.15;
        b->velocity[0] = b->velocity[1] = -0.15;
        trial_start(&t);
        trial_run(&t, 2.0);
        check_true(largest_difference(&t) > 1e-6); /* it was at work */
        const sums after = sum_points(&t, none);
        for (int k = 0; k < 2; ++k) check_close(after.momentum[k], 0.0, 4e-11); /* nodes all but empty take no force */
        check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) <= 1e-13);
        check_true(kinetic(&t) <= 0.5 * 0.045 * 2.0 * pi * 0.09 * 1.0);
        const double energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
        print_message("scheme %d: energy ledger %.2e\n", scheme, energy);
        check_true(energy <= (scheme == STRESS_USL ? 0.1 : scheme == STRESS_USF ? 0.03 : 0.009));
        trial_end(&t);
    }
}

/* ---- the cylinder ---- */

typedef struct stress_list {
    double *value;
    size_t n;
} stress_list;

static void add_stress(void *user, const fields *f, int body, size_t k)
{
    stress_list *s = user;
    s->value[s->n++] = field_get(f, P_STRESS, body, 0)[k] + field_get(f, P_STRESS, body, 1)[k];
}

static double cylinder_error(const char *cell, const char *how)
{
    const char *const set[] = {cell, how, "method.edge_penalty=0.05"};
    trial t;
    deck_begin(&t, "annulus_traction", set, 3);
    use_threads(1);
    trial_start(&t);
    trial_settle(&t, 10e-3);
    assert_true(t.sim->at_rest);
    stress_list s = {.value = calloc(mpm_count(t.sim->mpm), sizeof(double))};
    visit_points(&t, 0, add_stress, &s);
    const double error = 100.0 * guilkey_eq13(s.n, s.value, 19.4e6, 0.5, 1.0);
    free(s.value);
    print_message("%s, %s: %.3f %%, momentum ledger %.1e\n", cell, how, error,
                  ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y));
    check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) <= 1e-10);
    trial_end(&t);
    return error;
}

/* A static solution of the same discretisation, solved directly, has 2.33, 0.40 and 0.138 %; without the penalty 3.9, 2.9 and 1.6 %. Points are where the
 * load has put them here. */
static void test_cylinder(void **unused)
{
    (void)unused;
    check_close(cylinder_error("domain.cell=0.1", "method.stress=usl"), 2.33, 0.08);
    check_close(cylinder_error("domain.cell=0.05", "method.stress=usl"), 0.40, 0.03);
    check_close(cylinder_error("domain.cell=0.1", "method.stress=musl"), 2.33, 0.09);
    check_close(cylinder_error("domain.cell=0.1", "method.stress=usf"), 2.33, 0.06);
    check_close(cylinder_error("domain.cell=0.1", "time.solver=static"), 2.33, 0.08);
    check_close(cylinder_error("domain.cell=0.05", "time.solver=static"), 0.40, 0.024);
    check_close(cylinder_error("domain.cell=0.025", "time.solver=static"), 0.138, 0.0077);
}

/* ---- holes and walls of few cells, in static balance ---- */

/* An annulus under a traction on its bore (Lame). */
typedef struct ring_case {
    double inner, outer, cell;
    double most; /* of the error without held edges */
} ring_case;

typedef struct ring_sums {
    const ring_case *ring;
    double error, size;
} ring_sums;

static void add_radial(void *user, const fields *f, int body, size_t k)
{
    ring_sums *s = user;
    const double a2 = s->ring->inner * s->ring->inner, b2 = s->ring->outer * s->ring->outer, pressure = 19.4e6;
    const double x = field_get(f, P_POS, body, 0)[k], y = field_get(f, P_POS, body, 1)[k], r2 = x * x + y * y;
    const double xx = field_get(f, P_STRESS, body, 0)[k], yy = field_get(f, P_STRESS, body, 1)[k],
                 xy = field_get(f, P_STRESS, body, 3)[k];
    const double found = (xx * x * x + yy * y * y + 2.0 * xy * x * y) / r2;
    const double lame = pressure * a2 / (b2 - a2) * (1.0 - b2 / r2), volume = field_get(f, P_VOLUME0, body, 0)[k];
    s->error += volume * fabs(found - lame);
    s->size += volume * fabs(lame);
}

/* L1 of the radial stress as a share of that stress. */
static double ring_error(const ring_case *ring, const char *basis, const char *edges)
{
    char inner[96], bore[96], outer[96], cell[96], held[96], with[96], upper[96];
    const double width = ring->cell * (ceil(1.12 * ring->outer / ring->cell) + 1.0);
    (void)snprintf(inner, sizeof inner, "bodies.cylinder.shape.annulus.inner_radius=%.17g", ring->inner);
    (void)snprintf(outer, sizeof outer, "bodies.cylinder.shape.annulus.outer_radius=%.17g", ring->outer);
    (void)snprintf(bore, sizeof bore, "loads.bore.traction.surface.ball.radius=%.17g", ring->inner);
    (void)snprintf(cell, sizeof cell, "domain.cell=%.17g", ring->cell);
    (void)snprintf(upper, sizeof upper, "domain.upper=[%.17g, %.17g]", width, width);
    (void)snprintf(held, sizeof held, "method.edge_penalty=%s", edges);
    (void)snprintf(with, sizeof with, "method.basis=%s", basis);
    const char *const set[] = {inner, outer, bore, cell, upper, held, with, "time.solver=static"};
    trial t;
    deck_begin(&t, "annulus_traction", set, 8);
    use_threads(1);
    trial_start(&t);
    trial_settle(&t, 10e-3);
    ring_sums s = {.ring = ring};
    visit_points(&t, 0, add_radial, &s);
    trial_end(&t);
    return s.error / s.size;
}

/* What edges hold unasked leaves small holes and thin walls as right as they are without, and thick ones far better. */
static void test_small_rings(void **unused)
{
    (void)unused;
    const ring_case rings[] = {{0.2, 0.4, 0.1, 1.1},        {0.2, 0.6, 0.1, 1.1},    {0.2, 1.4, 0.1, 1.1},
                               {0.15, 0.55, 0.1, 1.1},      {0.3, 0.6, 0.1, 0.6},    {0.9, 1.0, 0.05, 0.2},
                               {0.9, 1.0, 0.1 / 3.0, 0.25}, {0.5, 1.0, 0.1, 0.5},    {0.5, 1.0, 0.5 / 12.0, 0.2},
                               {0.43, 0.91, 0.105, 0.4},    {0.43, 0.91, 0.041, 0.3}};
    for (size_t k = 0; k < sizeof rings / sizeof *rings; ++k)
        for (int basis = 0; basis < 3; ++basis) {
            const char *const name[] = {"quadratic", "cubic", "gimp"};
            const double with = ring_error(&rings[k], name[basis], "null"),
                         without = ring_error(&rings[k], name[basis], "0");
            print_message("%s, %g to %g, h = %g: %.2f %% for %.2f %%\n", name[basis], rings[k].inner, rings[k].outer,
                          rings[k].cell, 100.0 * with, 100.0 * without);
            check_true(with <= (basis == 2 ? 1.0 : rings[k].most) * without);
        }
    const ring_case thick = {0.43, 0.91, 0.024, 1.0};
    check_true(ring_error(&thick, "quadratic", "null") <= 8e-3);
}

/* Points newly reach a node while the load grows: it is held at once. The error falls with h (28.8 and 13.3 %). */
static void test_new_nodes(void **unused)
{
    (void)unused;
    double error[2];
    for (int k = 0; k < 2; ++k) {
        const char *const set[] = {k ? "domain.cell=0.075" : "domain.cell=0.15", "method.basis=gimp",
                                   "method.edge_penalty=0.05", "coupling=ice-mpm"};
        trial t;
        deck_begin(&t, "pressurized_cylinder", set, 4);
        use_threads(1);
        coupled_start(&t);
        trial_settle(&t, 10e-3);
        stress_list s = {.value = calloc(mpm_count(t.sim->mpm), sizeof(double))};
        visit_points(&t, 0, add_stress, &s);
        error[k] = guilkey_eq13(s.n, s.value, 19.4e6, 0.5, 1.0);
        free(s.value);
        trial_end(&t);
    }
    print_message("gimp with gas: %.2f and %.2f %%\n", 100.0 * error[0], 100.0 * error[1]);
    check_true(error[1] <= 0.6 * error[0]);
}

static void add_radius(void *user, const fields *f, int body, size_t k)
{
    double *most = user;
    *most = fmax(*most, field_get(f, P_POS, body, 0)[k]);
}

/* A bar of copper spreads on a wall as far with held edges as without: what holds them flows as the copper does. */
static void test_flow(void **unused)
{
    (void)unused;
    double radius[2] = {0.0, 0.0};
    for (int k = 0; k < 2; ++k) {
        const char *const set[] = {k ? "method.edge_penalty=0.05" : "method.edge_penalty=0", "domain.cell=0.8 mm"};
        trial t;
        deck_begin(&t, "taylor_bar", set, 2);
        use_threads(1);
        trial_start(&t);
        trial_run(&t, 80e-6);
        visit_points(&t, 0, add_radius, &radius[k]);
        trial_end(&t);
    }
    print_message("radius %.3f mm held, %.3f mm free\n", 1e3 * radius[1], 1e3 * radius[0]);
    check_close(radius[1] / radius[0], 1.0, 0.03);
}

typedef struct mean_height {
    double moment, mass;
} mean_height;

static void add_height(void *user, const fields *f, int body, size_t k)
{
    mean_height *m = user;
    const double mass = field_get(f, P_MASS, body, 0)[k];
    m->moment += mass * field_get(f, P_POS, body, 1)[k];
    m->mass += mass;
}

/* A heavy cantilever two cells thick balances: by the elastica its middle sinks by 0.17256 of its length. Measured 4.3 % more, of which 4 % is the sum
 * over the two points a cell along its thickness; it diverged at a quarter of the load where nothing holds its edges. */
static void test_elastica(void **unused)
{
    (void)unused;
    const char *const set[] = {"time.solver=static", "time.increments=10"};
    mean_height before = {0.0, 0.0}, after = {0.0, 0.0};
    trial t;
    deck_begin(&t, "defaults/e6_cantilever", set, 2);
    use_threads(1);
    trial_start(&t);
    visit_points(&t, 0, add_height, &before);
    trial_settle(&t, 0.7);
    visit_points(&t, 0, add_height, &after);
    const double sunk = (before.moment / before.mass - after.moment / after.mass) / 2.0;
    print_message("elastica: middle sinks by %.5f\n", sunk);
    check_close_relative(sunk, 0.17256, 0.03);
    trial_end(&t);
}

/* ---- resuming ---- */

static void begin_resumed(trial *t, int blocks, int threads)
{
    const char *const set[] = {"domain.cell=0.1", "method.edge_penalty=0.05"};
    deck_begin(t, "annulus_traction", set, 2);
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = blocks;
    use_threads(threads);
    trial_start(t);
}

/* The same bits whether run through, or resumed with other blocks and threads. */
static void test_resume(void **unused)
{
    (void)unused;
    char folder[] = "/tmp/floe-test-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    (void)snprintf(path, sizeof path, "%s/checkpoint.h5", folder);
    const checkpoint_place place = checkpoint_place_make();
    trial t;
    begin_resumed(&t, 1, 1);
    check_ok(t.ctx, io_init(t.ctx));
    trial_steps(&t, 60);
    assert_true(largest_difference(&t) > 0.0);
    write_checkpoint(&t, place.path);
    trial_steps(&t, 40);
    state expected = trial_finish(&t);
    begin_resumed(&t, 2, 2);
    read_checkpoint(&t, place.path);
    trial_steps(&t, 40);
    state found = trial_finish(&t);
    same_state(&expected, &found);
    state_free(&expected);
    state_free(&found);
    checkpoint_place_remove(&place);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flight),   cmocka_unit_test(test_linear),      cmocka_unit_test(test_collision),
        cmocka_unit_test(test_cylinder), cmocka_unit_test(test_small_rings), cmocka_unit_test(test_new_nodes),
        cmocka_unit_test(test_flow),     cmocka_unit_test(test_elastica),    cmocka_unit_test(test_resume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
