/* A liquid after Tait and Murnaghan: p = p_0 + (K/n) [(rho/rho_0)^n - 1], whatever its temperature. K is the bulk
 * modulus at rho_0 and p_0, n its derivative dK/dp.
 *
 * de = -p dv + c_v dT gives e = c_v T + e_0(rho), with x = rho/rho_0 and B = K/n
 *   e_0 = {p_0 (1 - 1/x) + B [(x^(n-1) - 1)/(n - 1) - (1 - 1/x)]} / rho_0: the energy of compression from rho_0. */
#include "material/barotropic.h"
#include "material/eos.h"

#include <math.h>

typedef struct tait_par {
    barotropic rest;
    double bulk_modulus; /* Pa, K */
    double exponent;     /* n */
} tait_par;

static const param_spec tait_params[] = {
    BAROTROPIC_DENSITY,
    PAR_POSITIVE(tait_par, bulk_modulus, "Pa", NAN, "bulk modulus at that density (water: 2.2 GPa)"),
    PAR_BETWEEN(tait_par, exponent, "1", 1.001, 20.0, 7.15,
                "derivative of the bulk modulus by pressure (water: 7 to 7.15)"),
    BAROTROPIC_REST,
};

/* Logarithms of density ratios keep the digits of small compressions. */
static double log_ratio(const tait_par *a, double rho)
{
    return log1p((rho - a->rest.density) / a->rest.density);
}

static double cold_energy(const tait_par *a, double rho)
{
    const double L = log_ratio(a, rho), n1 = a->exponent - 1.0, B = a->bulk_modulus / a->exponent;
    const double squeeze = -expm1(-L); /* 1 - 1/x */
    return (a->rest.pressure * squeeze + B * (expm1(n1 * L) / n1 - squeeze)) / a->rest.density;
}

static void tait_pressure(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                          double *restrict p, double *restrict c2)
{
    const tait_par *a = par;
    const double B = a->bulk_modulus / a->exponent;
    (void)e;
    for (size_t i = 0; i < n; i++) {
        const double power = a->exponent * log_ratio(a, rho[i]);
        p[i] = a->rest.pressure + B * expm1(power);
        c2[i] = a->bulk_modulus * exp(power) / rho[i]; /* not of 1 + expm1, which is 0 far out */
    }
}

static void tait_temperature(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                             double *restrict T)
{
    const tait_par *a = par;
    for (size_t i = 0; i < n; i++) T[i] = (e[i] - cold_energy(a, rho[i])) / a->rest.specific_heat;
}

static void tait_energy(const void *par, size_t n, const double *restrict rho, const double *restrict T,
                        double *restrict e)
{
    const tait_par *a = par;
    for (size_t i = 0; i < n; i++) e[i] = a->rest.specific_heat * T[i] + cold_energy(a, rho[i]);
}

static void tait_volume(const void *par, size_t n, const double *restrict p, const double *restrict T,
                        double *restrict v, double *restrict dvdp)
{
    const tait_par *a = par;
    const double B = a->bulk_modulus / a->exponent;
    (void)T;
    for (size_t i = 0; i < n; i++) {
        const double L = log1p((p[i] - a->rest.pressure) / B) / a->exponent;
        v[i] = exp(-L) / a->rest.density;
        dvdp[i] = -v[i] / (a->exponent * (B + (p[i] - a->rest.pressure)));
    }
}

/* Where the density would vanish. */
static double tait_pressure_floor(const void *par)
{
    const tait_par *a = par;
    return a->rest.pressure - a->bulk_modulus / a->exponent;
}

/* T = 0. */
static double tait_energy_floor(const void *par, double rho)
{
    return cold_energy(par, rho);
}

const eos_model eos_tait = {
    .name = "tait",
    .doc = "a liquid after Tait and Murnaghan, p = p_0 + (K/n) [(rho/rho_0)^n - 1], at any temperature",
    .cite =
        "F. D. Murnaghan, Proc. Nat. Acad. Sci. 30 (1944) 244; R. H. Cole, Underwater Explosions (1948), section 2.3",
    .param_size = sizeof(tait_par),
    .params = tait_params,
    .n_params = sizeof tait_params / sizeof *tait_params,
    .pressure = tait_pressure,
    .temperature = tait_temperature,
    .energy = tait_energy,
    .volume = tait_volume,
    .dpde = barotropic_dpde,
    .heat = barotropic_heat,
    .pressure_floor = tait_pressure_floor,
    .energy_floor = tait_energy_floor,
};
