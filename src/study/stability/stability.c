/* The search over all combinations at once, and the map. */
#include "study/stability/stability_internal.h"

#include "base/memory.h"
#include "study/judge.h"

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

/* A search, or a map, as a judge. */
typedef struct searching {
    stability *s;
    const stability_options *o;
    stability_cases cases; /* of the round; owned */
    size_t n;              /* its probes, behind those of s that have a verdict */
    bool mapped;           /* the one round of a map has been asked for */
} searching;

static floe_status reserve_probes(searching *r, size_t more)
{
    r->n = 0;
    return memory_resize(r->s->ctx, &r->s->probe, r->s->n_probes + more, sizeof *r->s->probe);
}

static void want_probe(searching *r, stability_probe probe)
{
    r->s->probe[r->s->n_probes + r->n++] = probe;
}

/* Every open search has its share of the processes. */
static floe_status want_of_searches(searching *r)
{
    const stability *s = r->s;
    const size_t jobs = r->o->batch.jobs > 0 ? (size_t)r->o->batch.jobs : 1;
    double x[SEARCH_MOST];
    size_t open = 0;
    for (size_t k = 0; k < s->n_sets; k++) open += is_open(&s->set[k]);
    TRY(reserve_probes(r, open * SEARCH_MOST));
    const size_t share = open > 0 ? jobs / open : 0;
    for (size_t k = 0; k < s->n_sets; k++) {
        if (!is_open(&s->set[k])) continue;
        const size_t found = search_next(&s->set[k].search, share < 1 ? 1 : share > 15 ? 15 : share, x);
        for (size_t i = 0; i < found; i++) want_probe(r, stability_probe_at(s, k, x[i]));
    }
    return FLOE_OK;
}

static floe_status want_map(searching *r)
{
    const size_t cells = crossed_count(r->s->over, 2), n = r->mapped ? 0 : r->s->n_sets * cells;
    TRY(reserve_probes(r, n));
    for (size_t i = 0; i < n; i++) want_probe(r, stability_probe_of_map(r->s, i / cells, i % cells));
    r->mapped = true;
    return FLOE_OK;
}

static floe_status want_next_of_stability(void *of, case_round *round)
{
    searching *r = of;
    stability *s = r->s;
    TRY(stability_is_map(s) ? want_map(r) : want_of_searches(r));
    stability_cases_free(s->ctx, &r->cases);
    TRY(stability_cases_make(&r->cases, s, r->o, s->probe + s->n_probes, r->n));
    *round = (case_round){stability_batch(s, r->o), r->cases.list, r->n};
    return FLOE_OK;
}

/* Those that have ended move up behind the ones before. */
static floe_status take_probes(void *of, const case_round *round)
{
    searching *r = of;
    stability *s = r->s;
    const bool stopped = r->o->batch.stop && *r->o->batch.stop;
    for (size_t i = 0, first = s->n_probes; i < round->n; i++) {
        const batch_case *one = &round->list[i];
        /* A run that failed as all were stopped has failed for that. */
        if (one->state != BATCH_ENDED || (stopped && one->status != FLOE_OK && one->status != FLOE_DIVERGED)) continue;
        s->probe[s->n_probes] = s->probe[first + i];
        TRY(stability_judge_case(s, &s->probe[s->n_probes], one));
        s->n_probes++;
    }
    return FLOE_OK;
}

static floe_status write_stability_results(void *of)
{
    const searching *r = of;
    TRY(stability_write(r->s));
    return stability_plot(r->s);
}

/* A search that has ended without a verdict is no success. */
static floe_status check_verdicts(void *of)
{
    const stability *s = ((const searching *)of)->s;
    for (size_t i = 0; i < s->n_probes; i++) {
        const stability_probe *p = &s->probe[i];
        if (!s->set[p->set].broken || p->verdict != VERDICT_NONE) continue;
        return fail(s->ctx, FLOE_INTERNAL, "the run in '%s/%s' gave no verdict: %s", s->dir, p->folder, p->cause);
    }
    return FLOE_OK;
}

static floe_status run_stability(stability *s, const stability_options *o)
{
    static const case_judge judge = {want_next_of_stability, take_probes, write_stability_results, check_verdicts};
    searching r = {.s = s, .o = o};
    TRY(stability_setup(s, o));
    const floe_status status = judge_cases(s->ctx, &judge, &r);
    stability_cases_free(s->ctx, &r.cases);
    return status;
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
