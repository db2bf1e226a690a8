/* Noble-Abel stiffened gas: p + p_inf = (gamma - 1) c_v T / (v - b), e = c_v T + p_inf (v - b) + q. A stiffened gas
 * whose molecules take the volume b; with p_inf = 0 the Noble-Abel gas of dense propellant gases. */
#include "material/eos.h"

#include <math.h>

typedef struct nasg_par {
    double gamma;
    double p_inf;         /* Pa */
    double covolume;      /* m3/kg, b */
    double specific_heat; /* c_v, J/kg/K */
    double heat_bond;     /* J/kg, q */
} nasg_par;

static const param_spec nasg_params[] = {
    PAR_BETWEEN(nasg_par, gamma, "1", 1.001, 20.0, NAN,
                "ratio of the slopes of enthalpy and energy (liquid water: 1.19)"),
    PAR_NONNEGATIVE(nasg_par, p_inf, "Pa", 0.0, "stiffness pressure (liquid water: 7.028e8 Pa); 0: the Noble-Abel gas"),
    PAR_NONNEGATIVE(nasg_par, covolume, "m^3/kg", NAN, "volume that the molecules take (liquid water: 6.61e-4 m^3/kg)"),
    PAR_POSITIVE(nasg_par, specific_heat, "J/kg/K", NAN, "specific heat at constant volume (liquid water: 3610)"),
    PAR_ANY(nasg_par, heat_bond, "J/kg", 0.0, "energy at zero temperature (liquid water: -1177788)"),
};

/* v - b; NAN where the molecules would not fit, so that p and c2 are no numbers there. */
static double free_volume(const nasg_par *a, double rho)
{
    const double free = 1.0 / rho - a->covolume;
    return free > 0.0 ? free : (double)NAN;
}

/* With x = (e - q)/(v - b) - p_inf, c_v T per free volume: p + p_inf = (gamma - 1) x, c2 = gamma (gamma - 1) x v^2 / (v
 * - b). */
static void nasg_pressure(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                          double *restrict p, double *restrict c2)
{
    const nasg_par *a = par;
    const double g1 = a->gamma - 1.0;
    for (size_t i = 0; i < n; i++) {
        const double free = free_volume(a, rho[i]), thermal = (e[i] - a->heat_bond) / free - a->p_inf;
        p[i] = g1 * thermal - a->p_inf;
        c2[i] = a->gamma * g1 * thermal / (rho[i] * rho[i] * free);
    }
}

static double cold_energy(const nasg_par *a, double rho)
{
    return a->heat_bond + a->p_inf * free_volume(a, rho);
}

static void nasg_temperature(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                             double *restrict T)
{
    const nasg_par *a = par;
    for (size_t i = 0; i < n; i++) T[i] = (e[i] - cold_energy(a, rho[i])) / a->specific_heat;
}

static void nasg_energy(const void *par, size_t n, const double *restrict rho, const double *restrict T,
                        double *restrict e)
{
    const nasg_par *a = par;
    for (size_t i = 0; i < n; i++) e[i] = a->specific_heat * T[i] + cold_energy(a, rho[i]);
}

static void nasg_volume(const void *par, size_t n, const double *restrict p, const double *restrict T,
                        double *restrict v, double *restrict dvdp)
{
    const nasg_par *a = par;
    const double gas_constant = (a->gamma - 1.0) * a->specific_heat;
    for (size_t i = 0; i < n; i++) {
        const double shifted = p[i] + a->p_inf, free = gas_constant * T[i] / shifted;
        v[i] = a->covolume + free;
        dvdp[i] = -free / shifted;
    }
}

static void nasg_dpde(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                      double *restrict dpde)
{
    const nasg_par *a = par;
    (void)e;
    for (size_t i = 0; i < n; i++) dpde[i] = (a->gamma - 1.0) / free_volume(a, rho[i]);
}

/* At constant p, v - b is proportional to T: alpha = (v - b)/(v T). */
static void nasg_heat(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                      double *restrict cv, double *restrict alpha)
{
    const nasg_par *a = par;
    for (size_t i = 0; i < n; i++) {
        cv[i] = a->specific_heat;
        alpha[i] = free_volume(a, rho[i]) * rho[i] * a->specific_heat / (e[i] - cold_energy(a, rho[i]));
    }
}

static double nasg_pressure_floor(const void *par)
{
    const nasg_par *a = par;
    return -a->p_inf;
}

/* T = 0, where p = -p_inf and c2 = 0. */
static double nasg_energy_floor(const void *par, double rho)
{
    return cold_energy(par, rho);
}

static double nasg_density_limit(const void *par)
{
    const nasg_par *a = par;
    return 1.0 / a->covolume;
}

const eos_model eos_nasg = {
    .name = "nasg",
    .doc = "Noble-Abel stiffened gas (dense gases, liquids), (p + gamma p_inf) (v - b) = (gamma - 1) (e - q)",
    .cite = "O. Le Metayer, R. Saurel, The Noble-Abel Stiffened-Gas equation of state, Phys. Fluids 28 (2016) 046102",
    .param_size = sizeof(nasg_par),
    .params = nasg_params,
    .n_params = sizeof nasg_params / sizeof *nasg_params,
    .pressure = nasg_pressure,
    .temperature = nasg_temperature,
    .energy = nasg_energy,
    .volume = nasg_volume,
    .dpde = nasg_dpde,
    .heat = nasg_heat,
    .pressure_floor = nasg_pressure_floor,
    .energy_floor = nasg_energy_floor,
    .density_limit = nasg_density_limit,
};
