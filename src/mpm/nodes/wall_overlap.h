/* Overlaps of bodies with unilateral sides: contact springs at the nodes of a side.
 *
 * The nodes of a side have the mass of a layer of half a cell. Stopping that layer at once would be a perfectly
 * inelastic impact: a bar of n cells lost 1/n of its energy and more afterwards. The contact force at a node is
 * therefore that of a spring of the overlap delta, the time integral of the velocity into the side since points have
 * reached it:
 *
 *   force = m w^2 f(delta),   w = 0.85 c/h,
 *
 * with c the speed of sound of the body at rest. It stops the layer within a few steps and returns all its energy;
 * contact ends when the overlap is zero. f(delta) = delta while delta is small against a cell; then it hardens to eight
 * times that slope, at which w is still stable, so that bodies under stresses of the order of their moduli overlap by a
 * fraction of a cell only. Yielding limits the overlap: beyond that of the yield stress y, h y/(0.85^2 G), nodes lose
 * the rest of their velocity into the side, as in an inelastic impact. There is no force before something has
 * approached. */
#ifndef MPM_WALL_OVERLAP_H
#define MPM_WALL_OVERLAP_H

#include "mpm/mpm.h"

/* Properties of the springs at a body's surface. */
typedef struct overlap_surface {
    double speed; /* m/s: of sound in it at rest */
    double flows; /* 1: overlap over spacing at which it yields; infinite where it does not */
} overlap_surface;

struct mpm_overlaps {
    /* m: overlaps of groups at the nodes of sides; 0 where nothing presses. Owned. */
    double *now, *next;
    size_t n;
    bool followed;           /* next is known */
    int nodes[MESH_MAX_DIM]; /* of the whole mesh; a periodic end is node 0 */
    size_t side[MPM_MAX_GROUPS][MESH_MAX_DIM][2];
    overlap_surface surface[SCENE_MAX_BODIES]; /* of our bodies */
    int slowest[SCENE_MAX_BODIES];             /* bodies from the slowest on */
    int rank[SCENE_MAX_BODIES];                /* of a body among them */
};

/* Allocates storage for scenes with unilateral sides. After groups are known. */
floe_status overlaps_create(mpm *s);
void overlaps_free(mpm *s);
/* Commits the next overlaps. */
void overlaps_commit(mpm *s);
/* Index among them; `node`: its index in the whole mesh, or that of a periodic image. */
size_t overlap_of_side(const struct mpm_overlaps *o, int group, int axis, int side, const int node[MESH_MAX_DIM]);
/* m w^2 of a mass (N/m) of a body with this speed of sound, at this spacing. */
double overlap_stiffness(double mass, double speed, double h);
/* f(delta) (m), and its stored energy over m w^2 (m2). */
double overlap_push(double overlap, double h);
double overlap_energy(double overlap, double h);

#endif
