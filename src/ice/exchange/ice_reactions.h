/* Reactions; only this folder includes it. */
#ifndef ICE_REACTIONS_H
#define ICE_REACTIONS_H

#include "coupling/reaction.h"
#include "ice/exchange/ice_exchange.h"

/* Reactions between materials of the cells. */
typedef struct ice_reactions {
    reaction list[REACTION_MAX];
    bool burns[REACTION_MAX]; /* the reactant is carried by points (ice_burn.c) */
    int n, threads;
    reaction_solver **solver; /* one a thread */
} ice_reactions;

/* Effect of reactions on one cell in the step, per cell volume. */
typedef struct ice_creation {
    bool any;
    double mass[ICE_MAX_MATERIALS], volume[ICE_MAX_MATERIALS]; /* kg/m3, 1: at the pressure of the step's start */
    double theta[ICE_MAX_MATERIALS];                           /* volume fractions that dP compresses */
    double dP; /* Pa: full-step pressure increment that compensates the new volume (theory 2.3) */
} ice_creation;

/* Surface (m2/m3) at which a solid on points burns, in a cell (ice_burn.c). */
double ice_burning_surface(const ice_view *v, int r, ptrdiff_t at);
/* Adds what reaction k has consumed of the points of a cell, local index i along axis 0, to its product. */
void ice_join_burnt(const ice *s, const ice_view *v, int k, ptrdiff_t at, int i);
ice_creation ice_created(const ice *s, const ice_view *v, ptrdiff_t at);

#endif
