/* Light solids beside fluids on cells (theory 7.6): the nodes that move the markers of surfaces, and implicit wall pressures.
 * Private to the folder. */
#ifndef MPM_INERTIA_H
#define MPM_INERTIA_H

#include "coupling/wall_response.h"
#include "mpm/motion/motion.h"
#include "mpm/mpm.h"

/* A node, by global index, that moves markers. One that a support leads does so by `share` of the motion of its master, the rest being the support's own
 * velocity (theory 4.13). */
typedef struct inertia_node {
    int group, node[3], master; /* master: by its number; -1: it is not led */
    double share, own[3];       /* m/s */
    double give[3]; /* m/s per N: change of velocity in the step; 0: a wall holds it, or it is too light for forces */
    double before[3], to[3]; /* m/s: velocity, and that at the end of the step by the forces so far */
    double force[3];         /* N: scratch; 0 between uses */
    double change[3];        /* m/s: scratch, where nodes hang together by their stiffness */
} inertia_node;

/* Of a node in a marker's velocity. */
typedef struct inertia_share {
    int node;
    double factor[3];
} inertia_share;

/* A marker on which fluids push. */
typedef struct inertia_marker {
    int vertex, first, n; /* shares */
    body_motion *motion;  /* of a body that does not deform, at `arm` (m) from its centre; NULL: nodes move it */
    double arm[3];
    double force[3], velocity[3]; /* N; m/s: change of its velocity: scratch */
} inertia_marker;

/* Owned arrays, kept from step to step. */
typedef struct marker_inertia {
    inertia_node *node;
    inertia_share *share;
    inertia_marker *marker;
    int *of_vertex; /* number of its marker; -1: no fluid acts on it */
    int *slot;      /* table of nodes, by their numbers plus one; a power of two of them */
    double *value;  /* vectors of the solution, one number a cell (wall_pressures.c) */
    int n_nodes, n_shares, n_markers;
    size_t reserved_nodes, reserved_shares, reserved_vertices, slots, reserved_values;
    rigid_field *change;  /* of bodies that do not deform: scratch */
    double (*impulse)[6]; /* N s, N m s: the same */
} marker_inertia;

/* Finds them for the forces of the fluids. Masses, momenta and forces are those of the step. Errors: FLOE_NO_MEMORY. */
floe_status inertia_find(mpm *s, const wall_response *w);
void inertia_free(mpm *s);
/* More flux (m3/s) out of each cell than the fluids have taken it to be, by the forces so far. */
void inertia_first_flux(const mpm *s, const wall_response *w, double *flux);
/* Change of flux by changes of pressure (Pa). */
void inertia_flux_of(const mpm *s, const wall_response *w, const double *pressure, double *flux);
/* That of a cell by 1 Pa of its own. */
double inertia_own_flux(const mpm *s, const wall_response *w, int cell);
/* Forces (N) of changes of pressure on the markers, in inertia_marker.force. */
void inertia_force_of(const mpm *s, const wall_response *w, const double *pressure);

#endif
