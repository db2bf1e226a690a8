/* Gas of the cells at rest, for solids whose state of rest is solved for (sim/gas_rest.h): cells of gas that hang
 * together are a region, and a region at rest has one pressure. */
#ifndef ICE_ICE_REST_H
#define ICE_ICE_REST_H

#include "ice/ice.h"

/* What is in a region, and what acts on it in the step. */
typedef struct ice_rest_region {
    double mass, volume; /* kg, m3 */
    double energy;       /* J: all of it; motion becomes heat */
    double heat;         /* J: of loads of given power */
    double held;         /* Pa: a load's, or that of open sides; NAN: its own */
    bool open;           /* to sides through which gas comes and goes */
} ice_rest_region;

typedef struct ice_rest {
    context *ctx;            /* not owned */
    ice_rest_region *region; /* owned */
    int n;
    int *of;      /* of every global cell: its region, -1: no gas. Owned */
    int *seen;    /* the same, -1 also where there is next to none; owned */
    int *list;    /* scratch; owned */
    int material; /* of the gas */
} ice_rest;

/* What a region has come to. */
typedef struct ice_rest_state {
    double mass, volume, energy, pressure; /* kg, m3, J/kg, Pa */
} ice_rest_state;

/* What of the scene's gas does not come to a rest of one pressure a region, or NULL. */
const char *ice_rest_obstacle(const ice *s);
floe_status ice_rest_create(ice_rest **out, ice *s);
void ice_rest_destroy(ice_rest **r);
/* Finds the regions from the state as it is, where the lines are included. Errors: FLOE_BAD_INPUT where a load would
 * pressurise a region that is open, or open sides hold it at two pressures; FLOE_NO_MEMORY. */
floe_status ice_rest_find(ice *s, ice_rest *r);
/* Region of a global cell, or of one beside it where that holds none; -1: nor there. */
int ice_rest_near(const ice *s, const ice_rest *r, const int cell[MESH_MAX_DIM]);
/* Fills the cells again once the solids have moved (their densities stand, and the lines at SEAL_NEXT): each region
 * with the gas that it has, at rest. FLOE_NO_MEMORY. */
floe_status ice_rest_fill(ice *s, const ice_rest *r, const ice_rest_state *state);

#endif
