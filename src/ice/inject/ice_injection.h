/* Places of cells that fluid comes to or leaves, and what it does to a cell. Only this folder includes it. */
#ifndef ICE_INJECTION_H
#define ICE_INJECTION_H

#include "ice/inject/ice_inject.h"
#include "ice/state/ice_lists.h"
#include "scene/mass_source.h"

/* A region in which a fluid is concerned. */
typedef struct inject_place {
    const shape *region; /* not owned; its model may be NULL: everywhere */
    int material;        /* of s->material */
    ice_region_cells within;
} inject_place;

typedef struct ice_injection {
    inject_place source[SCENE_MAX_SOURCES];
    inject_place vent[SCENE_MAX_VENTS][2];
    double *weight[MESH_MAX_BLOCKS]; /* m3 of cells, in one place at a time: ice_set_weights; owned */
} ice_injection;

/* Sets the weights of a place after the step: the volume that fluids have in the part of each cell that lies in it, alike
 * in all members of merged cells for each m3. Returns their sum. */
double ice_set_weights(ice *s, const inject_place *p);
/* All cells with a weight: for (ice_weighed c = ice_weighed_of(s, p); ice_next_weighed(&c);). */
typedef struct ice_weighed {
    ice *s;
    const ice_region *g;
    int id, r; /* r: the place's material among the view's */
    ice_view v;
    bool open;     /* the view is that of block id - 1 */
    ptrdiff_t at;  /* the cell */
    double weight; /* m3 */
    double volume; /* m3 that one kg/m3 of a fluid stands for in the cell */
    int local[MESH_MAX_DIM];
} ice_weighed;
ice_weighed ice_weighed_of(ice *s, const inject_place *p);
bool ice_next_weighed(ice_weighed *c);
/* The sums of its tile, and the place of its middle. */
double *ice_weighed_tile(const ice_weighed *c, double x[MESH_MAX_DIM]);

/* What comes into one cell, for each m3 of it. */
typedef struct cell_intake {
    double density;     /* kg/m3 */
    double temperature; /* K */
    double velocity[3]; /* m/s */
} cell_intake;
/* Adds it to the next state of a cell. Returns the energy that it has brought (J/m3): enthalpy and kinetic energy. */
double ice_take_in(const ice_view *v, int r, ptrdiff_t at, const cell_intake *in);
/* Takes mass and enthalpy (kg/m3, J/m3) out of the next state, at the cell's velocity. */
void ice_give_out(const ice_view *v, int r, ptrdiff_t at, double density, double enthalpy);

/* Lets a mass in at a place, by its weights, whose sum is `all`. entered: its mass, momentum and energy are sources of the ledger;
 * else only their moments. */
void ice_let_in(ice *s, const inject_place *p, double all, const mass_intake *in, bool entered);
/* The vents' part of the stage. */
floe_status ice_pass_vents(ice *s);

#endif
