/* Tractions on surfaces: massless points that the grid moves, each with an area and a load. */
#include "mpm/surface/traction.h"

#include "base/memory.h"
#include "geom/surface_elements.h"
#include "math/small_solve.h"
#include "mpm/implicit/implicit_view.h"
#include "mpm/loads/point_loads.h"
#include "mpm/motion/motion.h"
#include "mpm/nodes/node.h"
#include "mpm/surface/surfaces.h"
#include "mpm/transfer/stencil.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

enum { SURFACE_DIVISIONS = 4 }; /* surface elements per cell edge, about */

/* One with this share moves a surface with all of its acceleration. */
static const double steady_mass = 0.1;

typedef struct surface_list {
    mpm *s;
    int load, enclosed, body;
    floe_status status;
    size_t capacity;
} surface_list;

/* A place a little beyond an element, along its normal. */
static void place_beside(const mpm *s, const surface_element *e, double side, double x[3])
{
    const double step = side * 1e-3 * s->mesh->h[0];
    for (int a = 0; a < 3; ++a) x[a] = e->x[a] + step * e->normal[a];
}

/* +1 where a body lies on the side that the normal points to, -1 on the other, 0 where it lies on neither or both. */
static double side_of_body(const mpm *s, int body, const surface_element *e)
{
    const shape *solid = &s->scene->body[body].shape;
    double out[3], in[3];
    place_beside(s, e, 1.0, out);
    place_beside(s, e, -1.0, in);
    const bool outside = shape_inside(solid, s->mesh->dim, out), inside = shape_inside(solid, s->mesh->dim, in);
    return outside == inside ? 0.0 : outside ? 1.0 : -1.0;
}

/* The capacity is doubled when it is used up. */
static floe_status reserve_surface(surface_list *list)
{
    struct mpm_surfaces *w = list->s->surfaces;
    if (w->n_loaded < list->capacity) return FLOE_OK;
    list->capacity = list->capacity ? 2 * list->capacity : 256;
    TRY(memory_resize(list->s->ctx, &w->loaded, list->capacity, sizeof *w->loaded));
    return memory_resize(list->s->ctx, &w->loaded_next, list->capacity, sizeof *w->loaded_next);
}

static void add_surface_point(surface_list *list, const surface_element *e, double side)
{
    if (side == 0.0 || list->status != FLOE_OK) return;
    list->status = reserve_surface(list);
    if (list->status != FLOE_OK) return;
    surface_point *p = &list->s->surfaces->loaded[list->s->surfaces->n_loaded++];
    p->load = list->load;
    p->enclosed = list->enclosed;
    p->body = list->body;
    for (int a = 0; a < 3; ++a) {
        p->x[a] = e->x[a];
        p->area[a] = side * e->area * e->normal[a]; /* a pressure acts into the body */
    }
}

static void add_loaded_element(void *user, const surface_element *e)
{
    surface_list *list = user;
    add_surface_point(list, e, side_of_body(list->s, list->s->scene->load[list->load].body, e));
}

/* The first solid that an element of a fluid's surface faces, -1: none. */
static int faced_solid(const mpm *s, const surface_element *e)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (!s->body[b].fluid && side_of_body(s, s->body[b].scene_body, e) > 0.0) return s->body[b].scene_body;
    return -1;
}

static void add_enclosing_element(void *user, const surface_element *e)
{
    surface_list *list = user;
    add_surface_point(list, e, faced_solid(list->s, e) >= 0 ? 1.0 : 0.0);
}

static seed_spec surface_grid(const mpm *s)
{
    seed_spec grid = {.dim = s->mesh->dim, .axisymmetric = s->mesh->geometry == MESH_AXISYMMETRIC};
    for (int a = 0; a < 3; ++a) {
        grid.lower[a] = s->mesh->lower[a];
        grid.h[a] = s->mesh->h[a];
        grid.n[a] = s->mesh->n[a];
    }
    return grid;
}

typedef struct enclosure {
    const mpm *s;
    double all, faced; /* m2 */
} enclosure;

static void count_element(void *user, const surface_element *e)
{
    enclosure *c = user;
    double x[3];
    place_beside(c->s, e, 1.0, x);
    for (int a = 0; a < c->s->mesh->dim; ++a)
        if (x[a] < c->s->mesh->lower[a] || x[a] > c->s->mesh->upper[a]) return; /* a side of the domain closes it */
    c->all += e->area;
    if (faced_solid(c->s, e) >= 0) c->faced += e->area;
}

double surface_enclosed(const mpm *s, int body)
{
    enclosure c = {s, 0.0, 0.0};
    const seed_spec grid = surface_grid(s);
    surface_visit(&s->scene->body[body].shape, &grid, SURFACE_DIVISIONS, SURFACE_DIAGONALS, count_element, &c);
    return c.all > 0.0 ? c.faced / c.all : 1.0;
}

/* Surfaces of enclosed gases (implicit.h). */
static floe_status seed_enclosing_surfaces(mpm *s, surface_list *list, const seed_spec *grid)
{
    list->load = -1;
    for (int r = 0; r < implicit_gases(s); ++r) {
        list->enclosed = r;
        surface_visit(&s->scene->body[s->body[implicit_gas_body(s, r)].scene_body].shape, grid, SURFACE_DIVISIONS,
                      SURFACE_DIAGONALS, add_enclosing_element, list);
        TRY(list->status);
    }
    return FLOE_OK;
}

static void add_outer_element(void *user, const surface_element *e)
{
    add_surface_point(user, e, e->area > 0.0 ? 1.0 : 0.0);
}

/* Surfaces for contact in the implicit solver (implicit_gap.c): areas point outward. Gaps are accurate if the two surfaces at a node are
 * complete: sides that meet at a corner, such as one on a mirror, must not be one element that faces in neither direction. */
static floe_status seed_contacts(mpm *s, surface_list *list, const seed_spec *grid)
{
    list->load = list->enclosed = -1;
    for (int b = 0; b < s->n_bodies && implicit_measures_gaps(s); ++b) {
        list->body = s->body[b].scene_body;
        if (!scene_in_contact(s->scene, list->body)) continue;
        surface_visit(&s->scene->body[list->body].shape, grid, SURFACE_DIVISIONS, SURFACE_MIDDLES, add_outer_element,
                      list);
        TRY(list->status);
    }
    return FLOE_OK;
}

floe_status seed_surfaces(mpm *s)
{
    surface_list list = {.s = s, .enclosed = -1, .body = -1};
    const seed_spec grid = surface_grid(s);
    for (int l = 0; l < s->scene->n_loads; ++l) {
        if (s->scene->load[l].kind != LOAD_TRACTION) continue;
        const size_t before = s->surfaces->n_loaded;
        list.load = l;
        surface_visit(&s->scene->load[l].region, &grid, SURFACE_DIVISIONS, SURFACE_DIAGONALS, add_loaded_element,
                      &list);
        TRY(list.status);
        if (s->surfaces->n_loaded == before)
            return fail_key(s->ctx, KEY("loads", s->scene->load[l].name, "traction", "surface"),
                            "no surface of this shape is on the body that it loads; give the shape that bounds it");
    }
    TRY(seed_enclosing_surfaces(s, &list, &grid));
    TRY(seed_contacts(s, &list, &grid));
    if (s->surfaces->n_loaded)
        memcpy(s->surfaces->loaded_next, s->surfaces->loaded, s->surfaces->n_loaded * sizeof *s->surfaces->loaded);
    return FLOE_OK;
}

/* Mass at a node; at a ghost that of its image, so that a load by a wall is shared as its mirrored half is. */
static double mass_at(const mpm *s, const block *b, const double *mass, const int node[3])
{
    int at[3];
    for (int a = 0; a < 3; ++a) {
        at[a] = node[a];
        if (a >= s->mesh->dim || s->mesh->periodic[a]) continue;
        if (at[a] < 0) at[a] = -at[a];
        if (at[a] > s->mesh->n[a]) at[a] = 2 * s->mesh->n[a] - at[a];
    }
    return mass[mesh_index(b, at[0] - b->lo[0], at[1] - b->lo[1], at[2] - b->lo[2])];
}

static void relative_masses_of_nodes(const mpm *s, int group, const double x[3], place_stencil *st)
{
    const int blk = place_block(s, x);
    const double *mass = field_get(s->domain->fields[blk], N_MASS, group, 0);
    double heaviest = 0.0;
    for (int i = 0; i < st->n; ++i) {
        st->mass[i] = mass_at(s, &s->mesh->block[blk], mass, st->node[i]);
        heaviest = fmax(heaviest, st->mass[i]);
    }
    for (int i = 0; i < st->n; ++i) st->mass[i] = heaviest > 0.0 ? st->mass[i] / heaviest : 1.0;
}

/* Reduces the weights of nodes with less than the share `enough` of the heaviest mass. False: none has less, and nothing has changed. */
static bool bear_load(place_stencil *st, double enough)
{
    bool changed = false;
    for (int i = 0; i < st->n; ++i) {
        if (st->mass[i] >= enough) continue;
        st->w[i] *= st->mass[i] / enough;
        changed = true;
    }
    return changed;
}

/* Place of a node from the surface point in cells: row of the moments, 1 first. */
static void moment_row(const mpm *s, const double x[3], const int node[3], double row[4])
{
    row[0] = 1.0;
    for (int a = 0; a < s->mesh->dim; ++a) row[1 + a] = (mesh_node(s->mesh, a, node[a]) - x[a]) / s->mesh->h[a];
}

/* Weights times a linear factor, so that they sum to one and keep their centre at the surface point. False where the nodes
 * that are left cannot do it with shares within one: the weights are as they were. */
static bool keep_moments(const mpm *s, const double x[3], place_stencil *st)
{
    const int n = 1 + s->mesh->dim;
    double A[16] = {0.0}, c[4] = {1.0}, row[STENCIL_NODES][4], weight[STENCIL_NODES], sum[4] = {0.0};
    for (int i = 0; i < st->n; ++i) {
        moment_row(s, x, st->node[i], row[i]);
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) A[n * a + b] += st->w[i] * row[i][a] * row[i][b];
    }
    if (!small_solve_symmetric(n, A, c)) return false;
    for (int i = 0; i < st->n; ++i) {
        double factor = 0.0;
        for (int a = 0; a < n; ++a) factor += c[a] * row[i][a];
        weight[i] = st->w[i] * factor;
        if (!(fabs(weight[i]) <= 1.0)) return false;
        for (int a = 0; a < n; ++a) sum[a] += weight[i] * row[i][a];
    }
    for (int a = 0; a < n; ++a) /* nearly singular: the result is noise */
        if (!(fabs(sum[a] - (a == 0 ? 1.0 : 0.0)) <= 1e-12)) return false;
    memcpy(st->w, weight, (size_t)st->n * sizeof *weight);
    return true;
}

static void keep_sum(place_stencil *st)
{
    double sum = 0.0;
    for (int i = 0; i < st->n; ++i) sum += st->w[i];
    for (int i = 0; i < st->n; ++i) st->w[i] /= sum;
}

/* Shares of a surface point's load. The basis alone would load nodes whose support contains the surface but hardly any
 * point: such a force is balanced only by the huge stress of the one point at the edge of the support (75 times the
 * stress there, measured on an annulus with 3 x 3 points a cell). So a node takes of the load as its mass allows, and
 * the others take the rest so that force and moment stay. Slopes that vanish with the weights, as CPDI's where a corner
 * of one domain reaches a node, need more mass. */
static place_stencil surface_locate(const mpm *s, int group, const double x[3])
{
    place_stencil st = stencil_at(s, x);
    relative_masses_of_nodes(s, group, x, &st);
    if (bear_load(&st, s->basis->fact.load_mass) && !keep_moments(s, x, &st)) keep_sum(&st);
    return st;
}

typedef struct surface_force {
    double *force[3], value[3];
    int dim;
} surface_force;

static void add_traction(void *user, ptrdiff_t at, double weight, double mass)
{
    (void)mass;
    const surface_force *f = user;
    for (int a = 0; a < f->dim; ++a) f->force[a][at] += weight * f->value[a];
}

void add_surface_force(const mpm *s, int group, const double x[3], const double force[3])
{
    body_motion *motion = motion_of_group(s, group);
    if (motion) {
        motion_load(s, motion, x, force);
        return;
    }
    const place_stencil st = surface_locate(s, group, x);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        surface_force f = {.dim = s->mesh->dim};
        for (int a = 0; a < f.dim; ++a) {
            f.force[a] = field_get(s->domain->fields[b], N_FORCE, group, a);
            f.value[a] = force[a];
        }
        visit_stencil(&s->mesh->block[b], &st, add_traction, &f);
    }
}

/* Sums over the nodes of a place: of heat that is given, or of a temperature that is asked for. */
typedef struct surface_heat {
    double *change, given;
    const double *T, *capacity;
    double sum, weight;
} surface_heat;

static void give_node_heat(void *user, ptrdiff_t at, double weight, double mass)
{
    (void)mass;
    const surface_heat *f = user;
    f->change[at] += weight * f->given;
}

void add_surface_heat(const mpm *s, int group, const double x[3], double heat)
{
    const place_stencil st = surface_locate(s, group, x);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        surface_heat f = {.change = field_get(s->domain->fields[b], N_TEMP_CHANGE, group, 0), .given = heat};
        visit_stencil(&s->mesh->block[b], &st, give_node_heat, &f);
    }
}

static void ask_node_temperature(void *user, ptrdiff_t at, double weight, double mass)
{
    (void)mass;
    surface_heat *f = user;
    if (!(f->capacity[at] > 0.0)) return;
    f->sum += weight * f->T[at];
    f->weight += weight;
}

double surface_temperature(const mpm *s, int group, const double x[3])
{
    const place_stencil st = stencil_at(s, x);
    const int b = place_block(s, x);
    const fields *from = s->domain->fields[b];
    surface_heat f = {.T = field_get(from, N_TEMP, group, 0), .capacity = field_get(from, N_CAPACITY, group, 0)};
    visit_stencil(&s->mesh->block[b], &st, ask_node_temperature, &f);
    return f.weight > 0.0 ? f.sum / f.weight : (double)NAN;
}

void scatter_gas_pressure(mpm *s, int enclosed)
{
    for (size_t k = 0; k < s->surfaces->n_loaded; ++k)
        if (s->surfaces->loaded[k].enclosed == enclosed)
            add_surface_force(s, 0, s->surfaces->loaded[k].x, s->surfaces->loaded[k].area);
}

/* One surface point after the other, so that every block adds up a node in the same order. */
void scatter_surfaces(mpm *s, int group)
{
    double moment[3] = {0.0};
    for (size_t k = 0; k < s->surfaces->n_loaded; ++k) {
        const surface_point *p = &s->surfaces->loaded[k];
        if (p->load < 0) continue;
        const scene_load *load = &s->scene->load[p->load];
        if (s->body_group[load->body] != group) continue;
        const double pressure = load_target(s->scene, load, p->x, load_time(s)) * load_now(s, load);
        const double force[3] = {pressure * p->area[0], pressure * p->area[1], pressure * p->area[2]};
        add_surface_force(s, group, p->x, force);
        for (int a = 0; a < s->mesh->dim; ++a) {
            ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_SOURCE, force[a] * s->kick);
            add_moment(moment, p->x, a, force[a]);
        }
    }
    ledger_turn(s->ledger, LEDGER_SOURCE, moment, s->kick);
}

typedef struct motion_sum {
    const double *v[3], *acceleration[3];
    surface_motion out;
    double kick, undamped; /* of damping: share that it leaves */
    bool follows;          /* light nodes, too: their neighbours hold them (implicit/implicit_walls.h) */
    int dim;
} motion_sum;

/* A light node's acceleration is large and moves hardly any point, even at rest (theory 4.4): a surface that followed it would
 * leave its body, so it takes that in proportion to the mass. */
static void add_motion(void *user, ptrdiff_t at, double weight, double mass)
{
    motion_sum *m = user;
    const double without = !m->follows && mass < steady_mass ? (1.0 - mass / steady_mass) * m->kick : 0.0;
    for (int a = 0; a < m->dim; ++a) {
        const double v = m->v[a][at], change = m->acceleration[a][at];
        m->out.velocity[a] += weight * (v - without * change);
        m->out.working[a] += weight * 0.5 * ((1.0 + m->undamped) * v - m->undamped * m->kick * change);
    }
}

surface_shares surface_shares_at(const mpm *s, int group, const double x[3])
{
    const place_stencil st = surface_locate(s, group, x);
    surface_shares out; /* most of it stays unused: it is not cleared */
    out.n = st.n;
    for (int i = 0; i < st.n; ++i) {
        memcpy(out.node[i], st.node[i], sizeof out.node[i]);
        out.w[i] = st.w[i];
        out.moved[i] = walls_are_stiff(s) ? 1.0 : fmin(st.mass[i] / steady_mass, 1.0);
    }
    return out;
}

/* Of a body that does not deform. */
static surface_motion rigid_surface_motion(const mpm *s, const body_motion *motion, const double x[3])
{
    surface_motion out;
    double next[3], path[3];
    motion_of_place(s, motion, x, next, out.after, path);
    for (int a = 0; a < 3; ++a) {
        out.displacement[a] = next[a] - x[a];
        out.velocity[a] = out.displacement[a] / s->dt;
        out.working[a] = path[a] / s->dt;
    }
    return out;
}

surface_motion surface_motion_at(const mpm *s, int group, const double x[3])
{
    const body_motion *motion = motion_of_group(s, group);
    if (motion) return rigid_surface_motion(s, motion, x);
    const int b = place_block(s, x);
    motion_sum m = {.dim = s->mesh->dim, .kick = s->kick, .undamped = damping_left(s), .follows = walls_are_stiff(s)};
    for (int a = 0; a < m.dim; ++a) {
        m.v[a] = field_get(s->domain->fields[b], N_VEL_L, group, a);
        m.acceleration[a] = field_get(s->domain->fields[b], N_ACCEL, group, a);
    }
    const place_stencil st = surface_locate(s, group, x);
    visit_stencil(&s->mesh->block[b], &st, add_motion, &m);
    for (int a = 0; a < 3; ++a) {
        m.out.displacement[a] = s->dt * m.out.velocity[a];
        m.out.after[a] = m.out.velocity[a];
    }
    return m.out;
}

void move_surfaces(mpm *s, int group)
{
    for (size_t k = 0; k < s->surfaces->n_loaded; ++k) {
        const surface_point *p = &s->surfaces->loaded[k];
        const scene_load *load = &s->scene->load[p->load];
        if (s->body_group[load->body] != group) continue;
        const surface_motion m = surface_motion_at(s, group, p->x);
        const double pressure = load->target * load_now(s, load);
        double power = 0.0;
        for (int a = 0; a < 3; ++a) {
            s->surfaces->loaded_next[k].x[a] = p->x[a] + s->dt * m.velocity[a];
            s->surfaces->loaded_next[k].area[a] = p->area[a];
            power += pressure * p->area[a] * m.velocity[a];
        }
        s->surfaces->loaded_next[k].load = p->load;
        s->surfaces->loaded_next[k].enclosed = p->enclosed;
        s->surfaces->loaded_next[k].body = p->body;
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, power * s->dt);
    }
}

void displace_position(const mpm *s, int group, const double x[3], node_displacement *displacement, double out[3])
{
    const place_stencil st = surface_locate(s, group, x);
    for (int i = 0; i < st.n; ++i)
        for (int a = 0; a < s->mesh->dim; ++a) out[a] += st.w[i] * displacement(s, group, st.node[i], a);
}

void displace_surfaces(mpm *s, node_displacement *displacement)
{
    for (size_t k = 0; k < s->surfaces->n_loaded; ++k) {
        const surface_point *p = &s->surfaces->loaded[k];
        const int body = p->load < 0 ? p->body : s->scene->load[p->load].body;
        const int group = body < 0 ? 0 : s->body_group[body];
        surface_point *next = &s->surfaces->loaded_next[k];
        *next = *p;
        displace_position(s, group, p->x, displacement, next->x);
    }
}

double *mpm_surface(mpm *s, size_t *n, size_t *stride)
{
    *n = s->surfaces->n_loaded;
    *stride = sizeof(surface_point) / sizeof(double);
    return *n ? s->surfaces->loaded[0].x : NULL;
}
