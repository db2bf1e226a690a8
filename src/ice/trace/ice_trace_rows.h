/* Only this folder includes it: a row of cells while its faces' states are found, in a thread's storage. */
#ifndef ICE_ICE_TRACE_ROWS_H
#define ICE_ICE_TRACE_ROWS_H

#include "ice/state/ice_traced.h"
#include "ice/trace/ice_trace.h"

/* Waves along an axis, as they are limited: those of sound that run up and down, entropy, energy that pressure does not account for, and the velocities
 * across. */
enum { WAVE_UP, WAVE_DOWN, WAVE_ENTROPY, WAVE_ENERGY, WAVE_ACROSS, WAVES = WAVE_ACROSS + 2 };

/* Differences over a cell along an axis, of the flattened parabolas. */
enum { SLOPE_DENSITY, SLOPE_PRESSURE, SLOPE_ENERGY, SLOPE_VELOCITY, SLOPES = SLOPE_VELOCITY + 3 };

/* State at one face of each cell at half the step, and further values of the cell for the Riemann problem. */
enum {
    STATE_DENSITY,
    STATE_PRESSURE,
    STATE_ENERGY,
    STATE_EARLY,
    STATE_MACH,
    STATE_DILATATION,
    STATE_VELOCITY,
    STATE_SOUND = STATE_VELOCITY + 3, /* where fluids share cells; as the next two */
    STATE_IMPEDANCE,
    STATE_CONTRAST,
    STATES
};

/* Rows of cells -1 to n, each at index 1 + i. */
typedef struct trace_row {
    double *lower[3][WAVES], *upper[3][WAVES]; /* edges by axis, at the start of the step */
    double *slope[3][SLOPES];
    double *mach, *dilatation; /* |u|/c; share of div u in the velocity's gradient, 0 to 1 */
    double *contrast;          /* 0 to 1: at the interface of a liquid and a gas */
    double *below[STATES];     /* at the lower face of the axis in hand */
    double *above[STATES];     /* at the upper face, while faces along the row are found */
} trace_row;

/* Doubles of such a row. */
static inline size_t trace_row_length(const block *b)
{
    return ((size_t)b->n[0] + 2 + 7) / 8 * 8;
}

/* A thread's storage: the row in hand, and upper states of the rows before it along the other axes, one or a slab of them. */
typedef struct trace_store {
    trace_row row;
    double *kept[3][STATES]; /* along axes 1 and 2 */
    size_t length;           /* of a row */
} trace_store;

/* Sweeps slabs [first, last) of a block, layers of cells across its slowest axis, and finds their lower faces; and the last upper ones where `end`. */
typedef struct trace_job {
    const ice_view *v;
    int fluid;     /* of a region of one */
    bool shares;   /* cells of several fluids are traced too */
    double uneven; /* 1: cells bear weight where it lies in them (ice_lean.h); 0: evenly */
    int first, last;
    bool end;
    double *buffer;
} trace_job;

typedef void trace_slabs(const trace_job *job);
/* [dim - 1][whether a fluid is viscous, conducts, or is driven]; of regions of one fluid, and of several. */
extern trace_slabs *const ice_trace_kernels[3][2], *const ice_trace_several_kernels[3][2];

#endif
