/* Systems of ordinary differential equations to tight tolerances, by CVODE's Adams methods. Only src/verify includes
 * this. */
#ifndef VERIFY_ODE_H
#define VERIFY_ODE_H

#include "base/context.h"

#include <stddef.h>

typedef struct ode {
    size_t n; /* unknowns */
    /* dy/dt at (t, y). */
    void (*rate)(double t, const double *y, double *dydt, void *user);
    /* Called with the solution at each time asked for, in order. */
    void (*take)(size_t i, double t, const double *y, void *user);
    void *user;
    double relative;        /* tolerance of a step, over |y| */
    const double *absolute; /* [n], in the unit of y */
} ode;

/* Solves from y at t = 0 to each of the n_times times t (ascending, >= 0). Errors: FLOE_NO_MEMORY; FLOE_BAD_INPUT with
 * the solver's words where it cannot go on. */
floe_status ode_solve(context *ctx, const ode *system, const double *y, size_t n_times, const double *t);

#endif
