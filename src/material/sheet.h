/* A point of a membrane in space: plane stress in its tangent plane, with shear in it.
 *
 * Its state are two material vectors of the surface, at rest unit and normal to each other: F restricted to the tangent
 * plane, F = a_1 (x) E_1 + a_2 (x) E_2. They stretch with the velocity gradient and turn with the normal; C_ij = a_i .
 * a_j does not depend on either frame. The law sees the logarithms of the principal stretches (York 1997, section
 * 5.4.2, in two dimensions), and its stresses go along the principal directions: any isotropic law of membrane.h,
 * wrinkles and slack included (tension field, Reissner 1938). */
#ifndef MATERIAL_SHEET_H
#define MATERIAL_SHEET_H

#include "material/membrane.h"

typedef struct sheet_point {
    double a[2][3]; /* 1 */
} sheet_point;

/* Vectors across a unit normal, in a frame of their own, both of length `stretch` (below 1: slack). */
void sheet_start(const double normal[3], double stretch, sheet_point *p);
/* a <- (I + dt L) a: L in 1/s, row-major. False where it comes out of the numbers, or flat. */
bool sheet_stretch(const double L[9], double dt, sheet_point *p);
/* Rotates the vectors by the smallest angle into the plane normal to a unit vector (of either sign); their lengths and
 * their angle do not change. A normal of length zero, or one in the plane, changes nothing. */
void sheet_turn(const double normal[3], sheet_point *p);
/* Principal logarithmic strains, the larger first, and unit directions of them in space. */
void sheet_strain(const sheet_point *p, double strain[2], double direction[2][3]);
/* Cauchy stress (Pa; xx yy zz xy yz zx) and present volume over that at rest. `free_across` of the response must be
 * false. */
void sheet_stress(const membrane_response *r, const sheet_point *p, double stress[6], double *J);
/* As membrane_energy. */
double sheet_energy(const membrane_response *r, const sheet_point *p);

#endif
