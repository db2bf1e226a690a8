/* The first contents of a cell: what bodies and the ambient bring into it (theory 2.4). */
#ifndef ICE_FIRST_CONTENTS_H
#define ICE_FIRST_CONTENTS_H

#include "ice/ice_view.h"

/* What one material brings into a cell, per cell volume. */
typedef struct content {
    double fraction, mass, momentum[3], energy;
} content;

/* Adds the fluids of all bodies to the contents of the cell whose lower corner is `lo`: earlier bodies first, those that yield last (the rule of
 * scene/layout.h). *left: the free volume fraction, before and after. */
floe_status ice_add_bodies(const ice *s, const double lo[3], double *left, content *contents);
floe_status ice_add_ambient(const ice *s, content *contents, double free, const double lo[3]);
/* Bodies first, then the ambient in the free fraction. */
floe_status ice_fill_cell(const ice *s, const double lo[3], double free, content *contents);
/* A cell that a solid shares: what no fluid covers of it lies inside the solid, and is filled as the nearest cell outside, so that a fluid has the
 * mass and the momentum of its whole volume. nearest: that cell's number; -1: there is none. */
floe_status ice_fill_beside(const ice *s, const double lo[3], double free, int nearest, content *contents);
/* Share of its shape's volume that a body takes at x. */
double ice_share_at(const scene *s, const scene_body *body, const double x[3]);
void ice_store_contents(const ice *s, const ice_view *v, ptrdiff_t at, const content *contents);
/* The first guess at the equilibrium pressure of a block's cells: that of any fluid in the cell by itself, else the ambient's, or the reference. */
void ice_guess_pressure(const ice *s, const ice_view *v, double *p);

#endif
