/* Membranes as embedded boundaries: the curve, or the triangles, between their points, and the forces of gas on them.
 * Private to the mpm module; boundary.h is for the cells. */
#ifndef MPM_MEMBRANE_BOUNDARY_H
#define MPM_MEMBRANE_BOUNDARY_H

#include "embedded/cut.h"
#include "mpm/mpm.h"

/* Joins the points of membranes that enclose gas of the cells, and allocates the forces on them. FLOE_BAD_INPUT names a
 * surface that is open. */
floe_status start_membrane_force(mpm *s);
void free_membrane_force(mpm *s);
/* Adds the forces to N_FORCE of a group. */
void scatter_membrane_force(mpm *s, int group);

/* Whether a body is a surface in space whose points are joined, and the volume (m3) that it encloses; NAN where only sides of
 * the mesh tell where that ends. */
bool membrane_is_joined(const mpm *s, int body);
double membrane_volume(mpm *s, int body);

/* What boundary.h has of any boundary, of a membrane. */
floe_status membrane_vertices(mpm *s, int body, bool next, cut_surface *out);
void membrane_velocity(const mpm *s, int body, const cut_surface *c, double *velocity);
void membrane_set_force(mpm *s, int body, const cut_surface *c, const double *force);
void membrane_displacement(const mpm *s, int body, const cut_surface *c, double *path);

#endif
