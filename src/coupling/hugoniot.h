/* The state behind a shock, by the conservation of mass, momentum and energy across it (Rankine and Hugoniot). */
#ifndef COUPLING_HUGONIOT_H
#define COUPLING_HUGONIOT_H

#include "material/eos.h"

#include <stdbool.h>

/* v (m3/kg) and e (J/kg) behind a shock of the pressure p1 that runs into fluid at (v0, e0), whose pressure is p0 < p1:
 *     e - e0 = (p1 + p0)(v0 - v)/2,    p(v, e) = p1.
 * False where the law has no such state. */
bool hugoniot_state(const eos *law, double v0, double e0, double p0, double p1, double *v, double *e);

#endif
