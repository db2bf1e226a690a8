/* Gas through an orifice (theory 2.19): the flux of an isentropic nozzle as its critical point and its limits say, and both volumes as the ordinary
 * differential equations of their masses and energies do, solved here in small steps. */
#include "check.h"

#include "coupling/orifice.h"

#include <math.h>
#include <string.h>

/* From the state in the throat: the velocity of an isentropic expansion, and its density, where that is slower than sound; sonic else. */
static double nozzle(double gamma, double pressure, double work, double behind)
{
    const double c0 = sqrt(gamma * work), density = pressure / work;
    const double mach2 = 2.0 / (gamma - 1.0) * (pow(pressure / behind, (gamma - 1.0) / gamma) - 1.0);
    const double mach = sqrt(fmin(mach2, 1.0)), cooling = 1.0 + 0.5 * (gamma - 1.0) * mach * mach;
    return density * pow(cooling, -1.0 / (gamma - 1.0)) * mach * c0 / sqrt(cooling);
}

static void flux_is_that_of_a_nozzle(void **unused)
{
    (void)unused;
    static const double gammas[] = {1.1, 1.4, 1.6667, 3.0};
    for (int g = 0; g < 4; ++g) {
        const double gamma = gammas[g], p = 3e5, work = 287.0 * 350.0;
        const double critical = pow(2.0 / (gamma + 1.0), gamma / (gamma - 1.0));
        for (double ratio = 0.02; ratio < 0.999; ratio += 0.0137)
            check_close_relative(orifice_mass_flux(gamma, p, work, ratio * p), nozzle(gamma, p, work, ratio * p),
                                 1e-12);
        const double choked = p / sqrt(work) * sqrt(gamma * pow(2.0 / (gamma + 1.0), (gamma + 1.0) / (gamma - 1.0)));
        check_close_relative(orifice_mass_flux(gamma, p, work, 0.0), choked, 1e-14);
        check_close_relative(orifice_mass_flux(gamma, p, work, critical * p), choked, 1e-12);
        /* Close to one pressure: Bernoulli's law to a difference of 1e-6, and in proportion to the difference below it. */
        const double there = orifice_mass_flux(gamma, p, work, p * (1.0 - 1e-6));
        check_close_relative(there, sqrt(2.0 * p * 1e-6 * p / work), 1e-5);
        check_close_relative(orifice_mass_flux(gamma, p, work, p * (1.0 - 1e-7)), 0.1 * there, 1e-8);
        check_close_relative(orifice_mass_flux(gamma, p, work, p * (1.0 - 0.999e-6)), 0.999 * there, 1e-8);
        check_close(orifice_mass_flux(gamma, p, work, p), 0.0, 0.0);
    }
}

/* Pressure, work and density of surroundings are what they were said to be. */
static void surroundings(void **unused)
{
    (void)unused;
    const orifice_side s = orifice_surroundings(1.3, 2e5, 1e5);
    check_close_relative(orifice_pressure(&s), 2e5, 1e-15);
    check_close_relative(s.mass / s.volume, 2.0, 1e-15);
    check_close_relative((s.gamma - 1.0) * s.energy / s.mass, 1e5, 1e-15);
    assert_true(s.endless);
    const orifice_side none = orifice_surroundings(1.3, 0.0, 1e5);
    check_close(orifice_pressure(&none), 0.0, 0.0);
    check_close(none.mass, 0.0, 0.0);
    const orifice_side box = {.gamma = 1.4, .mass = 2.0, .energy = 5e5, .volume = 4.0};
    check_close_relative(orifice_pressure(&box), 5e4, 1e-15);
}

/* Both volumes after a time, in so many steps of Heun's rule. */
static void integrate(const orifice_side side[2], double area, bool one_way, double dt, int steps, orifice_flow out[2])
{
    orifice_side now[2] = {side[0], side[1]};
    memset(out, 0, 2 * sizeof *out);
    for (int k = 0; k < steps; ++k) {
        double mass[2][2] = {{0.0}}, heat[2][2] = {{0.0}};
        orifice_side at[2] = {now[0], now[1]};
        for (int stage = 0; stage < 2; ++stage) {
            const double p[2] = {orifice_pressure(&at[0]), orifice_pressure(&at[1])};
            const int from = p[0] >= p[1] ? 0 : 1;
            if (!(from == 1 && one_way) && p[from] > 0.0 && at[from].mass > 0.0) {
                const double work = p[from] * at[from].volume / at[from].mass, gamma = at[from].gamma;
                mass[stage][from] = area * (p[1 - from] < p[from] ? nozzle(gamma, p[from], work, p[1 - from]) : 0.0);
                heat[stage][from] = mass[stage][from] * gamma / (gamma - 1.0) * work;
            }
            for (int i = 0; i < 2 && stage == 0; ++i)
                if (!now[i].endless) {
                    at[i].mass = now[i].mass + dt / steps * (mass[0][1 - i] - mass[0][i]);
                    at[i].energy = now[i].energy + dt / steps * (heat[0][1 - i] - heat[0][i]);
                }
        }
        for (int i = 0; i < 2; ++i) {
            const double m = 0.5 * dt / steps * (mass[0][i] + mass[1][i]),
                         h = 0.5 * dt / steps * (heat[0][i] + heat[1][i]);
            out[i].mass += m;
            out[i].enthalpy += h;
            for (int to = 0; to < 2; ++to)
                if (!now[to].endless) {
                    now[to].mass += to == i ? -m : m;
                    now[to].energy += to == i ? -h : h;
                }
        }
    }
}

static orifice_side vessel(double gamma, double pressure, double work, double volume)
{
    return (orifice_side){.gamma = gamma,
                          .mass = pressure * volume / work,
                          .energy = pressure * volume / (gamma - 1.0),
                          .volume = volume};
}

/* Choked and below, from either side to the other, from and to surroundings; so long that several per cent to a half of it pass. */
static void volumes_follow_their_equations(void **unused)
{
    (void)unused;
    const orifice_side high = vessel(1.4, 5e5, 1e5, 0.2), low = vessel(1.25, 1e5, 8e4, 0.3),
                       near = vessel(1.4, 1.2e5, 9e4, 0.1);
    const orifice_side air = orifice_surroundings(1.4, 1e5, 8.6e4), strong = orifice_surroundings(1.4, 4e5, 8.6e4),
                       nothing = orifice_surroundings(1.4, 0.0, 8.6e4);
    const orifice_side pair[][2] = {{high, low}, {low, high},   {near, low},   {low, near},     {high, air},
                                    {air, high}, {low, strong}, {strong, low}, {high, nothing}, {near, air}};
    for (size_t k = 0; k < sizeof pair / sizeof *pair; ++k)
        for (int one_way = 0; one_way < 2; ++one_way)
            for (double dt = 2e-3; dt < 0.1; dt *= 5.0) {
                orifice_flow out[2], exact[2];
                orifice_pass(pair[k], 2e-4, one_way, dt, out);
                integrate(pair[k], 2e-4, one_way, dt, 2000, exact);
                for (int i = 0; i < 2; ++i) {
                    check_close(out[i].mass, exact[i].mass, 2e-6 * (exact[0].mass + exact[1].mass));
                    check_close(out[i].enthalpy, exact[i].enthalpy, 2e-6 * (exact[0].enthalpy + exact[1].enthalpy));
                }
                if (one_way) check_close(out[1].mass, 0.0, 0.0);
            }
}

/* Left to themselves two vessels come to one pressure and not beyond it, however long the step. */
static void no_further_than_one_pressure(void **unused)
{
    (void)unused;
    const orifice_side side[2] = {vessel(1.4, 5e5, 1e5, 0.2), vessel(1.4, 1e5, 1e5, 0.3)};
    const double common = 0.4 * (side[0].energy + side[1].energy) / 0.5;
    for (double dt = 1.0; dt < 2e4; dt *= 10.0) {
        orifice_flow out[2];
        orifice_pass(side, 1e-2, false, dt, out);
        orifice_side end[2] = {side[0], side[1]};
        end[0].energy += out[1].enthalpy - out[0].enthalpy;
        end[1].energy += out[0].enthalpy - out[1].enthalpy;
        for (int i = 0; i < 2; ++i) check_close_relative(orifice_pressure(&end[i]), common, 1e-14);
        check_close(out[1].mass, 0.0, 0.0); /* none comes back */
    }
    orifice_flow out[2];
    const orifice_side empty[2] = {vessel(1.4, 0.0, 1e5, 0.2), vessel(1.4, 0.0, 1e5, 0.3)};
    orifice_pass(empty, 1e-2, false, 1.0, out);
    for (int i = 0; i < 2; ++i) check_close(out[i].mass + out[i].enthalpy, 0.0, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flux_is_that_of_a_nozzle),
        cmocka_unit_test(surroundings),
        cmocka_unit_test(volumes_follow_their_equations),
        cmocka_unit_test(no_further_than_one_pressure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
