/* Pools of cells: which cells share a state (ice_pool.h). */
#include "ice/sealed/ice_pool.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* A cell of which less than this is left to a gas shares a neighbour's state. */
static const double small_cell = 0.5;

/* Outside several lines a share this close to none is none: round-off of their sum. */
static const double none = 1e-13;

/* The line that holds a gas; -1: none does. */
static int line_of(const ice *s, int gas)
{
    for (int l = 0; l < s->seal.n_lines; ++l)
        if (s->seal.line[l].held == gas) return l;
    return -1;
}

static double outside(const ice *s, double held)
{
    return s->seal.n_lines > 1 && fabs(1.0 - held) < none ? 0.0 : 1.0 - held;
}

double ice_open_cell(const ice *s, int gas, int place, const int cell[2])
{
    const int own = line_of(s, gas);
    double held = 0.0;
    if (own >= 0) return cut_open(&s->seal.line[own].place[place], cell);
    for (int l = 0; l < s->seal.n_lines; ++l) held += cut_open(&s->seal.line[l].place[place], cell);
    return outside(s, held);
}

double ice_open_face(const ice *s, int gas, int place, const int cell[2], int axis, int side)
{
    const int own = line_of(s, gas);
    double held = 0.0;
    if (own >= 0) return cut_face(&s->seal.line[own].place[place], cell, axis, side);
    for (int l = 0; l < s->seal.n_lines; ++l) held += cut_face(&s->seal.line[l].place[place], cell, axis, side);
    return outside(s, held);
}

double ice_mean_face(const ice *s, int gas, const int cell[2], int axis, int side)
{
    double sum = 0.0;
    for (int k = 0; k < ICE_SEAL_PLACES; ++k) sum += ice_open_face(s, gas, SEAL_MEAN + k, cell, axis, side);
    return sum / ICE_SEAL_PLACES;
}

double ice_outward(const ice *s, int gas, int line)
{
    const int own = line_of(s, gas);
    return own < 0 ? -1.0 : own == line ? 1.0 : 0.0;
}

/* What is left outside all lines, at least, of a cell and of its faces. */
static double least_outside(const ice *s, int place, const int cell[2])
{
    const int nobody = -1;
    double least = ice_open_cell(s, nobody, place, cell);
    for (int f = 0; f < 2 * s->mesh->dim; ++f) least = fmin(least, ice_open_face(s, nobody, place, cell, f / 2, f % 2));
    return least;
}

floe_status ice_seal_check(const ice *s, int place)
{
    const double overlap = scene_holder(s->scene) < 0 ? 1e-6 : 0.0; /* of solids in touch, by round-off */
    for (int l = 0; l < s->seal.n_lines && s->seal.n_lines > 1; ++l) {
        const cut_surface *c = &s->seal.line[l].place[place];
        for (int k = 0; k < c->n_cells; ++k) {
            const int *cell = c->cell[k].cell;
            if (least_outside(s, place, cell) >= -overlap) continue;
            return fail(s->ctx, FLOE_RETRY,
                        "%s cross each other, or one stands in the other, in cell (%d, %d) at (%g, %g)",
                        overlap > 0.0 ? "solids" : "membranes that hold gas", cell[0], cell[1],
                        mesh_centre(s->mesh, 0, cell[0]), mesh_centre(s->mesh, 1, cell[1]));
        }
    }
    return FLOE_OK;
}

void ice_pools_clear(ice_pools *p)
{
    memset(p->sum, 0, (size_t)p->count * POOL_SUMS * sizeof *p->sum);
}

static floe_status make_room(ice *s, ice_pools *p)
{
    if ((size_t)p->n < p->room) return FLOE_OK;
    const size_t wanted = p->room + p->room / 2 + 64;
    TRY(memory_resize(s->ctx, &p->member, wanted, sizeof *p->member));
    TRY(memory_resize(s->ctx, &p->lead, wanted, sizeof *p->lead));
    TRY(memory_resize(s->ctx, &p->sum, wanted * POOL_SUMS, sizeof *p->sum));
    p->room = wanted;
    return FLOE_OK;
}

/* Room of a cell that a gas has reached. A gap that opens between bodies in touch holds none, and counts as closed until
 * it is one room with the gas. */
static double room_of(const ice *s, int gas, int place, const int cell[2])
{
    const double open = ice_open_cell(s, gas, place, cell);
    if (place != SEAL_NOW || open == 0.0) return open;
    const int whole[3] = {cell[0], cell[1], 0}, id = mesh_block_of(s->mesh, whole);
    const block *b = &s->mesh->block[id];
    const ptrdiff_t at = mesh_index(b, cell[0] - b->lo[0], cell[1] - b->lo[1], 0);
    return field_get(s->domain->fields[id], C_OPEN, gas, 0)[at] > 0.0 ? open : 0.0;
}

static floe_status add_member(ice *s, int gas, int place, ice_pools *p, const int cell[2])
{
    const mesh *m = s->mesh;
    int *number = &p->place[cut_index(m, cell)];
    if (*number >= 0) return FLOE_OK;
    TRY(make_room(s, p));
    const int whole[3] = {cell[0], cell[1], 0};
    ice_member *k = &p->member[p->n];
    *k = (ice_member){.cell = {cell[0], cell[1]}, .block = mesh_block_of(m, whole), .pool = p->n};
    const block *b = &m->block[k->block];
    k->at = mesh_index(b, cell[0] - b->lo[0], cell[1] - b->lo[1], 0);
    k->open = room_of(s, gas, place, cell);
    for (int f = 0; f < 2 * m->dim; ++f) k->face[f / 2][f % 2] = ice_mean_face(s, gas, cell, f / 2, f % 2);
    *number = p->n++;
    return FLOE_OK;
}

static bool inside(const mesh *m, const int cell[2])
{
    return cell[0] >= 0 && cell[0] < m->n[0] && cell[1] >= 0 && cell[1] < m->n[1];
}

/* The neighbour whose state a cell takes: the one with most room behind a face that is open while the lines are at
 * `through`, and with more than its own. */
static bool find_neighbour(const ice *s, int gas, int place, int through, const ice_member *k, int out[2])
{
    double best = 0.0;
    for (int f = 0; f < 2 * s->mesh->dim; ++f) {
        int cell[2] = {k->cell[0], k->cell[1]};
        cell[f / 2] += f % 2 == SIDE_UPPER ? 1 : -1;
        if (!inside(s->mesh, cell)) continue;
        const double open = room_of(s, gas, place, cell);
        const double score = open * ice_open_face(s, gas, through, k->cell, f / 2, f % 2);
        if (!(open > k->open) || !(score > best)) continue;
        best = score;
        memcpy(out, cell, sizeof cell);
    }
    return best > 0.0;
}

/* Of a cell that is all covered and has no such neighbour, the roomiest of all around. */
static bool find_refuge(const ice *s, int gas, int place, const ice_member *k, int out[2])
{
    double best = 0.0;
    for (int n = 0; n < 9; ++n) {
        const int cell[2] = {k->cell[0] + n % 3 - 1, k->cell[1] + n / 3 - 1};
        if (n == 4 || !inside(s->mesh, cell)) continue;
        const double open = room_of(s, gas, place, cell);
        if (!(open > best)) continue;
        best = open;
        memcpy(out, cell, sizeof cell);
    }
    return best > 0.0;
}

/* Where the lines are in a step, at the time of the pools first. */
typedef struct step_places {
    int at[SEAL_PLACES];
    int n;
} step_places;

static step_places places_of(ice_pool_time when)
{
    step_places l = {.n = 0};
    l.at[l.n++] = when == POOLS_AFTER ? SEAL_NEXT : SEAL_NOW;
    for (int k = 0; k < ICE_SEAL_PLACES; ++k) l.at[l.n++] = SEAL_MEAN + k;
    if (when != POOLS_BEFORE) l.at[l.n++] = when == POOLS_AFTER ? SEAL_NOW : SEAL_NEXT;
    return l;
}

/* The cell whose state a member takes. A covered cell belongs to whom it flows to or from while it is open, now or at
 * another time of the step. */
static bool find_host(const ice *s, int gas, const step_places *l, const ice_member *m, int cell[2])
{
    if (find_neighbour(s, gas, l->at[0], l->at[0], m, cell)) return true;
    for (int k = 1; k < l->n && m->open == 0.0; ++k)
        if (find_neighbour(s, gas, l->at[0], l->at[k], m, cell)) return true;
    return m->open == 0.0 && find_refuge(s, gas, l->at[0], m, cell);
}

/* The member with which another shares its state; itself where it has its own. */
static floe_status follow(ice *s, int gas, const step_places *l, ice_pools *p, int k)
{
    int cell[2];
    const ice_member *m = &p->member[k];
    if (m->open >= small_cell || !find_host(s, gas, l, m, cell)) return FLOE_OK;
    TRY(add_member(s, gas, l->at[0], p, cell));
    p->member[k].pool = p->place[cut_index(s->mesh, cell)];
    return FLOE_OK;
}

/* From chains of members to numbered pools. */
static void number_pools(ice_pools *p)
{
    p->count = 0;
    for (int k = 0; k < p->n; ++k)
        if (p->member[k].pool == k) p->lead[p->count++] = k;
    for (int k = 0; k < p->n; ++k) {
        int root = k;
        while (p->member[root].pool != root) root = p->member[root].pool;
        p->sum[k] = root; /* waits here while the chains are needed */
    }
    for (int k = 0; k < p->n; ++k) p->member[k].pool = -1 - (int)p->sum[k];
    for (int n = 0; n < p->count; ++n) p->sum[p->lead[n]] = n;
    for (int k = 0; k < p->n; ++k) p->member[k].pool = (int)p->sum[-1 - p->member[k].pool];
}

/* The cells that lines about a gas cut at a place are members. */
static floe_status add_cut_cells(ice *s, int gas, int place, int at, ice_pools *p)
{
    for (int l = 0; l < s->seal.n_lines; ++l) {
        const cut_surface *c = &s->seal.line[l].place[at];
        if (ice_outward(s, gas, l) == 0.0) continue;
        for (int k = 0; k < c->n_cells; ++k) TRY(add_member(s, gas, place, p, c->cell[k].cell));
    }
    return FLOE_OK;
}

floe_status ice_pools_make(ice *s, int gas, ice_pool_time when, ice_pools *out)
{
    const step_places l = places_of(when);
    for (int k = 0; k < out->n; ++k) out->place[cut_index(s->mesh, out->member[k].cell)] = -1;
    out->n = 0;
    for (int k = 0; k < l.n; ++k) TRY(add_cut_cells(s, gas, l.at[0], l.at[k], out));
    for (int k = 0; k < out->n; ++k) TRY(follow(s, gas, &l, out, k));
    number_pools(out);
    if (ice_has_weight(s)) ice_pools_centre(s, gas, l.at[0], out);
    return FLOE_OK;
}

void ice_seal_views(const ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id) ice_view_make(s, id, &s->work->sealing->view[id]);
}

/* The state that a gas starts with, of its first body or of the ambient. */
static floe_status find_rest(ice *s, int gas, fluid_state *out)
{
    const scene *given = s->scene;
    const int material = s->material[gas].scene_material;
    for (int b = 0; b < given->n_bodies; ++b) {
        const scene_body *body = &given->body[b];
        if (body->material != material) continue;
        return fail_under(
            s->ctx,
            fluid_state_of(s->ctx, &s->material[gas].eos, body->pressure, body->temperature, body->density, out),
            KEY("bodies", body->name));
    }
    return fail_under(
        s->ctx,
        fluid_state_of(s->ctx, &s->material[gas].eos, given->ambient_pressure, given->ambient_temperature, NAN, out),
        KEY("ambient"));
}

static floe_status new_pools(const ice *s, ice_pools *p)
{
    const size_t cells = mesh_cells(s->mesh);
    TRY(memory_new(s->ctx, &p->place, cells, sizeof *p->place));
    for (size_t k = 0; k < cells; ++k) p->place[k] = -1;
    return FLOE_OK;
}

/* The lines, and what each holds; the surfaces of solids are one beside each fluid. */
static void find_lines(ice *s)
{
    int body[SCENE_MAX_HOLDERS];
    const int holders = scene_holders(s->scene, body);
    const int fluids = s->n_materials < SCENE_MAX_HOLDERS ? s->n_materials : SCENE_MAX_HOLDERS;
    s->seal = (ice_seal){.n_lines = holders > 0 ? holders : fluids};
    for (int l = 0; l < fluids && holders == 0; ++l) s->seal.line[l].held = l;
    for (int l = 0; l < holders; ++l) s->seal.line[l].held = ice_material_of(s, s->scene->body[body[l]].membrane.holds);
}

floe_status ice_seal_create(ice *s)
{
    find_lines(s);
    if (s->mesh->dim > 2 || s->n_materials > s->seal.n_lines + 1)
        return fail_key(
            s->ctx, KEY("bodies"),
            "membranes hold gas in two dimensions: each has one inside, and one gas or none is outside all");
    TRY(memory_new(s->ctx, &s->work->sealing, 1, sizeof *s->work->sealing));
    struct ice_sealing *w = s->work->sealing;
    for (int g = 0; g < s->n_materials; ++g) {
        TRY(new_pools(s, &w->now[g]));
        TRY(new_pools(s, &w->next[g]));
        TRY(find_rest(s, g, &w->rest[g]));
    }
    return memory_new(s->ctx, &w->view, (size_t)s->mesh->n_blocks, sizeof *w->view);
}

static void free_pools(context *ctx, ice_pools *p)
{
    memory_free(ctx, &p->member);
    memory_free(ctx, &p->lead);
    memory_free(ctx, &p->place);
    memory_free(ctx, &p->sum);
}

void ice_seal_destroy(context *ctx, struct ice_sealing **w)
{
    if (!*w) return;
    for (int g = 0; g < ICE_SEALED_GASES; ++g) {
        free_pools(ctx, &(*w)->now[g]);
        free_pools(ctx, &(*w)->next[g]);
    }
    memory_free(ctx, &(*w)->view);
    memory_free(ctx, w);
}
