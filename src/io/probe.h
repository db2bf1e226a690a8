/* Probes: what the state is at a place. */
#ifndef IO_PROBE_H
#define IO_PROBE_H

#include "sim/sim.h"

typedef struct probe_value {
    double pressure;               /* Pa, absolute; NAN where nothing is */
    double velocity[MESH_MAX_DIM]; /* m/s, of all materials there together; NAN where nothing is */
} probe_value;

/* The state of the cell that holds x: of the cells' fields if the scene has cells, else the mean of the points there,
 * by volume for the pressure and by mass for the velocity. All NAN outside the mesh. */
probe_value probe_read(const sim *s, const double x[3]);

#endif
