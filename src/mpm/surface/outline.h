/* What cuts the cells of gas, a membrane that holds gas or the surfaces of solids, as lines: where they are, how they
 * move, and what the gas pushes on them. */
#ifndef MPM_OUTLINE_H
#define MPM_OUTLINE_H

#include "embedded/cut.h"
#include "geom/outline.h"
#include "mpm/mpm.h"

/* The surface of a solid body of the scene as markers are laid on it at the start, four a cell. To be freed by
 * outline_free. */
floe_status mpm_outline_trace(const scene *s, const mesh *m, const scene_body *body, outline *out);
/* Adds it to the lines of `out`: what of it holds back a fluid, by its number in the scene; -1: all of it. */
floe_status mpm_outline_lay(const scene *s, const mesh *m, const scene_body *body, int fluid, cut_surface *out);
/* Where no fluid of the cells is: in a solid; where none was given; along a chain, where two meet. */
typedef enum mpm_no_fluid { MPM_NO_FLUID = -1, MPM_IN_A_SOLID = -2, MPM_FLUIDS_MEET = -3 } mpm_no_fluid;
/* The fluid of the cells at a place at the start, by its number in the scene, or an mpm_no_fluid. */
int mpm_fluid_at(const scene *s, int dim, const double x[3]);
/* Vertices from the points of a membrane (a body of ours), now or next; an end of it on a mirror goes on to it. FLOE_DIVERGED where a
 * point is lost. */
floe_status mpm_outline(mpm *s, int body, bool next, cut_surface *out);
/* Where the interface is sharp: vertices from the markers of all surfaces, lines of those that hold back a fluid, by its
 * number in the scene. What follows takes them whatever the body. */
floe_status mpm_outline_beside(mpm *s, int fluid, bool next, cut_surface *out);
/* Velocities (m/s) of the vertices, two numbers each. */
void mpm_outline_velocity(const mpm *s, int body, const cut_surface *c, double *velocity);
/* Forces (N) on the vertices, two numbers each, for the step to come, on top of those of other fluids. They are kept until
 * they are cleared. */
void mpm_outline_push(mpm *s, int body, const cut_surface *c, const double *force);
void mpm_outline_clear(mpm *s);
/* The way (m) over which these forces have worked in the step: that of the nodes, in the mean of its start and its
 * end. */
void mpm_outline_path(const mpm *s, int body, const cut_surface *c, double *path);

/* What all points have lost in the step (J), for the gas to take up as heat (method.losses); 0 where it is to be a
 * drift. */
double mpm_outline_lost(const mpm *s);

#endif
