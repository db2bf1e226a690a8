/* Parameters of a model at its sample, with some of them changed by key. */
#ifndef TESTS_UNIT_SETTINGS_H
#define TESTS_UNIT_SETTINGS_H

#include "check.h"

#include "base/param.h"

#include <string.h>

typedef struct setting {
    const char *key;
    double value;
} setting;

enum { SETTINGS_MOST = 32 }; /* doubles of a parameter struct */

/* The end of a list of settings; a list of some; an empty one. */
#define END       \
    {             \
        NULL, 0.0 \
    }
#define SET(...) ((const setting[]){__VA_ARGS__, END})
#define NONE ((const setting[]){END})

/* Copies `size` bytes of the sample and applies the settings. */
static inline void settings_apply(double par[SETTINGS_MOST], const void *sample, size_t size, const param_spec *specs,
                                  size_t n, const setting *change)
{
    check_true(size <= SETTINGS_MOST * sizeof par[0]);
    memcpy(par, sample, size);
    for (; change->key != NULL; change++) {
        double *to = param_find(specs, n, par, change->key);
        check_true(to != NULL);
        *to = change->value;
    }
}

#endif
