/* Every law of a reaction: finite rates that are not negative, none without reactant or up to its threshold, none that falls as it gets
 * hotter or the pressure rises; and, integrated, never more than there is, however stiff, the same from a solver that has been used.
 *
 * Parameters: the default where there is one; else 400 for a temperature, 1e-3 for a time, 1e6 for a rate, 0.1 for a speed, 0.8 for an exponent. */
#include "check.h"

#include "coupling/reaction.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PAR = 8 };

typedef struct law {
    const reaction_model *model;
    double par[MAX_PAR];
} law;

static double parameter(const param_spec *p)
{
    if (!isnan(p->fallback)) return p->fallback;
    if (strcmp(p->unit, "K") == 0) return 400.0;
    if (strcmp(p->unit, "s") == 0) return 1e-3;
    if (strcmp(p->unit, "1/s") == 0) return 1e6;
    if (strcmp(p->unit, "m/s") == 0) return 0.1;
    return 0.8;
}

static void on_each(void (*check)(const law *))
{
    check_true(reaction_registry_size > 0);
    for (size_t i = 0; i < reaction_registry_size; i++) {
        law a = {.model = reaction_registry[i]};
        assert_true(a.model->param_size <= sizeof a.par);
        assert_ptr_equal(reaction_find(a.model->name), a.model);
        assert_true(a.model->doc && a.model->cite && a.model->cite[0]);
        for (size_t k = 0; k < a.model->n_params; k++) {
            const param_spec *p = &a.model->params[k];
            check_true(param_in_range(p, parameter(p)));
            *(double *)(void *)((char *)a.par + p->offset) = parameter(p);
        }
        check(&a);
    }
    assert_null(reaction_find("no such law"));
}

static reaction_state state(double reactant, double T, double p)
{
    return (reaction_state){.reactant = reactant,
                            .product = 0.5,
                            .density = 1600.0,
                            .T = T,
                            .p = p,
                            .surface = reactant > 0.0 ? 30.0 : 0.0};
}

static double rate(const law *a, double reactant, double T, double p)
{
    const reaction_state s = state(reactant, T, p);
    return a->model->rate(a->par, &s);
}

static void check_rates(const law *a)
{
    for (double T = 1.0; T < 1e5; T *= 2.0)
        for (double p = 1e-3; p < 1e12; p *= 10.0) {
            const double here = rate(a, 3.0, T, p);
            check_true(isfinite(here) && here >= 0.0);
            check_true(rate(a, 3.0, 2.0 * T, p) >= here && rate(a, 3.0, T, 10.0 * p) >= here);
            check_close(rate(a, 0.0, T, p), 0.0, 0.0);
        }
    check_true(rate(a, 3.0, 1e4, 1e8) > 0.0);
    double par[MAX_PAR];
    memcpy(par, a->par, sizeof par);
    double *threshold = param_find(a->model->params, a->model->n_params, par, "threshold");
    if (!threshold) return;
    *threshold = 500.0;
    const reaction_state below = state(3.0, 499.0, 1e6), at = state(3.0, 500.0, 1e6), above = state(3.0, 501.0, 1e6);
    check_close(a->model->rate(par, &below), 0.0, 0.0);
    check_close(a->model->rate(par, &at), 0.0, 0.0);
    check_close(a->model->rate(par, &above), rate(a, 3.0, 501.0, 1e6), 0.0);
}

static void rates(void **unused)
{
    (void)unused;
    on_each(check_rates);
}

static void check_bounds(const law *a)
{
    context *ctx = context_create();
    const reaction one = {a->model, a->par, 0, 1, 1e6};
    reaction_solver *used, *fresh;
    check_ok(ctx, reaction_create(&used, ctx, 1, &one));
    double last = 0.0;
    for (double dt = 1e-9; dt < 2e3; dt *= 100.0) {
        const reaction_cell cell = {.n = 2,
                                    .rho = {3.0, 0.5},
                                    .e = {1e6, 1e6},
                                    .T = {1000.0, 1000.0},
                                    .cv = {1000.0, 1000.0},
                                    .density = {1600.0, 1.0},
                                    .surface = {30.0},
                                    .p = 1e6};
        double reacted, again;
        check_true(reaction_integrate(used, &cell, dt, &reacted));
        check_true(reacted > 0.0 && reacted <= 3.0);
        check_true(reacted >= last * (1.0 - 1e-7));
        last = reacted;
        check_ok(ctx, reaction_create(&fresh, ctx, 1, &one));
        check_true(reaction_integrate(fresh, &cell, dt, &again));
        check_close(again, reacted, 0.0); /* not a bit depends on what it solved before */
        reaction_destroy(ctx, &fresh);
    }
    check_close(last, 3.0, 1e-10);
    reaction_destroy(ctx, &used);
    context_destroy(&ctx);
}

static void bounds(void **unused)
{
    (void)unused;
    on_each(check_bounds);
}

/* Two reactions of one reactant, both without end: what there is is shared as their rates are, and no more. */
static void shared_reactant(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    const reaction_model *m = reaction_find("threshold");
    assert_non_null(m);
    double fast[MAX_PAR] = {0.0}, slow[MAX_PAR] = {0.0};
    param_fill_defaults(m->params, m->n_params, fast);
    param_fill_defaults(m->params, m->n_params, slow);
    *param_find(m->params, m->n_params, fast, "temperature") =
        *param_find(m->params, m->n_params, slow, "temperature") = 300.0;
    *param_find(m->params, m->n_params, fast, "time") = 1e-6;
    *param_find(m->params, m->n_params, slow, "time") = 3e-6;
    const reaction both[2] = {{m, fast, 0, 1, 0.0}, {m, slow, 0, 2, 0.0}};
    reaction_solver *s;
    check_ok(ctx, reaction_create(&s, ctx, 2, both));
    const reaction_cell cell = {.n = 3,
                                .rho = {4.0},
                                .e = {1e6, 1e6, 1e6},
                                .T = {1e3, 1e3, 1e3},
                                .cv = {1e3, 1e3, 1e3},
                                .density = {1.0, 1.0, 1.0},
                                .p = 1e5};
    double reacted[2];
    check_true(reaction_integrate(s, &cell, 1.0, reacted));
    check_close(reacted[0] + reacted[1], 4.0, 1e-14);
    check_close(reacted[0], 3.0, 1e-6);
    reaction_destroy(ctx, &s);
    context_destroy(&ctx);
}

/* The two orders of Bogacki and Shampine's pair apart, of a unit that decays over a step z: the weights of the second order are 7/24, 1/4, 1/3, 1/8. */
static double reacted_apart(double z)
{
    const double k1 = 1.0, k2 = 1.0 - 0.5 * z * k1, k3 = 1.0 - 0.75 * z * k2;
    const double third = z * (2.0 * k1 + 3.0 * k2 + 4.0 * k3) / 9.0, k4 = 1.0 - third;
    return fabs(third - z * (7.0 / 24.0 * k1 + 0.25 * k2 + k3 / 3.0 + 0.125 * k4));
}

/* What decays at a fixed rate is known: a short step is one of the third order, whose error estimate lets it pass and whose sum is that of the
 * exponential's first terms, to round-off; over a longer one the estimate is too large, and the exponential itself is found to the tolerance. */
static void decay(void **unused)
{
    (void)unused;
    context *ctx = context_create();
    const reaction_model *m = reaction_find("threshold");
    double par[MAX_PAR] = {0.0};
    assert_non_null(m);
    *param_find(m->params, m->n_params, par, "temperature") = 300.0;
    *param_find(m->params, m->n_params, par, "time") = 1.0;
    const reaction one = {m, par, 0, 1, 0.0};
    reaction_solver *s;
    check_ok(ctx, reaction_create(&s, ctx, 1, &one));
    for (double z = 1e-5; z < 0.5; z *= 1.3) {
        const reaction_cell cell = {
            .n = 2, .rho = {4.0}, .e = {1e6, 1e6}, .T = {1e3, 1e3}, .cv = {1e3, 1e3}, .density = {1.0, 1.0}, .p = 1e5};
        double reacted;
        check_true(reaction_integrate(s, &cell, z, &reacted));
        const double terms = 4.0 * z * (1.0 - z * (0.5 - z / 6.0)), exact = -4.0 * expm1(-z);
        const double estimate = reacted_apart(z) / (1e-9 * z + 1e-13);
        if (estimate < 0.99) check_close_relative(reacted, terms, 4e-15);
        if (estimate > 1.01) check_true(fabs(reacted / terms - 1.0) > 1e-14);
        check_close_relative(reacted, exact, 2e-8);
    }
    reaction_destroy(ctx, &s);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decay),
        cmocka_unit_test(rates),
        cmocka_unit_test(bounds),
        cmocka_unit_test(shared_reactant),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
