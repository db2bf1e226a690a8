/* Supports: regions that hold what lies in them, and fixed bodies that hold what sticks to them (theory 4.13). */
#ifndef MPM_SUPPORTS_H
#define MPM_SUPPORTS_H

#include "mpm/mpm.h"

/* How many nodes inside points outside reach. */
enum { SUPPORT_STEPS = 2 };

/* A node, by global index, that a region holds: it has the support's velocity V. (In a group that is not led, that is all.) Where a solid passes the surface of the region close by, it is led instead:
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

/* A region that holds: of a support of the scene, or a fixed body to which others stick from the start. */
typedef struct support_region {
    const shape *region;    /* at the start; not owned */
    const double *velocity; /* m/s; not owned */
    int body;               /* of ours, that is fixed; -1: a support of the scene */
} support_region;

enum { SUPPORT_REGIONS = SCENE_MAX_SUPPORTS + SCENE_MAX_BODIES };

struct mpm_supports {
    support_node *node; /* owned */
    size_t n, reserved;
    support_region region[SUPPORT_REGIONS]; /* those of the scene first */
    int n_regions;
    long long *clear; /* owned: numbers of nodes that are clear of fixed bodies, sorted (support_beyond.h) */
    size_t n_clear;
};

/* Finds the nodes that they hold or lead at the beginning (support_find.c). Errors: FLOE_NO_MEMORY; FLOE_BAD_INPUT where a support holds none. */
floe_status supports_create(mpm *s);
/* Whether others push nodes inside regions: these then need the mass of what the support holds there. Kept, with the momentum, and put back. */
bool supported_nodes_push(const mpm *s, int group);
void keep_whole_masses(mpm *s, int group);
void put_whole_masses(mpm *s, int group);
/* Finds the nodes again in each step, if some support moves. */
floe_status follow_supports(mpm *s);
void supports_free(mpm *s);
/* Velocity (m/s) of a region. */
static inline const double *support_velocity(const mpm *s, int region)
{
    return s->supports->region[region].velocity;
}
/* The entry of a node that some support holds or leads, or NULL. */
const support_node *support_of(const mpm *s, const int node[MESH_MAX_DIM]);
/* Whether supports lead nodes of a group. */
bool supports_lead_group(const mpm *s, int group);
/* Whether an entry holds or leads its node for a group, `leads` as supports_lead_group says of it. What is not led sticks to fixed bodies by their own nodes (motion/). */
static inline bool support_constrains(const mpm *s, bool leads, const support_node *n)
{
    return leads || (n->inside && s->supports->region[n->support].body < 0);
}
/* Whether some of the regions is a fixed body. */
bool supports_lead_by_body(const mpm *s);
/* Whether a support has a velocity. */
bool support_moves(const mpm *s, int support);
/* By how many nodes the solver's matrix couples farther along each axis, because led nodes of a curved or oblique surface have masters in different rows. */
int supports_widen(const mpm *s);
/* The region with which a place on the surface of a group moves, and which bears the loads there; -1: none. */
int support_with_surface(const mpm *s, int group, const double x[MESH_MAX_DIM]);
/* Enters an impulse (N s) that a region gives at x (m); a fixed body takes the opposite one. */
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
