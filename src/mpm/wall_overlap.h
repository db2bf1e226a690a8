/* How far bodies give way where they press on sides that let them go.
 *
 * The nodes of a side bear the mass of a layer of half a cell. To stop that layer at once is an impact without rebound: a bar of n cells
 * lost 1/n of its energy, and more in what followed. So what presses at a node is a spring of the overlap delta, the sum of dt times the
 * velocity into the side since points have come:
 *
 *   force = m w^2 f(delta),   w = 0.85 c/h,
 *
 * c the speed of sound of the body at rest. It takes the layer's motion up within a few steps and gives all of it back; contact ends where the
 * overlap does. f(delta) = delta while that is small against a cell; it then hardens, to eight times the slope, which leaves w below
 * what the step bears, so that bodies pressed by a large part of their moduli stay within a fraction of a cell. What flows keeps no more
 * than it bears: at the overlap of its yield stress y, h y/(0.85^2 G), nodes lose the rest of their velocity into the side as in an impact
 * without rebound. What a node remembers is what it has taken up itself: there is no force as long as nothing has approached. */
#ifndef MPM_WALL_OVERLAP_H
#define MPM_WALL_OVERLAP_H

#include "mpm/mpm.h"

/* What the springs at a body's surface are made of. */
typedef struct overlap_surface {
    double speed; /* m/s: of sound in it at rest */
    double flows; /* 1: overlap over spacing at which it flows; infinite where it does not */
} overlap_surface;

struct mpm_overlaps {
    /* m: of groups at the nodes of sides; 0 where nothing presses. Owned. */
    double *now, *next;
    size_t n;
    bool followed;           /* next is known */
    int nodes[MESH_MAX_DIM]; /* of the whole mesh; a periodic end is node 0 */
    size_t side[MPM_MAX_GROUPS][MESH_MAX_DIM][2];
    overlap_surface surface[SCENE_MAX_BODIES]; /* of our bodies */
    int slowest[SCENE_MAX_BODIES];             /* bodies from the slowest on */
    int rank[SCENE_MAX_BODIES];                /* of a body among them */
};

/* Room for a scene of which sides let go; none for others. After groups are known. */
floe_status overlaps_create(mpm *s);
void overlaps_free(mpm *s);
/* What follows from the step becomes what is remembered. */
void overlaps_commit(mpm *s);
/* The next overlaps, all zero, for those who know them to enter. */
void overlaps_follow(mpm *s);
/* Place among them; `node`: its index in the whole mesh, that of a periodic image too. */
size_t overlap_of_side(const struct mpm_overlaps *o, int group, int axis, int side, const int node[MESH_MAX_DIM]);
/* m w^2 of a mass (N/m) of a body with this speed of sound, at this spacing. */
double overlap_stiffness(double mass, double speed, double h);
/* f(delta) (m), and the energy over m w^2 (m2) that it keeps. */
double overlap_push(double overlap, double h);
double overlap_energy(double overlap, double h);

#endif
