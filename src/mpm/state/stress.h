/* Strain, stress and state of the points by their laws, in batches (stress.c); which of it a body keeps (create.c). */
#ifndef MPM_STRESS_H
#define MPM_STRESS_H

#include "mpm/mpm.h"

/* Sums of a pass over the points: energy (J) of heating loads, work of the reference pressure and of body forces, and
 * the impulse (N s) of the latter by component. */
enum {
    GAIN_HEAT,
    GAIN_REFERENCE,
    GAIN_BODY_FORCE,
    GAIN_IMPULSE,
    GAIN_MOMENT = GAIN_IMPULSE + MESH_MAX_DIM,
    GAIN_SUPPORT = GAIN_MOMENT + 3,
    GAIN_SUPPORT_MOMENT = GAIN_SUPPORT + MESH_MAX_DIM,
    GAIN_SUPPORT_WORK = GAIN_SUPPORT_MOMENT + 3,
    MPM_GAINS
};

/* Strain, artificial viscosity, heating and the law, for points [start, end) whose L stands in the batch (stress.c). */
floe_status update_stress(mpm *s, int blk, int body, size_t start, size_t end, solid_batch *batch,
                          double gain[MPM_GAINS]);
/* Rates of volume (1/s) of a batch whose L stands in it, as laws take them; L is then that of the middle of the step (stress.c). */
void rates_of_volume(const mpm *s, solid_batch *batch, double *out);
/* The time (s) over which stress is advanced (stress.c). */
double strain_step(const mpm *s);
/* Fills a batch with the state that wave speeds of points [start, end) need (stress.c). */
void load_speed_batch(const mpm *s, int blk, int body, size_t start, size_t end, solid_batch *batch);
/* Fills a batch with the current state of points [start, end) (stress.c). */
void load_batch(const mpm *s, int blk, int body, size_t start, size_t end, bool next, solid_batch *batch);
/* Makes a batch the next state of its points, from `start` (stress.c). */
void store_batch(const mpm *s, int blk, int body, size_t start, const solid_batch *b);
/* Whether a body has artificial viscosity. */
bool has_artificial(const mpm_body *b);
/* Whether the domains of a body's points deform with F (CPDI; create.c). */
bool keeps_shape(const mpm *s, int body);
/* Whether the domains of a body's points grow with their volume (GIMP, fluids). */
bool keeps_box(const mpm *s, int body);
/* Whether F is stored, for the shape of domains or for the law. */
bool keeps_F(const mpm *s, int body);

#endif
