/* The search over all combinations at once, and the map. */
#include "study/stability/stability_internal.h"

#include "base/memory.h"
#include "base/stop.h"
#include "io/file.h"

#include <string.h>

bool stability_is_map(const stability *s)
{
    return s->n_over == 2;
}

void stability_set_label(const stability *s, size_t set, char label[STABILITY_LABEL])
{
    size_t used = 0;
    label[0] = '\0';
    for (int i = 0; i < s->n_each && used < STABILITY_LABEL; i++) {
        const int n = snprintf(label + used, STABILITY_LABEL - used, "%s%s=%s", i > 0 ? ", " : "", s->each[i].key,
                               s->each[i].value[s->set[set].value[i]]);
        used += (size_t)n;
    }
}

const stability_probe *stability_cell(const stability *s, size_t set, int first, int second)
{
    for (size_t i = 0; i < s->n_probes; i++) {
        const stability_probe *p = &s->probe[i];
        if (p->set == set && strcmp(p->value[0], s->over[0].value[first]) == 0 &&
            strcmp(p->value[1], s->over[1].value[second]) == 0)
            return p;
    }
    return NULL;
}

static bool is_open(const stability_set *set)
{
    return !set->broken && search_look(&set->search).outcome == SEARCH_OPEN;
}

/* What to run next: every open search has its share of the processes. */
static size_t next_wishes(const stability *s, int jobs, stability_wish *wish)
{
    size_t open = 0, n = 0;
    double x[SEARCH_MOST];
    for (size_t k = 0; k < s->n_sets; k++) open += is_open(&s->set[k]);
    if (open == 0) return 0;
    const size_t share = (size_t)jobs / open;
    for (size_t k = 0; k < s->n_sets; k++) {
        if (!is_open(&s->set[k])) continue;
        const size_t found = search_next(&s->set[k].search, share < 1 ? 1 : share > 15 ? 15 : share, x);
        for (size_t i = 0; i < found; i++) wish[n++] = (stability_wish){.set = k, .x = x[i]};
    }
    return n;
}

static floe_status run_search(stability *s, const stability_options *o)
{
    stability_wish *wish;
    const int jobs = o->batch.jobs > 0 ? o->batch.jobs : 1;
    floe_status status = memory_new(s->ctx, &wish, s->n_sets * SEARCH_MOST, sizeof *wish);
    for (size_t n = 1; status == FLOE_OK && n > 0;) {
        n = next_wishes(s, jobs, wish);
        if (n > 0) status = stability_round(s, o, wish, n);
    }
    memory_free(s->ctx, &wish);
    return status;
}

static floe_status run_map(stability *s, const stability_options *o)
{
    const size_t cells = crossed_count(s->over, 2), n = s->n_sets * cells;
    stability_wish *wish;
    TRY(memory_new(s->ctx, &wish, n, sizeof *wish));
    for (size_t i = 0; i < n; i++) {
        wish[i].set = i / cells;
        crossed_pick(s->over, 2, i % cells, wish[i].value);
    }
    const floe_status status = stability_round(s, o, wish, n);
    memory_free(s->ctx, &wish);
    return status;
}

/* A search that has ended without a verdict is no success. */
static floe_status check_verdicts(const stability *s)
{
    for (size_t i = 0; i < s->n_probes; i++) {
        const stability_probe *p = &s->probe[i];
        if (!s->set[p->set].broken || p->verdict != VERDICT_NONE) continue;
        return fail(s->ctx, FLOE_INTERNAL, "the run in '%s/%s' gave no verdict: %s", s->dir, p->folder, p->cause);
    }
    return FLOE_OK;
}

static floe_status run_stability(stability *s, const stability_options *o)
{
    TRY(stability_setup(s, o));
    TRY(folder_make(s->ctx, s->dir));
    const floe_status status = stability_is_map(s) ? run_map(s, o) : run_search(s, o);
    if (status != FLOE_OK && status != FLOE_INTERRUPTED) return status;
    TRY(stability_write(s));
    TRY(stability_plot(s));
    if (status == FLOE_OK) return check_verdicts(s);
    char by[64] = "";
    if (o->batch.stop) stop_request_text(*o->batch.stop, by);
    context_clear(s->ctx);
    return fail(s->ctx, FLOE_INTERRUPTED,
                "stopped%s; what has ended is kept in '%s': the same command goes on from there", by, s->dir);
}

floe_status stability_run(stability **out, context *ctx, const stability_options *options)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    return run_stability(*out, options);
}

void stability_destroy(stability **s)
{
    if (!s || !*s) return;
    context *ctx = (*s)->ctx;
    memory_free(ctx, &(*s)->probe);
    memory_free(ctx, &(*s)->set);
    memory_free(ctx, &(*s)->dir);
    memory_free(ctx, &(*s)->deck_path);
    memory_free(ctx, s);
}
