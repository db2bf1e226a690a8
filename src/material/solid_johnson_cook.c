/* Metal plasticity after Johnson and Cook: von Mises yield at the flow stress
 *
 *   y = (A + B alpha^n) (1 + C ln max(r, 1)) (1 - T*^m),   r = (d alpha/dt) / reference_rate,
 *   T* = (T - reference_temperature) / (melting_temperature - reference_temperature), within 0 and 1,
 *
 * alpha the equivalent plastic strain. The elastic trial stress (hypoelastic.h) is returned along its deviator: q - 3 G
 * d alpha = y(alpha + d alpha, d alpha/dt), by Newton's method in a bracket; y does not fall with d alpha, so there is
 * one solution. T is that of the start of the step. Plastic work, the integral of A + B alpha^n times the two other
 * factors, becomes internal energy.
 *
 * Damage D grows by d alpha / alpha_f (Johnson and Cook 1985),
 *
 *   alpha_f = [D1 + D2 exp(D3 min(sigma*, 3/2))] (1 + D4 ln max(r, 1)) (1 + D5 T*),   sigma* = mean stress / q,
 *
 * and does not change the flow stress. A point that begins a step with D >= 1, or a mean stress above tension_strength,
 * has failed as that of solid_j2.c. */
#include "material/metal.h"
#include "material/solid_checks.h"

typedef struct johnson_cook_par {
    metal_par metal;
    double yield_stress, hardening_modulus, hardening_exponent;            /* A, B (Pa), n */
    double rate_coefficient, reference_rate;                               /* C, 1/s */
    double softening_exponent, melting_temperature, reference_temperature; /* m, K, K */
    double d1, d2, d3, d4, d5;
    double tension_strength; /* Pa; 0: never fails by it */
} johnson_cook_par;

static const param_spec johnson_cook_params[] = {
    ELASTIC_MODULI,
    PAR_POSITIVE(johnson_cook_par, yield_stress, "Pa", NAN,
                 "A, the yield stress before any plastic strain (OFHC copper: 90 MPa)"),
    PAR_NONNEGATIVE(johnson_cook_par, hardening_modulus, "Pa", 0.0,
                    "B, what the yield stress has risen by at a plastic strain of 1 (OFHC copper: 292 MPa)"),
    PAR_BETWEEN(johnson_cook_par, hardening_exponent, "1", 0.01, 2.0, 1.0, "n of the hardening (OFHC copper: 0.31)"),
    PAR_NONNEGATIVE(johnson_cook_par, rate_coefficient, "1", 0.0, "C, of the strain rate (OFHC copper: 0.025)"),
    PAR_POSITIVE(johnson_cook_par, reference_rate, "1/s", 1.0,
                 "plastic strain rate from which on the rate hardens; slower is as slow as this"),
    PAR_BETWEEN(johnson_cook_par, softening_exponent, "1", 0.1, 5.0, 1.0,
                "m of the thermal softening (OFHC copper: 1.09)"),
    PAR_NONNEGATIVE(
        johnson_cook_par, melting_temperature, "K", 0.0,
        "at which no shear is left (OFHC copper: 1356 K); the material needs a specific_heat. 0: no thermal softening"),
    PAR_POSITIVE(johnson_cook_par, reference_temperature, "K", 300.0, "below which nothing softens"),
    PAR_ANY(johnson_cook_par, d1, "1", 0.0, "D1 of the failure strain (OFHC copper: 0.54); D1 and D2 0: no damage"),
    PAR_NONNEGATIVE(johnson_cook_par, d2, "1", 0.0, "D2 of the failure strain (OFHC copper: 4.89)"),
    PAR_BETWEEN(johnson_cook_par, d3, "1", -100.0, 0.0, 0.0,
                "D3 of the failure strain, over mean stress by equivalent stress (OFHC copper: -3.03)"),
    PAR_NONNEGATIVE(johnson_cook_par, d4, "1", 0.0, "D4 of the failure strain, of the rate (OFHC copper: 0.014)"),
    PAR_NONNEGATIVE(johnson_cook_par, d5, "1", 0.0, "D5 of the failure strain, of the temperature (OFHC copper: 1.12)"),
    PAR_NONNEGATIVE(johnson_cook_par, tension_strength, "Pa", 0.0,
                    "mean stress above which a point fails, and from then on bears pressure alone; 0: never"),
    METAL_PRESSURE,
};

enum { DAMAGE = METAL_HISTORY, HISTORY_COUNT };

static const solid_history johnson_cook_history[HISTORY_COUNT] = {
    METAL_HISTORY_ROWS,
    [DAMAGE] = {"damage", "1", "share of the failure strain that is used up; 1: failed"},
};

/* The published range of mean stress over equivalent stress; the failure strain falls no further beyond. */
static const double MOST_TRIAXIALITY = 1.5;

static bool softens(const johnson_cook_par *a)
{
    return a->melting_temperature > 0.0;
}

static bool has_damage(const johnson_cook_par *a)
{
    return a->d1 != 0.0 || a->d2 != 0.0;
}

/* T*. */
static double homologous_temperature(const johnson_cook_par *a, double T)
{
    if (!softens(a)) return 0.0;
    const double share = (T - a->reference_temperature) / (a->melting_temperature - a->reference_temperature);
    return fmin(fmax(share, 0.0), 1.0);
}

/* ln max(r, 1). */
static double log_rate(const johnson_cook_par *a, double rate)
{
    return rate > a->reference_rate ? log(rate / a->reference_rate) : 0.0;
}

/* What a point brings into a step. */
typedef struct flow_state {
    double q, alpha, dt; /* Pa: of the trial; 1; s */
    double soft;         /* 1 - T*^m */
} flow_state;

/* The flow stress (Pa) after a plastic strain of x in the step, and its slope over x. */
static double flow_stress(const johnson_cook_par *a, const flow_state *p, double x, double *slope)
{
    const double alpha = p->alpha + x, power = a->hardening_modulus * pow(alpha, a->hardening_exponent);
    const double rate = p->dt > 0.0 ? x / p->dt : 0.0, factor = 1.0 + a->rate_coefficient * log_rate(a, rate);
    *slope = p->soft * factor * (alpha > 0.0 ? a->hardening_exponent * power / alpha : 0.0);
    if (rate > a->reference_rate) *slope += p->soft * (a->yield_stress + power) * a->rate_coefficient / x;
    return p->soft * factor * (a->yield_stress + power);
}

/* The plastic strain of a step whose trial is beyond `yield`, the flow stress at none: between 0 and (q - yield)/(3 G),
 * where y would not rise. Newton's method; where that leaves the bracket, its middle. */
static double plastic_flow(const johnson_cook_par *a, const flow_state *p, double yield)
{
    enum { MOST = 200 };
    const double G3 = 3.0 * a->metal.elastic.shear_modulus;
    double low = 0.0, high = (p->q - yield) / G3, x = high;
    for (int k = 0; k < MOST; k++) {
        double slope;
        const double left = p->q - G3 * x - flow_stress(a, p, x, &slope);
        if (left > 0.0)
            low = x;
        else
            high = x;
        if (fabs(left) <= 4e-16 * p->q) break;
        const double step = left / (G3 + slope);
        double next = x + step;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (next == x || !(high > low)) break;
        x = next;
    }
    return x;
}

/* Returns the trial stress to the yield surface; the plastic work per current volume (J/m3). */
static double return_to_yield(const johnson_cook_par *a, solid_batch *b, size_t i, double s[6])
{
    const double G3 = 3.0 * a->metal.elastic.shear_modulus, mean = mean_stress(s), q = equivalent_stress(s, mean);
    const double hot = homologous_temperature(a, b->temperature[i]), alpha = b->history[PLASTIC_STRAIN][i];
    const flow_state p = {q, alpha, b->dt, hot > 0.0 ? 1.0 - pow(hot, a->softening_exponent) : 1.0};
    double slope;
    if (!(q > p.soft * a->yield_stress)) return 0.0; /* y is at least that */
    const double yield = flow_stress(a, &p, 0.0, &slope);
    if (!(q > yield)) return 0.0;
    const double flow = plastic_flow(a, &p, yield), n = a->hardening_exponent;
    const double rate = log_rate(a, b->dt > 0.0 ? flow / b->dt : 0.0);
    return_stress(s, mean, 1.0 - G3 * flow / q, mean);
    b->history[PLASTIC_STRAIN][i] = alpha + flow;
    if (has_damage(a)) {
        const double flowing = q - G3 * flow, most = MOST_TRIAXIALITY * flowing;
        const double triaxiality = mean < most ? mean / flowing : MOST_TRIAXIALITY;
        const double failure = (a->d1 + a->d2 * exp(a->d3 * triaxiality)) * (1.0 + a->d4 * rate) * (1.0 + a->d5 * hot);
        b->history[DAMAGE][i] += flow / failure;
    }
    const double hardened = a->hardening_modulus / (n + 1.0) * (pow(alpha + flow, n + 1.0) - pow(alpha, n + 1.0));
    return p.soft * (1.0 + a->rate_coefficient * rate) * (a->yield_stress * flow + hardened);
}

static bool fails_now(const johnson_cook_par *a, const solid_batch *b, size_t i)
{
    if (b->history[FAILED][i] != 0.0) return false;
    return b->history[DAMAGE][i] >= 1.0 || (a->tension_strength > 0.0 && mean_stress_at(b, i) > a->tension_strength);
}

static size_t johnson_cook_stress(const void *par, double p_ref, solid_batch *b)
{
    const johnson_cook_par *a = par;
    const double K = a->metal.elastic.bulk_modulus, G = a->metal.elastic.shear_modulus;
    double before[SOLID_CHUNK];
    (void)p_ref; /* the stress of a solid is gauge already */
    const bool planar = spins_about_z_alone(b);
    for (size_t i = 0; i < b->n; i++) {
        double s[6], lost = 0.0; /* J per initial volume */
        before[i] = mean_stress_at(b, i);
        if (fails_now(a, b, i)) lost = metal_fail(&a->metal, b, i);
        hypoelastic_step(lame_lambda(&a->metal.elastic), G, b, i, planar, s);
        if (b->history[FAILED][i] != 0.0)
            bear_pressure_alone(K, s, &b->history[OPENING][i]);
        else
            lost = 0.5 * (b->J[i] + b->J_old[i]) * return_to_yield(a, b, i, s);
        for (int k = 0; k < 6; k++) b->stress[k][i] = s[k];
        b->energy[i] += (lost - b->q[i] * (b->J[i] - b->J_old[i])) / b->rho0[i];
    }
    const size_t inverted = solid_first_inverted(b);
    return inverted != 0 || a->metal.grueneisen == 0.0 ? inverted : metal_shock_pressure(&a->metal, b, before);
}

static double johnson_cook_yield_stress(const void *par)
{
    return ((const johnson_cook_par *)par)->yield_stress;
}

static unsigned johnson_cook_depends(const void *par)
{
    const johnson_cook_par *a = par;
    const unsigned heat = softens(a) ? SOLID_BY_TEMPERATURE : 0, rate = a->rate_coefficient > 0.0 ? SOLID_BY_RATE : 0;
    return metal_depends(par) | heat | rate;
}

static const char *johnson_cook_check(const void *par)
{
    const johnson_cook_par *a = par;
    if (softens(a) && !(a->melting_temperature > a->reference_temperature))
        return "its melting_temperature must be above its reference_temperature";
    if (has_damage(a) && !(a->d1 + a->d2 * exp(a->d3 * MOST_TRIAXIALITY) > 0.0))
        return "its failure strain must be positive up to a mean stress of 1.5 times the equivalent stress: d1 + d2 "
               "exp(1.5 d3) > 0";
    if (!has_damage(a) && (a->d3 != 0.0 || a->d4 != 0.0 || a->d5 != 0.0))
        return "its d3, d4 and d5 change a failure strain that d1 or d2 must give";
    if (a->d5 > 0.0 && !softens(a)) return "its d5 needs a melting_temperature";
    return metal_check(par);
}

const solid_model solid_johnson_cook = {
    .name = "johnson_cook",
    .doc = "metal plasticity after Johnson and Cook: hardening by strain and rate, thermal softening, damage",
    .cite = "G. R. Johnson, W. H. Cook, Proc. 7th Int. Symp. Ballistics (1983) 541; Engng Fract. Mech. 21 (1985) 31",
    .param_size = sizeof(johnson_cook_par),
    .params = johnson_cook_params,
    .n_params = sizeof johnson_cook_params / sizeof *johnson_cook_params,
    .needs = SOLID_HAS_ENERGY,
    .history = johnson_cook_history,
    .n_history = HISTORY_COUNT,
    .stress = johnson_cook_stress,
    .wave_speed = metal_wave_speed,
    .strain_energy = metal_strain_energy,
    .bulk_modulus = elastic_bulk_modulus,
    .shear_modulus = elastic_shear_modulus,
    .yield_stress = johnson_cook_yield_stress,
    .depends = johnson_cook_depends,
    .check = johnson_cook_check,
};
