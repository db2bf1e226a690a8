/* Gas points that a surface in three dimensions encloses (enclosed_gas.c). Private to the mpm module. */
#ifndef MPM_ENCLOSED_GAS_H
#define MPM_ENCLOSED_GAS_H

#include "mpm/mpm.h"

/* Gas points that a surface in three dimensions encloses (enclosed_gas.c). */
typedef struct gas_enclosure {
    size_t n;        /* points of the surface; 0: none encloses gas */
    int body;        /* the surface's */
    int material;    /* the gas's, in the scene */
    double *force;   /* N, three each: forces of the mean pressure of the gas, by number of the points; owned */
    double *area;    /* m2: by number of the points; owned */
    double pressure; /* Pa: mean pressure of the gas less the reference pressure */
    double growth;   /* the enclosed volume over the volume of all gas points */
} gas_enclosure;

/* Whether a body's points are gas that a surface encloses. */
bool is_enclosed_gas(const mpm *s, int body);
/* Finds the enclosing surface at the start. FLOE_BAD_INPUT says why it is not closed. */
floe_status start_enclosure(mpm *s);
void free_enclosure(mpm *s);
/* The forces of the gas's mean pressure on the points of the surface. */
void scatter_enclosed_pressure(mpm *s, int group);
/* Scales the volumes of a batch of gas points so that together they fill the enclosed volume. */
void scale_to_enclosed_volume(const mpm *s, int body, solid_batch *b);

#endif
