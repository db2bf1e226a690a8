/* Merged cells: which cells share a state (ice_merged_cells.h). */
#include "ice/cut/ice_merged_cells.h"
#include "ice/cut/ice_wall_flow.h"

#include "base/memory.h"
#include "ice/ice_constants.h"
#include "ice/state/ice_materials.h"

#include <math.h>
#include <string.h>

bool ice_encloses(const ice *s, int line, int region)
{
    const int r = s->embedded.boundary[line].enclosed;
    if (region < 0) return false; /* where nobody is */
    const ice_region *g = &s->region[region];
    return r >= g->first && r < g->first + g->n;
}

int ice_line_about(const ice *s, int region)
{
    for (int l = 0; l < s->embedded.n_boundaries; ++l)
        if (ice_encloses(s, l, region)) return l;
    return -1;
}

/* What the boundary about a region has of a cell or face, less what those inside it take. */
static double share_left(const ice *s, double whole, double enclosed)
{
    return s->embedded.n_boundaries > 1 && fabs(whole - enclosed) < ICE_OPEN_ROUND_OFF ? 0.0 : whole - enclosed;
}

double ice_open_cell(const ice *s, int region, int place, const int cell[3])
{
    const ice_embedded_boundary *line = s->embedded.boundary;
    const int about = ice_line_about(s, region);
    const double whole = about < 0 ? 1.0 : cut_open(&line[about].place[place], cell);
    double enclosed = 0.0;
    for (int l = 0; l < s->embedded.n_boundaries; ++l)
        if (line[l].within == about && l != about) enclosed += cut_open(&line[l].place[place], cell);
    return enclosed == 0.0 ? whole : share_left(s, whole, enclosed);
}

double ice_open_face(const ice *s, int region, int place, const int cell[3], int axis, int side)
{
    const ice_embedded_boundary *line = s->embedded.boundary;
    const int about = ice_line_about(s, region);
    const double whole = about < 0 ? 1.0 : cut_face(&line[about].place[place], cell, axis, side);
    double enclosed = 0.0;
    for (int l = 0; l < s->embedded.n_boundaries; ++l)
        if (line[l].within == about && l != about) enclosed += cut_face(&line[l].place[place], cell, axis, side);
    return enclosed == 0.0 ? whole : share_left(s, whole, enclosed);
}

double ice_mean_face(const ice *s, int region, const int cell[3], int axis, int side)
{
    double sum = 0.0;
    for (int k = 0; k < ICE_CUT_PREDICTED; ++k) sum += ice_open_face(s, region, CUT_MEAN + k, cell, axis, side);
    return sum / ICE_CUT_PREDICTED;
}

double ice_outward(const ice *s, int region, int line)
{
    const int about = ice_line_about(s, region);
    return about == line ? 1.0 : s->embedded.boundary[line].within == about ? -1.0 : 0.0;
}

/* A region, or where nobody is. */
static int region_about(const ice *s, int line)
{
    const int within = s->embedded.boundary[line].within;
    return within < 0 ? -1 : ice_region_of(s, s->embedded.boundary[within].enclosed)->number;
}

/* What is left about a line, at least, of a cell and of its faces. */
static double least_about(const ice *s, int line, int place, const int cell[3])
{
    const int region = region_about(s, line);
    double least = ice_open_cell(s, region, place, cell);
    for (int f = 0; f < 2 * s->mesh->dim; ++f) least = fmin(least, ice_open_face(s, region, place, cell, f / 2, f % 2));
    return least;
}

/* Whether everything that a boundary encloses lies inside another one. */
static bool lies_in(const ice *s, int line, int other)
{
    const mesh *m = s->mesh;
    const cut_surface *in = &s->embedded.boundary[line].place[CUT_NOW],
                      *about = &s->embedded.boundary[other].place[CUT_NOW];
    double less = 0.0;
    for (int k = 0; k < m->n[2]; ++k)
        for (int j = 0; j < m->n[1]; ++j)
            for (int i = 0; i < m->n[0]; ++i) {
                const int cell[3] = {i, j, k};
                const double open = cut_open(in, cell), around = cut_open(about, cell);
                if (open > 0.0 && around < open - ICE_OPEN_ROUND_OFF) return false;
                less += around - open;
            }
    return less > 0.0;
}

/* The innermost of the boundaries around it is the one that lies inside all others around it. */
void ice_cut_nest(ice *s)
{
    for (int l = 0; l < s->embedded.n_boundaries; ++l) s->embedded.boundary[l].within = -1;
    if (scene_enclosing_body(s->scene) < 0) return; /* surfaces of solids are beside each other */
    for (int l = 0; l < s->embedded.n_boundaries; ++l)
        for (int k = 0; k < s->embedded.n_boundaries; ++k) {
            const int within = s->embedded.boundary[l].within;
            if (k != l && lies_in(s, l, k) && (within < 0 || lies_in(s, k, within))) s->embedded.boundary[l].within = k;
        }
}

floe_status ice_cut_check(const ice *s, int place)
{
    const double overlap = scene_enclosing_body(s->scene) < 0 ? ICE_CONTACT_OVERLAP : 0.0; /* of solids */
    for (int l = 0; l < s->embedded.n_boundaries && s->embedded.n_boundaries > 1; ++l) {
        const cut_surface *c = &s->embedded.boundary[l].place[place];
        for (int k = 0; k < c->n_cells; ++k) {
            const int *cell = c->cell[k].cell;
            if (least_about(s, l, place, cell) >= -overlap) continue;
            return fail(s->ctx, FLOE_RETRY, "%s cross each other%s, in cell (%d, %d) at (%g, %g)",
                        overlap > 0.0 ? "solids" : "membranes that hold gas",
                        overlap > 0.0 ? ", or one stands in the other" : "", cell[0], cell[1],
                        mesh_centre(s->mesh, 0, cell[0]), mesh_centre(s->mesh, 1, cell[1]));
        }
    }
    return FLOE_OK;
}

void ice_clear_merged(ice_merged_cells *p)
{
    memset(p->sum, 0, (size_t)p->count * MERGED_SUMS * sizeof *p->sum);
    if (p->fluid) memset(p->fluid, 0, (size_t)(p->count * p->region->n) * FLUID_SUMS * sizeof *p->fluid);
}

void ice_sum_open_volumes(const ice *s, ice_merged_cells *p)
{
    for (int k = 0; k < p->n; ++k)
        p->sum[(size_t)p->member[k].merged * MERGED_SUMS + MERGED_VOLUME] +=
            p->member[k].open * mesh_cell_volume(s->mesh, p->member[k].cell[0]);
}

static floe_status reserve_members(ice *s, ice_merged_cells *p)
{
    if ((size_t)p->n < p->reserved) return FLOE_OK;
    const size_t wanted = p->reserved + p->reserved / 2 + 64;
    TRY(memory_resize(s->ctx, &p->member, wanted, sizeof *p->member));
    TRY(memory_resize(s->ctx, &p->lead, wanted, sizeof *p->lead));
    TRY(memory_resize(s->ctx, &p->sum, wanted * MERGED_SUMS, sizeof *p->sum));
    if (p->region->n > 1)
        TRY(memory_resize(s->ctx, &p->fluid, wanted * (size_t)p->region->n * FLUID_SUMS, sizeof *p->fluid));
    p->reserved = wanted;
    return FLOE_OK;
}

/* Open fraction of a cell that a gas has reached. A gap that opens between bodies in contact has no gas, and counts as
 * closed until it is connected with the gas. */
static double fluid_volume_of_cell(const ice *s, const ice_region *g, int place, const int cell[3])
{
    const double open = ice_open_cell(s, g->number, place, cell);
    if (place != CUT_NOW || open == 0.0) return open;
    const int id = mesh_block_of(s->mesh, cell);
    const block *b = &s->mesh->block[id];
    const ptrdiff_t at = mesh_index(b, cell[0] - b->lo[0], cell[1] - b->lo[1], cell[2] - b->lo[2]);
    return field_get(s->domain->fields[id], C_OPEN, g->first, 0)[at] > 0.0 ? open : 0.0;
}

static floe_status add_member(ice *s, int place, ice_merged_cells *p, const int cell[3])
{
    const mesh *m = s->mesh;
    int *number = &p->place[cut_index(m, cell)];
    if (*number >= 0) return FLOE_OK;
    TRY(reserve_members(s, p));
    ice_member *k = &p->member[p->n];
    *k = (ice_member){.cell = {cell[0], cell[1], cell[2]}, .block = mesh_block_of(m, cell), .merged = p->n};
    const block *b = &m->block[k->block];
    k->at = mesh_index(b, cell[0] - b->lo[0], cell[1] - b->lo[1], cell[2] - b->lo[2]);
    k->open = fluid_volume_of_cell(s, p->region, place, cell);
    for (int f = 0; f < 2 * m->dim; ++f)
        k->face[f / 2][f % 2] = ice_mean_face(s, p->region->number, cell, f / 2, f % 2);
    *number = p->n++;
    return FLOE_OK;
}

/* Shares of the fluids in a cell, by volume, as their densities at the start have it. */
static void shares_in(const ice *s, const ice_region *g, const int cell[3], double *share)
{
    const int id = mesh_block_of(s->mesh, cell);
    const block *b = &s->mesh->block[id];
    const ptrdiff_t at = mesh_index(b, cell[0] - b->lo[0], cell[1] - b->lo[1], cell[2] - b->lo[2]);
    double sum = 0.0;
    for (int r = 0; r < g->n; ++r) {
        share[r] = field_get(s->domain->fields[id], C_RHO, g->first + r, 0)[at] / s->cut_cells->usual[g->first + r];
        sum += share[r];
    }
    for (int r = 0; r < g->n; ++r) share[r] = sum > 0.0 ? share[r] / sum : 0.0;
}

/* How alike two cells are in their fluids, from 0 to 1: merging mixes. The densities are those of the start of the step
 * throughout it. */
static double likeness(const ice *s, const ice_region *g, const ice_member *k, const int cell[3])
{
    double own[ICE_MAX_MATERIALS], other[ICE_MAX_MATERIALS], common = 0.0;
    if (g->n == 1 || k->open == 0.0) return 1.0;
    shares_in(s, g, k->cell, own);
    shares_in(s, g, cell, other);
    for (int r = 0; r < g->n; ++r) common += least(own[r], other[r]);
    return pow(common, 8.0);
}

/* The neighbour with which a cell is merged: the one with the largest open fraction, larger than its own, behind a face
 * that is open with the boundaries at `through`; where fluids share cells, one with the same. */
static bool find_neighbour(const ice *s, const ice_region *g, int place, int through, const ice_member *k, int out[3])
{
    double best = 0.0;
    for (int f = 0; f < 2 * s->mesh->dim; ++f) {
        int cell[3] = {k->cell[0], k->cell[1], k->cell[2]};
        if (!mesh_step(s->mesh, cell, f / 2, f % 2 == SIDE_UPPER ? 1 : -1)) continue;
        const double open = fluid_volume_of_cell(s, g, place, cell);
        const double score =
            open * ice_open_face(s, g->number, through, k->cell, f / 2, f % 2) * likeness(s, g, k, cell);
        /* Of two alike the first: chosen by round-off, the host would change from step to step, and what one has too much go to the other. */
        if (!(open > k->open) || !(score > (1.0 + ICE_ALIKE) * best)) continue;
        best = score;
        memcpy(out, cell, sizeof cell);
    }
    return best > 0.0;
}

/* Of a cell that is all covered and has no such neighbour, the one with the largest open fraction of all around. */
static bool find_refuge(const ice *s, const ice_region *g, int place, const ice_member *k, int out[3])
{
    double best = 0.0;
    const int around = s->mesh->dim > 2 ? 27 : 9;
    for (int n = 0; n < around; ++n) {
        const int step[3] = {n % 3 - 1, n / 3 % 3 - 1, s->mesh->dim > 2 ? n / 9 - 1 : 0};
        int cell[3] = {k->cell[0], k->cell[1], k->cell[2]};
        bool inside = n != around / 2;
        for (int a = 0; a < 3; ++a) inside = mesh_step(s->mesh, cell, a, step[a]) && inside;
        if (!inside) continue;
        const double open = fluid_volume_of_cell(s, g, place, cell);
        if (!(open > best)) continue;
        best = open;
        memcpy(out, cell, sizeof cell);
    }
    return best > 0.0;
}

/* Positions of the boundaries in a step, first that at which cells are merged. */
typedef struct step_places {
    int at[CUT_PLACES];
    int n;
} step_places;

static step_places places_of(ice_merge_time when)
{
    step_places l = {.n = 0};
    l.at[l.n++] = when == MERGE_AFTER ? CUT_NEXT : CUT_NOW;
    for (int k = 0; k < ICE_CUT_PREDICTED; ++k) l.at[l.n++] = CUT_MEAN + k;
    if (when != MERGE_BEFORE) l.at[l.n++] = when == MERGE_AFTER ? CUT_NOW : CUT_NEXT;
    return l;
}

/* The cell whose state a member takes. A covered cell belongs to whom it flows to or from while it is open, now or at
 * another time of the step. */
static bool find_host(const ice *s, const ice_region *g, const step_places *l, const ice_member *m, int cell[3])
{
    if (find_neighbour(s, g, l->at[0], l->at[0], m, cell)) return true;
    for (int k = 1; k < l->n && m->open == 0.0; ++k)
        if (find_neighbour(s, g, l->at[0], l->at[k], m, cell)) return true;
    return m->open == 0.0 && find_refuge(s, g, l->at[0], m, cell);
}

/* The member with which another is merged; itself where it is not. */
static floe_status root_member(ice *s, const step_places *l, ice_merged_cells *p, int k)
{
    int cell[3];
    const ice_member *m = &p->member[k];
    if (m->open >= ICE_SMALL_CELL || !find_host(s, p->region, l, m, cell)) return FLOE_OK;
    TRY(add_member(s, l->at[0], p, cell));
    p->member[k].merged = p->place[cut_index(s->mesh, cell)];
    return FLOE_OK;
}

/* The member at the end of the chain of those with which one is merged. */
static int end_of_chain(const ice_merged_cells *p, int k)
{
    while (p->member[k].merged != k) k = p->member[k].merged;
    return k;
}

static bool is_thin(const ice_merged_cells *p, int k)
{
    return p->member[k].open < ICE_THIN_GAP;
}

/* A neighbour through an open face, now or at another time of the step, whose merged cell is more than a thin gap; -1: none is. */
static int way_out(const ice *s, const step_places *l, const ice_merged_cells *p, int k)
{
    const ice_member *m = &p->member[k];
    for (int n = 0; n < l->n; ++n)
        for (int f = 0; f < 2 * s->mesh->dim; ++f) {
            int cell[3] = {m->cell[0], m->cell[1], m->cell[2]};
            if (!mesh_step(s->mesh, cell, f / 2, f % 2 == SIDE_UPPER ? 1 : -1)) continue;
            const int other = p->place[cut_index(s->mesh, cell)];
            if (other < 0 || is_thin(p, end_of_chain(p, other))) continue;
            if (ice_open_face(s, p->region->number, l->at[n], m->cell, f / 2, f % 2) > 0.0) return other;
        }
    return -1;
}

/* A gap thinner than a tenth of a cell, all along, has the state of the gas at its end: its own would follow neither the
 * walls that close it nor those that open it (theory 7.2). From its ends inwards, a cell a round. */
static void join_thin_gaps(const ice *s, const step_places *l, ice_merged_cells *p)
{
    bool found = true;
    while (found) {
        found = false;
        for (int k = 0; k < p->n; ++k)
            p->lead[k] = p->member[k].merged == k && is_thin(p, k) ? way_out(s, l, p, k) : -1;
        for (int k = 0; k < p->n; ++k) {
            if (p->lead[k] < 0) continue;
            p->member[k].merged = p->lead[k];
            found = true;
        }
    }
}

/* Whether a boundary about a region crosses a face at some time of the step. */
static bool is_crossed(const ice *s, const step_places *l, int region, const int cell[3], int axis, int side)
{
    for (int b = 0; b < s->embedded.n_boundaries; ++b)
        for (int n = 0; n < l->n && ice_outward(s, region, b) != 0.0; ++n)
            if (cut_crosses(&s->embedded.boundary[b].place[l->at[n]], cell, axis, side)) return true;
    return false;
}

/* A pocket of gas between solids in contact, with a state of its own. */
static bool is_pocket(const ice_merged_cells *p, int k)
{
    return p->member[k].merged == k && p->member[k].open > 0.0 && p->member[k].open < ICE_POCKET;
}

/* To where the joint leads from a member, by what its neighbours know; -1: not known yet. */
static int along_joint(const ice *s, const step_places *l, const ice_merged_cells *p, int k)
{
    const ice_member *m = &p->member[k];
    for (int f = 0; f < 2 * s->mesh->dim; ++f) {
        int cell[3] = {m->cell[0], m->cell[1], m->cell[2]};
        if (!mesh_step(s->mesh, cell, f / 2, f % 2 == SIDE_UPPER ? 1 : -1)) continue;
        const int other = p->place[cut_index(s->mesh, cell)];
        if (other >= 0 && p->lead[other] >= 0 && is_crossed(s, l, p->region->number, m->cell, f / 2, f % 2))
            return p->lead[other];
    }
    return -1;
}

/* A pocket that is closed all round follows its walls as little as a thin gap does, and is as thin as solids in contact leave it: it has the state of the gas
 * at the end of the joint, which leads there through faces that surfaces cross, closed or not. */
static void join_pockets(const ice *s, const step_places *l, ice_merged_cells *p)
{
    bool found = false;
    for (int k = 0; k < p->n && !found; ++k) found = is_pocket(p, k);
    for (int k = 0; k < p->n && found; ++k) p->lead[k] = is_thin(p, end_of_chain(p, k)) ? -1 : k;
    while (found) {
        found = false;
        for (int k = 0; k < p->n; ++k) {
            const int to = p->lead[k] == -1 ? along_joint(s, l, p, k) : -1;
            if (to < 0) continue;
            p->lead[k] = -2 - to; /* its neighbours see it in the next round */
            found = true;
        }
        for (int k = 0; k < p->n; ++k)
            if (p->lead[k] < -1) p->lead[k] = -2 - p->lead[k];
    }
    for (int k = 0; k < p->n; ++k)
        if (is_pocket(p, k) && p->lead[k] >= 0) p->member[k].merged = p->lead[k];
}

/* Numbers the merged cells from the chains of members. */
static void number_merged_cells(ice_merged_cells *p)
{
    p->count = 0;
    for (int k = 0; k < p->n; ++k)
        if (p->member[k].merged == k) p->lead[p->count++] = k;
    for (int k = 0; k < p->n; ++k) {
        int root = k;
        while (p->member[root].merged != root) root = p->member[root].merged;
        p->sum[k] = root; /* waits here while the chains are needed */
    }
    for (int k = 0; k < p->n; ++k) p->member[k].merged = -1 - (int)p->sum[k];
    for (int n = 0; n < p->count; ++n) p->sum[p->lead[n]] = n;
    for (int k = 0; k < p->n; ++k) p->member[k].merged = (int)p->sum[-1 - p->member[k].merged];
}

/* Cells that the boundaries of a gas cut at a position are members. */
static floe_status add_cut_cells(ice *s, int place, int at, ice_merged_cells *p)
{
    for (int l = 0; l < s->embedded.n_boundaries; ++l) {
        const cut_surface *c = &s->embedded.boundary[l].place[at];
        if (ice_outward(s, p->region->number, l) == 0.0) continue;
        for (int k = 0; k < c->n_cells; ++k) TRY(add_member(s, place, p, c->cell[k].cell));
    }
    return FLOE_OK;
}

floe_status ice_merge_cells(ice *s, ice_merge_time when, ice_merged_cells *out)
{
    const step_places l = places_of(when);
    for (int k = 0; k < out->n; ++k) out->place[cut_index(s->mesh, out->member[k].cell)] = -1;
    out->n = 0;
    for (int k = 0; k < l.n; ++k) TRY(add_cut_cells(s, l.at[0], l.at[k], out));
    for (int k = 0; k < out->n; ++k) TRY(root_member(s, &l, out, k));
    join_thin_gaps(s, &l, out);
    join_pockets(s, &l, out);
    number_merged_cells(out);
    if (ice_has_weight(s) || ice_sees_walls(s)) ice_merged_centre(s, l.at[0], out);
    return FLOE_OK;
}

void ice_cut_views(const ice *s, const ice_region *g)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) ice_view_make(s, g, id, &s->cut_cells->view[id]);
}

/* The initial state of a gas, of its first body or of the ambient. */
static floe_status find_rest(ice *s, int r, fluid_state *out)
{
    const scene *given = s->scene;
    const int material = s->material[r].scene_material;
    for (int b = 0; b < given->n_bodies; ++b) {
        const scene_body *body = &given->body[b];
        if (body->material != material) continue;
        return fail_under(
            s->ctx, fluid_state_of(s->ctx, &s->material[r].eos, body->pressure, body->temperature, body->density, out),
            KEY("bodies", body->name));
    }
    return fail_under(
        s->ctx,
        fluid_state_of(s->ctx, &s->material[r].eos, given->ambient_pressure, given->ambient_temperature, NAN, out),
        KEY("ambient"));
}

static floe_status new_merged_cells(const ice *s, const ice_region *g, ice_merged_cells *p)
{
    p->region = g;
    const size_t cells = mesh_cells(s->mesh);
    TRY(memory_new(s->ctx, &p->place, cells, sizeof *p->place));
    for (size_t k = 0; k < cells; ++k) p->place[k] = -1;
    return FLOE_OK;
}

/* The boundaries and the material that each encloses; the surfaces of solids are one boundary beside each region. */
static void find_lines(ice *s)
{
    int body[SCENE_MAX_ENCLOSING];
    const int holders = scene_enclosing_bodies(s->scene, body);
    const int regions = s->n_regions < SCENE_MAX_ENCLOSING ? s->n_regions : SCENE_MAX_ENCLOSING;
    s->embedded = (ice_embedded){.n_boundaries = holders > 0 ? holders : regions};
    for (int l = 0; l < s->embedded.n_boundaries; ++l) s->embedded.boundary[l].within = -1;
    for (int l = 0; l < regions && holders == 0; ++l) s->embedded.boundary[l].enclosed = s->region[l].first;
    for (int l = 0; l < holders; ++l)
        s->embedded.boundary[l].enclosed = ice_material_of(s, s->scene->body[body[l]].membrane.encloses);
}

floe_status ice_cut_cells_create(ice *s)
{
    find_lines(s);
    if (s->n_regions > s->embedded.n_boundaries + 1)
        return fail_key(s->ctx, KEY("bodies"),
                        "of membranes that enclose gas each has one inside, and one gas or none is outside all");
    TRY(memory_new(s->ctx, &s->cut_cells, 1, sizeof *s->cut_cells));
    ice_cut_cells *w = s->cut_cells;
    for (int g = 0; g < s->n_regions; ++g) {
        TRY(new_merged_cells(s, &s->region[g], &w->now[g]));
        TRY(new_merged_cells(s, &s->region[g], &w->next[g]));
        TRY(find_rest(s, s->region[g].first, &w->rest[g]));
    }
    for (int r = 0; r < s->n_materials; ++r) {
        fluid_state rest;
        TRY(find_rest(s, r, &rest));
        w->usual[r] = rest.density;
    }
    if (s->implicit) TRY(ice_cut_system_create(s));
    return memory_new(s->ctx, &w->view, (size_t)s->mesh->n_blocks, sizeof *w->view);
}

static void free_merged_cells(context *ctx, ice_merged_cells *p)
{
    memory_free(ctx, &p->member);
    memory_free(ctx, &p->lead);
    memory_free(ctx, &p->place);
    memory_free(ctx, &p->sum);
    memory_free(ctx, &p->fluid);
}

void ice_cut_cells_destroy(context *ctx, ice_cut_cells **w)
{
    if (!*w) return;
    for (int g = 0; g < ICE_CUT_REGIONS; ++g) {
        free_merged_cells(ctx, &(*w)->now[g]);
        free_merged_cells(ctx, &(*w)->next[g]);
        ice_wall_flow_destroy(ctx, &(*w)->wall[g]);
        memory_free(ctx, &(*w)->spread[g].before);
    }
    ice_cut_system_destroy(ctx, &(*w)->system);
    memory_free(ctx, &(*w)->view);
    memory_free(ctx, w);
}
