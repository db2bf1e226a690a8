/* What is measured: points of some bodies, or cells of a material. Private to src/run. */
#ifndef RUN_SUBJECT_H
#define RUN_SUBJECT_H

#include "sim/sim.h"
#include "verify/exact.h"

typedef struct subject {
    sim *s;
    const exact *solution;
    bool body[SCENE_MAX_BODIES]; /* bodies of mpm */
    int cells;                   /* material of ice, or CELLS_OF_ALL; -1: none */
} subject;

/* Without a body or a material an exact solution of solids is compared with all of them. verify.body names points; where its material is in cells, or none is named, the material is measured, and where no
 * material is named either, all of several fluids together; in a scene of solids all points. */
subject find_subject(sim *s, const exact *solution);

/* The profile of a one-dimensional scene: every quantity of verify.metrics along x, beside the exact one. */
floe_status profile_of_line(sim *s, const exact *solution, const char *path);

#endif
