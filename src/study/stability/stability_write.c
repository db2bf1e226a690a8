/* A search or a map as files: stability.json, its runs as stability.csv, and what was found as limits.csv. */
#include "study/crossed.h"
#include "study/stability/stability.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static json_t *axes_json(const scene_axis *axis, int n, bool values)
{
    json_t *object = json_object();
    for (int i = 0; i < n; i++)
        json_put(object, axis[i].key, axis_values_json(axis[i].value, values ? axis[i].n_values : 0));
    return object;
}

static const char *outcome_name(const stability_set *set, search_outcome outcome)
{
    static const char *const name[] = {[SEARCH_OPEN] = "not_finished",
                                       [SEARCH_FOUND] = "found",
                                       [SEARCH_ALL_STABLE] = "all_stable",
                                       [SEARCH_ALL_UNSTABLE] = "all_unstable",
                                       [SEARCH_OUT_OF_PROBES] = "wide"};
    return set->broken ? "no_verdict" : name[outcome];
}

static json_t *limit_json(const stability *s, size_t k)
{
    const stability_set *set = &s->set[k];
    const search_state at = search_look(&set->search);
    return json_pack("{s:o, s:s, s:o, s:o, s:o, s:o, s:I, s:b}", "each",
                     crossed_json(s->each, s->n_each, s->set[k].value), "outcome", outcome_name(set, at.outcome),
                     "stable", json_number(at.stable), "unstable", json_number(at.unstable), "stable_over_reference",
                     json_number(at.stable / s->relative_to), "unstable_over_reference",
                     json_number(at.unstable / s->relative_to), "runs", (json_int_t)set->search.n_told, "monotone",
                     search_is_monotone(&set->search));
}

static json_t *limits_json(const stability *s)
{
    json_t *list = json_array();
    for (size_t k = 0; list && !stability_is_map(s) && k < s->n_sets; k++)
        json_array_append_new(list, limit_json(s, k));
    return list;
}

static json_t *probe_json(const stability *s, const stability_probe *p)
{
    json_t *value = json_object();
    for (int i = 0; value && i < s->n_over; i++) json_object_set_new(value, s->over[i].key, json_string(p->value[i]));
    return json_pack("{s:o, s:o, s:s, s:o, s:I, s:I, s:o, s:o, s:s}", "each",
                     crossed_json(s->each, s->n_each, s->set[p->set].value), "over", value, "verdict",
                     verdict_name(p->verdict), "energy_ratio", json_number(p->energy.ratio), "steps",
                     (json_int_t)p->steps, "rejected_steps", (json_int_t)p->rejected, "time", json_number(p->time),
                     "cause", json_plain_text(p->cause), "directory", p->folder);
}

static json_t *probes_json(const stability *s)
{
    json_t *list = json_array();
    for (size_t i = 0; list && i < s->n_probes; i++) json_array_append_new(list, probe_json(s, &s->probe[i]));
    return list;
}

static floe_status write_json(const stability *s)
{
    char criterion[CRITERION_TEXT], path[BATCH_PATH];
    (void)snprintf(path, sizeof path, "%s/stability.json", s->dir);
    criterion_text(s->growth, s->by_energy, criterion);
    json_t *object = json_pack(
        "{s:i, s:o, s:s, s:o, s:o, s:s, s:o, s:o, s:o, s:s, s:o, s:o}", "schema", 1, "deck",
        json_plain_text(s->deck_path), "title", s->title, "over", axes_json(s->over, s->n_over, stability_is_map(s)),
        "each", axes_json(s->each, s->n_each, true), "unit", s->unit[0] == ' ' ? s->unit + 1 : s->unit, "relative_to",
        json_number(s->relative_to), "tolerance", json_number(s->tolerance), "growth", json_number(s->growth),
        "criterion", criterion, "limits", limits_json(s), "runs", probes_json(s));
    return json_write(s->ctx, path, object);
}

static void append_probe(const stability *s, const stability_probe *p, strbuf *out)
{
    for (int i = 0; i < s->n_each; i++) csv_append_field(out, s->each[i].value[s->set[p->set].value[i]]);
    for (int i = 0; i < s->n_over; i++) csv_append_field(out, p->value[i]);
    strbuf_append(out, "%s,%.17g,%lld,%lld,%.17g,", verdict_name(p->verdict), p->energy.ratio, p->steps, p->rejected,
                  p->time);
    csv_append_field(out, p->cause);
    strbuf_append(out, "%s\n", p->folder);
}

static floe_status write_csv(const stability *s)
{
    strbuf out;
    strbuf_init(&out, s->ctx);
    for (int i = 0; i < s->n_each; i++) strbuf_append(&out, "%s,", s->each[i].key);
    for (int i = 0; i < s->n_over; i++) strbuf_append(&out, "%s,", s->over[i].key);
    strbuf_append(&out, "verdict,energy_ratio,steps,rejected_steps,time (%s),cause,directory\n",
                  s->dimensionless ? "1" : "s");
    for (size_t i = 0; i < s->n_probes; i++) append_probe(s, &s->probe[i], &out);
    return csv_write_rows(&out, s->dir, "stability");
}

static void append_limit(const stability *s, size_t k, strbuf *out)
{
    const stability_set *set = &s->set[k];
    const search_state at = search_look(&set->search);
    for (int i = 0; i < s->n_each; i++) csv_append_field(out, s->each[i].value[set->value[i]]);
    strbuf_append(out, "%s,%.9g,%.9g,%.9g,%.9g,%zu\n", outcome_name(set, at.outcome), at.stable, at.unstable,
                  at.stable / s->relative_to, at.unstable / s->relative_to, set->search.n_told);
}

static floe_status write_limits(const stability *s)
{
    strbuf out;
    strbuf_init(&out, s->ctx);
    for (int i = 0; i < s->n_each; i++) strbuf_append(&out, "%s,", s->each[i].key);
    strbuf_append(&out, "outcome,stable%s,unstable%s,stable_over_reference,unstable_over_reference,runs\n", s->unit,
                  s->unit);
    for (size_t k = 0; k < s->n_sets; k++) append_limit(s, k, &out);
    return csv_write_rows(&out, s->dir, "limits");
}

floe_status stability_write(const stability *s)
{
    TRY(write_json(s));
    TRY(write_csv(s));
    return stability_is_map(s) ? FLOE_OK : write_limits(s);
}
