/* Shared by the files of wetted walls (wetted.h): the list of nodes at which fluid and solid have mass, and lines of them across a wall. */
#ifndef MPM_WETTED_PARTS_H
#define MPM_WETTED_PARTS_H

#include "mpm/fluid/wetted.h"
#include "mpm/mpm.h"

typedef struct wetted_node {
    int at[MESH_MAX_DIM]; /* global */
    size_t number;        /* of the node */
    double mass[2];       /* kg: of the fluid, of the solid */
    double inertia[2];    /* the same, but that of a body with a motion has no end: its nodes move with all of it */
    double taken[3];      /* N s: impulses on such a solid */
    int solid;            /* velocity field of the solid */
    double area[3];       /* m2: N */
    double force[3];      /* N: on the fluid */
    double v[2][3];       /* m/s: v^L */
    double before[2][3];  /* m/s: at the start of the step */
    double gained[2][3];  /* m/s: change in the step without each other */
    double heat;          /* J/kg: loss of its line, of the fluid there */
    int root;             /* of its line, in the list */
} wetted_node;

typedef struct mpm_wetted {
    int fluid;      /* velocity field */
    double density; /* kg/m3: of the lightest solid */
    bool viscous;   /* some fluid is, and sticks to walls */
    int nodes[MESH_MAX_DIM];
    int *index;          /* per global node: in the list, -1: in none; owned */
    wetted_node *node;   /* owned */
    int *member, *first; /* nodes in the order of their lines' roots, and by root where its own begin; owned */
    int n, reserved;
    wetted_node *kept; /* the nodes before a trial of free bodies; owned */
    int kept_reserved;
} mpm_wetted;

enum { FLUID, SOLID }; /* indices of wetted_node.mass, v, before, gained */

static inline double wetted_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Number of a global node. */
static inline size_t wetted_number(const mpm_wetted *w, const int at[MESH_MAX_DIM])
{
    return (size_t)at[0] + (size_t)w->nodes[0] * ((size_t)at[1] + (size_t)w->nodes[1] * (size_t)at[2]);
}

/* The velocity field of solids with the largest mass at a node of a block; -1: none has any. */
int wetted_solid(const mpm *s, int blk, ptrdiff_t local);
/* Visits nodes of a block from `lo` to `end`, counted in it, at which both have mass. */
typedef floe_status shared_visitor(mpm *s, int blk, const int at[MESH_MAX_DIM], ptrdiff_t local);
floe_status wetted_visit(mpm *s, int blk, const int lo[MESH_MAX_DIM], const int end[MESH_MAX_DIM],
                         shared_visitor *visit);

/* wetted_list.c: lists the nodes, in global order, each with the root of its line; members and first of all lines. */
floe_status wetted_list(mpm *s);
/* In the list, of a node that may lie beyond the mesh; -1: it is not there. */
int wetted_find(const mpm *s, const int at[MESH_MAX_DIM]);

/* wetted_free.c: the velocities that free bodies get together with the fluid at their walls. */
floe_status wetted_move_free(mpm *s);

/* wetted_line.c: one velocity of the wall for the line of a root, or for all; its loss is heat of its fluid. */
void wetted_constrain_line(const mpm *s, int root);
void wetted_constrain_lines(const mpm *s);

#endif
