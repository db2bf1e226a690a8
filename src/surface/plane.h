/* The line or plane through points, by the moments of their positions. Private to the surface module. */
#ifndef SURFACE_PLANE_H
#define SURFACE_PLANE_H

#include "surface/neighbours.h"

/* Unit axes: two along the surface (in 2-D the second is the third axis of space), and the normal. */
typedef struct surface_frame {
    double u[3], v[3], n[3];
} surface_frame;

/* Fits to a point and its neighbours within `reach`, weighted by `weight` of their squared distance over that of
 * `reach`. False where they have no direction: they fall upon each other, in 3-D lie on a line. */
bool surface_plane(int dim, int n, const surface_neighbour *near, double reach, surface_frame *out);
/* (1 - s)^2 up to s = 1, zero beyond: weight of a neighbour at the distance sqrt(s) of the reach. */
double surface_weight(double s);
/* Two axes that make a right-handed frame with the unit n; in 2-D the second is the third axis of space. */
void surface_frame_about(int dim, const double n[3], surface_frame *out);

#endif
