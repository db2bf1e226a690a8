/* Normals of membranes whose points are not connected, by the methods of the surface module. Private to the mpm
 * module. */
#ifndef MPM_MEMBRANE_NORMAL_H
#define MPM_MEMBRANE_NORMAL_H

#include "mpm/mpm.h"
#include "surface/surface.h"

/* Of one body. */
typedef struct membrane_normals {
    surface_set set;
    surface_estimate *estimate; /* by number; owned */
    double *before;             /* 3 a point, by number: normals of the last step; owned */
    double *inside;             /* m, 3 a point of a fluid: places, for methods that need them; owned, else NULL */
    surface_link *link;         /* 2 a point, by number: where strain comes from places; owned, else NULL */
    size_t n_inside, seeded[SCENE_MAX_BODIES]; /* points that each fluid began with */
} membrane_normals;

/* Whether a body's normals are made without connections. */
bool normals_are_free(const mpm *s, int body);
/* Space for a body's normals, and the first of them; its line has been made (membrane_curve.h). */
floe_status normals_start(mpm *s, int body);
void normals_free(membrane_normals *n);

#endif
