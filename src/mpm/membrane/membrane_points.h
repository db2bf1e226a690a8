/* Membranes and strings among the bodies (membrane_points.c, seed_membrane.c). Private to the mpm module. */
#ifndef MPM_MEMBRANE_H
#define MPM_MEMBRANE_H

#include "mpm/mpm.h"

/* The law that the points of a membrane have among the solids'. */
extern const solid_model point_membrane;
/* Places and volumes of a membrane's points. Errors: FLOE_BAD_INPUT where they cannot be laid, FLOE_NO_MEMORY. */
floe_status seed_membrane(const mpm *s, const scene_body *b, const seed_spec *grid, seed_list *list);
/* Slack and mass of the n-th point of a body (0 first), which lies at k. */
floe_status set_membrane(mpm *s, int blk, int body, size_t k, size_t n);
/* The law of a body; its model is NULL where that is no membrane. */
membrane_response response_of(const mpm *s, const scene_body *b);
/* Strain of points [start, end) from L in the batch, and stress along their current tangents. FLOE_RETRY for a point
 * that is crushed. */
floe_status strain_membrane(mpm *s, int blk, int body, size_t start, size_t end, const solid_batch *rate);
/* Curves, normals and tangents of all membranes at the start, and the forces of gas on them. */
floe_status start_membranes(mpm *s);
/* FLOE_RETRY, in words: point k would be crushed to nothing. */
floe_status membrane_torn(const mpm *s, int blk, int body, size_t k);
/* Slack strain of a point (by number, from 0), below which it has no tension. */
double slack_of(const mpm *s, int body, size_t number);
/* Strain energy (J/m3 at rest) of points [start, end). */
void membrane_energies(const mpm *s, int blk, int body, size_t start, size_t end, double *psi);

#endif
