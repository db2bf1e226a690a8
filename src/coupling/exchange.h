/* Momentum and heat exchange between the materials of one cell or face, implicit in time (theory 2.2, 2.9).
 *
 * Materials r with masses m_r and values u_r are pulled together by a symmetric graph Laplacian,
 *     m_r (u_r' - u_r) = sum_s a_rs (u_s' - u_r'),    a_rs = dt V theta_r theta_s K_rs >= 0,
 * which is solved for the deviations from the common centre of mass, so that the sum of m u is kept to round-off for any
 * strength of the coupling. Serves faces (normal component), cells (all components) and temperatures. */
#ifndef COUPLING_EXCHANGE_H
#define COUPLING_EXCHANGE_H

#include "coupling/coupling_constants.h"

#include <stdbool.h>
#include <stddef.h>

enum { EXCHANGE_MAX = 16 };

/* Coefficients of all pairs; symmetric, diagonals unused. */
typedef struct exchange_table {
    int n;
    double K[EXCHANGE_MAX][EXCHANGE_MAX];  /* kg/(m3 s), momentum; of pairs that slip, along the normal */
    double Kt[EXCHANGE_MAX][EXCHANGE_MAX]; /* kg/(m3 s), momentum across the normal */
    double R[EXCHANGE_MAX][EXCHANGE_MAX];  /* W/(m3 K), heat */
} exchange_table;

typedef double exchange_matrix[EXCHANGE_MAX][EXCHANGE_MAX];

/* a_rs = factor theta_r theta_s coefficient_rs, for r != s. `factor` is dt at a face, dt V in a cell. */
void exchange_couple(int n, exchange_matrix coefficient, const double *theta, double factor, exchange_matrix a);

/* Relaxes `columns` sets of values, value[column][material], in place.
 * mass: m_r >= 0. 0: absent, receives the mean of the others, weighted by mass. INFINITY: prescribed, keeps its value.
 * Couplings beyond 1e12 of the largest finite mass are cut to that: they are rigid already. */
void exchange_relax(int n, const double *mass, exchange_matrix a, int columns, double value[][EXCHANGE_MAX]);

/* The same for pairs with different coefficients. A trace material, with a negligible share of the cell's volume and
 * mass, follows the others and transmits no force between them (trace.c). theta: volume fractions. */
void exchange_relax_parts(int n, const double *mass, const double *theta, exchange_matrix a, int columns,
                          double value[][EXCHANGE_MAX]);

/* Momentum where pairs slip (theory 2.9): couplings `a` act along the unit vector `normal`, `tangential` across it. u[axis][material].
 * unlike: pairs differ along the normal too. */
void exchange_relax_frame(int n, const double *mass, const double *theta, bool unlike, exchange_matrix a,
                          exchange_matrix tangential, int dim, const double *normal, double u[3][EXCHANGE_MAX]);

/* Two free, present materials in closed form: the difference of their values decays, the centre of mass stays. */
typedef struct exchange_two {
    double share0, share1; /* of the mass */
    double kept;           /* of the difference */
} exchange_two;

/* Masses m0, m1 > 0, coupling a = a_01. */
static inline exchange_two exchange_of_two(double m0, double m1, double a)
{
    const double total = m0 + m1, largest = m0 > m1 ? m0 : m1,
                 cut = a < EXCHANGE_RIGID * largest ? a : EXCHANGE_RIGID * largest;
    const double inverse = 1.0 / total, product = m0 * m1;
    return (exchange_two){m0 * inverse, m1 * inverse, product / (product + cut * total)};
}

static inline void exchange_relax_two(exchange_two x, double *u0, double *u1)
{
    const double centre = x.share0 * *u0 + x.share1 * *u1, difference = x.kept * (*u0 - *u1);
    *u0 = centre + x.share1 * difference;
    *u1 = centre - x.share0 * difference;
}

/* The same for one pair of values. */
static inline void exchange_relax_pair(double m0, double m1, double a, double *u0, double *u1)
{
    exchange_relax_two(exchange_of_two(m0, m1, a), u0, u1);
}

#endif
