#include "run/truth.h"

#include "base/strbuf.h"
#include "base/text.h"

#include <math.h>
#include <string.h>

enum { TEXT = 320 };
static const double bar[] = {0.01,
                             0.1}; /* of a drift: from the first on it is reported, from the second on warned of */
enum { BARS = sizeof bar / sizeof bar[0] };

/* Walls turn fluids on cells for as long as a run goes on, and weight does: an error of advection is a share of that, and not of what turns
 * at one time. */
static double drift_of(const sim *s, int q)
{
    return s->ice ? ledger_largest_share(&s->ledger, (ledger_quantity)q)
                  : ledger_largest_drift(&s->ledger, (ledger_quantity)q);
}

/* How many of the bars the largest drift of a quantity exceeds. */
static int bars_passed(const sim *s, int q)
{
    const double drift = fabs(drift_of(s, q));
    int n = 0;
    while (n < BARS && !(drift < bar[n])) ++n; /* a NaN passes all */
    return n;
}

static const char *words_of(int q)
{
    static const char *const words[LEDGER_QUANTITIES] = {
        "mass",   "momentum along x",           "momentum along y",           "momentum along z",
        "energy", "moment of momentum about x", "moment of momentum about y", "moment of momentum about z"};
    return words[q];
}

static const char *fate_of(double drift)
{
    if (isnan(drift)) return "no number";
    return drift < 0.0 ? "lost" : "from nothing";
}

static void describe_drift(const sim *s, int q, char text[TEXT])
{
    const double drift = drift_of(s, q);
    (void)snprintf(text, TEXT, "%s: %.2g %% of what was there at the start and came in is %s by t = %.6g%s",
                   words_of(q), 100.0 * fabs(drift), fate_of(drift), s->ledger.worst_time[q],
                   scene_time_unit(s->scene));
}

void truth_begin(run_truth *t, const sim *s)
{
    for (int q = 0; q < LEDGER_QUANTITIES; ++q) t->passed[q] = bars_passed(s, q);
}

void truth_log(run_truth *t, const sim *s)
{
    static const double first_part = 0.05; /* of the run: little may have come in yet */
    char text[TEXT];
    for (int q = 0; q < LEDGER_QUANTITIES && s->time >= first_part * s->scene->time.end; ++q) {
        const int passed = bars_passed(s, q);
        if (passed <= t->passed[q]) continue;
        t->passed[q] = passed;
        describe_drift(s, q, text);
        context_log(s->ctx, LOG_INFO, "%s", text);
    }
}

typedef struct notes {
    char *text;
    size_t size;
} notes;

static void add_note(notes *n, const char *note)
{
    text_add(n->text, n->size, "%s%s", n->text[0] ? "; " : "", note);
}

static void note_drifts(const sim *s, notes *n)
{
    char note[TEXT];
    for (int q = 0; q < LEDGER_QUANTITIES; ++q) {
        const int passed = bars_passed(s, q);
        if (passed == 0) continue;
        (void)snprintf(note, sizeof note, "%s%.2g %% of the %s %s", passed == BARS ? "WARNING: " : "",
                       100.0 * fabs(drift_of(s, q)), words_of(q), fate_of(drift_of(s, q)));
        add_note(n, note);
    }
}

/* Each flux through an open side may be in the ledger, and all of them bring motion that was nowhere. */
static void describe_feed(const sim *s, char text[TEXT])
{
    const ledger *l = &s->ledger;
    (void)snprintf(
        text, TEXT,
        "motion: kinetic and strain energy reached %.3g%s, %.2g times what the scene could set in motion; open sides "
        "feed it. Give temperature and material of what is outside, or take non_reflecting",
        l->motion.most, s->scene->dimensionless ? "" : " J", l->motion.most / ledger_possible_motion(l));
}

static void note_feed(const sim *s, notes *n)
{
    char note[TEXT];
    if (!ledger_is_fed(&s->ledger)) return;
    (void)snprintf(note, sizeof note, "WARNING: open sides feed the motion: %.2g times what there could be",
                   s->ledger.motion.most / ledger_possible_motion(&s->ledger));
    add_note(n, note);
}

static void note_counts(const sim *s, notes *n)
{
    static const struct {
        ledger_count count;
        const char *of;
    } told[] = {{COUNT_POINTS_LOST, "points lost"},
                {COUNT_FLOORS, "values raised to their floors"},
                {COUNT_ENERGY_GUARDS, "energies guarded"},
                {COUNT_NEWTON_FALLBACKS, "cells without a common pressure by Newton's method"},
                {COUNT_CELLS_MERGED, "small cells merged (over all steps)"}};
    char note[TEXT];
    for (size_t i = 0; i < sizeof told / sizeof told[0]; ++i) {
        const long long count = s->ledger.count[told[i].count];
        if (count == 0) continue;
        (void)snprintf(note, sizeof note, "%lld %s", count, told[i].of);
        add_note(n, note);
    }
}

void truth_summarise(const sim *s, run_summary *out)
{
    notes n = {out->notes, sizeof out->notes};
    out->notes[0] = '\0';
    char text[TEXT];
    out->notes[0] = '\0';
    note_drifts(s, &n);
    note_feed(s, &n);
    note_counts(s, &n);
    for (int q = 0; q < LEDGER_QUANTITIES; ++q) {
        if (bars_passed(s, q) < BARS) continue;
        describe_drift(s, q, text);
        summary_add_warning(out, text);
    }
    if (!ledger_is_fed(&s->ledger)) return;
    describe_feed(s, text);
    summary_add_warning(out, text);
}
