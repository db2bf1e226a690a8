/* Transfer between nodes and cells (theory 5.1, 5.2): the only file with both centrings. It uses fields, and neither
 * solver.
 *
 * The weight of node i in cell c is w_ci = 2^-d, doubled for each non-periodic side of the domain that the node lies
 * on, since half of its cells are missing there: then the weights of every node sum to one over the cells of the
 * domain, and both directions of the transfer have the same weights, so that mass and momentum are conserved to
 * round-off at every boundary. */
#ifndef COUPLING_TRANSFER_H
#define COUPLING_TRANSFER_H

#include "grid/stage.h"

enum { TRANSFER_MAX_PAIRS = 8 };

/* A solid: its velocity group at the nodes and its material in the cells. */
typedef struct transfer_pair {
    int group, material;
    double temperature;   /* K, in the cells, of points that carry none */
    double specific_heat; /* J/kg/K */
    bool warms;           /* its points carry a temperature */
    bool exchanges;       /* and fluids in the cells change it */
    int reaction;         /* that uses it up: instance of C_REACTED; -1: none */
} transfer_pair;

typedef struct transfer {
    context *ctx;       /* not owned */
    const mesh *mesh;   /* not owned */
    domain *domain;     /* not owned; set before the first stage runs */
    stage_list *stages; /* not owned */
    transfer_pair pair[TRANSFER_MAX_PAIRS];
    int n_pairs;
    double reference_pressure; /* Pa */
    double dt, gravity[3];     /* s, of the step in progress; m/s2 */
} transfer;

/* m_c = sum w m_i, u_c = sum w m_i v_i / m_c: C_RHO, C_VEL and C_TEMP of the solids, in owned cells. */
floe_status transfer_nodes_to_cells(transfer *t);
/* N_PRESSURE: P - p_ref averaged over the cells about each node (inside the domain). */
floe_status transfer_pressure_to_nodes(transfer *t);
/* C_MOMENTUM_L of the solids: sum w m_i v_i^L. */
floe_status transfer_momentum_to_cells(transfer *t);
/* v_i^L += sum w dv_c, from C_VELOCITY_CHANGE. */
floe_status transfer_change_to_nodes(transfer *t);
/* dT_i += sum w dT_c, from C_TEMP_CHANGE, of the solids that exchange heat: sum C_i dT_i = sum m_c c dT_c to round-off. */
floe_status transfer_temperature_to_nodes(transfer *t);
/* C_STRESS_ACCEL of the solids: what the nodes got from stress, loads, supports and contact in the step, and not from the
 * cells or from gravity. The first has the momentum of v_i^L with what the cells gave and before supports and contact act
 * again, the second that after them. */
floe_status transfer_momentum_before(transfer *t);
floe_status transfer_stress_to_cells(transfer *t);
/* N_BURNT_SHARE: the share of the mass about a node that burns, averaged over the cells with the weights of the mass,
 * from C_REACTED, in which cells then have their own shares. A cell loses at most half of its solid in a step. */
floe_status transfer_share_to_nodes(transfer *t);
/* What the points have lost, by the weights of their mass: C_REACTED, C_BURNT_MOMENTUM, C_BURNT_ENERGY per cell
 * volume. */
floe_status transfer_burnt_to_cells(transfer *t);

#endif
