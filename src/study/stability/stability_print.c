/* A search or a map for people. */
#include "study/crossed.h"
#include "study/stability/stability.h"

#include <math.h>
#include <string.h>

enum { COLUMN = 12 };

static void print_set_names(const stability *s, FILE *file)
{
    for (int i = 0; i < s->n_each; i++)
        (void)fprintf(file, "%*s  ", width_at_least(COLUMN, s->each[i].key), s->each[i].key);
}

static void print_set_values(const stability *s, size_t set, FILE *file)
{
    for (int i = 0; i < s->n_each; i++)
        (void)fprintf(file, "%*s  ", width_at_least(COLUMN, s->each[i].key), s->each[i].value[s->set[set].value[i]]);
}

static void print_probe(const stability *s, const stability_probe *p, FILE *file)
{
    print_set_values(s, p->set, file);
    for (int i = 0; i < s->n_over; i++)
        (void)fprintf(file, "%*s  ", width_at_least(COLUMN, s->over[i].key), p->value[i]);
    if (isfinite(s->relative_to)) (void)fprintf(file, "%10.4f  ", p->x[0] / s->relative_to);
    (void)fprintf(file, "%-14s  %10.3g  %8lld  %8lld  %.90s\n", verdict_name(p->verdict), p->energy.ratio, p->steps,
                  p->rejected, p->cause);
}

static void print_probes(const stability *s, FILE *file)
{
    print_set_names(s, file);
    for (int i = 0; i < s->n_over; i++)
        (void)fprintf(file, "%*s  ", width_at_least(COLUMN, s->over[i].key), s->over[i].key);
    if (isfinite(s->relative_to)) (void)fprintf(file, "over %-5.3g  ", s->relative_to);
    (void)fprintf(file, "%-14s  %10s  %8s  %8s  %s\n", "verdict", "energy", "steps", "rejected", "cause");
    for (size_t k = 0; k < s->n_sets; k++) {
        for (size_t i = 0; i < s->n_probes; i++) {
            if (s->probe[i].set == k) print_probe(s, &s->probe[i], file);
        }
    }
}

/* "time.fixed_step = 0.00105 (1.05 x 0.001)" */
static void print_value(const stability *s, double x, FILE *file)
{
    (void)fprintf(file, "%s = %.6g%s", s->over[0].key, x, s->unit);
    if (isfinite(s->relative_to)) (void)fprintf(file, " (%.4g x %g)", x / s->relative_to, s->relative_to);
}

/* What was found, in words; with a bracket only where it is one limit. */
static void print_outcome(const stability *s, const stability_set *set, const search_state *at, FILE *file)
{
    switch (at->outcome) {
    case SEARCH_FOUND: break;
    case SEARCH_OUT_OF_PROBES: (void)fprintf(file, "; the bracket is wider than the tolerance %g", s->tolerance); break;
    case SEARCH_ALL_STABLE:
        (void)fprintf(file, "no limit: stable at every value tried, the last of them %.6g%s%s", at->stable, s->unit,
                      at->refused ? "; the deck takes none beyond" : "");
        break;
    case SEARCH_ALL_UNSTABLE:
        (void)fprintf(file, "no limit: unstable at every value tried, the last of them %.6g%s", at->unstable, s->unit);
        break;
    case SEARCH_OPEN: (void)fprintf(file, set->broken ? "no answer: a run gave no verdict" : "not finished"); break;
    }
    if (!search_is_monotone(&set->search)) (void)fprintf(file, "; there is more than one limit, this is one of them");
}

static bool has_bracket(const search_state *at)
{
    return at->outcome == SEARCH_FOUND || at->outcome == SEARCH_OUT_OF_PROBES;
}

/* One limit: a sentence. */
static void print_sentence(const stability *s, FILE *file)
{
    const stability_set *one = &s->set[0];
    const search_state at = search_look(&one->search);
    char label[STABILITY_LABEL];
    stability_set_label(s, 0, label);
    if (label[0]) (void)fprintf(file, "%s: ", label);
    if (has_bracket(&at)) {
        (void)fprintf(file, "stable %s ", at.stable < at.unstable ? "up to" : "down to");
        print_value(s, at.stable, file);
        (void)fprintf(file, ", unstable at ");
        print_value(s, at.unstable, file);
    }
    print_outcome(s, one, &at, file);
    (void)fprintf(file, "; %zu runs\n", one->search.n_told);
}

/* Many limits: a table. */
static void print_limits(const stability *s, FILE *file)
{
    const bool over = isfinite(s->relative_to);
    (void)fprintf(file, "limits of %s%s\n", s->over[0].key, s->unit);
    print_set_names(s, file);
    (void)fprintf(file, "%12s  %12s  ", "stable at", "unstable at");
    if (over) (void)fprintf(file, "  both over %-8.3g  ", s->relative_to);
    (void)fprintf(file, "%4s\n", "runs");
    for (size_t k = 0; k < s->n_sets; k++) {
        const stability_set *set = &s->set[k];
        const search_state at = search_look(&set->search);
        print_set_values(s, k, file);
        (void)fprintf(file, "%12.6g  %12.6g  ", at.stable, at.unstable);
        if (over) (void)fprintf(file, "%9.4f  %9.4f  ", at.stable / s->relative_to, at.unstable / s->relative_to);
        (void)fprintf(file, "%4zu  ", set->search.n_told);
        print_outcome(s, set, &at, file);
        (void)fprintf(file, "\n");
    }
}

static void print_map(const stability *s, size_t set, FILE *file)
{
    char label[STABILITY_LABEL];
    const int first = width_at_least(COLUMN, s->over[0].key);
    stability_set_label(s, set, label);
    (void)fprintf(file, "%s%s%*s  %s\n%*s ", label, label[0] ? "\n" : "", first, s->over[0].key, s->over[1].key, first,
                  "");
    for (int k = 0; k < s->over[1].n_values; k++) (void)fprintf(file, " %8s", s->over[1].value[k]);
    (void)fprintf(file, "\n");
    for (int i = 0; i < s->over[0].n_values; i++) {
        (void)fprintf(file, "%*s ", first, s->over[0].value[i]);
        for (int k = 0; k < s->over[1].n_values; k++) {
            const stability_probe *p = stability_cell(s, set, i, k);
            (void)fprintf(file, " %8c", p ? verdict_sign(p->verdict) : ' ');
        }
        (void)fprintf(file, "\n");
    }
}

static void print_signs(FILE *file)
{
    for (int v = 0; v < VERDICT_COUNT; v++)
        (void)fprintf(file, "%s%c %s", v > 0 ? ", " : "", verdict_sign((verdict)v), verdict_name((verdict)v));
    (void)fprintf(file, "\n");
}

floe_status stability_print(const stability *s, FILE *file)
{
    char criterion[CRITERION_TEXT];
    if (s->title[0]) (void)fprintf(file, "%s\n", s->title);
    criterion_text(s->growth, s->by_energy, criterion);
    (void)fprintf(file, "%s\n\n", criterion);
    print_probes(s, file);
    (void)fprintf(file, "\n");
    if (!stability_is_map(s)) {
        if (s->n_sets > 1)
            print_limits(s, file);
        else
            print_sentence(s, file);
    }
    for (size_t k = 0; stability_is_map(s) && k < s->n_sets; k++) print_map(s, k, file);
    if (stability_is_map(s)) print_signs(file);
    if (ferror(file)) return fail(s->ctx, FLOE_IO, "cannot write the table");
    return FLOE_OK;
}
