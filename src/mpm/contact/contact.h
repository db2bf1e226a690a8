/* Contact of bodies that have velocity fields of their own (Y97 appendix A.1; Bardenhagen, Brackbill, Sulsky 2000).
 *
 * Each body of the scene's contact is a group of its own at the nodes; all others share one. Where groups meet at a
 * node, the contact corrects their velocities: after forces and walls have acted on v^L, and on the velocities that USF
 * and MUSL take strains from, which obey what v^L decided. Pairs exchange equal and opposite impulses along one normal,
 * so that momentum is kept whatever their number. Bodies outside the contact stick to what they meet, as they do
 * without it; beside cells, each material is a group, and what cells do not hold together moves through each other
 * without a contact. */
#ifndef MPM_CONTACT_H
#define MPM_CONTACT_H

#include "mpm/mpm.h"
#include "mpm/normal/normal.h"

/* Nodes along an axis that a basis may reach: with more, bodies share nodes that neither of them is near, and normals
 * of thin ones are off by up to 90 degrees (measured with the cubic basis). */
enum { CONTACT_SUPPORT = 3 };

struct mpm_contact {
    const normal_model *normal;
    bool named[MPM_MAX_GROUPS]; /* a body of the contact; else the group of all others */
    int rank[MPM_MAX_GROUPS];   /* its place in the deck's list */
    bool fluids;                /* the others are all fluids */
    int window[MESH_MAX_DIM];   /* nodes of a tile's window of the normals */
    int window_nodes;
    double h; /* m: least spacing */
    /* Per global tile: bit of each of its (at most 64) cells from which points reach a node where bodies meet;
     * owned. */
    uint64_t *near;
};

floe_status contact_create(mpm *s);
void contact_destroy(mpm *s);
/* Doubles that the normals take of a tile's partials. */
size_t contact_partials(const mpm *s);
/* What is done at the nodes where groups meet. */
typedef enum contact_act {
    CONTACT_DECIDE,  /* v^L is corrected, and who touches whom is kept in N_TOUCH; work and counts are entered */
    CONTACT_FORESEE, /* USF: the same from v + kick f/m with the forces so far, but only v_i is corrected */
    CONTACT_REPEAT,  /* MUSL: v_i is corrected as v^L was */
    CONTACT_RESTORE  /* the same of what is added to either (restore.c) */
} contact_act;
void contact_velocities(mpm *s, contact_act act);

/* What one group brings to a node. */
typedef struct contact_body {
    double mass;      /* kg */
    double v0[3];     /* m/s: velocity that the step began with */
    double v[3];      /* m/s: in, before contact; out, after it */
    double normal[3]; /* outward, of no unit length */
    double reach;     /* m: of its points from the node along the normal */
    bool named;       /* of the contact; else of all others */
    int rank;         /* place among the named, from 0 */
} contact_body;

typedef enum contact_state { CONTACT_FREE, CONTACT_SLIDES, CONTACT_STICKS } contact_state;

typedef struct contact_node {
    int n; /* bodies, at least two */
    int dim;
    double h;     /* m: least spacing */
    bool held[3]; /* components that a wall holds: normals have none */
    /* The group of all others holds fluids alone: it sticks to the first body of the contact that is here, not to
     * all, so that gas behind a skin does not hold to the skin what lets go of it. */
    bool fluids;
    bool apart; /* bodies outside the contact have nothing to do with others here: the cells do it */
    contact_body body[MPM_MAX_GROUPS];
    contact_state state[MPM_MAX_GROUPS][MPM_MAX_GROUPS]; /* of the pair a, b where a < b */
} contact_node;

/* A pair of bodies at a node that have to do with each other, or will once they have met. */
typedef struct contact_meeting {
    int a, b;
    double n[3]; /* unit normal from a to b, without components that walls hold; zero: there is none */
    double gap;  /* m: between their points along it; negative where they overlap */
    bool named;  /* both are of the contact: its rule is theirs; others stick */
} contact_meeting;
enum { CONTACT_MAX_PAIRS = MPM_MAX_GROUPS * (MPM_MAX_GROUPS - 1) / 2 };
/* All of a node; returns how many. */
int contact_find_meetings(const scene_contact *rule, const contact_node *node, contact_meeting *list);
/* Whether their surfaces have met. */
bool contact_has_met(const contact_node *node, const contact_meeting *m);
/* What groups bring to a node but velocities, from the block that has it; of those with mass there: their numbers in
 * `group`. */
void contact_look(const mpm *s, int blk, const int global[MESH_MAX_DIM], int group[MPM_MAX_GROUPS], contact_node *node);

/* Pairs of bodies that move as one, slide on each other, or are free. */
typedef struct contact_tally {
    int stick, slip, release;
} contact_tally;

/* The velocities that a contact leaves at a node, and the states of its pairs; the sum of mass times velocity stays, to
 * round-off. */
contact_tally contact_resolve(const scene_contact *rule, contact_node *node);
/* The velocities nearest to those given that obey the states: no motion within pairs that stick, none along the normal
 * of those that slide. */
void contact_impose(contact_node *node);

#endif
