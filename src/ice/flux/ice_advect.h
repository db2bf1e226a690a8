/* Only this folder includes it: the working storage of advection (ice_advect.c), its layout, and what is done beside the sweep (ice_advect_side.c). */
#ifndef ICE_ICE_ADVECT_H
#define ICE_ICE_ADVECT_H

#include "ice/flux/ice_flux.h"
#include "ice/ice_constants.h"

/* Advection of one material over slabs [first, last) of a block: layers of cells along its slowest axis. */
typedef struct ice_advect_job {
    const ice *s;
    const ice_view *v;
    int material, first, last;
    bool conserve;       /* theory 2.8 (iii) */
    double energy_floor; /* J/kg; -DBL_MAX where it must be evaluated cell by cell */
    double *buffer;      /* of the thread */
} ice_advect_job;

typedef struct ice_advect_result {
    int bad, guarded;
} ice_advect_result;

/* Indexed [dim - 1][multi]. */
typedef ice_advect_result ice_advect_slabs(const ice_advect_job *job);
extern ice_advect_slabs *const ice_advect_kernels[3][2];
/* Of a fluid whose faces are traced, [dim - 1]. */
extern ice_advect_slabs *const ice_advect_traced[3];

/* Mass-specific quantities: u, e, and v with several materials. */
enum { ADVECT_Q = 5 };
#define ADVECT_COUNT(dim, multi) ((dim) + 1 + ((multi) ? 1 : 0))

/* Rows of one slab each. Donor data of an axis: M, g, then N and H of each q. Fluxes: mass, each q, kinetic energy. */
typedef struct ice_advect_buffers {
    int dim;
    double *q[3][ADVECT_Q];                          /* centred values, ring of three slabs */
    double *along[MESH_MAX_DIM][2 * (ADVECT_Q + 1)]; /* donor data for faces inside the slab */
    double *across[2][2 * (ADVECT_Q + 1)];           /* for faces to the next slab, ring of two */
    double *flux[2][ADVECT_Q + 2];                   /* inside the slab, by axis */
    double *flux_across[2][ADVECT_Q + 2];            /* through the slab's lower face, ring of two */
    double *clip;                                    /* factor on what leaves small volume fractions */
    double *M[MESH_MAX_DIM], *g[MESH_MAX_DIM],
        *y[MESH_MAX_DIM]; /* what the quantities of a donor share (ice_advect.c) */
    double *fill, *rarest, *leans;
    double *none; /* zeros */
} ice_advect_buffers;

/* Slab index 0 of a slab in the linear index of the block, and the slab index of local cell (0, k) in it: in 3-D a slab is a
 * plane of rows k along axis 1. */
FLOE_ALWAYS_INLINE ptrdiff_t ice_slab_start(const block *b, const int dim, int slab)
{
    return dim == 1 ? 0 : (slab + MESH_GHOST) * b->stride[dim - 1];
}

FLOE_ALWAYS_INLINE ptrdiff_t ice_slab_row(const block *b, const int dim, int k)
{
    return MESH_GHOST + (dim == 3 ? (k + MESH_GHOST) * b->stride[1] : 0);
}

FLOE_ALWAYS_INLINE int ice_slab_first(const int dim, int ghost)
{
    return dim == 3 ? -ghost : 0;
}

FLOE_ALWAYS_INLINE int ice_slab_last(const block *b, const int dim, int ghost)
{
    return dim == 3 ? b->n[1] + ghost : 1;
}

/* The fluxes that change the cells of a row, by number: inside the slab by axis, through the slab's lower and upper faces; and the row's measures. */
typedef struct ice_row_flux {
    const double *inside[2][ADVECT_Q + 2], *below[ADVECT_Q + 2], *above[ADVECT_Q + 2];
    const double *lower0, *upper0;
    double inv_h[3], dt;
    ptrdiff_t stride1;
} ice_row_flux;

FLOE_ALWAYS_INLINE ice_row_flux ice_row_flux_of(const ice_advect_buffers *w, const ice_view *v, int slab)
{
    const int ring = (slab + 2) & 1;
    ice_row_flux q = {.lower0 = v->lower0, .upper0 = v->upper0, .dt = v->dt, .stride1 = v->b->stride[1]};
    for (int a = 0; a < MESH_MAX_DIM; ++a) q.inv_h[a] = v->inv_h[a];
    for (int f = 0; f < ADVECT_Q + 2; ++f) {
        q.inside[0][f] = w->flux[0][f];
        q.inside[1][f] = w->flux[1][f];
        q.below[f] = w->flux_across[ring][f];
        q.above[f] = w->flux_across[ring ^ 1][f];
    }
    return q;
}

/* dt times the divergence of flux number f, per volume, at slab index t of local cell i. */
FLOE_ALWAYS_INLINE double ice_flux_divergence(const ice_row_flux *q, int f, ptrdiff_t t, ptrdiff_t i, const int dim)
{
    double sum = q->upper0[i] * q->inside[0][f][t + 1] - q->lower0[i] * q->inside[0][f][t];
    if (dim == 3) sum += (q->inside[1][f][t + q->stride1] - q->inside[1][f][t]) * q->inv_h[1];
    if (dim > 1) sum += (q->above[f][t] - q->below[f][t]) * q->inv_h[dim - 1];
    return q->dt * sum;
}

/* Share of a cell's volume that leaves it in the step. */
FLOE_ALWAYS_INLINE double ice_outflow(const ice_view *v, const ice_fluid *m, ptrdiff_t at, ptrdiff_t i, const int dim)
{
    double out = most(m->fu[0][at + 1], 0.0) * v->upper0[i] + most(-m->fu[0][at], 0.0) * v->lower0[i];
    for (int a = 1; a < dim; ++a)
        out += (most(m->fu[a][at + v->b->stride[a]], 0.0) + most(-m->fu[a][at], 0.0)) * v->inv_h[a];
    return out * v->dt;
}

/* Division of a thread's buffer. */
void ice_advect_divide(ice_advect_buffers *w, double *buffer, const block *b, int dim, bool multi);
/* Outflow of a trace fraction (theta < 1e-6) is limited to its content. */
void ice_advect_clip(ice_advect_buffers *w, const ice_advect_job *job, int slab);
/* At interfaces between fluids (ice_interface_flux.c): donors of row k of a slab without gradients; and fluxes through the lower faces of the row,
 * normal to `axis`, that are of the pure state of their donor. */
void ice_advect_flatten(const ice_advect_buffers *w, const ice_advect_job *job, int slab, int k);
void ice_advect_sharpen(const ice_advect_job *job, int axis, int slab, int k, double *const *flux);
/* Fluxes through open sides of the domain, into the tiles. */
void ice_advect_tally_across(const ice_advect_buffers *w, const ice_advect_job *job, int slab);
void ice_advect_tally_along(const ice_advect_buffers *w, const ice_advect_job *job, int slab);
/* Counts bad and guarded cells of a row that was updated; the energy that guards made goes to the tiles. */
void ice_advect_check(const ice_advect_buffers *w, const ice_advect_job *job, int slab, int k,
                      ice_advect_result *result);

/* Clips the new velocity and energy of a trace fraction where they are quotients of round-off. */
void ice_clip_roundoff(const ice_fluid *m, ptrdiff_t at, int dim);

/* Its mass in the next state is not negative, or only by round-off of what its neighbours hold: less than is dropped anyway. */
static inline bool ice_mass_stands(const ice_fluid *m, ptrdiff_t at, bool multi)
{
    return m->rho1[at] >= 0.0 || (multi && m->rho1[at] * m->vl[at] > -ICE_LEAST_FRACTION);
}

#endif
