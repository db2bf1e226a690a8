/* A solid or liquid under shock, after Mie and Grueneisen: p = p_s(rho) + G (e - e_s(rho)), G = (dp/de)_rho, about the
 * isentrope s through the state (rho_0, T_0, p = 0), e = e_s + c_v (T - T_s).
 *
 *   rho > rho_0: G = Gamma rho_0, and the Hugoniot from that state is u_shock = c_0 + s u. With eta = 1 - rho_0/rho
 *       f = rho_0 c_0^2 eta (1 - Gamma eta/2) / (1 - s eta)^2,    p = f + G (e - c_v T_0),
 *       e_s = c_v T_0 + exp(Gamma eta) int_0^eta exp(-Gamma z) f(z) dz / rho_0,    T_s = T_0 exp(Gamma eta)
 *   rho < rho_0: G = Gamma rho. With x = rho/rho_0 and n = Gamma + 1
 *       p_s = rho_0 c_0^2/n (x^n - 1),    T_s = T_0 x^Gamma,
 *       e_s = c_v T_0 + c_0^2/n [(x^Gamma - 1)/Gamma - (1 - 1/x)]
 *
 * p, e and c are continuous but for Gamma c_v (T - T_0) in c^2 at rho_0. c^2 > 0 for every T >= 0 if Gamma < 2 s and
 * c_0^2 > Gamma (Gamma + 1) c_v T_0. The law ends where eta = 1/s. */
#include "material/eos_mie_grueneisen.h"

#include "material/eos.h"

#include <math.h>

typedef mie_grueneisen_par mg_par;

static const param_spec mg_params[] = {
    PAR_POSITIVE(mg_par, density, "kg/m^3", NAN, "density without pressure at the temperature below (copper: 8930)"),
    PAR_POSITIVE(mg_par, sound_speed, "m/s", NAN, "c_0 of u_shock = c_0 + s u (copper: 3940 m/s)"),
    PAR_BETWEEN(mg_par, slope, "1", 0.5, 4.0, NAN, "s of u_shock = c_0 + s u (copper: 1.489)"),
    PAR_BETWEEN(mg_par, grueneisen, "1", 0.01, 4.0, NAN,
                "Grueneisen coefficient (copper: 1.99); less than twice the slope"),
    PAR_POSITIVE(mg_par, specific_heat, "J/kg/K", NAN, "specific heat at constant volume (copper: 383)"),
    PAR_NONNEGATIVE(mg_par, temperature, "K", 293.15,
                    "temperature at which the density above is that without pressure"),
};

/* The isentrope s at a density, with G and dG/drho; NAN beyond the law's end. */
typedef struct curve {
    double p, e, T, c2, G, dG;
} curve;

/* Gauss-Legendre on [0, 1]. */
enum { NODES = 12 };
static const double node[NODES] = {0.0092196828766403782, 0.047941371814762546, 0.11504866290284765,
                                   0.20634102285669126,   0.31608425050090994,  0.43738329574426554,
                                   0.5626167042557344,    0.68391574949909006,  0.79365897714330869,
                                   0.88495133709715235,   0.95205862818523745,  0.99078031712335957};
static const double weight[NODES / 2] = {0.023587668193255914, 0.053469662997659213, 0.080039164271673111,
                                         0.10158371336153296,  0.1167462682691774,   0.12457352290670139};

/* int_0^eta exp(-Gamma z) f(z) dz / (rho_0 c_0^2), in y = -ln(1 - s z), in which the integrand has no pole. */
static double heat_integral(const mg_par *a, double end)
{
    double sum = 0.0;
    for (int k = 0; k < NODES; k++) {
        const double y = end * node[k], z = -expm1(-y) / a->slope;
        sum += weight[k < NODES / 2 ? k : NODES - 1 - k] * z * (1.0 - 0.5 * a->grueneisen * z) *
               exp(y - a->grueneisen * z);
    }
    return sum * end / a->slope;
}

/* f and df/deta at eta >= 0; `left` is 1 - s eta. */
static void cold_curve(const mg_par *a, double eta, double left, double *f, double *slope)
{
    const double rho_0 = a->density, square = a->sound_speed * a->sound_speed, Gamma = a->grueneisen, s = a->slope;
    *f = rho_0 * square * eta * (1.0 - 0.5 * Gamma * eta) / (left * left);
    *slope = rho_0 * square * (1.0 + (s - Gamma) * eta) / (left * left * left);
}

/* At y = -ln(1 - s eta) >= 0. */
static curve reference_compressed(const mg_par *a, double y)
{
    const double rho_0 = a->density, square = a->sound_speed * a->sound_speed, Gamma = a->grueneisen, s = a->slope;
    const double eta = -expm1(-y) / s, left = exp(-y), warm = exp(Gamma * eta), rho = rho_0 / (1.0 - eta);
    double f, slope;
    cold_curve(a, eta, left, &f, &slope);
    const double stored = square * warm * heat_integral(a, y), p = f + Gamma * rho_0 * stored;
    return (curve){.p = p,
                   .e = a->specific_heat * a->temperature + stored,
                   .T = a->temperature * warm,
                   .c2 = rho_0 / (rho * rho) * (slope + Gamma * p),
                   .G = Gamma * rho_0};
}

/* At x = rho/rho_0 <= 1; `rest` is x - 1. */
static curve reference_expanded(const mg_par *a, double x, double rest)
{
    const double square = a->sound_speed * a->sound_speed, Gamma = a->grueneisen, n = Gamma + 1.0, L = log1p(rest);
    const double rise = expm1(Gamma * L);
    return (curve){.p = a->density * square / n * expm1(n * L),
                   .e = a->specific_heat * a->temperature + square / n * (rise / Gamma + expm1(-L)),
                   .T = a->temperature * (1.0 + rise),
                   .c2 = square * (1.0 + rise),
                   .G = Gamma * a->density * x,
                   .dG = Gamma};
}

static curve curve_at(const mg_par *a, double rho)
{
    const double rest = (rho - a->density) / a->density;
    if (rest <= 0.0) return reference_expanded(a, rho / a->density, rest);
    return reference_compressed(a, -log1p(-a->slope * (rho - a->density) / rho));
}

static void mg_pressure(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                        double *restrict p, double *restrict c2)
{
    const mg_par *a = par;
    for (size_t i = 0; i < n; i++) {
        const curve k = curve_at(a, rho[i]);
        const double heat = e[i] - k.e;
        p[i] = k.p + k.G * heat;
        c2[i] = k.c2 + (k.dG + k.G * k.G / (rho[i] * rho[i])) * heat;
    }
}

mie_grueneisen_state mie_grueneisen_at(const mie_grueneisen_par *a, double rho, double e)
{
    const double rest = (rho - a->density) / a->density, Gamma = a->grueneisen,
                 over = e - a->specific_heat * a->temperature;
    if (rest <= 0.0) {
        const curve k = reference_expanded(a, rho / a->density, rest);
        const double heat = e - k.e;
        return (mie_grueneisen_state){k.p + k.G * heat, k.c2 + (k.dG + k.G * k.G / (rho * rho)) * heat, k.G};
    }
    const double eta = (rho - a->density) / rho, left = 1.0 - a->slope * eta;
    if (!(left > 0.0)) return (mie_grueneisen_state){NAN, NAN, NAN};
    double f, slope;
    cold_curve(a, eta, left, &f, &slope);
    const double p = f + Gamma * a->density * over;
    return (mie_grueneisen_state){p, a->density / (rho * rho) * (slope + Gamma * p), Gamma * a->density};
}

static void mg_temperature(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                           double *restrict T)
{
    const mg_par *a = par;
    for (size_t i = 0; i < n; i++) {
        const curve k = curve_at(a, rho[i]);
        T[i] = k.T + (e[i] - k.e) / a->specific_heat;
    }
}

static double energy_at(const mg_par *a, double rho, double T)
{
    const curve k = curve_at(a, rho);
    return k.e + a->specific_heat * (T - k.T);
}

static void mg_energy(const void *par, size_t n, const double *restrict rho, const double *restrict T,
                      double *restrict e)
{
    for (size_t i = 0; i < n; i++) e[i] = energy_at(par, rho[i], T[i]);
}

/* (dp/drho)_T */
static double isothermal(const mg_par *a, const curve *k, double rho, double T)
{
    return k->c2 + a->specific_heat * (k->dG * (T - k->T) - k->G * k->G * k->T / (rho * rho));
}

/* rho < rho_0: (rho_0 c_0^2/n - G_0 c_v T_0) x^n + G_0 c_v T x = p + rho_0 c_0^2/n, G_0 = Gamma rho_0, is convex in x,
 * so that Newton comes down to the root from above: from what each term alone would need. */
static double expanded_density(const mg_par *a, double p, double T)
{
    enum { MOST = 100 };
    const double n = a->grueneisen + 1.0, stiff = a->density * a->sound_speed * a->sound_speed / n;
    const double warm = a->grueneisen * a->density * a->specific_heat, cold = stiff - warm * a->temperature;
    double x = fmin(1.0, fmin(pow((p + stiff) / cold, 1.0 / n), (p + stiff) / (warm * T)));
    for (int k = 0; k < MOST; k++) {
        const double power = pow(x, a->grueneisen);
        const double step = (cold * power * x + warm * T * x - (p + stiff)) / (n * cold * power + warm * T);
        x -= step;
        if (!(step > 2e-16 * x)) break;
    }
    return a->density * x;
}

/* rho > rho_0: Newton in y, in steps of one at most; in y the pressure rises like exp(2 y). */
static double compressed_density(const mg_par *a, double p, double T)
{
    enum { MOST = 100 };
    const double heat = a->grueneisen * a->density * a->specific_heat;
    double y = 0.0, before = INFINITY;
    for (int k = 0; k < MOST; k++) {
        const curve c = reference_compressed(a, y);
        const double eta = -expm1(-y) / a->slope, rho = a->density / (1.0 - eta);
        const double slope = isothermal(a, &c, rho, T) * rho * rho / a->density * exp(-y) / a->slope;
        const double step = fmin((p - c.p - heat * (T - c.T)) / slope, 1.0);
        if (fabs(step) < 1.0 && fabs(step) >= before) break;
        y = fmax(y + step, 0.0);
        if (fabs(step) <= 1e-17 + 1e-16 * y) break;
        before = fabs(step);
        if (step >= 1.0) before = INFINITY;
    }
    return a->density / (1.0 + expm1(-y) / a->slope);
}

static void mg_volume(const void *par, size_t n, const double *restrict p, const double *restrict T, double *restrict v,
                      double *restrict dvdp)
{
    const mg_par *a = par;
    for (size_t i = 0; i < n; i++) {
        const double at_rho_0 = a->grueneisen * a->density * a->specific_heat * (T[i] - a->temperature);
        const double rho = p[i] > at_rho_0 ? compressed_density(a, p[i], T[i]) : expanded_density(a, p[i], T[i]);
        const curve k = curve_at(a, rho);
        v[i] = 1.0 / rho;
        dvdp[i] = -v[i] * v[i] / isothermal(a, &k, rho, T[i]);
    }
}

static void mg_dpde(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                    double *restrict dpde)
{
    const mg_par *a = par;
    (void)e;
    for (size_t i = 0; i < n; i++) dpde[i] = a->grueneisen * fmin(rho[i], a->density);
}

/* alpha = -(dp/dT) (dv/dp) / v at constant v and T. */
static void mg_heat(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                    double *restrict cv, double *restrict alpha)
{
    const mg_par *a = par;
    for (size_t i = 0; i < n; i++) {
        const curve k = curve_at(a, rho[i]);
        const double T = k.T + (e[i] - k.e) / a->specific_heat;
        cv[i] = a->specific_heat;
        alpha[i] = k.G * a->specific_heat / (rho[i] * isothermal(a, &k, rho[i], T));
    }
}

/* T = 0, rho = 0. */
static double mg_pressure_floor(const void *par)
{
    const mg_par *a = par;
    return -a->density * a->sound_speed * a->sound_speed / (a->grueneisen + 1.0);
}

/* T = 0. */
static double mg_energy_floor(const void *par, double rho)
{
    return energy_at(par, rho, 0.0);
}

static double mg_density_limit(const void *par)
{
    const mg_par *a = par;
    return a->slope > 1.0 ? a->density * a->slope / (a->slope - 1.0) : (double)INFINITY;
}

static const char *mg_check(const void *par)
{
    const mg_par *a = par;
    const double Gamma = a->grueneisen;
    if (!(Gamma < 2.0 * a->slope)) return "its grueneisen must be less than twice its slope";
    if (!(a->sound_speed * a->sound_speed > Gamma * (Gamma + 1.0) * a->specific_heat * a->temperature))
        return "its sound_speed^2 must be over grueneisen (grueneisen + 1) specific_heat temperature";
    return NULL;
}

const eos_model eos_mie_grueneisen = {
    .name = "mie_grueneisen",
    .doc = "a solid or liquid under shock, after Mie and Grueneisen, from its Hugoniot u_shock = c_0 + s u",
    .cite = "M. A. Meyers, Dynamic Behavior of Materials (1994); coefficients: S. P. Marsh (ed.), LASL Shock "
            "Hugoniot Data (1980)",
    .param_size = sizeof(mg_par),
    .params = mg_params,
    .n_params = sizeof mg_params / sizeof *mg_params,
    .pressure = mg_pressure,
    .temperature = mg_temperature,
    .energy = mg_energy,
    .volume = mg_volume,
    .dpde = mg_dpde,
    .heat = mg_heat,
    .pressure_floor = mg_pressure_floor,
    .energy_floor = mg_energy_floor,
    .density_limit = mg_density_limit,
    .check = mg_check,
};
