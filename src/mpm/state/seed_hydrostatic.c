/* Fluid points at rest under their own weight (theory 4.8). Cells are walked down column by column; a run is what fluid a column has between two
 * cells without. Runs that are open above, or end at a side, begin without weight. Those below a solid have the pressure of the fluid beside
 * them; where a vessel of points is closed all over, its highest run begins. Fluid that nothing holds falls, and has no weight. */
#include "mpm/state/seed_hydrostatic.h"

#include "base/memory.h"
#include "mpm/state/seed_fill.h"
#include "scene/fluid_columns.h"

#include <math.h>

enum { MOST_PASSES = 60 };

/* What fluid points a cell has. Depths are along the pull. */
typedef struct column_cell {
    double volume, load; /* m3; N/m3 times it */
    double top;          /* m: depth at which its fluid begins */
    double above;        /* Pa: weight there */
    bool solid;          /* it has points of solids */
    bool settled;        /* its fluid is borne, and `above` is right */
} column_cell;

/* Cells with fluid, one below the other. */
typedef struct fluid_run {
    size_t first; /* the highest */
    int n;
    bool covered; /* by a solid, and not settled yet */
} fluid_run;

typedef struct hydrostatic {
    const mpm *s;
    const seed_list *list;
    double pull[SCENE_MAX_BODIES]; /* m/s2, of the scene's bodies */
    int axis;
    double way;          /* along the axis: 1 up, -1 down */
    ptrdiff_t stride[3]; /* from a cell to the next along each axis */
    ptrdiff_t down;      /* from a cell to the one below */
    column_cell *cell;   /* owned */
    fluid_run *run;      /* owned */
    int runs;
} hydrostatic;

/* The k-th cell of a run from its upper end. */
static size_t run_cell(const hydrostatic *w, const fluid_run *run, int k)
{
    return (size_t)((ptrdiff_t)run->first + k * w->down);
}

static double depth(const hydrostatic *w, double x)
{
    return w->way * x;
}

/* Depth of the upper end of a cell, by its place along the axis. */
static double upper_end(const hydrostatic *w, int place)
{
    return depth(w, mesh_node(w->s->mesh, w->axis, w->way > 0.0 ? place : place + 1));
}

floe_status fluid_state_below(const mpm *s, int body, const double x[3], double weight, fluid_state *out,
                              double velocity[3])
{
    const int material = s->body[body].scene_material;
    const eos *law = &s->scene->material[material].eos;
    double slope;
    TRY(body_fluid_state(s->scene, s->body[body].scene_body, x, out, velocity));
    if (weight == 0.0) return FLOE_OK;
    law->model->dpde(law->par, 1, &out->density, &out->energy, &slope);
    const bool keeps_density = slope > 0.0 && scene_is_given_by_density(s->scene, material);
    return fluid_state_of(s->ctx, law, out->pressure + weight, keeps_density ? (double)NAN : out->temperature,
                          keeps_density ? out->density : (double)NAN, out);
}

/* ---- what is where ---- */

static void note_points(hydrostatic *w)
{
    const mpm *s = w->s;
    for (int body = 0; body < s->n_bodies; ++body) {
        const seed_list *list = &w->list[body];
        for (size_t n = 0; n < list->n; ++n) {
            column_cell *c = &w->cell[seed_cell_of(w->s->mesh, &w->list[body], n)];
            if (!s->body[body].fluid) {
                c->solid = true;
                continue;
            }
            const double top = depth(w, list->x[w->axis][n]) - list->half[w->axis][n];
            c->top = c->volume > 0.0 ? fmin(c->top, top) : top;
            c->volume += list->volume[n];
        }
    }
}

/* Whether a side holds the fluid that stands on it. */
static bool side_holds(const mpm *s, int axis, double way)
{
    const bc_kind kind = s->scene->bc.side[axis][way > 0.0 ? SIDE_UPPER : SIDE_LOWER].kind;
    return kind != BC_FREE && kind != BC_PERIODIC && !bc_gives_pressure(kind);
}

/* The run that begins at a place of a column, in cells from its upper end; it is added to the list where something holds it. */
static int add_run(hydrostatic *w, size_t highest, int begin, int cells)
{
    column_cell *first = &w->cell[(ptrdiff_t)highest + begin * w->down];
    fluid_run run = {.first = (size_t)(first - w->cell)};
    while (begin + run.n < cells && first[run.n * w->down].volume > 0.0) ++run.n;
    const column_cell *last = &first[(run.n - 1) * w->down];
    const bool on_side = begin + run.n == cells;
    const bool borne = last->solid || (on_side ? side_holds(w->s, w->axis, w->way) : last[w->down].solid);
    run.covered = first->solid || (begin > 0 && first[-w->down].solid);
    for (int k = 0; k < run.n; ++k) first[k * w->down].settled = borne && !run.covered;
    if (borne) w->run[w->runs++] = run;
    return run.n;
}

static void find_runs(hydrostatic *w)
{
    const mesh *m = w->s->mesh;
    const int cells = m->n[w->axis];
    int columns[3] = {m->n[0], m->n[1], m->n[2]};
    columns[w->axis] = 1;
    for (int k = 0; k < columns[2]; ++k)
        for (int j = 0; j < columns[1]; ++j)
            for (int i = 0; i < columns[0]; ++i) {
                int top[3] = {i, j, k};
                top[w->axis] = w->way > 0.0 ? 0 : cells - 1;
                const size_t highest = (size_t)(top[0] * w->stride[0] + top[1] * w->stride[1] + top[2] * w->stride[2]);
                for (int at = 0; at < cells;) {
                    const bool fluid = w->cell[(ptrdiff_t)highest + at * w->down].volume > 0.0;
                    at += fluid ? add_run(w, highest, at, cells) : 1;
                }
            }
}

/* ---- what it weighs ---- */

static int place_of(const hydrostatic *w, size_t cell, int axis)
{
    return (int)(cell / (size_t)w->stride[axis]) % w->s->mesh->n[axis];
}

/* Weight of the fluid above the middle of a cell. */
static double weight_at_middle(const hydrostatic *w, size_t cell)
{
    const column_cell *c = &w->cell[cell];
    const double middle = upper_end(w, place_of(w, cell, w->axis)) + 0.5 * w->s->mesh->h[w->axis];
    return c->above + c->load / c->volume * (middle - c->top);
}

static floe_status sum_loads(hydrostatic *w, double *const weight[SCENE_MAX_BODIES])
{
    const mpm *s = w->s;
    for (size_t k = 0; k < mesh_cells(s->mesh); ++k) w->cell[k].load = 0.0;
    for (int body = 0; body < s->n_bodies; ++body) {
        const seed_list *list = &w->list[body];
        const double pull = fabs(w->pull[s->body[body].scene_body]);
        for (size_t n = 0; s->body[body].fluid && n < list->n; ++n) {
            double x[3] = {0.0}, velocity[3];
            fluid_state state;
            for (int a = 0; a < s->mesh->dim; ++a) x[a] = list->x[a][n];
            TRY(fluid_state_below(s, body, x, weight[body][n], &state, velocity));
            w->cell[seed_cell_of(w->s->mesh, &w->list[body], n)].load += state.density * pull * list->volume[n];
        }
    }
    return FLOE_OK;
}

/* From the top of a run, where the weight is none, down. */
static void press_run(const hydrostatic *w, const fluid_run *run)
{
    double above = 0.0;
    for (int k = 0; k < run->n; ++k) {
        const size_t cell = run_cell(w, run, k);
        column_cell *c = &w->cell[cell];
        const double upper = upper_end(w, place_of(w, cell, w->axis));
        if (k > 0) c->top = upper;
        c->above = above;
        above += c->load / c->volume * (upper + w->s->mesh->h[w->axis] - c->top);
        c->settled = !run->covered;
    }
}

/* Adds to a covered run what the fluid beside it has more, in the mean over the cells that have settled fluid beside them; false: none has. */
static bool meet_neighbours(const hydrostatic *w, const fluid_run *run)
{
    const mesh *m = w->s->mesh;
    double more = 0.0;
    int met = 0;
    for (int k = 0; k < run->n; ++k)
        for (int f = 0; f < 2 * m->dim; ++f) {
            const size_t cell = run_cell(w, run, k);
            const int axis = f / 2, place = place_of(w, cell, axis) + (f % 2 ? 1 : -1);
            const size_t beside = (size_t)((ptrdiff_t)cell + (f % 2 ? 1 : -1) * w->stride[axis]);
            if (axis == w->axis || place < 0 || place >= m->n[axis] || !w->cell[beside].settled) continue;
            more += weight_at_middle(w, beside) - weight_at_middle(w, cell);
            met++;
        }
    for (int k = 0; k < run->n && met > 0; ++k) w->cell[run_cell(w, run, k)].above += more / met;
    return met > 0;
}

static void settle_run(const hydrostatic *w, fluid_run *run)
{
    for (int k = 0; k < run->n; ++k) w->cell[run_cell(w, run, k)].settled = true;
    run->covered = false;
}

/* The covered runs, a layer of them at a time: `met`, room for one mark a run. */
static void settle_covered(const hydrostatic *w, bool *met)
{
    for (int left = w->runs; left > 0;) {
        int highest = -1, settled = 0;
        left = 0;
        for (int k = 0; k < w->runs; ++k) {
            met[k] = w->run[k].covered && meet_neighbours(w, &w->run[k]);
            if (!w->run[k].covered) continue;
            left++;
            if (highest < 0 || w->cell[w->run[k].first].top < w->cell[w->run[highest].first].top) highest = k;
        }
        for (int k = 0; k < w->runs; ++k) {
            if (!met[k]) continue;
            settle_run(w, &w->run[k]);
            settled++;
        }
        if (settled == 0 && highest >= 0) settle_run(w, &w->run[highest]);
    }
}

/* Weight on every point; returns the largest change of one. */
static double press_points(const hydrostatic *w, double *const weight[SCENE_MAX_BODIES])
{
    double change = 0.0;
    for (int body = 0; body < w->s->n_bodies; ++body) {
        const seed_list *list = &w->list[body];
        for (size_t n = 0; w->s->body[body].fluid && n < list->n; ++n) {
            const column_cell *c = &w->cell[seed_cell_of(w->s->mesh, &w->list[body], n)];
            const double now =
                c->settled ? c->above + c->load / c->volume * (depth(w, list->x[w->axis][n]) - c->top) : 0.0;
            change = fmax(change, fabs(now - weight[body][n]));
            weight[body][n] = now;
        }
    }
    return change;
}

static double largest_weight(const hydrostatic *w, double *const weight[SCENE_MAX_BODIES])
{
    double largest = 0.0;
    for (int body = 0; body < w->s->n_bodies; ++body)
        for (size_t n = 0; w->s->body[body].fluid && n < w->list[body].n; ++n) largest = fmax(largest, weight[body][n]);
    return largest;
}

/* Densities follow the weights and these the densities, until nothing changes. */
static floe_status settle_pressures(hydrostatic *w, double *const weight[SCENE_MAX_BODIES])
{
    bool *covered = NULL, *met = NULL;
    const double enough = 1e-12;
    floe_status status = memory_new(w->s->ctx, &covered, (size_t)w->runs + 1, sizeof *covered);
    if (status == FLOE_OK) status = memory_new(w->s->ctx, &met, (size_t)w->runs + 1, sizeof *met);
    for (int k = 0; k < w->runs && status == FLOE_OK; ++k) covered[k] = w->run[k].covered;
    for (int pass = 0; pass < MOST_PASSES && status == FLOE_OK; ++pass) {
        status = sum_loads(w, weight);
        for (int k = 0; k < w->runs; ++k) {
            w->run[k].covered = covered[k];
            press_run(w, &w->run[k]);
        }
        settle_covered(w, met);
        if (press_points(w, weight) <= enough * largest_weight(w, weight)) break;
    }
    memory_free(w->s->ctx, &covered);
    memory_free(w->s->ctx, &met);
    return status;
}

static floe_status settle_columns(hydrostatic *w, double *weight[SCENE_MAX_BODIES])
{
    const mpm *s = w->s;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (w->pull[s->body[body].scene_body] != 0.0) w->way = w->pull[s->body[body].scene_body] > 0.0 ? 1.0 : -1.0;
        if (s->body[body].fluid) TRY(memory_new(s->ctx, &weight[body], w->list[body].n + 1, sizeof *weight[body]));
    }
    w->down = (w->way > 0.0 ? 1 : -1) * w->stride[w->axis];
    TRY(memory_new(s->ctx, &w->cell, mesh_cells(s->mesh), sizeof *w->cell));
    TRY(memory_new(s->ctx, &w->run, mesh_cells(s->mesh), sizeof *w->run));
    note_points(w);
    find_runs(w);
    return settle_pressures(w, weight);
}

floe_status find_hydrostatic_pressures(const mpm *s, const seed_list *list, double *weight[SCENE_MAX_BODIES])
{
    const mesh *m = s->mesh;
    hydrostatic w = {.s = s, .list = list, .way = -1.0, .stride = {1, m->n[0], (ptrdiff_t)m->n[0] * m->n[1]}};
    w.axis = scene_point_columns(s->scene, w.pull);
    if (w.axis < 0) return FLOE_OK;
    const floe_status status = settle_columns(&w, weight);
    memory_free(s->ctx, &w.cell);
    memory_free(s->ctx, &w.run);
    return status;
}
