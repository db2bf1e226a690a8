/* Pieces of boundaries (ice_merged_pieces.h), and the response of the pressure on them to their motion in the step (theory 7.6):
 * merged cells take the change of pressure that is found with the inertia behind the pieces (coupling/wall_response.h). */
#include "ice/cut/ice_merged_pieces.h"

#include "coupling/wall_response.h"
#include "ice/flux/ice_flux.h"
#include "ice/ice_constants.h"
#include "ice/pressure/ice_pressure.h"

#include <math.h>

ice_merged_cells *ice_merged_cells_of(const ice *s, const ice_region *g)
{
    return &s->cut_cells->now[g->number];
}

double ice_merged_sound(const ice_view *v, ptrdiff_t at)
{
    return v->multi ? sqrt(1.0 / (v->kappa_sum[at] * v->rho_sum[at])) : v->m[0].c[at];
}

ice_piece_walk ice_first_piece(const ice *s, const ice_merged_cells *p)
{
    return (ice_piece_walk){.s = s, .p = p, .place = CUT_MEAN, .n = -1, .weight = 1.0 / ICE_CUT_PREDICTED};
}

bool ice_next_piece(ice_piece_walk *w)
{
    const ice_embedded *set = &w->s->embedded;
    for (w->n++; w->number < set->n_boundaries; w->number++, w->place = CUT_MEAN, w->n = 0) {
        const ice_embedded_boundary *line = &set->boundary[w->number];
        w->outward = ice_outward(w->s, w->p->region->number, w->number);
        if (w->outward == 0.0) continue;
        for (; w->place < CUT_NEXT && w->n >= line->place[w->place].n_pieces; w->place++) w->n = 0;
        if (w->place == CUT_NEXT) continue;
        const cut_surface *c = &line->place[w->place];
        w->line = line;
        w->piece = &c->piece[w->n];
        w->member = &w->p->member[w->p->place[cut_index(c->mesh, c->cell[w->piece->cell].cell)]];
        return true;
    }
    return false;
}

double ice_at_middle(const cut_piece *q, int dim, const double *vertex, int a)
{
    double sum = q->weight[0] * vertex[3 * q->vertex[0] + a];
    for (int k = 1; k < dim; ++k) sum += q->weight[k] * vertex[3 * q->vertex[k] + a];
    return sum;
}

double ice_along_area(const ice_piece_walk *w, const double *vertex)
{
    const cut_piece *q = w->piece;
    double sum = 0.0;
    for (int a = 0; a < w->s->mesh->dim; ++a) sum += q->area[a] * ice_at_middle(q, w->s->mesh->dim, vertex, a);
    return w->outward * sum;
}

/* Adds a volume flux (m3/s, outward on the upper side) to a member's face, in all blocks that have it. */
static void add_to_face(const ice *s, const ice_member *m, int axis, int side, double flux)
{
    const double velocity = (side == SIDE_UPPER ? flux : -flux) / ice_member_area(s, m, axis, side);
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        const block *b = v->b;
        int at[3] = {m->cell[0] - b->lo[0], m->cell[1] - b->lo[1], m->cell[2] - b->lo[2]};
        at[axis] += side == SIDE_UPPER;
        bool has = true;
        for (int a = 0; a < s->mesh->dim; ++a) has = has && at[a] >= 0 && at[a] < b->n[a] + (a == axis);
        if (!has) continue;
        const ptrdiff_t face = mesh_index(b, at[0], at[1], at[2]);
        for (int r = 0; r < v->n_materials; ++r) v->m[r].fu[axis][face] += velocity;
        if (v->multi) v->flux[axis][face] += velocity;
    }
}

void ice_merged_sweep(const ice *s, const ice_region *g)
{
    bool swept = false;
    for (ice_piece_walk w = ice_first_piece(s, ice_merged_cells_of(s, g)); ice_next_piece(&w);) {
        const int face = w.piece->through - 1;
        if (face < 0) continue;
        add_to_face(s, w.member, face / 2, face % 2, w.weight * ice_along_area(&w, w.line->path) / s->dt);
        swept = true;
    }
    if (swept && g->n > 1) ice_bound_swept(s, g);
}

/* What the increment of ice_merged_step.c makes of more flux. */
static void set_wall_cell(const ice *s, const ice_merged_cells *p, int merged, wall_cell *out)
{
    const ice_member *lead = &p->member[p->lead[merged]];
    const ice_view *v = ice_member_view(s, lead);
    const double *sum = p->sum + (size_t)merged * MERGED_SUMS, volume = sum[MERGED_VOLUME];
    const double rho = v->rho_sum[lead->at], c = ice_merged_sound(v, lead->at);
    if (!(volume > 0.0)) return;
    out->stiffness = s->dt * rho * c * c / volume;
    out->per_flux = v->finest / volume;
    out->squeeze = -out->per_flux * sum[MERGED_FLUX];
    out->linear = ICE_SHOCK_LINEAR * rho * c;
    out->square = ICE_SHOCK_QUADRATIC * rho;
}

static floe_status add_region(ice *s, const ice_region *g)
{
    const ice_merged_cells *p = ice_merged_cells_of(s, g);
    const int first = s->walls->n_cells;
    ice_cut_views(s, g);
    TRY(wall_response_add_cells(s->walls, p->count));
    for (int k = 0; k < p->count; ++k) set_wall_cell(s, p, k, &s->walls->cell[first + k]);
    for (ice_piece_walk w = ice_first_piece(s, p); ice_next_piece(&w);) {
        const int cell = first + w.member->merged;
        if (!(s->walls->cell[cell].stiffness > 0.0)) continue;
        for (int k = 0; k < s->mesh->dim; ++k) {
            double area[3] = {0.0};
            for (int a = 0; a < s->mesh->dim; ++a)
                area[a] = w.weight * w.outward * w.piece->weight[k] * w.piece->area[a];
            TRY(wall_response_add_push(s->walls, cell, w.piece->vertex[k], area));
        }
    }
    return FLOE_OK;
}

floe_status ice_merged_response(ice *s)
{
    wall_response_clear(s->walls);
    for (int g = 0; g < s->n_regions; ++g) TRY(add_region(s, &s->region[g]));
    return FLOE_OK;
}

/* Adds the changes of wall pressure, which the solids have found, to the cells and faces. */
floe_status ice_cut_wall_pressure(ice *s)
{
    const wall_cell *cell = s->walls->cell;
    for (int n = 0; n < s->n_regions; ++n) {
        const ice_region *g = &s->region[n];
        const ice_merged_cells *p = ice_merged_cells_of(s, g);
        ice_cut_views(s, g);
        for (int k = 0; k < p->n; ++k) {
            const ice_view *v = ice_member_view(s, &p->member[k]);
            const wall_cell *of = &cell[p->member[k].merged];
            v->P[p->member[k].at] += of->change;
            v->dP[p->member[k].at] -= of->stiffness * of->flux;
        }
        cell += p->count;
        ice_fill_increment(s, g);
        TRY(ice_face_pressure_of(s, g));
    }
    return FLOE_OK;
}
