/* The state of a gas in cells without it, of which differences near the boundary are taken (theory 7.1): marked cells keep their own, two layers
 * about them have the mean of their neighbours; velocities of a viscous fluid beside the implicit pressure those by which it sticks to the wall (7.8). */
#include "ice/cut/ice_merged_cells.h"

#include "ice/sides/ice_sides.h"
#include "ice/state/ice_walk.h"

/* Marks of cells that have a state, during the stage; stored in the array of the shock sensor. */
static void mark_open(const ice *s, const ice_region *g)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        const fluid_state *rest = &s->cut_cells->rest[g->number];
        const ice_fluid *m = &v->m[0];
        const ice_rows q = ice_rows_of(v->b, -1, 0);
        for (int row = 0; row < q.n; ++row)
            for (int i = 0; i < v->b->n[0]; ++i) {
                const int j = ice_row_j(q, row), k = ice_row_k(q, row);
                const ptrdiff_t at = mesh_index(v->b, i, j, k);
                v->shock[at] = m->open[at] > 0.0 ? 1.0 : 0.0;
                if (m->open[at] > 0.0) continue;
                if (v->multi) {
                    ice_rest_fluids(s, v, at);
                    continue;
                }
                m->rho[at] = rest->density;
                m->e[at] = rest->energy;
                for (int a = 0; a < s->mesh->dim; ++a) m->u[a][at] = 0.0;
            }
    }
}

static void fill_state(const ice *s, const ice_region *g)
{
    ice_fill_state(s, g->first, g->n);
    ice_fill_ghosts(s, C_SHOCK, g->number, FILL_CURRENT, GHOST_EVEN);
}

/* Extrapolates a state into a cell without the gas: the mean of its neighbours with marks of at least `least`. */
static void extrapolate_state(const ice_view *v, ptrdiff_t at, double least)
{
    const ice_fluid *m = &v->m[0];
    double n = 0.0, rho = 0.0, e = 0.0, u[3] = {0.0};
    const int around = v->b->dim == 1 ? 3 : v->b->dim == 2 ? 9 : 27;
    for (int c = 0; c < around; ++c) {
        const ptrdiff_t from = at + ice_step_to(v->b, c);
        if (!(v->shock[from] >= least)) continue;
        n += 1.0;
        rho += m->rho[from];
        e += m->e[from];
        for (int a = 0; a < v->b->dim; ++a) u[a] += m->u[a][from];
    }
    if (n == 0.0) return;
    m->rho[at] = rho / n;
    m->e[at] = e / n;
    for (int a = 0; a < v->b->dim; ++a) m->u[a][at] = u[a] / n;
    v->shock[at] = 0.5 * least;
}

/* Two layers: as far as differences reach. */
static void extrapolate_layers(const ice *s, const ice_region *g)
{
    double least = 1.0;
    for (int layer = 0; layer < 2; ++layer, least *= 0.5) {
        fill_state(s, g);
        for (int id = 0; id < s->mesh->n_blocks; ++id) {
            const ice_view *v = &s->cut_cells->view[id];
            const ice_rows q = ice_rows_of(v->b, -1, 0);
            for (int row = 0; row < q.n; ++row) {
                const ptrdiff_t base = mesh_index(v->b, 0, ice_row_j(q, row), ice_row_k(q, row));
                for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at)
                    if (v->shock[at] < least) (v->multi ? ice_extrapolate_fluids : extrapolate_state)(v, at, least);
            }
        }
    }
}

floe_status ice_extrapolate_states(ice *s, const ice_region *g)
{
    TRY(ice_merge_cells(s, MERGE_BEFORE, &s->cut_cells->now[g->number]));
    ice_cut_views(s, g);
    if (g->n > 1) TRY(ice_remerge_fluids(s, g));
    mark_open(s, g);
    extrapolate_layers(s, g);
    if (g->n > 1) ice_join_covered(s, g);
    for (int r = g->first; g->n > 1 && s->implicit && r < g->first + g->n; ++r)
        ice_fill_ghosts(s, C_OPEN, r, FILL_CURRENT, GHOST_EVEN); /* weight is borne evenly beside covered cells */
    return FLOE_OK;
}

void ice_fill_changed(const ice *s, const ice_region *g)
{
    ice_fill_ghosts(s, C_VEL, g->first, FILL_CURRENT, GHOST_VELOCITY);
    ice_fill_ghosts(s, C_ENERGY, g->first, FILL_CURRENT, GHOST_ENERGY);
}

bool ice_covered_stick(const ice *s)
{
    return s->implicit && ice_is_viscous(s) && !ice_is_mixture(s);
}

void ice_stick_covered(const ice *s, const ice_region *g)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        const ice_fluid *m = &v->m[0];
        for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);)
            for (int a = 0; a < v->dim && !(m->open[c.at] > 0.0); ++a) m->u[a][c.at] = m->centred[a][c.at];
    }
    ice_fill_ghosts(s, C_VEL, g->first, FILL_CURRENT, GHOST_VELOCITY);
}

bool ice_keeps_sticking(const ice *s, const ice_merged_cells *p, const ice_member *m)
{
    if (m->open > 0.0 || !ice_covered_stick(s)) return false;
    for (int place = 0; place < CUT_PLACES; ++place)
        if (ice_open_cell(s, p->region->number, place, m->cell) > 0.0) return false;
    return true;
}
