/* Shape functions at an arbitrary position of the mesh, for loads at positions other than points of a tile: loaded surfaces, springs. Private to the mpm
 * module. */
#ifndef MPM_STENCIL_H
#define MPM_STENCIL_H

#include "mpm/mpm.h"

enum { STENCIL_NODES = BASIS_MAX_SUPPORT * BASIS_MAX_SUPPORT * BASIS_MAX_SUPPORT };

/* Nodes by global index, with their weights; `mass` if the caller needs it. */
typedef struct place_stencil {
    int n;
    int node[STENCIL_NODES][3];
    double w[STENCIL_NODES], mass[STENCIL_NODES];
} place_stencil;

/* The basis at a place (m), as if the tile were the whole mesh; beyond the mesh that of the nearest cell. */
place_stencil stencil_at(const mpm *s, const double x[3]);
/* The block whose cells contain a position. */
int place_block(const mpm *s, const double x[3]);

typedef void stencil_node(void *user, ptrdiff_t at, double weight, double mass);
/* Visits the nodes of a stencil in a block, ghosts included. */
void visit_stencil(const block *b, const place_stencil *st, stencil_node *visit, void *user);

/* Adds a force (N) to a group's nodes, with the weights of a stencil. */
void push_stencil(const mpm *s, int group, const place_stencil *st, const double force[3]);
/* Adds a force (N) at a place to a group's nodes, with the weights of the place. */
void push_nodes(const mpm *s, int group, const double x[3], const double force[3]);

#endif
