/* Allocations of a program that steps a deck fail, at any place and all that follow: FLOE_NO_MEMORY with a message, and
 * nothing left. */
#include "check.h"

#include "base/memory.h"
#include "library/library_internal.h"

#include <stdlib.h>
#include <string.h>

static floe_status use_simulation(floe_simulation *s, const char *path)
{
    double to[2048];
    size_t n;
    floe_totals sum;
    TRY(floe_step(s, floe_end_time(s)));
    TRY(floe_copy_field(s, "points/left/stress_xx", NULL, 0, &n));
    assert_true(n <= 2048);
    TRY(floe_copy_field(s, "points/left/stress_xx", to, n, NULL));
    TRY(floe_sum(s, &sum));
    TRY(floe_save(s, path));
    TRY(floe_step(s, floe_end_time(s)));
    TRY(floe_restore(s, path));
    assert_int_equal(floe_step_count(s), 1);
    return floe_step(s, floe_end_time(s));
}

/* What was there before a failed restore is there after it. */
static floe_status attempt(floe_context *floe, const char *path)
{
    static const char *const set[] = {"coupling=mpm", "domain.cell=0.1"};
    const floe_parameter parameter = {.key = "density", .range = FLOE_POSITIVE, .count = 1};
    floe_solid_law law = {.size = sizeof law,
                          .name = "other",
                          .parameter_size = sizeof(double),
                          .parameters = &parameter,
                          .n_parameters = 1,
                          .stress = solid_find("linear_elastic")->stress,
                          .wave_speed = solid_find("linear_elastic")->wave_speed,
                          .bulk_modulus = solid_find("linear_elastic")->bulk_modulus,
                          .shear_modulus = solid_find("linear_elastic")->shear_modulus};
    floe_deck *deck = NULL;
    floe_simulation *s = NULL;
    floe_status status = floe_add_solid_law(floe, &law);
    if (status == FLOE_OK) status = floe_load(floe, FLOE_SOURCE_DIR "/inputs/sod.yaml", set, 2, &deck);
    if (status == FLOE_OK) status = floe_simulation_create(deck, NULL, &s);
    if (status == FLOE_OK) status = use_simulation(s, path);
    if (s) check_true(floe_time(s) >= 0.0);
    floe_simulation_destroy(&s);
    floe_deck_destroy(&deck);
    return status;
}

static void any_allocation_may_fail(void **state)
{
    (void)state;
    char dir[] = "/tmp/floe_test_XXXXXX", path[64], command[64];
    floe_status status = FLOE_NO_MEMORY;
    uint64_t tries = 0;
    assert_non_null(mkdtemp(dir));
    (void)snprintf(path, sizeof path, "%s/state.h5", dir);
    assert_int_equal(floe_init(), FLOE_OK);
    /* The first ones, of the library itself, one by one; most of the rest are of decks, whose own test fails each. */
    for (uint64_t n = 1; status == FLOE_NO_MEMORY; n += 1 + n / 32, tries++) {
        floe_context *floe = floe_create();
        assert_non_null(floe);
        memory_inject_failure(floe->ctx, n);
        status = attempt(floe, path);
        memory_inject_failure(floe->ctx, 0);
        if (status != FLOE_OK) {
            assert_int_equal(status, FLOE_NO_MEMORY);
            check_true(floe_message(floe)[0] != '\0');
        }
        library_clear_messages(floe);
        const uint64_t own = sizeof *floe + LIBRARY_MAX_LAWS * sizeof *floe->law + sizeof(param_spec);
        check_true(memory_read_account(floe->ctx).live_bytes <= own);
        floe_destroy(&floe);
    }
    check_true(tries > 50);
    assert_int_equal(status, FLOE_OK);
    (void)snprintf(command, sizeof command, "rm -rf '%s'", dir);
    assert_int_equal(system(command), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(any_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
