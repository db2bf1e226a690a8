/* Places facets on shapes: where loads, enclosed gases and contact act on bodies (theory 4.13). */
#include "mpm/surface/traction.h"

#include "base/memory.h"
#include "geom/surface_elements.h"
#include "math/tensor.h"
#include "mpm/implicit/implicit_view.h"
#include "mpm/surface/surface_facets.h"
#include "mpm/surface/surfaces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CONTACT_DIVISIONS = 4 }; /* parts of a cell's edge between which elements lie */

/* The same under loads and gas. In space they are half as long as the parts. */
static int pressed_divisions(const mpm *s)
{
    return s->mesh->dim < 3 ? 4 : 2;
}

typedef struct surface_list {
    mpm *s;
    surface_use use;
    int number, body;
    floe_status status;
    size_t corners, facets; /* for which memory is reserved */
    size_t first_corner;    /* of this surface */
} surface_list;

/* The level of a body's shape (m) a little to one side of an element. */
static double level_beside(const mpm *s, int body, const surface_element *e, double side)
{
    const double step = side * 1e-3 * s->mesh->h[0];
    double x[3];
    for (int a = 0; a < 3; ++a) x[a] = e->x[a] + step * e->normal[a];
    return shape_level(&s->scene->body[body].shape, s->mesh->dim, x);
}

/* +1 where a body lies on the side that the normal points to, -1 on the other, 0 where its surface is not there, to a hundredth of a cell. By
 * levels, which tell the sides apart even where edges are closer than the step. */
static double side_of_body(const mpm *s, int body, const surface_element *e)
{
    if (fabs(level_beside(s, body, e, 0.0)) > 0.01 * s->mesh->h[0]) return 0.0;
    return level_beside(s, body, e, 1.0) < level_beside(s, body, e, -1.0) ? 1.0 : -1.0;
}

/* The capacity is doubled when it is used up. */
static floe_status reserve_facet(surface_list *list)
{
    struct mpm_surfaces *w = list->s->surfaces;
    if (w->n_facets == list->facets) {
        list->facets = list->facets ? 2 * list->facets : 256;
        TRY(memory_resize(list->s->ctx, &w->facet, list->facets, sizeof *w->facet));
    }
    if (w->n_corners + 3 <= list->corners) return FLOE_OK;
    list->corners = 2 * list->corners + 256;
    TRY(memory_resize(list->s->ctx, &w->corner_body, list->corners, sizeof *w->corner_body));
    return memory_resize(list->s->ctx, &w->corner, 3 * list->corners, sizeof *w->corner);
}

/* A facet with corners of its own; those that it shares are found later. */
static void add_facet(surface_list *list, const surface_element *e, double side)
{
    struct mpm_surfaces *w = list->s->surfaces;
    if (side == 0.0 || list->status != FLOE_OK) return;
    list->status = reserve_facet(list);
    if (list->status != FLOE_OK) return;
    surface_facet *f = &w->facet[w->n_facets++];
    *f = (surface_facet){.use = list->use, .number = list->number, .body = list->body};
    for (int k = 0; k < e->corners; ++k) {
        memcpy(&w->corner[3 * w->n_corners], e->corner[k], sizeof e->corner[k]);
        w->corner_body[w->n_corners] = list->body;
        f->corner[k] = w->n_corners++;
    }
    if (side < 0.0 && e->corners > 1) { /* into the shape */
        const size_t swap = f->corner[0];
        f->corner[0] = f->corner[1];
        f->corner[1] = swap;
    }
    f->at_rest[0][0] = side * e->normal[0]; /* on a line for good */
    pressure_on_corners(list->s, w->corner, f, f->at_rest);
    w->pressed = w->pressed || list->use != SURFACE_IN_CONTACT;
}

/* A corner by its place and its body, for sorting. */
typedef struct corner_key {
    double x[3];
    int body;
    size_t number;
} corner_key;

static int compare_places(const corner_key *p, const corner_key *q)
{
    for (int k = 0; k < 3; ++k)
        if (p->x[k] != q->x[k]) return p->x[k] < q->x[k] ? -1 : 1;
    return p->body < q->body ? -1 : p->body > q->body;
}

static int compare_corners(const void *a, const void *b)
{
    const corner_key *p = a, *q = b;
    const int order = compare_places(p, q);
    return order != 0 ? order : p->number < q->number ? -1 : p->number > q->number;
}

/* Gives corners at one place of a surface, which are neighbours in `key`, the first one's number; then closes the gaps in the numbers. */
static void join_sorted(struct mpm_surfaces *w, const corner_key *key, size_t n, size_t first, size_t *place)
{
    size_t kept = first;
    for (size_t k = 0; k < n; ++k) {
        const bool same = k > 0 && compare_places(&key[k], &key[k - 1]) == 0;
        place[key[k].number - first] = same ? place[key[k - 1].number - first] : key[k].number;
    }
    for (size_t k = first; k < first + n; ++k) {
        size_t *to = &place[k - first];
        if (*to != k) {
            *to = place[*to - first];
            continue;
        }
        memmove(&w->corner[3 * kept], &w->corner[3 * k], 3 * sizeof *w->corner);
        w->corner_body[kept] = w->corner_body[k];
        *to = kept++;
    }
    for (size_t f = 0; f < w->n_facets; ++f)
        for (int c = 0; c < 3; ++c)
            if (w->facet[f].corner[c] >= first) w->facet[f].corner[c] = place[w->facet[f].corner[c] - first];
    w->n_corners = kept;
}

/* Facets of a surface that meet share their corners from here on. */
static floe_status join_corners(surface_list *list)
{
    struct mpm_surfaces *w = list->s->surfaces;
    const size_t first = list->first_corner, n = w->n_corners - first;
    corner_key *key = NULL;
    size_t *place = NULL;
    TRY(list->status);
    floe_status status = memory_new(list->s->ctx, &key, n, sizeof *key);
    if (status == FLOE_OK) status = memory_new(list->s->ctx, &place, n, sizeof *place);
    if (status == FLOE_OK && n > 0) {
        for (size_t k = 0; k < n; ++k) {
            key[k] = (corner_key){.body = w->corner_body[first + k], .number = first + k};
            memcpy(key[k].x, &w->corner[3 * (first + k)], sizeof key[k].x);
        }
        qsort(key, n, sizeof *key, compare_corners);
        join_sorted(w, key, n, first, place);
    }
    memory_free(list->s->ctx, &key);
    memory_free(list->s->ctx, &place);
    list->first_corner = w->n_corners;
    return status;
}

enum { RIM_PASSES = 45 }; /* halvings, to round-off of a segment */

/* As near to its boundary (m) a place is on a body. */
static double on_boundary(const mpm *s)
{
    return 1e-6 * s->mesh->h[0];
}

/* An element's corners that are replaced, and its centre between them. */
static surface_element part_between(const surface_element *e, double corner[3][3])
{
    surface_element out = *e;
    for (int a = 0; a < 3; ++a) {
        out.x[a] = 0.0;
        for (int k = 0; k < e->corners; ++k) {
            out.corner[k][a] = corner[k][a];
            out.x[a] += corner[k][a] / e->corners;
        }
    }
    return out;
}

/* The part of an element that is on its body: `is_on` says which of its corners are. */
static void add_part_of_element(surface_list *list, const surface_element *e, const bool is_on[3])
{
    double part[6][3];
    const shape *body = &list->s->scene->body[list->body].shape;
    const int n = e->corners, edges = n > 2 ? n : n - 1;
    int kept = 0;
    for (int k = 0; k < n; ++k) {
        const int next = (k + 1) % n;
        if (is_on[k]) memcpy(part[kept++], e->corner[k], sizeof part[0]);
        if (k >= edges || is_on[k] == is_on[next]) continue;
        shape_crossing(body, list->s->mesh->dim, on_boundary(list->s), e->corner[is_on[k] ? k : next],
                       e->corner[is_on[k] ? next : k], RIM_PASSES, part[kept++]);
    }
    for (int k = n - 1; k < kept; ++k) { /* triangles about the first corner */
        double corner[3][3];
        for (int c = 0; c < n; ++c) memcpy(corner[c], part[c == 0 ? 0 : k - n + 1 + c], sizeof part[0]);
        const surface_element piece = part_between(e, corner);
        add_facet(list, &piece, side_of_body(list->s, list->body, &piece));
    }
}

/* Where the body ends, the element does, too. */
static void add_loaded_element(void *user, const surface_element *e)
{
    surface_list *list = user;
    const shape *body = &list->s->scene->body[list->body].shape;
    bool is_on[3] = {false};
    int on = 0;
    for (int k = 0; k < e->corners; ++k) {
        is_on[k] = shape_level(body, list->s->mesh->dim, e->corner[k]) <= on_boundary(list->s);
        on += is_on[k] ? 1 : 0;
    }
    if (on == 0 || on == e->corners) /* a body that is thinner than the element is not seen at its corners */
        add_facet(list, e, side_of_body(list->s, list->body, e));
    else
        add_part_of_element(list, e, is_on);
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
    list->body = faced_solid(list->s, e);
    add_facet(list, e, list->body >= 0 ? 1.0 : 0.0);
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
    for (int a = 0; a < c->s->mesh->dim; ++a) {
        const double beyond = e->x[a] + 1e-3 * c->s->mesh->h[0] * e->normal[a];
        if (beyond < c->s->mesh->lower[a] || beyond > c->s->mesh->upper[a]) return; /* a side of the domain closes it */
    }
    c->all += e->area;
    if (faced_solid(c->s, e) >= 0) c->faced += e->area;
}

double surface_enclosed(const mpm *s, int body)
{
    enclosure c = {s, 0.0, 0.0};
    const seed_spec grid = surface_grid(s);
    surface_visit(&s->scene->body[body].shape, &grid, pressed_divisions(s), count_element, &c);
    return c.all > 0.0 ? c.faced / c.all : 1.0;
}

/* Surfaces of enclosed gases (implicit.h). */
static floe_status seed_enclosing_surfaces(mpm *s, surface_list *list, const seed_spec *grid)
{
    list->use = SURFACE_BY_GAS;
    for (int r = 0; r < implicit_gases(s); ++r) {
        list->number = r;
        surface_visit(&s->scene->body[s->body[implicit_gas_body(s, r)].scene_body].shape, grid, pressed_divisions(s),
                      add_enclosing_element, list);
        TRY(join_corners(list));
    }
    return FLOE_OK;
}

static void add_outer_element(void *user, const surface_element *e)
{
    surface_list *list = user;
    struct mpm_surfaces *w = list->s->surfaces;
    const size_t before = w->n_facets;
    add_facet(list, e, 1.0);
    if (w->n_facets == before) return;
    surface_facet *f = &w->facet[before];
    double x[3];
    centre_of_facet(list->s, w->corner, f, x);
    for (int a = 0; a < 3; ++a) {
        f->area[a] = e->area * e->normal[a];
        f->offset[a] = e->x[a] - x[a];
    }
}

/* Surfaces for contact in the implicit solver (implicit_gap.c). Gaps are accurate if the two surfaces at a node are
 * complete: sides that meet at a corner, such as one on a mirror, must not be one element that faces in neither direction. */
static floe_status seed_contacts(mpm *s, surface_list *list, const seed_spec *grid)
{
    list->use = SURFACE_IN_CONTACT;
    list->number = 0;
    for (int b = 0; b < s->n_bodies && implicit_measures_gaps(s); ++b) {
        list->body = s->body[b].scene_body;
        if (!scene_in_contact(s->scene, list->body)) continue;
        surface_visit(&s->scene->body[list->body].shape, grid, CONTACT_DIVISIONS, add_outer_element, list);
        TRY(join_corners(list));
    }
    return FLOE_OK;
}

floe_status seed_surfaces(mpm *s)
{
    surface_list list = {.s = s, .use = SURFACE_LOADED};
    const seed_spec grid = surface_grid(s);
    for (int l = 0; l < s->scene->n_loads; ++l) {
        if (s->scene->load[l].kind != LOAD_TRACTION) continue;
        const size_t before = s->surfaces->n_facets;
        list.number = l;
        list.body = s->scene->load[l].body;
        surface_visit(&s->scene->load[l].region, &grid, pressed_divisions(s), add_loaded_element, &list);
        TRY(join_corners(&list));
        if (s->surfaces->n_facets == before)
            return fail_key(s->ctx, KEY("loads", s->scene->load[l].name, "traction", "surface"),
                            "no surface of this shape is on the body that it loads; give the shape that bounds it");
    }
    TRY(seed_enclosing_surfaces(s, &list, &grid));
    TRY(seed_contacts(s, &list, &grid));
    struct mpm_surfaces *w = s->surfaces;
    TRY(memory_new(s->ctx, &w->corner_next, 3 * w->n_corners, sizeof *w->corner_next));
    TRY(memory_new(s->ctx, &w->corner_force, 3 * w->n_corners, sizeof *w->corner_force));
    if (w->n_corners) memcpy(w->corner_next, w->corner, 3 * w->n_corners * sizeof *w->corner);
    return FLOE_OK;
}
