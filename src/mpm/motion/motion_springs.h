/* Springs on bodies that do not deform (motion.c). */
#ifndef MPM_MOTION_SPRINGS_H
#define MPM_MOTION_SPRINGS_H

#include "mpm/mpm.h"

/* Whether a body has a motion of its own. */
bool motion_has_body(const mpm *s, int body);
/* Where a place of such a body (m) is when the forces of springs on it are taken: those beside cells act half before and half after the motion
 * of the step, which conserves the energy of a spring with its length in the middle of the step. */
void motion_foresee(const mpm *s, int body, const double x[3], double ahead[3]);
/* A force (N) there, over a kick. */
void motion_push(mpm *s, int body, const double ahead[3], const double force[3]);
/* 1/kg: velocity of a place by a unit of impulse along a unit vector. */
double motion_compliance(mpm *s, int body, const double x[3], const double unit[3]);

#endif
