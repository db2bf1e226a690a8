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

static stability_probe begin_probe(size_t set)
{
    return (stability_probe){.set = set, .x = {NAN, NAN}};
}

/* Sets the i-th value of a probe, and what number it is. */
static void set_value(stability_probe *p, int i, const char *value)
{
    char *end;
    (void)snprintf(p->value[i], SCENE_VALUE, "%s", value);
    p->x[i] = strtod(value, &end);
    if (end == value) p->x[i] = NAN;
}

stability_probe stability_probe_at(const stability *s, size_t set, double x)
{
    stability_probe p = begin_probe(set);
    char value[SCENE_VALUE];
    (void)snprintf(value, sizeof value, "%.9g%s", x, s->unit);
    set_value(&p, 0, value);
    p.wanted = x;
    (void)snprintf(p.folder, sizeof p.folder, "%02zu-%.9g", set + 1, x);
    return p;
}

stability_probe stability_probe_of_map(const stability *s, size_t set, size_t cell)
{
    stability_probe p = begin_probe(set);
    int at[2];
    crossed_pick(s->over, 2, cell, at);
    for (int i = 0; i < 2; i++) set_value(&p, i, s->over[i].value[at[i]]);
    (void)snprintf(p.folder, sizeof p.folder, "%02zu-%02d-%02d", set + 1, at[0] + 1, at[1] + 1);
    return p;
}

/* Settings go from the outside in: the user's, those of the combination, the value. */
static floe_status make_case(const stability *s, const stability_options *o, const stability_probe *p,
                             case_settings *settings, batch_case *one)
{
    char label[STABILITY_LABEL];
    TRY(case_settings_make(settings, s->ctx, &o->set, (size_t)(s->n_each + s->n_over)));
    stability_set_label(s, p->set, label);
    for (int i = 0; i < s->n_each; i++) case_settings_pick(settings, &s->each[i], s->set[p->set].value[i]);
    for (int i = 0; i < s->n_over; i++) {
        case_settings_put(settings, s->over[i].key, p->value[i]);
        text_add(label, sizeof label, "%s%s=%s", label[0] ? ", " : "", s->over[i].key, p->value[i]);
    }
    *one = (batch_case){.set = settings->set, .n_set = settings->n};
    (void)snprintf(one->label, sizeof one->label, "%.159s", label);
    (void)snprintf(one->folder, sizeof one->folder, "%s", p->folder);
    return FLOE_OK;
}

floe_status stability_cases_make(stability_cases *cases, const stability *s, const stability_options *o,
                                 const stability_probe *probe, size_t n)
{
    *cases = (stability_cases){0};
    TRY(memory_new(s->ctx, &cases->list, n, sizeof *cases->list));
    TRY(memory_new(s->ctx, &cases->settings, n, sizeof *cases->settings));
    for (cases->n = 0; cases->n < n; cases->n++)
        TRY(make_case(s, o, &probe[cases->n], &cases->settings[cases->n], &cases->list[cases->n]));
    return FLOE_OK;
}

void stability_cases_free(context *ctx, stability_cases *cases)
{
    for (size_t i = 0; i < cases->n; i++) case_settings_free(&cases->settings[i], ctx);
    memory_free(ctx, &cases->settings);
    memory_free(ctx, &cases->list);
    cases->n = 0;
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

static void judge_run(const stability *s, const batch_case *one, stability_probe *p)
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

floe_status stability_judge_case(stability *s, stability_probe *p, const batch_case *one)
{
    stability_set *set = &s->set[p->set];
    p->steps = one->summary.steps;
    p->rejected = one->summary.rejected_steps;
    p->time = one->summary.time;
    if (one->ran) TRY(read_energy(s, one, &p->energy));
    judge_run(s, one, p);
    if (stability_is_map(s)) return FLOE_OK;
    if (p->verdict == VERDICT_NONE && one->status != FLOE_BAD_INPUT)
        set->broken = true;
    else
        search_tell(&set->search, p->wanted, answer_of(p, one));
    return FLOE_OK;
}
