/* Two long elastic cylinders, or one and a plane, pressed together without friction. */
#include "verify/verify_internal.h"

#include <math.h>

typedef struct hertz_par {
    double force, radius, bulk_modulus, shear_modulus;
    double centre[3];
} hertz_par;

static const param_spec hertz_params[] = {
    PAR_POSITIVE(hertz_par, force, "N/m", NAN, "force that presses, a metre of depth, of the whole contact"),
    PAR_POSITIVE(hertz_par, radius, "m", NAN, "of the cylinder on a plane; of two 1/R = 1/R1 + 1/R2"),
    PAR_POSITIVE(hertz_par, bulk_modulus, "Pa", NAN, "bulk modulus K of both"),
    PAR_POSITIVE(hertz_par, shear_modulus, "Pa", NAN, "shear modulus G of both"),
    PAR_VECTOR(hertz_par, centre, "m", PARAM_ANY, 0.0, "middle of the contact, which lies along x (its z is ignored)"),
};

typedef struct hertz_constants {
    double half_width, peak; /* m, Pa */
    double poisson;
} hertz_constants;

static floe_status hertz_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)ctx;
    (void)dim;
    const double pi = 3.14159265358979323846;
    const hertz_par *p = par;
    hertz_constants *c = prepared;
    c->poisson = 0.5 * (3.0 * p->bulk_modulus - 2.0 * p->shear_modulus) / (3.0 * p->bulk_modulus + p->shear_modulus);
    const double stiffness = p->shear_modulus / (1.0 - c->poisson); /* E* of two of the same */
    c->half_width = sqrt(4.0 * p->force * p->radius / (pi * stiffness));
    c->peak = 2.0 * p->force / (pi * c->half_width);
    return FLOE_OK;
}

/* Stress at a depth z below the contact: along x, across, and shear (Johnson 1985, eq. 4.49). */
static void stress_below(const hertz_constants *c, double x, double z, double stress[3])
{
    const double a2 = c->half_width * c->half_width, mean = a2 - x * x + z * z;
    const double root = sqrt(mean * mean + 4.0 * x * x * z * z);
    const double m = sqrt(fmax(0.0, 0.5 * (root + mean))), n = copysign(sqrt(fmax(0.0, 0.5 * (root - mean))), x);
    const double sum = m * m + n * n, share = sum > 0.0 ? (z * z + n * n) / sum : 0.0;
    const double scale = c->peak / c->half_width;
    stress[0] = -scale * (m * (1.0 + share) - 2.0 * z);
    stress[1] = -scale * m * (1.0 - share);
    stress[2] = sum > 0.0 ? -scale * n * (m * m - z * z) / sum : 0.0;
}

static double hertz_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                          double t)
{
    (void)t;
    (void)dim;
    const hertz_par *p = par;
    const hertz_constants *c = prepared;
    const double height = x[1] - p->centre[1];
    double stress[3];
    stress_below(c, x[0] - p->centre[0], fabs(height), stress);
    switch (quantity) {
    case EXACT_STRESS_XX: return stress[0];
    case EXACT_STRESS_YY: return stress[1];
    case EXACT_STRESS_ZZ: return c->poisson * (stress[0] + stress[1]);
    case EXACT_STRESS_XY: return height < 0.0 ? -stress[2] : stress[2];
    case EXACT_PRESSURE: return -(1.0 + c->poisson) * (stress[0] + stress[1]) / 3.0;
    default:
        return is_velocity(quantity) || quantity == EXACT_STRESS_YZ || quantity == EXACT_STRESS_ZX ? 0.0 : (double)NAN;
    }
}

enum { HALF_WIDTH, PEAK_PRESSURE };

static const exact_scalar hertz_scalars[] = {
    [HALF_WIDTH] = {"half_width", "m", "of the strip that is pressed"},
    [PEAK_PRESSURE] = {"peak_pressure", "Pa", "in its middle"},
};

static double hertz_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)par;
    (void)t;
    const hertz_constants *c = prepared;
    return i == HALF_WIDTH ? c->half_width : c->peak;
}

static const hertz_par sample = {.force = 1078.8, .radius = 1.0, .bulk_modulus = 833333.33, .shear_modulus = 384615.38};

const exact_model exact_hertz = {
    .name = "hertz",
    .doc = "cylinder pressed on a plane or another cylinder of the same material without friction, plane strain",
    .cite = "Hertz (1882); McEwen (1949); Johnson, Contact Mechanics (1985), section 4.2, eqs 4.43 to 4.49",
    .validity = "small strains, bodies that are large against the half-width a: stresses within a few a of the contact",
    .equations = EXACT_SOLID,
    .param_size = sizeof(hertz_par),
    .params = hertz_params,
    .n_params = COUNT_OF(hertz_params),
    .min_dim = 2,
    .max_dim = 2,
    .provides = EXACT_STRESSES | EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE),
    .scalars = hertz_scalars,
    .n_scalars = COUNT_OF(hertz_scalars),
    .sample = {.par = &sample, .dim = 2, .lo = {0.01, -0.1}, .hi = {0.1, -0.02}},
    .prepared_size = sizeof(hertz_constants),
    .prepare = hertz_prepare,
    .value = hertz_value,
    .scalar = hertz_scalar,
};
