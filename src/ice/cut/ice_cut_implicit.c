/* The implicit pressure beside embedded boundaries (theory 7.8). Of a merged cell, with all that is open of it,
 *
 *     V S y + dt [sum_f A_f F + sum_w A_w . v'] = 0,     v' = v'_0 + dt M^-1 sum_w A_w (change of P),
 *
 * F with the pressures at the end of the step as in theory 3, v' the velocity of the wall by these pressures and M what is behind it. Cells away
 * from walls have the rows of theory 3. All regions are one system, for a wall between two fluids ties them:
 *
 *     (P^T A P + dt B M^-1 B^T) x = b
 *
 * with A the rows of all cells with open faces, and P which gives the cells of a merged one their one pressure. Symmetric and positive
 * definite: conjugate gradients, preconditioned by the multigrid of A with the members of merged cells tied to each other, and the walls' answer to the
 * own pressure of each cell on the diagonal.
 *
 * The walls' velocities by all other forces are known only when the points have theirs, so there are three parts: before, with the last step's
 * change of pressure and the walls' velocities at the start (ice_cut_guess); the search, called by the points (ice_cut_solve); and after
 * (ice_cut_take). */
#include "ice/cut/ice_merged_cells.h"
#include "ice/cut/ice_merged_pieces.h"

#include "base/memory.h"
#include "coupling/wall_response.h"
#include "ice/flux/ice_flux.h"
#include "ice/ice_constants.h"
#include "ice/implicit/ice_implicit.h"
#include "ice/pressure/ice_pressure.h"
#include "ice/sides/ice_sides.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_walk.h"

#include <float.h>
#include <math.h>
#include <string.h>

typedef struct ice_cut_system {
    cg *c;          /* owned; on a list: the grids of all regions one after the other */
    size_t size;    /* entries of a region */
    double *b, *x;  /* owned; right side, and solution */
    double *weight; /* owned; 1/w, w the open volume of a cell, or merged cell, over that of its box; 0: none */
    double *pressure, *flux, *own; /* owned; of the merged cells of all regions, as in the wall_response */
    size_t reserved;
} ice_cut_system;

floe_status ice_cut_system_create(ice *s)
{
    const solve_grid cells = solve_grid_of_cells(s->mesh);
    TRY(memory_new(s->ctx, &s->cut_cells->system, 1, sizeof *s->cut_cells->system));
    ice_cut_system *w = s->cut_cells->system;
    w->size = cells.size;
    const size_t all = (size_t)s->n_regions * w->size;
    const solve_grid list = solve_grid_of_list((int)all);
    TRY(cg_create(&w->c, s->ctx, &list, 1, ICE_MOST_CUT_CG));
    TRY(memory_new(s->ctx, &w->b, all, sizeof(double)));
    TRY(memory_new(s->ctx, &w->x, all, sizeof(double)));
    return memory_new(s->ctx, &w->weight, all, sizeof(double));
}

void ice_cut_system_destroy(context *ctx, ice_cut_system **w)
{
    if (!*w) return;
    cg_destroy(&(*w)->c);
    memory_free(ctx, &(*w)->b);
    memory_free(ctx, &(*w)->x);
    memory_free(ctx, &(*w)->weight);
    memory_free(ctx, &(*w)->pressure);
    memory_free(ctx, &(*w)->flux);
    memory_free(ctx, &(*w)->own);
    memory_free(ctx, w);
}

/* ---- where cells are in the system ---- */

/* A region's part of a vector. */
static double *part_of(const ice *s, const ice_region *g, double *x)
{
    return x + (size_t)g->number * s->cut_cells->system->size;
}

static ptrdiff_t index_of(const ice *s, const int cell[3])
{
    return solve_index(&s->rows->grid, cell[0], cell[1], cell[2]);
}

static ptrdiff_t lead_index(const ice *s, const ice_merged_cells *p, int merged)
{
    return index_of(s, p->member[p->lead[merged]].cell);
}

/* Volume of a merged cell, as the rows have it: none is so small that its pressure is without bounds. */
static double volume_of(const ice *s, const ice_merged_cells *p, int merged)
{
    return fmax(p->sum[(size_t)merged * MERGED_SUMS + MERGED_VOLUME], ICE_GAP_FRACTION * mesh_box_volume(s->mesh));
}

/* rho c^2 of a merged cell. */
static double stiffness_of(const ice *s, const ice_merged_cells *p, int merged)
{
    const ice_member *lead = &p->member[p->lead[merged]];
    const ice_view *v = ice_member_view(s, lead);
    const double c = ice_merged_sound(v, lead->at);
    return v->rho_sum[lead->at] * c * c;
}

/* The same with the linear part of the bulk viscosity (theory 2.8, iv), q = c_l c h times the rate at which the density rises. */
static double resistance_of(const ice *s, const ice_merged_cells *p, int merged)
{
    const ice_member *lead = &p->member[p->lead[merged]];
    const ice_view *v = ice_member_view(s, lead);
    const double c = ice_merged_sound(v, lead->at);
    return stiffness_of(s, p, merged) * (1.0 + ICE_SHOCK_LINEAR * v->finest / (c * s->dt));
}

/* Members that do not lead take the value of the lead; or lose theirs, or give it to the lead. */
static void spread_lead(const ice *s, const ice_merged_cells *p, double *x)
{
    for (int k = 0; k < p->n; ++k) x[index_of(s, p->member[k].cell)] = x[lead_index(s, p, p->member[k].merged)];
}

static void drop_others(const ice *s, const ice_merged_cells *p, double *x)
{
    for (int k = 0; k < p->n; ++k)
        if (p->lead[p->member[k].merged] != k) x[index_of(s, p->member[k].cell)] = 0.0;
}

static void gather_at_lead(const ice *s, const ice_merged_cells *p, double *y)
{
    for (int k = 0; k < p->n; ++k) {
        if (p->lead[p->member[k].merged] == k) continue;
        double *of = &y[index_of(s, p->member[k].cell)];
        y[lead_index(s, p, p->member[k].merged)] += *of;
        *of = 0.0;
    }
}

/* ---- the matrix ---- */

static bool share_a_cell(const ice *s, const ice_merged_cells *p, const int lower[3], const int upper[3])
{
    const int k = p->place[cut_index(s->mesh, lower)], n = p->place[cut_index(s->mesh, upper)];
    return k >= 0 && n >= 0 && p->member[k].merged == p->member[n].merged;
}

/* Links are of what is open. Between members of a merged cell, where they only serve the preconditioner, they are those
 * of whole faces. Measured: four times as strong costs a third more iterations, a hundred times three times as many. */
static void cut_link(const ice *s, const ice_region *g, const int upper[3], int axis, double *link)
{
    int lower[3] = {upper[0], upper[1], upper[2]};
    lower[axis]--;
    const bool last = upper[axis] == s->mesh->n[axis], first = upper[axis] == 0;
    if (!first && !last && share_a_cell(s, ice_merged_cells_of(s, g), lower, upper)) return;
    *link *= last ? ice_mean_face(s, g->number, lower, axis, SIDE_UPPER)
                  : ice_mean_face(s, g->number, upper, axis, SIDE_LOWER);
}

static void cut_links(const ice *s, const ice_region *g, int axis)
{
    double *link = multigrid_links(s->rows[g->number].m).link[axis];
    int end[3];
    for (int a = 0; a < 3; ++a) end[a] = s->mesh->n[a] + (a == axis);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < end[1] * end[2]; ++row)
        for (int i = 0; i < end[0]; ++i) {
            const int face[3] = {i, row % end[1], row / end[1]};
            cut_link(s, g, face, axis, &link[index_of(s, face)]);
        }
}

static void cut_sinks(const ice *s, const ice_region *g)
{
    const ice_merged_cells *p = ice_merged_cells_of(s, g);
    const double box = mesh_box_volume(s->mesh);
    double *sink = multigrid_links(s->rows[g->number].m).sink, *weight = part_of(s, g, s->cut_cells->system->weight);
    for (int id = 0; id < s->mesh->n_blocks; ++id) {
        const ice_view *v = &s->cut_cells->view[id];
        for (ice_walk c = ICE_FIRST; ice_next_cell(v->b, &c);) {
            const ptrdiff_t at = index_of(s, c.cell);
            const bool takes_part = v->m[0].open[c.at] > 0.0 && p->place[cut_index(s->mesh, c.cell)] < 0;
            weight[at] = takes_part ? box / mesh_cell_volume(s->mesh, c.cell[0]) : 0.0;
            if (!takes_part) sink[at] = 0.0;
        }
    }
    for (int k = 0; k < p->count; ++k) {
        const double volume = volume_of(s, p, k);
        sink[lead_index(s, p, k)] = volume / (box * resistance_of(s, p, k));
        weight[lead_index(s, p, k)] = box / volume;
    }
}

static void find_matrix(ice *s, const ice_region *g)
{
    ice_implicit_links(s, g);
    for (int axis = 0; axis < s->mesh->dim; ++axis) cut_links(s, g, axis);
    cut_sinks(s, g);
}

/* ---- before the walls have moved ---- */

void ice_cut_viscous_rates(ice *s, const ice_region *g)
{
    ice_cut_diffusion_rates(s, g);
    ice_merged_diffusion_rates(s, g);
    for (int r = g->first; r < g->first + g->n; ++r) ice_fill_ghosts(s, C_DIFFUSION, r, FILL_CURRENT, GHOST_EVEN);
}

/* b of theory 3 in whole cells, that of the head in merged ones. */
static void find_right_side(ice *s, const ice_region *g)
{
    ice_merged_cells *p = ice_merged_cells_of(s, g);
    const double box = mesh_box_volume(s->mesh);
    double *b = part_of(s, g, s->cut_cells->system->b), *weight = part_of(s, g, s->cut_cells->system->weight);
    (void)ice_implicit_residual(s, g);
    const solve_grid *grid = &s->rows[g->number].grid;
    for (int row = 0; row < solve_rows(grid); ++row)
        for (int i = 0; i < grid->n[0]; ++i) {
            const ptrdiff_t at = solve_row(grid, row) + i;
            b[at] = weight[at] > 0.0 ? s->rows[g->number].b[at] : 0.0;
        }
    ice_merged_fluxes(s, p);
    for (int k = 0; k < p->count; ++k) {
        const ice_member *lead = &p->member[p->lead[k]];
        const double step = ice_member_view(s, lead)->step[lead->at], *sum = p->sum + (size_t)k * MERGED_SUMS;
        b[lead_index(s, p, k)] = -(volume_of(s, p, k) / resistance_of(s, p, k) * step + s->dt * sum[MERGED_FLUX]) / box;
    }
}

/* The first guess is one for all members of a merged cell. */
static void guess_alike(const ice *s, const ice_region *g)
{
    const ice_merged_cells *p = ice_merged_cells_of(s, g);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k], *lead = &p->member[p->lead[m->merged]];
        const ice_view *v = ice_member_view(s, m), *of = ice_member_view(s, lead);
        v->P[m->at] = v->step[m->at] = of->last_step[lead->at];
    }
    ice_fill_ghosts(s, C_PRESSURE_ADVANCED, g->number, FILL_CURRENT, GHOST_ZERO_OPEN);
}

/* P of the members, by the steps of pressure so far. */
static void press_members(const ice *s, const ice_region *g)
{
    const ice_merged_cells *p = ice_merged_cells_of(s, g);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k], *lead = &p->member[p->lead[m->merged]];
        const ice_view *v = ice_member_view(s, m), *of = ice_member_view(s, lead);
        v->P[m->at] = (ice_has_weight(s) ? v->p[m->at] : of->p[lead->at]) + of->step[lead->at];
    }
}

/* The rows of a region by its present u*. */
static void find_rows(ice *s, const ice_region *g)
{
    ice_cut_views(s, g);
    ice_implicit_fractions(s, g);
    ice_merged_fluxes(s, ice_merged_cells_of(s, g)); /* volumes, for the matrix */
    find_matrix(s, g);
    find_right_side(s, g);
}

static floe_status guess_region(ice *s, const ice_region *g)
{
    ice_cut_views(s, g);
    TRY(ice_implicit_begin(s, g));
    ice_implicit_centre(s, g);
    ice_implicit_guess(s, g);
    guess_alike(s, g);
    ice_implicit_push(s, g);
    find_rows(s, g);
    press_members(s, g);
    return FLOE_OK;
}

floe_status ice_cut_guess(ice *s)
{
    for (int g = 0; g < s->n_regions; ++g) TRY(guess_region(s, &s->region[g]));
    return FLOE_OK;
}

/* ---- the search ---- */

/* What the operators of conjugate gradients work with. */
typedef struct cut_search {
    const ice *s;
    const wall_motion *walls;
    double *found; /* changes of pressure so far, of merged cells */
} cut_search;

typedef struct search_count {
    int outer, cg;
} search_count;

static double flux_factor(const ice *s)
{
    return s->dt / mesh_box_volume(s->mesh);
}

/* The walls' answer to the pressures of the merged cells, into `flux`. */
static void answer_of_walls(const cut_search *q)
{
    const ice_cut_system *w = q->s->cut_cells->system;
    q->walls->flux_of(q->walls->walls, w->pressure, w->flux);
}

/* Pressures of merged cells from a vector of the system. */
static void gather_pressures(const ice *s, double *x, double *pressure)
{
    int first = 0;
    for (int g = 0; g < s->n_regions; ++g) {
        const ice_merged_cells *p = ice_merged_cells_of(s, &s->region[g]);
        const double *of = part_of(s, &s->region[g], x);
        for (int k = 0; k < p->count; ++k) pressure[first + k] = of[lead_index(s, p, k)];
        first += p->count;
    }
}

/* y += dt B M^-1 B^T x, less what the preconditioner's matrix has of it. */
static void add_wall_responses(const cut_search *q, double *x, double *y)
{
    const ice *s = q->s;
    const ice_cut_system *w = s->cut_cells->system;
    gather_pressures(s, x, w->pressure);
    answer_of_walls(q);
    int first = 0;
    for (int g = 0; g < s->n_regions; ++g) {
        const ice_merged_cells *p = ice_merged_cells_of(s, &s->region[g]);
        double *to = part_of(s, &s->region[g], y);
        for (int k = 0; k < p->count; ++k) {
            const int c = first + k;
            to[lead_index(s, p, k)] += flux_factor(s) * (w->flux[c] - w->own[c] * w->pressure[c]);
        }
        first += p->count;
    }
}

static void apply_matrix(void *user, double *x, double *y)
{
    const cut_search *q = user;
    const ice *s = q->s;
    for (int g = 0; g < s->n_regions; ++g) {
        const ice_merged_cells *p = ice_merged_cells_of(s, &s->region[g]);
        double *from = part_of(s, &s->region[g], x), *to = part_of(s, &s->region[g], y);
        spread_lead(s, p, from);
        multigrid_apply(s->rows[g].m, from, to);
        gather_at_lead(s, p, to);
        drop_others(s, p, from);
    }
    add_wall_responses(q, x, y);
}

static void apply_preconditioner(void *user, double *x, double *y)
{
    const cut_search *q = user;
    const ice *s = q->s;
    for (int g = 0; g < s->n_regions; ++g) {
        double *to = part_of(s, &s->region[g], y);
        multigrid_cycle(s->rows[g].m, part_of(s, &s->region[g], x), to);
        drop_others(s, ice_merged_cells_of(s, &s->region[g]), to);
    }
}

/* The walls' part of the right side, by all other forces and the changes of pressure so far, and of the preconditioner's diagonal. */
static floe_status meet_walls(ice *s, const cut_search *q)
{
    const ice_cut_system *w = s->cut_cells->system;
    int first = 0;
    memcpy(w->pressure, q->found, (size_t)s->walls->n_cells * sizeof(double));
    answer_of_walls(q);
    for (int g = 0; g < s->n_regions; ++g) {
        const ice_merged_cells *p = ice_merged_cells_of(s, &s->region[g]);
        double *b = part_of(s, &s->region[g], w->b), *sink = multigrid_links(s->rows[g].m).sink;
        for (int k = 0; k < p->count; ++k) {
            const int c = first + k;
            const ptrdiff_t at = lead_index(s, p, k);
            w->own[c] = q->walls->own_flux(q->walls->walls, c);
            b[at] -= flux_factor(s) * (q->walls->flux[c] + w->flux[c]);
            sink[at] += flux_factor(s) * w->own[c];
        }
        first += p->count;
        TRY(multigrid_prepare(s->rows[g].m));
    }
    return FLOE_OK;
}

/* Largest error of a volume. */
static double largest_error(const ice *s)
{
    const ice_cut_system *w = s->cut_cells->system;
    double largest = 0.0;
    bool sound = true;
    for (size_t k = 0; k < (size_t)s->n_regions * w->size; ++k) {
        const double r = fabs(w->weight[k] * w->b[k]);
        largest = most(largest, r);
        sound = sound && isfinite(r);
    }
    return sound ? largest : DBL_MAX;
}

/* The changes of pressure that the present rows ask for. */
static floe_status solve_rows_of(ice *s, cut_search *q, search_count *n)
{
    ice_cut_system *w = s->cut_cells->system;
    const cg_system system = {apply_matrix, apply_preconditioner, q, CG_WEIGHTED, w->weight};
    const double tolerance = s->scene->method.pressure_tolerance;
    double best = INFINITY, residual = largest_error(s);
    memset(w->x, 0, (size_t)s->n_regions * w->size * sizeof *w->x);
    for (int outer = 0; residual > tolerance; ++outer, ++n->outer) {
        if (!(residual < ICE_HOPELESS_RESIDUAL * best) || outer == ICE_MOST_OUTER)
            return ice_implicit_give_up(s, residual, best, outer);
        best = fmin(best, residual);
        n->cg += cg_solve(w->c, &system, ice_implicit_tolerance(s, s->rows, residual), w->b, w->x).iterations;
        residual = largest_error(s);
    }
    return FLOE_OK;
}

/* They move the faces, and join those found before. */
static void take_changes(ice *s, double *found)
{
    ice_cut_system *w = s->cut_cells->system;
    gather_pressures(s, w->x, w->pressure);
    for (int c = 0; c < s->walls->n_cells; ++c) found[c] += w->pressure[c];
    for (int k = 0; k < s->n_regions; ++k) {
        const ice_region *g = &s->region[k];
        double *x = part_of(s, g, w->x);
        ice_cut_views(s, g);
        spread_lead(s, ice_merged_cells_of(s, g), x);
        memcpy(s->rows[k].x, x, w->size * sizeof *x);
        ice_implicit_take(s, g);
        ice_implicit_push(s, g);
    }
}

/* Of one fluid the rows are linear. Of several the volume fractions at faces follow u*, and with them the rows. */
static floe_status search_pressures(ice *s, cut_search *q)
{
    const double tolerance = s->scene->method.pressure_tolerance;
    search_count n = {0, 0};
    double best = INFINITY;
    TRY(meet_walls(s, q));
    for (int outer = 0;; ++outer) {
        TRY(solve_rows_of(s, q, &n));
        take_changes(s, q->found);
        if (!ice_is_mixture(s)) break;
        for (int g = 0; g < s->n_regions; ++g) find_rows(s, &s->region[g]);
        TRY(meet_walls(s, q));
        const double residual = largest_error(s);
        if (residual <= tolerance) break;
        if (!(residual < ICE_HOPELESS_RESIDUAL * best) || outer == ICE_MOST_OUTER)
            return ice_implicit_give_up(s, residual, best, outer);
        best = fmin(best, residual);
    }
    ice_implicit_tally(s, n.outer, n.cg);
    return FLOE_OK;
}

static floe_status reserve_walls(const ice *s, ice_cut_system *w, size_t n)
{
    if (n <= w->reserved) return FLOE_OK;
    TRY(memory_resize(s->ctx, &w->pressure, 2 * n, sizeof(double)));
    TRY(memory_resize(s->ctx, &w->flux, 2 * n, sizeof(double)));
    TRY(memory_resize(s->ctx, &w->own, 2 * n, sizeof(double)));
    w->reserved = 2 * n;
    return FLOE_OK;
}

floe_status ice_cut_solve(void *fluids, const wall_motion *motion, double *pressure)
{
    ice *s = fluids;
    cut_search q = {s, motion, pressure};
    TRY(reserve_walls(s, s->cut_cells->system, (size_t)s->walls->n_cells));
    memset(pressure, 0, (size_t)s->walls->n_cells * sizeof *pressure);
    return search_pressures(s, &q);
}

/* ---- after the walls have moved ---- */

/* dP of merged cells by the fluxes, those of the walls as they move. `cell`: the region's first in the wall_response. */
static void expand_members(const ice *s, const ice_region *g, const wall_cell *cell)
{
    ice_merged_cells *p = ice_merged_cells_of(s, g);
    ice_merged_fluxes(s, p);
    for (int k = 0; k < p->n; ++k) {
        const ice_member *m = &p->member[k];
        const double flux = p->sum[(size_t)m->merged * MERGED_SUMS + MERGED_FLUX] + cell[m->merged].flux;
        ice_member_view(s, m)->dP[m->at] = -s->dt * flux / volume_of(s, p, m->merged) * stiffness_of(s, p, m->merged);
    }
}

static floe_status take_region(ice *s, const ice_region *g, const wall_cell *cell)
{
    ice_cut_views(s, g);
    for (int r = g->first; g->n > 1 && r < g->first + g->n; ++r) ice_fill_faces(s, F_VEL, r);
    ice_implicit_advance(s, g);
    if (g->n > 1) ice_still_elsewhere(s, ice_merged_cells_of(s, g));
    expand_members(s, g, cell);
    press_members(s, g);
    ice_fill_increment(s, g);
    return ice_face_pressure_of(s, g);
}

floe_status ice_cut_take(ice *s)
{
    const wall_cell *cell = s->walls->cell;
    for (int g = 0; g < s->n_regions; ++g) {
        TRY(take_region(s, &s->region[g], cell));
        cell += ice_merged_cells_of(s, &s->region[g])->count;
    }
    return FLOE_OK;
}
