/* Heat conducted between fluids of the cells and solids with sharp surfaces (theory 7.10): two half-spaces that come into touch, with the surface anywhere in a
 * cell; a liquid between round walls, in the plane, about an axis and in space; a hot body that swims; nothing made or lost, for any blocks, any threads and
 * after a restart. */
#include "coupled_fixture.h"

typedef struct pair {
    double liquid_k, solid_k; /* W/m/K */
    double liquid_c, solid_c; /* J/kg/K */
    double solid_density;
    bool implicit;
} pair;

static const double liquid_T = 3.0, solid_T = 1.0; /* K: at the start */

/* A box of cells h full of liquid, and the solid's material. */
static int begin(trial *t, int dim, double h, const pair *p)
{
    trial_begin(t, dim, (const double[3]){1.0, 1.0, 1.0}, h);
    scene *s = t->scene;
    for (int a = 0; a < dim; ++a) set_sides(t, a, BC_SYMMETRY, BC_SYMMETRY);
    s->coupling = COUPLING_ICE_MPM;
    s->reference_pressure = s->ambient_pressure = 1.0;
    s->has_ambient = true;
    s->ambient_material = coupled_liquid(t, p->liquid_c, p->liquid_k);
    s->ambient_temperature = liquid_T;
    if (p->implicit) s->method.pressure = PRESSURE_IMPLICIT;
    set_method(t, "quadratic", STRESS_USL, 1.0);
    s->method.interface = INTERFACE_SHARP;
    const int solid = add_solid(t, "linear_elastic", 1000.0, 500.0, p->solid_density);
    s->material[solid].specific_heat = p->solid_c;
    s->material[solid].tension_switch = 1.0;
    s->material[solid].conductivity = p->solid_k;
    return solid;
}

/* J: of a body by its number. */
static double heat_of(const trial *t, int body)
{
    mpm_totals sum;
    check_ok(t->ctx, mpm_sum(t->sim->mpm, &sum));
    return sum.heat[body];
}

/* ---- two half-spaces ---- */

/* What flows over each unit of area by time t: e_s (T_i - T_s) 2 (t/pi)^1/2, e = (k rho c)^1/2, T_i shared by e (Carslaw and Jaeger 1959, section 2.15).
 * Returns the error of floe, relative. */
static double half_space_error(const pair *p, double h, double place)
{
    trial t;
    const double end = 0.6, e_l = sqrt(p->liquid_k * p->liquid_c),
                 e_s = sqrt(p->solid_k * p->solid_density * p->solid_c);
    const int solid = begin(&t, 1, h, p);
    coupled_body(&t, solid, make_box(&t, (const double[3]){place, 0.0, 0.0}, (const double[3]){1.0, 1.0, 1.0}), 2)
        ->temperature = solid_T;
    coupled_start(&t);
    const double before = heat_of(&t, 0);
    trial_run(&t, end);
    const double flowed = heat_of(&t, 0) - before,
                 expected = 2.0 * sqrt(end / acos(-1.0)) * e_l * e_s / (e_l + e_s) * (liquid_T - solid_T);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 1e-11);
    trial_end(&t);
    return fabs(flowed / expected - 1.0);
}

/* From a solid that hardly conducts in a liquid that does, to the reverse; the surface anywhere in a cell. */
static void test_half_spaces(void **unused)
{
    (void)unused;
    static const struct {
        pair p;
        double coarse, fine;
    } each[] = {{{0.02, 0.04, 2.0, 1.5, 3.0, false}, 0.1, 0.05},
                {{0.05, 0.02, 1.0, 1.0, 2.0, false}, 0.17, 0.08},
                {{0.01, 0.2, 1.0, 1.0, 5.0, true}, 0.024, 0.0088}};
    for (size_t k = 0; k < sizeof each / sizeof *each; ++k) {
        double most[2] = {0.0, 0.0};
        for (int n = 0; n < 3; ++n)
            for (int fine = 0; fine < 2; ++fine)
                most[fine] =
                    fmax(most[fine], half_space_error(&each[k].p, fine ? 0.025 : 0.05, 0.5 + 0.0079 * (2 * n + 1)));
        check_true(most[0] <= each[k].coarse && most[1] <= each[k].fine);
    }
}

/* ---- between round walls ---- */

typedef enum round_space { IN_PLANE, ABOUT_AXIS, IN_SPACE } round_space;

static const double inner = 0.33, outer = 0.81; /* m */

/* W: that flows at rest between the part of the walls in the domain, a quarter of a circle, a radian of half a
 * sphere, and an eighth. */
static double flow_at_rest(round_space space, double conductivity)
{
    const double pi = acos(-1.0), of_sphere = conductivity * (liquid_T - solid_T) / (1.0 / inner - 1.0 / outer);
    if (space == IN_PLANE) return 0.5 * pi * conductivity * (liquid_T - solid_T) / log(outer / inner);
    return space == ABOUT_AXIS ? of_sphere : 0.5 * pi * of_sphere;
}

/* The cold wall inside and the hot one outside have so much capacity that they keep their temperatures. Returns the error of the heat that flows into one and
 * out of the other. */
static double round_error(round_space space, double h, motion_kind motion)
{
    trial t;
    const pair p = {0.2, 0.2, 1.0, 1e7, 3.0, false};
    const double end = 0.9;
    const int solid = begin(&t, space == IN_SPACE ? 3 : 2, h, &p);
    if (space == ABOUT_AXIS) t.scene->mesh.geometry = MESH_AXISYMMETRIC;
    scene_body *body[2] = {coupled_body(&t, solid, make_ball(&t, (const double[3]){0.0, 0.0, 0.0}, inner), 2),
                           coupled_body(&t, solid, make_ring(&t, outer, 2.0), 2)};
    for (int b = 0; b < 2; ++b) body[b]->motion.kind = motion;
    body[0]->temperature = solid_T;
    body[1]->temperature = liquid_T;
    t.scene->ambient_temperature = 0.5 * (solid_T + liquid_T);
    coupled_start(&t);
    trial_run(&t, 0.9 * end);
    const double before[2] = {heat_of(&t, 0), heat_of(&t, 1)};
    trial_run(&t, end);
    const double expected = 0.1 * end * flow_at_rest(space, p.liquid_k);
    const double in = (heat_of(&t, 0) - before[0]) / expected - 1.0,
                 out = (before[1] - heat_of(&t, 1)) / expected - 1.0;
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 1e-9); /* of 1e7 */
    trial_end(&t);
    return fmax(fabs(in), fabs(out));
}

static void test_round_walls(void **unused)
{
    (void)unused;
    check_true(round_error(IN_PLANE, 0.1, MOTION_BY_LAW) <= 0.007);
    check_true(round_error(IN_PLANE, 1.0 / 14.0, MOTION_FIXED) <= 0.005);
    check_true(round_error(ABOUT_AXIS, 0.1, MOTION_FIXED) <= 0.012);
    check_true(round_error(ABOUT_AXIS, 1.0 / 14.0, MOTION_BY_LAW) <= 0.01);
    check_true(round_error(IN_SPACE, 0.2, MOTION_FIXED) <= 0.1);
}

/* ---- a hot body that swims ---- */

typedef struct swim {
    int blocks;
    double conductivity; /* W/m/K: of the body */
} swim;

static void begin_swim(trial *t, const void *how)
{
    const swim *w = how;
    const pair p = {0.05, w->conductivity, 2.0, 1.5, 3.0, false};
    const int solid = begin(t, 2, 0.0625, &p);
    t->scene->material[solid].expansion = 1e-3; /* so that it has a temperature even if it does not conduct */
    t->scene->material[solid].stress_free_temperature = (double)NAN;
    for (int a = 0; a < 2; ++a) t->scene->mesh.blocks[a] = w->blocks;
    scene_body *b = coupled_body(t, solid, make_ball(t, (const double[3]){0.43, 0.52, 0.0}, 0.21), 2);
    b->temperature = 5.0;
    b->velocity[0] = 0.6;
    coupled_start(t);
}

/* Energy closes as without heat: by what the points lose in moving. An insulator keeps its heat. */
static void test_swim(void **unused)
{
    (void)unused;
    double drift[2];
    for (int k = 0; k < 2; ++k) {
        trial t;
        const swim w = {1, k ? 0.2 : 0.0};
        begin_swim(&t, &w);
        const double before = heat_of(&t, 0);
        trial_run(&t, 0.1);
        if (k)
            check_true(heat_of(&t, 0) < 0.98 * before);
        else
            check_close(heat_of(&t, 0), before, 1e-3 * before);
        drift[k] = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
        trial_end(&t);
    }
    check_true(drift[1] <= 1.1 * drift[0] + 1e-12);
}

static void test_bits(void **unused)
{
    (void)unused;
    const swim one = {1, 0.2}, four = {2, 0.2};
    same_steps(begin_swim, &one, &four, 12);
    same_after_resuming(begin_swim, &one, &four, 6, 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_half_spaces), cmocka_unit_test(test_round_walls),
                                       cmocka_unit_test(test_swim), cmocka_unit_test(test_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
