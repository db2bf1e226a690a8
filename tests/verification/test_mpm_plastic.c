/* Plasticity in motion: waves of an elastic-plastic block against a wall, what points remember as they cross cells and blocks,
 * and where the energy goes. */
#include "mpm_fixture.h"

static const double K = 1.3e11, G = 4.5e10, RHO = 8900.0, yield = 2e7;

static int add_metal(trial *t, double hardening)
{
    const int metal = add_solid(t, "j2", K, G, RHO);
    scene_material *m = &t->scene->material[metal];
    set_param(m->law->params, m->law->n_params, m->law_par, "yield_stress", 0, yield);
    set_param(m->law->params, m->law->n_params, m->law_par, "hardening_modulus", 0, hardening);
    return metal;
}

/* The exact state behind both waves of a block that hits a wall in uniaxial strain: an elastic precursor up to the yield
 * point, q = 2 G e = Y, then a plastic wave. Strains are small (1e-3). */
typedef struct impact {
    double elastic_speed, plastic_speed;     /* m/s */
    double precursor_stress, precursor_kick; /* Pa, m/s */
    double wall_stress, plastic_strain;      /* Pa, 1 */
} impact;

static impact impact_of(double speed, double hardening)
{
    const double share = hardening / (3.0 * G + hardening);
    impact w = {.elastic_speed = sqrt((K + 4.0 / 3.0 * G) / RHO),
                .plastic_speed = sqrt((K + 4.0 / 3.0 * G * share) / RHO)};
    const double strain = 0.5 * yield / G;
    w.precursor_stress = (K + 4.0 / 3.0 * G) * strain;
    w.precursor_kick = w.precursor_stress / (RHO * w.elastic_speed);
    const double further = (speed - w.precursor_kick) / w.plastic_speed; /* strain across the plastic wave */
    w.wall_stress = w.precursor_stress + RHO * w.plastic_speed * (speed - w.precursor_kick);
    w.plastic_strain = 2.0 * G * further / (3.0 * G + hardening);
    return w;
}

typedef struct wave_errors {
    const impact *wave;
    double time, between;                           /* s, m between points at first */
    double stress, strain, volume, energy;          /* L1 sums */
    double plateau_stress, plateau_strain, plateau; /* sums well behind the plastic wave */
} wave_errors;

/* A point at its first place X was met by the elastic wave at X/c_e, by the plastic one at X/c_p. */
static void compare_with_waves(void *user, const fields *f, int body, size_t k)
{
    wave_errors *e = user;
    const double X = (fmod(field_get(f, P_ID, body, 0)[k], 0x1p40) + 0.5) * e->between;
    const bool plastic = X < e->wave->plastic_speed * e->time, elastic = X < e->wave->elastic_speed * e->time;
    const double stress = plastic ? -e->wave->wall_stress : elastic ? -e->wave->precursor_stress : 0.0;
    const double volume = field_get(f, P_VOLUME0, body, 0)[k];
    e->volume += volume;
    e->stress += volume * fabs(field_get(f, P_STRESS, body, 0)[k] - stress);
    e->strain += volume * fabs(field_get(f, P_HISTORY_1, body, 0)[k] - (plastic ? e->wave->plastic_strain : 0.0));
    if (X < 0.1 * e->wave->plastic_speed * e->time || X > 0.7 * e->wave->plastic_speed * e->time) return;
    e->plateau += volume;
    e->plateau_stress += volume * field_get(f, P_STRESS, body, 0)[k];
    e->plateau_strain += volume * field_get(f, P_HISTORY_1, body, 0)[k];
}

static wave_errors wave_error(double h, const char *basis, stress_scheme stress)
{
    const double speed = 4.0, hardening = 2e10, end = 1.2e-4;
    const impact wave = impact_of(speed, hardening);
    trial t;
    trial_begin(&t, 1, (const double[]){1.25, 0.0, 0.0}, h);
    set_sides(&t, 0, BC_SYMMETRY, BC_FREE);
    set_method(&t, basis, stress, 1.0);
    t.scene->time.cfl_mpm = 0.4;
    const int metal = add_metal(&t, hardening);
    t.scene->material[metal].artificial_linear = 0.5;
    t.scene->material[metal].artificial_quadratic = 1.0;
    add_body(&t, metal, make_box(&t, (const double[]){0, 0, 0}, (const double[]){1.0, 0, 0}), 2)->velocity[0] = -speed;
    trial_start(&t);
    trial_run(&t, end);
    wave_errors e = {.wave = &wave, .time = end, .between = 0.5 * h};
    visit_points(&t, 0, compare_with_waves, &e);
    e.stress /= e.volume * wave.wall_stress;
    e.strain /= e.volume * wave.plastic_strain;
    e.plateau_stress = fabs(e.plateau_stress / (e.plateau * wave.wall_stress) + 1.0);
    e.plateau_strain = fabs(e.plateau_strain / (e.plateau * wave.plastic_strain) - 1.0);
    e.energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_X) <= 1e-12);
    trial_end(&t);
    print_message("%s h = %g: L1 of stress %.4f, of plastic strain %.4f; behind the waves %.4f, %.4f; energy %.1e\n",
                  basis, h, e.stress, e.strain, e.plateau_stress, e.plateau_strain, e.energy);
    e.wave = NULL;
    return e;
}

/* Artificial viscosity spreads waves of a linear medium as diffusion does, to sqrt(h c t): order 1/2. Behind them the state is
 * that of the jump conditions. Less viscosity (0.1) has half the errors, but rings, and plastic strain keeps what ringing adds
 * (1.5 % at the finer spacing). */
static void test_waves(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme) {
            const bool all = strcmp(basis_registry[i]->name, "quadratic") == 0;
            if (!all && scheme != (int)(i % 3)) continue;
            const wave_errors coarse = wave_error(0.01, basis_registry[i]->name, (stress_scheme)scheme);
            const wave_errors fine = wave_error(0.0025, basis_registry[i]->name, (stress_scheme)scheme);
            check_true(fine.stress <= 0.024);
            check_true(fine.strain <= 0.032); /* 0.028 */
            check_true(coarse.stress >= 1.8 * fine.stress);
            check_true(coarse.strain >= 1.7 * fine.strain);
            check_true(fine.plateau_stress <= 2e-3); /* 1.1e-3 */
            check_true(fine.plateau_strain <= 4e-3); /* 2.2e-3 */
            check_true(fine.energy <= 8e-4);         /* 3.6e-4 */
        }
}

/* What a point remembers stays with it, to the bit, as it crosses cells and blocks without straining. */
static double remembered(const fields *f, int body, size_t k, int number)
{
    return fmod(field_get(f, P_ID, body, 0)[k], 0x1p40) * 0.25 + number;
}

static void set_memory(void *user, const fields *f, int body, size_t k)
{
    (void)user;
    field_get(f, P_HISTORY_1, body, 0)[k] = remembered(f, body, k, 1);
    field_get(f, P_HISTORY_3, body, 0)[k] = remembered(f, body, k, 3);
}

static void check_memory(void *user, const fields *f, int body, size_t k)
{
    size_t *points = user;
    check_close(field_get(f, P_HISTORY_1, body, 0)[k], remembered(f, body, k, 1), 0.0);
    check_close(field_get(f, P_HISTORY_2, body, 0)[k], 0.0, 0.0);
    check_close(field_get(f, P_HISTORY_3, body, 0)[k], remembered(f, body, k, 3), 0.0);
    ++*points;
}

static void test_memory(void **state)
{
    (void)state;
    trial t;
    trial_begin(&t, 2, (const double[]){2.0, 1.6, 0.0}, 0.1);
    t.scene->mesh.blocks[0] = t.scene->mesh.blocks[1] = 2;
    set_method(&t, "quadratic", STRESS_USL, 1.0);
    const int metal = add_metal(&t, 0.0);
    scene_body *b = add_body(&t, metal, make_ball(&t, (const double[]){0.5, 0.45, 0.0}, 0.3), 3);
    b->velocity[0] = 3000.0;
    b->velocity[1] = 200.0;
    trial_start(&t);
    visit_points(&t, 0, set_memory, NULL);
    trial_run(&t, 3e-4);
    check_true(t.sim->ledger.count[COUNT_REORDERS] > 5);
    check_true(t.sim->mpm->points[1][0].n > 0);
    size_t points = 0;
    visit_points(&t, 0, check_memory, &points);
    assert_int_equal(points, mpm_count(t.sim->mpm));
    assert_true(points > 200);
    trial_end(&t);
}

/* Ends of the copper bar of inputs/taylor_bar.yaml. */
typedef struct bar_ends {
    double length, radius, plastic_strain; /* m, m, 1: the largest of each */
} bar_ends;

static void find_ends(void *user, const fields *f, int body, size_t k)
{
    bar_ends *e = user;
    e->radius = fmax(e->radius, field_get(f, P_POS, body, 0)[k]);
    e->length = fmax(e->length, field_get(f, P_POS, body, 1)[k]);
    e->plastic_strain = fmax(e->plastic_strain, field_get(f, P_HISTORY_1, body, 0)[k]);
}

/* Taylor's bar at 80 us: published by codes with Lagrangian meshes (Kamoulakos 1990, Zhu and Cescotto 1995, Camacho and Ortiz
 * 1997, as the literature since quotes them) length 21.3 to 21.7 mm, radius 7.0 to 7.2 mm, plastic strain 2.5 to 3.2. */
static void test_taylor_bar(void **state)
{
    (void)state;
    const double h = 0.4e-3, speed = 227.0, radius = 3.2e-3, length = 32.4e-3, rho = 8930.0;
    trial t;
    trial_begin(&t, 2, (const double[]){9.6e-3, 33.6e-3, 0.0}, h);
    t.scene->mesh.geometry = MESH_AXISYMMETRIC;
    set_sides(&t, 0, BC_SYMMETRY, BC_FREE);
    set_sides(&t, 1, BC_SLIP, BC_FREE);
    set_method(&t, "quadratic", STRESS_USL, 0.99);
    const int copper = add_solid(&t, "j2", 130e9, 43.333e9, rho);
    scene_material *m = &t.scene->material[copper];
    set_param(m->law->params, m->law->n_params, m->law_par, "yield_stress", 0, 400e6);
    set_param(m->law->params, m->law->n_params, m->law_par, "hardening_modulus", 0, 100e6);
    const double corner[3] = {0}, end[3] = {radius, length, 0.0};
    add_body(&t, copper, make_box(&t, corner, end), 2)->velocity[1] = -speed;
    trial_start(&t);
    trial_run(&t, 80e-6);

    bar_ends ends = {0};
    visit_points(&t, 0, find_ends, &ends);
    sim_totals totals;
    check_ok(t.ctx, sim_sum(t.sim, &totals));
    const double kinetic = 0.25 * rho * radius * radius * length * speed * speed; /* at first, per radian */
    ends.length += 0.25 * h; /* points stand half of theirs inside */
    ends.radius += 0.25 * h;
    print_message("length %.2f mm, radius %.2f mm, plastic strain %.2f; plastic work %.3f of the energy\n",
                  1e3 * ends.length, 1e3 * ends.radius, ends.plastic_strain, totals.internal / kinetic);
    check_true(ends.length >= 21.3e-3 && ends.length <= 21.7e-3);         /* 21.85, 21.58, 21.48 at 0.8, 0.4, 0.2 mm */
    check_true(ends.radius >= 6.9e-3 && ends.radius <= 7.2e-3);           /* 6.71, 6.96, 7.10 */
    check_true(ends.plastic_strain >= 2.5 && ends.plastic_strain <= 3.2); /* 2.66, 2.94, 3.08 */
    check_true(totals.internal / kinetic >= 0.95 && totals.internal < kinetic); /* 0.922, 0.961, 0.979 */
    check_true(totals.kinetic <= 2e-3 * kinetic && totals.strain <= 4e-3 * kinetic);
    trial_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_taylor_bar),
        cmocka_unit_test(test_waves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
