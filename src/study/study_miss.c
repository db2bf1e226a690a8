/* What a study has not reached. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "base/text.h"

#include <string.h>

enum { MISS_TEXT = CONTEXT_MESSAGE_SIZE / 2 - 16, MISS_LINE = 400, MISS_LAST = 200 };

/* Lines for the message; where they do not fit, names without their reasons end it. */
typedef struct misses {
    char line[MISS_TEXT], more[MISS_LAST];
    size_t n, n_more;
} misses;

static void add_miss(misses *m, const char *name, const char *why)
{
    char text[MISS_LINE];
    const size_t at = strlen(m->line);
    const int length = snprintf(text, sizeof text, "\n    %.180s: %.200s", name, why);
    m->n++;
    if (m->n_more == 0 && at + (size_t)length + sizeof m->more + 32 < sizeof m->line) {
        text_add(m->line, sizeof m->line, "%s", text);
        return;
    }
    const size_t end = strlen(m->more);
    m->n_more++;
    if (end + strlen(name) + 8 < sizeof m->more) text_add(m->more, sizeof m->more, "%s%s", end ? "; " : "", name);
}

static void add_last(misses *m)
{
    if (m->n_more == 0) return;
    text_add(m->line, sizeof m->line, "\n    and %zu more: %s", m->n_more, m->more);
}

static floe_status add_bars(const study *s, misses *m, size_t *all)
{
    char text[512];
    study_bar_result *list;
    TRY(study_bars(s, &list, all));
    for (size_t i = 0; i < *all; i++) {
        if (list[i].met) continue;
        study_bar_text(s, &list[i], text, sizeof text);
        char *limit = strstr(text, ": ");
        if (limit) *limit = '\0';
        add_miss(m, text, limit ? limit + 2 : "");
    }
    memory_free(s->ctx, &list);
    add_last(m);
    return FLOE_OK;
}

/* What a case has come to that it should not have; NULL: it is fine. */
static const char *fault_of(const study *s, const study_case *one)
{
    const bool foreseen = study_refusal_of(s, one) != NULL;
    if (study_has_verdicts(s)) {
        const bool fine = one->verdict == STUDY_RIGHT || one->verdict == STUDY_UNJUDGED ||
                          (one->verdict == STUDY_REFUSED && foreseen);
        if (fine) return one->unnoticed == 0 ? NULL : "blind";
        return study_verdict_name(one->verdict);
    }
    const batch_case *run = one->run;
    const bool said = run->status == FLOE_DIVERGED || run->status == FLOE_BAD_INPUT;
    if (run->state != BATCH_ENDED || study_is_done(one) || run->timed_out || (said && foreseen)) return NULL;
    return batch_status_name(run);
}

static void add_cases(const study *s, misses *m)
{
    char name[STUDY_LABEL + 32];
    for (size_t i = 0; i < s->n; i++) {
        const study_case *one = &s->list[i];
        const char *fault = fault_of(s, one);
        if (!fault) continue;
        char unnoticed[BATCH_MESSAGE];
        study_unnoticed_text(one, unnoticed);
        (void)snprintf(name, sizeof name, "%s, %s", fault, one->run->label);
        add_miss(m, name, one->unnoticed != 0 ? unnoticed : study_has_verdicts(s) ? one->why : one->run->message);
    }
    add_last(m);
}

floe_status study_check_results(const study *s)
{
    misses bars = {.n = 0}, cases = {.n = 0};
    char head[2][160] = {"", ""};
    size_t all;
    TRY(add_bars(s, &bars, &all));
    add_cases(s, &cases);
    if (bars.n + cases.n == 0) return FLOE_OK;
    if (bars.n > 0) (void)snprintf(head[0], sizeof head[0], "%zu of %zu required bars missed:", bars.n, all);
    if (cases.n > 0)
        (void)snprintf(head[1], sizeof head[1], "%s%zu of %zu cases %s:", bars.n > 0 ? "\n" : "", cases.n, s->n,
                       study_has_verdicts(s)
                           ? s->options->spoil ? "are wrong, checked blindly, or refused without a reason in the deck"
                                               : "are wrong, or refused without a reason in the deck"
                           : "have not come to their end, and the deck does not say why (study.refuse)");
    return fail(s->ctx, FLOE_MISSED_BAR, "%s%s%s%s", head[0], bars.line, head[1], cases.line);
}
