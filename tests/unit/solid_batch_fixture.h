/* A batch of one point of 1000 kg/m3, as it is before any strain. */
#ifndef TESTS_UNIT_SOLID_BATCH_FIXTURE_H
#define TESTS_UNIT_SOLID_BATCH_FIXTURE_H

#include "material/solid.h"

#include <string.h>

static inline void batch_start(solid_batch *b, double dt)
{
    memset(b, 0, sizeof *b);
    b->n = 1;
    b->dt = dt;
    b->J[0] = b->J_old[0] = 1.0;
    b->rho0[0] = 1000.0;
    for (int k = 0; k < 9; k += 4) b->F[k][0] = 1.0;
}

#endif
