/* The implicit pressure's passes over the cells and faces of the blocks. Until ice_implicit_finish, C_DP holds what
 * advection, conduction, heating and new volume do to the pressure, and C_PRESSURE_ADVANCED the latest step of
 * pressure. */
#include "ice/implicit/ice_implicit.h"

#include "ice/exchange/ice_exchange.h"
#include "ice/ice_constants.h"
#include "ice/points/ice_points.h"
#include "ice/pressure/ice_pressure.h"
#include "ice/shock/ice_shock.h"
#include "ice/sides/ice_sides.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_lean.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_walk.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Calls `visit` for every owned row of every block; rows of faces normal to `axis`, or of cells (-1). */
typedef void row_visitor(const ice *s, const ice_view *v, int axis, int j, int k);
static void for_face_rows(const ice *s, const ice_region *g, int axis, row_visitor *visit)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_rows q = ice_rows_of(v.b, axis, 0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row) visit(s, &v, axis, ice_row_j(q, row), ice_row_k(q, row));
    }
}

/* -(1 - s) dt (u . grad) p over as much of the step as P is ahead, into the array of dP. */
static void advect_pressure(const ice *s, const ice_view *v, int axis, int j, int k)
{
    (void)s;
    (void)axis;
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    double *restrict out = v->dP;
    const double *restrict p = v->p, *restrict shock = v->shock;
    for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at) out[at] = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const double *restrict u = v->mean[a];
        const double quarter = -0.25 * v->dt * v->inv_h[a] * v->limit_hi * v->advance;
        const ptrdiff_t st = v->b->stride[a];
#pragma omp simd
        for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at)
            out[at] += (1.0 - shock[at]) * quarter * u[at] * (p[at + st] - p[at - st]);
    }
}

/* Faces of a row normal to `axis` that are not the domain's sides: whether the row has any, and from where to where. */
static bool inner_faces(const ice *s, const ice_view *v, int axis, int j, int k, ptrdiff_t *from, ptrdiff_t *to)
{
    const block *b = v->b;
    const bool lower = b->at_side[axis][SIDE_LOWER] && !s->mesh->periodic[axis],
               upper = b->at_side[axis][SIDE_UPPER] && !s->mesh->periodic[axis];
    *from = mesh_index(b, axis == 0 && lower, j, k);
    *to = mesh_index(b, b->n[0] + (axis == 0 && !upper), j, k);
    if (axis == 0) return true;
    const int at = axis == 1 ? j : k;
    return !(lower && at == 0) && !(upper && at == b->n[axis]);
}

static void set_face_mobility(const ice *s, const ice_view *v, int axis, int j, int k)
{
    (void)s;
    const ptrdiff_t base = mesh_index(v->b, 0, j, k), n = v->b->n[0] + (axis == 0), step = v->b->stride[axis];
    for (int r = 0; r < v->n_materials; ++r) {
        const double *restrict rho = v->m[r].rho, *restrict theta = v->m[r].theta;
        double *restrict out = v->m[r].mobility[axis];
        for (ptrdiff_t R = base; R < base + n; ++R) {
            const double fractions = v->multi ? theta[R - step] + theta[R] : 2.0;
            out[R] = fractions / (rho[R - step] + rho[R] + ICE_TINY);
        }
    }
}

FLOE_ALWAYS_INLINE void centre_inner_faces(const ice_view *v, int axis, ptrdiff_t from, ptrdiff_t to, const bool uneven)
{
    const ptrdiff_t step = v->b->stride[axis];
    const double pressure_impulse = v->dt * v->inv_h[axis], gravity_impulse = v->dt * v->gravity[axis];
    const double *restrict p = v->p, *restrict c = v->dP, *restrict shock = v->shock, *restrict all = v->rho_sum;
    for (int r = 0; r < v->n_materials; ++r) {
        const double *restrict mobility = v->m[r].mobility[axis];
        double *restrict face = v->m[r].fu[axis];
#pragma omp simd
        for (ptrdiff_t R = from; R < to; ++R) {
            const ptrdiff_t L = R - step;
            const double now = 0.5 + 0.25 * (shock[L] + shock[R]), phi = ice_implicit_phi(v, now), more = phi - now;
            const double weight = uneven ? ice_weight_on_face(all, v->m[0].open, R, step) : 1.0;
            face[R] += more * gravity_impulse * weight -
                       pressure_impulse * mobility[R] * (more * (p[R] - p[L]) + phi * (c[R] - c[L]));
        }
    }
}

/* u*_0: from the explicit centring and the pressure at the start to those of the implicit step. */
static void centre_face(const ice *s, const ice_view *v, int axis, int j, int k)
{
    ptrdiff_t from, to;
    if (!inner_faces(s, v, axis, j, k, &from, &to)) return;
    if (ice_weight_is_uneven(v, axis))
        centre_inner_faces(v, axis, from, to, true);
    else
        centre_inner_faces(v, axis, from, to, false);
}

floe_status ice_implicit_begin(ice *s, const ice_region *g)
{
    const bool diffuses = ice_diffuses(s);
    for_face_rows(s, g, -1, advect_pressure);
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        if (ice_reaction_count(s) > 0) ice_created_pressure(s, &v, v.dP);
        for (int r = 0; r < v.n_materials && diffuses; ++r) ice_diffusion_pressure(s, &v, r, v.dP);
    }
    return ice_load_pressure(s, g);
}

void ice_implicit_centre(ice *s, const ice_region *g)
{
    ice_view v;
    ice_fill_ghosts(s, C_DP, g->number, FILL_CURRENT, GHOST_ZERO_OPEN);
    for (int axis = 0; axis < s->mesh->dim; ++axis) for_face_rows(s, g, axis, set_face_mobility);
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        for (int axis = 0; axis < v.dim && v.multi; ++axis) {
            double *mobility[ICE_MAX_MATERIALS];
            for (int r = 0; r < v.n_materials; ++r) mobility[r] = v.m[r].mobility[axis];
            ice_exchange_faces(s, &v, axis, mobility);
        }
        for (int r = 0; r < v.n_materials; ++r) ice_boundary_mobility(s, &v, r);
    }
    for (int axis = 0; axis < s->mesh->dim; ++axis) for_face_rows(s, g, axis, centre_face);
}

static void push_face(const ice *s, const ice_view *v, int axis, int j, int k)
{
    (void)s;
    const ptrdiff_t base = mesh_index(v->b, 0, j, k), n = v->b->n[0] + (axis == 0), step = v->b->stride[axis];
    const double pressure_impulse = v->dt * v->inv_h[axis];
    const double *restrict y = v->P, *restrict shock = v->shock;
    for (int r = 0; r < v->n_materials; ++r) {
        const double *restrict mobility = v->m[r].mobility[axis];
        double *restrict face = v->m[r].fu[axis];
#pragma omp simd
        for (ptrdiff_t R = base; R < base + n; ++R) {
            const ptrdiff_t L = R - step;
            const double phi = ice_implicit_phi(v, 0.5 + 0.25 * (shock[L] + shock[R]));
            face[R] -= pressure_impulse * phi * mobility[R] * (y[R] - y[L]);
        }
    }
}

void ice_implicit_push(const ice *s, const ice_region *g)
{
    for (int axis = 0; axis < s->mesh->dim; ++axis) for_face_rows(s, g, axis, push_face);
}

static ice_implicit *rows_of(const ice *s, const ice_view *v)
{
    return &s->rows[v->region];
}

/* Index on the solver's grid of the first cell of a row. */
static ptrdiff_t grid_row(const ice_implicit *w, const block *b, int j, int k)
{
    return solve_index(&w->grid, b->lo[0], b->lo[1] + j, b->lo[2] + k);
}

static double cell_compressibility(const ice_view *v, ptrdiff_t at)
{
    const double c = v->m[0].c[at];
    return v->kappa_sum ? 1.0 / v->kappa_sum[at] : v->rho_sum[at] * c * c;
}

/* div F of a cell. */
static double flux_divergence(const ice_view *v, ptrdiff_t at, ptrdiff_t i)
{
    double div = v->upper0[i] * v->flux[0][at + 1] - v->lower0[i] * v->flux[0][at];
    for (int a = 1; a < v->dim; ++a) div += (v->flux[a][at + v->b->stride[a]] - v->flux[a][at]) * v->inv_h[a];
    return div;
}

/* The same with each axis by its spacing over the largest: the jump of velocity over the cell, over that. */
static double jump_over(const ice_view *v, ptrdiff_t at, ptrdiff_t i)
{
    double jump = v->share[0] * (v->upper0[i] * v->flux[0][at + 1] - v->lower0[i] * v->flux[0][at]);
    for (int a = 1; a < v->dim; ++a)
        jump += v->share[a] * (v->flux[a][at + v->b->stride[a]] - v->flux[a][at]) * v->inv_h[a];
    return jump;
}

/* Volume of a cell over that of its box, h h h. */
static double weight_of(const ice_view *v, ptrdiff_t i)
{
    double box = 1.0;
    for (int a = 0; a < v->dim; ++a) box *= v->h[a];
    return v->volume[i] / box;
}

static void residual_row(const ice *s, const ice_view *v, int axis, int j, int k)
{
    (void)axis;
    ice_implicit *w = rows_of(s, v);
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    double *restrict b = w->b + grid_row(w, v->b, j, k), largest = 0.0;
    bool sound = true;
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = base + i;
        const double phi = ice_implicit_phi(v, 0.5 * (1.0 + v->shock[at]));
        const double constrained = s->with_points && ice_is_continued(v, at) ? 0.0 : 1.0;
        const double r =
            constrained * (-v->step[at] / (phi * cell_compressibility(v, at)) - v->dt * flux_divergence(v, at, i));
        largest = most(largest, fabs(r));
        sound = sound && isfinite(r);
        b[i] = r * weight_of(v, i);
    }
    /* Blocks lie side by side in a row of the mesh; those of one row are taken one after the other. */
    double *tile = &w->tile[v->b->lo[1] + j + w->grid.n[1] * (v->b->lo[2] + k)];
    *tile = most(*tile, sound ? largest : DBL_MAX);
}

double ice_implicit_residual(ice *s, const ice_region *g)
{
    ice_implicit *w = &s->rows[g->number];
    const int rows = solve_rows(&w->grid);
    double largest = 0.0;
    memset(w->tile, 0, (size_t)rows * sizeof(double));
    for_face_rows(s, g, -1, residual_row);
    for (int row = 0; row < rows; ++row) largest = most(largest, w->tile[row]);
    return largest;
}

static void sink_row(const ice *s, const ice_view *v, int axis, int j, int k)
{
    (void)axis;
    const ice_implicit *w = rows_of(s, v);
    double *sink = multigrid_links(w->m).sink + grid_row(w, v->b, j, k);
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(v->b, 0, j, k) + i;
        const double phi = ice_implicit_phi(v, 0.5 * (1.0 + v->shock[at]));
        sink[i] = weight_of(v, i) / (phi * cell_compressibility(v, at));
    }
}

/* dt^2 phi M / h^2 times the face's area over that of its box: lower0 V / (h h h) h_0 across axis 0, V / (h h h)
 * else. */
static void link_row(const ice *s, const ice_view *v, int axis, int j, int k)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k), n = v->b->n[0] + (axis == 0), step = v->b->stride[axis];
    const double square = v->dt * v->dt * v->inv_h[axis] * v->inv_h[axis];
    const ice_implicit *w = rows_of(s, v);
    double *link = multigrid_links(w->m).link[axis] + grid_row(w, v->b, j, k);
    for (ptrdiff_t i = 0; i < n; ++i) {
        const ptrdiff_t R = base + i, L = R - step;
        double mobility = 0.0;
        for (int r = 0; r < v->n_materials; ++r)
            mobility += (v->multi ? v->m[r].ft[axis][R] : 1.0) * v->m[r].mobility[axis][R];
        const double phi = ice_implicit_phi(v, 0.5 + 0.25 * (v->shock[L] + v->shock[R]));
        const double area = axis == 0 ? v->lower0[i] * weight_of(v, i) * v->h[0] : weight_of(v, i);
        link[i] = square * phi * mobility * area;
    }
}

/* A constrained cell keeps its pressure: links to it become sinks of its neighbours, and it is not an unknown. */
static void constrain_cell(const ice *s, const ice_view *v, int i, int j, int k)
{
    const solve_grid *g = &rows_of(s, v)->grid;
    const link_system q = multigrid_links(rows_of(s, v)->m);
    const int cell[MESH_MAX_DIM] = {v->b->lo[0] + i, v->b->lo[1] + j, v->b->lo[2] + k};
    const ptrdiff_t at = solve_index(g, cell[0], cell[1], cell[2]);
    for (int a = 0; a < g->dim; ++a)
        for (int upper = 0; upper < 2; ++upper) {
            const bool side = cell[a] == (upper ? g->n[a] - 1 : 0), wrap = side && g->periodic[a];
            const ptrdiff_t to = upper ? (wrap ? at - (g->n[a] - 1) * g->stride[a] : at + g->stride[a])
                                       : (wrap ? at + (g->n[a] - 1) * g->stride[a] : at - g->stride[a]);
            double *link = &q.link[a][upper ? to : at];
            if (!side || wrap) q.sink[to] += *link;
            *link = 0.0;
        }
}

static void drop_sink(const ice *s, const ice_view *v, int i, int j, int k)
{
    const ice_implicit *w = rows_of(s, v);
    multigrid_links(w->m).sink[grid_row(w, v->b, j, k) + i] = 0.0;
}

static void for_constrained(const ice *s, const ice_region *g,
                            void (*visit)(const ice *s, const ice_view *v, int i, int j, int k))
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);)
        for (ice_walk c = ICE_FIRST; ice_next_cell(v.b, &c);)
            if (ice_is_continued(&v, c.at)) visit(s, &v, c.in[0], c.in[1], c.in[2]);
}

void ice_implicit_links(ice *s, const ice_region *g)
{
    for_face_rows(s, g, -1, sink_row);
    for (int axis = 0; axis < s->mesh->dim; ++axis) for_face_rows(s, g, axis, link_row);
}

floe_status ice_implicit_matrix(ice *s, const ice_region *g)
{
    ice_implicit_links(s, g);
    if (s->with_points) {
        for_constrained(s, g, constrain_cell);
        for_constrained(s, g, drop_sink);
    }
    return multigrid_prepare(s->rows[g->number].m);
}

static void take_row(const ice *s, const ice_view *v, int axis, int j, int k)
{
    (void)axis;
    const ice_implicit *w = rows_of(s, v);
    const double *x = w->x + grid_row(w, v->b, j, k);
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(v->b, 0, j, k) + i;
        v->P[at] = x[i];
        v->step[at] += x[i];
    }
}

void ice_implicit_take(ice *s, const ice_region *g)
{
    for_face_rows(s, g, -1, take_row);
    ice_fill_ghosts(s, C_PRESSURE_ADVANCED, g->number, FILL_CURRENT, GHOST_ZERO_OPEN);
}

static void guess_row(const ice *s, const ice_view *v, int axis, int j, int k)
{
    (void)axis;
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(v->b, 0, j, k) + i;
        const bool constrained = s->with_points && ice_is_continued(v, at);
        v->P[at] = v->step[at] = constrained ? 0.0 : v->last_step[at];
    }
}

void ice_implicit_guess(ice *s, const ice_region *g)
{
    for_face_rows(s, g, -1, guess_row);
    ice_fill_ghosts(s, C_PRESSURE_ADVANCED, g->number, FILL_CURRENT, GHOST_ZERO_OPEN);
}

/* dP of the volumes as they flow, so that 2.10 keeps the sum of volumes exactly; P by the steps that were solved for,
 * which are smooth where a stiff cell would make a pressure of a residual. Of the bulk viscosity only the part that
 * falls with the square of h: the linear one is for sound that the step resolves. */
static void finish_pressure_row(const ice *s, const ice_view *v, int axis, int j, int k)
{
    (void)s;
    (void)axis;
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(v->b, 0, j, k) + i;
        const double div = flux_divergence(v, at, i), squeeze = v->length * ice_compression(div, jump_over(v, at, i));
        v->P[at] = v->p[at] + (v->dP[at] + v->step[at]) + v->rho_sum[at] * squeeze * squeeze;
        v->dP[at] = -v->dt * div * cell_compressibility(v, at);
    }
}

void ice_implicit_advance(ice *s, const ice_region *g)
{
    for_face_rows(s, g, -1, finish_pressure_row);
}

void ice_implicit_finish(ice *s, const ice_region *g)
{
    ice_implicit_advance(s, g);
    ice_finish_increment(s, g);
}
