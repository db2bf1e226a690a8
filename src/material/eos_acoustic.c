/* A liquid of constant sound speed: p = p_0 + c^2 (rho - rho_0), whatever its temperature. The law of linear acoustics,
 * kept at any density.
 *
 * de = -p dv + c_v dT gives e = c_v T + e_0(rho), e_0 = (p_0 - c^2 rho_0) (1/rho_0 - 1/rho) + c^2 ln(rho/rho_0): the
 * energy of compression from rho_0. */
#include "material/barotropic.h"
#include "material/eos.h"

#include <math.h>

typedef struct acoustic_par {
    barotropic rest;
    double sound_speed; /* m/s, c */
} acoustic_par;

static const param_spec acoustic_params[] = {
    BAROTROPIC_DENSITY,
    PAR_POSITIVE(acoustic_par, sound_speed, "m/s", NAN, "speed of sound c; the bulk modulus is density times c^2"),
    BAROTROPIC_REST,
};

/* ln(1 + x) - x/(1 + x), x = rho/rho_0 - 1, keeps the digits of small compressions. */
static double cold_energy(const acoustic_par *a, double rho)
{
    const double x = (rho - a->rest.density) / a->rest.density, c2 = a->sound_speed * a->sound_speed;
    return a->rest.pressure / a->rest.density * (x / (1.0 + x)) + c2 * (log1p(x) - x / (1.0 + x));
}

static void acoustic_pressure(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                              double *restrict p, double *restrict c2)
{
    const acoustic_par *a = par;
    const double square = a->sound_speed * a->sound_speed;
    (void)e;
    for (size_t i = 0; i < n; i++) {
        p[i] = a->rest.pressure + square * (rho[i] - a->rest.density);
        c2[i] = square;
    }
}

static void acoustic_temperature(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                                 double *restrict T)
{
    const acoustic_par *a = par;
    for (size_t i = 0; i < n; i++) T[i] = (e[i] - cold_energy(a, rho[i])) / a->rest.specific_heat;
}

static void acoustic_energy(const void *par, size_t n, const double *restrict rho, const double *restrict T,
                            double *restrict e)
{
    const acoustic_par *a = par;
    for (size_t i = 0; i < n; i++) e[i] = a->rest.specific_heat * T[i] + cold_energy(a, rho[i]);
}

static void acoustic_volume(const void *par, size_t n, const double *restrict p, const double *restrict T,
                            double *restrict v, double *restrict dvdp)
{
    const acoustic_par *a = par;
    const double slope = 1.0 / (a->sound_speed * a->sound_speed);
    (void)T;
    for (size_t i = 0; i < n; i++) {
        v[i] = 1.0 / (a->rest.density + slope * (p[i] - a->rest.pressure));
        dvdp[i] = -slope * v[i] * v[i];
    }
}

/* Where the density would vanish. */
static double acoustic_pressure_floor(const void *par)
{
    const acoustic_par *a = par;
    return a->rest.pressure - a->sound_speed * a->sound_speed * a->rest.density;
}

/* T = 0. */
static double acoustic_energy_floor(const void *par, double rho)
{
    return cold_energy(par, rho);
}

const eos_model eos_acoustic = {
    .name = "acoustic",
    .doc = "a liquid of constant sound speed, p = p_0 + c^2 (rho - rho_0): linear acoustics",
    .cite = "A. R. York, D. Sulsky, H. L. Schreyer, Int. J. Numer. Meth. Engng 48 (2000) 901, equation 26",
    .param_size = sizeof(acoustic_par),
    .params = acoustic_params,
    .n_params = sizeof acoustic_params / sizeof *acoustic_params,
    .pressure = acoustic_pressure,
    .temperature = acoustic_temperature,
    .energy = acoustic_energy,
    .volume = acoustic_volume,
    .dpde = barotropic_dpde,
    .heat = barotropic_heat,
    .pressure_floor = acoustic_pressure_floor,
    .energy_floor = acoustic_energy_floor,
};
