/* The pressurised cylinder of Guilkey et al. 2003 against Lame, from its deck: errors of eq. 13 in both couplings, the gas's
 * pressure, and the slope with the paper's settings. */
#include "check.h"

#include "floe/floe.h"
#include "verify/order.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

enum { MAX_SET = 8 };

typedef struct answer {
    double eq13, gas, sigma_r, steps;
} answer;

/* Removes what a run has written into `folder`. */
static void clear_folder(const char *folder)
{
    char command[256];
    (void)snprintf(command, sizeof command, "rm -rf -- '%s'", folder);
    assert_int_equal(system(command), 0);
}

static answer run(const char *coupling, double h, size_t n_set, const char *const *more)
{
    char folder[] = "/tmp/floe-test-XXXXXX", cell[32], how[32];
    const char *set[MAX_SET] = {cell, how};
    assert_non_null(mkdtemp(folder));
    (void)snprintf(cell, sizeof cell, "domain.cell=%g", h);
    (void)snprintf(how, sizeof how, "coupling=%s", coupling);
    for (size_t k = 0; k < n_set; ++k) set[2 + k] = more[k];
    floe_context *floe = floe_create();
    floe_deck *deck;
    floe_run *r;
    assert_int_equal(floe_init(), FLOE_OK);
    if (floe_load(floe, FLOE_SOURCE_DIR "/inputs/pressurized_cylinder.yaml", set, 2 + n_set, &deck) != FLOE_OK ||
        floe_execute(deck, &(floe_options){.directory = folder, .threads = 1}, &r) != FLOE_OK) {
        print_error("%s\n", floe_message(floe));
        check_true(!"the cylinder runs");
    }
    assert_string_equal(floe_run_status(r), "at_rest");
    const answer a = {.eq13 = floe_value(r, "errors.eq13"),
                      .gas = floe_value(r, "errors.rel_gas_pressure"),
                      .sigma_r = floe_value(r, "errors.l1_sigma_r"),
                      .steps = floe_value(r, "steps")};
    check_true(a.gas <= 1.5e-5);
    check_true(floe_value(r, "conservation.mass") <= 1e-15);
    check_true(floe_value(r, "conservation.momentum") <= 3e-12);
    print_message("%-8s h = %-6g eq. 13: %.2f %%, L1 of sigma_r %.3g Pa, gas %.2e, %g steps, drifts: mass %.1e, "
                  "momentum %.1e, energy %.1e, %.2f s\n",
                  coupling, h, 100.0 * a.eq13, a.sigma_r, a.gas, a.steps, floe_value(r, "conservation.mass"),
                  floe_value(r, "conservation.momentum"), floe_value(r, "conservation.energy"),
                  floe_value(r, "wall_seconds"));
    floe_run_destroy(&r);
    floe_deck_destroy(&deck);
    floe_destroy(&floe);
    clear_folder(folder);
    return a;
}

/* With floe's defaults: a third to four fifths above what is measured (2.4 and 0.39 %, 2.5 and 0.36 %), and so below what a pressure on the
 * solid that is 1 % wrong makes of the finer mesh; likewise with the smeared interface (5.5 and 1.04 %). */
static void test_defaults(void **state)
{
    (void)state;
    static const char *const coupling[] = {"ice-mpm", "mpm"};
    for (int c = 0; c < 2; ++c) {
        check_true(run(coupling[c], 0.1, 0, NULL).eq13 <= 0.035);
        check_true(run(coupling[c], 0.05, 0, NULL).eq13 <= 0.007);
    }
    static const char *const smeared[] = {"method.interface=smeared"};
    check_true(run("ice-mpm", 0.1, 1, smeared).eq13 <= 0.08);
    if (check_at_length())
        check_true(run("ice-mpm", 0.05, 1, smeared).eq13 <= 0.015); /* the paper's settings below are smeared too */
}

/* With the paper's settings, the linear basis and 2x2 points on a lattice: first order, 0.89 within two standard errors. */
static void test_paper(void **state)
{
    (void)state;
    static const char *const paper[] = {"method.basis=linear", "method.interface=smeared",
                                        "bodies.cylinder.seeding=lattice"};
    const bool all = check_at_length();
    const double h[] = {all ? 0.025 : 0.2, 0.1, all ? 0.05 : 0.08};
    double error[3];
    for (int k = 0; k < 3; ++k) {
        error[k] = run("ice-mpm", h[k], 3, paper).eq13;
        check_true(error[k] <= 2.5 * h[k]); /* 38.3, 20.1 and 16.5 % are measured */
    }
    order_fit fit;
    context *ctx = context_create();
    check_ok(ctx, order_fit_power(ctx, 3, h, error, &fit));
    context_destroy(&ctx);
    print_message("slope %.3f +- %.3f\n", fit.order, fit.standard_error);
    check_true(fit.order >= 0.89 - 2.0 * fit.standard_error);
    check_true(fit.standard_error <= (all ? 0.04 : 0.012)); /* the order rises from 0.88 to 0.965: 0.024 is measured */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_paper),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
