/* Springs and tethers between points, or between a point and a fixed position (spring.c). Private to the mpm module. */
#ifndef MPM_SPRING_H
#define MPM_SPRING_H

#include "mpm/work.h"

/* Finds their points, and their lengths at rest. */
floe_status start_springs(mpm *s);
/* Adds their forces to N_FORCE of a group. */
void scatter_springs(mpm *s, int group);
/* Their energy (J). */
double spring_energy(const mpm *s);
/* The rate (1/s) with which they bound the step, and the name of the spring that does. */
double spring_rate(const mpm *s, const char **name);

#endif
