/* The equilibrium pressure of a mixed cell: the p at which its materials fill it (theory 2.1; Guilkey et al. 2003, eq. 4),
 *     F(p) = sum_r a_r v_r(p) - 1 = 0,    a_r = m_r / V (m_r / TMV with materials carried by points),
 * v_r(p) = v_r(p, T_r) with T_r frozen, or along an isentrope.
 *
 * F decreases with p. Newton's method is applied to (p + s) F(p), s = -(largest pressure floor of the materials), which is linear for an ideal gas beside an
 * incompressible material. The solver is GSL's (gsl_root_fdfsolver_newton), one cell after the other, and GSL's tests of residual and interval decide
 * convergence. One step is taken first for all cells side by side, so that the laws are evaluated in batches; most cells need no other. The signs of F give a
 * bracket, outside of which no law is evaluated: where a step leaves a wide bracket, the next start is its geometric mean; in a narrow one Brent's method
 * (gsl_root_fsolver_brent) finishes the search. The result of a cell does not depend on the other cells. */
#ifndef COUPLING_EQUILIBRIUM_H
#define COUPLING_EQUILIBRIUM_H

#include "base/context.h"
#include "coupling/isentrope.h"

#include <stdbool.h>

enum { EQUILIBRIUM_MAX = 16, EQUILIBRIUM_BATCH = 64 };

/* Mixed cells of one list of materials, side by side: value[cell], value[material][cell]. In a cell, materials with a = 0 are left out; their v is
 * without meaning. */
typedef struct equilibrium_batch {
    int n; /* materials */
    const eos *eos[EQUILIBRIUM_MAX];
    const isentrope *path[EQUILIBRIUM_MAX];       /* of each cell, exponent 0 where T is frozen; NULL: it is in all */
    double a[EQUILIBRIUM_MAX][EQUILIBRIUM_BATCH]; /* kg/m3 */
    double T[EQUILIBRIUM_MAX][EQUILIBRIUM_BATCH]; /* K */
    double p[EQUILIBRIUM_BATCH];                  /* Pa: guess in, pressure out */
    double v[EQUILIBRIUM_MAX][EQUILIBRIUM_BATCH]; /* m3/kg at p, out */
    double residual[EQUILIBRIUM_BATCH];           /* F(p), out */
    int iterations[EQUILIBRIUM_BATCH];            /* out */
    int fallbacks[EQUILIBRIUM_BATCH];             /* steps of Newton's that left the bracket, out */
    bool solved[EQUILIBRIUM_BATCH];               /* out */
} equilibrium_batch;

/* Solves the first `cells` <= EQUILIBRIUM_BATCH cells of a batch. FLOE_RETRY, without a message of its own (the caller knows the cells), when 200
 * iterations do not do for some: the last iterate is in those that are not solved. */
floe_status equilibrium_solve(equilibrium_batch *b, int cells);

#endif
