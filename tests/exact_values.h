/* What tests ask of exact solutions: their parameters by default, and their scalars by name. */
#ifndef TESTS_EXACT_VALUES_H
#define TESTS_EXACT_VALUES_H

#include "verify/exact.h"

#include <math.h>
#include <string.h>

/* Fills par (model->param_size bytes) with the defaults of the table; NAN where a parameter is required. */
static inline void exact_fill_defaults(const exact_model *model, void *par)
{
    memset(par, 0, model->param_size);
    param_fill_defaults(model->params, model->n_params, par);
}

/* The scalar of that name; NAN if there is none. */
static inline double exact_scalar_value(const exact *solution, const char *name, double t)
{
    const exact_model *model = solution->model;
    for (size_t i = 0; i < model->n_scalars; ++i)
        if (strcmp(model->scalars[i].name, name) == 0) return model->scalar(solution->par, solution->prepared, i, t);
    return (double)NAN;
}

#endif
