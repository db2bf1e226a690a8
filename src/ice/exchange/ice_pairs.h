/* Exchange of momentum and heat by pairs; only this folder includes it. */
#ifndef ICE_PAIRS_H
#define ICE_PAIRS_H

#include "ice/equilibrium/ice_equilibrium.h"
#include "ice/exchange/ice_exchange.h"
#include "ice/state/ice_lists.h"

#include <math.h>

/* Coefficients of exchange: of momentum along the normal of pairs that slip (of all momentum elsewhere), of
 * tangential momentum, of heat. */
typedef enum ice_coefficient { ICE_NORMAL, ICE_TANGENTIAL, ICE_HEAT, ICE_COEFFICIENTS } ice_coefficient;

/* An exchange law that depends on the state of its pair. */
typedef struct ice_pair_law {
    int first, second;
    ice_coefficient which; /* which coefficient it gives */
    const struct exchange_law *model;
    const void *par; /* the scene's */
} ice_pair_law;

/* Exchange laws of the deck. */
typedef struct ice_pairs {
    double (*table[ICE_COEFFICIENTS])[EXCHANGE_MAX]; /* constants, in ice.exchange */
    ice_pair_law law[3 * SCENE_MAX_EXCHANGES];
    int n;
    bool plain;                   /* constants alone */
    bool prescribed;              /* some solid has a prescribed motion */
    bool unlike;                  /* of three or more materials, pairs have different constants */
    bool heat;                    /* some pair exchanges heat */
    bool slips;                   /* some pair has a tangential law of its own */
    bool wall[ICE_MAX_MATERIALS]; /* the gradient of these materials' volume fraction is the normal */
} ice_pairs;

/* Materials at a cell or face, before exchange. */
typedef struct ice_spot {
    double theta[EXCHANGE_MAX], density[EXCHANGE_MAX], u[3][EXCHANGE_MAX]; /* 1, kg/m3 of the pure material, m/s */
    double sound[EXCHANGE_MAX], slope[3];                                  /* m/s; Pa/m: the gradient of p */
} ice_spot;

/* Share of positive heat that is distributed by theta kappa and not by rho T: for dispersed fluids in a shock. */
static inline double ice_shocked(const ice_view *v, ptrdiff_t at, double heat)
{
    return v->interface && heat > 0.0 ? v->shock[at] * (1.0 - v->interface[at]) : 0.0;
}

/* What resists an exchange: nothing accelerates bodies with a prescribed motion. */
static inline double ice_inertia(const ice_view *v, int r, double mass)
{
    return v->material[r].prescribed && mass > 0.0 ? (double)INFINITY : mass;
}

/* Constants of the pairs of a view. */
double (*ice_constants_of(const ice *s, const ice_view *v, ice_coefficient which))[EXCHANGE_MAX];
/* Coefficients at a place: the table of constants, or `own`, filled from it and the laws. */
double (*ice_coefficients(const ice *s, const ice_view *v, ice_coefficient which, const ice_spot *spot,
                          exchange_matrix own))[EXCHANGE_MAX];
/* Gradient (1/m) of the volume fraction of the walls, and its direction; false: none to speak of. */
void ice_wall_gradient(const ice_view *v, ptrdiff_t at, double gradient[3]);
/* Gradient of p (Pa/m) in a cell. */
void ice_pressure_slope(const ice_view *v, ptrdiff_t at, double slope[3]);
bool ice_wall_normal(const ice_view *v, const double gradient[3], double normal[3]);
/* Momentum exchange of whole vectors; factor: dt at a face, dt TMV/V in a cell; gradient NULL: no pair slips. */
void ice_relax_spot(const ice *s, const ice_view *v, const double *mass, const ice_spot *spot, double factor,
                    const double *gradient, double u[3][EXCHANGE_MAX]);
/* Momentum exchange of the only two materials, by constants, in cells [from, to) of a list of mixed ones (ice_exchange_pair.c). */
void ice_exchange_pair(const ice *s, const ice_view *v, const ice_cell_list *list, size_t from, size_t to);

#endif
