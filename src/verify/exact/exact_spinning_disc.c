/* A disc, or a cylinder, that spins about its axis: a motion with large rotations and small strains. */
#include "verify/verify_internal.h"

typedef struct disc_par {
    double radius, density, bulk_modulus, shear_modulus, spin, plane_stress;
    double centre[3];
} disc_par;

static const param_spec disc_params[] = {
    PAR_POSITIVE(disc_par, radius, "m", NAN, "radius of the disc"),
    PAR_POSITIVE(disc_par, density, "kg/m3", NAN, "density at rest"),
    PAR_POSITIVE(disc_par, bulk_modulus, "Pa", NAN, "bulk modulus K"),
    PAR_POSITIVE(disc_par, shear_modulus, "Pa", NAN, "shear modulus G"),
    PAR_ANY(disc_par, spin, "1/s", NAN, "angular velocity (radians), from the first axis to the second"),
    PAR_BETWEEN(disc_par, plane_stress, "1", 0.0, 1.0, 0.0, "0: plane strain; 1: plane stress"),
    PAR_VECTOR(disc_par, centre, "m", PARAM_ANY, 0.0, "a point of the axis (its z is ignored)"),
};

/* sigma_r = a (R^2 - r^2), sigma_theta = a R^2 - b r^2, u_r = r (c R^2 - d r^2). */
typedef struct disc_constants {
    double a, b, c, d;
    double out_of_plane; /* sigma_z over sigma_r + sigma_theta */
} disc_constants;

static floe_status disc_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    (void)dim;
    const disc_par *p = par;
    disc_constants *c = prepared;
    TRY(check_whole(ctx, "plane_stress", p->plane_stress));
    const bool thin = whole_number(p->plane_stress) == 1;
    const double K = p->bulk_modulus;
    const double G = p->shear_modulus;
    const double poisson = 0.5 * (3.0 * K - 2.0 * G) / (3.0 * K + G);
    /* plane strain is plane stress with other constants */
    const double nu = thin ? poisson : poisson / (1.0 - poisson);
    const double E = 2.0 * G * (1.0 + nu);
    const double load = p->density * p->spin * p->spin / 8.0;
    c->a = load * (3.0 + nu);
    c->b = load * (1.0 + 3.0 * nu);
    c->c = load * (1.0 - nu) * (3.0 + nu) / E;
    c->d = load * (1.0 - nu) * (1.0 + nu) / E;
    c->out_of_plane = thin ? 0.0 : poisson;
    return FLOE_OK;
}

static double disc_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                         double t)
{
    (void)dim;
    const disc_par *p = par;
    const disc_constants *c = prepared;
    const double at[2] = {x[0] - p->centre[0], x[1] - p->centre[1]};
    const double square = at[0] * at[0] + at[1] * at[1];
    const double size = p->radius * p->radius;
    if (!(square <= size * (1.0 + 1e-9))) return NAN;
    const double cosine = cos(p->spin * t);
    const double sine = sin(p->spin * t);
    /* The place now is the turned one times 1 + strain; written so that small displacements lose no digits. */
    const double strain = c->c * size - c->d * square;
    const double turned[2] = {cosine * at[0] - sine * at[1], sine * at[0] + cosine * at[1]};
    const double less = -2.0 * pow(sin(0.5 * p->spin * t), 2.0);
    const double moved[2] = {strain * turned[0] + less * at[0] - sine * at[1],
                             strain * turned[1] + less * at[1] + sine * at[0]};
    const double now[2] = {(1.0 + strain) * turned[0], (1.0 + strain) * turned[1]};
    const double radial = c->a * (size - square);
    const double hoop = c->a * size - c->b * square;
    /* cos and sin of twice the angle of the place now, over which the polar stress is turned; 1 and 0 at the centre */
    const double norm = now[0] * now[0] + now[1] * now[1];
    const double cos2 = norm > 0.0 ? (now[0] * now[0] - now[1] * now[1]) / norm : 1.0;
    const double sin2 = norm > 0.0 ? 2.0 * now[0] * now[1] / norm : 0.0;
    switch (quantity) {
    case EXACT_DENSITY: return p->density;
    case EXACT_VELOCITY_X: return -p->spin * now[1];
    case EXACT_VELOCITY_Y: return p->spin * now[0];
    case EXACT_DISPLACEMENT_X: return moved[0];
    case EXACT_DISPLACEMENT_Y: return moved[1];
    case EXACT_STRESS_XX: return 0.5 * (radial + hoop) + 0.5 * (radial - hoop) * cos2;
    case EXACT_STRESS_YY: return 0.5 * (radial + hoop) - 0.5 * (radial - hoop) * cos2;
    case EXACT_STRESS_XY: return 0.5 * (radial - hoop) * sin2;
    case EXACT_STRESS_ZZ: return c->out_of_plane * (radial + hoop);
    case EXACT_PRESSURE: return -(1.0 + c->out_of_plane) * (radial + hoop) / 3.0;
    default:
        return is_velocity(quantity) || is_displacement(quantity) || quantity == EXACT_STRESS_YZ ||
                       quantity == EXACT_STRESS_ZX
                   ? 0.0
                   : (double)NAN;
    }
}

static const exact_scalar disc_scalars[] = {
    {"period", "s", "time of a turn"},
    {"largest_stress", "Pa", "stress at the centre"},
};

static double disc_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)t;
    const disc_par *p = par;
    const disc_constants *c = prepared;
    return i == 0 ? 2.0 * VERIFY_PI / fabs(p->spin) : c->a * p->radius * p->radius;
}

static const disc_par sample_par = {
    .radius = 0.5, .density = 1000.0, .bulk_modulus = 1e12, .shear_modulus = 4e11, .spin = 2.0};

const exact_model exact_spinning_disc = {
    .name = "spinning_disc",
    .doc = "a disc or cylinder that spins freely about its axis",
    .cite = "Timoshenko & Goodier, Theory of Elasticity, 3rd ed. (1970), art. 32",
    .validity =
        "linear elasticity in the turning frame, x the place at rest: error of the order of the strain, density "
        "(spin radius)^2/modulus. In plane stress it is that of a thin disc. No ends: it does not change along z.",
    .equations = EXACT_SOLID,
    .param_size = sizeof(disc_par),
    .params = disc_params,
    .n_params = COUNT_OF(disc_params),
    .min_dim = 2,
    .max_dim = 3,
    .provides =
        EXACT_STRESSES | EXACT_DISPLACEMENTS | EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_DENSITY),
    .scalars = disc_scalars,
    .n_scalars = COUNT_OF(disc_scalars),
    /* At t = 0, where the axes of the balance are those of the disc at rest. */
    .sample = {.par = &sample_par, .dim = 2, .lo = {0.05, 0.05}, .hi = {0.3, 0.3}, .t = 0.0},
    .prepared_size = sizeof(disc_constants),
    .prepare = disc_prepare,
    .value = disc_value,
    .scalar = disc_scalar,
};
