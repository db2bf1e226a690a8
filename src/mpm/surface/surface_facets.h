/* The pieces of loaded surfaces, of those beside enclosed gas and of those in contact (theory 4.13; traction.c). Private to the mpm module. */
#ifndef MPM_SURFACE_FACETS_H
#define MPM_SURFACE_FACETS_H

#include "mpm/mpm.h"

/* What a facet is there for. */
typedef enum surface_use {
    SURFACE_LOADED,    /* by a load of the scene */
    SURFACE_BY_GAS,    /* an enclosed gas (implicit.h) presses on it */
    SURFACE_IN_CONTACT /* gaps are measured from it (implicit_gap.c) */
} surface_use;

/* A piece of a surface: a point, a segment or a triangle between corners that it shares with others, in such an order that its area
 * vector points into the body where it is pressed, out of it for contact. */
typedef struct surface_facet {
    size_t corner[3];
    double at_rest[3][3]; /* m2: what a unit of pressure puts on each corner, at rest; on a line +1 or -1, for good */
    double area[3];       /* m2: for contact, the area vector at rest with the normal of the surface */
    double offset[3];     /* m: from its centre to the curved surface at rest; for contact */
    surface_use use;
    int number; /* of the load in the scene, or of the enclosed gas */
    int body;   /* of the scene */
} surface_facet;

/* What a unit of pressure along the area of a segment or a triangle puts on each of its corners (m2): the gradient of the volume that the surface
 * encloses with their places (m). */
void pressure_between(const mesh *m, const double *const corner[3], double force[3][3]);
/* The same of a facet. */
void pressure_on_corners(const mpm *s, const double *place, const surface_facet *f, double force[3][3]);
/* Centre (m) and area vector (m2; times the radius about an axis) of a facet whose corners lie at these places. */
void centre_of_facet(const mpm *s, const double *place, const surface_facet *f, double x[3]);
void area_of_facet(const mpm *s, const double *place, const surface_facet *f, double area[3]);
/* Whether the pressure on a facet follows the surface. */
bool facet_follows(const mpm *s, const surface_facet *f);
#endif
