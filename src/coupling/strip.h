/* Rows of cells and the rows of nodes about them (theory 5.1): a value of one centring is a weighted sum over its two
 * neighbours of the other along each axis, with weights of 1/2, doubled at nodes on a non-periodic side of the domain,
 * where half the cells are missing. */
#ifndef COUPLING_STRIP_H
#define COUPLING_STRIP_H

#include "grid/mesh.h"

/* A row of values along axis 0, and the rows that they are sums of. */
typedef struct strip {
    int n;             /* values */
    ptrdiff_t at;      /* linear index of the first */
    int rows;          /* 1, 2 or 4: two along each further axis, less what lies outside */
    ptrdiff_t from[4]; /* index of the lower of the first value's two neighbours along axis 0, in each row */
    double weight[4];  /* of each row, times the 1/2 of axis 0 */
    /* Weights of the two neighbours of the first and last value; 1 between: 0 outside, 2 doubled. */
    double first[2], last[2];
} strip;

/* What becomes of the sums: they are stored; those of x y are; they are added where y > 0. */
typedef enum strip_use { STRIP_SUM, STRIP_SUM_PRODUCT, STRIP_ADD_WHERE } strip_use;

/* The owned cells of row (j, k), sums over nodes. */
strip strip_of_cells(const mesh *m, const block *b, int j, int k);
/* The nodes of row (j, k), sums over the cells inside the domain; one ghost node at each end where a neighbour's cells
 * are at hand. */
strip strip_of_nodes(const mesh *m, const block *b, int j, int k);
/* Nodes along an axis for which sums can be taken: [first, end). */
int strip_first_node(const mesh *m, const block *b, int axis);
int strip_end_node(const mesh *m, const block *b, int axis);

/* Sums of x (of x y) over a strip into out, all of them arrays of the block. y is of the neighbours' centring in
 * products, of the values' in STRIP_ADD_WHERE, NULL otherwise. Entries without weight are not looked at. */
void strip_sum(const strip *s, const double *x, const double *y, double *out, strip_use use);

#endif
