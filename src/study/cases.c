#include "study/cases.h"

#include "base/memory.h"
#include "run/catalogue.h"

#include <math.h>
#include <string.h>

floe_status case_set_make(case_set *set, const comparison *c, const compare_options *o, const compare_case *one)
{
    *set = (case_set){0};
    TRY(memory_new(c->ctx, &set->text, o->set.n + 2, sizeof *set->text));
    for (size_t i = 0; i < o->set.n; i++) set->text[set->n++] = o->set.text[i];
    (void)snprintf(set->coupling, sizeof set->coupling, "coupling=%s", coupling_name(one->coupling));
    set->text[set->n++] = set->coupling;
    if (!one->value[0]) return FLOE_OK;
    (void)snprintf(set->axis, sizeof set->axis, "%s=%s", c->axis.key, one->value);
    set->text[set->n++] = set->axis;
    return FLOE_OK;
}

void case_set_free(context *ctx, case_set *set)
{
    memory_free(ctx, &set->text);
}

void case_path(const comparison *c, const compare_case *one, char path[COMPARE_PATH])
{
    (void)snprintf(path, COMPARE_PATH, "%s/%s", c->dir, one->folder);
}

void case_label(const comparison *c, size_t i, char label[160])
{
    const compare_case *one = &c->list[i];
    (void)snprintf(label, 160, "[%zu/%zu] %s%s%.40s%s%.40s", i + 1, c->n, coupling_name(one->coupling),
                   one->value[0] ? ", " : "", one->value[0] ? c->axis.key : "", one->value[0] ? "=" : "", one->value);
}

void case_report(const comparison *c, const compare_options *o, size_t i)
{
    const compare_case *one = &c->list[i];
    char label[160];
    if (!o->progress) return;
    case_label(c, i, label);
    (void)fprintf(o->progress, "%s: %s, %lld steps, %.3g s", label, one->summary.status, one->summary.steps,
                  one->summary.wall_seconds);
    for (int k = 0; k < one->summary.n_errors && k < 1; k++) {
        const char *name = one->summary.errors[k].name;
        (void)fprintf(o->progress, ", %s %.4g%s%s", name,
                      one->summary.errors[k].value * (compare_is_relative(name) ? 100.0 : 1.0),
                      compare_unit(name)[0] ? " " : "", compare_unit(name));
    }
    (void)fprintf(o->progress, "%s%s\n", one->message[0] ? ": " : "", one->message);
}

static floe_status run_scene_of(comparison *c, const compare_options *o, size_t i, scene *s)
{
    compare_case *one = &c->list[i];
    char path[COMPARE_PATH], label[160];
    case_path(c, one, path);
    case_label(c, i, label);
    const run_options run = {.dir = path,
                             .stop = o->stop,
                             .threads = o->threads > 0 ? o->threads : 1,
                             .progress = o->progress,
                             .label = label,
                             .sink = o->sink,
                             .sink_user = o->sink_user,
                             .sink_detail = LOG_WARNING};
    one->status = run_scene(c->ctx, s, &run, &one->summary);
    one->ran = true;
    (void)snprintf(one->message, sizeof one->message, "%.500s", context_message(c->ctx));
    return one->status;
}

static floe_status load_and_run(comparison *c, const compare_options *o, size_t i)
{
    deck_catalogue *catalogue;
    deck_report report = {0};
    case_set set;
    scene *s = NULL;
    TRY(catalogue_create(&catalogue, c->ctx));
    floe_status status = case_set_make(&set, c, o, &c->list[i]);
    if (status == FLOE_OK)
        status = deck_load(&s, c->ctx, o->deck, &(deck_overrides){set.text, set.n}, catalogue, &report);
    deck_report_free(&report);
    catalogue_destroy(c->ctx, &catalogue);
    if (status == FLOE_OK) status = run_scene_of(c, o, i, s);
    case_set_free(c->ctx, &set);
    scene_destroy(&s);
    return status;
}

/* What one case may do without ending the comparison. */
static bool is_result(floe_status status)
{
    return status == FLOE_OK || status == FLOE_DIVERGED;
}

floe_status cases_run_here(comparison *c, const compare_options *o)
{
    for (size_t i = 0; i < c->n; i++) {
        const floe_status status = load_and_run(c, o, i);
        if (c->list[i].ran) case_report(c, o, i);
        if (!is_result(status)) return status;
        context_clear(c->ctx);
    }
    return FLOE_OK;
}
