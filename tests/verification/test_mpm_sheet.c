/* Membranes as surfaces in space: a sphere that breathes, one that holds its gas at rest, and the same bits for any
 * blocks, any threads and after a restart. */
#include "coupled_fixture.h"

#include "io/checkpoint/checkpoint.h"
#include "io/io.h"

static const double pi = 3.14159265358979323846;

static scene_membrane *add_surface(trial *t, double modulus, const sheet_surface *surface)
{
    scene_material *m = &t->scene->material[t->scene->n_materials];
    (void)snprintf(m->name, sizeof m->name, "skin");
    m->kind = MATERIAL_SOLID;
    m->density = 1.0;
    m->membrane = membrane_find("plane_stress");
    check_ok(t->ctx, scene_allocate(t->scene, &m->membrane_par, m->membrane->param_size));
    set_param(m->membrane->params, m->membrane->n_params, m->membrane_par, "modulus", 0, modulus);
    set_param(m->membrane->params, m->membrane->n_params, m->membrane_par, "poisson_ratio", 0, 0.3);
    scene_body *b = add_body(t, t->scene->n_materials++, (shape){0}, 3);
    b->membrane = (scene_membrane){
        .present = true, .surface = *surface, .thickness = 0.01, .length = NAN, .heavy_mass = NAN, .encloses = -1};
    b->membrane.normals = surface_find("quadric");
    check_ok(t->ctx, scene_allocate(t->scene, &b->membrane.normals_par, b->membrane.normals->param_size));
    set_param(b->membrane.normals->params, b->membrane.normals->n_params, b->membrane.normals_par, "spread", 0, 1.0);
    return &b->membrane;
}

/* The time at which a taut sphere, let go, moves fastest: a quarter of the period 2 pi R sqrt(rho (1 - nu) / (2 E)) of its breathing. */
static double quarter_period(double h)
{
    trial t;
    const double size[3] = {0.7, 0.7, 0.7};
    const sheet_surface sphere = {.kind = SHEET_SPHERE, .axis = 2, .radius = 0.5};
    trial_begin(&t, 3, size, h);
    for (int a = 0; a < 3; ++a) set_sides(&t, a, BC_SYMMETRY, BC_FREE);
    set_method(&t, "quadratic", STRESS_USL, 1.0);
    t.scene->time.fixed_step = 0.1 * h;
    add_surface(&t, 1.0, &sphere)->slack = -1e-3;
    trial_start(&t);
    const double time = time_of_most_motion(&t, 1.0);
    trial_end(&t);
    return time;
}

static void test_breathing(void **unused)
{
    (void)unused;
    const double exact_time = 0.5 * pi * 0.5 * sqrt(0.35);
    const double coarse = quarter_period(0.1) / exact_time - 1.0, fine = quarter_period(0.07) / exact_time - 1.0;
    print_message("quarter period of a sphere: error %.3e at h = R/5, %.3e at R/7\n", coarse, fine);
    check_true(fabs(coarse) < 0.03);
    check_true(fabs(fine) < 0.6 * fabs(coarse)); /* second order: 0.49 */
}

/* The balloon from its exact rest (inputs/membrane_sphere.yaml): pressure and enclosed volume stay, the gas fills it, and the momentum that the
 * mirrors give is accounted for. Points that push by themselves are 2.8e-4 off by then (docs/results/membrane-3d.md). */
static void test_enclosed_rest(void **unused)
{
    (void)unused;
    const double pressure = 884.042, volume = pi / 6.0 * 0.517445 * 0.517445 * 0.517445;
    static const char *const set[] = {
        "bodies.gas.shape.ball.radius=0.517445", "bodies.gas.pressure=884.042", "bodies.gas.density=0.902263",
        "bodies.skin.membrane={surface: {sphere: {centre: [0, 0, 0], radius: 0.517445}}, thickness: 0.0933714, "
        "section: volume, slack: -0.0342933, encloses: gas}"};
    trial t;
    deck_begin(&t, "membrane_sphere", set, 4);
    trial_start(&t);
    double enclosed = mpm_enclosed_volume(t.sim->mpm, 1), now;
    print_message("volume of an eighth of a sphere: error %.2e\n", enclosed / volume - 1.0);
    check_true(fabs(enclosed / volume - 1.0) < 1e-11); /* quadrics fit a sphere */
    while (t.sim->time < 0.004) check_ok(t.ctx, sim_step(t.sim, INFINITY));
    mpm_totals sum;
    check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
    check_ok(t.ctx, mpm_mean_pressure(t.sim->mpm, t.scene->body[0].material, &(shape){0}, &now));
    enclosed = mpm_enclosed_volume(t.sim->mpm, 1);
    print_message("balloon at rest: pressure off by %.2e, gas volume off the enclosed one by %.2e\n",
                  now / pressure - 1.0, sum.volume[0] / enclosed - 1.0);
    check_true(fabs(now / pressure - 1.0) < 4e-5); /* 2e-5 */
    check_true(fabs(sum.volume[0] / enclosed - 1.0) < 1e-7);
    assert_true(isnan(mpm_enclosed_volume(t.sim->mpm, 0)));
    check_ok(t.ctx, sim_update_ledger(t.sim));
    for (int a = 0; a < 3; ++a)
        check_true(ledger_drift(&t.sim->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a)) < 1e-12);
    trial_end(&t);
}

/* ---- bits ---- */

typedef struct variant {
    int blocks, threads;
    const char *stress, *normals; /* as set on the command line */
} variant;

static void begin(trial *t, const void *how)
{
    const variant *v = how;
    const char *const set[] = {v->stress, v->normals, "domain.upper=[0.8, 0.8, 0.8]"};
    deck_begin(t, "membrane_sphere", set, 3);
    for (int a = 0; a < 3; ++a) t->scene->mesh.blocks[a] = v->blocks;
    use_threads(v->threads);
    trial_start(t);
}

static void test_bits(void **unused)
{
    (void)unused;
    static const char *const way[2][2] = {{"method.stress=usl", "bodies.skin.membrane.normals=isosurface"},
                                          {"method.stress=musl", "bodies.skin.membrane.normals=quadric"}};
    for (int k = 0; k < 2; ++k) {
        const variant one = {1, 1, way[k][0], way[k][1]}, other = {2, 2, way[k][0], way[k][1]};
        same_steps(begin, &one, &other, 6);
    }
}

static void test_resume(void **unused)
{
    (void)unused;
    const variant one = {1, 1, "method.stress=musl", "bodies.skin.membrane.normals=quadric"};
    const variant eight = {2, 2, one.stress, one.normals};
    same_after_resuming(begin, &one, &eight, 4, 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_breathing),
        cmocka_unit_test(test_enclosed_rest),
        cmocka_unit_test(test_bits),
        cmocka_unit_test(test_resume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
