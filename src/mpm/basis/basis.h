/* Bases: the shape functions that carry data between points and nodes (numerics 4.3). One file adds one:
 * basis_<name>.c ends in a const descriptor `basis_<name>`; the conformance battery covers it (partition of unity, linear
 * reproduction, gradients against differences, positivity, walls). The 1-D weights live in an always-inline body in
 * basis_1d.h, which the point kernels take as a literal argument. */
#ifndef MPM_BASIS_BASIS_H
#define MPM_BASIS_BASIS_H

#include <stdbool.h>
#include <stddef.h>

typedef enum basis_kind { BASIS_LINEAR, BASIS_GIMP, BASIS_QUADRATIC, BASIS_KINDS } basis_kind;

enum { BASIS_MAX_SUPPORT = 4 };

typedef struct basis_model {
    const char *name, *doc, *cite;
    basis_kind kind;
    int support;        /* nodes along an axis that a point may reach */
    int reach_lower;    /* nodes below the lower node of the point's cell */
    int smoothness;     /* continuous derivatives */
    /* Weights and derivatives (1/m) along one axis. xi: position in the cell in units of h, 0 <= xi < 1 (1 on the upper wall);
     * half: half width in units of h (GIMP); wall_lower: cells between the point's cell and the lower wall (0: first cell), or a
     * large number; wall_upper likewise; inv_h = 1/h. Entry k belongs to node cell - reach_lower + k. */
    void (*weights)(double xi, double half, int wall_lower, int wall_upper, double inv_h, double *w, double *dw);
} basis_model;

extern const basis_model *const basis_registry[];
extern const size_t basis_registry_size;
const basis_model *basis_find(const char *name);

#endif
