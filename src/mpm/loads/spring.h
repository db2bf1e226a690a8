/* Springs and tethers between points, or between a point and a fixed position (spring.c). Private to the mpm module. */
#ifndef MPM_SPRING_H
#define MPM_SPRING_H

#include "mpm/mpm.h"

/* Where a point was last found: a first guess for the next search. */
typedef struct spring_end {
    int block;
    size_t index;
} spring_end;

typedef struct spring_state {
    spring_end end[2];
    double rest_length; /* m */
} spring_state;

/* Finds their points, and their lengths at rest. */
floe_status start_springs(mpm *s);
/* Adds their forces to N_FORCE of a group. */
void scatter_springs(mpm *s, int group);
/* Their energy (J). */
double spring_energy(const mpm *s);
/* The rate (1/s) with which they bound the step, and the name of the spring that does. */
double spring_rate(const mpm *s, const char **name);

#endif
