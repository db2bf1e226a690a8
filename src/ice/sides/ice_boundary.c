/* The sides of the domain: ghosts of cell fields, and what sides impose on faces (theory 2.13). One table (axis,
 * side) and one loop; a kind of side is a row of `rule_of`. */
#include "ice/sides/ice_open_side.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_tiles.h"

#include <math.h>

bool ice_is_wall(bc_kind kind)
{
    return kind == BC_SYMMETRY || kind == BC_SLIP || kind == BC_NO_SLIP;
}

/* Sides that characteristics decide. */
static bool by_characteristics(bc_kind kind)
{
    return kind == BC_NON_REFLECTING || kind == BC_RESERVOIR;
}

/* What becomes of one array beyond a side. */
typedef enum ghost_act { ACT_MIRROR, ACT_NEAREST, ACT_LINEAR, ACT_VALUE, ACT_ODD } ghost_act;
typedef struct ghost_rule {
    ghost_act act;
    double value;
    bool positive; /* of ACT_LINEAR: as densities are */
} ghost_rule;      /* MIRROR: value + mirror; ODD: 2 value - mirror */

/* Continues an array in a straight line beyond a face, by the smaller of the last two differences, none where they
 * differ in sign; what is positive falls to half at most. */
static void extrapolate_beyond(bool positive, double *a, ptrdiff_t at, ptrdiff_t out)
{
    const double last = a[at] - a[at - out], before = a[at - out] - a[at - 2 * out];
    double slope = last * before > 0.0 ? copysign(fmin(fabs(last), fabs(before)), last) : 0.0;
    if (positive) slope = fmax(slope, -0.5 / MESH_GHOST * fabs(a[at]));
    for (int n = 1; n <= MESH_GHOST; ++n) a[at + n * out] = a[at] + n * slope;
}

/* Ghosts beyond the face of one owned cell; `deep`: owned cells behind it, itself included. */
static void apply_rule(ghost_rule rule, double *a, ptrdiff_t at, ptrdiff_t out, int deep)
{
    for (int n = 1; n <= MESH_GHOST; ++n) {
        const ptrdiff_t ghost = at + n * out, image = at - (n - 1 < deep ? n - 1 : deep - 1) * out;
        switch (rule.act) {
        case ACT_MIRROR: a[ghost] = rule.value != 0.0 ? a[image] + rule.value : a[image]; break;
        case ACT_NEAREST: a[ghost] = a[at]; break;
        case ACT_VALUE: a[ghost] = rule.value; break;
        case ACT_ODD: a[ghost] = rule.value != 0.0 ? -a[image] + 2.0 * rule.value : -a[image]; break;
        case ACT_LINEAR: extrapolate_beyond(rule.positive, a, at, out); return;
        }
    }
}

static double reservoir_value(const ice *s, const ice_side_face *here, int r, ice_ghost kind, bool *given)
{
    const bc_side *wall = here->condition;
    const ice_reservoir *in = &here->behind;
    const bool enters = s->material[r].scene_material == wall->material;
    *given = enters || (kind == GHOST_DENSITY && ice_shares_cells(s, r, wall->material));
    switch (kind) {
    case GHOST_DENSITY: return enters ? in->rho : 0.0;
    case GHOST_ENERGY: return in->e;
    case GHOST_TEMPERATURE: return in->T;
    default: return in->v;
    }
}

static ghost_rule velocity_rule(const ice *s, const bc_side *wall, int axis, int component)
{
    const bool normal = component == axis, viscous = ice_is_viscous(s);
    const double given =
        wall->kind == BC_VELOCITY ? bc_velocity(wall, component, s->time + 0.5 * s->dt) : wall->velocity[component];
    switch (wall->kind) {
    case BC_SYMMETRY:
    case BC_SLIP: return (ghost_rule){.act = normal ? ACT_ODD : ACT_MIRROR};
    case BC_NO_SLIP:
    case BC_VELOCITY:
        if (normal) return (ghost_rule){.act = ACT_ODD, .value = wall->kind == BC_VELOCITY ? given : 0.0};
        return (ghost_rule){.act = viscous ? ACT_ODD : ACT_MIRROR, .value = viscous ? given : 0.0};
    case BC_INLET: return (ghost_rule){.act = ACT_VALUE, .value = wall->velocity[component]};
    case BC_NON_REFLECTING: return (ghost_rule){.act = ACT_LINEAR};
    default: return (ghost_rule){.act = ACT_NEAREST};
    }
}

/* Beyond a wall: its temperature on the face, or the difference of a cell that its heat flux makes, k (T_ghost -
 * T)/h. */
static ghost_rule temperature_rule(const ice *s, const bc_side *wall, int axis, int r)
{
    const double k = s->material[r].conductivity;
    if (wall->kind != BC_SLIP && wall->kind != BC_NO_SLIP) return (ghost_rule){.act = ACT_MIRROR};
    if (wall->temperature > 0.0) return (ghost_rule){.act = ACT_ODD, .value = wall->temperature};
    return (ghost_rule){.act = ACT_MIRROR, .value = k > 0.0 ? wall->heat_flux * s->mesh->h[axis] / k : 0.0};
}

static ghost_rule rule_of(const ice *s, const ice_side_face *here, int axis, int r, int component, ice_ghost kind)
{
    const bc_side *wall = here->condition;
    const bc_kind side_kind = wall->kind;
    const bool open =
        side_kind == BC_INLET || side_kind == BC_OUTLET || side_kind == BC_FREE || by_characteristics(side_kind);
    if (kind == GHOST_VELOCITY) return velocity_rule(s, wall, axis, component);
    const bool crossed = side_kind == BC_NON_REFLECTING || (side_kind == BC_VELOCITY && wall->velocity[axis] != 0.0);
    if (crossed && (kind == GHOST_DENSITY || kind == GHOST_ENERGY))
        return (ghost_rule){.act = ACT_LINEAR, .positive = true};
    if (!open && kind == GHOST_TEMPERATURE) return temperature_rule(s, wall, axis, r);
    if (!open) return (ghost_rule){.act = ACT_MIRROR};
    if (kind == GHOST_ZERO_OPEN) return (ghost_rule){.act = ACT_VALUE};
    if (side_kind == BC_INLET && kind != GHOST_EVEN) {
        bool given;
        const double value = reservoir_value(s, here, r, kind, &given);
        if (given) return (ghost_rule){.act = ACT_VALUE, .value = value};
    }
    return (ghost_rule){.act = ACT_NEAREST};
}

/* One array beyond one side of a block, by the rules of its faces. */
static void fill_beyond(const ice *s, const block *b, int axis, mesh_side side, int r, int component, ice_ghost kind,
                        double *a)
{
    const bool differs = ice_side_differs(s, axis, side);
    const ptrdiff_t out = side == SIDE_LOWER ? -b->stride[axis] : b->stride[axis];
    const ice_side_face *here = ice_side_at(s, b, axis, side, 0, 0, 0);
    ghost_rule rule = rule_of(s, here, axis, r, component, kind);
    int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
    bc_layers(b, axis, side, 0, 0, lo, hi);
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i) {
                if (differs) {
                    here = ice_side_at(s, b, axis, side, i, j, k);
                    rule = rule_of(s, here, axis, r, component, kind);
                }
                apply_rule(rule, a, mesh_index(b, i, j, k), out, b->n[axis]);
            }
}

/* In columns beyond another open side, whose ghosts are being filled too, the nearest owned cell says which way the fluids flow: else that
 * would change from fluid to fluid, and where two sides bring two fluids a corner could be left without any. */
static ghost_column column_at(const ice *s, const block *b, int axis, int r, const int at[MESH_MAX_DIM])
{
    const bool alone = ice_region_of(s, r)->n == 1;
    int own[MESH_MAX_DIM] = {at[0], at[1], at[2]};
    for (int d = 0; d < s->mesh->dim && !alone; ++d) {
        const int side = at[d] < 0 ? SIDE_LOWER : SIDE_UPPER;
        if (d == axis || (at[d] >= 0 && at[d] < b->n[d]) || !b->at_side[d][side] || s->mesh->periodic[d]) continue;
        if (ice_side_has(s, d, (mesh_side)side, bc_gives_pressure)) own[d] = side == SIDE_LOWER ? 0 : b->n[d] - 1;
    }
    return (ghost_column){mesh_index(b, at[0], at[1], at[2]), mesh_index(b, own[0], own[1], own[2])};
}

/* Then what flows in from outside, if the state there is known. */
static void fill_inflow(const ice *s, const block *b, int axis, mesh_side side, int r, int component, ice_ghost kind,
                        double *a)
{
    int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
    bc_layers(b, axis, side, 0, 0, lo, hi);
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i) {
                const ice_side_face *here = ice_side_at(s, b, axis, side, i, j, k);
                if (ice_known_outside(here))
                    ice_inflow_ghosts(s, b, s->domain->fields[b->id], here,
                                      column_at(s, b, axis, r, (const int[]){i, j, k}), axis, side, r, kind, component,
                                      a);
            }
}

typedef void side_filler(const ice *s, const block *b, int axis, mesh_side side, int r, int component, ice_ghost kind,
                         double *a);

/* All components of a field beyond all sides that have faces of some kind. */
static void fill_sides(const ice *s, field_id id, int instance, fill_which which, ice_ghost kind,
                       bool (*some)(bc_kind kind), side_filler *fill)
{
    const mesh *m = s->mesh;
    const int components = field_component_count(field_describe(id)->components, m->dim);
    for (int block_id = 0; block_id < m->n_blocks; ++block_id) {
        const block *b = &m->block[block_id];
        const fields *f = s->domain->fields[block_id];
        for (int c = 0; c < components; ++c) {
            double *a = which == FILL_NEXT ? field_next(f, id, instance, c) : field_get(f, id, instance, c);
            for (int axis = 0; axis < m->dim; ++axis)
                for (int side = 0; side < 2; ++side)
                    if (b->at_side[axis][side] && !m->periodic[axis] &&
                        (!some || ice_side_has(s, axis, (mesh_side)side, some)))
                        fill(s, b, axis, (mesh_side)side, instance, c, kind, a);
        }
    }
}

static void fill_by_rules(const ice *s, field_id id, int instance, fill_which which, ice_ghost kind)
{
    domain_fill(s->domain, id, instance, which);
    fill_sides(s, id, instance, which, kind, NULL, fill_beyond);
}

static void fill_from_outside(const ice *s, field_id id, int instance, fill_which which, ice_ghost kind)
{
    fill_sides(s, id, instance, which, kind, bc_gives_pressure, fill_inflow);
}

void ice_fill_ghosts(const ice *s, field_id id, int instance, fill_which which, ice_ghost kind)
{
    const bool state = kind == GHOST_VELOCITY || kind == GHOST_DENSITY || kind == GHOST_ENERGY || kind == GHOST_VOLUME;
    fill_by_rules(s, id, instance, which, kind);
    if (state && !s->material[instance].points) fill_from_outside(s, id, instance, which, kind);
}

/* Which way the fluids flow is known when all have been filled by the rules. */
void ice_fill_state(const ice *s, int first, int n)
{
    static const struct {
        field_id id;
        ice_ghost kind;
    } state[] = {{C_RHO, GHOST_DENSITY}, {C_VEL, GHOST_VELOCITY}, {C_ENERGY, GHOST_ENERGY}, {C_VOL, GHOST_VOLUME}};
    for (int from_outside = 0; from_outside < 2; ++from_outside)
        for (int r = first; r < first + n; ++r)
            for (int k = 0; k < 4; ++k) {
                const bool points = s->material[r].points;
                if ((state[k].id == C_ENERGY && points) || (state[k].id == C_VOL && ice_region_of(s, r)->n == 1))
                    continue;
                if (!from_outside)
                    fill_by_rules(s, state[k].id, r, FILL_CURRENT, state[k].kind);
                else if (!points)
                    fill_from_outside(s, state[k].id, r, FILL_CURRENT, state[k].kind);
            }
}

floe_status ice_boundary_ghosts(ice *s)
{
    TRY(ice_renew_sides(s));
    ice_fill_state(s, 0, s->n_materials);
    for (int r = 0; r < s->n_materials; ++r) {
        if (!s->material[r].points) continue;
        ice_fill_ghosts(s, C_TEMP, r, FILL_CURRENT, GHOST_EVEN);
        /* A state of rest that is solved for has no steps, and no acceleration of one. */
        if (fields_has(s->domain->fields[0], C_STRESS_ACCEL, r))
            ice_fill_ghosts(s, C_STRESS_ACCEL, r, FILL_CURRENT, GHOST_EVEN);
    }
    for (int g = 0; g < s->n_regions; ++g)
        if (s->region[g].n > 1) ice_fill_ghosts(s, C_PRESSURE, g, FILL_CURRENT, GHOST_EVEN);
    return FLOE_OK;
}

void ice_visit_sides(const ice *s, const ice_view *v, int r, side_visitor *visit)
{
    const block *b = v->b;
    for (int axis = 0; axis < b->dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            if (!b->at_side[axis][side] || s->mesh->periodic[axis]) continue;
            int hi[MESH_MAX_DIM] = {b->n[0], b->n[1], b->n[2]}, lo[MESH_MAX_DIM] = {0, 0, 0};
            lo[axis] = side == SIDE_LOWER ? 0 : b->n[axis] - 1;
            hi[axis] = lo[axis] + 1;
            for (int k = lo[2]; k < hi[2]; ++k)
                for (int j = lo[1]; j < hi[1]; ++j)
                    for (int i = lo[0]; i < hi[0]; ++i) {
                        const ptrdiff_t cell = mesh_index(b, i, j, k);
                        const ptrdiff_t face = side == SIDE_LOWER ? cell : cell + b->stride[axis];
                        visit(s, v, axis, (mesh_side)side, r,
                              (side_face){face, cell, i, j, k, side == SIDE_LOWER ? -1.0 : 1.0});
                    }
        }
}

static const bc_side *condition_at(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at)
{
    return ice_condition_at(s, v->b, axis, side, at.i, at.j, at.k);
}

/* Given pressure on the face: the same difference as inside, over half a cell. */
static double outlet_velocity(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at)
{
    const ice_fluid *m = &v->m[r];
    const double phi = 0.5 * (1.0 + v->shock[at.cell]),
                 given = ice_outlet_pressure(s, v, axis, side, at, v->p[at.cell]);
    const double theta = v->multi ? m->theta[at.cell] : 1.0,
                 mobility = m->rho[at.cell] > 0.0 ? theta / m->rho[at.cell] : 0.0;
    const double gradient = at.outward * (given - v->p[at.cell]) * 2.0 * v->inv_h[axis];
    return m->u[axis][at.cell] + phi * v->dt * (v->gravity[axis] - mobility * gradient);
}

/* Faces of given pressure move with it, over half a cell; beyond it the pressure does not change. At no other side does
 * u* change with the pressure. The explicit u* of such a face becomes that of the implicit centring. */
static void set_side_mobility(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at)
{
    const ice_fluid *m = &v->m[r];
    const bc_side *wall = condition_at(s, v, axis, side, at);
    const bool gives = wall->kind == BC_OUTLET && m->rho[at.cell] > 0.0;
    m->mobility[axis][at.face] = gives ? 2.0 * (v->multi ? m->theta[at.cell] : 1.0) / m->rho[at.cell] : 0.0;
    if (!gives) return;
    const double now = 0.5 * (1.0 + v->shock[at.cell]), change = ice_implicit_phi(v, now) - now;
    const double gradient =
        at.outward * (ice_outlet_pressure(s, v, axis, side, at, v->p[at.cell]) - v->p[at.cell]) * v->inv_h[axis];
    m->fu[axis][at.face] += change * v->dt * (v->gravity[axis] - m->mobility[axis][at.face] * gradient);
}

void ice_boundary_mobility(const ice *s, const ice_view *v, int r)
{
    ice_visit_sides(s, v, r, set_side_mobility);
}

/* Faces whose state characteristics decide: also of outlets that fill what is behind them. */
static bool follows_waves(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at)
{
    const bc_kind kind = condition_at(s, v, axis, side, at)->kind;
    return by_characteristics(kind) || (kind == BC_OUTLET && ice_is_reservoir(s, v, axis, side, at));
}

static void set_velocity(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at)
{
    const bc_side *wall = condition_at(s, v, axis, side, at);
    double *face = v->m[r].fu[axis];
    if (follows_waves(s, v, axis, side, at)) {
        face[at.face] = at.outward * ice_characteristic(s, v, axis, side, at).velocity + v->m[r].u[axis][at.cell] -
                        v->mean[axis][at.cell];
        return;
    }
    switch (wall->kind) {
    case BC_SYMMETRY:
    case BC_SLIP:
    case BC_NO_SLIP: face[at.face] = 0.0; break;
    case BC_VELOCITY: face[at.face] = bc_velocity(wall, axis, s->time + 0.5 * s->dt); break;
    case BC_INLET: face[at.face] = wall->velocity[axis]; break;
    case BC_OUTLET: face[at.face] = outlet_velocity(s, v, axis, side, r, at); break;
    default: break; /* free: as between equal cells */
    }
}

void ice_boundary_face_velocity(const ice *s, const ice_view *v, int r)
{
    ice_visit_sides(s, v, r, set_velocity);
}

/* Of the fluid at a side with a velocity: the side's own, and what the fluid has by passing it. */
static double side_acceleration(const ice *s, const ice_view *v, int axis, const ice_side_face *here, side_face at)
{
    const bc_side *wall = here->condition;
    const double t = s->time + 0.5 * s->dt, u = bc_velocity(wall, axis, t);
    const double slope = 2.0 * at.outward * (u - v->mean[axis][at.cell]) * v->inv_h[axis];
    return wall->velocity[axis] * swing_rate(&wall->course, t) + here->acceleration[axis] + u * slope;
}

static void set_side_pressure(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at)
{
    const ice_side_face *here = ice_side_at(s, v->b, axis, side, at.i, at.j, at.k);
    const bc_side *wall = here->condition;
    (void)r;
    if (v->traced && (!v->alone || v->alone[at.cell] > 0.0) && (ice_is_wall(wall->kind) || wall->kind == BC_FREE))
        return; /* by the waves between cell and ghost */
    if (follows_waves(s, v, axis, side, at))
        v->fp[axis][at.face] = ice_characteristic(s, v, axis, side, at).pressure;
    else if (wall->kind == BC_OUTLET)
        v->fp[axis][at.face] = ice_outlet_pressure(s, v, axis, side, at, v->P[at.cell]);
    else if (ice_enters_supersonic(s, here, axis, side))
        v->fp[axis][at.face] = wall->pressure;
    else if (wall->kind == BC_FREE)
        v->fp[axis][at.face] = v->P[at.cell];
    else {
        double body_acceleration = v->gravity[axis];
        if (wall->kind == BC_VELOCITY) body_acceleration -= side_acceleration(s, v, axis, here, at);
        v->fp[axis][at.face] = v->P[at.cell] + 0.5 * at.outward * v->rho_sum[at.cell] * body_acceleration * v->h[axis];
    }
}

void ice_boundary_face_pressure(const ice *s, const ice_view *v)
{
    ice_visit_sides(s, v, 0, set_side_pressure);
}

static void enter_side_work(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at)
{
    (void)r;
    (void)side;
    double *tile = ice_tile(s, v->b, at.i, at.j, at.k);
    const int face_i = at.i + (axis == 0 && at.outward > 0.0);
    const double area = axis == 0 ? v->area0[face_i] : v->volume[at.i] * v->inv_h[axis];
    const double open = ice_side_aperture(s, v, (const int[]){at.i, at.j, at.k}, axis, at.outward > 0.0);
    const double side_impulse = -at.outward * v->dt * area * v->fp[axis][at.face];
    tile[TILE_ENERGY] += side_impulse * v->flux[axis][at.face];
    double x[MESH_MAX_DIM];
    ice_side_place(s, v->b, axis, at.outward > 0.0, (const int[]){at.i, at.j, at.k}, x);
    /* Radial momentum is not conserved: it is no sum of fluxes. */
    if (!(axis == 0 && s->mesh->geometry == MESH_AXISYMMETRIC))
        ice_add_impulse(tile + TILE_MOMENTUM, x, axis, side_impulse * open);
}

void ice_boundary_work(ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) ice_visit_sides(s, &v, 0, enter_side_work);
}

/* Local faces along `along`, [first, end), that lie in the domain, of those normal to `axis`. */
static void faces_inside(const block *b, int along, int axis, int *first, int *end)
{
    const int ghost = along < b->dim ? MESH_GHOST : 0;
    *first = b->at_side[along][SIDE_LOWER] ? 0 : -ghost;
    *end = b->n[along] + (b->at_side[along][SIDE_UPPER] ? along == axis : ghost);
}

static void zero_range(double *a, ptrdiff_t from, ptrdiff_t to)
{
    for (ptrdiff_t at = from; at < to; ++at) a[at] = 0.0;
}

/* Zero beyond the domain, where no outflow is to be known; the domain's own faces stay. */
static void zero_outer_faces(const block *b, int axis, double *a)
{
    int first[MESH_MAX_DIM], end[MESH_MAX_DIM];
    for (int d = 0; d < MESH_MAX_DIM; ++d) faces_inside(b, d, axis, &first[d], &end[d]);
    for (int k = b->dim > 2 ? -MESH_GHOST : 0; k < b->n[2] + (b->dim > 2 ? MESH_GHOST : 0); ++k)
        for (int j = b->dim > 1 ? -MESH_GHOST : 0; j < b->n[1] + (b->dim > 1 ? MESH_GHOST : 0); ++j) {
            const ptrdiff_t row = mesh_index(b, 0, j, k), last = row + b->n[0] + MESH_GHOST;
            const bool outside = j < first[1] || j >= end[1] || k < first[2] || k >= end[2];
            zero_range(a, row - MESH_GHOST, outside ? last : row + first[0]);
            zero_range(a, row + end[0], last);
        }
}

/* Local face `at` on the upper side along `axis`, in ghost columns of a block: from the block that owns the cell below it, if any does. */
static void take_side_face(const ice *s, field_id id, int instance, int axis, const block *b, const int *at)
{
    const mesh *m = s->mesh;
    int cell[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        cell[a] = mesh_index_around(m, a, b->lo[a] + at[a] - (a == axis));
        if (cell[a] < 0 || cell[a] >= m->n[a]) return;
    }
    const block *owner = &m->block[mesh_block_of(m, cell)];
    const ptrdiff_t from = mesh_index(owner, cell[0] - owner->lo[0], cell[1] - owner->lo[1], cell[2] - owner->lo[2]);
    const double *source = field_get(s->domain->fields[owner->id], id, instance, axis);
    field_get(s->domain->fields[b->id], id, instance, axis)[mesh_index(b, at[0], at[1], at[2])] =
        source[from + owner->stride[axis]];
}

/* Blocks share their faces as they do cells, and leave out the last face of the domain along an axis. */
static void fill_side_faces(const ice *s, field_id id, int instance, int axis)
{
    const mesh *m = s->mesh;
    for (int block_id = 0; block_id < m->n_blocks; ++block_id) {
        const block *b = &m->block[block_id];
        int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
        if (m->periodic[axis] || !b->at_side[axis][SIDE_UPPER]) continue;
        for (int a = 0; a < MESH_MAX_DIM; ++a) {
            const int ghost = a < m->dim ? MESH_GHOST : 0;
            lo[a] = a == axis ? b->n[a] : -ghost;
            hi[a] = a == axis ? b->n[a] + 1 : b->n[a] + ghost;
        }
        for (int k = lo[2]; k < hi[2]; ++k)
            for (int j = lo[1]; j < hi[1]; ++j)
                for (int i = lo[0]; i < hi[0]; ++i) {
                    const int at[MESH_MAX_DIM] = {i, j, k};
                    bool own = true;
                    for (int a = 0; a < MESH_MAX_DIM; ++a) own = own && (a == axis || (at[a] >= 0 && at[a] < b->n[a]));
                    if (!own) take_side_face(s, id, instance, axis, b, at);
                }
    }
}

void ice_fill_faces(const ice *s, field_id id, int instance)
{
    const mesh *m = s->mesh;
    for (int block_id = 0; block_id < m->n_blocks; ++block_id)
        for (int axis = 0; axis < m->dim; ++axis)
            zero_outer_faces(&m->block[block_id], axis, field_get(s->domain->fields[block_id], id, instance, axis));
    domain_fill(s->domain, id, instance, FILL_CURRENT);
    if (!ice_has_interfaces(s, ice_region_of(s, instance)))
        return; /* which bound what a ghost cell gives by all of its faces */
    for (int axis = 0; axis < m->dim; ++axis) fill_side_faces(s, id, instance, axis);
}
