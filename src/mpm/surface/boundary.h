/* Embedded boundaries in the cells of gas, as membranes or surfaces of solids have them: their position, their motion,
 * and the forces of the gas on them. */
#ifndef MPM_BOUNDARY_H
#define MPM_BOUNDARY_H

#include "coupling/wall_response.h"
#include "embedded/cut.h"
#include "geom/contour.h"
#include "mpm/mpm.h"

/* Adds the surface of a solid body of the scene to the boundary `out`, as it ends on sides of the mesh: the part that bounds a fluid (by its number in the
 * scene); -1: all of it. */
floe_status mpm_boundary_add(const scene *s, const mesh *m, const scene_body *body, int fluid, cut_surface *out);
/* Positions without a fluid on cells: no fluid was given, inside a solid, or along a chain where two fluids meet. */
typedef enum mpm_no_fluid { MPM_NO_FLUID = -1, MPM_IN_A_SOLID = -2, MPM_FLUIDS_MEET = -3 } mpm_no_fluid;
/* The fluid on cells at a position at the start, by its number in the scene, or an mpm_no_fluid. */
int mpm_fluid_at(const scene *s, int dim, const double x[3]);
/* Vertices from the points of a membrane, now or next; an end near a mirror is continued to it. FLOE_DIVERGED where a
 * point is lost. */
floe_status mpm_boundary_vertices(mpm *s, int body, bool next, cut_surface *out);
/* With a sharp interface: vertices from the markers of all surfaces, and chains of those that bound a fluid, by its
 * number in the scene; -1: any. The functions below use them for any body. */
floe_status mpm_boundary_beside(mpm *s, int fluid, bool next, cut_surface *out);
/* Velocities (m/s) of the vertices, three numbers each. */
void mpm_boundary_velocity(const mpm *s, int body, const cut_surface *c, double *velocity);
/* Adds forces (N) on the vertices, three numbers each, for the next step to those of other fluids. They are stored until
 * they are cleared. */
void mpm_boundary_force(mpm *s, int body, const cut_surface *c, const double *force);
void mpm_boundary_clear(mpm *s);
/* Where heat passes surfaces (theory 7.10): the temperature (K) of each vertex, NAN where its solid conducts no heat; and the heat (W) that fluids conduct
 * into each in the next step, added to that of other fluids until it is cleared. */
void mpm_boundary_temperature(const mpm *s, double *temperature);
void mpm_boundary_heat(mpm *s, const double *heat);
/* The largest step (s) in which such heat keeps surface and fluid from overtaking each other. */
double mpm_wall_heat_step(const mpm *s);
/* Their sum on a solid (N) in the last step, changes included. False: the body has no surface beside a fluid of the cells, or shares it with others (welded.h). */
bool mpm_boundary_sum_force(const mpm *s, int body, double force[3]);
/* How these forces change with the motion of the markers in the next step (theory 7.6), whose vertices are by number the markers:
 * the step finds the changes and adds them to the forces. NULL: they do not change. Borrowed until the step is over. */
void mpm_boundary_responds(mpm *s, wall_response *w);
/* The displacement (m) over which these forces do work in the step: that of the nodes, with the mean of their
 * velocities at its start and end. */
void mpm_boundary_displacement(const mpm *s, int body, const cut_surface *c, double *path);

/* Energy that all points have lost in the step (J), which the gas gets as heat (method.losses); 0 where it is a
 * drift. */
double mpm_boundary_lost_energy(const mpm *s);

#endif
