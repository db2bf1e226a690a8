/* Bodies that are all but incompressible, in steps that are solved for (theory 9.8). Their points have the change of volume 1 + e that is linear
 * over patches of cells (state/volume_patch.h), e = P (det f - 1) with f = I + grad u of the increment, and
 *
 *     f_bar = ((1 + e)/det f)^(1/m) f,    T = V (1 + e) (sigma - s I) f^-T + V (det f) P s f^-T,    s = tr sigma/m,
 *
 * over the m axes that strain: the derivative of what they store, V the volumes at the start of the increment. The tangent is that of points
 * whose e and P s stay as they are, and for each mode of a patch kappa c c^T, c the change of its volume with the displacements of the nodes and kappa its
 * bulk modulus. As kappa grows the pressures p = kappa c.u become unknowns of their own,
 *
 *     A u + sum c p = r,    c.u - p/kappa = 0,
 *
 * which minimal residuals solve for in as many iterations whatever kappa is. Private to implicit*.c. */
#ifndef MPM_IMPLICIT_VOLUME_H
#define MPM_IMPLICIT_VOLUME_H

#include "mpm/implicit/implicit.h"
#include "mpm/state/volume_patch.h"
#include "solve/minres.h"

/* A patch of cells of a body. */
typedef struct body_patch {
    int body, modes;
    size_t first, n;    /* its points, in the list of points */
    size_t unknown;     /* of its first mode, among the pressures */
    size_t node, nodes; /* in the list of nodes: those that its points reach */
    size_t change;      /* where its c begins */
    double bulk;        /* Pa: kappa */
} body_patch;

struct implicit_volume {
    body_patch *patch; /* owned */
    size_t patches, patches_reserved;
    size_t modes;               /* of all patches */
    size_t listed;              /* points of all patches */
    size_t *point;              /* their numbers; owned */
    double (*phi)[PATCH_MODES]; /* of each listed point; owned */
    size_t points_reserved;
    /* Of each point, by its number; owned. m3 at the start; det f - 1, and e; s and P s (Pa); V (det f) f^-T at the components of grad u (m3). */
    double *volume, *own, *shared, *own_stress, *shared_stress, *cofactor;
    double *
        tangent; /* of forces without P s, with a bulk modulus for each point: what the preconditioner is made of; owned */
    double *bulk; /* J: volume times d s/d e; owned */
    int *node;    /* on the solver's grid; owned */
    size_t nodes_reserved, change_reserved;
    double *change;     /* c: for each mode and component one a node of the patch (m2 and less); owned */
    node_matrix *exact; /* A; owned */
    minres *solver;     /* owned */
    double margin;      /* of the multigrid (multigrid_widen) */
    double *rhs, *x;    /* displacements, then pressures; owned */
    size_t unknowns_reserved;
};

/* Allocates what bodies of the scene need. Errors: FLOE_NO_MEMORY. */
floe_status implicit_volume_create(mpm *s);
void implicit_volume_free(mpm *s);
/* Whether a body shares its changes of volume. */
bool implicit_shares_volume(const mpm *s, int body);
/* Patches of the points where they stand; after implicit_locate. Errors: FLOE_NO_MEMORY. */
floe_status implicit_find_patches(mpm *s);
/* The values of points, by their numbers, become P f. */
void implicit_project_volumes(mpm *s, double *value);
/* c of every mode, and kappa, with the tangents; where bodies share changes of volume. */
void implicit_couple_patches(mpm *s);
/* Solves for the change of the displacement that removes the residual, to the share `share` of it. */
floe_status implicit_solve_volume(mpm *s, double share);

#endif
