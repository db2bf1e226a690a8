/* Decks with a membrane around gas of the cells, and what tells whether anything has happened or has passed. */
#ifndef TESTS_VERIFICATION_EMBEDDED_FIXTURE_H
#define TESTS_VERIFICATION_EMBEDDED_FIXTURE_H

#include "coupled_fixture.h"

FIXTURE void sealed_begin(trial *t, const char *deck, const char *const *set, size_t n)
{
    deck_begin(t, deck, set, n);
    check_ok(t->ctx, sim_create(&t->sim, t->ctx, t->scene, COUPLING_ICE_MPM));
}

/* Largest deviation of a cell field of a gas from a value, over the cells that hold any of it; of the others, from 0. */
typedef struct deviation {
    double inside, outside;
} deviation;

FIXTURE deviation deviation_of(const trial *t, field_id id, int gas, int component, double value)
{
    const size_t n = mesh_cells(&t->sim->mesh);
    double *x = malloc(n * sizeof *x), *open = malloc(n * sizeof *open);
    deviation out = {0.0, 0.0};
    assert_non_null(x);
    assert_non_null(open);
    gather_cells(t->sim, id, gas, component, 1, x);
    gather_cells(t->sim, C_OPEN, gas, 0, 1, open);
    for (size_t k = 0; k < n; ++k) {
        if (open[k] > 0.0)
            out.inside = fmax(out.inside, fabs(x[k] - value));
        else
            out.outside = fmax(out.outside, fabs(x[k]));
    }
    free(x);
    free(open);
    return out;
}

#endif
