/* A catalogue for the tests of decks, from the real registries, and helpers that load a deck from text. */
#ifndef TESTS_DECK_COMMON_H
#define TESTS_DECK_COMMON_H

#include "check.h"

#include "base/memory.h"
#include "deck/deck.h"
#include "verify/exact.h"
#include "verify/metric.h"

#include <string.h>

enum { CATALOGUE_MOST = 64 };

typedef struct catalogue_store {
    deck_exact exact[CATALOGUE_MOST];
    deck_name metric[METRIC_COUNT], quantity[EXACT_QUANTITY_COUNT];
    deck_catalogue catalogue;
} catalogue_store;

static const deck_name test_normals[] = {{"colour", "colour function"}, {"mass", "gradient of mass"}};
static const deck_name test_bases[] = {{"linear", "hat functions"}, {"gimp", "GIMP"}, {"quadratic", "B-splines"}};

static floe_status test_check_exact(context *ctx, const char *name, const void *par, int dim)
{
    exact solution;
    TRY(exact_create(ctx, exact_find(name), par, dim, &solution));
    exact_destroy(ctx, &solution);
    return FLOE_OK;
}

static const char *test_check_metric(const char *name, const scene *s)
{
    metric parsed;
    if (metric_parse(NULL, name, &parsed) != FLOE_OK) return "";
    return parsed.kind == METRIC_EQ13 && !(s->verify.probe_pressure > 0.0) ? "needs verify.pressure" : NULL;
}

static void make_catalogue(catalogue_store *store)
{
    deck_catalogue *c = &store->catalogue;
    memset(store, 0, sizeof *store);
    for (size_t i = 0; i < exact_registry_size && i < CATALOGUE_MOST; i++) {
        const exact_model *m = exact_registry[i];
        store->exact[c->n_exact++] =
            (deck_exact){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m->min_dim, m->max_dim};
    }
    for (int i = 0; i < METRIC_COUNT; i++) {
        const metric_description d = metric_describe((metric_kind)i);
        store->metric[c->n_metric++] = (deck_name){d.name, d.doc};
    }
    for (int i = 0; i < EXACT_QUANTITY_COUNT; i++) {
        const exact_quantity q = (exact_quantity)i;
        store->quantity[c->n_quantity++] = (deck_name){exact_quantity_name(q), exact_quantity_doc(q)};
    }
    c->exact = store->exact;
    c->metric = store->metric;
    c->quantity = store->quantity;
    c->normal = test_normals;
    c->n_normal = sizeof test_normals / sizeof test_normals[0];
    c->basis = test_bases;
    c->n_basis = sizeof test_bases / sizeof test_bases[0];
    c->check_exact = test_check_exact;
    c->check_metric = test_check_metric;
}

#endif
