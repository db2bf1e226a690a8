/* The collision of two elastic bars, exactly, by the waves in them (Saint-Venant 1867; Goldsmith, Impact (1960),
 * chapter 3): shared by the exact solution of its fields and by the reference of its history. Only src/verify includes
 * this.
 *
 * Bar 0 is on the left. In each bar a wave `out` leaves the face that meets the other bar, runs to the free far end and
 * comes back unchanged after 2 L/c as `in`. At the faces, with impedances z = rho c A, v = out + in and the force is z
 * (in - out) on bar 0 and z (out - in) on bar 1 (pressing positive): both agree in contact, v = 2 (z0 in0 + z1 in1)/(z0
 * + z1), which lasts as long as in0 > in1; a free face has out = in. So `out` is constant but for steps, which are
 * found in turn. */
#ifndef VERIFY_BAR_IMPACT_H
#define VERIFY_BAR_IMPACT_H

#include "verify/verify_internal.h"

typedef struct bar_impact_par {
    double left_length, left_density, left_modulus, left_area, left_velocity;
    double right_length, right_density, right_modulus, right_area, right_velocity;
    double gap, origin;
} bar_impact_par;

/* The entries of a parameter table whose struct begins with a bar_impact_par. */
#define BAR_IMPACT_PARAMS                                                                                          \
    PAR_POSITIVE(bar_impact_par, left_length, "m", NAN, "length of the left bar"),                                 \
        PAR_POSITIVE(bar_impact_par, left_density, "kg/m3", NAN, "density of the left bar"),                       \
        PAR_POSITIVE(bar_impact_par, left_modulus, "Pa", NAN,                                                      \
                     "modulus of the left bar along the axis: E in uniaxial stress, K + 4G/3 in uniaxial strain"), \
        PAR_POSITIVE(bar_impact_par, left_area, "m2", 1.0, "section of the left bar"),                             \
        PAR_ANY(bar_impact_par, left_velocity, "m/s", NAN, "velocity of the left bar at the start"),               \
        PAR_POSITIVE(bar_impact_par, right_length, "m", NAN, "length of the right bar"),                           \
        PAR_POSITIVE(bar_impact_par, right_density, "kg/m3", NAN, "density of the right bar"),                     \
        PAR_POSITIVE(bar_impact_par, right_modulus, "Pa", NAN, "modulus of the right bar along the axis"),         \
        PAR_POSITIVE(bar_impact_par, right_area, "m2", 1.0, "section of the right bar"),                           \
        PAR_ANY(bar_impact_par, right_velocity, "m/s", 0.0, "velocity of the right bar at the start"),             \
        PAR_NONNEGATIVE(bar_impact_par, gap, "m", 0.0, "distance of the bars at the start"),                       \
        PAR_ANY(bar_impact_par, origin, "m", 0.0, "left end of the left bar at the start")

/* An initialiser: the left bar of York (1997), box 15, against one that differs in all. */
#define BAR_IMPACT_SAMPLE                                                                                           \
    {                                                                                                               \
        .left_length = 1.25, .left_density = 1.0, .left_modulus = 1e5, .left_area = 1.0, .left_velocity = 2.0,      \
        .right_length = 2.0, .right_density = 1.5, .right_modulus = 2e5, .right_area = 1.2, .right_velocity = 0.25, \
        .gap = 0.002, .origin = 1.0                                                                                 \
    }

enum { BAR_IMPACT_STEPS = 400 };

/* One bar and its wave: `out` is wave[i] from step[i] of the bar_impact on, and velocity/2 before t = 0. */
typedef struct impact_bar {
    double length, speed, impedance; /* m, m/s, kg/s */
    double velocity, mass;           /* at the start, m/s; kg */
    double face;                     /* x of the face that meets the other bar, at the start */
    double wave[BAR_IMPACT_STEPS];
    double once[BAR_IMPACT_STEPS], twice[BAR_IMPACT_STEPS]; /* integrals of `out` from 0 to step[i], m and m s */
    double square[BAR_IMPACT_STEPS];                        /* integral of its square, m2/s */
} impact_bar;

typedef struct bar_impact {
    impact_bar bar[2];
    int n;
    double step[BAR_IMPACT_STEPS];   /* s, ascending from 0 */
    bool touching[BAR_IMPACT_STEPS]; /* from step[i] on */
    double horizon;                  /* s: known up to here; INFINITY when there are no more steps */
    double contact, release;         /* s: of the first contact, INFINITY if it lasts beyond the horizon */
    double largest_force;            /* N, up to the horizon */
} bar_impact;

/* Errors: FLOE_BAD_INPUT for bars that do not meet. */
floe_status bar_impact_solve(context *ctx, const bar_impact_par *p, bar_impact *out);

/* At time t (0 to horizon) of bar 0 or 1; `depth` is the distance from the face, 0 to length, in the bar at rest. */
double bar_impact_velocity(const bar_impact *b, int which, double depth, double t);
double bar_impact_displacement(const bar_impact *b, int which, double depth, double t);
/* Force over the section, N, tension positive. */
double bar_impact_force(const bar_impact *b, int which, double depth, double t);
/* Of the bar's centre of mass. */
double bar_impact_mean_velocity(const bar_impact *b, int which, double t);
double bar_impact_mean_displacement(const bar_impact *b, int which, double t);
/* Of the velocities of the centres of mass, after the first contact over before it. */
double bar_impact_restitution(const bar_impact *b);
/* Kinetic and strain energy of the bar, J. */
double bar_impact_energy(const bar_impact *b, int which, double t);

#endif
