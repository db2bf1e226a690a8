/* Which nodes supports constrain and lead (theory 4.13). A solid that passes the surface of a region between two nodes is to be constrained there, not at the last node
 * inside: a cantilever of 20 cells would sag by up to a quarter too much. */
#include "base/memory.h"
#include "geom/bounds.h"
#include "geom/compound.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/node.h"
#include "mpm/nodes/support_beyond.h"
#include "mpm/nodes/support_points.h"
#include "mpm/nodes/supports.h"
#include "scene/scene_motion.h"

#include <math.h>
#include <string.h>

/* ---- regions ---- */

static const double at_rest[MESH_MAX_DIM] = {0.0, 0.0, 0.0};

/* Supports of the scene, and fixed bodies to which others stick where they meet. */
static void list_regions(mpm *s)
{
    const scene *sc = s->scene;
    struct mpm_supports *p = s->supports;
    for (int k = 0; k < sc->n_supports; ++k)
        p->region[p->n_regions++] = (support_region){&sc->support[k].region, sc->support[k].velocity, -1};
    for (int b = s->n_deforming; b < s->n_bodies && !sc->contact.enabled; ++b) {
        const scene_body *body = &sc->body[s->body[b].scene_body];
        if (body->motion.kind == MOTION_FIXED && body->shape.model)
            p->region[p->n_regions++] = (support_region){&body->shape, at_rest, b};
    }
}

/* Regions move with their support. */
static void place_at_start(const mpm *s, int support, const double x[MESH_MAX_DIM], double out[MESH_MAX_DIM])
{
    for (int a = 0; a < MESH_MAX_DIM; ++a) out[a] = x[a] - s->time * support_velocity(s, support)[a];
}

/* What ends at a side of the mesh has the nodes there, too. */
static bool region_has(const mpm *s, int support, const double x[MESH_MAX_DIM])
{
    const mesh *m = s->mesh;
    double at[MESH_MAX_DIM] = {0.0};
    for (int a = 0; a < m->dim; ++a) {
        const double inward = MPM_SUPPORT_BESIDE * m->h[a];
        at[a] = m->periodic[a] ? x[a] : fmax(m->lower[a] + inward, fmin(x[a], m->upper[a] - inward));
    }
    place_at_start(s, support, at, at);
    return shape_inside(s->supports->region[support].region, s->mesh->dim, at);
}

/* The first of n regions that has a place; -1: none. */
static int region_with(const mpm *s, int n, const double x[MESH_MAX_DIM])
{
    for (int k = 0; k < n; ++k)
        if (region_has(s, k, x)) return k;
    return -1;
}

int support_with(const mpm *s, const double x[MESH_MAX_DIM])
{
    return region_with(s, s->scene->n_supports, x);
}

/* Fluids are not to be led, nor solids that supports drive beside an implicit pressure, which then does not find the volumes; where cells share the mass of nodes (smeared) decks have no supports. */
bool supports_lead_group(const mpm *s, int group)
{
    bool all = s->cells != CELLS_SMEARED && !scene_drives_beside_implicit(s->scene), any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (s->body[body].group != group) continue;
        all = all && !s->body[body].fluid;
        any = any || (body < s->n_deforming && !s->body[body].membrane.model);
    }
    return all && any;
}

/* Bodies that can be led to a surface: a membrane or a fluid has none that a region cuts. */
static bool is_led_body(const mpm *s, int body)
{
    return body < s->n_deforming && !s->body[body].fluid && !s->body[body].membrane.model &&
           supports_lead_group(s, s->body[body].group);
}

int support_with_surface(const mpm *s, int group, const double x[MESH_MAX_DIM])
{
    return supports_lead_group(s, group) ? region_with(s, s->supports->n_regions, x) : -1;
}

const support_node *support_of(const mpm *s, const int node[MESH_MAX_DIM])
{
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *n = &s->supports->node[k];
        if (memcmp(n->node, node, sizeof n->node) == 0) return n;
    }
    return NULL;
}

bool supports_cut(const mpm *s, const int cell[MESH_MAX_DIM])
{
    const mesh *m = s->mesh;
    double lo[3] = {0.0}, hi[3] = {0.0}, centroid[3];
    for (int a = 0; a < m->dim; ++a) {
        lo[a] = mesh_node(m, a, cell[a]);
        hi[a] = mesh_node(m, a, cell[a] + 1);
    }
    for (int k = 0; k < s->scene->n_supports; ++k) {
        const double share = shape_fraction(&s->scene->support[k].region, m->dim, lo, hi, false, 2, centroid);
        if (share > MPM_SUPPORT_SURFACE && share < 1.0 - MPM_SUPPORT_SURFACE) return true;
    }
    return false;
}

bool supports_lead(const mpm *s, int body)
{
    for (size_t k = 0; k < s->supports->n; ++k)
        if (s->supports->node[k].led && s->supports->region[s->supports->node[k].support].body < 0)
            return is_led_body(s, body) && s->scene->n_supports <= COMPOUND_MOST;
    return false;
}

bool supports_take_points(const mpm *s, int body)
{
    return s->scene->n_supports > 0 && is_led_body(s, body);
}

static bool some_solid_has(const mpm *s, const double x[MESH_MAX_DIM])
{
    for (int body = 0; body < s->n_bodies; ++body) {
        const shape *of = &s->scene->body[s->body[body].scene_body].shape;
        if (is_led_body(s, body) && of->model && shape_inside(of, s->mesh->dim, x)) return true;
    }
    return false;
}

/* Whether some solid is at x, or where the line from there along an axis leaves the region, if that is near: what sticks to a round body does not reach into it. */
static bool solid_is_beyond(const mpm *s, int support, int axis, double way, const double x[MESH_MAX_DIM])
{
    static const double part = 0.25;
    static const int parts = 6;
    double at[MESH_MAX_DIM];
    memcpy(at, x, sizeof at);
    if (some_solid_has(s, at)) return true;
    for (int n = 0; n < parts && shape_inside(s->supports->region[support].region, s->mesh->dim, at); ++n) {
        at[axis] += way * part * s->mesh->h[axis];
        if (some_solid_has(s, at)) return true;
    }
    return false;
}

/* Whether some solid is at x, seen where it was at the start, or at most two `steps` (cells) beside the line along an axis, `way` out of the region. */
static bool solid_is_near(const mpm *s, int support, int axis, double way, double steps, const double x[MESH_MAX_DIM])
{
    double start[MESH_MAX_DIM];
    place_at_start(s, support, x, start);
    const int dim = s->mesh->dim, rows = dim > 1 ? 2 : 0, layers = dim > 2 ? 2 : 0, first = axis == 0 ? 1 : 0,
              second = axis == 2 ? 1 : 2;
    for (int k = -layers; k <= layers; ++k)
        for (int j = -rows; j <= rows; ++j) {
            double at[MESH_MAX_DIM];
            memcpy(at, start, sizeof at);
            at[first] += j * steps * s->mesh->h[first];
            at[second] += layers ? k * steps * s->mesh->h[second] : 0.0;
            if (solid_is_beyond(s, support, axis, way, at)) return true;
        }
    return false;
}

static bool step_from(const mpm *s, const int node[MESH_MAX_DIM], int axis, int steps, int out[MESH_MAX_DIM],
                      double x[MESH_MAX_DIM])
{
    memcpy(out, node, MESH_MAX_DIM * sizeof *out);
    out[axis] += steps;
    place_of_node(s->mesh, out, x);
    return s->mesh->periodic[axis] || (out[axis] >= 0 && out[axis] <= s->mesh->n[axis]);
}

/* Where the surface of a region is between a place inside and the next node outside, in cells from the former; a solid must pass it there. Negative: none does. */
static double surface_between(const mpm *s, int support, int axis, const double inside[MESH_MAX_DIM],
                              const double outside[MESH_MAX_DIM])
{
    double lo = 0.0, hi = 1.0, x[MESH_MAX_DIM];
    memcpy(x, inside, sizeof x);
    while (hi - lo > MPM_SUPPORT_SURFACE) {
        const double middle = 0.5 * (lo + hi);
        x[axis] = inside[axis] + middle * (outside[axis] - inside[axis]);
        *(region_has(s, support, x) ? &lo : &hi) = middle;
    }
    const double share = 0.5 * (lo + hi);
    x[axis] = inside[axis] + (share + MPM_SUPPORT_BESIDE) * (outside[axis] - inside[axis]);
    const double way = outside[axis] > inside[axis] ? 1.0 : -1.0;
    return solid_is_near(s, support, axis, way, MPM_SUPPORT_REACHED, x) ? share : -1.0;
}

/* Distance (cells) of a node outside from a region along an axis, less than one; negative: there is none. */
static double distance_outside(const mpm *s, int support, const int node[MESH_MAX_DIM], int axis, int way)
{
    int beside[MESH_MAX_DIM];
    double x[MESH_MAX_DIM], inside[MESH_MAX_DIM];
    place_of_node(s->mesh, node, x);
    if (!step_from(s, node, axis, way, beside, inside) || !region_has(s, support, inside)) return -1.0;
    const double share = surface_between(s, support, axis, inside, x);
    return share < 0.0 ? -1.0 : 1.0 - share;
}

static bool is_close(const mpm *s, const int node[MESH_MAX_DIM])
{
    for (int k = 0; k < s->supports->n_regions; ++k)
        for (int axis = 0; axis < s->mesh->dim; ++axis)
            for (int way = -1; way < 2; way += 2) {
                const double distance = distance_outside(s, k, node, axis, way);
                if (distance >= 0.0 && distance < MPM_SUPPORT_CLEAR) return true;
            }
    return false;
}

/* A way along which a node can be led. */
typedef struct lead {
    double distance; /* of the node from the surface, in cells */
    int master[MESH_MAX_DIM];
    double share, per_step; /* and what a step towards the master adds to it */
} lead;

static bool lead_by(const mpm *s, int support, const int node[MESH_MAX_DIM], int axis, int steps, double distance,
                    double clear, lead *out)
{
    double x[MESH_MAX_DIM];
    if (!step_from(s, node, axis, steps, out->master, x) || region_with(s, s->supports->n_regions, x) >= 0 ||
        is_close(s, out->master) || !solid_is_near(s, support, axis, steps > 0 ? 1.0 : -1.0, MPM_SUPPORT_BEARING, x))
        return false;
    out->distance = fabs(distance);
    out->share = distance / clear;
    out->per_step = 1.0 / clear;
    return true;
}

/* Of a node inside: the surface is at most as far away as points beyond it reach. */
static bool lead_from_inside(const mpm *s, int support, const int node[MESH_MAX_DIM], int axis, int way, lead *out)
{
    int at[MESH_MAX_DIM];
    double before[MESH_MAX_DIM], x[MESH_MAX_DIM];
    place_of_node(s->mesh, node, before);
    for (int steps = 1; steps <= SUPPORT_STEPS; ++steps) {
        if (!step_from(s, node, axis, way * steps, at, x)) return false;
        if (!region_has(s, support, x)) {
            const double share = surface_between(s, support, axis, before, x), depth = steps - 1 + share;
            if (share < 0.0) return false;
            const int to = steps - depth >= MPM_SUPPORT_CLEAR ? steps : steps + 1;
            return lead_by(s, support, node, axis, way * to, -depth, to - depth, out);
        }
        memcpy(before, x, sizeof before);
    }
    return false;
}

static bool lead_from_outside(const mpm *s, int support, const int node[MESH_MAX_DIM], int axis, int way, lead *out)
{
    const double distance = distance_outside(s, support, node, axis, way);
    if (distance < 0.0 || distance >= MPM_SUPPORT_CLEAR) return false;
    return lead_by(s, support, node, axis, -way, distance, 1.0 + distance, out);
}

/* The shortest way to lead a node; none where surfaces lie on both of its sides: it serves neither alone. */
static bool find_lead(const mpm *s, int support, const int node[MESH_MAX_DIM], bool inside, lead *best)
{
    bool found = false;
    for (int axis = 0; axis < s->mesh->dim; ++axis) {
        lead way[2];
        const bool lower = (inside ? lead_from_inside : lead_from_outside)(s, support, node, axis, -1, &way[0]);
        const bool upper = (inside ? lead_from_inside : lead_from_outside)(s, support, node, axis, 1, &way[1]);
        if (lower && upper) return false;
        if (!lower && !upper) continue;
        const lead *one = &way[lower ? 0 : 1];
        if (!found || one->distance < best->distance) *best = *one;
        found = true;
    }
    return found;
}

static floe_status add_support_node(mpm *s, const support_node *node)
{
    struct mpm_supports *p = s->supports;
    if (p->n == p->reserved) {
        const size_t wanted = p->reserved ? 2 * p->reserved : 64;
        TRY(memory_resize(s->ctx, &p->node, wanted, sizeof *p->node));
        p->reserved = wanted;
    }
    p->node[p->n++] = *node;
    return FLOE_OK;
}

static bool some_body_is_led(const mpm *s)
{
    for (int body = 0; body < s->n_bodies; ++body)
        if (is_led_body(s, body)) return true;
    return false;
}

static floe_status look_at_node(mpm *s, int support, const int node[MESH_MAX_DIM], bool leads)
{
    double x[MESH_MAX_DIM];
    place_of_node(s->mesh, node, x);
    support_node found = {.support = support};
    memcpy(found.node, node, sizeof found.node);
    const bool inside = region_has(s, support, x), close = leads && !inside && is_close(s, node);
    lead way = {.share = 0.0};
    found.inside = inside;
    if (leads && find_lead(s, support, node, inside, &way)) {
        found.led = true;
        found.share = way.share;
        found.per_step = way.per_step;
        for (int a = 0; a < MESH_MAX_DIM; ++a) {
            found.way[a] = way.master[a] - node[a];
            const int back = (found.way[a] > 0) - (found.way[a] < 0);
            found.master[a] = a < s->mesh->dim ? mesh_index_around(s->mesh, a, way.master[a]) : 0;
            found.anchor[a] = a < s->mesh->dim ? mesh_index_around(s->mesh, a, way.master[a] - back) : 0;
        }
    }
    return inside || close ? add_support_node(s, &found) : FLOE_OK;
}

/* Nodes within a cell of the region's bounds. */
static floe_status find_nodes(mpm *s, int support)
{
    const mesh *m = s->mesh;
    const support_region *of = &s->supports->region[support];
    int begin[3] = {0, 0, 0}, end[3] = {1, 1, 1};
    double lo[3], hi[3];
    const bool leads = some_body_is_led(s);
    const bool bounded = shape_bounds(of->region, m->dim, lo, hi);
    for (int a = 0; a < m->dim; ++a) {
        end[a] = m->n[a] + (m->periodic[a] ? 0 : 1);
        if (!bounded) continue;
        const double way = s->time * of->velocity[a] - m->lower[a];
        begin[a] = (int)fmax(0.0, fmin(end[a], floor((lo[a] + way) / m->h[a]) - 1.0));
        end[a] = (int)fmax(0.0, fmin(end[a], ceil((hi[a] + way) / m->h[a]) + 2.0));
    }
    for (int k = begin[2]; k < end[2]; ++k)
        for (int j = begin[1]; j < end[1]; ++j)
            for (int i = begin[0]; i < end[0]; ++i) TRY(look_at_node(s, support, (const int[]){i, j, k}, leads));
    return FLOE_OK;
}

static void set_free_mass(const mpm *s, int blk, int body, size_t k)
{
    const fields *f = s->domain->fields[blk];
    double x[MESH_MAX_DIM] = {0.0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, body, a)[k];
    field_get(f, P_FREE_MASS, body, 0)[k] = support_with(s, x) < 0 ? field_get(f, P_MASS, body, 0)[k] : 0.0;
}

floe_status mpm_find_free_points(mpm *s)
{
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk)
        for (int body = 0; body < s->n_bodies; ++body) {
            if (!supports_take_points(s, body)) continue;
            const long long n = (long long)s->points[blk][body].n;
#pragma omp parallel for schedule(static)
            for (long long k = 0; k < n; ++k) set_free_mass(s, blk, body, (size_t)k);
        }
    return FLOE_OK;
}

static floe_status find_all_nodes(mpm *s)
{
    s->supports->n = 0;
    for (int k = 0; k < s->supports->n_regions; ++k) TRY(find_nodes(s, k));
    return FLOE_OK;
}

static bool region_has_nodes(const struct mpm_supports *p, int region, bool led)
{
    for (size_t k = 0; k < p->n; ++k)
        if (p->node[k].support == region && (p->node[k].led || !led)) return true;
    return false;
}

/* Leaves out fixed bodies to which nothing sticks at the start. */
static bool drop_bodies(mpm *s)
{
    struct mpm_supports *p = s->supports;
    const int before = p->n_regions;
    p->n_regions = 0;
    for (int k = 0; k < before; ++k)
        if (p->region[k].body < 0 || region_has_nodes(p, k, true)) p->region[p->n_regions++] = p->region[k];
    return p->n_regions < before;
}

floe_status supports_create(mpm *s)
{
    TRY(memory_new(s->ctx, &s->supports, 1, sizeof *s->supports));
    list_regions(s);
    TRY(find_all_nodes(s));
    if (drop_bodies(s)) TRY(find_all_nodes(s));
    for (int k = 0; k < s->scene->n_supports; ++k)
        if (!region_has_nodes(s->supports, k, false))
            return fail_key(
                s->ctx, KEY("supports", s->scene->support[k].name),
                "holds nothing: no node of the mesh lies in its region; make it larger, or the cells smaller");
    return find_clear_nodes(s);
}

bool supports_lead_by_body(const mpm *s)
{
    for (int k = 0; k < s->supports->n_regions; ++k)
        if (s->supports->region[k].body >= 0) return true;
    return false;
}

bool support_moves(const mpm *s, int support)
{
    bool moves = false;
    for (int a = 0; a < s->mesh->dim; ++a) moves = moves || support_velocity(s, support)[a] != 0.0;
    return moves;
}

/* The axis along which a node is led. */
static int axis_of(const support_node *n)
{
    return n->way[0] != 0 ? 0 : n->way[1] != 0 ? 1 : 2;
}

int supports_widen(const mpm *s)
{
    const support_node *first[SUPPORT_REGIONS][2] = {{NULL}};
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *n = &s->supports->node[k];
        if (!n->led) continue;
        const int axis = axis_of(n);
        const support_node **same = &first[n->support][n->way[axis] > 0 ? 1 : 0];
        if (!*same) *same = n;
        if (axis_of(*same) != axis || (*same)->master[axis] != n->master[axis]) return SUPPORT_STEPS;
    }
    return 0;
}

floe_status follow_supports(mpm *s)
{
    bool any = false;
    for (int k = 0; k < s->scene->n_supports; ++k) any = any || support_moves(s, k);
    if (!any) return FLOE_OK;
    TRY(find_all_nodes(s));
    return find_clear_nodes(s);
}

void supports_free(mpm *s)
{
    if (s->supports) memory_free(s->ctx, &s->supports->node);
    if (s->supports) memory_free(s->ctx, &s->supports->clear);
    memory_free(s->ctx, &s->supports);
}
