/* Calorically perfect ideal gas: p = (gamma - 1) rho e, e = c_v T, so that v = (gamma - 1) c_v T / p. */
#include "material/eos.h"

#include <math.h>

typedef struct ideal_par {
    double gamma;
    double specific_heat; /* c_v, J/kg/K */
} ideal_par;

static const param_spec ideal_params[] = {
    PAR_BETWEEN(ideal_par, gamma, "1", 1.001, 20.0, 1.4, "ratio of specific heats"),
    PAR_POSITIVE(ideal_par, specific_heat, "J/kg/K", NAN, "specific heat at constant volume (dry air: 717.5)"),
};

/* c2 = (dp/drho)_e + (dp/de)_rho p / rho^2 = gamma (gamma - 1) e. */
static void ideal_pressure(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                           double *restrict p, double *restrict c2)
{
    const ideal_par *a = par;
    const double g1 = a->gamma - 1.0, gg1 = a->gamma * g1;
    for (size_t i = 0; i < n; i++) {
        p[i] = g1 * rho[i] * e[i];
        c2[i] = gg1 * e[i];
    }
}

static void ideal_temperature(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                              double *restrict T)
{
    const ideal_par *a = par;
    (void)rho;
    for (size_t i = 0; i < n; i++) T[i] = e[i] / a->specific_heat;
}

static void ideal_energy(const void *par, size_t n, const double *restrict rho, const double *restrict T,
                         double *restrict e)
{
    const ideal_par *a = par;
    (void)rho;
    for (size_t i = 0; i < n; i++) e[i] = a->specific_heat * T[i];
}

static void ideal_volume(const void *par, size_t n, const double *restrict p, const double *restrict T,
                         double *restrict v, double *restrict dvdp)
{
    const ideal_par *a = par;
    const double gas_constant = (a->gamma - 1.0) * a->specific_heat;
    for (size_t i = 0; i < n; i++) {
        v[i] = gas_constant * T[i] / p[i];
        dvdp[i] = -v[i] / p[i];
    }
}

static void ideal_dpde(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                       double *restrict dpde)
{
    const ideal_par *a = par;
    (void)e;
    for (size_t i = 0; i < n; i++) dpde[i] = (a->gamma - 1.0) * rho[i];
}

/* v is proportional to T at constant p: alpha = 1/T. */
static void ideal_heat(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                       double *restrict cv, double *restrict alpha)
{
    const ideal_par *a = par;
    (void)rho;
    for (size_t i = 0; i < n; i++) {
        cv[i] = a->specific_heat;
        alpha[i] = a->specific_heat / e[i];
    }
}

static double ideal_pressure_floor(const void *par)
{
    (void)par;
    return 0.0;
}

static double ideal_energy_floor(const void *par, double rho)
{
    (void)par;
    (void)rho;
    return 0.0;
}

const eos_model eos_ideal = {
    .name = "ideal",
    .doc = "ideal gas of constant specific heats, p = (gamma - 1) rho e",
    .cite = "A. R. York, D. Sulsky, H. L. Schreyer, Int. J. Numer. Meth. Engng 48 (2000) 901, eq. 22",
    .param_size = sizeof(ideal_par),
    .params = ideal_params,
    .n_params = sizeof ideal_params / sizeof *ideal_params,
    .pressure = ideal_pressure,
    .temperature = ideal_temperature,
    .energy = ideal_energy,
    .volume = ideal_volume,
    .dpde = ideal_dpde,
    .heat = ideal_heat,
    .pressure_floor = ideal_pressure_floor,
    .energy_floor = ideal_energy_floor,
};
