/* Cases made ready as their runs would make them, and left at that. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "run/live_line.h"
#include "run/ready.h"
#include "scene/deck_location.h"
#include "scene/unsupported.h"

enum { TOLD_MOST = 5 /* cases that are warned of one by one */, LIVE_INTERVAL = 1, PLAIN_INTERVAL = 10 };

/* Cells that all cases may have together: beyond, only the first and the last are set up. */
static const double all_cells = 5e4;

typedef struct rehearsing {
    const study *s;
    study_rehearsal *out;
    live_line line;
    size_t told;
} rehearsing;

/* A case that cannot start is a result of its study; but one that the deck does not foresee is most likely a mistake. */
static void tell_refused_case(rehearsing *r, const study_case *one)
{
    const context *ctx = r->s->ctx;
    if (study_refusal_of(r->s, one)) {
        r->out->foreseen++;
        return;
    }
    r->out->refused++;
    if (r->told++ < TOLD_MOST)
        context_log(r->s->ctx, LOG_WARNING, "case %s of `floe %s` cannot start: %s", one->run->label,
                    r->s->options->name, context_message(ctx));
}

/* A case that is one of too many to be set up is at least asked for what its coupling cannot do. */
static floe_status rehearse_case(rehearsing *r, size_t i, bool all)
{
    const batch_options batch = study_batch_options(r->s);
    run_ready ready = {0};
    scene *of;
    if (live_line_is_due(&r->line)) {
        char text[LIVE_LINE_SIZE];
        (void)snprintf(text, sizeof text, "setting up case %zu of %zu: %s", i + 1, r->s->n, r->s->run[i].label);
        live_line_show(&r->line, text);
    }
    TRY(batch_prepare(r->s->ctx, &batch, &r->s->run[i], &of));
    const floe_status status = all ? run_make_ready(of, &ready, NULL, NULL)
                                   : scene_deck_location(of, scene_refuse_unsupported(of, of->coupling));
    scene_destroy(&of);
    if (ready.done) r->out->set_up++;
    if (status != FLOE_BAD_INPUT && status != FLOE_DIVERGED) return status;
    tell_refused_case(r, &r->s->list[i]);
    context_clear(r->s->ctx);
    return FLOE_OK;
}

static floe_status rehearse_study(study *s, study_rehearsal *out)
{
    rehearsing r = {.s = s, .out = out};
    floe_status status = FLOE_OK;
    double cells = 0.0;
    TRY(study_make_plan(s));
    for (size_t i = 0; i < s->n; i++) cells += s->list[i].cells;
    live_line_begin(&r.line, s->options->batch.progress, LIVE_INTERVAL, PLAIN_INTERVAL);
    out->cases = s->n;
    for (size_t i = 0; i < s->n && status == FLOE_OK; i++) {
        if (s->options->batch.stop && *s->options->batch.stop) status = fail(s->ctx, FLOE_INTERRUPTED, "stopped");
        if (status == FLOE_OK) status = rehearse_case(&r, i, cells <= all_cells || i == 0 || i + 1 == s->n);
    }
    live_line_clear(&r.line);
    if (status == FLOE_OK && r.told > TOLD_MOST)
        context_log(s->ctx, LOG_WARNING, "and %zu more cases", r.told - TOLD_MOST);
    return status;
}

floe_status study_rehearse(context *ctx, const study_options *options, study_rehearsal *out)
{
    study *s;
    *out = (study_rehearsal){0};
    TRY(memory_new(ctx, &s, 1, sizeof *s));
    s->ctx = ctx;
    s->options = options;
    const floe_status status = rehearse_study(s, out);
    study_destroy(&s);
    return status;
}
