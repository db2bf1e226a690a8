/* What the cells see of a solid: its bulk response at the cell's pressure, independent of temperature (the points carry
 * the solid's own stress; this only says how much volume a solid takes at a pressure).
 *
 *   p > p_s:  p - p_reference = K/2 (1/J - J),  J = v rho_0
 *   p < p_s:  x = x_s (v_s / v)^(K_s/x_s),      x = p - p_least,  K_s = -v dp/dv at p_s
 *
 * p_least is 0 beside a gas, which at any pressure above zero can so share a cell with a solid; beside a liquid that
 * bears tension, the most that it bears. Value and slope match at p_s. K_s/x_s is of order 1e6 for a metal in gas: v is
 * always found from p, as v_s exp[-(x_s/K_s) ln(x/x_s)], which is well conditioned. */
#include "material/eos.h"
#include "material/solid.h"

#include <float.h>
#include <math.h>

static const param_spec bulk_params[] = {
    PAR_POSITIVE(eos_bulk_par, density, "kg/m^3", NAN, "density at the reference pressure"),
    PAR_POSITIVE(eos_bulk_par, bulk_modulus, "Pa", NAN,
                 "bulk modulus at the reference pressure; should be that of the solid's law"),
    PAR_POSITIVE(eos_bulk_par, specific_heat, "J/kg/K", NAN, "specific heat"),
    PAR_ANY(eos_bulk_par, reference_pressure, "Pa", 0.0, "pressure at which the density holds"),
    PAR_POSITIVE(eos_bulk_par, switch_pressure, "Pa", NAN,
                 "pressure below which the tension branch holds, in which p stays above least_pressure"),
    PAR_ANY(eos_bulk_par, least_pressure, "Pa", 0.0,
            "that pressure: what the fluids beside it can bear at least, 0 or below"),
};

/* J from s = (p - p_reference)/K: 1/J - J = 2 s. Both forms are the same root; each is free of cancellation on its
 * side. */
static inline double normal_stretch(double s)
{
    const double root = sqrt(s * s + 1.0);
    return s >= 0.0 ? 1.0 / (root + s) : root - s;
}

/* The state at the switch, where the branches meet. */
typedef struct bulk_switch {
    double density;      /* kg/m3 */
    double bulk_modulus; /* -v dp/dv = K/2 (1/J + J), Pa */
} bulk_switch;

static bulk_switch switch_state(const eos_bulk_par *a)
{
    const double J = normal_stretch((a->switch_pressure - a->reference_pressure) / a->bulk_modulus);
    return (bulk_switch){.density = a->density / J, .bulk_modulus = 0.5 * a->bulk_modulus * (1.0 / J + J)};
}

/* The tension branch from the density. x is kept above zero where the exponential underflows, so that compressibilities
 * stay finite. */
static void tension_pressure(const eos_bulk_par *a, bulk_switch s, double rho, double *p, double *c2)
{
    const double x_s = a->switch_pressure - a->least_pressure;
    const double x = fmax(x_s * exp(s.bulk_modulus / x_s * log1p((rho - s.density) / s.density)), DBL_MIN);
    *p = x + a->least_pressure;
    *c2 = s.bulk_modulus / x_s * x / rho;
}

/* (1/J - J) is formed as (x - 1)(x + 1)/x with x = rho/rho_0, so that small strains keep their digits.
 * Two passes: the first has no branch; tension is rare. */
static void bulk_pressure(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                          double *restrict p, double *restrict c2)
{
    const eos_bulk_par *a = par;
    const double rho_0 = a->density, half_K = 0.5 * a->bulk_modulus, p_ref = a->reference_pressure;
    const bulk_switch s = switch_state(a);
    (void)e;
    for (size_t i = 0; i < n; i++) {
        p[i] = p_ref + half_K * (rho[i] - rho_0) * (rho[i] + rho_0) / (rho_0 * rho[i]);
        c2[i] = half_K * (1.0 / rho_0 + rho_0 / (rho[i] * rho[i]));
    }
    for (size_t i = 0; i < n; i++) {
        if (rho[i] < s.density) tension_pressure(a, s, rho[i], &p[i], &c2[i]);
    }
}

static void bulk_temperature(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                             double *restrict T)
{
    const eos_bulk_par *a = par;
    (void)rho;
    for (size_t i = 0; i < n; i++) T[i] = e[i] / a->specific_heat;
}

static void bulk_energy(const void *par, size_t n, const double *restrict rho, const double *restrict T,
                        double *restrict e)
{
    const eos_bulk_par *a = par;
    (void)rho;
    for (size_t i = 0; i < n; i++) e[i] = a->specific_heat * T[i];
}

/* Normal branch: dJ/dp = -2 J^2 / [K (1 + J^2)]. Tension branch: dv/dp = -(x_s/K_s) v/x. */
static void bulk_volume(const void *par, size_t n, const double *restrict p, const double *restrict T,
                        double *restrict v, double *restrict dvdp)
{
    const eos_bulk_par *a = par;
    const double rho_0 = a->density, K = a->bulk_modulus, p_ref = a->reference_pressure, p_s = a->switch_pressure;
    const bulk_switch s = switch_state(a);
    const double least = a->least_pressure, x_s = p_s - least, exponent = x_s / s.bulk_modulus;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        const double J = normal_stretch((p[i] - p_ref) / K);
        v[i] = J / rho_0;
        dvdp[i] = -2.0 * J * v[i] / (K * (1.0 + J * J));
    }
    for (size_t i = 0; i < n; i++) {
        if (!(p[i] < p_s)) continue;
        v[i] = exp(-exponent * log((p[i] - least) / x_s)) / s.density;
        dvdp[i] = -exponent * v[i] / (p[i] - least);
    }
}

static void bulk_dpde(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                      double *restrict dpde)
{
    (void)par;
    (void)rho;
    (void)e;
    for (size_t i = 0; i < n; i++) dpde[i] = 0.0;
}

static void bulk_heat(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                      double *restrict cv, double *restrict alpha)
{
    const eos_bulk_par *a = par;
    (void)rho;
    (void)e;
    for (size_t i = 0; i < n; i++) {
        cv[i] = a->specific_heat;
        alpha[i] = 0.0;
    }
}

static double bulk_pressure_floor(const void *par)
{
    const eos_bulk_par *a = par;
    return a->least_pressure;
}

static double bulk_energy_floor(const void *par, double rho)
{
    (void)par;
    (void)rho;
    return 0.0;
}

const eos_model eos_bulk = {
    .name = "bulk",
    .doc = "a solid as the cells see it: p - p_ref = K/2 (1/J - J), with a tension branch in which p stays above "
           "what its fluids bear",
    .cite = "J. E. Guilkey, T. Harman, A. Xia, B. Kashiwa, P. McMurtry, An Eulerian-Lagrangian approach for large "
            "deformation fluid structure interaction problems, Part 1 (2003), below eq. 4",
    .param_size = sizeof(eos_bulk_par),
    .params = bulk_params,
    .n_params = sizeof bulk_params / sizeof *bulk_params,
    .pressure = bulk_pressure,
    .temperature = bulk_temperature,
    .energy = bulk_energy,
    .volume = bulk_volume,
    .dpde = bulk_dpde,
    .heat = bulk_heat,
    .pressure_floor = bulk_pressure_floor,
    .energy_floor = bulk_energy_floor,
};
