/* The flow beside embedded boundaries (ice_wall_flow.h; theory 7.7). In every cell that a boundary cuts, and in covered cells beside these, a polynomial of
 * second degree is fitted by least squares to the velocities in the neighbourhood,
 *
 *     u(x) = u_0 + P(x),    sum_i w_i |P(x_i) - (u_i - u_0)|^2 = min,    w = share / (1/4 + |x_i - x_0|^2/h^2)^2,
 *
 * those of the fluid at the centroids of open volumes, and those of the boundary at the middle of its pieces. Values beyond a thin wall are left out. The fit
 * does not replace the state of the cell: the velocity is moved from centroid to centre by the difference of the fit between them, and the gradient at a
 * piece is corrected by the residual of the fit at the boundary less that at the centroid, over their distance. So each cell feels the drag of its own
 * velocity, whatever the fit smooths. */
#include "ice/cut/ice_wall_fit.h"

#include "base/memory.h"
#include "ice/ice_constants.h"
#include "ice/sides/ice_sides.h"
#include "ice/state/ice_walk.h"

#include <math.h>
#include <string.h>

bool ice_sees_walls(const ice *s)
{
    return s->heats_walls || ice_is_viscous(s);
}

void ice_wall_flow_destroy(context *ctx, ice_wall_flow **w)
{
    if (!*w) return;
    memory_free(ctx, &(*w)->fit_of);
    memory_free(ctx, &(*w)->first);
    memory_free(ctx, &(*w)->cell);
    memory_free(ctx, &(*w)->fluid);
    memory_free(ctx, &(*w)->heat);
    memory_free(ctx, &(*w)->sample);
    memory_free(ctx, w);
}

static floe_status flow_of(ice *s, const ice_region *g, ice_wall_flow **out)
{
    ice_wall_flow **w = &s->cut_cells->wall[g->number];
    if (!*w) {
        const size_t cells = mesh_cells(s->mesh);
        TRY(memory_new(s->ctx, w, 1, sizeof **w));
        TRY(memory_new(s->ctx, &(*w)->fit_of, cells, sizeof *(*w)->fit_of));
        for (size_t k = 0; k < cells; ++k) (*w)->fit_of[k] = -1;
    }
    *out = *w;
    return FLOE_OK;
}

/* ---- which cells ---- */

static floe_status add_fit(ice *s, const ice_region *g, ice_wall_flow *w, const int cell[3], int host)
{
    if ((size_t)w->n >= w->reserved) {
        const size_t wanted = w->reserved + w->reserved / 2 + 64;
        TRY(memory_resize(s->ctx, &w->cell, wanted, sizeof *w->cell));
        TRY(memory_resize(s->ctx, &w->first, wanted, sizeof *w->first));
        if (ice_is_viscous(s)) TRY(memory_resize(s->ctx, &w->fluid, wanted * (size_t)g->n, sizeof *w->fluid));
        if (s->heats_walls) TRY(memory_resize(s->ctx, &w->heat, wanted * (size_t)g->n, sizeof *w->heat));
        w->reserved = wanted;
    }
    fit_cell *f = &w->cell[w->n];
    memset(f, 0, sizeof *f);
    memcpy(f->cell, cell, sizeof f->cell);
    f->host = host < 0 ? w->n : host;
    for (int a = 0; a < s->mesh->dim; ++a) f->centre[a] = f->centroid[a] = mesh_centre(s->mesh, a, cell[a]);
    w->first[w->n] = -1;
    w->fit_of[cut_index(s->mesh, cell)] = w->n++;
    return FLOE_OK;
}

static floe_status add_cells(ice *s, const ice_region *g, const ice_merged_cells *p, ice_wall_flow *w)
{
    for (int k = 0; k < w->n; ++k) w->fit_of[cut_index(s->mesh, w->cell[k].cell)] = -1;
    w->n = 0;
    for (int k = 0; k < p->n; ++k) {
        TRY(add_fit(s, g, w, p->member[k].cell, -1));
        for (int a = 0; a < s->mesh->dim; ++a) w->cell[k].centroid[a] -= p->member[k].above[a];
        /* a surface on faces of the mesh may be that of covered cells: its drag is that of the cell in front of it */
        if (!(p->member[k].open > 0.0)) w->cell[k].host = p->lead[p->member[k].merged];
    }
    for (int k = 0; k < p->n; ++k) {
        int step[3], cell[3];
        double shift[3];
        if (!(p->member[k].open > 0.0)) continue;
        for (int n = 0; fit_next_step(s->mesh->dim, 1, &n, step);) {
            if (!fit_find_cell(s->mesh, p->member[k].cell, step, cell, shift)) continue;
            const int fit = w->fit_of[cut_index(s->mesh, cell)];
            if (fit < 0 && ice_open_cell(s, g->number, CUT_NOW, cell) == 0.0) TRY(add_fit(s, g, w, cell, k));
            if (fit >= 0 && fit < p->n && !(p->member[fit].open > 0.0) && w->cell[fit].host == fit)
                w->cell[fit].host = k;
        }
    }
    return FLOE_OK;
}

/* ---- the boundaries ---- */

static void set_sample(const ice *s, const ice_embedded_boundary *line, const cut_piece *q, double outward,
                       wall_sample *out)
{
    const cut_surface *c = &line->place[CUT_NOW];
    *out = (wall_sample){.place = {.cell = c->cell[q->cell].cell, .T = ice_wall_temperature(s, line, q)}, .next = -1};
    for (int a = 0; a < s->mesh->dim; ++a) {
        out->place.x[a] = cut_at_middle(c, q, a);
        for (int k = 0; k < s->mesh->dim; ++k) out->place.v[a] += q->weight[k] * line->velocity[3 * q->vertex[k] + a];
        out->place.area[a] = outward * q->area[a];
    }
    if (s->mesh->geometry == MESH_AXISYMMETRIC)
        for (int a = 0; a < 2; ++a) out->place.area[a] /= most(out->place.x[0], ICE_TINY);
    out->size = fit_length(out->place.area);
}

static floe_status add_samples(ice *s, const ice_region *g, ice_wall_flow *w)
{
    w->n_samples = 0;
    for (int l = 0; l < s->embedded.n_boundaries; ++l) {
        const ice_embedded_boundary *line = &s->embedded.boundary[l];
        const cut_surface *c = &line->place[CUT_NOW];
        const double outward = ice_outward(s, g->number, l);
        if (outward == 0.0) continue;
        const size_t wanted = (size_t)w->n_samples + (size_t)c->n_pieces;
        if (wanted > w->reserved_samples) {
            TRY(memory_resize(s->ctx, &w->sample, wanted + wanted / 2, sizeof *w->sample));
            w->reserved_samples = wanted + wanted / 2;
        }
        for (int n = 0; n < c->n_pieces; ++n) {
            wall_sample *q = &w->sample[w->n_samples];
            set_sample(s, line, &c->piece[n], outward, q);
            int fit = w->fit_of[cut_index(s->mesh, q->place.cell)];
            if (fit < 0 || !(q->size > 0.0)) continue;
            fit = w->cell[fit].host;
            fit_bring_near(s->mesh, &w->cell[fit], q->place.x);
            q->next = w->first[fit];
            w->first[fit] = w->n_samples++;
        }
    }
    return FLOE_OK;
}

/* The wall of the cell itself: the mean of its pieces, with their mean normal where they do not face each other. */
static bool own_wall(const ice_wall_flow *w, fit_cell *f, int fit)
{
    double size = 0.0, x[3] = {0.0}, area[3] = {0.0};
    for (int k = w->first[fit]; k >= 0; k = w->sample[k].next) {
        const wall_sample *q = &w->sample[k];
        size += q->size;
        for (int a = 0; a < 3; ++a) {
            x[a] += q->size * q->place.x[a];
            area[a] += q->place.area[a];
        }
    }
    if (!(size > 0.0)) return false;
    const double length = fit_length(area);
    for (int a = 0; a < 3; ++a) {
        f->wall[a] = f->centre[a] = x[a] / size;
        if (length > 0.1 * size) f->outward[a] = area[a] / length;
    }
    return true;
}

/* That of the nearest piece around. */
static void near_wall(const mesh *m, const ice_wall_flow *w, fit_cell *f)
{
    double nearest = INFINITY;
    int step[3], cell[3];
    double shift[3];
    for (int n = 0; fit_next_step(m->dim, FIT_AROUND, &n, step);) {
        if (!fit_find_cell(m, f->cell, step, cell, shift)) continue;
        const int fit = w->fit_of[cut_index(m, cell)];
        for (int k = fit < 0 ? -1 : w->first[fit]; k >= 0; k = w->sample[k].next) {
            const wall_sample *q = &w->sample[k];
            double away = 0.0;
            for (int a = 0; a < m->dim; ++a) away += pow((q->place.x[a] + shift[a] - f->centre[a]) / m->h[a], 2.0);
            if (!(away < nearest)) continue;
            nearest = away;
            for (int a = 0; a < m->dim; ++a) {
                f->wall[a] = q->place.x[a] + shift[a];
                f->outward[a] = q->place.area[a] / q->size;
            }
        }
    }
}

/* ---- the fit ---- */

/* Velocity of fluid r in a cell; returns the open fraction of the cell, 0 where there is none of the fluid. */
static double state_in(const ice *s, int r, const int cell[3], double u[3])
{
    ptrdiff_t at;
    const ice_view *v = fit_view(s, cell, &at);
    const ice_fluid *m = &v->m[r];
    for (int a = 0; a < s->mesh->dim; ++a) u[a] = m->u[a][at];
    return m->rho[at] > 0.0 ? m->open[at] : 0.0;
}

static void add_wall_fluid(const ice *s, const ice_wall_flow *w, const fit_cell *f, int r, const double u0[3],
                           fit_squares *q)
{
    const mesh *m = s->mesh;
    int step[3], cell[3];
    double shift[3], x[3] = {0.0}, u[3] = {0.0};
    for (int n = 0; fit_next_step(m->dim, FIT_AROUND, &n, step);) {
        if (!fit_find_cell(m, f->cell, step, cell, shift)) continue;
        const double open = state_in(s, r, cell, u);
        if (!(open > 0.0)) continue;
        const int fit = w->fit_of[cut_index(m, cell)];
        for (int a = 0; a < m->dim; ++a) {
            x[a] = (fit < 0 ? mesh_centre(m, a, cell[a]) : w->cell[fit].centroid[a]) + shift[a];
            u[a] -= u0[a];
        }
        fit_add(m, f, x, open, u, q);
        q->samples++;
    }
}

static void add_walls(const mesh *m, const ice_wall_flow *w, const fit_cell *f, const double u0[3], fit_squares *q)
{
    int step[3], cell[3];
    double shift[3], x[3] = {0.0}, u[3] = {0.0};
    for (int n = 0; fit_next_step(m->dim, FIT_AROUND, &n, step);) {
        if (!fit_find_cell(m, f->cell, step, cell, shift)) continue;
        const int fit = w->fit_of[cut_index(m, cell)];
        for (int k = fit < 0 ? -1 : w->first[fit]; k >= 0; k = w->sample[k].next) {
            const wall_sample *p = &w->sample[k];
            for (int a = 0; a < m->dim; ++a) {
                x[a] = p->place.x[a] + shift[a];
                u[a] = p->place.v[a] - u0[a];
            }
            fit_add(m, f, x, fit_wall_share(m, p), u, q);
        }
    }
}

static void fit_fluid(const ice *s, const ice_wall_flow *w, const fit_cell *f, int r, fluid_fit *out)
{
    fit_squares q = {.components = s->mesh->dim};
    double t[FIT_TERMS];
    memset(out, 0, sizeof *out);
    (void)state_in(s, r, w->cell[f->host].cell, out->u);
    add_wall_fluid(s, w, f, r, out->u, &q);
    if (q.samples <= s->mesh->dim) return;
    add_walls(s->mesh, w, f, out->u, &q);
    fit_solve(&q, s->mesh->dim, out->term);
    fit_terms(s->mesh, f, f->centroid, t);
    for (int a = 0; a < s->mesh->dim; ++a) out->miss[a] = -fit_sum(t, out->term[a]);
}

/* ---- what it gives ---- */

/* The velocity at the centre of the cell. */
static void store_centre(const ice *s, const ice_wall_flow *w, const fit_cell *f, int r, const fluid_fit *of)
{
    ptrdiff_t at;
    const ice_view *v = fit_view(s, f->cell, &at);
    const bool open = &w->cell[f->host] == f;
    double x[3] = {0.0}, t[FIT_TERMS];
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = mesh_centre(s->mesh, a, f->cell[a]);
    fit_terms(s->mesh, f, x, t);
    for (int a = 0; a < s->mesh->dim; ++a)
        v->m[r].centred[a][at] = of->u[a] + fit_sum(t, of->term[a]) + (open ? of->miss[a] : 0.0);
}

static void copy_velocities(const ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);)
            for (int r = 0; r < v->n_materials; ++r)
                for (int a = 0; a < v->dim; ++a) v->m[r].centred[a][c.at] = v->m[r].u[a][c.at];
    }
}

static void find_velocities(ice *s, const ice_region *g, const ice_wall_flow *w)
{
    copy_velocities(s);
#pragma omp parallel for schedule(static)
    for (int k = 0; k < w->n; ++k) {
        for (int r = 0; r < g->n; ++r) {
            fluid_fit *of = &w->fluid[k * g->n + r];
            fit_fluid(s, w, &w->cell[k], r, of);
            store_centre(s, w, &w->cell[k], r, of);
        }
    }
    for (int r = 0; r < g->n; ++r) ice_fill_ghosts(s, C_VEL_CENTRED, g->first + r, FILL_CURRENT, GHOST_VELOCITY);
}

floe_status ice_find_wall_flow(ice *s, const ice_region *g)
{
    ice_wall_flow *w;
    TRY(flow_of(s, g, &w));
    ice_cut_views(s, g);
    TRY(add_cells(s, g, &s->cut_cells->now[g->number], w));
    TRY(add_samples(s, g, w));
#pragma omp parallel for schedule(static)
    for (int k = 0; k < w->n; ++k)
        if (!own_wall(w, &w->cell[k], k)) near_wall(s->mesh, w, &w->cell[k]);
    if (ice_is_viscous(s)) find_velocities(s, g, w);
    if (s->heats_walls) ice_find_wall_heat(s, g);
    return FLOE_OK;
}

void ice_centre_temperatures(ice *s, const ice_region *g)
{
    fit_centre_temperatures(s, g);
    for (int r = 0; r < g->n; ++r) ice_fill_ghosts(s, C_DIFFUSION_T, g->first + r, FILL_CURRENT, GHOST_TEMPERATURE);
}

void ice_wall_flow_difference(const ice *s, const ice_region *g, int k, const double from_centre[3], double du[3])
{
    const ice_wall_flow *w = s->cut_cells->wall[g->number];
    const fit_cell *f = &w->cell[k];
    const fluid_fit *of = &w->fluid[k * g->n];
    double x[3] = {0.0}, t[FIT_TERMS];
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = mesh_centre(s->mesh, a, f->cell[a]) + from_centre[a];
    fit_terms(s->mesh, f, x, t);
    for (int a = 0; a < s->mesh->dim; ++a) du[a] = fit_sum(t, of->term[a]) + of->miss[a];
}

/* Gradient of the velocity, by component and axis. */
static void gradient_at(const ice *s, const fit_cell *f, const fluid_fit *of, const wall_place *w, double G[3][3])
{
    const mesh *m = s->mesh;
    const double size = fit_length(w->area);
    const double away = fit_distance(m, f, w);
    double t[FIT_TERMS], slope[3][FIT_TERMS];
    fit_terms(m, f, w->x, t);
    fit_slopes(m, f, w->x, slope);
    for (int a = 0; a < m->dim; ++a) {
        const double rest = of->miss[a] - (w->v[a] - of->u[a] - fit_sum(t, of->term[a]));
        for (int b = 0; b < m->dim; ++b) G[a][b] = fit_sum(slope[b], of->term[a]) - rest / away * w->area[b] / size;
    }
}

void ice_wall_drag(const ice *s, const ice_region *g, int r, const wall_place *at, double drag[3])
{
    wall_place near = *at;
    const wall_place *w = &near;
    const ice_wall_flow *flow = s->cut_cells->wall[g->number];
    const ice_material *m = &s->material[g->first + r];
    const int dim = s->mesh->dim, fit = fit_at(s, flow, w);
    const double mu = m->shear_viscosity, dilatation = m->bulk_viscosity - 2.0 / 3.0 * mu;
    double G[3][3], div = 0.0;
    for (int a = 0; a < dim; ++a) drag[a] = 0.0;
    if (fit < 0 || !(fit_length(w->area) > 0.0)) return;
    fit_bring_near(s->mesh, &flow->cell[fit], near.x);
    gradient_at(s, &flow->cell[fit], &flow->fluid[fit * g->n + r], w, G);
    for (int a = 0; a < dim; ++a) div += G[a][a];
    if (s->mesh->geometry == MESH_AXISYMMETRIC) div += w->x[0] > 0.0 ? w->v[0] / w->x[0] : G[0][0];
    for (int a = 0; a < dim; ++a) {
        for (int b = 0; b < dim; ++b) drag[a] -= mu * (G[a][b] + G[b][a]) * w->area[b];
        drag[a] -= dilatation * div * w->area[a];
    }
}
