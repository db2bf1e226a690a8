/* States behind shocks: closed forms of ideal and stiffened gas and of Mie and Grueneisen's law, and the conditions themselves of the others. */
#include "check.h"

#include "coupling/hugoniot.h"

#include <math.h>
#include <stdio.h>

static double energy_at(const eos *law, double p, double T, double *v)
{
    double dvdp, e;
    law->model->volume(law->par, 1, &p, &T, v, &dvdp);
    const double rho = 1.0 / *v;
    law->model->energy(law->par, 1, &rho, &T, &e);
    return e;
}

/* rho/rho_0 = ((g + 1) P + (g - 1) P_0)/((g - 1) P + (g + 1) P_0), P above the floor. */
static void gases(void **state)
{
    (void)state;
    static double air[] = {1.4, 717.5}, dense[] = {1.09, 600.0}, water[] = {4.4, 6e8, 1816.0};
    const eos law[] = {{eos_find("ideal"), air}, {eos_find("ideal"), dense}, {eos_find("stiffened"), water}};
    for (size_t i = 0; i < sizeof law / sizeof *law; i++)
        for (double ratio = 1.001; ratio < 1e7; ratio *= 10.0) {
            const double *g = law[i].par, p0 = 2e5, p1 = p0 * ratio, floor = law[i].model->pressure_floor(law[i].par);
            double v0, v, e;
            const double e0 = energy_at(&law[i], p0, 300.0, &v0), P0 = p0 - floor, P = p1 - floor;
            check_true(hugoniot_state(&law[i], v0, e0, p0, p1, &v, &e));
            const double exact = v0 * ((*g - 1.0) * P + (*g + 1.0) * P0) / ((*g + 1.0) * P + (*g - 1.0) * P0);
            check_true(fabs(v / exact - 1.0) <= 1e-9);
            check_true(fabs(e - e0 - 0.5 * (p1 + p0) * (v0 - v)) <= 1e-9 * e);
        }
}

/* From its own reference state p = rho_0 c_0^2 eta/(1 - s eta)^2, eta = 1 - v/v_0. */
static void metal(void **state)
{
    (void)state;
    static double copper[] = {8930.0, 3940.0, 1.489, 1.99, 383.0, 293.15};
    const eos law = {eos_find("mie_grueneisen"), copper};
    const double v0 = 1.0 / copper[0], rho = copper[0], T = copper[5];
    double e0, p0, c2, v, e;
    law.model->energy(law.par, 1, &rho, &T, &e0);
    law.model->pressure(law.par, 1, &rho, &e0, &p0, &c2);
    for (double eta = 0.01; eta < 0.4; eta *= 2.0) {
        const double p = copper[0] * copper[1] * copper[1] * eta / ((1.0 - copper[2] * eta) * (1.0 - copper[2] * eta));
        check_true(hugoniot_state(&law, v0, e0, p0, p, &v, &e));
        printf("eta %g: %g\n", eta, 1.0 - v / v0);
        check_true(fabs(1.0 - v / v0 - eta) <= 1e-8);
    }
}

static void other_laws(void **state)
{
    (void)state;
    static double water[] = {1.19, 7.028e8, 6.61e-4, 3610.0, -1177788.0},
                  tnt[] = {1630.0, 371.2e9, 3.231e9, 4.15, 0.95, 0.30, 1000.0},
                  tait[] = {1000.0, 1e5, 4186.0, 2.2e9, 7.15};
    const eos law[] = {{eos_find("nasg"), water}, {eos_find("jwl"), tnt}, {eos_find("tait"), tait}};
    for (size_t i = 0; i < sizeof law / sizeof *law; i++)
        for (double p1 = 1.1e9; p1 < 1e11; p1 *= 3.0) {
            double v0, v, e, p, c2;
            const double p0 = 1e9, e0 = energy_at(&law[i], p0, 600.0, &v0);
            check_true(hugoniot_state(&law[i], v0, e0, p0, p1, &v, &e));
            const double rho = 1.0 / v;
            law[i].model->pressure(law[i].par, 1, &rho, &e, &p, &c2);
            check_true(fabs(p / p1 - 1.0) <= 1e-8);
            check_true(fabs(e - e0 - 0.5 * (p1 + p0) * (v0 - v)) <= 1e-9 * fabs(e));
        }
}

static void nothing_behind(void **state)
{
    (void)state;
    static double copper[] = {8930.0, 3940.0, 1.489, 1.99, 383.0, 293.15};
    const eos law = {eos_find("mie_grueneisen"), copper};
    double v0, v, e;
    const double e0 = energy_at(&law, 1e9, 400.0, &v0);
    check_true(!hugoniot_state(&law, v0, e0, 1e9, NAN, &v, &e));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gases),
        cmocka_unit_test(metal),
        cmocka_unit_test(other_laws),
        cmocka_unit_test(nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
