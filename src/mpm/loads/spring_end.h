/* The ends of springs: material places, each a weighted mean of points (spring_end.c). Only this folder includes it. */
#ifndef MPM_SPRING_END_H
#define MPM_SPRING_END_H

#include "mpm/loads/spring.h"

/* A point of an end, and where it was last found: a first guess for the next search. */
typedef struct spring_point {
    double id, weight;
    int block;
    size_t index;
} spring_point;

/* Owned. */
typedef struct spring_end {
    int body; /* of ours; -1: a fixed position */
    int n;
    spring_point *point; /* by their ids */
    double compliance;   /* 1/kg: velocity of the place by a unit of impulse along the spring, at most */
} spring_end;

struct spring_state {
    spring_end end[2];
    double rest_length; /* m */
    double pull;        /* N: of the dashpot in the step */
};

/* Places an end on the points of its body. Errors as start_springs. */
floe_status spring_end_start(mpm *s, const scene_spring *spring, int e, spring_end *end);
/* Finds its points again; false where one is lost, and the spring is broken. */
bool spring_end_find(const mpm *s, spring_end *end);
/* Its position (m), now or after the motion of the step. */
void spring_end_position(const mpm *s, const scene_spring_end *given, const spring_end *end, bool next, double x[3]);
/* Its velocity (m/s). */
void spring_end_velocity(const mpm *s, const spring_end *end, double v[3]);
/* Finds spring_end.compliance along a unit vector. */
void spring_end_comply(mpm *s, spring_end *end, const double unit[3]);
/* Whether what one end gives moves the other. */
bool spring_ends_share(const spring_end *a, const spring_end *b);

#endif
