/* Mass that reactions take from points. */
#ifndef MPM_BURN_H
#define MPM_BURN_H

#include "mpm/mpm.h"

/* Commits the masses that reactions have left of the points, before sorting; points without mass are dropped then
 * (burn.c). */
void burn_commit(mpm *s);

#endif
