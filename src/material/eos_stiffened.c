/* Stiffened gas, for liquids: p = (gamma - 1) rho e - gamma p_inf, e = c_v T + p_inf v, hence
 * p + p_inf = (gamma - 1) rho c_v T: an ideal gas in p + p_inf. */
#include "material/eos.h"

#include <math.h>

typedef struct stiffened_par {
    double gamma;
    double p_inf;         /* Pa */
    double specific_heat; /* c_v, J/kg/K */
} stiffened_par;

static const param_spec stiffened_params[] = {
    PAR_BETWEEN(stiffened_par, gamma, "1", 1.001, 20.0, NAN,
                "Grueneisen coefficient plus one (water: 2.35 to 7.15, by the fit)"),
    PAR_NONNEGATIVE(stiffened_par, p_inf, "Pa", NAN, "stiffness pressure; the liquid holds tension down to -p_inf"),
    PAR_POSITIVE(stiffened_par, specific_heat, "J/kg/K", NAN, "specific heat at constant volume"),
};

/* c2 = (gamma - 1) e + (gamma - 1) p / rho = gamma (p + p_inf) / rho. With x = rho e - p_inf = rho c_v T both are
 * p + p_inf = (gamma - 1) x and c2 = gamma (gamma - 1) x / rho: one subtraction of near numbers, not two. */
static void stiffened_pressure(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                               double *restrict p, double *restrict c2)
{
    const stiffened_par *a = par;
    const double g1 = a->gamma - 1.0, gg1 = a->gamma * g1, p_inf = a->p_inf;
    for (size_t i = 0; i < n; i++) {
        const double thermal = rho[i] * e[i] - p_inf;
        p[i] = g1 * thermal - p_inf;
        c2[i] = gg1 * thermal / rho[i];
    }
}

static void stiffened_temperature(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                                  double *restrict T)
{
    const stiffened_par *a = par;
    for (size_t i = 0; i < n; i++) T[i] = (e[i] - a->p_inf / rho[i]) / a->specific_heat;
}

static void stiffened_energy(const void *par, size_t n, const double *restrict rho, const double *restrict T,
                             double *restrict e)
{
    const stiffened_par *a = par;
    for (size_t i = 0; i < n; i++) e[i] = a->specific_heat * T[i] + a->p_inf / rho[i];
}

static void stiffened_volume(const void *par, size_t n, const double *restrict p, const double *restrict T,
                             double *restrict v, double *restrict dvdp)
{
    const stiffened_par *a = par;
    const double gas_constant = (a->gamma - 1.0) * a->specific_heat, p_inf = a->p_inf;
    for (size_t i = 0; i < n; i++) {
        const double shifted = p[i] + p_inf;
        v[i] = gas_constant * T[i] / shifted;
        dvdp[i] = -v[i] / shifted;
    }
}

static void stiffened_dpde(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                           double *restrict dpde)
{
    const stiffened_par *a = par;
    (void)e;
    for (size_t i = 0; i < n; i++) dpde[i] = (a->gamma - 1.0) * rho[i];
}

/* v is proportional to T at constant p: alpha = 1/T. */
static void stiffened_heat(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                           double *restrict cv, double *restrict alpha)
{
    const stiffened_par *a = par;
    for (size_t i = 0; i < n; i++) {
        cv[i] = a->specific_heat;
        alpha[i] = a->specific_heat / (e[i] - a->p_inf / rho[i]);
    }
}

static double stiffened_pressure_floor(const void *par)
{
    const stiffened_par *a = par;
    return -a->p_inf;
}

/* T = 0, where p = -p_inf and c2 = 0. */
static double stiffened_energy_floor(const void *par, double rho)
{
    const stiffened_par *a = par;
    return a->p_inf / rho;
}

const eos_model eos_stiffened = {
    .name = "stiffened",
    .doc = "stiffened gas (liquids), p = (gamma - 1) rho e - gamma p_inf",
    .cite = "F. H. Harlow, A. A. Amsden, Fluid Dynamics, LA-4700 (1971); O. Le Metayer, J. Massoni, R. Saurel, "
            "Int. J. Thermal Sci. 43 (2004) 265",
    .param_size = sizeof(stiffened_par),
    .params = stiffened_params,
    .n_params = sizeof stiffened_params / sizeof *stiffened_params,
    .pressure = stiffened_pressure,
    .temperature = stiffened_temperature,
    .energy = stiffened_energy,
    .volume = stiffened_volume,
    .dpde = stiffened_dpde,
    .heat = stiffened_heat,
    .pressure_floor = stiffened_pressure_floor,
    .energy_floor = stiffened_energy_floor,
};
