/* Contact (contact.h) in the balance of forces. At a node where bodies a and b meet along n, with a gap g left between
 * their surfaces,
 *
 *     r = n . (u_a - u_b) - g <= 0,     push >= 0,     push r = 0,
 *
 * by normals and gaps of the surfaces that face each other (balance_gap.c), or, where the deck has touch: nodes, by the
 * normals of a step and without gaps. Which of the conditions bind is found along with the displacement (primal-dual
 * active sets; Hueeber, Wohlmuth 2005, Comput. Methods Appl. Mech. Engrg. 194, 3147): one that pulls is let go, one
 * that is broken binds. Those that bind are kept exactly, by projecting what the nodes cannot do out of the matrix, the
 * forces and the preconditioner; what the projection takes of the forces is the push. `stick` binds all components of
 * what has met, both ways; `release` those across n while it is pressed. Private to balance*.c. */
#ifndef MPM_BALANCE_CONTACT_H
#define MPM_BALANCE_CONTACT_H

#include "mpm/balance/balance.h"

enum {
    SPOT_ROWS = 36
}; /* conditions at a node, at most: of all pairs of four bodies in space, or six in the plane, and what goes with them */

/* A condition: along . (u_a - u_b) <= gap. */
typedef struct contact_row {
    int layer[2];    /* of a and b */
    double along[3]; /* unit */
    double gap;      /* m */
    /* m2; m3, m2: of the surfaces of a and b that face each other, as the node sees them: areas, and places along the
     * normal times areas, and those (balance_gap.c). */
    double area[2][3], sum[2], weight[2];
    bool bound;  /* equal, and for good */
    int lead;    /* place among those of the node of the one that it comes and goes with; -1: none */
    bool active; /* it binds */
    double push; /* N: of a on b */
} contact_row;

/* A node where bodies meet. */
typedef struct contact_spot {
    int node; /* on the solver's grid */
    size_t first;
    int rows;
} contact_spot;

struct balance_contact {
    contact_spot *spot; /* owned */
    size_t spots, spot_room;
    contact_row *row; /* owned */
    size_t rows, row_room;
    /* Of each condition that binds: with those before it at its node C = L Q, rows of C the conditions, of Q
     * orthonormal. A condition that follows from others has an empty row of Q. Owned. */
    double *Q;    /* all components of the node */
    double *L;    /* SPOT_ROWS */
    int *spot_of; /* of each node: its place among the spots, -1: none; owned. NULL where gaps are those of points */
    double *raw;  /* N, on the grid: what is left of the forces before the projection; owned */
};

/* Why bodies in contact cannot be solved for, or NULL. */
const char *contact_rest_obstacle(const mpm *s);
/* Room for it. */
floe_status contact_rest_create(mpm *s);
void contact_rest_free(mpm *s);
/* What can meet in the increment; what touches binds at first. */
floe_status contact_rest_find(mpm *s);
/* Pushes from what is left of the forces, which is then projected. */
void contact_rest_take(mpm *s);
/* Lets go what pulls, and binds what is broken at u. True: something has changed. */
bool contact_rest_decide(mpm *s, const double *u);
/* Binds all there is, whatever its gap, so that what moves freely comes to rest on what it meets. False: all did. */
bool contact_rest_close(mpm *s);
/* Adds the displacement that brings what binds, and is not there at u, to where it must be. True: there is some. */
bool contact_rest_way(const mpm *s, const double *u, double *way);
/* The projection of an array, and of the matrix. */
void contact_rest_project(const mpm *s, double *x);
void contact_rest_stiffen(const mpm *s, node_matrix *m);
/* From surfaces where there are some: normals and gaps of all conditions (balance_gap.c). */
void contact_gap_measure(mpm *s);
/* Counts for the ledger. */
void contact_rest_enter(mpm *s);

#endif
