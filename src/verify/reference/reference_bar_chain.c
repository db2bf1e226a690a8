/* A pendulum as a chain of bars: point masses in a line, joined by massless bars, the first one held, a heavy one at
 * the end. m_i d2x_i/dt2 = m_i g + tensions of the bars at i, tension = E A eps along the bar, integrated by CVODE. */
#include "verify/ode.h"
#include "verify/reference.h"
#include "verify/verify_internal.h"

#include "base/memory.h"

#include <gsl/gsl_sf_ellint.h>

typedef struct chain_par {
    double points, first_x, first_y, last_x, last_y, point_mass, end_mass, modulus, area, gravity;
    double one_way, small_strain, tolerance;
} chain_par;

static const param_spec chain_params[] = {
    PAR_BETWEEN(chain_par, points, "1", 2.0, 2000.0, NAN,
                "points of the string, the held one and the heavy one included"),
    PAR_ANY(chain_par, first_x, "m", 0.0, "the first point, which is held"),
    PAR_ANY(chain_par, first_y, "m", 0.0, "height of the first point"),
    PAR_ANY(chain_par, last_x, "m", NAN, "the last point at the start; the others lie evenly between"),
    PAR_ANY(chain_par, last_y, "m", NAN, "height of the last point at the start"),
    PAR_POSITIVE(chain_par, point_mass, "kg", NAN, "mass of each point but the last"),
    PAR_POSITIVE(chain_par, end_mass, "kg", NAN, "mass of the last point"),
    PAR_POSITIVE(chain_par, modulus, "Pa", NAN, "Young's modulus of the string"),
    PAR_POSITIVE(chain_par, area, "m2", NAN, "section of the string: the volume of a point over the points' distance"),
    PAR_NONNEGATIVE(chain_par, gravity, "m/s2", NAN, "acceleration, towards -y"),
    PAR_BETWEEN(chain_par, one_way, "1", 0.0, 1.0, 1.0, "1: bars only pull (wrinkle law); 0: they also push"),
    PAR_BETWEEN(chain_par, small_strain, "1", 0.0, 1.0, 0.0, "0: logarithmic strain; 1: extension over length at rest"),
    PAR_BETWEEN(chain_par, tolerance, "1", 1e-13, 1e-3, 1e-10,
                "of a step, over the size of the pendulum and its speed"),
};

enum { ANGLE, PLACE_X, PLACE_Y, VELOCITY_X, VELOCITY_Y, KINETIC, STRAIN_ENERGY, WORK, QUANTITIES };

static const reference_quantity chain_quantities[QUANTITIES] = {
    [ANGLE] = {"angle", "1", "of the line from the first point to the last with the vertical, towards +x (radians)",
               NULL, false},
    [PLACE_X] = {"x", "m", "place of the last point", NULL, false},
    [PLACE_Y] = {"y", "m", "height of the last point", NULL, false},
    [VELOCITY_X] = {"velocity_x", "m/s", "velocity of the last point", "x", false},
    [VELOCITY_Y] = {"velocity_y", "m/s", "velocity of the last point, upwards", "y", false},
    [KINETIC] = {"kinetic", "J", "kinetic energy", NULL, false},
    [STRAIN_ENERGY] = {"strain_energy", "J", "strain energy: the work of the tensions", NULL, false},
    [WORK] = {"work", "J", "work of gravity since the start: the sum of both energies", NULL, false},
};

/* Unknowns: x, y of the moving points in turn, from the second on, then their velocities in the same order. */
typedef struct chain {
    const chain_par *p;
    bool one_way, small_strain;
    size_t moving; /* points that move */
    double rest;   /* length of a bar, m */
    size_t times;
    double *value; /* [QUANTITIES][times] */
    double start;  /* potential energy at the start, J */
} chain;

static double mass_of(const chain *c, size_t i)
{
    return i + 1 == c->moving ? c->p->end_mass : c->p->point_mass;
}

/* The bar that ends at moving point i: its vector from the point before, and its length. */
static double bar_vector(const chain *c, const double *y, size_t i, double along[2])
{
    const double *to = y + 2 * i;
    along[0] = to[0] - (i > 0 ? to[-2] : c->p->first_x);
    along[1] = to[1] - (i > 0 ? to[-1] : c->p->first_y);
    return sqrt(along[0] * along[0] + along[1] * along[1]);
}

static double bar_strain(const chain *c, double length)
{
    if (c->one_way && length <= c->rest) return 0.0;
    return c->small_strain ? length / c->rest - 1.0 : log(length / c->rest);
}

/* Work of the tension from rest to a length. */
static double bar_energy(const chain *c, double length)
{
    const double strain = bar_strain(c, length);
    const double scale = c->p->modulus * c->p->area * c->rest;
    if (c->small_strain) return 0.5 * scale * strain * strain;
    return strain == 0.0 ? 0.0 : scale * (exp(strain) * (strain - 1.0) + 1.0);
}

static void chain_rate(double t, const double *y, double *dydt, void *user)
{
    (void)t;
    const chain *c = user;
    const size_t half = 2 * c->moving;
    double *force = dydt + half;
    for (size_t k = 0; k < half; k++) {
        dydt[k] = y[half + k];
        force[k] = k % 2 == 1 ? -c->p->gravity : 0.0;
    }
    const double scale = c->p->modulus * c->p->area;
    for (size_t i = 0; i < c->moving; i++) {
        double along[2];
        const double length = bar_vector(c, y, i, along);
        const double tension = scale * bar_strain(c, length) / length;
        for (int a = 0; a < 2; a++) {
            force[2 * i + a] -= tension * along[a] / mass_of(c, i);
            if (i > 0) force[2 * i - 2 + a] += tension * along[a] / c->p->point_mass;
        }
    }
}

static double potential_energy(const chain *c, const double *y)
{
    double sum = 0.0;
    for (size_t i = 0; i < c->moving; i++) sum += mass_of(c, i) * c->p->gravity * y[2 * i + 1];
    return sum;
}

static void chain_take(size_t i, double t, const double *y, void *user)
{
    (void)t;
    const chain *c = user;
    const double *last = y + 2 * c->moving - 2;
    const double *velocity = y + 2 * c->moving;
    double kinetic = 0.0;
    double strain = 0.0;
    for (size_t k = 0; k < c->moving; k++) {
        double along[2];
        const double *v = velocity + 2 * k;
        kinetic += 0.5 * mass_of(c, k) * (v[0] * v[0] + v[1] * v[1]);
        strain += bar_energy(c, bar_vector(c, y, k, along));
    }
    const double all[QUANTITIES] = {[ANGLE] = atan2(last[0] - c->p->first_x, c->p->first_y - last[1]),
                                    [PLACE_X] = last[0],
                                    [PLACE_Y] = last[1],
                                    [VELOCITY_X] = velocity[2 * c->moving - 2],
                                    [VELOCITY_Y] = velocity[2 * c->moving - 1],
                                    [KINETIC] = kinetic,
                                    [STRAIN_ENERGY] = strain,
                                    [WORK] = c->start - potential_energy(c, y)};
    for (size_t q = 0; q < QUANTITIES; q++) c->value[q * c->times + i] = all[q];
}

static double chain_span(const chain_par *p)
{
    return hypot(p->last_x - p->first_x, p->last_y - p->first_y);
}

/* Initial state and absolute tolerances: state[4 moving], absolute[4 moving]. */
static void chain_start(const chain *c, double *state, double *absolute)
{
    const chain_par *p = c->p;
    const double size = p->tolerance * chain_span(p);
    const double tension = p->gravity > 0.0 ? p->gravity : p->modulus * p->area / p->end_mass;
    const double speed = p->tolerance * sqrt(tension * chain_span(p));
    for (size_t i = 0; i < c->moving; i++) {
        const double share = (double)(i + 1) / (double)c->moving;
        state[2 * i] = p->first_x + share * (p->last_x - p->first_x);
        state[2 * i + 1] = p->first_y + share * (p->last_y - p->first_y);
    }
    for (size_t k = 0; k < 4 * c->moving; k++) absolute[k] = k < 2 * c->moving ? size : speed;
}

static floe_status chain_series(context *ctx, const void *par, const void *prepared, size_t n, const double *t,
                                double *value)
{
    (void)prepared;
    const chain_par *p = par;
    chain c = {.p = p,
               .one_way = whole_number(p->one_way) == 1,
               .small_strain = whole_number(p->small_strain) == 1,
               .moving = (size_t)whole_number(p->points) - 1,
               .times = n,
               .value = value};
    double *state;
    c.rest = chain_span(p) / (double)c.moving;
    TRY(memory_new(ctx, &state, 8 * c.moving, sizeof *state));
    double *absolute = state + 4 * c.moving;
    chain_start(&c, state, absolute);
    c.start = potential_energy(&c, state);
    const ode system = {.n = 4 * c.moving,
                        .rate = chain_rate,
                        .take = chain_take,
                        .user = &c,
                        .relative = p->tolerance,
                        .absolute = absolute};
    const floe_status status = ode_solve(ctx, &system, state, n, t);
    memory_free(ctx, &state);
    return status;
}

static floe_status chain_prepare(context *ctx, const void *par, void *prepared)
{
    (void)prepared;
    const chain_par *p = par;
    TRY(check_whole(ctx, "points", p->points));
    TRY(check_whole(ctx, "one_way", p->one_way));
    TRY(check_whole(ctx, "small_strain", p->small_strain));
    if (chain_span(p) > 0.0) return FLOE_OK;
    return fail_key(ctx, KEY("last_x"), "the first and the last point are at the same place (%g, %g)", p->first_x,
                    p->first_y);
}

enum { LENGTH, START_ANGLE, RIGID_PERIOD };

static const reference_scalar chain_scalars[] = {
    [LENGTH] = {"length", "m", "length of the string at rest"},
    [START_ANGLE] = {"start_angle", "1", "angle at the start (radians)"},
    [RIGID_PERIOD] = {"rigid_period", "s",
                      "period of a mass on a rigid string without mass: 4 sqrt(L/g) K(sin(angle/2))"},
};

static double chain_scalar(const void *par, const void *prepared, size_t i)
{
    (void)prepared;
    const chain_par *p = par;
    const double angle = atan2(p->last_x - p->first_x, p->first_y - p->last_y);
    if (i == LENGTH) return chain_span(p);
    if (i == START_ANGLE) return angle;
    if (fabs(sin(0.5 * angle)) >= 1.0) return INFINITY; /* upside down: it stays */
    gsl_sf_result quarter;
    const int status = gsl_sf_ellint_Kcomp_e(fabs(sin(0.5 * angle)), GSL_PREC_DOUBLE, &quarter);
    return status == 0 ? 4.0 * sqrt(chain_span(p) / p->gravity) * quarter.val : (double)NAN;
}

/* Y97, boxes 6 and 7, with a quarter of the points: point volumes of (0.1)^2/3.03 m3 at 40 points. */
static const chain_par york = {.points = 10.0,
                               .first_x = 0.33333,
                               .first_y = 0.9999,
                               .last_x = 0.101,
                               .last_y = 0.303,
                               .point_mass = 1.32e-3,
                               .end_mass = 3.3,
                               .modulus = 1e6,
                               .area = 0.175,
                               .gravity = 20.0,
                               .one_way = 1.0,
                               .tolerance = 1e-10};

const reference_model reference_bar_chain = {
    .name = "bar_chain",
    .doc = "a pendulum of point masses in a line, joined by bars, a heavy mass at the end",
    .cite =
        "York (1997), section 5.7 and appendix A.4.5; integrated by CVODE (Hindmarsh et al., ACM TOMS 31 (2005) 363)",
    .validity =
        "the chain of these very points, straight, unstretched and at rest at the start. Steps resolve the fastest "
        "bar, so that time goes with points^2 (seconds for 10 points over 1.75 s, a minute for 40); the angle "
        "of York's pendulum differs by less than 4e-5 between 10, 20 and 40 points of the same total mass. "
        "Without one_way bars that are pushed in a line buckle: small disturbances grow.",
    .param_size = sizeof(chain_par),
    .params = chain_params,
    .n_params = COUNT_OF(chain_params),
    .quantities = chain_quantities,
    .n_quantities = QUANTITIES,
    .scalars = chain_scalars,
    .n_scalars = COUNT_OF(chain_scalars),
    .sample = &york,
    .sample_end = 0.1,
    .prepare = chain_prepare,
    .series = chain_series,
    .scalar = chain_scalar,
};
