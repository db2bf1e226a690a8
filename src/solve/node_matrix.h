/* A symmetric matrix that couples unknowns of a solve_grid with all those within `width` of them along each axis: what
 * points and their basis make of a law's tangent; and with `arm` more along each axis alone: what lines make. Every unknown has several components, and each pair of unknowns a
 * block of entries. Rows exist only where points reach. */
#ifndef SOLVE_NODE_MATRIX_H
#define SOLVE_NODE_MATRIX_H

#include "solve/grid.h"

enum { NODE_MATRIX_COMPONENTS = 4 * MESH_MAX_DIM }; /* of a vector for each body that meets others at a node */

typedef struct node_matrix {
    context *ctx; /* not owned */
    solve_grid grid;
    int components, width, arm;
    int side, slots; /* 2 width + 1; unknowns that a row couples with */
    int arms;        /* of the slots on either side of those within the width */
    int rows;
    int *row;      /* of each place of the grid, -1: none; owned */
    int *place;    /* on the grid, of each row; owned */
    int *column;   /* places that a row's slots couple with, its own where there is none; rows x slots, owned */
    double *value; /* rows x components x components x slots; owned */
} node_matrix;

/* A matrix without rows; g is copied. Owner: the caller. Errors: FLOE_NO_MEMORY. */
floe_status node_matrix_create(node_matrix **out, context *ctx, const solve_grid *g, int components, int width,
                               int arm);
void node_matrix_destroy(node_matrix **m);

/* Gives it rows where `takes_part` (one an entry of the grid's arrays) says so, all zero. Errors: FLOE_NO_MEMORY. */
floe_status node_matrix_shape(node_matrix *m, const bool *takes_part);
/* The slot of an unknown that lies this far from the row's, within the width. Far and near, slots k and slots - 1 - k lie opposite. */
static inline int node_matrix_slot(const node_matrix *m, const int offset[MESH_MAX_DIM])
{
    int slot = 0;
    for (int a = m->grid.dim - 1; a >= 0; --a) slot = slot * m->side + offset[a] + m->width;
    return m->arms + slot;
}
/* The same so far along one axis, within the width or the arm beyond. */
static inline int node_matrix_slot_along(const node_matrix *m, int axis, int far)
{
    int offset[MESH_MAX_DIM] = {0, 0, 0};
    const int arm = (far < 0 ? -far : far) - m->width - 1 + axis * m->arm; /* counted from the axis 0, and outwards */
    offset[axis] = far;
    if (far > m->width) return m->slots - m->arms + arm;
    return far < -m->width ? m->arms - 1 - arm : node_matrix_slot(m, offset);
}
/* Entries (c, c') of a row, one a slot. */
static inline double *node_matrix_entries(const node_matrix *m, int row, int c, int c2)
{
    return m->value +
           (((size_t)row * (size_t)m->components + (size_t)c) * (size_t)m->components + (size_t)c2) * (size_t)m->slots;
}
/* Sets the rows and columns of constrained components to zero: `constrained` has one array for each component, in order. */
void node_matrix_constrain(node_matrix *m, const bool *constrained);
/* Takes n directions (orthonormal, of all components each) at a row's unknown out of the matrix, which becomes P A P
 * with P the projection onto the others, and has `stiffness` along them. */
void node_matrix_project(node_matrix *m, int row, int n, const double *direction, double stiffness);
/* y = A x on arrays of all components; y is 0 where there is no row. */
void node_matrix_apply(const node_matrix *m, const double *x, double *y);

#endif
