/* Loads on points: tractions on surfaces, body forces, energy. */
#include "base/memory.h"
#include "geom/surface.h"
#include "mpm/locate.h"
#include "mpm/work.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

enum { SURFACE_DIVISIONS = 4 }; /* surface elements per cell edge, about */

typedef struct surface_list {
    mpm *s;
    int load;
    floe_status status;
    size_t capacity;
} surface_list;

/* +1 where the loaded body lies on the side that the normal points to, -1 on the other, 0 where it lies on neither or both. */
static double side_of_body(const mpm *s, const scene_load *load, const surface_element *e)
{
    const shape *body = &s->scene->body[load->body].shape;
    double out[3], in[3];
    const double step = 1e-3 * s->mesh->h[0];
    for (int a = 0; a < 3; ++a) {
        out[a] = e->x[a] + step * e->normal[a];
        in[a] = e->x[a] - step * e->normal[a];
    }
    const bool outside = shape_inside(body, s->mesh->dim, out), inside = shape_inside(body, s->mesh->dim, in);
    return outside == inside ? 0.0 : outside ? 1.0 : -1.0;
}

/* Room doubles as it fills. */
static floe_status reserve_surface(surface_list *list)
{
    struct mpm_work *w = list->s->work;
    if (w->n_surface < list->capacity) return FLOE_OK;
    list->capacity = list->capacity ? 2 * list->capacity : 256;
    TRY(memory_resize(list->s->ctx, &w->surface, list->capacity, sizeof *w->surface));
    return memory_resize(list->s->ctx, &w->surface_next, list->capacity, sizeof *w->surface_next);
}

static void add_element(void *user, const surface_element *e)
{
    surface_list *list = user;
    const double side = side_of_body(list->s, &list->s->scene->load[list->load], e);
    if (side == 0.0 || list->status != FLOE_OK) return;
    list->status = reserve_surface(list);
    if (list->status != FLOE_OK) return;
    surface_point *p = &list->s->work->surface[list->s->work->n_surface++];
    p->load = list->load;
    for (int a = 0; a < 3; ++a) {
        p->x[a] = e->x[a];
        p->area[a] = side * e->area * e->normal[a]; /* a pressure pushes into the body */
    }
}

floe_status seed_surfaces(mpm *s)
{
    surface_list list = {.s = s};
    seed_spec grid = {.dim = s->mesh->dim, .axisymmetric = s->mesh->geometry == MESH_AXISYMMETRIC};
    for (int a = 0; a < 3; ++a) {
        grid.lower[a] = s->mesh->lower[a];
        grid.h[a] = s->mesh->h[a];
        grid.n[a] = s->mesh->n[a];
    }
    for (int l = 0; l < s->scene->n_loads; ++l) {
        if (s->scene->load[l].kind != LOAD_TRACTION) continue;
        const size_t before = s->work->n_surface;
        list.load = l;
        surface_visit(&s->scene->load[l].region, &grid, SURFACE_DIVISIONS, add_element, &list);
        TRY(list.status);
        if (s->work->n_surface == before)
            return fail(s->ctx, FLOE_BAD_INPUT, "load '%s' finds no surface of its shape on the body that it loads",
                        s->scene->load[l].name);
    }
    if (s->work->n_surface)
        memcpy(s->work->surface_next, s->work->surface, s->work->n_surface * sizeof *s->work->surface);
    return FLOE_OK;
}

/* Weights of a surface point, as if its tile were the whole mesh: nodes are then global. */
typedef struct surface_stencil {
    int first[3], count[3];
    double w[3][3];
} surface_stencil;

static surface_stencil surface_locate(const mpm *s, const surface_point *p)
{
    surface_stencil st = {.count = {1, 1, 1}, .w = {{1.0}, {1.0}, {1.0}}};
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double inv_h = 1.0 / s->mesh->h[a];
        int cell = mesh_cell_of(s->mesh, a, p->x[a]);
        cell = cell < 0 ? 0 : cell >= s->mesh->n[a] ? s->mesh->n[a] - 1 : cell;
        double slope[3];
        const double xi = (p->x[a] - mesh_node(s->mesh, a, cell)) * inv_h;
        st.first[a] = cell + s->work->basis_1d(xi, 0.25, inv_h, st.w[a], slope);
        st.count[a] = s->basis->support;
    }
    return st;
}

typedef void surface_node(void *user, ptrdiff_t at, double weight);

/* Visits the nodes of a stencil that a block holds. */
static void visit_stencil(const block *b, const surface_stencil *st, surface_node *visit, void *user)
{
    for (int k = 0; k < st->count[2]; ++k)
        for (int j = 0; j < st->count[1]; ++j)
            for (int i = 0; i < st->count[0]; ++i) {
                const int local[3] = {st->first[0] + i - b->lo[0], st->first[1] + j - b->lo[1],
                                      st->first[2] + k - b->lo[2]};
                bool held = true;
                for (int a = 0; a < b->dim; ++a) held = held && local[a] >= -1 && local[a] <= b->n[a] + 1;
                if (held)
                    visit(user, mesh_index(b, local[0], local[1], local[2]), st->w[0][i] * st->w[1][j] * st->w[2][k]);
            }
}

typedef struct surface_force {
    double *force[3], value[3];
    int dim;
} surface_force;

static void add_force(void *user, ptrdiff_t at, double weight)
{
    const surface_force *f = user;
    for (int a = 0; a < f->dim; ++a) f->force[a][at] += weight * f->value[a];
}

/* One surface point after the other, so that every block adds up a node in the same order. */
void scatter_surfaces(mpm *s, int group)
{
    for (size_t k = 0; k < s->work->n_surface; ++k) {
        const surface_point *p = &s->work->surface[k];
        const scene_load *load = &s->scene->load[p->load];
        if (s->work->body_group[load->body] != group) continue;
        const double pressure = load->target * load_fraction(load, s->time);
        const surface_stencil st = surface_locate(s, p);
        for (int b = 0; b < s->mesh->n_blocks; ++b) {
            surface_force f = {.dim = s->mesh->dim};
            for (int a = 0; a < f.dim; ++a) {
                f.force[a] = field_get(s->domain->fields[b], N_FORCE, group, a);
                f.value[a] = pressure * p->area[a];
            }
            visit_stencil(&s->mesh->block[b], &st, add_force, &f);
        }
        for (int a = 0; a < s->mesh->dim; ++a)
            ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_SOURCE,
                       pressure * p->area[a] * s->work->kick);
    }
}

typedef struct surface_velocity {
    const double *v[3];
    double sum[3];
    int dim;
} surface_velocity;

static void add_velocity(void *user, ptrdiff_t at, double weight)
{
    surface_velocity *v = user;
    for (int a = 0; a < v->dim; ++a) v->sum[a] += weight * v->v[a][at];
}

/* The block whose cells hold a surface point. */
static int block_of(const mpm *s, const surface_point *p)
{
    int cell[3] = {0, 0, 0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        const int c = mesh_cell_of(s->mesh, a, p->x[a]);
        cell[a] = c < 0 ? 0 : c >= s->mesh->n[a] ? s->mesh->n[a] - 1 : c;
    }
    return mesh_block_of(s->mesh, cell);
}

void move_surfaces(mpm *s, int group)
{
    for (size_t k = 0; k < s->work->n_surface; ++k) {
        const surface_point *p = &s->work->surface[k];
        const scene_load *load = &s->scene->load[p->load];
        if (s->work->body_group[load->body] != group) continue;
        const int b = block_of(s, p);
        surface_velocity v = {.dim = s->mesh->dim};
        for (int a = 0; a < v.dim; ++a) v.v[a] = field_get(s->domain->fields[b], N_VEL_L, group, a);
        const surface_stencil st = surface_locate(s, p);
        visit_stencil(&s->mesh->block[b], &st, add_velocity, &v);
        const double pressure = load->target * load_fraction(load, s->time);
        double power = 0.0;
        for (int a = 0; a < 3; ++a) {
            s->work->surface_next[k].x[a] = p->x[a] + s->dt * v.sum[a];
            s->work->surface_next[k].area[a] = p->area[a];
            power += pressure * p->area[a] * v.sum[a];
        }
        s->work->surface_next[k].load = p->load;
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_SOURCE, power * s->dt);
    }
}

void set_body_forces(mpm *s)
{
    memset(s->work->acceleration, 0, sizeof s->work->acceleration);
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        if (load->kind != LOAD_BODY_FORCE) continue;
        for (int b = 0; b < s->n_bodies; ++b)
            if (load->body < 0 || load->body == s->body[b].scene_body)
                for (int a = 0; a < 3; ++a)
                    s->work->acceleration[b][a] += load_fraction(load, s->time) * load->vector[a];
    }
}

floe_status set_heating(mpm *s)
{
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        s->work->heat_dp[l] = 0.0;
        if (s->coupled || load->kind != LOAD_PRESSURISE) continue;
        bool active;
        const double scheduled = load_scheduled_pressure(s->scene, load, s->time + s->dt, s->time, &active);
        if (!active) continue;
        double now;
        TRY(mpm_mean_pressure(s, load->material, &load->region, &now));
        s->work->heat_dp[l] = scheduled - now;
    }
    return FLOE_OK;
}
