/* Bases: the shape functions that carry data between points and nodes (theory 4.3). One file adds one: basis_<name>.h
 * has the weights along an axis, `basis_<name>_weights`, always inlined, and ends in a const descriptor `basis_<name>`.
 * The build lists the files; the point kernels are instantiated for each (basis_inline.h), and the conformance battery
 * covers it (partition of unity, linear reproduction, gradients against differences, positivity).
 *
 * A basis knows nothing of walls: points near one reach the ghost nodes beyond it, and the nodes are folded back
 * (mpm/nodes/wall.c), which is the same as folding the shape functions (theory 4.3) and leaves the kernels without
 * branches.
 *
 * CPDI is the one whose domains have a shape: parallelograms whose sides F turns and stretches (mpm/transfer/locate.h). Its
 * weights along an axis, below, are those of a box along the axes; that is what acts at places takes, and what the
 * battery asks. */
#ifndef MPM_BASIS_BASIS_H
#define MPM_BASIS_BASIS_H

#include <stdbool.h>
#include <stddef.h>

enum { BASIS_MAX_SUPPORT = 4 };

/* What methods about the weights ask of a basis. It is written in this order, whole: one that is left out does not
 * compile. */
typedef struct basis_facts {
    int edge_taps;      /* nodes of a line of edges (mpm/edge/edge.h): the degree of the splines plus two */
    double ghost_share; /* cells: integral over the mesh of the first ghost's shape function beyond a side */
    double axis_moment; /* cells^2: integral over r > 0 of r times the shape function of a node on the axis */
    double least_mass;  /* of the heaviest point's: lighter nodes take no force (node.c) */
    double load_mass;   /* of the heaviest node's about: lighter nodes take less of a load on a surface (traction.c) */
    double usl_share;   /* most of h/c that a step takes with USL (totals.c, theory 4.6) */
    double carried_share;     /* of points that carry the motion about them */
    double restored_share[4]; /* of affine FMPM of orders 2, 4, 6 and more */
    bool hats; /* light nodes are spared (light_nodes.c), and affine FMPM adds all its terms whole (restore.c) */
    bool light_losses; /* light nodes would make losses of nothing: their accelerations are in no gradient (heat.c) */
    bool sized;        /* points have boxes */
    bool shaped;       /* which F turns and stretches */
} basis_facts;

typedef struct basis_model {
    const char *name, *doc, *cite;
    int support;    /* nodes along an axis that a point reaches */
    int reach;      /* nodes that it may reach beyond its own cell on either side: 0 or 1 */
    int smoothness; /* continuous derivatives */
    /* default gamma of the ghost penalty at edges of solids (mpm/edge/edge.h): the largest with which holes of two
     * cells in radius and walls of two cells are as accurate as without; 0: none. */
    double edge_penalty;
    basis_facts fact;
    bool averaged; /* the slopes are means over the point's domain, of a finer function than the weights */
    /* Weights and derivatives (1/m) along one axis; returns the first node's offset from the lower node of the cell.
     * xi: position in the cell in units of h, 0 <= xi <= 1; half: half width of the point's domain in units of h, 0 <
     * half <= 1/2 (read by GIMP, and CPDI, which takes up to 1); inv_h = 1/h (1/m). */
    int (*weights)(double xi, double half, double inv_h, double *w, double *dw);
} basis_model;

extern const basis_model *const basis_registry[];
extern const size_t basis_registry_size;
/* NULL if there is none of that name. */
const basis_model *basis_find(const char *name);
bool basis_is(const basis_model *b, const char *name);
/* Its index in the registry. */
int basis_number(const basis_model *b);

#endif
