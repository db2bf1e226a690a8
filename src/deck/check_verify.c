/* Exact solution, metrics and probes against the rest of the scene. */
#include "deck/check.h"

#include <stdio.h>
#include <string.h>

static const char *metric_candidate(const void *user, size_t i)
{
    const deck_catalogue *catalogue = user;
    return i < catalogue->n_metric ? catalogue->metric[i].name : NULL;
}

static floe_status check_exact(reader *r)
{
    const deck_catalogue *catalogue = r->catalogue;
    const scene_verify *verify = &r->scene->verify;
    if (!catalogue || !catalogue->check_exact || !is_clean(r->root, PATH("verify", "exact"))) return FLOE_OK;
    const floe_status status = catalogue->check_exact(r->ctx, verify->exact, verify->exact_par, r->scene->mesh.dim);
    if (status != FLOE_BAD_INPUT) return status;
    char message[400];
    snprintf(message, sizeof message, "%s", context_message(r->ctx));
    context_clear(r->ctx);
    return bad_at(r, PATH("verify", "exact"), NULL, NULL, "%s", message);
}

static floe_status check_metrics(reader *r)
{
    const deck_catalogue *catalogue = r->catalogue;
    deck_node *list = node_path(r->root, PATH("verify", "metrics"));
    if (!catalogue || !catalogue->check_metric || !list || r->root->bad) return FLOE_OK;
    for (deck_node *item = list->first; item; item = item->next) {
        const char *why = catalogue->check_metric(item->text, r->scene);
        if (!why) continue;
        if (why[0] == '\0') {
            TRY(bad_name(r, item, false, "metric", metric_candidate, catalogue));
        } else {
            TRY(bad(r, item, NULL, "metric '%.60s': %s", item->text, why));
        }
    }
    return FLOE_OK;
}

static floe_status check_probes(reader *r)
{
    const scene *s = r->scene;
    if (!is_clean(r->root, PATH("domain"))) return FLOE_OK;
    for (int i = 0; i < s->n_probes; i++) {
        const scene_probe *probe = &s->probe[i];
        bool inside = true;
        for (int axis = 0; axis < s->mesh.dim; axis++) {
            const double x = probe->position[axis];
            inside = inside && x >= s->mesh.lower[axis] && x <= s->mesh.upper[axis];
        }
        if (inside || !is_clean(r->root, PATH("output", "probes", probe->name))) continue;
        TRY(bad_at(r, PATH("output", "probes", probe->name), "a place in the domain", NULL,
                   "probe '%s' lies outside the domain", probe->name));
    }
    return FLOE_OK;
}

floe_status check_verify(reader *r)
{
    TRY(check_exact(r));
    TRY(check_probes(r));
    return check_metrics(r);
}
