/* Tracers: places of bodies of points that the history follows as the bodies move (docs/theory, 10.6). */
#ifndef SIM_TRACER_H
#define SIM_TRACER_H

#include "sim/sim.h"

/* The values of a tracer; NAN if points from which it is computed have left the domain. */
typedef struct tracer_value {
    double displacement[MESH_MAX_DIM]; /* m, since the start */
    double velocity[MESH_MAX_DIM];     /* m/s */
    double stress[6];                  /* Pa, Cauchy: xx yy zz xy yz zx; NAN where the body carries none */
} tracer_value;

/* Finds for each tracer of the scene the points near its place and their weights, in the state at the start. Tracers of
 * bodies that are not of points in this coupling are left out. Errors: FLOE_BAD_INPUT where the body has no point
 * within a cell and a half of the place. */
floe_status tracers_create(struct tracers **out, const sim *s);
void tracers_destroy(context *ctx, struct tracers **t);
/* Whether tracer n of the scene shows anything, and whether its body carries stress. */
bool tracer_is_of_points(const sim *s, int n);
bool tracer_has_stress(const sim *s, int n);
/* Values of all tracers of the scene now, out[scene.n_tracers]: one pass over the points of their bodies. */
void tracers_read(const sim *s, tracer_value *out);

#endif
