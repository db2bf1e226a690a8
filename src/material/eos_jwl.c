/* Products of an explosive, after Jones, Wilkins and Lee, in V = rho_0/rho:
 *
 *   p = A [1 - omega/(R1 V)] exp(-R1 V) + B [1 - omega/(R2 V)] exp(-R2 V) + omega rho e,
 *   e = c_v T + e_0(V), e_0 = [(A/R1) exp(-R1 V) + (B/R2) exp(-R2 V)] / rho_0,
 *
 * that is p = p_0(V) + omega rho c_v T with p_0 = -de_0/dv = A exp(-R1 V) + B exp(-R2 V). Far out it is an ideal gas of
 * gamma = 1 + omega. e counts from there: what is often given as E_0 per volume of explosive is rho_0 e before it
 * expands. */
#include "material/eos.h"

#include <math.h>

typedef struct jwl_par {
    double density; /* kg/m3, rho_0 */
    double A, B;    /* Pa */
    double R1, R2;
    double omega;
    double specific_heat; /* J/kg/K */
} jwl_par;

static const param_spec jwl_params[] = {
    PAR_POSITIVE(jwl_par, density, "kg/m^3", NAN, "density of the explosive (TNT: 1630)"),
    PAR_NONNEGATIVE(jwl_par, A, "Pa", NAN, "first coefficient (TNT: 371.2 GPa)"),
    PAR_NONNEGATIVE(jwl_par, B, "Pa", NAN, "second coefficient (TNT: 3.231 GPa)"),
    PAR_BETWEEN(jwl_par, R1, "1", 0.1, 20.0, NAN, "first exponent (TNT: 4.15)"),
    PAR_BETWEEN(jwl_par, R2, "1", 0.1, 20.0, NAN, "second exponent (TNT: 0.95)"),
    PAR_BETWEEN(jwl_par, omega, "1", 0.01, 2.0, NAN, "Grueneisen coefficient (TNT: 0.30)"),
    PAR_POSITIVE(jwl_par, specific_heat, "J/kg/K", 1000.0, "specific heat; it changes temperatures alone"),
};

/* The curve of no temperature at V: pressure, energy, and slope -dp_0/dV. */
typedef struct cold {
    double p, e, slope;
} cold;

static cold cold_at(const jwl_par *a, double V)
{
    const double first = a->A * exp(-a->R1 * V), second = a->B * exp(-a->R2 * V);
    return (cold){first + second, (first / a->R1 + second / a->R2) / a->density, a->R1 * first + a->R2 * second};
}

/* c2 = dp_0/drho + omega (omega + 1) c_v T, dp_0/drho = -(dp_0/dV) V^2/rho_0. */
static void jwl_pressure(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                         double *restrict p, double *restrict c2)
{
    const jwl_par *a = par;
    for (size_t i = 0; i < n; i++) {
        const double V = a->density / rho[i];
        const cold k = cold_at(a, V);
        const double heat = e[i] - k.e;
        p[i] = k.p + a->omega * rho[i] * heat;
        c2[i] = k.slope * V * V / a->density + a->omega * (a->omega + 1.0) * heat;
    }
}

static void jwl_temperature(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                            double *restrict T)
{
    const jwl_par *a = par;
    for (size_t i = 0; i < n; i++) T[i] = (e[i] - cold_at(a, a->density / rho[i]).e) / a->specific_heat;
}

static void jwl_energy(const void *par, size_t n, const double *restrict rho, const double *restrict T,
                       double *restrict e)
{
    const jwl_par *a = par;
    for (size_t i = 0; i < n; i++) e[i] = a->specific_heat * T[i] + cold_at(a, a->density / rho[i]).e;
}

/* p_0(V) + heat/V = p. The left side falls and is convex, so that Newton climbs to the root from below: from the volume
 * that the heat alone would fill, at which p_0 is still over. */
static double volume_ratio(const jwl_par *a, double p, double heat, double *slope)
{
    enum { MOST = 200 };
    double V = heat / p;
    for (int k = 0; k < MOST; k++) {
        const cold c = cold_at(a, V);
        *slope = c.slope + heat / (V * V);
        const double step = (c.p + heat / V - p) / *slope;
        V += step;
        if (!(step > 4e-16 * V)) break;
    }
    *slope = cold_at(a, V).slope + heat / (V * V);
    return V;
}

static void jwl_volume(const void *par, size_t n, const double *restrict p, const double *restrict T,
                       double *restrict v, double *restrict dvdp)
{
    const jwl_par *a = par;
    const double pressure_of_heat = a->omega * a->density * a->specific_heat;
    for (size_t i = 0; i < n; i++) {
        double slope;
        v[i] = volume_ratio(a, p[i], pressure_of_heat * T[i], &slope) / a->density;
        dvdp[i] = -1.0 / (slope * a->density);
    }
}

static void jwl_dpde(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                     double *restrict dpde)
{
    const jwl_par *a = par;
    (void)e;
    for (size_t i = 0; i < n; i++) dpde[i] = a->omega * rho[i];
}

/* alpha = -(dp/dT) (dv/dp) / v at constant v and T. */
static void jwl_heat(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                     double *restrict cv, double *restrict alpha)
{
    const jwl_par *a = par;
    for (size_t i = 0; i < n; i++) {
        const double V = a->density / rho[i];
        const cold k = cold_at(a, V);
        const double slope = k.slope + a->omega * rho[i] * (e[i] - k.e) / V;
        cv[i] = a->specific_heat;
        alpha[i] = a->omega * a->specific_heat * rho[i] / (slope * V);
    }
}

/* An infinite volume. */
static double jwl_pressure_floor(const void *par)
{
    (void)par;
    return 0.0;
}

/* T = 0. */
static double jwl_energy_floor(const void *par, double rho)
{
    const jwl_par *a = par;
    return cold_at(a, a->density / rho).e;
}

const eos_model eos_jwl = {
    .name = "jwl",
    .doc =
        "products of an explosive, p = A [1 - omega/(R1 V)] exp(-R1 V) + B [1 - omega/(R2 V)] exp(-R2 V) + omega rho e",
    .cite = "E. L. Lee, H. C. Hornig, J. W. Kury, UCRL-50422 (1968); B. M. Dobratz, P. C. Crawford, LLNL Explosives "
            "Handbook, UCRL-52997 (1985)",
    .param_size = sizeof(jwl_par),
    .params = jwl_params,
    .n_params = sizeof jwl_params / sizeof *jwl_params,
    .pressure = jwl_pressure,
    .temperature = jwl_temperature,
    .energy = jwl_energy,
    .volume = jwl_volume,
    .dpde = jwl_dpde,
    .heat = jwl_heat,
    .pressure_floor = jwl_pressure_floor,
    .energy_floor = jwl_energy_floor,
};
