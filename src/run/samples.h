/* What is compared with an exact solution: values at points, or averages over cells. */
#ifndef RUN_SAMPLES_H
#define RUN_SAMPLES_H

#include "io/gather.h"
#include "sim/sim.h"
#include "verify/exact.h"

/* The points of a body, in the order of their ids. Arrays are counted memory, owned. */
typedef struct point_samples {
    const sim *s;
    const exact *solution;
    int body; /* instance of the point fields */
    point_list list;
    double *x[3];      /* m */
    double *start[3];  /* m: where they were seeded; NULL where the exact solution does not ask for it */
    double *v[3];      /* m/s */
    double *normal[3]; /* of a membrane, where the exact solution has one; else NULL */
    double *stress[6]; /* Pa, xx yy zz xy yz zx; NULL: zero */
    double *volume;    /* m3, now */
    double *density;   /* kg/m3, now */
    double *energy;    /* J/kg; NULL if the body has none */
} point_samples;

floe_status point_samples_take(point_samples *p, const sim *s, const exact *solution, int body);
void point_samples_free(point_samples *p);
/* The quantity as the run has it at point i, and as the exact solution has it there and then; NAN if there is none. */
double point_value(const point_samples *p, exact_quantity quantity, size_t i);
double point_exact(const point_samples *p, exact_quantity quantity, size_t i);
bool point_inside(const point_samples *p, const shape *region, size_t i);

/* Instead of a material: all of them together, velocity and energy weighed by mass. */
enum { CELLS_OF_ALL = ICE_MAX_MATERIALS };

/* The cells of a material, in global order. Arrays are counted memory, owned. */
typedef struct cell_samples {
    const sim *s;
    const exact *solution;
    int material; /* instance of the cell fields, or CELLS_OF_ALL */
    size_t n;
    double *rho, *energy, *pressure;
    double *volume;   /* m3/kg, of the pure material; NULL with one fluid, or all */
    double *fraction; /* of the first material; NULL but for all */
    double *open;     /* share of the cell that a membrane leaves; NULL without one */
    double *v[3];
} cell_samples;

floe_status cell_samples_take(cell_samples *c, const sim *s, const exact *solution, int material);
void cell_samples_free(cell_samples *c);
double cell_value(const cell_samples *c, exact_quantity quantity, size_t i);
/* The average of the exact solution over the cell: mass-weighted for quantities per mass. */
double cell_exact(const cell_samples *c, exact_quantity quantity, size_t i);
/* The volume (m3) that the material has in the cell. */
double cell_weight(const cell_samples *c, size_t i);
bool cell_inside(const cell_samples *c, const shape *region, size_t i);

#endif
