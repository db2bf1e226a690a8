/* Places surface points on shapes: where loads, enclosed gases and contact act on bodies (theory 4.13). */
#include "mpm/surface/traction.h"

#include "base/memory.h"
#include "geom/surface_elements.h"
#include "mpm/implicit/implicit_view.h"
#include "mpm/surface/surfaces.h"

#include <string.h>

enum { SURFACE_DIVISIONS = 4 }; /* surface elements per cell edge, about */

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
