/* The coupled step with embedded boundaries (membranes around gas, or surfaces of solids): the boundaries separate
 * gases, take their pressure, and move. */
#ifndef SIM_SEALED_GASES_H
#define SIM_SEALED_GASES_H

#include "coupling/wall_response.h"
#include "embedded/cut.h"
#include "sim/sim.h"

/* A boundary in the step: a membrane, or the surfaces of all solids beside a fluid. */
typedef struct sealed_line {
    int body;  /* body of the membrane, of the points; 0 for surfaces */
    int fluid; /* of surfaces: the fluid that they bound, by its number in the scene, or the first of several that share cells; -1: a membrane */
    cut_surface place[SEAL_PLACES];  /* its positions, as in ice_seal_line */
    double *velocity, *path, *force; /* of the vertices, three numbers each; owned */
    int reserved;                    /* vertices for which these are allocated */
    double share; /* its share of the mass of all membranes, and of the lost energy of points that heats its gas */
} sealed_line;

typedef struct sealed {
    context *ctx;       /* not owned */
    stage_list *stages; /* not owned */
    mpm *points;        /* not owned */
    ice *gases;         /* not owned */
    sealed_line line[SCENE_MAX_ENCLOSING];
    int n_lines;
    wall_response walls; /* response of the pressure on light solids to their motion (theory 7.6) */
    bool nested;         /* it is known which membranes are inside which */
} sealed;

floe_status sealed_create(struct sealed **out, sim *s);
void sealed_destroy(struct sealed **t);
/* Initial state of the cells; the points have been seeded. */
floe_status sealed_initialise(sim *s);
floe_status sealed_step(sim *s);
/* Whether the next step has implicit wall pressures (theory 7.6). */
void sealed_use_wall_response(sealed *t, bool implicit);
/* For implicit steps: finds the cut cells at the current positions, and at the next positions of the points. Errors: as
 * mpm_boundary_vertices, cut_find. */
floe_status sealed_find_still(sealed *t);
floe_status sealed_find_moved(sealed *t);

#endif
