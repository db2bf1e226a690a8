/* A scene does not know its units: with lengths, masses, times and temperatures by powers of two its results are the same bits, by
 * these powers. What differs has a constant with a dimension in it: a tolerance in metres, a floor in pascals. */
#include "metamorphic_fixture.h"
#include "scale_fixture.h"

/* Decks whose initial state goes through a power that is no root: the same to so much of the largest value of a field, not in bits. */
static const struct {
    const char *deck, *why;
    double most;
} known[] = {
    {"sedov", "the front starts at (E t^2/(alpha rho))^(1/(j+2))", 1e-12},
};

/* The power of two of number k of a part of the state. */
static int power_of(const mesh *m, const scaling *by, const char *part, size_t k)
{
    static const char *const clock[] = {"s", "s", "1", "s"}, *const account[] = {"kg", "kg m/s",  "kg m/s",  "kg m/s",
                                                                                 "J",  "kg m2/s", "kg m2/s", "kg m2/s"};
    if (strcmp(part, "clocks") == 0) return scale_power(by, clock[k]);
    const size_t quantity = k / (2 * LEDGER_KINDS); /* sums and what they carry; then counts */
    if (strcmp(part, "ledger") == 0) return quantity < LEDGER_QUANTITIES ? scale_held(m, by, account[quantity]) : 0;
    for (int id = 0; id < FIELD_COUNT; ++id)
        if (strcmp(field_describe((field_id)id)->name, part) == 0)
            return scale_held(m, by, field_describe((field_id)id)->unit);
    return 0;
}

typedef struct difference {
    size_t n;     /* numbers that are not the same bits */
    double worst; /* over the largest of its part */
    const char *part;
} difference;

/* Numbers so small are not counted: in other units they underflow. */
static const double vanishing = 1e-250;

static void differ_in_part(difference *d, const state *expected, const double *found, int p)
{
    const size_t start = expected->part[p].start,
                 end = p + 1 < expected->n_parts ? expected->part[p + 1].start : expected->n;
    double size = 0.0, apart = 0.0;
    for (size_t k = start; k < end; ++k) {
        const double a = expected->value[k], b = found[k];
        if (isfinite(a)) size = fmax(size, fabs(a));
        if (a == b || (isnan(a) && isnan(b)) || fmax(fabs(a), fabs(b)) < vanishing) continue;
        d->n++;
        apart = fmax(apart, isfinite(a) && isfinite(b) ? fabs(a - b) : (double)INFINITY);
    }
    if (!(apart > d->worst * size)) return;
    d->worst = apart / size;
    d->part = expected->part[p].name;
}

/* What was found in other units, told in the first ones, against what was expected. */
static difference differ(const mesh *m, const scaling *by, const state *expected, state *found)
{
    difference d = {0};
    if (expected->n != found->n) return (difference){expected->n, (double)INFINITY, "size"};
    for (int p = 0; p < expected->n_parts; ++p) {
        const size_t start = expected->part[p].start,
                     end = p + 1 < expected->n_parts ? expected->part[p + 1].start : expected->n;
        for (size_t k = start; k < end; ++k)
            found->value[k] = ldexp(found->value[k], -power_of(m, by, expected->part[p].name, k - start));
        differ_in_part(&d, expected, found->value, p);
    }
    return d;
}

/* Steps of a scene in other units, and whether all of them were taken; the simulation stays. */
static bool run_scaled(subject *s, const scaling *by, long steps, state *out)
{
    assert_true(subject_load(s));
    scale_scene(s->t.scene, by);
    if (!subject_start(s)) return false;
    const bool done = subject_steps(s, steps);
    check_ok(s->t.ctx, sim_update_ledger(s->t.sim));
    *out = state_of(s->t.sim);
    state_add_ledger(out, s->t.sim);
    return done;
}

static void judge(const subject *s, const difference *d, bool both, tally *count)
{
    count->runs++;
    if (d->n == 0 && both) {
        count->same++;
        return;
    }
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k)
        if (both && strcmp(s->deck, known[k].deck) == 0 && d->worst <= known[k].most) {
            count->known++;
            return;
        }
    count->wrong++;
    print_error("%s: %zu numbers differ, by up to %.2g of the largest of '%s'\n", subject_name(s), d->n, d->worst,
                d->part ? d->part : "");
}

static void check_units(subject *s, void *user, tally *count)
{
    static const scaling none = {0},
                         other[] = {{-20, -120, 10, -10}, {22, 36, 18, -4}}; /* even: roots of them are powers, too */
    const long steps = *(const long *)user;
    state expected = {0};
    const bool done = run_scaled(s, &none, steps, &expected);
    const bool has_formulas = s->t.scene && s->t.scene->n_formulas > 0; /* which are of SI themselves */
    subject_end(s);
    for (size_t k = 0; !has_formulas && k < (check_at_length() ? 2 : 1); ++k) {
        state found = {0};
        const bool as_well = run_scaled(s, &other[k], steps, &found) == done;
        const difference d = s->t.sim ? differ(&s->t.sim->mesh, &other[k], &expected, &found) : (difference){0};
        judge(s, &d, as_well, count);
        subject_end(s);
        state_free(&found);
    }
    state_free(&expected);
}

static void test_units(void **unused)
{
    (void)unused;
    long steps = check_at_length() ? 60 : 12;
    tally count = {0};
    check_decks(true, check_units, &steps, &count);
    print_tally("units", &count);
    assert_int_equal(count.wrong, 0);
    assert_int_equal(count.same + count.known, count.runs);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_units)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
