/* The step of gases beside lines that cut the cells, a membrane that holds gas or the surfaces of solids: the lines bear the gases'
 * pressure, and move. */
#ifndef SIM_SEALED_H
#define SIM_SEALED_H

#include "coupling/cut.h"
#include "sim/sim.h"

/* What a step knows of the lines. */
typedef struct sealed {
    context *ctx;       /* not owned */
    stage_list *stages; /* not owned */
    mpm *points;        /* not owned */
    ice *gases;         /* not owned */
    cut_line now, next;
    cut_line mean[ICE_SEAL_PLACES];  /* where they pass in the step, going on as they do now */
    double *velocity, *path, *force; /* of the vertices, two each; owned */
    int room;                        /* vertices that these hold */
} sealed;

floe_status sealed_create(struct sealed **out, sim *s);
void sealed_destroy(struct sealed **t);
/* Points are seeded; the cells get the gases. */
floe_status sealed_initialise(sim *s);
floe_status sealed_step(sim *s);
/* Of lines that do not move: where they are, for the gases too; and where the points have gone. Errors: as mpm_outline, cut_find. */
floe_status sealed_find_still(sealed *t);
floe_status sealed_find_moved(sealed *t);

#endif
