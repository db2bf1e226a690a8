/* Shared by the files of this module. Only src/verify includes it. */
#ifndef VERIFY_INTERNAL_H
#define VERIFY_INTERNAL_H

#include "verify/exact.h"

#include <math.h>
#include <stddef.h>

#define VERIFY_PI 3.14159265358979323846

/* Flow between plates, from the start: while nu t is less than this part of the height squared, images of the plates
 * say it, later modes do. So many of either leave less than 1e-17. */
#define VERIFY_EARLY 0.05
enum { VERIFY_IMAGES = 5, VERIFY_MODES = 11 };

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

/* A parameter that stands for a whole number (an axis, a mode, a choice). */
static inline int whole_number(double x)
{
    return (int)lround(x);
}

/* Errors: FLOE_BAD_INPUT unless x is a whole number. */
floe_status check_whole(context *ctx, const char *key, double x);
/* Errors: FLOE_BAD_INPUT unless the parameter `axis` is 0 ... dim - 1. */
floe_status check_axis(context *ctx, double axis, int dim);

/* `value` when the velocity (or displacement) component is `axis`, else 0. `first` is the enumerator of the x
 * component. */
static inline double component_along(exact_quantity quantity, exact_quantity first, int axis, double value)
{
    return (int)quantity - (int)first == axis ? value : 0.0;
}

static inline bool is_velocity(exact_quantity quantity)
{
    return quantity >= EXACT_VELOCITY_X && quantity <= EXACT_VELOCITY_Z;
}

static inline bool is_displacement(exact_quantity quantity)
{
    return quantity >= EXACT_DISPLACEMENT_X && quantity <= EXACT_DISPLACEMENT_Z;
}

/* Internal energy (J/kg) and temperature (K) of a stiffened gas at (rho, p): e = (p + gamma p_inf)/((gamma - 1) rho),
 * T = (p + p_inf)/((gamma - 1) c_v rho). c_v = 0 stands for "not given": NAN. p_inf = 0: an ideal gas. */
static inline double gas_energy(double rho, double p, double gamma, double p_inf)
{
    return (p + gamma * p_inf) / ((gamma - 1.0) * rho);
}

static inline double gas_temperature(double rho, double p, double gamma, double p_inf, double heat_capacity)
{
    return heat_capacity > 0.0 ? (p + p_inf) / ((gamma - 1.0) * heat_capacity * rho) : (double)NAN;
}

/* What an ideal gas at (rho, p) has of density, pressure, energy and temperature; NAN for another quantity. */
static inline double gas_value(exact_quantity quantity, double rho, double p, double gamma, double heat_capacity)
{
    switch (quantity) {
    case EXACT_DENSITY: return rho;
    case EXACT_PRESSURE: return p;
    case EXACT_INTERNAL_ENERGY: return gas_energy(rho, p, gamma, 0.0);
    case EXACT_TEMPERATURE: return gas_temperature(rho, p, gamma, 0.0, heat_capacity);
    default: return NAN;
    }
}

/* The same of a gas in a simple wave, where the speed of sound is `ratio` times that of the gas at rest, (rho, p). */
static inline double simple_wave_value(exact_quantity quantity, double rho, double p, double gamma,
                                       double heat_capacity, double ratio)
{
    return gas_value(quantity, rho * pow(ratio, 2.0 / (gamma - 1.0)), p * pow(ratio, 2.0 * gamma / (gamma - 1.0)),
                     gamma, heat_capacity);
}

/* Errors: FLOE_BAD_INPUT unless a gas of that speed of sound can follow the velocity `key`, instead of leaving a
 * vacuum. */
floe_status simple_wave_check(context *ctx, const char *key, double velocity, double sound, double gamma);

/* A viscous ideal gas of even pressure between two walls of given temperatures, of which one slides: what two flows
 * have in common at the share s of the way from wall to wall by which conduction alone would be linear. */
typedef struct hot_walls {
    double pressure, gamma, heat_capacity; /* Pa, 1, J/kg/K: c_v */
    double first, second;                  /* K: of the walls, at s = 0 and s = 1 */
    double heating;                        /* K: mu U^2/(2 k), of the shear */
} hot_walls;
/* Pressure, density, energy and temperature, T = T_1 + (T_2 - T_1) s + heating s (1 - s); NAN for another quantity. */
double hot_walls_value(const hot_walls *w, exact_quantity quantity, double s);

typedef double root_function(double x, void *user);

/* The root of f in [lo, hi] to round-off (Brent's method, GSL); f must change sign there. NAN when it does not, when f
 * is not finite where it is asked, or when memory is out. */
double find_root(root_function *f, void *user, double lo, double hi);

/* The profile of a plane wave: a Gaussian exp(-s^2/2), s = (x - centre)/width, or a sine sin(2 pi (x -
 * centre)/width). */
typedef struct profile {
    bool sine;
    double centre; /* m */
    double width;  /* m, > 0: standard deviation, or wavelength */
    double period; /* m; 0: not periodic. Gaussians sum their images (exact to round-off for width <= period/4) */
} profile;

double profile_value(const profile *f, double x);
/* The largest |f| and the largest |df/dx|, as upper bounds that are attained by the lone profile. */
double profile_largest_slope(const profile *f);
/* Errors: FLOE_BAD_INPUT when width does not fit the period. */
floe_status profile_check(context *ctx, const profile *f);

#endif
