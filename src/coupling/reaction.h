/* Reactions: mass of one material of a cell becomes mass of another (step 4 of Guilkey et al. 2003). One file adds a law of the rate: reaction_<name>.c ends
 * in a const descriptor `reaction_<name>`. In each cell the rate is integrated over the step: by one explicit step if that is accurate enough, else by
 * CVODE's backward differentiation formulas, which take any stiffness. The temperature follows from the heat released so far; the pressure is that of the
 * start of the step. */
#ifndef COUPLING_REACTION_H
#define COUPLING_REACTION_H

#include "base/context.h"
#include "base/param.h"

enum { REACTION_MAX = 8, REACTION_MAX_MATERIALS = 16 };

/* A cell as a law sees it. */
typedef struct reaction_state {
    double reactant; /* kg per m3 of the cell */
    double product;  /* kg per m3 of the cell */
    double density;  /* of the pure reactant, kg/m3 */
    double T;        /* K: of the mixture of the cell's fluids; of the solid where there are none */
    double p;        /* Pa */
    double surface;  /* m2 of the reactant's surface per m3 */
} reaction_state;

typedef struct reaction_model {
    const char *name; /* in the deck */
    const char *doc;  /* one line */
    const char *cite;
    size_t param_size;
    const param_spec *params;
    size_t n_params;
    /* kg/(m3 s) that become product: finite, >= 0, and 0 without reactant. */
    double (*rate)(const void *par, const reaction_state *state);
} reaction_model;

/* All of them, in alphabetical order, made by the build from the file names. */
extern const reaction_model *const reaction_registry[];
extern const size_t reaction_registry_size;
/* NULL if there is none of that name. */
const reaction_model *reaction_find(const char *name);

typedef struct reaction {
    const reaction_model *model;
    const void *par;
    int reactant, product; /* materials of the cell */
    double heat;           /* J per kg that reacts; becomes internal energy of the product */
} reaction;

/* A cell at the start of the step. Heat capacities are kept through it. */
typedef struct reaction_cell {
    int n;                              /* materials */
    double rho[REACTION_MAX_MATERIALS]; /* kg per m3 of the cell; 0 of those that take no part */
    bool solid[REACTION_MAX_MATERIALS]; /* on points: keeps its temperature, which is none of the mixture's */
    double e[REACTION_MAX_MATERIALS], T[REACTION_MAX_MATERIALS], cv[REACTION_MAX_MATERIALS]; /* J/kg, K, J/kg/K */
    double density[REACTION_MAX_MATERIALS];                                                  /* pure, kg/m3 */
    double surface[REACTION_MAX]; /* of each reaction's reactant, m2/m3 */
    double p;                     /* Pa */
} reaction_cell;

typedef struct reaction_solver reaction_solver;

/* Solves cells of n reactions (borrowed). Errors: FLOE_NO_MEMORY. */
floe_status reaction_create(reaction_solver **out, context *ctx, int n, const reaction *list);
void reaction_destroy(context *ctx, reaction_solver **s);
/* reacted[k] >= 0: kg per m3 of the cell that reaction k turns over in dt (s); together never more than there is of a
 * reactant, and all of it where less than 1e-12 of the cell's mass would be left. False where CVODE cannot go on. */
bool reaction_integrate(reaction_solver *s, const reaction_cell *cell, double dt, double *reacted);

#endif
