/* A uniform gas at rest, a slab, cylinder or sphere, that expands into a vacuum, until the wave that runs inwards comes
 * near the centre: a rarefaction fan at the edge, bent by the geometry. There is no shock, so that u +- k c, k =
 * 2/(gamma - 1), changes by -+ a c u/r along dr/dt = u +- c (a = 0, 1, 2; Courant & Friedrichs, Supersonic Flow and
 * Shock Waves (1948), section 158).
 *
 * The net of both families of characteristics is marched with the trapezoidal rule from the edge, where the fan is the
 * plane one, on nets of 200, 400 and 800 intervals, and extrapolated. Only src/verify includes this. */
#ifndef VERIFY_RADIAL_FAN_H
#define VERIFY_RADIAL_FAN_H

#include "base/context.h"

enum { FAN_NODES = 200 }; /* intervals of the coarse net in each direction */

typedef struct fan_gas {
    int geometry;                /* a: 0 slab (radius: half its width), 1 cylinder, 2 sphere */
    double radius, sound, gamma; /* m, m/s (of the gas at rest), 1 */
} fan_gas;

/* A place of the net. Extrapolation and interpolation are smooth in these. */
typedef struct fan_node {
    double log_time, radius, velocity, log_sound; /* of s, m, m/s, log of m/s */
} fan_node;

/* node[j][i]: crossing of the i-th outward characteristic with the j-th inward one. The latter leaves the corner with
 * the sound speed c e^(-D j/FAN_NODES), the former the inner edge of the fan at the time limit e^(-D nu (1 -
 * i/FAN_NODES)), where D = 10 log(10) (gamma - 1) and nu = (gamma + 1)/(2 gamma - 2): both evenly spaced for the plane
 * fan. log_time is infinite where they do not cross by some time after the limit. */
typedef struct radial_fan {
    fan_gas gas;
    double limit; /* s: known up to here, 0.6 radius/sound */
    fan_node node[FAN_NODES + 1][FAN_NODES + 1];
} radial_fan;

/* One net with `halvings` (0, 1 ...) of the coarse spacing, at the coarse nodes: second order. Errors:
 * FLOE_NO_MEMORY. */
floe_status radial_fan_march(context *ctx, const fan_gas *gas, int halvings, radial_fan *out);
/* The extrapolated net: a few tenths of a second. Errors: FLOE_NO_MEMORY. */
floe_status radial_fan_solve(context *ctx, const fan_gas *gas, radial_fan *out);

typedef struct fan_state {
    double velocity, sound; /* m/s; sound 0: vacuum, with the velocity of its edge */
} fan_state;

/* At the distance r >= 0 from the centre and 0 <= t <= limit; NAN later. */
fan_state radial_fan_at(const radial_fan *fan, double r, double t);
/* Speed of the edge, which is constant: 2 c/(gamma - 1). */
double fan_front_speed(const fan_gas *gas);

#endif
