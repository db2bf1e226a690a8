/* What the rest of the module asks of the implicit solver beside its stages (mpm.h). All of it holds without one, too. */
#ifndef MPM_IMPLICIT_VIEW_H
#define MPM_IMPLICIT_VIEW_H

#include "mpm/mpm.h"

void implicit_destroy(mpm *s);
/* Number of enclosed gases, and the body of points of one of them; -1: gas of the cells. */
int implicit_gases(const mpm *s);
int implicit_gas_body(const mpm *s, int gas);
/* Whether contact gaps are measured between the surfaces of the bodies (implicit_gap.c), which then move with the
 * loaded surfaces. */
bool implicit_measures_gaps(const mpm *s);

#endif
