/* Chains that end on a periodic side, where another, or the same, begins on the opposite one: they are one. */
#include "geom/contour_internal.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* Of a cell: ends this near are one place. */
static const double one_place = 1e-6;

/* Whether y is x on the opposite side of a periodic axis. */
static bool is_image(const seed_spec *g, const double x[2], const double y[2])
{
    for (int a = 0; a < 2; ++a) {
        const double length = g->n[a] * g->h[a], near = one_place * g->h[a];
        if (g->periodic[a] && fabs(fabs(x[a] - y[a]) - length) < near &&
            fabs(x[1 - a] - y[1 - a]) < one_place * g->h[1 - a])
            return true;
    }
    return false;
}

/* The open chain that goes on where another ends; o->n_chains: none. */
static size_t chain_after(const contour *o, const seed_spec *g, size_t chain)
{
    const contour_chain *c = &o->chain[chain];
    const double *end = o->x[c->first + c->n - 1];
    size_t next = 0;
    for (; next < o->n_chains; ++next)
        if (!o->chain[next].closed && is_image(g, end, o->x[o->chain[next].first])) break;
    return next;
}

typedef struct joiner {
    contour *from, to; /* of `to` both arrays are as large as those of `from` */
    size_t *after;     /* of each chain */
    bool *followed, *done;
} joiner;

/* One chain of those that follow a first one; each gives its last point for the first of the next. */
static void join_from(joiner *j, size_t first)
{
    const contour *o = j->from;
    contour_chain *out = &j->to.chain[j->to.n_chains++];
    *out = o->chain[first];
    out->first = j->to.n;
    for (size_t c = first; c < o->n_chains && !j->done[c]; c = j->after[c]) {
        const bool goes_on = j->after[c] < o->n_chains;
        const size_t n = o->chain[c].n - goes_on;
        memcpy(j->to.x[j->to.n], o->x[o->chain[c].first], n * sizeof *o->x);
        j->to.n += n;
        j->done[c] = true;
        out->closed = out->closed || (goes_on && j->after[c] == first);
    }
    out->n = j->to.n - out->first;
}

static void join_all(joiner *j, const seed_spec *grid)
{
    const size_t n = j->from->n_chains;
    for (size_t c = 0; c < n; ++c) j->after[c] = j->from->chain[c].closed ? n : chain_after(j->from, grid, c);
    for (size_t c = 0; c < n; ++c)
        if (j->after[c] < n) j->followed[j->after[c]] = true;
    for (int pass = 0; pass < 2; ++pass) /* those that begin on a side; then rings */
        for (size_t c = 0; c < n; ++c)
            if (!j->done[c] && (pass == 1 || !j->followed[c])) join_from(j, c);
}

floe_status contour_join_around(context *ctx, contour *o, const seed_spec *grid)
{
    joiner j = {.from = o};
    if (o->n == 0 || !(grid->periodic[0] || grid->periodic[1])) return FLOE_OK;
    floe_status status = memory_new(ctx, &j.to.x, o->n, sizeof *j.to.x);
    if (status == FLOE_OK) status = memory_new(ctx, &j.to.chain, o->n_chains, sizeof *j.to.chain);
    if (status == FLOE_OK) status = memory_new(ctx, &j.after, o->n_chains, sizeof *j.after);
    if (status == FLOE_OK) status = memory_new(ctx, &j.followed, 2 * o->n_chains, sizeof *j.followed);
    if (status == FLOE_OK) {
        j.done = j.followed + o->n_chains;
        join_all(&j, grid);
        contour_free(ctx, o);
        *o = j.to;
    } else
        contour_free(ctx, &j.to);
    memory_free(ctx, &j.after);
    memory_free(ctx, &j.followed);
    return status;
}
