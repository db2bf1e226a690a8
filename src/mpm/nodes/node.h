/* Nodes: their mass, volume and damping (node.c, node_volume.c). */
#ifndef MPM_NODE_H
#define MPM_NODE_H

#include "mpm/mpm.h"

/* Share of a node's velocity that remains after viscous damping, which is implicit, so that any rate is stable
 * (node.c). */
double damping_left(const mpm *s);
/* Volume (m3; a radian's about an axis) of the shape function of a global node inside the mesh, which sides fold for the group (node_volume.c). */
double node_volume(const mpm *s, int group, const int at[MESH_MAX_DIM]);
/* Threshold (kg): nodes with less mass take no forces. */
double small_node(const mpm *s);
/* v_i = momentum over mass, zero where there is no mass, on the nodes of every block (node.c). */
void divide_momenta(mpm *s, int group, field_id out);

/* The velocity group from `first` on, `other` (-1: none) left out, with the largest mass at a node of a block; -1: none has
 * any. */
static inline int heaviest_group(const mpm *s, const fields *f, ptrdiff_t at, int first, int other)
{
    int found = -1;
    double most = 0.0;
    for (int g = first; g < s->n_groups; ++g) {
        const double mass = g == other ? 0.0 : field_get(f, N_MASS, g, 0)[at];
        if (!(mass > most)) continue;
        most = mass;
        found = g;
    }
    return found;
}

#endif
