/* Springs, tethers and dashpots between places of bodies, or between one and a fixed position (theory 4.13). Private to the mpm module. */
#ifndef MPM_SPRING_H
#define MPM_SPRING_H

#include "mpm/mpm.h"

/* Places the ends on points, and finds lengths at rest. Errors: FLOE_BAD_INPUT where a body has no such place, FLOE_NO_MEMORY. */
floe_status start_springs(mpm *s);
/* Storage for them. */
floe_status create_springs(mpm *s);
void free_springs(mpm *s);
/* Adds their forces to N_FORCE of a group, or to those on a body that does not deform. */
void scatter_springs(mpm *s, int group);
/* Enters what dashpots have taken in the step; once points have their next positions. */
void enter_dashpots(mpm *s);
/* In static balance: finds the points of both ends of spring n, which sorting moves, and gives their number; 0: one is lost, and the spring is
 * broken. Then number k of them, with its weight, negative at the first end. */
typedef struct spring_share {
    int body, support;   /* that it belongs to; -1: none */
    double x[3], weight; /* m */
} spring_share;
int spring_find(mpm *s, int n);
spring_share spring_share_of(const mpm *s, int n, int k);
/* The spring with its second end moved (m) against the first: force (N) on the second, its stiffness against such motion, without what
 * compression takes across (N/m), and energy (J). */
typedef struct spring_pull {
    double force[3], stiffness[9], energy;
} spring_pull;
void spring_pull_at(const mpm *s, int n, const double moved[3], spring_pull *out);
/* Their energy (J). */
double spring_energy(const mpm *s);
/* The rate (1/s) with which they bound the step, and the name of the spring that does. */
double spring_rate(mpm *s, const char **name);

#endif
