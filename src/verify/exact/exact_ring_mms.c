/* Manufactured solution: a ring whose layers turn about the axis, each by an angle of its own and without any strain in
 * itself.
 *
 *     alpha = A sin(pi c t) (1 - s^2)^2 + W t,   s = (R - R0)/w,   x = R e_r(Theta + alpha)
 *
 * A shear gamma = R alpha' of one layer against the next keeps J = 1; both faces, s = -1 and 1, are free of traction,
 * and stay but for the spin W of the whole, which turns stretch and stress with it. */
#include "verify/verify_internal.h"

typedef struct ring_par {
    double inner_radius, outer_radius, shear_modulus, density, amplitude, frequency, spin;
    double centre[3];
} ring_par;

static const param_spec ring_params[] = {
    PAR_POSITIVE(ring_par, inner_radius, "m", 0.75, "R0 - w: inner radius"),
    PAR_POSITIVE(ring_par, outer_radius, "m", 1.25, "R0 + w: outer radius"),
    PAR_POSITIVE(ring_par, shear_modulus, "Pa", NAN, "shear modulus G = mu"),
    PAR_POSITIVE(ring_par, density, "kg/m3", NAN, "density at rest"),
    PAR_ANY(ring_par, amplitude, "1", NAN, "A: largest angle (radians) by which the middle of the ring turns"),
    PAR_POSITIVE(ring_par, frequency, "Hz", NAN, "c of sin(pi c t): half turns of the phase in a second"),
    PAR_ANY(ring_par, spin, "1/s", 0.0, "W: angle (radians) by which the whole ring turns in a second"),
    PAR_VECTOR(ring_par, centre, "m", PARAM_ANY, 0.0, "a point of the axis (its z is ignored)"),
};

static floe_status ring_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    (void)prepared;
    const ring_par *p = par;
    if (p->outer_radius > p->inner_radius) return FLOE_OK;
    return fail_key(ctx, KEY("outer_radius"), "%g m: must be over inner_radius = %g m", p->outer_radius,
                    p->inner_radius);
}

/* The angle and its derivatives by R and t. */
typedef struct ring_turn {
    double R, angle, rate, acceleration; /* m, 1, 1/s, 1/s2 */
    double slope, bend;                  /* 1/m, 1/m2: alpha', alpha'' */
} ring_turn;

static ring_turn turn_at(const ring_par *p, const double at[2], double t)
{
    const double R = hypot(at[0], at[1]), w = 0.5 * (p->outer_radius - p->inner_radius);
    const double s = (R - p->inner_radius) / w - 1.0, inside = 1.0 - s * s;
    const double omega = VERIFY_PI * p->frequency, now = p->amplitude * sin(omega * t);
    const double bump = inside * inside;
    return (ring_turn){.R = R,
                       .angle = now * bump + p->spin * t,
                       .rate = p->amplitude * omega * cos(omega * t) * bump + p->spin,
                       .acceleration = -omega * omega * now * bump,
                       .slope = -4.0 * now * s * inside / w,
                       .bend = -4.0 * now * (1.0 - 3.0 * s * s) / (w * w)};
}

/* Directions at the place now: e_r, and e_theta a quarter turn on. */
static void axes_now(const ring_turn *turn, const double at[2], double radial[2], double hoop[2])
{
    const double cosine = cos(turn->angle), sine = sin(turn->angle);
    radial[0] = (cosine * at[0] - sine * at[1]) / turn->R;
    radial[1] = (sine * at[0] + cosine * at[1]) / turn->R;
    hoop[0] = -radial[1];
    hoop[1] = radial[0];
}

/* sigma = mu (B - I), B = (e_r + gamma e_theta)^2 + e_theta^2: with J = 1 nothing is left of the law's bulk part. */
static double ring_stress(const ring_par *p, const ring_turn *turn, const double radial[2], const double hoop[2], int i,
                          int j)
{
    const double shear = turn->R * turn->slope;
    return p->shear_modulus * (shear * (radial[i] * hoop[j] + hoop[i] * radial[j]) + shear * shear * hoop[i] * hoop[j]);
}

static double ring_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                         double t)
{
    (void)prepared;
    (void)dim;
    const ring_par *p = par;
    const double at[2] = {x[0] - p->centre[0], x[1] - p->centre[1]};
    const ring_turn turn = turn_at(p, at, t);
    if (!(turn.R >= p->inner_radius * (1.0 - 1e-9) && turn.R <= p->outer_radius * (1.0 + 1e-9))) return NAN;
    double radial[2], hoop[2];
    axes_now(&turn, at, radial, hoop);
    switch (quantity) {
    case EXACT_DENSITY: return p->density;
    case EXACT_DISPLACEMENT_X:
    case EXACT_DISPLACEMENT_Y: {
        const int a = (int)quantity - EXACT_DISPLACEMENT_X;
        return turn.R * radial[a] - at[a];
    }
    case EXACT_VELOCITY_X:
    case EXACT_VELOCITY_Y: return turn.R * turn.rate * hoop[(int)quantity - EXACT_VELOCITY_X];
    case EXACT_STRESS_XX:
    case EXACT_STRESS_YY: {
        const int a = (int)quantity - EXACT_STRESS_XX;
        return ring_stress(p, &turn, radial, hoop, a, a);
    }
    case EXACT_STRESS_XY: return ring_stress(p, &turn, radial, hoop, 0, 1);
    case EXACT_DISPLACEMENT_Z:
    case EXACT_VELOCITY_Z:
    case EXACT_STRESS_ZZ:
    case EXACT_STRESS_YZ:
    case EXACT_STRESS_ZX: return 0.0;
    default: return NAN;
    }
}

/* b_r = -R alpha_t^2 + (mu/rho) R alpha'^2,  b_theta = R alpha_tt - (mu/rho) (R alpha'' + 3 alpha'), in the directions of now. */
static void ring_body_force(const void *par, const void *prepared, int dim, const double x[3], double t,
                            double force[3])
{
    (void)prepared;
    (void)dim;
    const ring_par *p = par;
    const double at[2] = {x[0] - p->centre[0], x[1] - p->centre[1]}, stiffness = p->shear_modulus / p->density;
    const ring_turn turn = turn_at(p, at, t);
    double radial[2], hoop[2];
    axes_now(&turn, at, radial, hoop);
    const double inward = turn.R * (stiffness * turn.slope * turn.slope - turn.rate * turn.rate);
    const double along = turn.R * turn.acceleration - stiffness * (turn.R * turn.bend + 3.0 * turn.slope);
    for (int a = 0; a < 2; a++) force[a] = inward * radial[a] + along * hoop[a];
}

static const exact_scalar ring_scalars[] = {
    {"period", "s", "period of the layers' turning to and fro"},
    {"largest_shear", "1", "about the largest gamma, at s = 1/sqrt(3), the amplitude reached"},
};

static double ring_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)prepared;
    (void)t;
    const ring_par *p = par;
    if (i == 0) return 2.0 / p->frequency;
    const double w = 0.5 * (p->outer_radius - p->inner_radius), s = 1.0 / sqrt(3.0);
    return (p->inner_radius + w * (1.0 + s)) * 4.0 * fabs(p->amplitude) * s * (1.0 - s * s) / w;
}

static const ring_par sample_par = {.inner_radius = 0.75,
                                    .outer_radius = 1.25,
                                    .shear_modulus = 400.0,
                                    .density = 1000.0,
                                    .amplitude = 0.9,
                                    .frequency = 1.0,
                                    .spin = 2.0};

const exact_model exact_ring_mms = {
    .name = "ring_mms",
    .doc = "manufactured large turning of a neo-Hookean ring, layer by layer, with its body force",
    .cite = "Kamojjala, Brannon, Sadeghirad & Guilkey, Eng. with Computers 31 (2015) 193 (the generalized vortex), "
            "with our derivation of the force",
    .validity =
        "x the place at rest (X); strain energy lambda/2 (ln J)^2 - mu ln J + mu/2 (tr C - 3), any lambda; plane "
        "strain; needs `verify.sources`. Both faces are free, or held where nothing spins.",
    .equations = EXACT_LARGE_SOLID,
    .param_size = sizeof(ring_par),
    .params = ring_params,
    .n_params = COUNT_OF(ring_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides = EXACT_DISPLACEMENTS | EXACT_VELOCITIES | EXACT_STRESSES | EXACT_BIT(EXACT_DENSITY),
    .scalars = ring_scalars,
    .n_scalars = COUNT_OF(ring_scalars),
    .sample = {.par = &sample_par, .dim = 2, .lo = {0.6, 0.5}, .hi = {0.85, 0.8}, .t = 0.3},
    .prepare = ring_prepare,
    .value = ring_value,
    .body_force = ring_body_force,
    .scalar = ring_scalar,
};
