/* From values to runs, and from runs to verdicts. */
#include "study/stability/stability_internal.h"

#include "base/memory.h"
#include "base/text.h"
#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

batch_options stability_batch(const stability *s, const stability_options *o)
{
    batch_options batch = o->batch;
    batch.dir = s->dir;
    batch.keep_finished = true;
    return batch;
}

/* The text of the wish's value of an axis. */
static void wish_value(const stability *s, const stability_wish *wish, int axis, char *text, size_t size)
{
    if (stability_is_map(s))
        (void)snprintf(text, size, "%s", s->over[axis].value[wish->value[axis]]);
    else
        (void)snprintf(text, size, "%.9g%s", wish->x, s->unit);
}

static void name_folder(const stability *s, const stability_wish *wish, char folder[256])
{
    if (stability_is_map(s))
        (void)snprintf(folder, 256, "%02zu-%02d-%02d", wish->set + 1, wish->value[0] + 1, wish->value[1] + 1);
    else
        (void)snprintf(folder, 256, "%02zu-%.9g", wish->set + 1, wish->x);
}

/* Settings go from the outside in: the user's, those of the combination, the value. */
static floe_status make_case(const stability *s, const stability_options *o, const stability_wish *wish,
                             case_settings *settings, batch_case *one)
{
    char value[SCENE_VALUE], label[STABILITY_LABEL];
    TRY(case_settings_make(settings, s->ctx, &o->set, (size_t)(s->n_each + s->n_over)));
    stability_set_label(s, wish->set, label);
    for (int i = 0; i < s->n_each; i++) case_settings_pick(settings, &s->each[i], s->set[wish->set].value[i]);
    for (int i = 0; i < s->n_over; i++) {
        wish_value(s, wish, i, value, sizeof value);
        case_settings_put(settings, s->over[i].key, value);
        text_add(label, sizeof label, "%s%s=%s", label[0] ? ", " : "", s->over[i].key, value);
    }
    *one = (batch_case){.set = settings->set, .n_set = settings->n};
    (void)snprintf(one->label, sizeof one->label, "%.159s", label);
    name_folder(s, wish, one->folder);
    return FLOE_OK;
}

floe_status stability_cases_make(stability_cases *cases, const stability *s, const stability_options *o,
                                 const stability_wish *wish, size_t n)
{
    *cases = (stability_cases){0};
    TRY(memory_new(s->ctx, &cases->list, n, sizeof *cases->list));
    TRY(memory_new(s->ctx, &cases->settings, n, sizeof *cases->settings));
    for (cases->n = 0; cases->n < n; cases->n++)
        TRY(make_case(s, o, &wish[cases->n], &cases->settings[cases->n], &cases->list[cases->n]));
    return FLOE_OK;
}

void stability_cases_free(context *ctx, stability_cases *cases)
{
    for (size_t i = 0; i < cases->n; i++) case_settings_free(&cases->settings[i], ctx);
    memory_free(ctx, &cases->settings);
    memory_free(ctx, &cases->list);
}

/* The energies of a run; a run that has ended before its first row has none. */
static floe_status read_energy(const stability *s, const batch_case *one, energy_record *energy)
{
    char path[BATCH_PATH];
    csv_table history;
    (void)snprintf(path, sizeof path, "%s/%s/history.csv", s->dir, one->folder);
    *energy = (energy_record){.finite = true};
    if (!file_exists(path)) return FLOE_OK;
    const floe_status status = csv_read(&history, s->ctx, path);
    if (status == FLOE_OK) *energy = energy_read(&history);
    csv_free(&history);
    return status;
}

static void judge_case(const stability *s, const batch_case *one, stability_probe *p)
{
    if (one->status == FLOE_DIVERGED) {
        p->verdict = VERDICT_DIVERGED;
        (void)snprintf(p->cause, sizeof p->cause, "%s", one->message);
    } else if (one->status != FLOE_OK) {
        p->verdict = VERDICT_NONE;
        (void)snprintf(p->cause, sizeof p->cause, "%s", one->message[0] ? one->message : status_text(one->status));
    } else if (!p->energy.finite) {
        p->verdict = VERDICT_NOT_FINITE;
        (void)snprintf(p->cause, sizeof p->cause, "an energy in history.csv is not finite");
    } else if (s->by_energy && p->energy.ratio > s->growth) {
        p->verdict = VERDICT_GROWS;
        (void)snprintf(p->cause, sizeof p->cause, "%.3g times the energy that can be there%s", p->energy.ratio,
                       p->rejected > 0 ? ", and steps were rejected" : "");
    } else if (p->rejected > 0) {
        p->verdict = VERDICT_REJECTED;
        (void)snprintf(p->cause, sizeof p->cause, "steps rejected: %lld", p->rejected);
    }
}

static search_answer answer_of(const stability_probe *p, const batch_case *one)
{
    if (one->status == FLOE_BAD_INPUT) return SEARCH_REFUSED;
    return p->verdict == VERDICT_STABLE ? SEARCH_STABLE : SEARCH_UNSTABLE;
}

static floe_status note_case(stability *s, const stability_wish *wish, const batch_case *one)
{
    stability_probe *p = &s->probe[s->n_probes];
    *p = (stability_probe){.set = wish->set, .steps = one->summary.steps, .rejected = one->summary.rejected_steps};
    p->time = one->summary.time;
    (void)snprintf(p->folder, sizeof p->folder, "%s", one->folder);
    for (int i = 0; i < s->n_over; i++) {
        char *end;
        wish_value(s, wish, i, p->value[i], sizeof p->value[i]);
        p->x[i] = strtod(p->value[i], &end);
        if (end == p->value[i]) p->x[i] = NAN;
    }
    if (one->ran) TRY(read_energy(s, one, &p->energy));
    judge_case(s, one, p);
    s->n_probes++;
    if (stability_is_map(s)) return FLOE_OK;
    stability_set *set = &s->set[wish->set];
    if (p->verdict == VERDICT_NONE && one->status != FLOE_BAD_INPUT)
        set->broken = true;
    else
        search_tell(&set->search, wish->x, answer_of(p, one));
    return FLOE_OK;
}

static floe_status run_cases(stability *s, const stability_options *o, const stability_wish *wish, batch_case *list,
                             size_t n)
{
    const batch_options batch = stability_batch(s, o);
    const floe_status status = batch_run(s->ctx, &batch, list, n);
    if (status != FLOE_OK && status != FLOE_INTERRUPTED) return status;
    const bool stopped = o->batch.stop && *o->batch.stop;
    for (size_t i = 0; i < n; i++) {
        /* A run that failed as all were stopped has failed for that. */
        const bool spoilt = stopped && list[i].status != FLOE_OK && list[i].status != FLOE_DIVERGED;
        if (list[i].state == BATCH_ENDED && !spoilt) TRY(note_case(s, &wish[i], &list[i]));
    }
    return status;
}

floe_status stability_round(stability *s, const stability_options *o, const stability_wish *wish, size_t n)
{
    stability_cases cases;
    floe_status status = memory_resize(s->ctx, &s->probe, s->n_probes + n, sizeof *s->probe);
    if (status != FLOE_OK) return status;
    status = stability_cases_make(&cases, s, o, wish, n);
    if (status == FLOE_OK) status = run_cases(s, o, wish, cases.list, n);
    stability_cases_free(s->ctx, &cases);
    return status;
}
