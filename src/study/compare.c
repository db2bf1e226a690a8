/* From a deck to the cases of a comparison, and through them. */
#include "study/compare.h"

#include "base/memory.h"
#include "study/axis_text.h"

#include <ctype.h>
#include <string.h>

/* A folder name: what a file system may not like becomes '_'. */
static void name_folder(const compare_case *one, char *folder, size_t size)
{
    const char *value = one->value;
    (void)snprintf(folder, size, "%s%s%s", coupling_name(one->coupling), value[0] ? "-" : "", value);
    for (char *c = folder; *c; c++) {
        if (!isalnum((unsigned char)*c) && !strchr("._-+", *c)) *c = '_';
    }
}

static floe_status fill_case(comparison *c, const compare_options *o, compare_case *one)
{
    batch_case *run = one->run;
    size_t n = 0;
    TRY(memory_new(c->ctx, &one->set, o->set.n + 2, sizeof *one->set));
    for (; n < o->set.n; n++) one->set[n] = o->set.text[n];
    (void)snprintf(one->coupling_set, sizeof one->coupling_set, "coupling=%s", coupling_name(one->coupling));
    one->set[n++] = one->coupling_set;
    (void)snprintf(one->axis_set, sizeof one->axis_set, "%s=%s", c->axis.key, one->value);
    if (one->value[0]) one->set[n++] = one->axis_set;
    run->set = one->set;
    run->n_set = n;
    name_folder(one, run->folder, sizeof run->folder);
    (void)snprintf(run->label, sizeof run->label, "%s%s%.100s", coupling_name(one->coupling), one->value[0] ? ", " : "",
                   one->value[0] ? one->axis_set : "");
    return FLOE_OK;
}

static floe_status make_cases(comparison *c, const compare_options *o, const scene *s)
{
    const int values = c->axis.n_values > 0 ? c->axis.n_values : 1;
    const int couplings = s->n_runs_as > 0 ? s->n_runs_as : 1;
    c->n = (size_t)values * (size_t)couplings;
    TRY(memory_new(c->ctx, &c->list, c->n, sizeof *c->list));
    TRY(memory_new(c->ctx, &c->run, c->n, sizeof *c->run));
    for (size_t i = 0; i < c->n; i++) {
        compare_case *one = &c->list[i];
        const size_t k = i / (size_t)values;
        one->run = &c->run[i];
        one->coupling = s->n_runs_as > 0 ? s->runs_as[k] : s->coupling;
        if (c->axis.n_values > 0)
            (void)snprintf(one->value, sizeof one->value, "%s", c->axis.value[i % (size_t)values]);
        TRY(fill_case(c, o, one));
    }
    return FLOE_OK;
}

static batch_options options_of(const compare_options *o)
{
    return (batch_options){.program = o->program,
                           .deck = o->deck,
                           .dir = o->dir,
                           .jobs = o->jobs,
                           .threads = o->threads,
                           .stop = o->stop,
                           .progress = o->progress};
}

/* Every case must make a scene before the first one runs. */
static floe_status check_case(comparison *c, const batch_options *o, compare_case *one)
{
    scene *s;
    TRY(batch_prepare(c->ctx, o, one->run, &s));
    one->h = s->mesh.cell[0];
    scene_destroy(&s);
    return FLOE_OK;
}

static floe_status take_scene(comparison *c, const compare_options *o, const scene *s)
{
    const batch_options batch = options_of(o);
    (void)snprintf(c->title, sizeof c->title, "%s", s->title);
    (void)snprintf(c->exact, sizeof c->exact, "%s", s->verify.exact);
    c->axis = s->compare;
    if (o->axis) TRY(axis_from_text(c->ctx, "--axis", o->axis, &c->axis));
    TRY(make_cases(c, o, s));
    for (size_t i = 0; i < c->n; i++) TRY(check_case(c, &batch, &c->list[i]));
    return FLOE_OK;
}

static floe_status make(comparison *c, const compare_options *o)
{
    const batch_options batch = options_of(o);
    batch_case whole = {.set = o->set.text, .n_set = o->set.n};
    scene *s;
    TRY(memory_string(c->ctx, &c->deck_path, o->deck));
    TRY(memory_string(c->ctx, &c->dir, o->dir));
    TRY(batch_prepare(c->ctx, &batch, &whole, &s));
    const floe_status status = take_scene(c, o, s);
    scene_destroy(&s);
    return status;
}

static floe_status carry_out(comparison *c, const compare_options *o)
{
    const batch_options batch = options_of(o);
    TRY(make(c, o));
    const floe_status status = batch_run(c->ctx, &batch, c->run, c->n);
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
    for (size_t i = 0; (*c)->list && i < (*c)->n; i++) memory_free(ctx, &(*c)->list[i].set);
    memory_free(ctx, &(*c)->deck_path);
    memory_free(ctx, &(*c)->dir);
    memory_free(ctx, &(*c)->list);
    memory_free(ctx, &(*c)->run);
    memory_free(ctx, c);
}
