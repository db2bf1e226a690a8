#include "verify/piston.h"

#include "verify/verify_internal.h"

floe_status piston_check(context *ctx, const piston *p)
{
    if (p->spring_mass == 0.0 || p->stiffness > 0.0) return FLOE_OK;
    return fail_key(ctx, KEY("spring_mass"), "%g kg: a spring with a mass needs a stiffness > 0", p->spring_mass);
}

/* Times in which a wave runs through the fluid and through the spring, s. */
static double fluid_time(const piston *p)
{
    return p->length * sqrt(p->density / p->bulk_modulus);
}

static double spring_time(const piston *p)
{
    return p->spring_mass > 0.0 ? sqrt(p->spring_mass / p->stiffness) : 0.0;
}

/* z cot z. */
static double z_cot(double z)
{
    return z > 0.0 ? z / tan(z) : 1.0;
}

static double shock_residual(double omega, void *user)
{
    const piston *p = user;
    const double fluid = p->bulk_modulus * p->area / p->length * z_cot(omega * fluid_time(p));
    return p->mass * omega * omega - fluid - p->stiffness * z_cot(omega * spring_time(p));
}

/* The residual grows from -infinity to infinity between two poles, and from below 0 in the first interval. A root that
 * lies next to a pole to nine digits is a mode in which the piston hardly moves: the edge of the interval stands for
 * it. */
static double root_between(const piston *p, double lo, double hi)
{
    piston copy = *p;
    const double margin = 1e-9 * (hi - lo);
    const double from = lo > 0.0 ? lo + margin : 0.0;
    const double to = hi - margin;
    if (shock_residual(from, &copy) >= 0.0) return from;
    if (shock_residual(to, &copy) <= 0.0) return to;
    return find_root(shock_residual, &copy, from, to);
}

double piston_frequency(const piston *p, int mode)
{
    const double fluid = VERIFY_PI / fluid_time(p);
    const double spring = spring_time(p) > 0.0 ? VERIFY_PI / spring_time(p) : (double)INFINITY;
    double lo = 0.0;
    double fluid_poles = 1.0;
    double spring_poles = 1.0;
    for (; mode > 0; mode--) {
        const double hi = fmin(fluid_poles * fluid, spring_poles * spring);
        if (mode == 1) return root_between(p, lo, hi);
        /* where both poles agree there is one interval less, and no mode that moves the piston */
        if (fluid_poles * fluid <= hi * (1.0 + 1e-9)) fluid_poles += 1.0;
        if (spring_poles * spring <= hi * (1.0 + 1e-9)) spring_poles += 1.0;
        lo = hi;
    }
    return NAN;
}

/* Mean of sin^2(z x)/sin^2(z) over x from 0 to 1. */
static double mean_square(double z)
{
    return z > 0.0 ? (0.5 - 0.25 * sin(2.0 * z) / z) / (sin(z) * sin(z)) : 1.0 / 3.0;
}

double piston_modal_mass(const piston *p, double omega)
{
    const double fluid = p->density * p->area * p->length;
    return p->mass + fluid * mean_square(omega * fluid_time(p)) + p->spring_mass * mean_square(omega * spring_time(p));
}
