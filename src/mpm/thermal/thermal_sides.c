/* Sides of the domain with a temperature (theory 12.4): nodes of their planes have it. */
#include "mpm/nodes/wall.h"
#include "mpm/thermal/thermal.h"
#include "scene/formula.h"
#include "scene/side_parts.h"

static const bc_side *wall_at(const mpm *s, int axis, int side, const double x[3])
{
    const bc_side *c = scene_condition_at(s->scene, axis, side, x);
    return (c->kind == BC_SLIP || c->kind == BC_NO_SLIP) && !s->mesh->periodic[axis] ? c : NULL;
}

const bc_side *wall_with_temperature(const mpm *s, int axis, int side, const double x[3])
{
    const bc_side *c = wall_at(s, axis, side, x);
    return c && c->temperature > 0.0 ? c : NULL;
}

const bc_side *wall_with_heat_flux(const mpm *s, int axis, int side, const double x[3])
{
    const bc_side *c = wall_at(s, axis, side, x);
    return c && c->heat_flux != 0.0 ? c : NULL;
}

/* Whether a wall, or a part of one, has a temperature, or a heat flux. */
static bool some_wall(const mpm *s, bool flux)
{
    scene_condition at;
    for (int i = 0; scene_next_condition(s->scene, &i, &at);) {
        const bool wall = at.side->kind == BC_SLIP || at.side->kind == BC_NO_SLIP;
        if (wall && (flux ? at.side->heat_flux != 0.0 : at.side->temperature > 0.0)) return true;
    }
    return false;
}

bool some_wall_gives_heat(const mpm *s)
{
    return some_wall(s, true);
}

/* What is done at nodes of a side with a temperature. */
typedef struct side_heat {
    mpm *s;
    int group, axis, side;
    double t;    /* s */
    double heat; /* J: that has come in */
    floe_status status;
} side_heat;

/* The temperature of the side at a node; false: it has none there, or no material is about the node. */
static bool side_temperature(side_heat *q, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, double *T)
{
    const mpm *s = q->s;
    double x[MESH_MAX_DIM];
    if (q->status != FLOE_OK || !(field_get(s->domain->fields[blk], N_CAPACITY, q->group, 0)[at] > 0.0)) return false;
    place_of_node(s->mesh, node, x);
    const bc_side *wall = wall_with_temperature(s, q->axis, q->side, x);
    if (wall) q->status = scene_number(s->scene, &wall->temperature, x, q->t, T);
    return wall && q->status == FLOE_OK;
}

static void set_node(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at)
{
    side_heat *q = user;
    double T;
    if (side_temperature(q, blk, node, at, &T)) field_get(q->s->domain->fields[blk], N_TEMP, q->group, 0)[at] = T;
}

/* A node's heat is that of its points, whatever the temperature that it had to have. */
static double temperature_change_at(const fields *f, int group, ptrdiff_t at, double T)
{
    return T - field_get(f, N_HEAT, group, 0)[at] / field_get(f, N_CAPACITY, group, 0)[at];
}

static void impose_temperature_node(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at)
{
    side_heat *q = user;
    const fields *f = q->s->domain->fields[blk];
    double T;
    if (side_temperature(q, blk, node, at, &T))
        field_get(f, N_TEMP_CHANGE, q->group, 0)[at] = temperature_change_at(f, q->group, at, T);
}

/* Heat that a node needs beyond what it gets by conduction and exchange. */
static void enter_node(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at, ptrdiff_t inward)
{
    (void)inward;
    side_heat *q = user;
    const fields *f = q->s->domain->fields[blk];
    double T;
    if (!side_temperature(q, blk, node, at, &T)) return;
    q->heat += field_get(f, N_CAPACITY, q->group, 0)[at] *
               (temperature_change_at(f, q->group, at, T) - field_get(f, N_TEMP_CHANGE, q->group, 0)[at]);
}

/* Visits the nodes of a side that each block sees, those of neighbours included. */
typedef void side_node_visitor(void *user, int blk, const int node[MESH_MAX_DIM], ptrdiff_t at);

static void visit_thermal_side(const mesh *m, int axis, int side, side_node_visitor *visit, void *user)
{
    for (int blk = 0; blk < m->n_blocks; ++blk) {
        const block *b = &m->block[blk];
        int lo[MESH_MAX_DIM] = {0, 0, 0}, end[MESH_MAX_DIM] = {1, 1, 1}, node[MESH_MAX_DIM];
        if (!b->at_side[axis][side]) continue;
        for (int a = 0; a < m->dim; ++a) {
            lo[a] = b->at_side[a][SIDE_LOWER] && !m->periodic[a] ? 0 : b->lo[a] - 1;
            end[a] = b->lo[a] + b->n[a] + (b->at_side[a][SIDE_UPPER] && !m->periodic[a] ? 1 : 2);
        }
        lo[axis] = side == SIDE_LOWER ? 0 : m->n[axis];
        end[axis] = lo[axis] + 1;
        for (node[2] = lo[2]; node[2] < end[2]; ++node[2])
            for (node[1] = lo[1]; node[1] < end[1]; ++node[1])
                for (node[0] = lo[0]; node[0] < end[0]; ++node[0])
                    visit(user, blk, node, mesh_index(b, node[0] - b->lo[0], node[1] - b->lo[1], node[2] - b->lo[2]));
    }
}

floe_status set_side_temperatures(mpm *s, int group, double t)
{
    side_heat q = {.s = s, .group = group, .t = t};
    if (!some_wall(s, false)) return FLOE_OK;
    for (q.axis = 0; q.axis < s->mesh->dim; ++q.axis)
        for (q.side = 0; q.side < 2 && !s->mesh->periodic[q.axis]; ++q.side)
            visit_thermal_side(s->mesh, q.axis, q.side, set_node, &q);
    return q.status;
}

/* A node on an edge of the domain has the temperature of the side that is visited last. */
floe_status impose_side_temperatures(mpm *s, int group)
{
    side_heat q = {.s = s, .group = group, .t = s->time + s->dt};
    if (!some_wall(s, false)) return FLOE_OK;
    for (q.axis = 0; q.axis < s->mesh->dim; ++q.axis)
        for (q.side = 0; q.side < 2 && !s->mesh->periodic[q.axis]; ++q.side) {
            wall_visit_once(s->mesh, q.axis, q.side, enter_node, &q);
            visit_thermal_side(s->mesh, q.axis, q.side, impose_temperature_node, &q);
        }
    if (q.status == FLOE_OK) ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, q.heat);
    return q.status;
}
