/* Membranes around gas, solved for: against exact rests, and for the same bits whatever the blocks. */
#include "coupled_fixture.h"

/* What gas of energy p0 V0/(gamma - 1) and a membrane come to (verify/reference/reference_membrane_rest.c has the equations): a circle, or a sphere (k 1,
 * 2), of which a share is in the scene. */
typedef struct rest_case {
    const char *deck;
    scene_coupling coupling;
    int k; /* 1: circle; 2: sphere, of constant volume */
    double share, length, thickness, modulus, pressure, volume;
    size_t n_set;
    const char *set[4];
    double tolerance;     /* of radius and pressure */
    long long iterations; /* at most: a quarter more than measured, of a tangent that is that of the forces */
} rest_case;

typedef struct rest_state {
    double radius, pressure;
} rest_state;

static const double pi = 3.14159265358979323846;

/* The energy at rest at a radius, less that at the start. */
static double excess(const rest_case *c, double r, double *pressure)
{
    const double strain = log(r / c->length), thin = c->k == 2 ? pow(r / c->length, -2.0) : 1.0;
    const double surface = 2.0 * c->k * pi * c->share, volume = surface * pow(r, c->k + 1) / (c->k + 1);
    *pressure = c->k * c->modulus * strain * c->thickness * thin / r;
    return *pressure * volume / 0.4 +
           0.5 * c->k * c->modulus * strain * strain * surface * pow(c->length, c->k) * c->thickness -
           c->pressure * c->volume / 0.4;
}

static rest_state rest_of(const rest_case *c)
{
    rest_state s;
    double lo = c->length, hi = 1.5 * c->length;
    for (int n = 0; n < 200; ++n) {
        s.radius = 0.5 * (lo + hi);
        *(excess(c, s.radius, &s.pressure) > 0.0 ? &hi : &lo) = s.radius;
    }
    return s;
}

/* Measured: the dog-bone's radius 3e-5 and pressure 1.4e-4 off with 56 points, 1e-5 and 4e-5 with 100 (second order); the balloon's 2e-4 and 4e-6. As
 * ice-mpm the dog-bone has some thin gas more, of 3e-4 of the energy. */
static const rest_case cases[] = {
    {"membrane_circle",
     COUPLING_MPM,
     1,
     0.25,
     0.5,
     0.1,
     1e6 / 0.91,
     1000.0,
     0.04908738521234052 * 4.0,
     0,
     {0},
     2e-4,
     16},
    {"membrane_dogbone",
     COUPLING_MPM,
     1,
     0.25,
     1.400034,
     0.1,
     1e6 / 0.91,
     100.0,
     0.4746286,
     2,
     {"domain.cell=0.4", "bodies.skin.membrane.number=56"},
     3e-4,
     610},
    {"membrane_dogbone",
     COUPLING_ICE_MPM,
     1,
     0.25,
     1.400034,
     0.1,
     1e6 / 0.91,
     100.0,
     0.4746286,
     2,
     {"domain.cell=0.2", "bodies.skin.membrane.number=100"},
     1e-3,
     750},
    {"membrane_balloon",
     COUPLING_MPM,
     2,
     0.5 / (2.0 * pi),
     0.5,
     0.1,
     5e4 / 0.7,
     1000.0,
     0.5 * 4.0 / 3.0 * pi * 0.125 / (2.0 * pi),
     1,
     {"bodies.skin.membrane.strain=positions"},
     4e-4,
     50},
};

static void start_case(trial *t, const rest_case *c, int blocks)
{
    const char *set[6] = {"time.solver=static"};
    for (size_t k = 0; k < c->n_set; ++k) set[1 + k] = c->set[k];
    deck_begin(t, c->deck, set, 1 + c->n_set);
    t->scene->coupling = c->coupling;
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = blocks;
    coupled_start(t);
    trial_run(t, t->scene->time.end);
}

static int membrane_in(const trial *t)
{
    for (int b = 0; b < t->sim->mpm->n_bodies; ++b)
        if (!t->sim->mpm->body[b].fluid) return b;
    return -1;
}

static double pressure_in(trial *t, const membrane_enclosure *enclosure)
{
    double pressure;
    if (!t->sim->ice) return enclosure->pressure;
    check_ok(t->ctx, ice_mean_pressure(t->sim->ice, 0, NULL, &pressure));
    return pressure;
}

static void exact_rests(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        trial t;
        membrane_enclosure enclosure;
        double first[3], last[3];
        const rest_state wanted = rest_of(&cases[k]);
        start_case(&t, &cases[k], 1);
        mpm_membrane_enclosure(t.sim->mpm, membrane_in(&t), &enclosure);
        mpm_membrane_end(t.sim->mpm, membrane_in(&t), false, first);
        mpm_membrane_end(t.sim->mpm, membrane_in(&t), true, last);
        const double a = hypot(first[0], first[1]) / wanted.radius - 1.0,
                     b = hypot(last[0], last[1]) / wanted.radius - 1.0;
        const double pressure = pressure_in(&t, &enclosure) / wanted.pressure - 1.0;
        print_message("%s: radius off by %.1e and %.1e, pressure by %.1e, energy by %.1e; %lld iterations\n",
                      cases[k].deck, a, b, pressure, ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY),
                      t.sim->ledger.count[COUNT_BALANCE_ITERATIONS]);
        check_true(fabs(a) <= cases[k].tolerance && fabs(b) <= cases[k].tolerance);
        check_true(fabs(pressure) <= cases[k].tolerance);
        check_true(enclosure.outside == 0.0);
        check_true(t.sim->ledger.count[COUNT_BALANCE_ITERATIONS] <= cases[k].iterations);
        check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MASS) <= 1e-13);
        check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <=
                   2e-6); /* the balloon's 8e-7: its ends are coarse */
        trial_end(&t);
    }
}

static void same_bits(void **unused)
{
    (void)unused;
    for (int k = 0; k < 2; ++k) {
        trial t;
        rest_case c = cases[2];
        c.coupling = k ? COUPLING_MPM : COUPLING_ICE_MPM;
        start_case(&t, &c, 1);
        state expected = trial_finish(&t);
        start_case(&t, &c, 2);
        state found = trial_finish(&t);
        same_state(&expected, &found);
        state_free(&found);
        state_free(&expected);
    }
}

/* What is no line around gas. */
static void others_are_refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *deck, *why;
    } other[] = {
        {"airbag_200", "strain: positions"}, {"piston_membrane", "springs"}, {"membrane_sphere", "strain: positions"}};
    for (size_t k = 0; k < sizeof other / sizeof *other; ++k) {
        const char *const set[] = {"time.solver=static"};
        trial t;
        deck_begin(&t, other[k].deck, set, 1);
        const floe_status status = sim_create(&t.sim, t.ctx, t.scene, t.scene->coupling);
        assert_non_null(strstr(context_message(t.ctx), other[k].why));
        check_fails(t.ctx, status, FLOE_BAD_INPUT);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_rests),
        cmocka_unit_test(same_bits),
        cmocka_unit_test(others_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
