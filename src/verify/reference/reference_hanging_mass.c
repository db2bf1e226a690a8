/* A mass that falls on a spring, or on a slack string, which have no mass: free fall until the string is taut, one
 * swing of an oscillator, free flight up, and again. With x the stretch beyond the rest length, m v^2/2 + W(x) - m g x
 * is constant. The swing is that of the two-way law between its turning points x_a <= 0 < x_b: with x = c - a
 * cos(theta) the time dt = a sin(theta) d theta/v is the integral of a smooth function (a constant one for Hooke's
 * law). */
#include "verify/reference.h"
#include "verify/verify_internal.h"

#include <gsl/gsl_integration.h>

typedef struct mass_par {
    double mass, modulus, area, length, gravity, slack, origin;
    double one_way, small_strain, constant_volume;
} mass_par;

static const param_spec mass_params[] = {
    PAR_POSITIVE(mass_par, mass, "kg", NAN, "mass"),
    PAR_POSITIVE(mass_par, modulus, "Pa", NAN, "Young's modulus of the spring"),
    PAR_POSITIVE(mass_par, area, "m2", NAN, "section of the spring at rest"),
    PAR_POSITIVE(mass_par, length, "m", NAN, "length of the spring at rest"),
    PAR_POSITIVE(mass_par, gravity, "m/s2", NAN, "acceleration, downwards"),
    PAR_NONNEGATIVE(mass_par, slack, "m", 0.0, "free fall before the string is taut; needs one_way: 1"),
    PAR_ANY(mass_par, origin, "m", 0.0, "height of the mass at the start, where it is at rest"),
    PAR_BETWEEN(mass_par, one_way, "1", 0.0, 1.0, 0.0, "1: a string, which only pulls; 0: a spring"),
    PAR_BETWEEN(mass_par, small_strain, "1", 0.0, 1.0, 0.0, "0: logarithmic strain; 1: extension over length at rest"),
    PAR_BETWEEN(mass_par, constant_volume, "1", 0.0, 1.0, 0.0,
                "0: the section does not change; 1: the volume does not"),
};

typedef struct mass_motion {
    double energy;      /* of mass and spring over that of the taut mass at rest, J */
    double low, high;   /* turning points of the stretch, m */
    double start;       /* theta at which it becomes taut */
    double fall, swing; /* s: until it is taut; from there to the lowest point */
} mass_motion;

static double mass_tension(const mass_par *p, double x)
{
    const double strain = whole_number(p->small_strain) ? x / p->length : log1p(x / p->length);
    const double area = p->area * (whole_number(p->constant_volume) ? p->length / (p->length + x) : 1.0);
    return p->modulus * area * strain;
}

/* W, the work of the tension. */
static double tension_work(const mass_par *p, double x)
{
    const double scale = p->modulus * p->area;
    const double log_stretch = log1p(x / p->length);
    if (whole_number(p->small_strain)) {
        return whole_number(p->constant_volume) ? scale * (x - p->length * log_stretch)
                                                : 0.5 * scale * x * x / p->length;
    }
    return whole_number(p->constant_volume) ? 0.5 * scale * p->length * log_stretch * log_stretch
                                            : scale * ((p->length + x) * log_stretch - x);
}

typedef struct swing {
    const mass_par *p;
    const mass_motion *m;
    const gsl_integration_glfixed_table *table;
    double time; /* sought */
} swing;

static double kinetic_at(double x, void *user)
{
    const swing *s = user;
    return s->m->energy + s->p->mass * s->p->gravity * x - tension_work(s->p, x);
}

/* x = c - a cos(theta), written so that no digits are lost next to the turning points. */
static double stretch_at(const mass_motion *m, double theta)
{
    return m->low + (m->high - m->low) * pow(sin(0.5 * theta), 2.0);
}

static double time_rate(double theta, void *user)
{
    const swing *s = user;
    const double reach = 0.5 * (s->m->high - s->m->low) * sin(theta);
    return reach * sqrt(0.5 * s->p->mass / kinetic_at(stretch_at(s->m, theta), user));
}

static double time_to(const swing *s, double theta)
{
    gsl_function f = {time_rate, (void *)s};
    if (theta <= s->m->start) return 0.0;
    return gsl_integration_glfixed(&f, s->m->start, theta, s->table);
}

static double time_excess(double theta, void *user)
{
    const swing *s = user;
    return time_to(s, theta) - s->time;
}

static floe_status check_choices(context *ctx, const mass_par *p)
{
    TRY(check_whole(ctx, "one_way", p->one_way));
    TRY(check_whole(ctx, "small_strain", p->small_strain));
    TRY(check_whole(ctx, "constant_volume", p->constant_volume));
    if (p->slack == 0.0 || whole_number(p->one_way)) return FLOE_OK;
    return fail_key(ctx, KEY("slack"), "%g m: a spring has none; set one_way: 1 for a string", p->slack);
}

static floe_status find_turns(context *ctx, const mass_par *p, mass_motion *m)
{
    swing s = {.p = p, .m = m};
    double far = p->length;
    for (int i = 0; i < 60 && kinetic_at(far, &s) > 0.0; i++) far *= 2.0;
    /* The lowest point is beyond that of equilibrium, where the kinetic energy is largest. */
    double balanced = far;
    while (mass_tension(p, balanced) > p->mass * p->gravity) balanced *= 0.5;
    m->high = find_root(kinetic_at, &s, balanced, far);
    m->low = p->slack > 0.0 ? find_root(kinetic_at, &s, -p->length * (1.0 - 1e-12), 0.0) : 0.0;
    if (isfinite(m->low) && isfinite(m->high)) return FLOE_OK;
    return fail_key(ctx, KEY("mass"), "the spring (modulus %g, area %g, length %g) cannot stop the mass %g", p->modulus,
                    p->area, p->length, p->mass);
}

static gsl_integration_glfixed_table *gauss_table(context *ctx, floe_status *status)
{
    enum { NODES = 32 }; /* the integrand is smooth: round-off */
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(NODES);
    *status = table != NULL ? FLOE_OK : fail(ctx, FLOE_NO_MEMORY, "no memory for the nodes of a quadrature");
    return table;
}

static floe_status mass_prepare(context *ctx, const void *par, void *prepared)
{
    const mass_par *p = par;
    mass_motion *m = prepared;
    floe_status status;
    TRY(check_choices(ctx, p));
    m->energy = p->mass * p->gravity * p->slack;
    m->fall = sqrt(2.0 * p->slack / p->gravity);
    TRY(find_turns(ctx, p, m));
    m->start = acos(fmax(-1.0, (m->high + m->low) / (m->high - m->low)));
    gsl_integration_glfixed_table *table = gauss_table(ctx, &status);
    TRY(status);
    m->swing = time_to(&(swing){.p = p, .m = m, .table = table}, VERIFY_PI);
    gsl_integration_glfixed_table_free(table);
    return FLOE_OK;
}

enum { POSITION, VELOCITY, TENSION, KINETIC, STRAIN_ENERGY, WORK, QUANTITIES };

static const reference_quantity mass_quantities[QUANTITIES] = {
    [POSITION] = {"position", "m", "height of the mass", NULL, false},
    [VELOCITY] = {"velocity", "m/s", "velocity of the mass, upwards", "position", false},
    [TENSION] = {"tension", "N", "force of the spring on the mass", NULL, false},
    [KINETIC] = {"kinetic", "J", "kinetic energy", NULL, false},
    [STRAIN_ENERGY] = {"strain_energy", "J", "strain energy of the spring: the work of its tension", NULL, false},
    [WORK] = {"work", "J", "work of gravity since the start: the sum of both energies", NULL, false},
};

/* Fall u (m) and its rate at a time within the swing down, from 0 to m->swing. */
static void swing_state(swing *s, double time, double *u, double *rate)
{
    s->time = fmin(time, s->m->swing * (1.0 - 1e-15));
    const double theta = find_root(time_excess, s, s->m->start, VERIFY_PI);
    const double x = stretch_at(s->m, theta);
    *u = x + s->p->slack;
    *rate = sqrt(2.0 * fmax(kinetic_at(x, s), 0.0) / s->p->mass);
}

static void string_state_at(swing *s, double t, double *u, double *rate)
{
    const double half = s->m->fall + s->m->swing;
    const double cycle = fmod(t, 2.0 * half);
    const double sign = cycle <= half ? 1.0 : -1.0;
    const double time = cycle <= half ? cycle : 2.0 * half - cycle;
    if (time <= s->m->fall) {
        *u = 0.5 * s->p->gravity * time * time;
        *rate = s->p->gravity * time;
    } else {
        swing_state(s, time - s->m->fall, u, rate);
    }
    *rate *= sign;
}

static floe_status mass_series(context *ctx, const void *par, const void *prepared, size_t n, const double *t,
                               double *value)
{
    const mass_par *p = par;
    floe_status status;
    gsl_integration_glfixed_table *table = gauss_table(ctx, &status);
    TRY(status);
    swing s = {.p = p, .m = prepared, .table = table};
    for (size_t i = 0; i < n; i++) {
        double u, rate;
        string_state_at(&s, t[i], &u, &rate);
        const double x = fmax(u - p->slack, 0.0);
        value[POSITION * n + i] = p->origin - u;
        value[VELOCITY * n + i] = -rate;
        value[TENSION * n + i] = mass_tension(p, x);
        value[KINETIC * n + i] = 0.5 * p->mass * rate * rate;
        value[STRAIN_ENERGY * n + i] = tension_work(p, x);
        value[WORK * n + i] = p->mass * p->gravity * u;
    }
    gsl_integration_glfixed_table_free(table);
    return FLOE_OK;
}

enum { TAKE_UP, LOWEST, REBOUND, APEX, DROP, LARGEST_TENSION };

static const reference_scalar mass_scalars[] = {
    [TAKE_UP] = {"take_up", "s", "time at which the slack is taken up"},
    [LOWEST] = {"lowest", "s", "time at the lowest point"},
    [REBOUND] = {"rebound", "s", "time at which the string is slack again"},
    [APEX] = {"period", "s", "time back at the start, and period"},
    [DROP] = {"drop", "m", "fall from the start to the lowest point"},
    [LARGEST_TENSION] = {"largest_tension", "N", "force of the spring at the lowest point"},
};

static double mass_scalar(const void *par, const void *prepared, size_t i)
{
    const mass_par *p = par;
    const mass_motion *m = prepared;
    const double time[] = {[TAKE_UP] = m->fall,
                           [LOWEST] = m->fall + m->swing,
                           [REBOUND] = m->fall + 2.0 * m->swing,
                           [APEX] = 2.0 * (m->fall + m->swing)};
    if (i == DROP) return p->slack + m->high;
    return i == LARGEST_TENSION ? mass_tension(p, m->high) : time[i];
}

/* Y97, boxes 3 and 5: the slack by logarithmic strain. */
static const mass_par york = {.mass = 3.33,
                              .modulus = 1e6,
                              .area = 0.1,
                              .length = 0.3 + 0.0210,
                              .gravity = 250.0,
                              .slack = 0.0210,
                              .origin = 1.69,
                              .one_way = 1.0};

const reference_model reference_hanging_mass = {
    .name = "hanging_mass",
    .doc = "a mass on a spring, or on a slack string, under gravity",
    .cite = "York (1997), sections 5.5 (eq. 5.11) and 5.6",
    .validity =
        "a spring without mass (one with mass makes the period longer by a sixth of their ratio) and no loss where it "
        "becomes taut; it may compress unless one_way is 1. A spring with Hooke's law, small_strain 1, swings as -(m "
        "g/k)(1 - cos(omega t)), k = modulus area/length. Of a string that is slack in part, length is the length at "
        "rest of all of it, and area that length over the sum of length at rest/area of the parts.",
    .param_size = sizeof(mass_par),
    .params = mass_params,
    .n_params = COUNT_OF(mass_params),
    .quantities = mass_quantities,
    .n_quantities = QUANTITIES,
    .scalars = mass_scalars,
    .n_scalars = COUNT_OF(mass_scalars),
    .sample = &york,
    .sample_end = 0.1,
    .prepared_size = sizeof(mass_motion),
    .prepare = mass_prepare,
    .series = mass_series,
    .scalar = mass_scalar,
};
