/* Motions that bodies of points are given, in place of what their law makes of them (theory 4.17). */
#ifndef SCENE_SCENE_MOTION_H
#define SCENE_SCENE_MOTION_H

#include <stdbool.h>

enum { MOTION_MAX_KNOTS = 128 };

typedef enum motion_kind {
    MOTION_BY_LAW, /* the body deforms */
    MOTION_FIXED,
    MOTION_DRIVEN, /* velocity and spin are given over time */
    MOTION_RIGID   /* a free rigid body */
} motion_kind;

/* Velocity and spin are piecewise linear in time between the knots, and constant before the first and after the last. */
typedef struct scene_motion {
    motion_kind kind;
    bool table;                           /* the deck gives times */
    int n;                                /* knots; at least 1 where the body is driven */
    double time[MOTION_MAX_KNOTS];        /* s */
    double velocity[MOTION_MAX_KNOTS][3]; /* m/s: of the point about which the body turns */
    double spin[MOTION_MAX_KNOTS];        /* 1/s: about the axis */
    double about[3];                      /* m: that point at t = 0; NAN: the centre of mass */
    double axis[3];                       /* of the spin, fixed in space; of any length */
    double turning[3];                    /* 1/s: spin of a rigid body at the start */
} scene_motion;

/* Whether the nodes do not move the body. */
static inline bool motion_is_given(const scene_motion *m)
{
    return m->kind != MOTION_BY_LAW;
}

/* Whether position and velocity are known beforehand. */
static inline bool motion_is_prescribed(const scene_motion *m)
{
    return m->kind == MOTION_FIXED || m->kind == MOTION_DRIVEN;
}

/* Unit vector along the axis. */
void motion_axis(const scene_motion *m, double out[3]);
/* Velocity (m/s) and spin (1/s) of a prescribed motion at a time. */
void motion_rates(const scene_motion *m, double t, double velocity[3], double *spin);
/* Their exact integrals from one time to a later one (m, rad). */
void motion_travel(const scene_motion *m, double from, double to, double way[3], double *angle);
/* Velocity (m/s) of the body at x at the start, by its motion; `velocity`: that which the deck gives the body. False: about
 * its centre of mass, which is not known here. */
bool motion_velocity_at_start(const scene_motion *m, const double velocity[3], const double x[3], double out[3]);
/* The largest speed (m/s) along each axis, and spin (1/s), between t and the end of the part of the table that t is in. */
void motion_largest(const scene_motion *m, double t, double speed[3], double *spin);

#endif
