/* Normals of bodies on the grid: the gradient of a function that decreases from the inside of a body to its outside, smoothed over the nodes. One file adds
 * one: normal_<name>.c ends in a const descriptor `normal_<name>`, a smoothing kernel along an axis; the kernel of a node is the product over the axes, and
 *     phi_i = sum_p V0_p (kernel of node i at x_p),   n_i = sum_p V0_p grad_p (kernel) / phi_i = -grad phi/phi.
 * A pair of bodies has the normal n_a - n_b, along the gradient of phi_b/(phi_a + phi_b): opposite for b, and dominated by the body near whose edge the node
 * lies. Far inside a body grad phi is noise, and with this quotient a thin body has the same n as a thick one. */
#ifndef MPM_NORMAL_NORMAL_H
#define MPM_NORMAL_NORMAL_H

#include "mpm/basis/basis.h"

enum { NORMAL_MAX_SUPPORT = 4 };

/* Kernel along one axis at the nodes that a point reaches. */
typedef struct normal_weights {
    int first, n; /* offset of the first node from the lower node of the cell, and how many there are */
    double w[NORMAL_MAX_SUPPORT], dw[NORMAL_MAX_SUPPORT]; /* 1, 1/m: derivative with the point's position */
} normal_weights;

typedef struct normal_model {
    const char *name, *doc, *cite;
    int reach; /* nodes beyond its own cell that a point reaches, at most */
    /* xi, half, inv_h: as a basis takes them (basis.h). */
    normal_weights (*weights)(const basis_model *basis, double xi, double half, double inv_h);
} normal_model;

extern const normal_model *const normal_registry[];
extern const size_t normal_registry_size;
/* NULL if there is none of that name. */
const normal_model *normal_find(const char *name);

#endif
