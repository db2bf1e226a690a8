/* Supports: nodes inside a region whose velocity is prescribed (support.c). */
#ifndef MPM_SUPPORTS_H
#define MPM_SUPPORTS_H

#include "mpm/mpm.h"

/* A node, by global index, that a support constrains. */
typedef struct support_node {
    int node[MESH_MAX_DIM], support;
} support_node;

struct mpm_supports {
    support_node *node; /* owned */
    size_t n;
};

/* Finds the nodes that they constrain. */
floe_status start_supports(mpm *s);
void supports_free(mpm *s);
/* Sets their prescribed velocities; `entered` as impose_walls. */
void impose_supports(mpm *s, int group, field_id velocity, double entered);
/* Removes a change of velocity from their nodes; `share` of that impulse is entered into the ledger. */
void constrain_supports(mpm *s, int group, field_id change, double share);

#endif
