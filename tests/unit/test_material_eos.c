/* Equations of state against published states of matter. */
#include "check.h"

#include "base/context.h"
#include "material/eos.h"
#include "scene/state.h"

#include <math.h>

/* Parameters in the order of the law's table. */
static eos law_of(const char *name, double *par)
{
    const eos out = {.model = eos_find(name), .par = par};
    assert_non_null(out.model);
    check_true(!out.model->check || !out.model->check(par));
    return out;
}

/* Shocks into copper lie on u_shock = 3940 + 1.489 u: momentum and energy across the shock give rho, p and e, and the law that p. Marsh,
 * LASL Shock Hugoniot Data. */
static void copper_hugoniot(void **state)
{
    (void)state;
    double par[] = {8930.0, 3940.0, 1.489, 1.99, 383.0, 293.15};
    const eos copper = law_of("mie_grueneisen", par);
    for (double u = 1.0; u < 4000.0; u *= 2.0) {
        const double shock = 3940.0 + 1.489 * u, rho = 8930.0 * shock / (shock - u), p = 8930.0 * shock * u;
        const double e = 383.0 * 293.15 + 0.5 * u * u;
        double found, c2;
        copper.model->pressure(copper.par, 1, &rho, &e, &found, &c2);
        check_close_relative(found, p, 1e-9); /* near rho_0 round-off of rho is 1e-16 rho c^2/p */
        check_true(sqrt(c2) + u > shock);     /* sound catches the shock up from behind */
    }
}

/* At rest the bulk modulus is rho_0 c_0^2 on either side of rho_0, and the volumetric expansivity Gamma c_v rho_0/K_T: 4.97e-5 1/K for
 * copper, 5.0e-5 in tables. */
static void copper_at_rest(void **state)
{
    (void)state;
    double par[] = {8930.0, 3940.0, 1.489, 1.99, 383.0, 293.15};
    const eos copper = law_of("mie_grueneisen", par);
    const double T = 293.15;
    for (int side = -1; side <= 1; side += 2) {
        const double rho = 8930.0 * (1.0 + side * 1e-9);
        double e, p, c2, cv, alpha;
        copper.model->energy(copper.par, 1, &rho, &T, &e);
        copper.model->pressure(copper.par, 1, &rho, &e, &p, &c2);
        copper.model->heat(copper.par, 1, &rho, &e, &cv, &alpha);
        check_close_relative(c2, 3940.0 * 3940.0, 1e-7);
        check_close_relative(alpha, 5.0e-5, 0.03);
    }
}

static void parameters_refused(void **state)
{
    (void)state;
    const eos_model *model = eos_find("mie_grueneisen");
    const double steep[] = {8930.0, 3940.0, 0.9, 1.99, 383.0, 293.15},
                 soft[] = {8930.0, 394.0, 1.489, 1.99, 383.0, 2931.5};
    check_true(model->check(steep) && model->check(soft));
}

/* Detonation of TNT (Dobratz & Crawford 1985): E_0 = 7.0 GPa, pressure 21.0 GPa and speed 6930 m/s at the Chapman-Jouguet state, which
 * momentum, energy and sonic flow behind the front tie to the law. The printed figures have two to three digits. */
static void tnt_detonation(void **state)
{
    (void)state;
    double par[] = {1630.0, 371.2e9, 3.231e9, 4.15, 0.95, 0.30, 1000.0};
    const eos tnt = law_of("jwl", par);
    const double D = 6930.0, p_cj = 21.0e9, V = 1.0 - p_cj / (1630.0 * D * D), rho = 1630.0 / V,
                 u = p_cj / (1630.0 * D);
    const double e = 7.0e9 / 1630.0 + 0.5 * u * u;
    double p, c2;
    tnt.model->pressure(tnt.par, 1, &rho, &e, &p, &c2);
    check_close_relative(p, p_cj, 0.01);
    check_close_relative(u + sqrt(c2), D, 0.01);
}

/* Liquid water after Le Metayer & Saurel 2016 at 1 atm: energy and sound speed as functions of v and p are the closed forms of the law. */
static void nasg_water(void **state)
{
    (void)state;
    double par[] = {1.19, 7.028e8, 6.61e-4, 3610.0, -1177788.0};
    const eos water = law_of("nasg", par);
    const double p = 101325.0, T = 298.0;
    double v, dvdp, e, found, c2;
    water.model->volume(water.par, 1, &p, &T, &v, &dvdp);
    check_close_relative(v, 6.61e-4 + 0.19 * 3610.0 * 298.0 / (7.028e8 + 101325.0), 1e-14);
    const double rho = 1.0 / v;
    water.model->energy(water.par, 1, &rho, &T, &e);
    water.model->pressure(water.par, 1, &rho, &e, &found, &c2);
    check_close_relative(e, (p + 1.19 * 7.028e8) / 0.19 * (v - 6.61e-4) - 1177788.0, 1e-12);
    check_close_relative(c2, 1.19 * v * v * (p + 7.028e8) / (v - 6.61e-4), 1e-10);
}

/* dK/dp = n, and 1 % of compression of water takes 22.9 MPa at K = 2.2 GPa, n = 7.15. */
static void tait_water(void **state)
{
    (void)state;
    double par[] = {1000.0, 101325.0, 4186.0, 2.2e9, 7.15};
    const eos water = law_of("tait", par);
    const double rho[2] = {1000.0, 1010.0}, e[2] = {0.0, 0.0};
    double p[2], c2[2];
    water.model->pressure(water.par, 2, rho, e, p, c2);
    check_close(p[0], 101325.0, 0.0);
    check_close_relative(p[1] - p[0], 2.2e9 / 7.15 * (pow(1.01, 7.15) - 1.0), 1e-12);
    check_close_relative((rho[1] * c2[1] - rho[0] * c2[0]) / (p[1] - p[0]), 7.15, 1e-12);
}

/* A law in which pressure is density's alone refuses another pressure at that density, instead of taking it in silence. */
static void contradiction_refused(void **state)
{
    (void)state;
    double par[] = {1000.0, 101325.0, 4186.0, 2.2e9, 7.15};
    const eos water = law_of("tait", par);
    context *ctx = context_create();
    fluid_state out;
    check_true(fluid_state_of(ctx, &water, 101325.0, (double)NAN, 1000.0, &out) == FLOE_OK);
    check_true(fluid_state_of(ctx, &water, 2e5, (double)NAN, 1010.0, &out) == FLOE_BAD_INPUT);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copper_hugoniot),       cmocka_unit_test(copper_at_rest), cmocka_unit_test(parameters_refused),
        cmocka_unit_test(tnt_detonation),        cmocka_unit_test(nasg_water),     cmocka_unit_test(tait_water),
        cmocka_unit_test(contradiction_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
