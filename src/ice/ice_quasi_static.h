/* Quasi-static gas on cells, for solids in equilibrium (sim/quasi_static_gas.h): connected cells of gas are a region,
 * and at rest a region has one pressure. */
#ifndef ICE_QUASI_STATIC_H
#define ICE_QUASI_STATIC_H

#include "ice/ice.h"

/* Contents of a region, and the loads on it in the increment. */
typedef struct ice_gas_region {
    double mass, volume;        /* kg, m3 */
    double energy;              /* J: total energy; kinetic energy becomes heat */
    double heat;                /* J: of loads of given power */
    double prescribed_pressure; /* Pa: prescribed by a load or by open sides; NAN: by its law */
    bool open;                  /* it reaches sides through which gas can flow */
} ice_gas_region;

typedef struct ice_quasi_static {
    context *ctx;           /* not owned */
    ice_gas_region *region; /* owned */
    int n;
    int *of;      /* of every global cell: its region, -1: no gas. Owned */
    int *seen;    /* the same, -1 also where there is almost none; owned */
    int *list;    /* scratch; owned */
    int material; /* of the gas */
} ice_quasi_static;

/* The state of a region after the increment. */
typedef struct ice_gas_region_state {
    double mass, volume, energy, pressure; /* kg, m3, J/kg, Pa */
} ice_gas_region_state;

/* Why the gas of the scene has no equilibrium with one pressure a region, in words, or NULL. */
const char *ice_quasi_static_obstacle(const ice *s);
floe_status ice_quasi_static_create(ice_quasi_static **out, ice *s);
void ice_quasi_static_destroy(ice_quasi_static **r);
/* Finds the regions from the current state and the current boundaries. Errors: FLOE_BAD_INPUT where a load prescribes
 * the pressure of an open region, or open sides prescribe two pressures; FLOE_NO_MEMORY. */
floe_status ice_quasi_static_find(ice *s, ice_quasi_static *r);
/* Region of a global cell, or of a neighbour where that has none; -1: none there either. */
int ice_gas_region_near(const ice *s, const ice_quasi_static *r, const int cell[MESH_MAX_DIM]);
/* Sets the cells after the solids have moved (their densities and the boundaries at CUT_NEXT are known): each region
 * with its gas at rest. FLOE_NO_MEMORY. */
floe_status ice_quasi_static_fill(ice *s, const ice_quasi_static *r, const ice_gas_region_state *state);

#endif
