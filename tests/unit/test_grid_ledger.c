/* The ledger: entries of a step count once it is final, sums do not lose the small, drifts are shares of the whole. */
#include "check.h"
#include "grid/ledger.h"

#include <math.h>
#include <string.h>

/* An account of 1 kg m/s along x and next to none along y. */
static void open_account(ledger *l)
{
    memset(l, 0, sizeof *l);
    l->initial[LEDGER_MOMENTUM_X] = l->total[LEDGER_MOMENTUM_X] = l->scale[LEDGER_MOMENTUM_X] = 1.0;
    l->scale[LEDGER_MOMENTUM_Y] = 1e-18;
}

static void a_rejected_step_leaves_nothing(void **state)
{
    (void)state;
    ledger l;
    open_account(&l);
    ledger_add(&l, LEDGER_MOMENTUM_X, LEDGER_SOURCE, 0.5);
    ledger_tally(&l, COUNT_FLOORS, 3);
    ledger_discard(&l);
    ledger_commit(&l);
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_X), 0.0, 0.0);
    assert_int_equal(l.count[COUNT_FLOORS], 0);
    ledger_add(&l, LEDGER_MOMENTUM_X, LEDGER_SOURCE, 0.5);
    ledger_tally(&l, COUNT_FLOORS, 3);
    ledger_commit(&l);
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_X), 0.5, 0.0);
    assert_int_equal(l.count[COUNT_FLOORS], 3);
    l.total[LEDGER_MOMENTUM_X] = 1.5;
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_X), 0.0, 0.0);
}

/* A million entries of 1e-12, each below what 1e5 can hold to half of itself, are 1e-6. */
static void small_entries_are_not_lost(void **state)
{
    (void)state;
    ledger l;
    open_account(&l);
    ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, 1e5);
    ledger_commit(&l);
    for (int i = 0; i < 1000000; i++) {
        ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, 1e-12);
        ledger_commit(&l);
    }
    const ledger_sum *sum = &l.entry[LEDGER_ENERGY][LEDGER_SOURCE];
    check_close((sum->value - 1e5) + sum->carry, 1e-6, 1e-15);
}

/* Along an axis that is at rest, round-off is a share of the momentum there is, and not all of its own. */
static void momentum_is_one_vector(void **state)
{
    (void)state;
    ledger l;
    open_account(&l);
    l.total[LEDGER_MOMENTUM_Y] = 1e-18;
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_Y), 1e-18, 1e-33);
    l.total[LEDGER_MOMENTUM_Z] = 1e-3;
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_Z), 1e-3, 1e-18);
    l.scale[LEDGER_ENERGY] = 1e-30;
    l.total[LEDGER_ENERGY] = 1e-30;
    check_close(ledger_drift(&l, LEDGER_ENERGY), 1.0, 0.0);
    l.not_conserved[LEDGER_MOMENTUM_Z] = true;
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_Z), 0.0, 0.0);
}

/* A scene at rest with 2 J and 3 kg. */
static ledger_state some_state(void)
{
    ledger_state now = {.motion = 2.0};
    now.total[LEDGER_MASS] = now.extent[LEDGER_MASS] = 3.0;
    now.total[LEDGER_ENERGY] = now.extent[LEDGER_ENERGY] = 2.0;
    return now;
}

/* Moments have the scale of the momenta that there can be, at the farthest; a look without them leaves them alone, and where an axis of
 * their plane is periodic, or a radius, they have no account. */
static void moments_are_kept_apart(void **state)
{
    (void)state;
    ledger l = {0};
    mesh m = {.dim = 3, .upper = {6.0, 0.0, 8.0}, .periodic = {true, false, false}};
    const double x[3] = {2.0, 3.0, 5.0};
    ledger_choose(&l, &m);
    assert_true(!l.not_conserved[LEDGER_MOMENT_X] && l.not_conserved[LEDGER_MOMENT_Y] &&
                l.not_conserved[LEDGER_MOMENT_Z]);
    check_close(l.arm, 5.0, 1e-15);
    m = (mesh){.dim = 2, .geometry = MESH_AXISYMMETRIC};
    ledger_choose(&l, &m);
    assert_true(l.not_conserved[LEDGER_MOMENTUM_X] && !l.not_conserved[LEDGER_MOMENTUM_Y] &&
                l.not_conserved[LEDGER_MOMENT_Z]);
    l = (ledger){.arm = 2.0};
    ledger_state now = some_state();
    now.turns = true;
    now.extent[LEDGER_MOMENT_Z] = 100.0; /* more than 2 (2 m E)^1/2 */
    ledger_open(&l, &now, 0.0);
    /* x x J of (7, 11, 13) */
    ledger_push(&l, LEDGER_BOUNDARY, 0, 7.0, x);
    ledger_push(&l, LEDGER_BOUNDARY, 1, 11.0, x);
    ledger_push(&l, LEDGER_BOUNDARY, 2, 13.0, x);
    ledger_commit(&l);
    check_close(l.entry[LEDGER_MOMENT_X][LEDGER_BOUNDARY].value, 3.0 * 13.0 - 5.0 * 11.0, 1e-15);
    check_close(l.entry[LEDGER_MOMENT_Y][LEDGER_BOUNDARY].value, 5.0 * 7.0 - 2.0 * 13.0, 1e-15);
    check_close(l.entry[LEDGER_MOMENT_Z][LEDGER_BOUNDARY].value, 2.0 * 11.0 - 3.0 * 7.0, 1e-15);
    check_close(l.entry[LEDGER_MOMENTUM_Y][LEDGER_BOUNDARY].value, 11.0, 0.0);
    now.total[LEDGER_MOMENT_Z] = 3.0;
    ledger_look(&l, &now, 1.0);
    check_close(ledger_drift(&l, LEDGER_MOMENT_Z), 2.0 / (2.0 * sqrt(2.0 * 3.0 * 2.0)), 1e-14);
    now.turns = false;
    now.total[LEDGER_MOMENT_Z] = 9.0;
    ledger_look(&l, &now, 2.0);
    check_close(l.total[LEDGER_MOMENT_Z], 3.0, 0.0);
    check_close(l.worst_time[LEDGER_MOMENT_Z], 1.0, 0.0);
}

/* An error does not make itself small by growing, and what a run has once shown stays. */
static void the_scale_does_not_grow_with_the_error(void **state)
{
    (void)state;
    ledger l = {0};
    ledger_state now = some_state();
    ledger_open(&l, &now, 0.0);
    now.total[LEDGER_ENERGY] = now.extent[LEDGER_ENERGY] = now.motion = 19.2;
    now.total[LEDGER_MOMENTUM_X] = 5.0;
    now.extent[LEDGER_MOMENTUM_X] = 10.0;
    ledger_look(&l, &now, 0.5);
    check_close(ledger_drift(&l, LEDGER_ENERGY), 8.6, 1e-14);
    check_close(ledger_drift(&l, LEDGER_MOMENTUM_X), 5.0 / sqrt(2.0 * 3.0 * 2.0), 1e-14);
    now = some_state();
    ledger_look(&l, &now, 1.0);
    check_close(ledger_drift(&l, LEDGER_ENERGY), 0.0, 0.0);
    check_close(ledger_largest_drift(&l, LEDGER_ENERGY), 8.6, 1e-14);
    check_close(l.worst_time[LEDGER_ENERGY], 0.5, 0.0);
    check_close(l.motion.available, 2.0, 0.0);
    /* What comes in is what an error is small beside; what goes out again does not count against it. */
    ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, 6.0);
    ledger_commit(&l);
    now.total[LEDGER_ENERGY] = now.motion = 7.0;
    ledger_look(&l, &now, 2.0);
    check_close(ledger_drift(&l, LEDGER_ENERGY), 1.0 / 8.0, 1e-15);
    ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, -6.0);
    ledger_commit(&l);
    now.total[LEDGER_ENERGY] = now.motion = 1.0;
    ledger_look(&l, &now, 3.0);
    check_close(ledger_drift(&l, LEDGER_ENERGY), 1.0 / 8.0, 1e-15);
    check_close(l.motion.available, 8.0, 1e-15);
    now.total[LEDGER_ENERGY] = (double)NAN;
    ledger_look(&l, &now, 4.0);
    now.total[LEDGER_ENERGY] = 2.0;
    ledger_look(&l, &now, 5.0);
    assert_true(isnan(ledger_largest_drift(&l, LEDGER_ENERGY)));
}

/* Of a moment of momentum, what walls give counts for the share that is reported, and not for the drift. */
static void walls_turn_for_as_long_as_they_do(void **state)
{
    (void)state;
    ledger l = {0};
    ledger_state now = some_state();
    now.turns = true;
    l.arm = 1.0;
    ledger_open(&l, &now, 0.0);
    ledger_add(&l, LEDGER_MOMENT_Z, LEDGER_BOUNDARY, 40.0);
    ledger_add(&l, LEDGER_MOMENT_Z, LEDGER_SOURCE, -41.0);
    ledger_commit(&l);
    now.extent[LEDGER_MOMENT_Z] = 2.0;
    ledger_look(&l, &now, 1.0);
    check_close(ledger_largest_drift(&l, LEDGER_MOMENT_Z), 1.0 / 2.0, 1e-15);
    check_close(ledger_largest_share(&l, LEDGER_MOMENT_Z), 1.0 / 40.0, 1e-15);
    check_close(ledger_largest_share(&l, LEDGER_ENERGY), ledger_largest_drift(&l, LEDGER_ENERGY), 0.0);
}

/* Of a solid of 1 kg with a speed of sound of 10 m/s, that is at rest but for round-off. */
static void round_off_at_rest_is_no_drift(void **state)
{
    (void)state;
    ledger l = {0};
    ledger_state now = {.motion = 0.0};
    now.total[LEDGER_MASS] = now.extent[LEDGER_MASS] = 1.0;
    ledger_open(&l, &now, 100.0);
    now.total[LEDGER_ENERGY] = now.extent[LEDGER_ENERGY] = now.motion = 1e-30;
    now.total[LEDGER_MOMENTUM_Y] = now.extent[LEDGER_MOMENTUM_Y] = 1e-16;
    ledger_look(&l, &now, 1.0);
    assert_true(ledger_drift(&l, LEDGER_ENERGY) < 1e-11);
    assert_true(ledger_drift(&l, LEDGER_MOMENTUM_Y) < 1e-6);
    now.total[LEDGER_ENERGY] = 1e-12; /* a strain of 1e-7 is one */
    ledger_look(&l, &now, 2.0);
    assert_true(ledger_drift(&l, LEDGER_ENERGY) > 1.0);
}

/* Fluxes through open sides are entries, and no drift: motion that could not be is what shows that they feed it. */
static void sides_that_feed_motion_show(void **state)
{
    (void)state;
    for (int known = 0; known < 2; ++known) {
        ledger l = {0};
        ledger_state now = {.motion = 1.0};
        now.total[LEDGER_ENERGY] = now.extent[LEDGER_ENERGY] = 100.0;
        ledger_open(&l, &now, 0.0);
        if (known) l.motion.stored = 4.0;
        now.motion = 7.0;
        ledger_look(&l, &now, 1.0);
        assert_false(ledger_is_fed(&l));
        now.motion = 8.0;
        now.total[LEDGER_ENERGY] = 110.0;
        ledger_add(&l, LEDGER_ENERGY, LEDGER_BOUNDARY, 10.0);
        ledger_commit(&l);
        ledger_look(&l, &now, 2.0);
        now.motion = 1.0; /* it has left: the most counts */
        ledger_look(&l, &now, 3.0);
        assert_true(ledger_is_fed(&l) == known);
        ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, 10.0); /* what sources bring may move */
        ledger_commit(&l);
        ledger_look(&l, &now, 4.0);
        assert_false(ledger_is_fed(&l));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rejected_step_leaves_nothing),
        cmocka_unit_test(small_entries_are_not_lost),
        cmocka_unit_test(momentum_is_one_vector),
        cmocka_unit_test(moments_are_kept_apart),
        cmocka_unit_test(the_scale_does_not_grow_with_the_error),
        cmocka_unit_test(walls_turn_for_as_long_as_they_do),
        cmocka_unit_test(round_off_at_rest_is_no_drift),
        cmocka_unit_test(sides_that_feed_motion_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
