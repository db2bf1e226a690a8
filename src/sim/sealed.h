/* The step of gases beside lines that cut the cells, a membrane that holds gas or the surfaces of solids: the lines
 * bear the gases' pressure, and move. */
#ifndef SIM_SEALED_H
#define SIM_SEALED_H

#include "embedded/cut.h"
#include "sim/sim.h"

/* What a step knows of a membrane, or of the surfaces of all solids beside a fluid. */
typedef struct sealed_line {
    int body;                        /* the membrane's, of the points; 0 for surfaces, which need none */
    int fluid;                       /* of surfaces: what they hold back, by its number in the scene; -1: a membrane */
    cut_surface place[SEAL_PLACES];  /* as in ice_seal_line */
    double *velocity, *path, *force; /* of the vertices, two each; owned */
    int room;                        /* vertices that these hold */
    double share; /* of the mass of all membranes: how much of what the points lose goes into its gas */
} sealed_line;

typedef struct sealed {
    context *ctx;       /* not owned */
    stage_list *stages; /* not owned */
    mpm *points;        /* not owned */
    ice *gases;         /* not owned */
    sealed_line line[SCENE_MAX_HOLDERS];
    int n_lines;
} sealed;

floe_status sealed_create(struct sealed **out, sim *s);
void sealed_destroy(struct sealed **t);
/* Points are seeded; the cells get the gases. */
floe_status sealed_initialise(sim *s);
floe_status sealed_step(sim *s);
/* Of lines that do not move: where they are, for the gases too; and where the points have gone. Errors: as mpm_outline,
 * cut_find. */
floe_status sealed_find_still(sealed *t);
floe_status sealed_find_moved(sealed *t);

#endif
