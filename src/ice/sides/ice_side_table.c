#include "ice/sides/ice_side_table.h"

#include "ice/sides/ice_sides.h"

#include "base/memory.h"
#include "scene/formula.h"
#include "scene/side_parts.h"

#include <math.h>

/* The faces of one side beside a block; NULL: all are alike. */
typedef ice_side_face *face_list;

struct ice_side_table {
    ice_side_face alike[MESH_MAX_DIM][2];
    bool differs[MESH_MAX_DIM][2], in_time;
    face_list (*face)[MESH_MAX_DIM][2]; /* by block */
    int n_blocks;
};

/* ---- where the faces of a block are in its list ---- */

static int columns_along(const block *b, int axis, int along)
{
    if (along == axis || along >= b->dim) return 1;
    return b->n[along] + 2 * MESH_GHOST;
}

static int column_of(const block *b, int axis, int along, int local)
{
    return along == axis || along >= b->dim ? 0 : local + MESH_GHOST;
}

static size_t face_number(const block *b, int axis, int i, int j, int k)
{
    const size_t n0 = (size_t)columns_along(b, axis, 0), n1 = (size_t)columns_along(b, axis, 1);
    return (size_t)column_of(b, axis, 0, i) +
           n0 * ((size_t)column_of(b, axis, 1, j) + n1 * (size_t)column_of(b, axis, 2, k));
}

const ice_side_face *ice_side_at(const ice *s, const block *b, int axis, mesh_side side, int i, int j, int k)
{
    const ice_side_table *t = s->sides;
    if (!t->differs[axis][side]) return &t->alike[axis][side];
    return &t->face[b->id][axis][side][face_number(b, axis, i, j, k)];
}

const bc_side *ice_condition_at(const ice *s, const block *b, int axis, mesh_side side, int i, int j, int k)
{
    return ice_side_at(s, b, axis, side, i, j, k)->condition;
}

bool ice_side_differs(const ice *s, int axis, mesh_side side)
{
    return s->sides->differs[axis][side];
}

bool ice_side_has(const ice *s, int axis, mesh_side side, bool (*kind)(bc_kind kind))
{
    scene_condition at;
    for (int i = 0; scene_next_condition(s->scene, &i, &at);)
        if (at.axis == axis && at.end == (int)side && kind(at.side->kind)) return true;
    return false;
}

/* ---- what stands there ---- */

static bool has_reservoir(bc_kind kind)
{
    return kind == BC_INLET || bc_gives_pressure(kind);
}

static void find_behind(const ice *s, ice_side_face *f)
{
    const bc_side *c = f->condition;
    f->behind = (ice_reservoir){.rho = 0.0};
    if (!has_reservoir(c->kind)) return;
    const int r = ice_material_of(s, c->material);
    if (r < 0 || s->material[r].points || !(c->temperature > 0.0)) return;
    f->behind = ice_state_at(&s->material[r].eos, c->pressure, c->temperature);
}

/* The numbers of a condition at a place and time. */
static floe_status resolve_condition(const ice *s, const bc_side *given, const double x[3], double t, ice_side_face *f)
{
    const scene *sc = s->scene;
    f->own = *given;
    f->condition = &f->own;
    TRY(scene_number(sc, &given->pressure, x, t, &f->own.pressure));
    TRY(scene_number(sc, &given->temperature, x, t, &f->own.temperature));
    TRY(scene_number(sc, &given->heat_flux, x, t, &f->own.heat_flux));
    for (int a = 0; a < s->mesh->dim; ++a) {
        double before, after;
        const double half = 0.5 * s->dt;
        TRY(scene_number(sc, &given->velocity[a], x, t, &f->own.velocity[a]));
        f->acceleration[a] = 0.0;
        if (!(half > 0.0) || !scene_formula_of(sc, &given->velocity[a])) continue;
        TRY(scene_number(sc, &given->velocity[a], x, t - half, &before));
        TRY(scene_number(sc, &given->velocity[a], x, t + half, &after));
        f->acceleration[a] = (after - before) / s->dt;
    }
    find_behind(s, f);
    return FLOE_OK;
}

/* Middle of a column along an axis. Beyond the domain formulas need have no value: a ghost column has the place of the cell that it
 * repeats, or of the nearest. */
static double place_along(const mesh *m, int a, int cell)
{
    if (m->periodic[a]) return mesh_centre(m, a, mesh_index_around(m, a, cell));
    return mesh_centre(m, a, cell < 0 ? 0 : cell < m->n[a] ? cell : m->n[a] - 1);
}

static floe_status resolve_block(const ice *s, const block *b, int axis, int side)
{
    const double t = s->time + 0.5 * s->dt;
    int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
    bc_layers(b, axis, (mesh_side)side, 0, 0, lo, hi);
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i) {
                const int local[3] = {i, j, k};
                double x[3] = {0.0, 0.0, 0.0};
                for (int a = 0; a < s->mesh->dim; ++a) x[a] = place_along(s->mesh, a, b->lo[a] + local[a]);
                x[axis] = side == SIDE_LOWER ? s->mesh->lower[axis] : s->mesh->upper[axis];
                ice_side_face *face = &s->sides->face[b->id][axis][side][face_number(b, axis, i, j, k)];
                TRY(resolve_condition(s, scene_condition_at(s->scene, axis, side, x), x, t, face));
            }
    return FLOE_OK;
}

static floe_status resolve_sides(ice *s)
{
    for (int id = 0; id < s->mesh->n_blocks; ++id)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int side = 0; side < 2; ++side)
                if (s->sides->face[id][axis][side]) TRY(resolve_block(s, &s->mesh->block[id], axis, side));
    return FLOE_OK;
}

floe_status ice_renew_sides(ice *s)
{
    return s->sides->in_time ? resolve_sides(s) : FLOE_OK;
}

/* ---- storage ---- */

static floe_status create_faces(ice *s)
{
    const mesh *m = s->mesh;
    ice_side_table *t = s->sides;
    t->n_blocks = m->n_blocks;
    TRY(memory_new(s->ctx, &t->face, (size_t)m->n_blocks, sizeof *t->face));
    for (int id = 0; id < m->n_blocks; ++id)
        for (int axis = 0; axis < m->dim; ++axis)
            for (int side = 0; side < 2; ++side) {
                const block *b = &m->block[id];
                if (!t->differs[axis][side] || !b->at_side[axis][side]) continue;
                const size_t n = (size_t)columns_along(b, axis, 0) * (size_t)columns_along(b, axis, 1) *
                                 (size_t)columns_along(b, axis, 2);
                TRY(memory_new(s->ctx, &t->face[id][axis][side], n, sizeof(ice_side_face)));
            }
    return resolve_sides(s);
}

floe_status ice_sides_create(ice *s)
{
    scene_condition at;
    bool any = false;
    TRY(memory_new(s->ctx, &s->sides, 1, sizeof *s->sides));
    ice_side_table *t = s->sides;
    for (int axis = 0; axis < s->mesh->dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            t->differs[axis][side] = !s->mesh->periodic[axis] && scene_side_varies(s->scene, axis, side);
            any = any || t->differs[axis][side];
            t->alike[axis][side].condition = &s->scene->bc.side[axis][side];
            find_behind(s, &t->alike[axis][side]);
        }
    for (int i = 0; scene_next_condition(s->scene, &i, &at);)
        t->in_time = t->in_time || scene_varies_in_time(s->scene, at.side, sizeof *at.side);
    return any ? create_faces(s) : FLOE_OK;
}

void ice_sides_destroy(context *ctx, struct ice_side_table **w)
{
    for (int id = 0; *w && (*w)->face && id < (*w)->n_blocks; ++id)
        for (int axis = 0; axis < MESH_MAX_DIM; ++axis)
            for (int side = 0; side < 2; ++side) memory_free(ctx, &(*w)->face[id][axis][side]);
    if (*w) memory_free(ctx, &(*w)->face);
    memory_free(ctx, w);
}
