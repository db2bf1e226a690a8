/* The equilibrium of several fluids outside of a step that counts: taken back when a step is rejected, and made anew
 * for output. */
#include "ice/ice_internal.h"

#include <string.h>

static void copy_cells(const ice_view *v, double *to, const double *from)
{
    memcpy(to, from, v->b->size * sizeof *to);
}

void ice_save_found(ice *s, int block_id, const ice_view *v)
{
    if (!s->work->reconcile) return;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_arrays *m = &v->m[r];
        if (!m->e_found) continue;
        copy_cells(v, m->e_found, m->e);
        copy_cells(v, m->vol_found, m->vol);
    }
    s->work->found[block_id] = s->step + 1;
}

void ice_rollback_step(ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        if (s->work->found[id] != s->step + 1) continue;
        ice_view v;
        ice_view_make(s, id, &v);
        for (int r = 0; r < v.n_materials; ++r) {
            const ice_arrays *m = &v.m[r];
            if (!m->e_found) continue;
            copy_cells(&v, m->e, m->e_found);
            copy_cells(&v, m->vol, m->vol_found);
        }
        s->work->found[id] = 0;
    }
}

/* A state in which no pressure fills a cell keeps the fractions of the last step; the next step will say what is wrong
 * with it. */
floe_status ice_refresh(ice *s)
{
    if (!s->multi || s->sealed) return FLOE_OK;
    const ledger counted = *s->ledger;
    floe_status status = ice_boundary_ghosts(s);
    if (status == FLOE_OK) status = ice_equilibrium_pressure(s);
    ice_rollback_step(s);
    *s->ledger = counted;
    if (status != FLOE_RETRY) return status;
    context_clear(s->ctx);
    return FLOE_OK;
}
