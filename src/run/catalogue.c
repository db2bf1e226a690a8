#include "run/catalogue.h"

#include "base/memory.h"
#include "mpm/basis/basis.h"
#include "mpm/normal/normal.h"
#include "mpm/transfer/transfer.h"
#include "verify/exact.h"
#include "verify/history_metric.h"
#include "verify/metric.h"

#include <math.h>
#include <string.h>

static const char *check_history_metric(const char *quantity, const scene *s)
{
    const reference_model *model = reference_find(s->verify.reference);
    if (!model) return "needs verify.reference";
    if (reference_quantity_find(model, quantity) == model->n_quantities) return "the reference has no such quantity";
    for (int i = 0; i < s->verify.n_columns; i++) {
        if (strcmp(s->verify.column[i].quantity, quantity) == 0) return NULL;
    }
    return "verify.history names no column for its quantity";
}

/* Only membranes have normals, and of a line only those in a plane; the angle is measured from an exact zero. */
static const char *check_normal(const metric *m, const scene *s)
{
    const scene_membrane *of = s->verify.body >= 0 ? &s->body[s->verify.body].membrane : NULL;
    const bool relative = m->kind == METRIC_L1REL || m->kind == METRIC_L2REL || m->kind == METRIC_LINFREL;
    if (!of || !of->present) return "needs verify.body: a membrane";
    if (of->surface.kind == SHEET_NONE && s->mesh.dim != 2) return "a line has normals in a plane alone";
    return m->quantity == EXACT_NORMAL && relative ? "the exact angle is 0; take l1, l2 or linf" : NULL;
}

/* NULL when the metric can be measured in the scene, "" when there is none of that name, else why it cannot be. */
static const char *check_metric(const char *name, const scene *s)
{
    metric m;
    const char *quantity;
    if (history_metric_parse(name, &quantity) != HISTORY_METRIC_COUNT) return check_history_metric(quantity, s);
    if (metric_parse(NULL, name, &m) != FLOE_OK) return "";
    const exact_model *model = exact_find(s->verify.exact);
    if (!model) return "needs verify.exact";
    if (m.kind == METRIC_EQ13) {
        if (!exact_param(model, s->verify.exact_par, "inner_radius") ||
            !exact_param(model, s->verify.exact_par, "outer_radius"))
            return "needs an exact solution with an inner and an outer radius";
        return isnan(s->verify.probe_pressure) ? "needs verify.pressure" : NULL;
    }
    if (!(model->provides & EXACT_BIT(m.quantity))) return "the exact solution does not give that quantity";
    return m.quantity >= EXACT_NORMAL_X ? check_normal(&m, s) : NULL;
}

static floe_status check_exact(context *ctx, const char *name, const void *par, int dim)
{
    const exact_model *model = exact_find(name);
    exact solution;
    if (!model) return fail_key(ctx, KEY("verify", "exact"), "there is no exact solution '%s'", name);
    TRY(exact_create(ctx, model, par, dim, &solution));
    exact_destroy(ctx, &solution);
    return FLOE_OK;
}

static floe_status check_reference(context *ctx, const char *name, const void *par)
{
    const reference_model *model = reference_find(name);
    reference r;
    if (!model) return fail_key(ctx, KEY("verify", "reference"), "there is no reference '%s'", name);
    TRY(reference_create(ctx, model, par, &r));
    reference_destroy(ctx, &r);
    return FLOE_OK;
}

static const char *reference_quantity_name(const char *name, size_t i)
{
    const reference_model *model = reference_find(name);
    return model && i < model->n_quantities ? model->quantities[i].name : NULL;
}

/* The catalogue and its lists, in one piece. */
typedef struct catalogue_box {
    deck_catalogue catalogue;          /* first: its address is that of the box */
    deck_exact *exact;                 /* owned */
    deck_history_reference *reference; /* owned */
    deck_name *basis;                  /* owned */
    deck_name *transfer;               /* owned */
    deck_name *normal;                 /* owned */
    deck_name metric[METRIC_COUNT + HISTORY_METRIC_COUNT];
} catalogue_box;

static floe_status fill_catalogue(catalogue_box *box, context *ctx)
{
    TRY(memory_new(ctx, &box->exact, exact_registry_size, sizeof *box->exact));
    TRY(memory_new(ctx, &box->reference, reference_registry_size, sizeof *box->reference));
    TRY(memory_new(ctx, &box->basis, basis_registry_size, sizeof *box->basis));
    TRY(memory_new(ctx, &box->transfer, transfer_registry_size, sizeof *box->transfer));
    TRY(memory_new(ctx, &box->normal, normal_registry_size, sizeof *box->normal));
    for (size_t i = 0; i < exact_registry_size; i++) {
        const exact_model *m = exact_registry[i];
        box->exact[i] =
            (deck_exact){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m->min_dim, m->max_dim};
    }
    for (size_t i = 0; i < reference_registry_size; i++) {
        const reference_model *m = reference_registry[i];
        box->reference[i] = (deck_history_reference){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size};
    }
    for (size_t i = 0; i < basis_registry_size; i++)
        box->basis[i] = (deck_name){basis_registry[i]->name, basis_registry[i]->doc};
    for (size_t i = 0; i < transfer_registry_size; i++)
        box->transfer[i] = (deck_name){transfer_registry[i]->name, transfer_registry[i]->doc};
    for (size_t i = 0; i < normal_registry_size; i++)
        box->normal[i] = (deck_name){normal_registry[i]->name, normal_registry[i]->doc};
    for (int i = 0; i < METRIC_COUNT; i++) {
        const metric_description d = metric_describe((metric_kind)i);
        box->metric[i] = (deck_name){d.name, d.doc};
    }
    for (int i = 0; i < HISTORY_METRIC_COUNT; i++) {
        const history_metric_kind kind = (history_metric_kind)i;
        box->metric[METRIC_COUNT + i] = (deck_name){history_metric_pattern(kind), history_metric_doc(kind)};
    }
    box->catalogue = (deck_catalogue){.exact = box->exact,
                                      .n_exact = exact_registry_size,
                                      .reference = box->reference,
                                      .n_reference = reference_registry_size,
                                      .basis = box->basis,
                                      .n_basis = basis_registry_size,
                                      .transfer = box->transfer,
                                      .n_transfer = transfer_registry_size,
                                      .normal = box->normal,
                                      .n_normal = normal_registry_size,
                                      .metric = box->metric,
                                      .n_metric = METRIC_COUNT + HISTORY_METRIC_COUNT,
                                      .check_metric = check_metric,
                                      .check_exact = check_exact,
                                      .check_reference = check_reference,
                                      .reference_quantity = reference_quantity_name};
    return FLOE_OK;
}

floe_status catalogue_create(deck_catalogue **out, context *ctx)
{
    catalogue_box *box;
    *out = NULL;
    TRY(memory_new(ctx, &box, 1, sizeof *box));
    const floe_status status = fill_catalogue(box, ctx);
    *out = &box->catalogue;
    if (status != FLOE_OK) catalogue_destroy(ctx, out);
    return status;
}

void catalogue_destroy(context *ctx, deck_catalogue **catalogue)
{
    if (!catalogue || !*catalogue) return;
    catalogue_box *box = (catalogue_box *)*catalogue;
    memory_free(ctx, &box->exact);
    memory_free(ctx, &box->reference);
    memory_free(ctx, &box->basis);
    memory_free(ctx, &box->transfer);
    memory_free(ctx, &box->normal);
    memory_free(ctx, &box);
    *catalogue = NULL;
}
