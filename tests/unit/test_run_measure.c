/* What is measured against an exact solution: a state that is the exact one has no error, a state that is off by a known amount
 * has that error. */
#include "deck_text_fixture.h"

#include "run/initial.h"
#include "run/measure.h"

#include <math.h>
#include <string.h>

typedef struct measured {
    context *ctx;
    scene *scene;
    exact solution;
    sim *sim;
    run_summary summary;
} measured;

static void load(measured *m, const char *text)
{
    *m = (measured){.ctx = context_create()};
    m->scene = fixture_scene(m->ctx, text);
    check_ok(m->ctx, initial_exact(m->scene, &m->solution));
    initial_attach(m->scene, &m->solution);
    check_ok(m->ctx, sim_create(&m->sim, m->ctx, m->scene, m->scene->coupling));
}

static double error_of(measured *m, const char *name)
{
    m->summary.n_errors = 0;
    check_ok(m->ctx, measure_errors(m->sim, &m->solution, &m->summary));
    for (int i = 0; i < m->summary.n_errors; i++) {
        if (strcmp(m->summary.errors[i].name, name) == 0) return m->summary.errors[i].value;
    }
    return NAN;
}

static void release(measured *m)
{
    sim_destroy(&m->sim);
    exact_destroy(m->ctx, &m->solution);
    scene_destroy(&m->scene);
    context_destroy(&m->ctx);
}

static const char ring[] =
    "floe: 1\n"
    "coupling: mpm\n"
    "domain: {dim: 2, lower: [-1.5, -1.5], upper: [1.5, 1.5], cell: 0.25}\n"
    "materials:\n"
    "  steel: {density: 8900, law: {linear_elastic: {bulk_modulus: 117 GPa, shear_modulus: 43.8 GPa}}}\n"
    "bodies:\n"
    "  ring: {material: steel, state: exact, shape: {annulus: {inner_radius: 0.5, outer_radius: 1}}}\n"
    "time: {end: 1e-3}\n"
    "verify:\n"
    "  exact: {lame: {inner_radius: 0.5, outer_radius: 1, inner_pressure: 2 MPa, bulk_modulus: 117 GPa,\n"
    "                 shear_modulus: 43.8 GPa}}\n"
    "  body: ring\n"
    "  pressure: 2 MPa\n"
    "  metrics: [eq13, linf_sigma_r, linf_sigma_theta, linf_stress_xy, l1_velocity_x]\n";

static void points_that_are_exact_have_no_error(void **state)
{
    (void)state;
    measured m;
    load(&m, ring);
    /* Rotating a stress of some MPa into polar components costs some units of its last place. */
    const double last_place = 64.0 * 2.3e-16 * 6e6;
    check_close(error_of(&m, "eq13"), 0.0, 1e-12);
    check_close(error_of(&m, "linf_sigma_r"), 0.0, last_place);
    check_close(error_of(&m, "linf_sigma_theta"), 0.0, last_place);
    check_close(error_of(&m, "linf_stress_xy"), 0.0, last_place);
    check_close(error_of(&m, "l1_velocity_x"), 0.0, 0.0);
    release(&m);
}

/* A uniform stress added on top shows as it is in every norm; a uniform p as 2 p in sigma_r + sigma_theta. */
static void a_known_error_is_found(void **state)
{
    (void)state;
    measured m;
    load(&m, ring);
    const double p = 1e5, sum = 2.0 * 2e6 * 0.25 / 0.75;
    for (int c = 0; c < 2; c++) {
        double *stress = field_get(m.sim->domain->fields[0], P_STRESS, 0, c);
        for (size_t i = 0; i < m.sim->mpm->points[0][0].n; i++) stress[i] += p;
    }
    check_close_relative(error_of(&m, "eq13"), 2.0 * p / sum, 1e-10);
    check_close_relative(error_of(&m, "linf_sigma_r"), p, 1e-8);
    check_close_relative(error_of(&m, "linf_sigma_theta"), p, 1e-8);
    release(&m);
}

static const char stream[] = "floe: 1\n"
                             "units: none\n"
                             "coupling: %s\n"
                             "domain: {dim: 1, lower: [0], upper: [1], cell: 0.1}\n"
                             "boundaries: {x: periodic}\n"
                             "materials:\n"
                             "  gas: {eos: {ideal: {gamma: 1.4, specific_heat: 1}}}\n"
                             "bodies:\n"
                             "  all: {material: gas, state: exact, shape: {box: {lower: [0], upper: [1]}}}\n"
                             "time: {end: 1}\n"
                             "verify:\n"
                             "  exact: {uniform: {density: 1.5, velocity: [0.5], pressure: 2}}\n"
                             "  metrics: [linf_density, linf_velocity_x, linf_pressure, l1rel_pressure]\n";

/* The same deck, in cells and as points. */
static void fluids_are_measured_in_both_couplings(void **state)
{
    static const char *const coupling[] = {"ice", "mpm"};
    (void)state;
    for (int k = 0; k < 2; k++) {
        char text[2048];
        measured m;
        (void)snprintf(text, sizeof text, stream, coupling[k]);
        load(&m, text);
        check_close(error_of(&m, "linf_density"), 0.0, 1e-14);
        check_close(error_of(&m, "linf_velocity_x"), 0.0, 1e-14);
        check_close(error_of(&m, "linf_pressure"), 0.0, 1e-14);
        check_close(error_of(&m, "l1rel_pressure"), 0.0, 1e-14);
        release(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_that_are_exact_have_no_error),
        cmocka_unit_test(a_known_error_is_found),
        cmocka_unit_test(fluids_are_measured_in_both_couplings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
