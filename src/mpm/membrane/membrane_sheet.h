/* Membranes as surfaces in space (membrane_sheet.c). Private to the mpm module. */
#ifndef MPM_MEMBRANE_SHEET_H
#define MPM_MEMBRANE_SHEET_H

#include "material/sheet.h"
#include "mpm/mpm.h"

/* Whether a body is a surface in space. */
bool is_sheet(const mpm *s, int body);
/* Its material vectors at the start, across its normals, and the stress in them. FLOE_BAD_INPUT names a point without a
 * normal. */
floe_status start_sheet(mpm *s, int body);
/* Stretches the vectors of points [start, end) whose L stands in the batch. FLOE_RETRY names one that is crushed. */
floe_status strain_sheet(mpm *s, int blk, int body, size_t start, size_t end, const solid_batch *rate);
/* Turns the vectors across the normals of the next state, and puts the stress. */
void turn_sheet(mpm *s, int body);
/* Strain energies (J/m3 at rest) of points [start, end). */
void sheet_energies(const mpm *s, int blk, int body, size_t start, size_t end, double *psi);

#endif
