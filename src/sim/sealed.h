/* The step of gases that a membrane holds: the membrane cuts the cells, bears the gases' pressure, and moves. */
#ifndef SIM_SEALED_H
#define SIM_SEALED_H

#include "coupling/cut.h"
#include "sim/sim.h"

/* What a step knows of the membrane. */
typedef struct sealed {
    context *ctx;       /* not owned */
    stage_list *stages; /* not owned */
    mpm *points;        /* not owned */
    ice *gases;         /* not owned */
    int body;           /* of the points */
    cut_line now, next;
    double *velocity, *path, *force; /* of the vertices, two each; owned */
    int room;                        /* vertices that these hold */
} sealed;

floe_status sealed_create(struct sealed **out, sim *s);
void sealed_destroy(struct sealed **t);
/* Points are seeded; the cells get the gases. */
floe_status sealed_initialise(sim *s);
floe_status sealed_step(sim *s);

#endif
