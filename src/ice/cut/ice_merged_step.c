/* The step of merged cells (ice_merged_cells.h): the pressure increment of theory 2.3 and the Lagrangian values of 2.6 and 2.8, for cells with partly closed
 * faces and a moving wall. The pressure on the wall is P of the merged cells:
 *
 *     dP = -(dt/V) [sum_f A_f u* + sum_w A_w . v] / S                             V, A_f: what is open
 *     M du = -dt [sum_f A_f (P* - P)]                                            since sum_f A_f + sum_w A_w = 0
 *     M de = -dt sum_f A_f u* P* - P sum_w A_w . d - M du . (u + u^L)/2           d: the displacement of the wall in the step
 *
 * Under gravity P is linear within the merged cells: dP has the value at their centre, the other sums have that at the face or piece, so that they include
 * the weight of the cells (ice_merged_weight.c). A viscous fluid sticks to the wall: the shear force over half a cell, theta mu |A_w| (u - v)/(h/2), acts on
 * wall and fluid in opposite directions. Heat that a fluid conducts to it is ice_wall_heat.c's. Where there is no gas on its other side, the reference pressure acts there. */
#include "ice/cut/ice_merged_cells.h"
#include "ice/cut/ice_merged_pieces.h"
#include "ice/cut/ice_wall_flow.h"

#include "ice/exchange/ice_exchange.h"
#include "ice/ice_constants.h"
#include "ice/shock/ice_shock.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_walk.h"

#include <math.h>
#include <string.h>

/* Area (m2) of the whole lower or upper face of a member's cell. */
double ice_member_area(const ice *s, const ice_member *k, int axis, int side)
{
    return mesh_face_area(s->mesh, axis, k->cell[0] + (axis == 0 && side == SIDE_UPPER));
}

ptrdiff_t ice_member_face(const ice_view *v, const ice_member *k, int axis, int side)
{
    return k->at + (side == SIDE_UPPER ? v->b->stride[axis] : 0);
}

/* Of the middle of a piece from the centre of its cell. */
static void from_centre(const ice_piece_walk *w, double x[3])
{
    const cut_surface *c = &w->line->place[w->place];
    const cut_piece *q = w->piece;
    for (int a = 0; a < w->s->mesh->dim; ++a)
        x[a] = cut_at_middle(c, q, a) - mesh_centre(w->s->mesh, a, w->member->cell[a]);
}

/* Pressure of the current gas on a piece. */
static double pressure_on(const ice_piece_walk *w)
{
    const double P = ice_member_view(w->s, w->member)->P[w->member->at];
    double x[3];
    if (!ice_has_weight(w->s)) return P;
    from_centre(w, x);
    return P + ice_rise_to_piece(w->s, w->p, w->member, x) - ice_merged_rise(w->s, w->p, w->member);
}

/* Force (N) of the fluids on a piece: their pressure, and the drag of each. */
typedef struct piece_force {
    double all[3], drag[ICE_MAX_MATERIALS][3];
} piece_force;

static wall_place place_of(const ice_piece_walk *w)
{
    const cut_surface *c = &w->line->place[w->place];
    wall_place to = {.cell = w->member->cell, .T = ice_wall_temperature(w->s, w->line, w->piece)};
    for (int a = 0; a < w->s->mesh->dim; ++a) {
        to.x[a] = cut_at_middle(c, w->piece, a);
        to.v[a] = ice_at_middle(w->piece, w->s->mesh->dim, w->line->velocity, a);
        to.area[a] = w->outward * w->piece->area[a];
    }
    return to;
}

static void force_on(const ice_piece_walk *w, piece_force *f)
{
    const ice *s = w->s;
    const cut_piece *q = w->piece;
    const ptrdiff_t at = w->member->at;
    const ice_view *v = ice_member_view(s, w->member);
    const double P = pressure_on(w);
    for (int a = 0; a < s->mesh->dim; ++a) f->all[a] = w->outward * P * q->area[a];
    if (!ice_is_viscous(s)) {
        memset(f->drag, 0, sizeof f->drag);
        return;
    }
    const wall_place place = place_of(w);
    for (int r = 0; r < v->n_materials; ++r) {
        const double share = v->multi ? v->m[r].theta[at] : 1.0;
        double drag[3];
        ice_wall_drag(s, w->p->region, r, &place, drag);
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double before = f->all[a];
            f->all[a] = before + share * drag[a];
            f->drag[r][a] = f->all[a] - before; /* what the fluid loses is what the piece has, to the bit */
        }
    }
}

/* All of a merged cell is one whole cell of the mesh: the wall lies on its faces. */
static bool is_one_cell(const ice *s, const ice_merged_cells *p, int merged)
{
    const ice_member *lead = &p->member[p->lead[merged]];
    return lead->open == 1.0 && p->sum[(size_t)merged * MERGED_SUMS + MERGED_VOLUME] <=
                                    (1.0 + ICE_OPEN_ROUND_OFF) * mesh_cell_volume(s->mesh, lead->cell[0]);
}

void ice_merged_centring(const ice *s, const ice_region *g)
{
    ice_merged_cells *p = ice_merged_cells_of(s, g);
    const bool stick = ice_covered_stick(s);
    ice_cut_views(s, g);
    if (stick) {
        ice_clear_merged(p);
        ice_sum_open_volumes(s, p);
    }
    for (int k = 0; k < p->n; ++k)
        if (!(stick && is_one_cell(s, p, p->member[k].merged)))
            ice_member_view(s, &p->member[k])->shock[p->member[k].at] = 1.0;
    /* A whole cell that has pieces of its neighbour, as cells that walls cut (theory 7.2). */
    for (ice_piece_walk w = ice_first_piece(s, p); ice_next_piece(&w);)
        if (w.piece->through > 0) ice_member_view(s, w.member)->shock[w.member->at] = 1.0;
}

void ice_merged_fluxes(const ice *s, ice_merged_cells *p)
{
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        const ice_view *v = ice_member_view(s, m);
        double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        sum[MERGED_VOLUME] += m->open * mesh_cell_volume(s->mesh, m->cell[0]);
        for (int f = 0; f < 2 * s->mesh->dim; ++f) {
            const int axis = f / 2, side = f % 2;
            const double out = side == SIDE_UPPER ? 1.0 : -1.0;
            sum[MERGED_FLUX] += out * m->face[axis][side] * ice_member_area(s, m, axis, side) *
                                v->flux[axis][ice_member_face(v, m, axis, side)];
        }
    }
    for (ice_piece_walk w = ice_first_piece(s, p); ice_next_piece(&w);)
        p->sum[(size_t)w.member->merged * MERGED_SUMS + MERGED_FLUX] += w.weight * ice_along_area(&w, w.line->velocity);
}

void ice_still_elsewhere(const ice *s, const ice_merged_cells *p)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);) {
            if (v->m[0].open[c.at] > 0.0 || p->place[cut_index(s->mesh, c.cell)] >= 0) continue;
            v->dP[c.at] = 0.0;
            v->P[c.at] = v->p[c.at];
        }
    }
}

/* Where no gas is, between solids in contact, nothing pushes them beside the contact, whose stress is against the reference pressure. */
static void fill_void(const ice *s, const ice_view *v, ptrdiff_t at)
{
    v->dP[at] = 0.0;
    v->P[at] = s->scene->reference_pressure;
}

void ice_merged_increment(const ice *s, const ice_region *g)
{
    ice_merged_cells *p = ice_merged_cells_of(s, g);
    ice_cut_views(s, g);
    ice_merged_fluxes(s, p);
    if (g->n > 1) ice_still_elsewhere(s, p);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k], *lead = &p->member[p->lead[m->merged]];
        const ice_view *v = ice_member_view(s, m), *of = ice_member_view(s, lead);
        const double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        if (!(sum[MERGED_VOLUME] > 0.0)) {
            fill_void(s, v, m->at);
            continue;
        }
        const double rho = of->rho_sum[lead->at], c = ice_merged_sound(of, lead->at);
        const double div = sum[MERGED_FLUX] / sum[MERGED_VOLUME];
        const double squeeze = div < 0.0 ? -v->finest * div : 0.0, dP = -s->dt * div * rho * c * c;
        v->dP[m->at] = dP;
        const double p0 = ice_has_weight(s) ? v->p[m->at] : of->p[lead->at];
        v->P[m->at] = p0 + dP + ice_bulk_pressure(rho, c, squeeze, 1.0);
        if (ice_reaction_count(s) > 0) v->P[m->at] += ice_created_pressure_at(s, of, lead->at);
    }
}

/* Gravity's part of the pressure inside merged cells on a face of a member; its impulse is their weight. */
static double add_weight(const ice *s, const ice_merged_cells *p, const ice_member *m, int axis, int side, double area,
                         double *sum)
{
    if (!ice_has_weight(s)) return 0.0;
    const double rise = ice_rise_to_face(s, p, m, axis, side);
    sum[MERGED_WEIGHT + axis] += area * m->face[axis][side] * rise;
    return rise - ice_merged_rise(s, p, m);
}

/* Where stresses and heat of a fluid of merged cells are summed: among several it has sums of its own. */
typedef struct stress_sums {
    double *momentum, *work;
} stress_sums;

static stress_sums stress_sums_of(const ice_merged_cells *p, int merged, int r)
{
    double *sum = p->sum + (size_t)merged * MERGED_SUMS;
    if (!p->fluid) return (stress_sums){sum + MERGED_MOMENTUM, sum + MERGED_WORK};
    double *own = p->fluid + (size_t)(merged * p->region->n + r) * FLUID_SUMS;
    return (stress_sums){own + FLUID_MOMENTUM, own + FLUID_ENERGY};
}

/* Of a face: area, times the step, positive on the upper side. */
static void add_face_stress(const ice *s, const ice_merged_cells *p, const ice_member *m, int axis, mesh_side side,
                            double area)
{
    const ice_view *v = ice_member_view(s, m);
    const ptrdiff_t at = ice_member_face(v, m, axis, side);
    const int i = m->cell[0] - v->b->lo[0] + (axis == 0 && side == SIDE_UPPER);
    for (int r = 0; r < p->region->n; ++r) {
        const stress_sums to = stress_sums_of(p, m->merged, r);
        const ice_face_diffusion t = ice_cut_stress(v, r, axis, at, i),
                                 other = ice_stress_between(s, v, r, axis, at, i, side);
        for (int a = 0; a < s->mesh->dim; ++a) to.momentum[a] += area * m->face[axis][side] * (t.t[a] + other.t[a]);
        *to.work += area * m->face[axis][side] * (t.power + other.power);
    }
}

static void add_hoop(const ice *s, const ice_merged_cells *p, const ice_member *m)
{
    const ice_view *v = ice_member_view(s, m);
    for (int r = 0; r < p->region->n; ++r)
        stress_sums_of(p, m->merged, r).momentum[0] += s->dt * m->open * mesh_cell_volume(s->mesh, m->cell[0]) *
                                                       ice_cut_hoop(v, r, m->at, m->cell[0] - v->b->lo[0]);
}

/* Impulse and work of the faces of a member on its merged cells. */
static void add_faces(const ice *s, const ice_merged_cells *p, const ice_member *m, double *sum)
{
    const ice_view *v = ice_member_view(s, m);
    const bool diffuses = ice_has_diffusion(s);
    for (int f = 0; f < 2 * s->mesh->dim; ++f) {
        const int axis = f / 2, side = f % 2;
        const ptrdiff_t at = ice_member_face(v, m, axis, side);
        const double area = (side == SIDE_UPPER ? s->dt : -s->dt) * ice_member_area(s, m, axis, side);
        const double P = v->P[m->at] + add_weight(s, p, m, axis, side, area, sum);
        sum[MERGED_MOMENTUM + axis] -= area * m->face[axis][side] * (v->fp[axis][at] - P);
        sum[MERGED_WORK] -= area * v->flux[axis][at] * v->fp[axis][at]; /* the flux is of the open part by now */
        if (diffuses && m->face[axis][side] > 0.0) add_face_stress(s, p, m, axis, (mesh_side)side, area);
    }
    if (diffuses && m->open > 0.0) add_hoop(s, p, m);
}

/* Stresses on the open faces of a member, times the step. */
static void add_open_stresses(const ice *s, const ice_merged_cells *p, const ice_member *m)
{
    for (int f = 0; f < 2 * s->mesh->dim; ++f) {
        const double area = (f % 2 == SIDE_UPPER ? s->dt : -s->dt) * ice_member_area(s, m, f / 2, f % 2);
        if (m->face[f / 2][f % 2] > 0.0) add_face_stress(s, p, m, f / 2, (mesh_side)(f % 2), area);
    }
    if (m->open > 0.0) add_hoop(s, p, m);
}

void ice_merged_diffusion_rates(const ice *s, const ice_region *g)
{
    ice_merged_cells *p = ice_merged_cells_of(s, g);
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        p->sum[(size_t)m->merged * MERGED_SUMS + MERGED_VOLUME] += m->open * mesh_cell_volume(s->mesh, m->cell[0]);
        add_open_stresses(s, p, m);
    }
    for (ice_piece_walk w = ice_first_piece(s, p); ice_next_piece(&w);) {
        const wall_place place = place_of(&w);
        const ice_view *v = ice_member_view(s, w.member);
        for (int r = 0; r < g->n; ++r) {
            const double share = w.weight * s->dt * (v->multi ? v->m[r].theta[w.member->at] : 1.0);
            double drag[3], *momentum = stress_sums_of(p, w.member->merged, r).momentum;
            ice_wall_drag(s, g, r, &place, drag);
            for (int a = 0; a < s->mesh->dim; ++a) momentum[a] -= share * drag[a];
        }
    }
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        const double time_volume = s->dt * p->sum[(size_t)m->merged * MERGED_SUMS + MERGED_VOLUME];
        for (int r = 0; r < g->n; ++r) {
            const double *momentum = stress_sums_of(p, m->merged, r).momentum;
            for (int a = 0; a < s->mesh->dim; ++a)
                ice_member_view(s, m)->m[r].diff[a][m->at] = time_volume > 0.0 ? momentum[a] / time_volume : 0.0;
        }
    }
}

/* Heat of an enclosed gas goes to its merged cells in proportion to their mass. */
static void add_gas_heat(const ice *s, ice_merged_cells *p)
{
    double mass = 0.0, heat = 0.0;
    for (int l = 0; l < s->embedded.n_boundaries; ++l)
        if (ice_encloses(s, l, p->region->number)) heat = s->embedded.boundary[l].heat;
    if (heat == 0.0) return;
    for (int n = 0; n < p->count; ++n) mass += p->sum[(size_t)n * MERGED_SUMS + MERGED_MASS];
    for (int n = 0; n < p->count && mass > 0.0; ++n) {
        double *sum = p->sum + (size_t)n * MERGED_SUMS;
        sum[MERGED_WORK] += heat * sum[MERGED_MASS] / mass;
    }
}

/* Pressure (Pa) outside the membranes where there is no gas; the stress of solids is against it. */
static double pressure_beyond(const ice *s)
{
    return s->n_regions == s->embedded.n_boundaries ? s->scene->reference_pressure : 0.0;
}

/* The same on the other side of a line: inside another there is its gas. */
static double pressure_behind(const ice *s, int line)
{
    return s->embedded.boundary[line].within < 0 ? pressure_beyond(s) : 0.0;
}

/* What the reference pressure does to the membranes about the current gas, or to the surfaces, in the step: into the
 * ledger. */
static void enter_surroundings(const ice *s, const ice_region *g)
{
    const bool radial = s->mesh->geometry == MESH_AXISYMMETRIC;
    double work = 0.0;
    if (pressure_beyond(s) == 0.0) return;
    for (ice_piece_walk w = ice_first_piece(s, ice_merged_cells_of(s, g)); ice_next_piece(&w);) {
        const double beyond = pressure_behind(s, w.number);
        if (beyond == 0.0) continue;
        double x[MESH_MAX_DIM] = {0.0};
        for (int a = 0; a < s->mesh->dim; ++a) x[a] = ice_at_middle(w.piece, s->mesh->dim, w.line->path, a);
        for (int a = radial; a < s->mesh->dim; ++a)
            ledger_push(s->ledger, LEDGER_BOUNDARY, a, -w.weight * s->dt * beyond * w.piece->area[a], x);
        work -= w.weight * beyond * ice_along_area(&w, w.line->path);
    }
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, work);
}

/* The drag of each fluid on a piece; its work is in that of all. */
static void add_drag(const ice_piece_walk *w, const piece_force *f)
{
    const ice *s = w->s;
    double *work = &w->p->sum[(size_t)w->member->merged * MERGED_SUMS + MERGED_WORK];
    for (int r = 0; r < w->p->region->n; ++r) {
        const stress_sums to = stress_sums_of(w->p, w->member->merged, r);
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double done = w->weight * f->drag[r][a] * ice_at_middle(w->piece, s->mesh->dim, w->line->path, a);
            to.momentum[a] -= w->weight * s->dt * f->drag[r][a];
            if (to.work == work) continue;
            *work += done;
            *to.work -= done;
        }
    }
}

/* Heat (W) that each fluid of the region conducts to a piece. */
static void heat_on(const ice_piece_walk *w, double heat[ICE_MAX_MATERIALS])
{
    const ice_view *v = ice_member_view(w->s, w->member);
    const wall_place place = place_of(w);
    for (int r = 0; r < w->p->region->n; ++r)
        heat[r] = (v->multi ? v->m[r].theta[w->member->at] : 1.0) * ice_wall_heat(w->s, w->p->region, r, &place);
}

static void take_wall_heat(const ice_piece_walk *w)
{
    double heat[ICE_MAX_MATERIALS];
    heat_on(w, heat);
    for (int r = 0; r < w->p->region->n; ++r)
        *stress_sums_of(w->p, w->member->merged, r).work -= w->weight * w->s->dt * heat[r];
}

static void add_mass(const ice *s, const ice_merged_cells *p, const ice_member *m, double *sum)
{
    const ice_member *lead = &p->member[p->lead[m->merged]];
    const ice_fluid *own = &ice_member_view(s, m)->m[0], *of = &ice_member_view(s, lead)->m[0];
    const double mass = ice_member_view(s, m)->rho_sum[m->at] * m->open * mesh_cell_volume(s->mesh, m->cell[0]);
    sum[MERGED_MASS] += mass;
    for (int a = 0; a < s->mesh->dim; ++a) sum[MERGED_DIFFERENCE + a] += mass * (own->u[a][m->at] - of->u[a][lead->at]);
}

static void add_merged_sources(const ice *s, ice_merged_cells *p)
{
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        add_mass(s, p, m, sum);
        add_faces(s, p, m, sum);
    }
    for (ice_piece_walk w = ice_first_piece(s, p); ice_next_piece(&w);) {
        const ice_member *m = w.member;
        double *sum = p->sum + (size_t)m->merged * MERGED_SUMS, x[3];
        piece_force f;
        from_centre(&w, x);
        force_on(&w, &f);
        for (int a = 0; a < s->mesh->dim; ++a) {
            if (ice_has_weight(s))
                sum[MERGED_WEIGHT + a] +=
                    w.weight * s->dt * w.outward * w.piece->area[a] * ice_rise_to_piece(s, p, m, x);
            sum[MERGED_WORK] -= w.weight * f.all[a] * ice_at_middle(w.piece, s->mesh->dim, w.line->path, a);
        }
        add_drag(&w, &f);
        if (s->heats_walls) take_wall_heat(&w);
    }
    add_gas_heat(s, p);
}

/* Lagrangian velocity and energy of merged cells. Where too little energy would remain, they have that of compression
 * alone (2.7), and the rest is entered as a defect. */
typedef struct merged_state {
    double du[3], e;
} merged_state;

void ice_enter_weight(const ice *s, const ice_member *lead, const double *sum, double work)
{
    double x[MESH_MAX_DIM] = {0.0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = mesh_centre(s->mesh, a, lead->cell[a]) - lead->above[a];
    for (int a = 0; a < s->mesh->dim; ++a)
        if (sum[MERGED_WEIGHT + a] != 0.0 && (a > 0 || s->mesh->geometry != MESH_AXISYMMETRIC))
            ledger_push(s->ledger, LEDGER_SOURCE, a, sum[MERGED_WEIGHT + a], x);
    if (work != 0.0) ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, work);
}

static merged_state advance_merged_cells(const ice *s, const ice_merged_cells *p, int merged)
{
    const ice_member *lead = &p->member[p->lead[merged]];
    const ice_view *v = ice_member_view(s, lead);
    const ice_fluid *m = &v->m[0];
    const double *sum = p->sum + (size_t)merged * MERGED_SUMS, mass = sum[MERGED_MASS],
                 floor = v->material[0].energy_floor;
    merged_state out = {.e = m->e[lead->at]};
    double u[3] = {0.0}, gain = 0.0, kinetic = 0.0, fallen = 0.0;
    if (!(mass > 0.0)) return out;
    for (int a = 0; a < s->mesh->dim; ++a) {
        u[a] = m->u[a][lead->at] + sum[MERGED_DIFFERENCE + a] / mass;
        const double du = sum[MERGED_MOMENTUM + a] / mass, next = u[a] + du;
        out.du[a] = du;
        gain += du * 0.5 * (u[a] + next);
        kinetic += 0.5 * next * next;
        if (sum[MERGED_WEIGHT + a] != 0.0) fallen += sum[MERGED_WEIGHT + a] * 0.5 * (u[a] + next);
    }
    const double rho = m->rho[lead->at], c = m->c[lead->at], before = out.e;
    ice_enter_weight(s, lead, sum, fallen);
    const double conserving = before + (sum[MERGED_WORK] + fallen) / mass - gain;
    const double plain = before + v->P[lead->at] * v->dP[lead->at] / (rho * rho * c * c);
    const bool usable =
        s->scene->method.conserve_energy && conserving - (isnan(floor) ? 0.0 : floor) > ICE_THERMAL_SHARE * kinetic;
    out.e = usable ? conserving : plain;
    if (!usable) {
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DEFECT, mass * (plain - conserving));
        ledger_tally(s->ledger, COUNT_ENERGY_GUARDS, 1);
    }
    return out;
}

/* Cells without the gas keep their state. */
static void keep_elsewhere(const ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        const ice_fluid *m = v->m;
        const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row) {
            const ptrdiff_t base = ice_row_start(v->b, q, row);
            for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at) {
                if (m[0].open[at] > 0.0) continue;
                for (int r = 0; r < v->n_materials; ++r) {
                    for (int a = 0; a < s->mesh->dim; ++a) m[r].ul[a][at] = m[r].u[a][at];
                    m[r].el[at] = m[r].e[at];
                }
                if (v->multi) v->owed[at] = 0.0;
            }
        }
    }
}

static void advance_fluid(const ice *s, ice_merged_cells *p)
{
    for (int merged = 0; merged < p->count; ++merged) {
        const merged_state now = advance_merged_cells(s, p, merged);
        double *sum = p->sum + (size_t)merged * MERGED_SUMS;
        for (int a = 0; a < s->mesh->dim; ++a) sum[MERGED_MOMENTUM + a] = now.du[a];
        sum[MERGED_WORK] = now.e;
    }
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        const ice_fluid *to = &ice_member_view(s, m)->m[0];
        const double *sum = p->sum + (size_t)m->merged * MERGED_SUMS;
        to->el[m->at] = sum[MERGED_WORK];
        if (ice_keeps_sticking(s, p, m)) continue;
        const ice_member *from = m->open > 0.0 ? m : &p->member[p->lead[m->merged]];
        const ice_fluid *of = &ice_member_view(s, from)->m[0];
        for (int a = 0; a < s->mesh->dim; ++a) to->ul[a][m->at] = of->u[a][from->at] + sum[MERGED_MOMENTUM + a];
    }
}

void ice_merged_sources(const ice *s, const ice_region *g)
{
    ice_merged_cells *p = ice_merged_cells_of(s, g);
    ice_cut_views(s, g);
    keep_elsewhere(s);
    ice_clear_merged(p);
    add_merged_sources(s, p);
    enter_surroundings(s, g);
    if (g->n > 1)
        ice_advance_fluids(s, p);
    else
        advance_fluid(s, p);
}

/* Shares a force on a piece out to the vertices between which it lies. */
static void push_vertices(const ice_piece_walk *w, const double force[3])
{
    const cut_piece *q = w->piece;
    for (int k = 0; k < w->s->mesh->dim; ++k)
        for (int a = 0; a < w->s->mesh->dim; ++a) w->line->force[3 * q->vertex[k] + a] += force[a] * q->weight[k];
}

/* The same of the heat that fluids conduct to it. */
static void warm_vertices(const ice_piece_walk *w)
{
    double heat[ICE_MAX_MATERIALS], all = 0.0;
    heat_on(w, heat);
    for (int r = 0; r < w->p->region->n; ++r) all += w->weight * heat[r];
    for (int k = 0; k < w->s->mesh->dim; ++k) w->line->heat_flow[w->piece->vertex[k]] += all * w->piece->weight[k];
}

/* Forces of a region on the boundaries beside it, and its heat into them. */
static void load_vertices(const ice *s, const ice_region *g)
{
    ice_cut_views(s, g);
    for (ice_piece_walk w = ice_first_piece(s, ice_merged_cells_of(s, g)); ice_next_piece(&w);) {
        const double beyond = pressure_behind(s, w.number);
        double force[3];
        piece_force f;
        force_on(&w, &f);
        for (int a = 0; a < s->mesh->dim; ++a) force[a] = w.weight * (f.all[a] - beyond * w.piece->area[a]);
        push_vertices(&w, force);
        if (s->heats_walls) warm_vertices(&w);
    }
}

floe_status ice_cut_load(ice *s)
{
    for (int l = 0; l < s->embedded.n_boundaries; ++l) {
        const ice_embedded_boundary *line = &s->embedded.boundary[l];
        const size_t vertices = (size_t)line->place[CUT_NOW].n_vertices;
        memset(line->force, 0, 3 * vertices * sizeof *line->force);
        if (s->heats_walls) memset(line->heat_flow, 0, vertices * sizeof *line->heat_flow);
    }
    for (int g = 0; g < s->n_regions; ++g) load_vertices(s, &s->region[g]);
    return s->walls ? ice_merged_response(s) : FLOE_OK;
}
