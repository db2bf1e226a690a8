/* Heat that fluids conduct to embedded boundaries (theory 7.10). As with velocities (ice_wall_flow.c), a polynomial is fitted about every cut cell, to the
 * temperatures of the fluid at the centroids of open volumes and to those of the boundary where it takes heat; an insulated boundary has no value. The
 * heat on a piece is that of the fit's slope there, corrected so that every cell gives the heat of its own temperature. */
#include "ice/cut/ice_wall_fit.h"
#include "ice/source/ice_source.h"

#include <math.h>
#include <string.h>

/* Where fluid r has a state in a cell: its temperature and the open share of the cell, 0 where there is none of it. */
static double temperature_in(const ice *s, int r, const int cell[3], double *T)
{
    ptrdiff_t at;
    const ice_view *v = fit_view(s, cell, &at);
    *T = v->m[r].diffT[at];
    return v->m[r].rho[at] > 0.0 ? v->m[r].open[at] : 0.0;
}

/* Differences from T_0 of the fluid and of the boundary around a cell. */
static void add_temperatures(const ice *s, const ice_wall_flow *w, const fit_cell *f, int r, double T_0, fit_squares *q)
{
    const mesh *m = s->mesh;
    int step[3], cell[3];
    double shift[3], x[3] = {0.0}, T;
    for (int n = 0; fit_next_step(m->dim, FIT_AROUND, &n, step);) {
        if (!fit_find_cell(m, f->cell, step, cell, shift)) continue;
        const int fit = w->fit_of[cut_index(m, cell)];
        const double open = temperature_in(s, r, cell, &T);
        for (int a = 0; a < m->dim; ++a)
            x[a] = (fit < 0 ? mesh_centre(m, a, cell[a]) : w->cell[fit].centroid[a]) + shift[a];
        T -= T_0;
        if (open > 0.0) fit_add(m, f, x, open, &T, q);
        q->samples += open > 0.0;
        for (int k = fit < 0 ? -1 : w->first[fit]; k >= 0; k = w->sample[k].next) {
            const wall_sample *p = &w->sample[k];
            if (isnan(p->place.T)) continue;
            for (int a = 0; a < m->dim; ++a) x[a] = p->place.x[a] + shift[a];
            T = p->place.T - T_0;
            fit_add(m, f, x, fit_wall_share(m, p), &T, q);
        }
    }
}

static void fit_heat(const ice *s, const ice_wall_flow *w, const fit_cell *f, int r, heat_fit *out)
{
    fit_squares q = {.components = 1};
    double t[FIT_TERMS];
    memset(out, 0, sizeof *out);
    (void)temperature_in(s, r, w->cell[f->host].cell, &out->T);
    add_temperatures(s, w, f, r, out->T, &q);
    if (q.samples <= s->mesh->dim) return;
    fit_solve(&q, s->mesh->dim, &out->term);
    fit_terms(s->mesh, f, f->centroid, t);
    out->miss = -fit_sum(t, out->term);
}

double ice_wall_temperature(const ice *s, const ice_embedded_boundary *line, const cut_piece *q)
{
    double T = 0.0;
    if (!s->heats_walls) return NAN;
    for (int k = 0; k < s->mesh->dim; ++k) T += q->weight[k] * line->temperature[q->vertex[k]];
    return T;
}

void ice_find_wall_heat(ice *s, const ice_region *g)
{
    const ice_wall_flow *w = s->cut_cells->wall[g->number];
    ice_find_temperatures(s, g);
#pragma omp parallel for schedule(static)
    for (int k = 0; k < w->n; ++k)
        for (int r = 0; r < g->n; ++r) fit_heat(s, w, &w->cell[k], r, &w->heat[k * g->n + r]);
}

void fit_centre_temperatures(const ice *s, const ice_region *g)
{
    const ice_wall_flow *w = s->cut_cells->wall[g->number];
    for (int k = 0; k < w->n; ++k) {
        const fit_cell *f = &w->cell[k];
        ptrdiff_t at;
        const ice_view *v = fit_view(s, f->cell, &at);
        double x[3] = {0.0}, t[FIT_TERMS];
        for (int a = 0; a < s->mesh->dim; ++a) x[a] = mesh_centre(s->mesh, a, f->cell[a]);
        fit_terms(s->mesh, f, x, t);
        for (int r = 0; r < g->n; ++r) {
            const heat_fit *of = &w->heat[k * g->n + r];
            v->m[r].diffT[at] = of->T + fit_sum(t, of->term) + (f->host == k ? of->miss : 0.0);
        }
    }
}

double ice_wall_heat(const ice *s, const ice_region *g, int r, const wall_place *at)
{
    wall_place near = *at;
    const wall_place *w = &near;
    const ice_wall_flow *flow = s->cut_cells->wall[g->number];
    const int fit = fit_at(s, flow, w);
    const double size = fit_length(w->area), k = s->material[g->first + r].conductivity;
    if (fit < 0 || !(k > 0.0) || !(size > 0.0) || isnan(w->T)) return 0.0;
    const fit_cell *f = &flow->cell[fit];
    const heat_fit *of = &flow->heat[fit * g->n + r];
    fit_bring_near(s->mesh, f, near.x);
    double t[FIT_TERMS], slope[3][FIT_TERMS], through = 0.0;
    fit_terms(s->mesh, f, w->x, t);
    fit_slopes(s->mesh, f, w->x, slope);
    for (int a = 0; a < s->mesh->dim; ++a) through += fit_sum(slope[a], of->term) * w->area[a];
    const double rest = w->T - of->T - fit_sum(t, of->term) - of->miss;
    return -k * (through + rest / fit_distance(s->mesh, f, w) * size);
}
