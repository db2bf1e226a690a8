/* Supports: regions that hold what lies in them (theory 4.13). */
#ifndef MPM_SUPPORTS_H
#define MPM_SUPPORTS_H

#include "mpm/mpm.h"

/* How many nodes inside points outside reach. */
enum { SUPPORT_STEPS = 2 };

/* A node, by global index, that a support holds: it has the support's velocity V. (In a group that is not led, that is all.) Where a solid passes the surface of the region close by, it is led instead:
 * its velocity is linear between the surface and a free node beyond, V + share (v_master - V), so that the solid is constrained at the surface itself. */
typedef struct support_node {
    int node[MESH_MAX_DIM], support;
    bool inside, led;                            /* the region has it; and it is led */
    int master[MESH_MAX_DIM], way[MESH_MAX_DIM]; /* of a led one: and how many nodes on, across periodic ends too */
    int anchor[MESH_MAX_DIM];                    /* the node before the master */
    double whole[1 + MESH_MAX_DIM];              /* scratch: mass and momentum with those of points that it holds */
    double share,
        per_step; /* its distance from the surface over that of the master, negative in the region; and the same of one step */
} support_node;

struct mpm_supports {
    support_node *node; /* owned */
    size_t n, reserved;
};

/* Finds the nodes that they hold or lead at the beginning (support_find.c). Errors: FLOE_NO_MEMORY; FLOE_BAD_INPUT where a support holds none. */
floe_status supports_create(mpm *s);
/* Whether others push nodes inside regions: these then need the mass of what the support holds there. Kept, with the momentum, and put back. */
bool supported_nodes_push(const mpm *s, int group);
void keep_whole_masses(mpm *s, int group);
void put_whole_masses(mpm *s, int group);
/* Takes the initial stress from the points that belong to supports. */
void relieve_supported_points(mpm *s);
/* Finds the nodes again in each step, if some support moves. */
floe_status follow_supports(mpm *s);
void supports_free(mpm *s);
/* Whether supports lead nodes, and a body may be what passes their surfaces. */
bool supports_lead(const mpm *s, int body);
/* The entry of a node that some support holds or leads, or NULL. */
const support_node *support_of(const mpm *s, const int node[MESH_MAX_DIM]);
/* Whether the surface of a support passes a cell at the start. */
bool supports_cut(const mpm *s, const int cell[MESH_MAX_DIM]);
/* Whether supports lead nodes of a group. */
bool supports_lead_group(const mpm *s, int group);
/* Whether an entry holds or leads its node for a group. */
static inline bool support_constrains(const mpm *s, int group, const support_node *n)
{
    return n->inside || supports_lead_group(s, group);
}
/* Whether a support has a velocity. */
bool support_moves(const mpm *s, int support);
/* By how many nodes the solver's matrix couples farther along each axis, because led nodes of a curved or oblique surface have masters in different rows. */
int supports_widen(const mpm *s);
/* Whether points of a body may belong to supports: those in the regions move along and have no stress. */
bool supports_take_points(const mpm *s, int body);
/* The first support whose region has the place x (m); -1: none. */
int support_with(const mpm *s, const double x[MESH_MAX_DIM]);
/* The support with which a place on the surface of a group moves, and which bears the loads there; -1: none. */
int support_with_surface(const mpm *s, int group, const double x[MESH_MAX_DIM]);
/* Enters an impulse (N s) that a support gives at x (m). */
void push_support(const mpm *s, int support, const double x[MESH_MAX_DIM], int c, double impulse);

/* Gives the masters what points gave led nodes: masses and momenta, forces (support.c). */
void fold_supports(mpm *s, int group, bool momentum, bool force);
/* The same of the momenta of residuals (transfer/restore.c), which the velocities themselves or changes of them have. */
void fold_supported_residuals(mpm *s, int group, bool velocities);
/* Sets the velocities of constrained and led nodes; `entered` as impose_walls. */
void impose_supports(mpm *s, int group, field_id velocity, double entered);
/* The same of a change of velocity, which constrained nodes do not have; `share` of that impulse is entered into the ledger. */
void constrain_supports(mpm *s, int group, field_id change, double share);
/* Enters what damping has taken of momenta that masters were given. */
void enter_support_damping(mpm *s, int group);
/* Gives led nodes the acceleration of their masters: that their points had another velocity changes no velocity of a point, but PIC's share. */
void still_supports(mpm *s, int group);
/* Lets led nodes follow what has changed the velocities N_VEL_L and accelerations N_ACCEL of their masters. */
void follow_masters(mpm *s, int group);

#endif
