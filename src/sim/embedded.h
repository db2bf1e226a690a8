/* The coupled step with embedded boundaries (membranes around gas, or surfaces of solids): the boundaries separate
 * gases, take their pressure, and move. */
#ifndef SIM_EMBEDDED_H
#define SIM_EMBEDDED_H

#include "coupling/wall_response.h"
#include "embedded/cut.h"
#include "sim/sim.h"

/* A boundary in the step: a membrane, or the surfaces of all solids beside a fluid. */
typedef struct embedded_boundary {
    int body;  /* body of the membrane, of the points; 0 for surfaces */
    int fluid; /* of surfaces: the fluid that they bound, by its number in the scene, or the first of several that share cells; -1: a membrane */
    cut_surface place[CUT_PLACES];   /* its positions, as in ice_embedded_boundary */
    double *velocity, *path, *force; /* of the vertices, three numbers each; owned */
    double *temperature, *heat_flow; /* K, W: of the vertices, where heat passes them; owned */
    int reserved;                    /* vertices for which these are allocated */
    double share; /* its share of the mass of all membranes, and of the lost energy of points that heats its gas */
} embedded_boundary;

typedef struct embedded {
    context *ctx;       /* not owned */
    stage_list *stages; /* not owned */
    mpm *points;        /* not owned */
    ice *gases;         /* not owned */
    embedded_boundary boundary[SCENE_MAX_ENCLOSING];
    int n_boundaries;
    wall_response walls; /* response of the pressure on light solids to their motion (theory 7.6) */
    bool nested;         /* it is known which membranes are inside which */
} embedded;

floe_status embedded_create(struct embedded **out, sim *s);
void embedded_destroy(struct embedded **t);
/* Initial state of the cells; the points have been seeded. */
floe_status embedded_initialise(sim *s);
floe_status embedded_step(sim *s);
/* Whether the next step has implicit wall pressures (theory 7.6). */
void embedded_use_wall_response(embedded *t, bool implicit);
/* For implicit steps: finds the cut cells at the current positions, and at the next positions of the points. Errors: as
 * mpm_boundary_vertices, cut_find. */
floe_status embedded_find_still(embedded *t);
floe_status embedded_find_moved(embedded *t);

#endif
