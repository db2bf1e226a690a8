/* Contact of bodies with separate velocity fields (Y97 appendix A.1; Bardenhagen, Brackbill, Sulsky 2000).
 *
 * Each body of the scene's contact is a velocity group of its own at the nodes; all other bodies share one. Where
 * groups meet at a node, contact corrects their velocities: v^L after forces and walls, and the velocities of which USF
 * and MUSL take strains, with the contact states of v^L. Pairs exchange equal and opposite impulses along one normal,
 * which conserves momentum for any number of bodies. Bodies outside the contact stick to what they meet. Beside cells
 * each material is a group; materials that the exchange on cells does not couple interpenetrate without a contact. */
#ifndef MPM_CONTACT_H
#define MPM_CONTACT_H

#include "grid/tile_box.h"
#include "mpm/mpm.h"
#include "mpm/normal/normal.h"

/* Largest support of a basis along an axis, in nodes. With a larger one, bodies share nodes that neither is near, and
 * normals of thin bodies are off by up to 90 degrees (measured with the cubic basis). */
enum { CONTACT_SUPPORT = 3 };

struct mpm_contact {
    const normal_model *normal;
    bool named[MPM_MAX_GROUPS]; /* a body of the contact; else the group of all others */
    int rank[MPM_MAX_GROUPS];   /* its index in the deck's list */
    bool fluids;                /* all other bodies are fluids */
    int window[MESH_MAX_DIM];   /* nodes of a tile's window of the normals */
    int window_nodes;
    double h; /* m: least spacing */
    /* Per global tile: bit of each of its (at most 64) cells whose points reach a node where bodies meet; owned. */
    uint64_t *near;
};

floe_status contact_create(mpm *s);
void contact_destroy(mpm *s);
/* Doubles that the normals take of a tile's partials. */
size_t contact_partials(const mpm *s);
/* What is done at the nodes where groups meet. */
typedef enum contact_act {
    CONTACT_DECIDE,  /* v^L is corrected and the contact states are stored in N_TOUCH; work and counts are entered */
    CONTACT_FORESEE, /* USF: the same from v + dt f/m with the forces so far, but only v_i is corrected */
    CONTACT_REPEAT,  /* MUSL: v_i is corrected as v^L was */
    CONTACT_RESTORE  /* the same of what is added to either (restore.c) */
} contact_act;
void contact_velocities(mpm *s, contact_act act);

/* What one group brings to a node. */
typedef struct contact_body {
    double mass;      /* kg */
    double v0[3];     /* m/s: velocity at the start of the step */
    double v[3];      /* m/s: in, before contact; out, after it */
    double normal[3]; /* outward, not normalised */
    double reach;     /* m: of its points from the node along the normal */
    bool named;       /* a body of the contact; else all others */
    int rank;         /* index among the named, from 0 */
    bool given;       /* it has a motion of its own, which contact does not change (motion/motion.h) */
    double taken[3];  /* N s: impulses on such a body */
} contact_body;

typedef enum contact_state { CONTACT_FREE, CONTACT_SLIDES, CONTACT_STICKS } contact_state;

typedef struct contact_node {
    int n; /* bodies, at least two */
    int dim;
    double h;            /* m: least spacing */
    bool constrained[3]; /* components that a wall constrains: normals have none */
    /* The group of all other bodies has fluids alone. It sticks to the first contact body at the node, not to all, so
     * that gas behind a thin body does not tie to it another body that separates. */
    bool fluids;
    bool apart; /* bodies outside the contact do not interact here: the exchange on cells couples them */
    contact_body body[MPM_MAX_GROUPS];
    contact_state state[MPM_MAX_GROUPS][MPM_MAX_GROUPS]; /* of the pair a, b where a < b */
} contact_node;

/* A pair of bodies at a node that may come into contact. */
typedef struct contact_meeting {
    int a, b;
    double n[3]; /* unit normal from a to b, without components that walls constrain; zero: there is none */
    double gap;  /* m: gap between their points along the normal; negative where they overlap */
    bool named;  /* both are bodies of the contact, whose rule applies; others stick */
} contact_meeting;
enum { CONTACT_MAX_PAIRS = MPM_MAX_GROUPS * (MPM_MAX_GROUPS - 1) / 2 };
/* All of a node; returns how many. */
int contact_find_meetings(const scene_contact *rule, const contact_node *node, contact_meeting *list);
/* Whether their surfaces have met. */
bool contact_has_met(const contact_node *node, const contact_meeting *m);
/* Everything but velocities of the groups with mass at a node, from the block that owns it; their numbers in
 * `group`. */
void contact_look(const mpm *s, int blk, const int global[MESH_MAX_DIM], int group[MPM_MAX_GROUPS], contact_node *node);

/* Numbers of pairs that stick, slide, or are free. */
typedef struct contact_tally {
    int stick, slip, release;
} contact_tally;

/* Velocities after contact at a node, and the states of its pairs; momentum is conserved to round-off. */
contact_tally contact_resolve(const scene_contact *rule, contact_node *node);
/* The nearest velocities that obey the contact states: no relative motion of pairs that stick, none along the normal of
 * those that slide. */
void contact_impose(contact_node *node);

struct point_arrays;
/* Whether a point may reach a node where bodies in contact meet. */
bool contact_is_near(const mpm *s, const tile_box *t, const struct point_arrays *p, size_t k);

#endif
