#include "run/catalogue.h"

#include "base/memory.h"
#include "mpm/basis/basis.h"
#include "verify/exact.h"
#include "verify/metric.h"

#include <math.h>

/* NULL when the metric can be measured in the scene, "" when there is none of that name, else why it cannot be. */
static const char *check_metric(const char *name, const scene *s)
{
    metric m;
    if (metric_parse(NULL, name, &m) != FLOE_OK) return "";
    const exact_model *model = exact_find(s->verify.exact);
    if (!model) return NULL; /* that is another error */
    if (m.kind == METRIC_EQ13) {
        if (!exact_param(model, s->verify.exact_par, "inner_radius") ||
            !exact_param(model, s->verify.exact_par, "outer_radius"))
            return "needs an exact solution with an inner and an outer radius";
        return isnan(s->verify.probe_pressure) ? "needs verify.pressure" : NULL;
    }
    return model->provides & EXACT_BIT(m.quantity) ? NULL : "the exact solution does not give that quantity";
}

static floe_status check_exact(context *ctx, const char *name, const void *par, int dim)
{
    const exact_model *model = exact_find(name);
    exact solution;
    if (!model) return fail(ctx, FLOE_BAD_INPUT, "there is no exact solution '%s'", name);
    TRY(exact_create(ctx, model, par, dim, &solution));
    exact_destroy(ctx, &solution);
    return FLOE_OK;
}

/* The catalogue and its lists, in one piece. */
typedef struct catalogue_box {
    deck_catalogue catalogue; /* first: its address is that of the box */
    deck_exact *exact;        /* owned */
    deck_name *basis;         /* owned */
    deck_name metric[METRIC_COUNT];
} catalogue_box;

static floe_status fill(catalogue_box *box, context *ctx)
{
    TRY(memory_new(ctx, &box->exact, exact_registry_size, sizeof *box->exact));
    TRY(memory_new(ctx, &box->basis, basis_registry_size, sizeof *box->basis));
    for (size_t i = 0; i < exact_registry_size; i++) {
        const exact_model *m = exact_registry[i];
        box->exact[i] =
            (deck_exact){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m->min_dim, m->max_dim};
    }
    for (size_t i = 0; i < basis_registry_size; i++)
        box->basis[i] = (deck_name){basis_registry[i]->name, basis_registry[i]->doc};
    for (int i = 0; i < METRIC_COUNT; i++) {
        const metric_description d = metric_describe((metric_kind)i);
        box->metric[i] = (deck_name){d.name, d.doc};
    }
    box->catalogue = (deck_catalogue){.exact = box->exact,
                                      .n_exact = exact_registry_size,
                                      .basis = box->basis,
                                      .n_basis = basis_registry_size,
                                      .metric = box->metric,
                                      .n_metric = METRIC_COUNT,
                                      .check_metric = check_metric,
                                      .check_exact = check_exact};
    return FLOE_OK;
}

floe_status catalogue_create(deck_catalogue **out, context *ctx)
{
    catalogue_box *box;
    *out = NULL;
    TRY(memory_new(ctx, &box, 1, sizeof *box));
    const floe_status status = fill(box, ctx);
    *out = &box->catalogue;
    if (status != FLOE_OK) catalogue_destroy(ctx, out);
    return status;
}

void catalogue_destroy(context *ctx, deck_catalogue **catalogue)
{
    if (!catalogue || !*catalogue) return;
    catalogue_box *box = (catalogue_box *)*catalogue;
    memory_free(ctx, &box->exact);
    memory_free(ctx, &box->basis);
    memory_free(ctx, &box);
    *catalogue = NULL;
}
