/* Chunks of a body's points, as many as a batch of its law holds, in steps that are solved for. Private to implicit*.c. */
#ifndef MPM_IMPLICIT_CHUNKS_H
#define MPM_IMPLICIT_CHUNKS_H

#include "mpm/implicit/implicit.h"

/* Components of grad u, all nine, of the points of a chunk. */
typedef double gradient_rows[IMPLICIT_GRADIENTS][SOLID_CHUNK];

/* What is done with a chunk of a body's points, [start, end) of a block. */
typedef floe_status chunk_visit(mpm *s, int blk, int body, size_t start, size_t end, const double *u, solid_batch *b);
/* Does it with all chunks of solids, side by side; one that failed says so. */
floe_status visit_chunks(mpm *s, const double *u, chunk_visit *visit);

/* grad u of a chunk at the displacement u (m). */
void gather_chunk(const mpm *s, int blk, int body, size_t start, size_t end, const double *u, gradient_rows G);
/* What is shared of a chunk's changes of volume (implicit_volume.h); NULL: the body shares none. */
const double *chunk_shared(const mpm *s, int blk, int body, size_t start);
/* The law at these gradients, from the state at the start of the increment; with changes of volume of their own where `shared` has
 * them. 0, or 1 + the first point beyond it. */
size_t chunk_law(const mpm *s, int blk, int body, size_t start, size_t end, gradient_rows G, const double *shared,
                 solid_batch *b);
/* FLOE_RETRY, with the point that is beyond its law. */
floe_status refuse_chunk(const mpm *s, int blk, int body, size_t point);
/* V0 T of point k of a batch whose stress is `less` (Pa) than the law's along the axes, at the components that the scene has. */
void chunk_point_force(const mpm *s, const solid_batch *b, size_t k, gradient_rows G, double less, double volume0,
                       double *out);
/* V (det f) f^-T of point k of a batch, V its volume at the start of the increment. */
void chunk_cofactor(const mpm *s, gradient_rows G, size_t k, double volume, double *out);
/* Mean stress (Pa) of point k of a batch along the axes that strain. */
double chunk_mean_stress(const mpm *s, const solid_batch *b, size_t k);
/* det(I + G) - 1, of which nothing is lost where G is small. */
double growth_of(const double G[9]);

#endif
