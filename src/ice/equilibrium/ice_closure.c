/* Storage of the closure of cells with several materials. Equilibrium outside of a step: restored when a step is rejected, and computed for output. */
#include "ice/equilibrium/ice_closure.h"
#include "ice/state/ice_lists.h"

#include "base/memory.h"
#include "base/threads.h"

#include <string.h>

floe_status ice_closure_create(ice *s)
{
    TRY(memory_new(s->ctx, &s->closure, 1, sizeof *s->closure));
    ice_closure *w = s->closure;
    w->threads = threads_most();
    TRY(memory_new(s->ctx, &w->cells, (size_t)w->threads, sizeof *w->cells));
    TRY(memory_new(s->ctx, &w->set, (size_t)w->threads, sizeof *w->set));
    for (int t = 0; t < w->threads; ++t)
        TRY(memory_new(s->ctx, &w->set[t], (size_t)s->mesh->n[0] + 8, sizeof(unsigned)));
    for (int g = 0; g < s->n_regions; ++g)
        if (s->region[g].n > 1) TRY(ice_lists_create(s, w->mixed[g]));
    return FLOE_OK;
}

void ice_closure_destroy(context *ctx, ice_closure **closure)
{
    ice_closure *w = *closure;
    if (!w) return;
    for (int g = 0; g < ICE_MAX_MATERIALS; ++g) ice_lists_destroy(ctx, w->mixed[g]);
    for (int t = 0; w->set && t < w->threads; ++t) memory_free(ctx, &w->set[t]);
    memory_free(ctx, &w->set);
    memory_free(ctx, &w->cells);
    memory_free(ctx, closure);
}

const ice_cell_list *ice_mixed_cells(const ice *s, const ice_view *v)
{
    return &s->closure->mixed[v->region][v->b->id];
}

static void copy_cells(const ice_view *v, double *to, const double *from)
{
    memcpy(to, from, v->b->size * sizeof *to);
}

void ice_save_found(ice *s, int block_id, const ice_view *v)
{
    if (!v->reconcile) return;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        if (!m->e_found) continue;
        copy_cells(v, m->e_found, m->e);
        copy_cells(v, m->vol_found, m->vol);
    }
    s->closure->saved[v->region][block_id] = s->step + 1;
}

static void rollback_region(ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        long *saved = &s->closure->saved[g->number][v.b->id];
        if (*saved != s->step + 1) continue;
        for (int r = 0; r < v.n_materials; ++r) {
            const ice_fluid *m = &v.m[r];
            if (!m->e_found) continue;
            copy_cells(&v, m->e, m->e_found);
            copy_cells(&v, m->vol, m->vol_found);
        }
        *saved = 0;
    }
}

void ice_rollback_closure(ice *s)
{
    for (int g = 0; g < s->n_regions && s->closure; ++g) rollback_region(s, &s->region[g]);
}

/* A state in which no pressure fills a cell keeps the fractions of the last step; the next step will say what is wrong
 * with it. */
floe_status ice_refresh(ice *s)
{
    if (!ice_is_mixture(s)) return FLOE_OK;
    const ledger counted = *s->ledger;
    floe_status status = ice_boundary_ghosts(s);
    if (status == FLOE_OK) status = ice_equilibrium_pressure(s);
    ice_rollback_closure(s);
    *s->ledger = counted;
    if (status != FLOE_RETRY) return status;
    context_clear(s->ctx);
    return FLOE_OK;
}
