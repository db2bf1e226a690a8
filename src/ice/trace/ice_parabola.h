/* A quantity within a cell as a parabola with the cell's mean (theory 2.17; Colella and Woodward 1984). Only this folder includes it. */
#ifndef ICE_ICE_PARABOLA_H
#define ICE_ICE_PARABOLA_H

#include "ice/ice_constants.h"
#include "ice/ice_view.h"

#include <math.h>

/* Means of five cells, of which the parabola is that of the middle one. */
typedef struct ice_five {
    double q[5];
} ice_five;

/* Values at the lower and upper face. */
typedef struct ice_edges {
    double lower, upper;
} ice_edges;

/* The monotonised central difference of a cell: half the jump over two cells, at most twice either one; 0 at an extremum. */
FLOE_ALWAYS_INLINE double ice_limited_difference(double below, double above)
{
    const double most_size = least(0.5 * fabs(below + above), 2.0 * least(fabs(below), fabs(above)));
    return below * above > 0.0 ? copysign(most_size, below) : 0.0;
}

/* Edges that keep the parabola between its edges (eq. 1.10); the mean itself at an extremum. */
FLOE_ALWAYS_INLINE ice_edges ice_monotone(ice_edges e, double mean)
{
    const double jump = e.upper - e.lower, curve = 6.0 * (mean - 0.5 * (e.lower + e.upper));
    const bool flat = (e.upper - mean) * (mean - e.lower) <= 0.0, over = jump * curve > jump * jump,
               under = jump * curve < -jump * jump;
    const double lower = over ? 3.0 * mean - 2.0 * e.upper : e.lower,
                 upper = under ? 3.0 * mean - 2.0 * e.lower : e.upper;
    return (ice_edges){flat ? mean : lower, flat ? mean : upper};
}

/* Edges by the four cells about each face, with limited differences (eqs 1.6 to 1.8). */
FLOE_ALWAYS_INLINE ice_edges ice_parabola_edges(ice_five x)
{
    const double *q = x.q;
    const double below = ice_limited_difference(q[1] - q[0], q[2] - q[1]),
                 here = ice_limited_difference(q[2] - q[1], q[3] - q[2]),
                 above = ice_limited_difference(q[3] - q[2], q[4] - q[3]);
    const ice_edges e = {0.5 * (q[1] + q[2]) + (below - here) / 6.0, 0.5 * (q[2] + q[3]) + (here - above) / 6.0};
    return ice_monotone(e, q[2]);
}

/* Edges by the same four cells each, without limits. */
FLOE_ALWAYS_INLINE ice_edges ice_smooth_edges(ice_five x)
{
    const double *q = x.q;
    return (ice_edges){(7.0 * (q[1] + q[2]) - (q[0] + q[3])) / 12.0, (7.0 * (q[2] + q[3]) - (q[1] + q[4])) / 12.0};
}

/* Edges of the straight line with the central difference. */
FLOE_ALWAYS_INLINE ice_edges ice_line_edges(ice_five x)
{
    const double half = 0.25 * (x.q[3] - x.q[1]);
    return (ice_edges){x.q[2] - half, x.q[2] + half};
}

/* Towards others by a share. */
FLOE_ALWAYS_INLINE ice_edges ice_blend_edges(ice_edges e, double share, ice_edges other)
{
    return (ice_edges){e.lower + share * (other.lower - e.lower), e.upper + share * (other.upper - e.upper)};
}

/* Edges at a contact: those of the neighbours' lines (eqs 1.14, 1.15), by a share. */
FLOE_ALWAYS_INLINE ice_edges ice_steepen_edges(ice_edges e, double share, ice_five x)
{
    const double *q = x.q;
    const ice_edges steep = {q[1] + 0.5 * ice_limited_difference(q[1] - q[0], q[2] - q[1]),
                             q[3] - 0.5 * ice_limited_difference(q[3] - q[2], q[4] - q[3])};
    const ice_edges blended = ice_monotone(ice_blend_edges(e, share, steep), q[2]);
    return share > 0.0 ? blended : e;
}

/* Mean of the parabola over the share next to a face of the cell, which a wave of that Courant number brings to it in the step. A wave that
 * leaves the face is continued: of negative share the parabola is taken beyond it. */
FLOE_ALWAYS_INLINE double ice_mean_below_upper(ice_edges e, double mean, double share)
{
    const double jump = e.upper - e.lower, curve = 6.0 * (mean - 0.5 * (e.lower + e.upper));
    return e.upper - 0.5 * share * (jump - (1.0 - 2.0 / 3.0 * share) * curve);
}

FLOE_ALWAYS_INLINE double ice_mean_above_lower(ice_edges e, double mean, double share)
{
    const double jump = e.upper - e.lower, curve = 6.0 * (mean - 0.5 * (e.lower + e.upper));
    return e.lower + 0.5 * share * (jump + (1.0 - 2.0 / 3.0 * share) * curve);
}

#endif
