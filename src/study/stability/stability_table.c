/* A search or a map as tables: the runs (stability.csv) and what was found of them (limits.csv), both in stability.json. */
#include "study/crossed.h"
#include "study/stability/stability.h"
#include "study/table.h"

#include "base/text.h"
#include "io/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMN = 12 };

static void add_each(const stability *s, const stability_set *set, table *t)
{
    const table_column each = {.in = TABLE_ALL, .object = "each", .quoted = true, .width = COLUMN};
    table_values(t, each, s->each, s->n_each, set->value);
}

/* ---- runs ---- */

static void add_probe(const stability *s, const stability_probe *p, table *t)
{
    char over[32], cause[91];
    (void)snprintf(over, sizeof over, "over %-5.3g", s->relative_to);
    (void)snprintf(cause, sizeof cause, "%.90s", p->cause);
    table_row(t);
    add_each(s, &s->set[p->set], t);
    for (int i = 0; i < s->n_over; i++)
        table_text(t, s->over[i].key,
                   (table_column){.in = TABLE_ALL, .object = "over", .quoted = true, .width = COLUMN}, p->value[i]);
    if (isfinite(s->relative_to))
        table_number(t, over, (table_column){.in = TABLE_SHOWN, .format = "%.4f"}, p->x[0] / s->relative_to);
    table_text(t, "verdict", (table_column){.in = TABLE_ALL, .left = true, .width = 14}, verdict_name(p->verdict));
    table_number(t, "energy_ratio", (table_column){.in = TABLE_ALL, .heading = "energy", .format = "%.3g", .width = 10},
                 p->energy.ratio);
    table_whole(t, "steps", (table_column){.in = TABLE_ALL, .width = 8}, p->steps);
    table_whole(t, "rejected_steps", (table_column){.in = TABLE_ALL, .heading = "rejected", .width = 8}, p->rejected);
    table_number(t, "time", (table_column){.in = TABLE_FILES, .unit = s->dimensionless ? "1" : "s"}, p->time);
    table_text(t, "cause", (table_column){.in = TABLE_FILES, .quoted = true}, p->cause);
    table_text(t, "directory", (table_column){.in = TABLE_FILES}, p->folder);
    table_text(t, "cause", (table_column){.in = TABLE_SHOWN, .left = true}, cause);
}

/* In the order in which they were run, or, for people, combination by combination. */
static void make_probe_table(const stability *s, bool by_set, table *t)
{
    table_init(t, s->ctx);
    for (size_t k = 0; k < (by_set ? s->n_sets : 1); k++) {
        for (size_t i = 0; i < s->n_probes; i++)
            if (!by_set || s->probe[i].set == k) add_probe(s, &s->probe[i], t);
    }
}

/* ---- limits ---- */

static const char *outcome_name(const stability_set *set, search_outcome outcome)
{
    static const char *const name[] = {[SEARCH_OPEN] = "not_finished",
                                       [SEARCH_FOUND] = "found",
                                       [SEARCH_ALL_STABLE] = "all_stable",
                                       [SEARCH_ALL_UNSTABLE] = "all_unstable",
                                       [SEARCH_OUT_OF_PROBES] = "wide"};
    return set->broken ? "no_verdict" : name[outcome];
}

/* What was found, in words; with a bracket only where it is one limit. */
static void describe_outcome(const stability *s, const stability_set *set, const search_state *at,
                             char text[BATCH_MESSAGE])
{
    text[0] = '\0';
    switch (at->outcome) {
    case SEARCH_FOUND: break;
    case SEARCH_OUT_OF_PROBES:
        text_add(text, BATCH_MESSAGE, "; the bracket is wider than the tolerance %g", s->tolerance);
        break;
    case SEARCH_ALL_STABLE:
        text_add(text, BATCH_MESSAGE, "no limit: stable at every value tried, the last of them %.6g%s%s", at->stable,
                 s->unit, at->refused ? "; the deck takes none beyond" : "");
        break;
    case SEARCH_ALL_UNSTABLE:
        text_add(text, BATCH_MESSAGE, "no limit: unstable at every value tried, the last of them %.6g%s", at->unstable,
                 s->unit);
        break;
    case SEARCH_OPEN:
        text_add(text, BATCH_MESSAGE, "%s", set->broken ? "no answer: a run gave no verdict" : "not finished");
        break;
    }
    if (!search_is_monotone(&set->search))
        text_add(text, BATCH_MESSAGE, "; there is more than one limit, this is one of them");
}

static const char *unit_name(const stability *s)
{
    return s->unit[0] == ' ' ? s->unit + 1 : s->unit;
}

static void add_limit(const stability *s, const stability_set *set, table *t)
{
    const search_state at = search_look(&set->search);
    const unsigned both = isfinite(s->relative_to) ? TABLE_ALL : TABLE_FILES;
    table_column value = {.in = TABLE_ALL, .unit = unit_name(s), .width = COLUMN, .digits = 9};
    table_column ratio = {.in = both, .format = "%.4f", .width = 9, .digits = 9};
    char over[32], text[BATCH_MESSAGE];
    (void)snprintf(over, sizeof over, "over %.3g", s->relative_to);
    table_row(t);
    add_each(s, set, t);
    table_text(t, "outcome", (table_column){.in = TABLE_FILES}, outcome_name(set, at.outcome));
    value.heading = "stable at";
    table_number(t, "stable", value, at.stable);
    value.heading = "unstable at";
    table_number(t, "unstable", value, at.unstable);
    ratio.heading = "both";
    table_number(t, "stable_over_reference", ratio, at.stable / s->relative_to);
    ratio.heading = over;
    table_number(t, "unstable_over_reference", ratio, at.unstable / s->relative_to);
    table_whole(t, "runs", (table_column){.in = TABLE_ALL, .width = 4}, (long long)set->search.n_told);
    table_flag(t, "monotone", (table_column){.in = TABLE_JSON}, search_is_monotone(&set->search));
    describe_outcome(s, set, &at, text);
    table_text(t, "", (table_column){.in = TABLE_SHOWN, .left = true}, text);
}

static void make_limit_table(const stability *s, table *t)
{
    table_init(t, s->ctx);
    for (size_t k = 0; !stability_is_map(s) && k < s->n_sets; k++) add_limit(s, &s->set[k], t);
}

/* ---- as files ---- */

static json_t *stability_axes_json(const scene_axis *axis, int n, bool values)
{
    json_t *object = json_object();
    for (int i = 0; i < n; i++)
        json_put(object, axis[i].key, axis_values_json(axis[i].value, values ? axis[i].n_values : 0));
    return object;
}

static floe_status write_json(const stability *s, const table *probes, const table *limits)
{
    char criterion[CRITERION_TEXT], path[BATCH_PATH];
    (void)snprintf(path, sizeof path, "%s/stability.json", s->dir);
    criterion_text(s->growth, s->by_energy, criterion);
    return json_write(s->ctx, path,
                      json_pack("{s:i, s:o, s:s, s:o, s:o, s:s, s:o, s:o, s:o, s:s, s:o, s:o}", "schema", 1, "deck",
                                json_plain_text(s->deck_path), "title", s->title, "over",
                                stability_axes_json(s->over, s->n_over, stability_is_map(s)), "each",
                                stability_axes_json(s->each, s->n_each, true), "unit", unit_name(s), "relative_to",
                                json_number(s->relative_to), "tolerance", json_number(s->tolerance), "growth",
                                json_number(s->growth), "criterion", criterion, "limits", table_json(limits), "runs",
                                table_json(probes)));
}

floe_status stability_write(const stability *s)
{
    table probes, limits;
    make_probe_table(s, false, &probes);
    make_limit_table(s, &limits);
    floe_status status = write_json(s, &probes, &limits);
    if (status == FLOE_OK) status = table_write_csv(&probes, s->dir, "stability");
    if (status == FLOE_OK && !stability_is_map(s)) status = table_write_csv(&limits, s->dir, "limits");
    table_free(&limits);
    table_free(&probes);
    return status;
}

/* ---- for people ---- */

static floe_status print_and_free(table *t, FILE *file)
{
    const floe_status status = table_print(t, file);
    table_free(t);
    return status;
}

/* "time.fixed_step = 0.00105 (1.05 x 0.001)" */
static void print_value(const stability *s, double x, FILE *file)
{
    (void)fprintf(file, "%s = %.6g%s", s->over[0].key, x, s->unit);
    if (isfinite(s->relative_to)) (void)fprintf(file, " (%.4g x %g)", x / s->relative_to, s->relative_to);
}

/* One limit: a sentence. */
static void print_sentence(const stability *s, FILE *file)
{
    const stability_set *one = &s->set[0];
    const search_state at = search_look(&one->search);
    char label[STABILITY_LABEL], text[BATCH_MESSAGE];
    stability_set_label(s, 0, label);
    describe_outcome(s, one, &at, text);
    if (label[0]) (void)fprintf(file, "%s: ", label);
    if (at.outcome == SEARCH_FOUND || at.outcome == SEARCH_OUT_OF_PROBES) {
        (void)fprintf(file, "stable %s ", at.stable < at.unstable ? "up to" : "down to");
        print_value(s, at.stable, file);
        (void)fprintf(file, ", unstable at ");
        print_value(s, at.unstable, file);
    }
    (void)fprintf(file, "%s; %zu runs\n", text, one->search.n_told);
}

/* Many limits: a table. */
static floe_status print_limits(const stability *s, FILE *file)
{
    table t;
    (void)fprintf(file, "limits of %s%s\n", s->over[0].key, s->unit);
    make_limit_table(s, &t);
    return print_and_free(&t, file);
}

/* A column for each value of the second key, and in it a sign for each verdict. */
static floe_status print_map(const stability *s, size_t set, FILE *file)
{
    char label[STABILITY_LABEL];
    table t;
    stability_set_label(s, set, label);
    (void)fprintf(file, "%s%s%*s  %s\n", label, label[0] ? "\n" : "", COLUMN, s->over[0].key, s->over[1].key);
    table_init(&t, s->ctx);
    for (int i = 0; i < s->over[0].n_values; i++) {
        table_row(&t);
        table_text(&t, "", (table_column){.in = TABLE_SHOWN, .width = COLUMN}, s->over[0].value[i]);
        for (int k = 0; k < s->over[1].n_values; k++) {
            const stability_probe *p = stability_cell(s, set, i, k);
            table_text(&t, s->over[1].value[k], (table_column){.in = TABLE_SHOWN, .width = 8},
                       p ? (const char[]){verdict_sign(p->verdict), '\0'} : "");
        }
    }
    return print_and_free(&t, file);
}

static floe_status print_maps(const stability *s, FILE *file)
{
    for (size_t k = 0; k < s->n_sets; k++) TRY(print_map(s, k, file));
    for (int v = 0; v < VERDICT_COUNT; v++)
        (void)fprintf(file, "%s%c %s", v > 0 ? ", " : "", verdict_sign((verdict)v), verdict_name((verdict)v));
    (void)fprintf(file, "\n");
    return FLOE_OK;
}

floe_status stability_print(const stability *s, FILE *file)
{
    char criterion[CRITERION_TEXT];
    table probes;
    if (s->title[0]) (void)fprintf(file, "%s\n", s->title);
    criterion_text(s->growth, s->by_energy, criterion);
    (void)fprintf(file, "%s\n\n", criterion);
    make_probe_table(s, true, &probes);
    TRY(print_and_free(&probes, file));
    (void)fprintf(file, "\n");
    if (stability_is_map(s)) return print_maps(s, file);
    if (s->n_sets > 1) return print_limits(s, file);
    print_sentence(s, file);
    return FLOE_OK;
}
