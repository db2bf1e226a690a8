/* Transfers: what becomes of a point's velocity in a step (theory 4.2). One file adds one: transfer_<name>.c ends in
 * a const descriptor `transfer_<name>`; the conformance battery covers it with every basis (momentum, uniform motion,
 * and moment of momentum and rigid motion where it claims them).
 *
 * With S the weights of the points on the nodes and S+ the mass-weighted means of points at the nodes, the nodes get
 *     v_i = sum_p S_ip m_p [v_p + C_p (x_i - x_p)] / m_i,
 * and the points
 *     v_p <- share (v_p + kick S a) + (1 - share) S v^L,   x_p <- x_p + dt S v^L. */
#ifndef MPM_TRANSFER_TRANSFER_H
#define MPM_TRANSFER_TRANSFER_H

#include <stdbool.h>
#include <stddef.h>

/* What a point keeps of the motion about it, C_p (1/s). */
typedef enum transfer_carry {
    CARRY_NOTHING,
    CARRY_MOMENTS, /* C = B/D, B = sum_i S_ip v_i (x_i - x_p)^T, D = sum_i S_ip (x_i - x_p)^2 along each axis */
    CARRY_GRADIENT /* C = sum_i v_i grad S_ip */
} transfer_carry;

typedef struct transfer_model {
    const char *name, *doc, *cite;
    double share; /* of FLIP, 0 to 1; NAN: what the deck's method.flip says */
    transfer_carry carry;
    bool filter; /* v_p above is what [I - (I - S S+)^m] leaves of it */
    bool
        restore; /* v^L above is replaced by the sum of k terms, each the part of the former that points would not return (restore.c) */
    int order;               /* m or k where the deck's method.filter_order says nothing */
    bool keeps_spin;         /* the moment of momentum is kept to round-off, C_p's share included */
    bool keeps_rigid_motion; /* one step leaves the velocities of a turning body as they are */
} transfer_model;

extern const transfer_model *const transfer_registry[];
extern const size_t transfer_registry_size;
/* NULL if there is none of that name. */
const transfer_model *transfer_find(const char *name);

#endif
