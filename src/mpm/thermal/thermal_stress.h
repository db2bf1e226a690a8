/* What temperature does to stress and stress to temperature, about a call of the law (theory 12.5, 12.6). */
#ifndef MPM_THERMAL_STRESS_H
#define MPM_THERMAL_STRESS_H

#include "mpm/mpm.h"

/* Temperature and heat of a batch of a body whose law depends on them; 0 where its points carry no temperature. */
void load_heat(const mpm *s, int blk, int body, size_t start, solid_batch *b);

/* Of a batch of a body that warms, between the two calls below. */
typedef struct thermal_batch {
    double energy[SOLID_CHUNK];  /* J/kg: before the law */
    double stretch[SOLID_CHUNK]; /* of which the law sees none */
    double rate[3][SOLID_CHUNK]; /* 1/s: normal rates of the motion */
    double growth[SOLID_CHUNK];  /* logarithm of the thermal stretch of the step */
    double trace[SOLID_CHUNK];   /* Pa: of the stress before the law */
} thermal_batch;

/* Before the law: takes the thermal strain out of rates, or out of F and J. */
void begin_thermal_stress(const mpm *s, int blk, int body, size_t start, solid_batch *b, thermal_batch *t);
/* After the law: F and J as they are; the heat of the step leaves the law's energy and is put aside for the points. */
void end_thermal_stress(const mpm *s, int blk, int body, size_t start, solid_batch *b, thermal_batch *t);
/* psi (J/m3, per initial volume) of a law that goes by F, of the current state in b. */
void thermal_strain_energy(const mpm *s, int blk, int body, size_t start, solid_batch *b, double *psi);

#endif
