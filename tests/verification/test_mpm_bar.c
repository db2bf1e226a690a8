/* A clamped bar in its first mode (Landau and Lifshitz, section 25), 1-D, FLIP: order in the spacing and in the step, and what
 * the stress schemes do to the energy. */
#include "exact_values.h"
#include "mpm_fixture.h"
#include "order_fixture.h"

static const double length = 1.0, modulus = 4.0, density = 1.0, amplitude = 1e-4;

typedef struct bar {
    const char *basis;
    stress_scheme stress;
    double h, step; /* step NAN: from the wave speed */
    double periods;
    double free_end;
} bar;

typedef struct reading {
    const exact *exact;
    double time, *start; /* m, by id */
    norm displacement;
} reading;

static void keep_start(void *user, const fields *f, int body, size_t k)
{
    reading *r = user;
    r->start[(size_t)field_get(f, P_ID, body, 0)[k]] = field_get(f, P_POS, body, 0)[k];
}

static void add_error(void *user, const fields *f, int body, size_t k)
{
    reading *r = user;
    const double X[3] = {r->start[(size_t)field_get(f, P_ID, body, 0)[k]]};
    norm_add(&r->displacement, field_get(f, P_POS, body, 0)[k] - X[0],
             exact_value(r->exact, EXACT_DISPLACEMENT_X, X, r->time), field_get(f, P_VOLUME0, body, 0)[k]);
}

typedef struct result {
    double error;  /* L2 of displacement over the amplitude */
    double energy; /* at the end, over the start's */
    double probe;  /* displacement of one point */
} result;

static double energy_of(trial *t)
{
    sim_totals totals;
    check_ok(t->ctx, sim_sum(t->sim, &totals));
    return totals.kinetic + totals.strain;
}

static result vibrate(const bar *b)
{
    trial t;
    const double size[3] = {b->free_end > 0.0 ? 1.2 : 1.0, 0.0, 0.0};
    trial_begin(&t, 1, size, b->h);
    set_sides(&t, 0, BC_NO_SLIP, b->free_end > 0.0 ? BC_FREE : BC_NO_SLIP);
    set_method(&t, b->basis, b->stress, 1.0);
    t.scene->time.cfl_mpm = 0.4;
    t.scene->time.fixed_step = b->step;
    exact solution;
    const exact_model *model = exact_find("standing_bar");
    double *par;
    check_ok(t.ctx, scene_allocate(t.scene, &par, model->param_size));
    exact_fill_defaults(model, par);
    *exact_param(model, par, "length") = length;
    *exact_param(model, par, "modulus") = modulus;
    *exact_param(model, par, "density") = density;
    *exact_param(model, par, "amplitude") = amplitude;
    *exact_param(model, par, "free_end") = b->free_end;
    check_ok(t.ctx, exact_create(t.ctx, model, par, 1, &solution));
    t.scene->initial = initial_of_exact;
    t.scene->initial_user = &solution;
    const double lo[3] = {0.0, 0.0, 0.0}, hi[3] = {length, 1.0, 1.0};
    add_body(&t, add_solid(&t, "linear_elastic", modulus - 4.0 / 3.0, 1.0, density), make_box(&t, lo, hi), 2)
        ->initial_from_exact = true;
    trial_start(&t);
    reading r = {.exact = &solution, .start = calloc(mpm_count(t.sim->mpm), sizeof(double))};
    visit_points(&t, 0, keep_start, &r);
    const double before = energy_of(&t);
    trial_run(&t, b->periods * exact_scalar_value(&solution, "period", 0.0));
    r.time = t.sim->time;
    visit_points(&t, 0, add_error, &r);
    const double *x = field_get(t.sim->domain->fields[0], P_POS, 0, 0);
    const size_t probe = mpm_count(t.sim->mpm) / 3;
    const result out = {norm_finish(&r.displacement).l2 / amplitude, energy_of(&t) / before,
                        x[probe] - r.start[(size_t)field_get(t.sim->domain->fields[0], P_ID, 0, 0)[probe]]};
    free(r.start);
    exact_destroy(t.ctx, &solution);
    trial_end(&t);
    return out;
}

static void test_order_in_h(void **state)
{
    (void)state;
    const double h[] = {0.1, 0.05, 0.025, 0.0125};
    for (int end = 0; end <= 1; ++end)
        for (size_t i = 0; i < basis_registry_size; ++i)
            for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme) {
                double error[4];
                for (int k = 0; k < 4; ++k)
                    error[k] =
                        vibrate(&(bar){basis_registry[i]->name, (stress_scheme)scheme, h[k], NAN, 1.2, end}).error;
                const double order = fitted_order(4, h, error);
                print_message("%-9s scheme %d, %s end: %.2e %.2e %.2e %.2e, order %.2f\n", basis_registry[i]->name,
                              scheme, end ? "free" : "fixed", error[0], error[1], error[2], error[3], order);
                if (basis_registry[i]->smoothness > 0) check_true(order >= 1.8);
            }
}

/* Differences between halved steps after one period, where they are those of the phase, fall by four. On a coarse mesh they do not:
 * v^L and the projection of the points' new velocities differ by dt (1 - P S) a, a term of dt h^2. */
static void test_order_in_step(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme) {
            double u[3];
            bar b = {basis_registry[i]->name, (stress_scheme)scheme, 0.0125, NAN, 1.0, 0.0};
            for (int k = 0; k < 3; ++k) {
                b.step = 1.0 / (300 << k);
                u[k] = vibrate(&b).probe;
            }
            const double order = log2((u[0] - u[1]) / (u[1] - u[2]));
            print_message("%-9s scheme %d: order in the step %.2f\n", basis_registry[i]->name, scheme, order);
            check_true(order >= 1.7 && order <= 2.4);
        }
}

/* Over 20 periods at CFL 0.4 and 20 cells a half wave USF's energy swings by 2.4 % (what nodes do not see of the points' velocities
 * comes back later: after 80 periods it is within 0.4 % of its start), MUSL's by as much, and USL loses up to 7 %; with half the
 * spacing all fall by four and more. */
static void test_energy(void **state)
{
    (void)state;
    const double bound[] = {[STRESS_USL] = 0.1, [STRESS_USF] = 0.03, [STRESS_MUSL] = 0.03};
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme) {
            bar b = {basis_registry[i]->name, (stress_scheme)scheme, 0.05, NAN, 20.0, 0.0};
            const double coarse = vibrate(&b).energy - 1.0;
            b.h = 0.025;
            const double fine = vibrate(&b).energy - 1.0;
            print_message("%-9s scheme %d: energy after 20 periods %+.3f %%, at half the spacing %+.3f %%\n",
                          basis_registry[i]->name, scheme, 100.0 * coarse, 100.0 * fine);
            const double share = basis_is(basis_registry[i], "cubic") ? 0.3 : 0.25; /* 0.82 % of 3 */
            check_true(fabs(coarse) <= bound[scheme] && fabs(fine) <= share * bound[scheme]);
            if (scheme != STRESS_USF) check_true(coarse < 0.0);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_in_h),
        cmocka_unit_test(test_order_in_step),
        cmocka_unit_test(test_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
