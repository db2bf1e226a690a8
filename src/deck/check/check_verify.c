/* Exact solution, metrics and probes against the rest of the scene. */
#include "deck/check/check.h"

#include <stdio.h>
#include <string.h>

static const char *listed_metric_name(const void *user, size_t i)
{
    const char *const *names = user;
    return names[i];
}

/* "l1_X" and "density": "l1_density"; a pattern without an X is a name already. */
static floe_status expand_metric_name(deck_arena *arena, const char **out, const char *pattern, const char *quantity)
{
    const size_t stem = strlen(pattern) - 1, size = stem + strlen(quantity) + 1;
    char *name;
    TRY(arena_new(arena, &name, size));
    snprintf(name, size, "%.*s%s", (int)stem, pattern, quantity);
    *out = name;
    return FLOE_OK;
}

static bool is_pattern(const char *name)
{
    const size_t length = strlen(name);
    return length > 2 && strcmp(name + length - 2, "_X") == 0;
}

/* Every metric's name, with a NULL at the end. */
static floe_status list_metrics(reader *r, const char ***names)
{
    const deck_catalogue *c = r->catalogue;
    const char **name;
    size_t n = 0;
    TRY(arena_new(r->arena, &name, (c->n_metric * (c->n_quantity + 1) + 1) * sizeof *name));
    for (size_t i = 0; i < c->n_metric; i++) {
        if (!is_pattern(c->metric[i].name)) {
            name[n++] = c->metric[i].name;
            continue;
        }
        for (size_t q = 0; q < c->n_quantity; q++) {
            TRY(expand_metric_name(r->arena, &name[n++], c->metric[i].name, c->quantity[q].name));
        }
    }
    *names = name;
    return FLOE_OK;
}

static bool is_listed(const char *const *names, const char *name)
{
    for (; *names; names++) {
        if (strcmp(*names, name) == 0) return true;
    }
    return false;
}

static floe_status check_exact(reader *r)
{
    const deck_catalogue *catalogue = r->catalogue;
    const scene_verify *verify = &r->scene->verify;
    if (!catalogue || !catalogue->check_exact || !is_clean(r->root, KEY("verify", "exact"))) return FLOE_OK;
    return take_refusal(r, catalogue->check_exact(r->ctx, verify->exact, verify->exact_par, r->scene->mesh.dim));
}

static floe_status check_reference(reader *r)
{
    const deck_catalogue *catalogue = r->catalogue;
    const scene_verify *verify = &r->scene->verify;
    if (!catalogue || !catalogue->check_reference || !is_clean(r->root, KEY("verify", "reference"))) return FLOE_OK;
    return take_refusal(r, catalogue->check_reference(r->ctx, verify->reference, verify->reference_par));
}

static floe_status check_metric(reader *r, const char **names, deck_node *item)
{
    const deck_catalogue *catalogue = r->catalogue;
    const char *why = is_listed(names, item->text) ? NULL : "";
    if (catalogue->check_metric) why = catalogue->check_metric(item->text, r->scene);
    if (!why) return FLOE_OK;
    if (why[0] == '\0') return bad_name(r, item, false, "metric", listed_metric_name, names);
    if (r->errors->count > 0) return FLOE_OK; /* it may be a consequence */
    return bad(r, item, NULL, "metric '%.60s': %s", item->text, why);
}

static floe_status check_metrics(reader *r)
{
    deck_node *list = node_path(r->root, KEY("verify", "metrics"));
    if (!r->catalogue || !list || list->bad) return FLOE_OK;
    const char **names;
    TRY(list_metrics(r, &names));
    for (deck_node *item = list->first; item; item = item->next) TRY(check_metric(r, names, item));
    return FLOE_OK;
}

static floe_status check_probes(reader *r)
{
    const scene *s = r->scene;
    if (!is_clean(r->root, KEY("domain"))) return FLOE_OK;
    for (int i = 0; i < s->n_probes; i++) {
        const scene_probe *probe = &s->probe[i];
        bool inside = true;
        for (int axis = 0; axis < s->mesh.dim; axis++) {
            const double x = probe->position[axis];
            inside = inside && x >= s->mesh.lower[axis] && x <= s->mesh.upper[axis];
        }
        if (inside || !is_clean(r->root, KEY("output", "probes", probe->name))) continue;
        TRY(bad_at(r, KEY("output", "probes", probe->name), "a place in the domain", NULL,
                   "probe '%s' lies outside the domain", probe->name));
    }
    return FLOE_OK;
}

static const char *candidate_axis_name(const void *user, size_t i)
{
    const scene_study *study = user;
    return i < (size_t)study->n_axes ? study->axis[i].key : NULL;
}

static bool is_axis(const scene_study *study, const char *key)
{
    for (int i = 0; i < study->n_axes; i++) {
        if (strcmp(study->axis[i].key, key) == 0) return true;
    }
    return false;
}

/* Names of axes, where the deck has axes: the command line may bring others. */
static floe_status check_study(reader *r)
{
    const scene_study *study = &r->scene->batches->study;
    deck_node *over = node_path(r->root, KEY("study", "over"));
    deck_node *bars = node_path(r->root, KEY("study", "require"));
    if (study->n_axes == 0) return FLOE_OK;
    if (over && !is_axis(study, study->over)) TRY(bad_name(r, over, false, "axis", candidate_axis_name, study));
    for (deck_node *bar = bars ? bars->first : NULL; bar; bar = bar->next) {
        const deck_node *where = node_find(bar, "where");
        for (deck_node *item = where ? where->first : NULL; item; item = item->next) {
            if (!is_axis(study, item->key)) TRY(bad_name(r, item, true, "axis", candidate_axis_name, study));
        }
    }
    return FLOE_OK;
}

floe_status check_verify(reader *r)
{
    TRY(check_study(r));
    TRY(check_exact(r));
    TRY(check_reference(r));
    TRY(check_probes(r));
    return check_metrics(r);
}
