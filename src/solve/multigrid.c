#include "base/memory.h"
#include "solve/multigrid_level.h"

#include <string.h>

floe_status multigrid_new(multigrid **out, context *ctx, const multigrid_kind *kind)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->ctx = ctx;
    (*out)->kind = kind;
    return FLOE_OK;
}

floe_status multigrid_add(multigrid *m, size_t size, size_t bytes, void *own)
{
    multigrid_level *l = &m->level[m->n++];
    l->size = size;
    TRY(memory_new(m->ctx, &l->own, 1, bytes));
    *(void **)own = l->own;
    TRY(memory_new(m->ctx, &l->x, size, sizeof(double)));
    return m->n == 1 ? FLOE_OK : memory_new(m->ctx, &l->b, size, sizeof(double));
}

void multigrid_destroy(multigrid **m)
{
    if (!m || !*m) return;
    context *ctx = (*m)->ctx;
    for (int k = 0; k < (*m)->n; ++k) {
        multigrid_level *l = &(*m)->level[k];
        if (l->own) (*m)->kind->free(ctx, l->own);
        memory_free(ctx, &l->own);
        memory_free(ctx, &l->x);
        memory_free(ctx, &l->b);
    }
    memory_free(ctx, m);
}

floe_status multigrid_prepare(multigrid *m)
{
    const multigrid_kind *kind = m->kind;
    for (m->last = 0; m->last + 1 < m->n && !kind->is_last(&m->level[m->last]); ++m->last)
        TRY(kind->coarsen(&m->level[m->last], &m->level[m->last + 1]));
    return kind->prepare_last(&m->level[m->last]);
}

void multigrid_apply(void *user, double *x, double *y)
{
    const multigrid *m = user;
    m->kind->apply(&m->level[0], x, y);
}

/* Down to the last level and up again. */
void multigrid_cycle(void *user, double *x, double *y)
{
    const multigrid *m = user;
    const multigrid_level *l = m->level;
    for (int k = 0; k < m->last; ++k) {
        const double *b = k == 0 ? x : l[k].b;
        m->kind->smooth(&l[k], b, true);
        m->kind->restrict_residual(&l[k], b, &l[k + 1]);
    }
    m->kind->solve(&l[m->last], m->last == 0 ? x : l[m->last].b);
    for (int k = m->last - 1; k >= 0; --k) {
        m->kind->prolong_correction(&l[k], &l[k + 1]);
        m->kind->smooth(&l[k], k == 0 ? x : l[k].b, false);
    }
    memcpy(y, l[0].x, l[0].size * sizeof *y);
}
