/* Contact conditions (contact.h) of the implicit solver. At a node where bodies a and b meet with normal n and gap g
 * between their surfaces,
 *
 *     r = n . (u_a - u_b) - g <= 0,     lambda >= 0,     lambda r = 0,
 *
 * with lambda the contact force. Normals and gaps are those of the surfaces that face each other (implicit_gap.c), or,
 * with `touch: nodes`, normals are those of a step and gaps are zero. A primal-dual active set (Hueeber, Wohlmuth 2005,
 * Comput. Methods Appl. Mech. Engrg. 194, 3147) finds the active conditions together with the displacement: a condition
 * in tension is released, a violated one becomes active. Active conditions are satisfied exactly: the constrained
 * motions are projected out of the matrix, the residual and the preconditioner, and the force that the projection
 * removes is the contact force. `stick` makes all components of relative motion constrained for good; `release` those
 * along n while they are in compression. Private to implicit*.c. */
#ifndef MPM_IMPLICIT_CONTACT_H
#define MPM_IMPLICIT_CONTACT_H

#include "mpm/contact/contact.h"
#include "mpm/implicit/implicit.h"

enum {
    SPOT_ROWS = 36
}; /* most conditions at a node: of all pairs of four bodies in three dimensions, or six in two, with their tangential ones */

/* A condition: along . (u_a - u_b) <= gap. */
typedef struct contact_row {
    int layer[2];    /* of a and b */
    double along[3]; /* unit */
    double gap;      /* m */
    /* Of the surfaces of a and b that face each other, weighted with the node's shape function: area vectors (m2), sums
     * of position along the normal times area (m3), and of area (m2) (implicit_gap.c). */
    double area[2][3], sum[2], weight[2];
    bool bound;          /* an equality, active for good */
    int lead;            /* index among those of the node of the condition whose state it shares; -1: none */
    bool active;         /* it is an equality in this iteration */
    double normal_force; /* N: contact force of a on b */
} contact_row;

/* A node with contact conditions. */
typedef struct contact_spot {
    int node; /* on the solver's grid */
    size_t first;
    int rows;
} contact_spot;

struct implicit_contact {
    contact_spot *spot; /* owned */
    size_t spots, spots_reserved;
    contact_row *row; /* owned */
    size_t rows, rows_reserved;
    /* LQ factors of the active conditions of each node, C = L Q: rows of C are the conditions, rows of Q are
     * orthonormal. A condition that depends linearly on others has a zero row of Q. Owned. */
    double *Q;    /* all components of the node */
    double *L;    /* SPOT_ROWS */
    int *spot_of; /* of each node: its index among the spots, -1: none; owned. NULL where gaps are those of points */
    double *raw;  /* N, on the grid: the residual before the projection; owned */
};

/* Why bodies in contact cannot be solved for, or NULL. */
const char *implicit_contact_obstacle(const mpm *s);
/* Allocates its storage. */
floe_status implicit_contact_create(mpm *s);
void implicit_contact_free(mpm *s);
/* Finds the conditions of the increment; bodies that touch start with active ones. */
floe_status implicit_contact_find(mpm *s);
/* Contact forces from the residual, which is then projected. */
void implicit_contact_forces(mpm *s);
/* Releases conditions in tension and activates those that u violates. True: some have changed. */
bool implicit_contact_update(mpm *s, const double *u);
/* Activates all conditions, whatever their gap, so that a free body comes to rest on what it meets. False: all were
 * active. */
bool implicit_contact_bind_all(mpm *s);
/* Adds the increment that closes the gaps of active conditions at u. True: it is not zero. */
bool implicit_contact_closing_step(const mpm *s, const double *u, double *step);
/* The projection of an array, and of the matrix. */
void implicit_contact_project(const mpm *s, double *x);
void implicit_contact_project_matrix(const mpm *s, node_matrix *m);
/* Normals and gaps of all conditions from the surfaces of the bodies (implicit_gap.c). */
void implicit_contact_measure_gaps(mpm *s);
/* Enters the counts of contacts into the ledger. */
void implicit_contact_enter(mpm *s);

#endif
