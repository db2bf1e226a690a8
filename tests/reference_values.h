/* What tests ask of references: their scalars by name. */
#ifndef TESTS_REFERENCE_VALUES_H
#define TESTS_REFERENCE_VALUES_H

#include "verify/reference.h"

#include <math.h>
#include <string.h>

/* The scalar of that name; NAN if there is none. */
static inline double reference_scalar_value(const reference *r, const char *name)
{
    const reference_model *model = r->model;
    for (size_t i = 0; i < model->n_scalars; ++i)
        if (strcmp(model->scalars[i].name, name) == 0) return model->scalar(r->par, r->prepared, i);
    return (double)NAN;
}

#endif
