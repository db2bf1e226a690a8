/* Forces of gas on cells on surfaces of solids. Private to the mpm module; boundary.h is for the cells. */
#ifndef MPM_SURFACE_MARKERS_H
#define MPM_SURFACE_MARKERS_H

#include "geom/contour.h"
#include "mpm/surface/surface_place.h"
#include "mpm/surface/surfaces.h"

/* The fluid of the cells beside a chain, by its number in the scene, or an mpm_no_fluid. */
int fluid_beside(const scene *s, const mesh *m, const contour *o, size_t chain);

/* Places markers on the shapes of solids. */
floe_status seed_markers(mpm *s);
/* Adds forces (N, three a marker) to N_FORCE of a group, on nodes with mass. */
void scatter_markers(mpm *s, int group, const double *force);
/* Adds their heat (W) to N_TEMP_CHANGE of a group, likewise. */
void scatter_marker_heat(mpm *s, int group);
/* Next positions and velocities of the markers of a group, and the displacement over which their forces do work. */
void move_markers(mpm *s, int group);
/* Moves them by nodal displacements instead. */
void displace_markers(mpm *s, node_displacement *displacement);
/* Forces on markers (N/Pa, three each) of a pressure on the surface as it is at the start of the step, as the surface at its end has them; and the volume
 * (m3) over which they pass with it, along them. */
void turn_marker_forces(const mpm *s, const double *force, double *out);
double swept_by_markers(const mpm *s, const double *first, const double *last);
/* Commits their next state. */
void commit_markers(mpm *s);
void free_markers(context *ctx, surface_markers *k);

#endif
