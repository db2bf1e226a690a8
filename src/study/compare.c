/* From a deck to the cases of a comparison, and through them. */
#include "study/compare.h"

#include "base/memory.h"
#include "io/file.h"
#include "run/catalogue.h"
#include "study/cases.h"

#include <ctype.h>
#include <string.h>

/* Loads the deck with settings; errors go to the message. */
static floe_status load(context *ctx, const char *path, const deck_overrides *set, scene **out)
{
    deck_catalogue *catalogue;
    deck_report report = {0};
    *out = NULL;
    TRY(catalogue_create(&catalogue, ctx));
    floe_status status = deck_load(out, ctx, path, set, catalogue, &report);
    if (status == FLOE_BAD_INPUT && report.text) {
        context_clear(ctx);
        status = fail(ctx, FLOE_BAD_INPUT, "%s", report.text);
    }
    deck_report_free(&report);
    catalogue_destroy(ctx, &catalogue);
    return status;
}

static floe_status bad_axis(context *ctx, const char *text)
{
    return fail(ctx, FLOE_BAD_INPUT, "--axis takes KEY=V1,V2,... with at most %d values, not '%s'", SCENE_MAX_AXIS,
                text);
}

/* "KEY=V1,V2,..." */
static floe_status parse_axis(context *ctx, const char *text, scene_axis *axis)
{
    const char *at = strchr(text, '=');
    *axis = (scene_axis){0};
    if (!at || at == text || (size_t)(at - text) >= sizeof axis->key) return bad_axis(ctx, text);
    (void)snprintf(axis->key, sizeof axis->key, "%.*s", (int)(at - text), text);
    do {
        at++;
        const size_t length = strcspn(at, ",");
        if (length == 0 || length >= sizeof axis->value[0] || axis->n_values == SCENE_MAX_AXIS)
            return bad_axis(ctx, text);
        (void)snprintf(axis->value[axis->n_values++], sizeof axis->value[0], "%.*s", (int)length, at);
        at += length;
    } while (*at == ',');
    return FLOE_OK;
}

/* A folder name: what a file system may not like becomes '_'. */
static void name_folder(compare_case *one)
{
    const char *value = one->value;
    (void)snprintf(one->folder, sizeof one->folder, "%s%s%s", coupling_name(one->coupling), value[0] ? "-" : "", value);
    for (char *c = one->folder; *c; c++) {
        if (!isalnum((unsigned char)*c) && !strchr("._-+", *c)) *c = '_';
    }
}

static floe_status make_cases(comparison *c, const scene *s)
{
    const int values = c->axis.n_values > 0 ? c->axis.n_values : 1;
    const int couplings = s->n_runs_as > 0 ? s->n_runs_as : 1;
    c->n = (size_t)values * (size_t)couplings;
    TRY(memory_new(c->ctx, &c->list, c->n, sizeof *c->list));
    for (size_t i = 0; i < c->n; i++) {
        compare_case *one = &c->list[i];
        const size_t k = i / (size_t)values;
        one->coupling = s->n_runs_as > 0 ? s->runs_as[k] : s->coupling;
        if (c->axis.n_values > 0)
            (void)snprintf(one->value, sizeof one->value, "%s", c->axis.value[i % (size_t)values]);
        name_folder(one);
    }
    return FLOE_OK;
}

/* Every case must make a scene before the first one runs. */
static floe_status check_case(comparison *c, const compare_options *o, compare_case *one)
{
    case_set set;
    scene *s;
    TRY(case_set_make(&set, c, o, one));
    const floe_status status = load(c->ctx, o->deck, &(deck_overrides){set.text, set.n}, &s);
    case_set_free(c->ctx, &set);
    TRY(status);
    one->h = s->mesh.cell[0];
    scene_destroy(&s);
    return FLOE_OK;
}

static floe_status take_scene(comparison *c, const compare_options *o, const scene *s)
{
    (void)snprintf(c->title, sizeof c->title, "%s", s->title);
    (void)snprintf(c->exact, sizeof c->exact, "%s", s->verify.exact);
    c->axis = s->compare;
    if (o->axis) TRY(parse_axis(c->ctx, o->axis, &c->axis));
    TRY(make_cases(c, s));
    for (size_t i = 0; i < c->n; i++) TRY(check_case(c, o, &c->list[i]));
    return FLOE_OK;
}

static floe_status make(comparison *c, const compare_options *o)
{
    scene *s;
    TRY(memory_string(c->ctx, &c->deck_path, o->deck));
    TRY(memory_string(c->ctx, &c->dir, o->dir));
    TRY(load(c->ctx, o->deck, &o->set, &s));
    const floe_status status = take_scene(c, o, s);
    scene_destroy(&s);
    return status;
}

static floe_status carry_out(comparison *c, const compare_options *o)
{
    TRY(make(c, o));
    TRY(folder_make(c->ctx, c->dir));
    const floe_status status = o->jobs > 1 ? cases_run_as_jobs(c, o) : cases_run_here(c, o);
    if (status != FLOE_OK && status != FLOE_INTERRUPTED) return status;
    TRY(compare_write(c));
    TRY(compare_plot(c));
    if (status == FLOE_OK) return FLOE_OK;
    context_clear(c->ctx);
    return fail(c->ctx, FLOE_INTERRUPTED, "stopped; the cases that are done stand in '%s'", c->dir);
}

floe_status compare_run(comparison **out, context *ctx, const compare_options *options)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    return carry_out(*out, options);
}

void compare_destroy(comparison **c)
{
    if (!c || !*c) return;
    context *ctx = (*c)->ctx;
    memory_free(ctx, &(*c)->deck_path);
    memory_free(ctx, &(*c)->dir);
    memory_free(ctx, &(*c)->list);
    memory_free(ctx, c);
}
