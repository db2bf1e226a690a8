/* Fluxes out of merged cells that several fluids share, and the change of their velocities and energies in the step: the sums of ice_merged_step.c divided
 * among the fluids, as ice_sources.c does for whole cells (theory 2.6, 2.8 i, 7.2). */
#include "ice/cut/ice_merged_cells.h"

#include "ice/ice_constants.h"
#include "ice/source/ice_source.h"

#include <math.h>

/* ---- volume fractions at faces ---- */

/* A face through which a member gives: to another merged cell, a whole one, or a side. */
typedef struct outlet {
    const ice_member *m;
    int axis, side;
    double open; /* share of the face by which velocities there are still to be multiplied */
} outlet;

/* swept: velocities have been multiplied, and have what moving pieces draw through the face. */
static outlet outlet_of(const ice_member *m, int face, bool swept)
{
    const double open = m->face[face / 2][face % 2];
    return (outlet){m, face / 2, face % 2, swept && open > 0.0 ? 1.0 : open};
}

static bool is_inner(const ice *s, const ice_merged_cells *p, const outlet *f)
{
    int cell[3] = {f->m->cell[0], f->m->cell[1], f->m->cell[2]};
    if (!mesh_step(s->mesh, cell, f->axis, f->side == SIDE_UPPER ? 1 : -1)) return false;
    const int place = p->place[cut_index(s->mesh, cell)];
    return place >= 0 && p->member[place].merged == f->m->merged;
}

/* Volume of a fluid's velocity that leaves through the face in the step (m3), all of it that fluid; 0 where it comes in. */
static double volume_out(const ice *s, const outlet *f, int r)
{
    const ice_view *v = ice_member_view(s, f->m);
    const double speed =
        (f->side == SIDE_UPPER ? 1.0 : -1.0) * v->m[r].fu[f->axis][ice_member_face(v, f->m, f->axis, f->side)];
    return most(speed, 0.0) * s->dt * f->open * ice_member_area(s, f->m, f->axis, f->side);
}

static double fraction_at(const ice *s, const outlet *f, int r)
{
    const ice_view *v = ice_member_view(s, f->m);
    return v->m[r].ft[f->axis][ice_member_face(v, f->m, f->axis, f->side)];
}

/* Sets the fraction in all blocks that have the face. */
static void set_fraction(const ice *s, const outlet *f, int r, double fraction)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        const block *b = v->b;
        int at[3] = {f->m->cell[0] - b->lo[0], f->m->cell[1] - b->lo[1], f->m->cell[2] - b->lo[2]};
        at[f->axis] += f->side == SIDE_UPPER;
        bool has = true;
        for (int a = 0; a < s->mesh->dim; ++a) has = has && at[a] >= 0 && at[a] < b->n[a] + (a == f->axis);
        if (!has) continue;
        const ptrdiff_t face = mesh_index(b, at[0], at[1], at[2]);
        double sum = 0.0;
        v->m[r].ft[f->axis][face] = fraction;
        for (int q = 0; q < v->n_materials; ++q) sum += v->m[q].ft[f->axis][face] * v->m[q].fu[f->axis][face];
        v->flux[f->axis][face] = sum;
    }
}

static bool is_mixed(const ice *s, const ice_member *m)
{
    return ice_member_view(s, m)->mixed[m->at] > 1.0;
}

static bool is_sharp(const ice *s, const ice_member *m)
{
    const ice_view *v = ice_member_view(s, m);
    return v->sharp && v->interface[m->at] > 0.0;
}

/* Away from interfaces a member gives what it has, without gradients. */
static void flatten_member(const ice *s, const ice_member *m)
{
    ptrdiff_t at;
    for (int id = 0; ice_next_seen(s, m->cell, &id, &at);) s->cut_cells->view[id - 1].limiter[at] = 0.0;
    for (int n = 0; n < 2 * s->mesh->dim; ++n) {
        const outlet f = outlet_of(m, n, false);
        const ice_view *v = ice_member_view(s, m);
        for (int r = 0; r < v->n_materials; ++r)
            if ((f.side == SIDE_UPPER ? 1.0 : -1.0) * v->m[r].fu[f.axis][ice_member_face(v, m, f.axis, f.side)] > 0.0)
                set_fraction(s, &f, r, v->m[r].theta[m->at]);
    }
}

/* What merged cells have of a fluid (m3), in FLUID_VOLUME, and what would leave them, in FLUID_MASS. */
static void add_outflow(const ice *s, const ice_merged_cells *p, const ice_member *m, bool swept)
{
    const ice_view *v = ice_member_view(s, m);
    for (int r = 0; r < v->n_materials; ++r) {
        double *sum = p->fluid + (size_t)(m->merged * v->n_materials + r) * FLUID_SUMS;
        sum[FLUID_VOLUME] += v->m[r].theta[m->at] * m->open * mesh_cell_volume(s->mesh, m->cell[0]);
        for (int n = 0; n < 2 * v->dim; ++n) {
            const outlet f = outlet_of(m, n, swept);
            if (f.open > 0.0 && !is_inner(s, p, &f)) sum[FLUID_MASS] += volume_out(s, &f, r) * fraction_at(s, &f, r);
        }
    }
}

/* As bound_outflow of ice_interface.c: those that would give too much give less everywhere, and those with some left more. */
static void bound_face(const ice *s, const ice_merged_cells *p, const outlet *f)
{
    const int n = p->region->n;
    const double *sum = p->fluid + (size_t)(f->m->merged * n) * FLUID_SUMS;
    double missing = 0.0, total = 0.0, fraction[ICE_MAX_MATERIALS], left[ICE_MAX_MATERIALS];
    bool gives[ICE_MAX_MATERIALS];
    for (int r = 0; r < n; ++r, sum += FLUID_SUMS) {
        const double has = sum[FLUID_VOLUME] * (1.0 - ICE_INTERFACE_PURE), out = sum[FLUID_MASS];
        gives[r] = volume_out(s, f, r) > 0.0;
        fraction[r] = fraction_at(s, f, r);
        left[r] = gives[r] ? most(has - out, 0.0) : 0.0;
        total += left[r];
        if (!gives[r] || !(out > has)) continue;
        missing += (1.0 - has / out) * fraction[r];
        fraction[r] *= has / out;
    }
    if (missing == 0.0) return;
    for (int r = 0; r < n; ++r)
        if (gives[r]) set_fraction(s, f, r, fraction[r] + (total > 0.0 ? missing * left[r] / total : 0.0));
}

static void bound_member(const ice *s, const ice_merged_cells *p, const ice_member *m, bool swept)
{
    for (int n = 0; n < 2 * s->mesh->dim; ++n) {
        const outlet f = outlet_of(m, n, swept);
        if (f.open > 0.0 && !is_inner(s, p, &f)) bound_face(s, p, &f);
    }
}

static void bound_members(const ice *s, ice_merged_cells *p, bool swept)
{
    ice_clear_merged(p);
    for (int k = 0; k < p->n; ++k)
        if (is_mixed(s, &p->member[k])) add_outflow(s, p, &p->member[k], swept);
    for (int k = 0; k < p->n; ++k)
        if (is_mixed(s, &p->member[k]) && is_sharp(s, &p->member[k])) bound_member(s, p, &p->member[k], swept);
}

void ice_bound_merged(const ice *s, const ice_region *g)
{
    ice_merged_cells *p = &s->cut_cells->now[g->number];
    ice_cut_views(s, g);
    for (int k = 0; k < p->n; ++k)
        if (is_mixed(s, &p->member[k]) && !is_sharp(s, &p->member[k])) flatten_member(s, &p->member[k]);
    bound_members(s, p, false);
}

void ice_bound_swept(const ice *s, const ice_region *g)
{
    bound_members(s, &s->cut_cells->now[g->number], true);
}

/* ---- velocities and energies ---- */

/* The step of merged cells, per volume. */
typedef struct merged_push {
    double volume, mass;          /* m3, kg */
    double impulse[3], weight[3]; /* of the pressure per volume; gravity's per mass */
    double heat;                  /* work of faces and pieces less what the pressure's impulse takes */
    double fallen;                /* J: gravity's work */
} merged_push;

static merged_push push_of(const ice *s, const double *sum)
{
    merged_push q = {
        .volume = sum[MERGED_VOLUME], .mass = sum[MERGED_MASS], .heat = sum[MERGED_WORK] / sum[MERGED_VOLUME]};
    for (int a = 0; a < s->mesh->dim; ++a) {
        q.impulse[a] = (sum[MERGED_MOMENTUM + a] - sum[MERGED_WEIGHT + a]) / q.volume;
        q.weight[a] = sum[MERGED_WEIGHT + a] / q.mass;
    }
    return q;
}

static void push_fluids(const ice_view *v, ptrdiff_t at, merged_push *q)
{
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        const double rho = m->rho[at], mobility = rho > 0.0 ? m->theta[at] / rho : 0.0;
        for (int a = 0; a < v->dim; ++a) {
            const double u = m->u[a][at], du = q->impulse[a] * mobility, next = u + (du + q->weight[a]);
            q->heat -= rho * du * 0.5 * (u + next);
            q->fallen += q->volume * rho * q->weight[a] * 0.5 * (u + next);
            m->ul[a][at] = next;
        }
        m->el[at] = m->e[at];
    }
}

/* The reversible part; the rest is known after the exchange. */
static void heat_several(const ice *s, const ice_view *v, ptrdiff_t at, const merged_push *q)
{
    const bool conserves = s->scene->method.conserve_energy;
    const double plain = ice_compression_work(v, at);
    double given = 0.0;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        if (!(m->rho[at] > 0.0)) continue;
        const double gained =
            conserves ? ice_reversible_gain(v, r, at, plain) : m->theta[at] * m->kappa[at] * plain / m->rho[at];
        m->el[at] = m->e[at] + gained;
        given += m->rho[at] * gained;
    }
    v->owed[at] = conserves ? q->heat - given : 0.0;
}

/* Where too little energy would remain, that of compression alone (2.7), and the rest is entered as a defect. */
static void heat_only(const ice *s, const ice_view *v, ptrdiff_t at, int r, const merged_push *q)
{
    const ice_fluid *m = &v->m[r];
    const double floor = v->material[r].energy_floor, rho = m->rho[at];
    const double conserving = m->e[at] + q->heat / rho,
                 plain = m->e[at] + ice_compression_work(v, at) * m->kappa[at] / rho;
    double kinetic = 0.0;
    for (int a = 0; a < v->dim; ++a) kinetic += 0.5 * m->ul[a][at] * m->ul[a][at];
    const bool usable =
        s->scene->method.conserve_energy && conserving - (isnan(floor) ? 0.0 : floor) > ICE_THERMAL_SHARE * kinetic;
    m->el[at] = usable ? conserving : plain;
    v->owed[at] = 0.0;
    if (usable) return;
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_DEFECT, q->mass * (plain - conserving));
    ledger_tally(s->ledger, COUNT_ENERGY_GUARDS, 1);
}

/* Viscosity, conduction and the drag of the boundary, summed by ice_merged_step.c. */
static void add_stresses(const ice_merged_cells *p, int merged, const ice_view *v, ptrdiff_t at)
{
    const double volume = p->sum[(size_t)merged * MERGED_SUMS + MERGED_VOLUME];
    for (int r = 0; r < v->n_materials; ++r) {
        const double *own = p->fluid + (size_t)(merged * v->n_materials + r) * FLUID_SUMS;
        const double mass = volume * v->m[r].rho[at];
        double du[3];
        if (!(mass > 0.0)) continue;
        for (int a = 0; a < v->dim; ++a) du[a] = own[FLUID_MOMENTUM + a] / mass;
        ice_add_change(&v->m[r], at, v->dim, du, own[FLUID_ENERGY] / mass);
    }
}

static void heat_fluids(const ice *s, const ice_view *v, ptrdiff_t at, const merged_push *q)
{
    if (v->mixed[at] > 1.0) {
        heat_several(s, v, at, q);
        return;
    }
    for (int r = 0; r < v->n_materials; ++r)
        if (v->m[r].rho[at] > 0.0) heat_only(s, v, at, r, q);
}

static void advance_lead(const ice *s, const ice_merged_cells *p, int merged)
{
    const ice_member *lead = &p->member[p->lead[merged]];
    const ice_view *v = ice_member_view(s, lead);
    const double *sum = p->sum + (size_t)merged * MERGED_SUMS;
    merged_push q = push_of(s, sum);
    push_fluids(v, lead->at, &q);
    ice_enter_weight(s, lead, sum, q.fallen);
    heat_fluids(s, v, lead->at, &q);
    if (ice_has_diffusion(s)) add_stresses(p, merged, v, lead->at);
}

static void take_lead(const ice *s, const ice_member *m, const ice_member *lead)
{
    const ice_view *to = ice_member_view(s, m), *from = ice_member_view(s, lead);
    to->owed[m->at] = from->owed[lead->at];
    for (int r = 0; r < to->n_materials; ++r) {
        to->m[r].el[m->at] = from->m[r].el[lead->at];
        for (int a = 0; a < to->dim; ++a) to->m[r].ul[a][m->at] = from->m[r].ul[a][lead->at];
    }
}

void ice_advance_fluids(const ice *s, ice_merged_cells *p)
{
    ice_sum_open_volumes(s, p);
    for (int merged = 0; merged < p->count; ++merged)
        if (p->sum[(size_t)merged * MERGED_SUMS + MERGED_MASS] > 0.0) advance_lead(s, p, merged);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        if (p->sum[(size_t)m->merged * MERGED_SUMS + MERGED_MASS] > 0.0)
            take_lead(s, m, &p->member[p->lead[m->merged]]);
    }
}
