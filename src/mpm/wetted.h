/* Where fluid points meet solids: each has a velocity field of its own at the nodes, and at the wall both have one velocity.
 *
 * With one field a node that carries but a sliver of a steel wall is steel, and the gas of one to two cells beside it stands still. Two fields
 * held together node by node do no better where the fluid presses. So what is held is the velocity *of the wall*: the fluid's nodes have
 * N_i = sum_p V_p grad S_ip, the integral of S_i n over the fluid's surface by the points' own quadrature, and for the nodes j of a grid line
 * across the wall sum_j N_j . (v_j^fluid - v_j^solid) = 0, and so along the wall with |N_j|. First the fluid's nodes lose P N_j and the
 * solid's get it, P from sum_j N_j . (f_j - P N_j) = 0: of even pressure that is all that the fluid's nodes are pushed with, to
 * round-off, however its points stand, and a solid at rest bears what it bears with one field. What closing is left is ended by areas and
 * not by masses, of which the lightest node would take all and throw the points that see it.
 *
 * Beside what damping brings to rest one field stays: its nodes of little mass are steadier, and the dead layer has no motion to lose. */
#ifndef MPM_WETTED_H
#define MPM_WETTED_H

#include "mpm/mpm.h"

typedef struct wetted_node {
    int at[MESH_MAX_DIM]; /* global */
    size_t number;        /* of it */
    double mass[2];       /* kg: of the fluid, of the solid */
    double area[3];       /* m2: N */
    double force[3];      /* N: on the fluid */
    double v[2][3];       /* m/s: v^L */
    double before[2][3];  /* m/s: that the step begins with */
    double gained[2][3];  /* m/s: what they had without each other */
    double heat;          /* J/kg: what its line has lost, of the fluid's there */
    int root;             /* of its line, in the list */
} wetted_node;

typedef struct mpm_wetted {
    int fluid, solid; /* velocity fields */
    double density;   /* kg/m3: of the lightest solid */
    int nodes[MESH_MAX_DIM];
    int *index;          /* per global node: in the list, -1: in none; owned */
    wetted_node *node;   /* owned */
    int *member, *first; /* nodes in the order of their lines' roots, and by root where its own begin; owned */
    int n, reserved;
} mpm_wetted;

floe_status wetted_create(mpm *s);
/* What lines have lost in the step (J/kg of fluid) into N_LOSS. */
floe_status wetted_add_losses(mpm *s);
void wetted_free(context *ctx, mpm_wetted **w);

#endif
