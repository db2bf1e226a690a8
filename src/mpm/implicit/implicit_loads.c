/* External nodal forces of an implicit step: loads, enclosed gases, gas on cells; on surfaces as the displacement has turned and stretched them, and
 * the stiffness that this makes (theory 9.1); and nodal masses. */
#include "base/memory.h"
#include "mpm/implicit/implicit.h"
#include "mpm/loads/point_loads.h"
#include "mpm/loads/spring.h"
#include "mpm/surface/surface_facets.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/surfaces.h"
#include "mpm/surface/traction.h"
#include "mpm/transfer/scatter.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

floe_status mpm_implicit_masses(mpm *s)
{
    for (int g = 0; g < s->n_groups; ++g) TRY(scatter_group(s, g, SCATTER_MOMENTUM, false, false));
    return FLOE_OK;
}

static void clear_forces(mpm *s, int group)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int c = 0; c < s->mesh->dim; ++c)
            memset(field_get(s->domain->fields[b], N_FORCE, group, c), 0, s->mesh->block[b].size * sizeof(double));
}

/* Adds what the nodes of a group have of forces, folded at walls. */
static void collect_forces(mpm *s, int group, double *out)
{
    fold_forces(s, group);
    implicit_collect(s, N_FORCE, group, out);
}

/* The nodal forces of a unit pressure of a gas on its walls as they are now, and what these have swept. */
static void press_walls(mpm *s, int r)
{
    enclosed_gas *gas = &s->implicit->gas_set[r];
    if (!gas_walls_follow(gas)) return;
    memset(gas->unit_force, 0, s->implicit->components * sizeof *gas->unit_force);
    if (gas->body < 0) turn_marker_forces(s, s->gas[r].unit_force, gas->marker_force);
    gas->swept = gas->body < 0 ? swept_by_markers(s, s->gas[r].unit_force, gas->marker_force) : surface_swept(s, r);
    for (int g = 0; g < s->n_groups; ++g) {
        clear_forces(s, g);
        if (gas->body < 0)
            scatter_markers(s, g, gas->marker_force);
        else
            scatter_gas_pressure(s, g, r);
        collect_forces(s, g, gas->unit_force);
    }
}

void implicit_move_surfaces(mpm *s, const double *u)
{
    s->implicit->tried = u;
    displace_surfaces(s, implicit_displacement);
    displace_markers(s, implicit_displacement);
}

void implicit_load_surfaces(mpm *s, const double *u, double *external)
{
    implicit_move_surfaces(s, u);
    s->kick = 0.0; /* no impulse is entered */
    for (int g = 0; g < s->n_groups; ++g) {
        clear_forces(s, g);
        scatter_surfaces(s, g);
        collect_forces(s, g, external);
    }
    for (int r = 0; r < s->implicit->n_gases; ++r) press_walls(s, r);
}

/* Whether anything presses on surfaces that follow: of gas on cells with a smeared interface nothing does (implicit_gas.c). */
static bool any_follows(const mpm *s)
{
    bool any = s->surfaces->pressed;
    for (int r = 0; r < s->implicit->n_gases; ++r) any = any || gas_walls_follow(&s->implicit->gas_set[r]);
    return any;
}

void implicit_follow_surfaces(mpm *s, const double *u)
{
    struct mpm_implicit *w = s->implicit;
    if (!any_follows(s) && !w->springs) return;
    memcpy(w->external, w->steady, w->components * sizeof *w->external);
    implicit_load_surfaces(s, u, w->external);
    implicit_springs_force(s, u, w->external);
    implicit_drop_unreached(w, w->external);
    for (int r = 0; r < w->n_gases; ++r) implicit_drop_unreached(w, w->gas_set[r].unit_force);
}

static void collect_loads(mpm *s, double *out)
{
    memset(out, 0, s->implicit->components * sizeof *out);
    s->kick = 0.0; /* no impulse is entered */
    set_body_forces(s);
    for (int g = 0; g < s->n_groups; ++g) {
        clear_forces(s, g);
        scatter_loads(s, g);
        implicit_collect(s, N_FORCE, g, out);
    }
}

/* The loads as they were when the increment before ended. */
static void collect_first_loads(mpm *s)
{
    const double dt = s->dt;
    s->dt = 0.0;
    s->step--;
    collect_loads(s, s->implicit->external_first);
    memset(s->implicit->u, 0, s->implicit->components * sizeof(double));
    implicit_load_surfaces(s, s->implicit->u, s->implicit->external_first);
    memcpy(s->implicit->acceleration_first, s->acceleration, sizeof s->acceleration);
    s->dt = dt;
    s->step++;
}

floe_status mpm_implicit_loads(mpm *s)
{
    TRY(enclosed_gases_from_cells(s));
    for (int r = 0; r < s->implicit->n_gases; ++r) {
        enclosed_gas *gas = &s->implicit->gas_set[r];
        memset(gas->unit_force, 0, s->implicit->components * sizeof *gas->unit_force);
        if (s->gas && s->gas[r].unit_force)
            TRY(memory_resize(s->ctx, &gas->marker_force, 3 * s->surfaces->markers.n, sizeof *gas->marker_force));
    }
    if (s->implicit->external_first) collect_first_loads(s);
    collect_loads(s, s->implicit->external);
    return FLOE_OK;
}

/* ---- stiffness of pressures that follow ---- */

/* A facet as the matrix sees it: its centre, area vector, and the pressure (Pa) that follows it. */
typedef struct pressed_facet {
    double x[3], area[3], pressure;
    int group;
} pressed_facet;

static double pressure_on_facet(const mpm *s, const surface_facet *f, const double x[3])
{
    if (f->use == SURFACE_BY_GAS) return s->implicit->gas_set[f->number].pressure - s->scene->reference_pressure;
    const scene_load *load = &s->scene->load[f->number];
    return load_now(s, load) * load_target(s->scene, load, x, load_time(s));
}

static pressed_facet look_at_facet(const mpm *s, const surface_facet *f)
{
    pressed_facet out = {.group = s->body_group[f->body]};
    double now[3];
    centre_of_facet(s, s->surfaces->corner, f, out.x); /* where its shape functions are */
    centre_of_facet(s, s->surfaces->corner_next, f, now);
    area_of_facet(s, s->surfaces->corner_next, f, out.area);
    out.pressure = pressure_on_facet(s, f, now);
    return out;
}

/* Change of an area vector with component c of a node: dA = (div u) A - (grad u)^T A, and with the radius about an axis. */
static void area_by_node(const mpm *s, const pressed_facet *f, const weighted_node *node, int c, double out[3])
{
    const double about_axis = s->mesh->geometry == MESH_AXISYMMETRIC && c == 0 ? node->S[0] / f->x[0] : 0.0;
    for (int a = 0; a < s->mesh->dim; ++a)
        out[a] = f->area[a] * (node->slope[c][c] + about_axis) - f->area[c] * node->slope[c][a];
}

static void add_entry(node_matrix *m, const weighted_node *i, const weighted_node *j, int c2, int c, double value)
{
    int offset[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) offset[a] = j->node[a] - i->node[a];
    node_matrix_entries(m, m->row[i->at], c2, c)[node_matrix_slot(m, offset)] += value;
}

/* Light nodes take part as far as they take the load (theory 4.13): with their whole shares the matrix is not definite there. */
static void weaken_light_nodes(const mpm *s, const pressed_facet *f, weighted_node *node, int n)
{
    const surface_shares shares = surface_shares_at(s, f->group, f->x);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < shares.n; ++k) {
            const int *at = shares.node[k];
            if (at[0] != node[i].node[0] || at[1] != node[i].node[1] || at[2] != node[i].node[2]) continue;
            node[i] = scaled_node(&node[i], shares.moved[k]);
        }
}

/* Half of the stiffness and half of its transpose: on a closed surface, and where its rim is constrained, they are the same. */
static void assemble_facet(const mpm *s, const pressed_facet *f, node_matrix *m)
{
    const struct mpm_implicit *w = s->implicit;
    const point_weights place = implicit_weights_at(s, f->x);
    const int dim = s->mesh->dim, layer = implicit_layer(s, f->group), base = layer * dim;
    weighted_node node[IMPLICIT_NODES];
    const int n = implicit_nodes(s, &place, node);
    weaken_light_nodes(s, f, node, n);
    for (int j = 0; j < n; ++j)
        for (int c = 0; c < dim; ++c) {
            double change[3];
            if (!w->reached[implicit_index(w, layer, c, node[j].at)]) continue;
            area_by_node(s, f, &node[j], c, change);
            for (int i = 0; i < n; ++i)
                for (int c2 = 0; c2 < dim; ++c2) {
                    if (!w->reached[implicit_index(w, layer, c2, node[i].at)]) continue;
                    const double half = -0.5 * f->pressure * node[i].S[c2] * change[c2];
                    add_entry(m, &node[i], &node[j], base + c2, base + c, half);
                    add_entry(m, &node[j], &node[i], base + c, base + c2, half);
                }
        }
}

/* Each marker with its share of the area of a gas on cells is a facet of its own. */
static void assemble_markers(const mpm *s, const enclosed_gas *gas, node_matrix *m)
{
    const surface_markers *k = &s->surfaces->markers;
    const double pressure = gas->pressure - s->scene->reference_pressure;
    for (size_t n = 0; n < k->n && pressure != 0.0; ++n) {
        const double *area = gas->marker_force + 3 * n, *x = k->now[n].x;
        const pressed_facet f = {{x[0], x[1], x[2]}, {area[0], area[1], area[2]}, pressure, k->group[n]};
        if (area[0] != 0.0 || area[1] != 0.0 || area[2] != 0.0) assemble_facet(s, &f, m);
    }
}

void implicit_assemble_surfaces(const mpm *s, node_matrix *m)
{
    for (int r = 0; r < s->implicit->n_gases; ++r)
        if (s->implicit->gas_set[r].marker_force) assemble_markers(s, &s->implicit->gas_set[r], m);
    if (!s->surfaces->pressed) return;
    for (size_t k = 0; k < s->surfaces->n_facets; ++k) {
        const surface_facet *f = &s->surfaces->facet[k];
        if (f->use == SURFACE_IN_CONTACT || !facet_follows(s, f)) continue;
        const pressed_facet pressed = look_at_facet(s, f);
        if (pressed.pressure != 0.0) assemble_facet(s, &pressed, m);
    }
}

/* ---- springs in static balance ---- */

/* A point of an end: its nodes, how much larger its part of the matrix is, and how far a support to which it belongs moves it, times its weight (m). */
typedef struct spring_reach {
    double bound, carried[3];
    int layer, n;
    weighted_node node[IMPLICIT_NODES];
} spring_reach;

/* One spring in an increment. */
typedef struct spring_nodes {
    int n;
    spring_reach *reach; /* owned */
    spring_pull pull;    /* at the displacement that was last evaluated */
} spring_nodes;

struct implicit_springs {
    spring_nodes spring[SCENE_MAX_SPRINGS];
};

floe_status implicit_springs_create(mpm *s)
{
    if (s->scene->n_springs == 0) return FLOE_OK;
    return memory_new(s->ctx, &s->implicit->springs, 1, sizeof *s->implicit->springs);
}

void implicit_springs_free(mpm *s)
{
    for (int n = 0; s->implicit->springs && n < SCENE_MAX_SPRINGS; ++n)
        memory_free(s->ctx, &s->implicit->springs->spring[n].reach);
    memory_free(s->ctx, &s->implicit->springs);
}

/* The nodes of a point, those that no point reaches left out. One that belongs to a support moves with that alone. */
static void find_reach(const mpm *s, const spring_share *share, spring_reach *out)
{
    const struct mpm_implicit *w = s->implicit;
    *out = (spring_reach){.n = 0};
    for (int c = 0; share->support >= 0 && c < s->mesh->dim; ++c)
        out->carried[c] = share->weight * s->dt * s->scene->support[share->support].velocity[c];
    if (share->support >= 0) return;
    const point_weights place = implicit_weights_at(s, share->x);
    out->layer = implicit_layer(s, s->body[share->body].group);
    out->n = implicit_nodes(s, &place, out->node);
    for (int i = 0; i < out->n; ++i)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const bool reached = w->reached[implicit_index(w, out->layer, c, out->node[i].at)];
            out->node[i].S[c] = reached ? share->weight * out->node[i].S[c] : 0.0;
        }
}

floe_status implicit_springs_find(mpm *s)
{
    struct implicit_springs *all = s->implicit->springs;
    for (int n = 0; all && n < s->scene->n_springs; ++n) {
        spring_nodes *spring = &all->spring[n];
        double sum = 0.0;
        spring->n = spring_find(s, n);
        if (spring->n == 0) continue;
        TRY(memory_resize(s->ctx, &spring->reach, (size_t)spring->n, sizeof *spring->reach));
        for (int k = 0; k < spring->n; ++k) sum += fabs(spring_share_of(s, n, k).weight);
        for (int k = 0; k < spring->n; ++k) {
            const spring_share share = spring_share_of(s, n, k);
            find_reach(s, &share, &spring->reach[k]);
            /* (sum w x)^2 <= (sum |w|) (sum |w| x^2); a point at the rim of an end has no weight */
            spring->reach[k].bound = share.weight != 0.0 ? sum / fabs(share.weight) : 0.0;
        }
    }
    return FLOE_OK;
}

/* Displacement of the point, times its weight. */
static void moved_by_point(const mpm *s, const spring_reach *r, const double *u, double out[3])
{
    for (int i = 0; i < r->n; ++i)
        for (int c = 0; c < s->mesh->dim; ++c)
            out[c] += r->node[i].S[c] * u[implicit_index(s->implicit, r->layer, c, r->node[i].at)];
}

static void moved_by(const mpm *s, const spring_nodes *spring, const double *u, double out[3])
{
    out[0] = out[1] = out[2] = 0.0;
    for (int k = 0; k < spring->n; ++k) moved_by_point(s, &spring->reach[k], u, out);
}

/* The same at the displacement u of the nodes, with what supports move. */
static void moved_at(const mpm *s, const spring_nodes *spring, const double *u, double out[3])
{
    moved_by(s, spring, u, out);
    for (int k = 0; k < spring->n; ++k)
        for (int c = 0; c < 3; ++c) out[c] += spring->reach[k].carried[c];
}

static void push_reach(const mpm *s, const spring_reach *r, const double force[3], bool free_alone, double *out)
{
    const struct mpm_implicit *w = s->implicit;
    for (int i = 0; i < r->n; ++i)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const size_t at = implicit_index(w, r->layer, c, r->node[i].at);
            if (!free_alone || !w->constrained[at]) out[at] += r->node[i].S[c] * force[c];
        }
}

void implicit_springs_force(mpm *s, const double *u, double *external)
{
    struct implicit_springs *all = s->implicit->springs;
    for (int n = 0; all && n < s->scene->n_springs; ++n) {
        spring_nodes *spring = &all->spring[n];
        double moved[3];
        moved_at(s, spring, u, moved);
        spring_pull_at(s, n, moved, &spring->pull);
        for (int k = 0; k < spring->n; ++k) push_reach(s, &spring->reach[k], spring->pull.force, false, external);
    }
}

double implicit_springs_gain(mpm *s, const double *u)
{
    struct implicit_springs *all = s->implicit->springs;
    double sum = 0.0;
    for (int n = 0; all && n < s->scene->n_springs; ++n) {
        const double still[3] = {0.0, 0.0, 0.0};
        double moved[3];
        spring_pull before, after;
        moved_at(s, &all->spring[n], u, moved);
        spring_pull_at(s, n, still, &before);
        spring_pull_at(s, n, moved, &after);
        sum += after.energy - before.energy;
    }
    return sum;
}

static void stiffness_times(const spring_pull *pull, const double moved[3], double factor, double force[3])
{
    for (int a = 0; a < 3; ++a)
        force[a] = factor * (pull->stiffness[3 * a] * moved[0] + pull->stiffness[3 * a + 1] * moved[1] +
                             pull->stiffness[3 * a + 2] * moved[2]);
}

void implicit_springs_stiffness(const mpm *s, const double *x, double *y)
{
    const struct implicit_springs *all = s->implicit->springs;
    for (int n = 0; all && n < s->scene->n_springs; ++n) {
        const spring_nodes *spring = &all->spring[n];
        double moved[3], force[3];
        moved_by(s, spring, x, moved);
        for (int k = 0; k < spring->n; ++k) {
            const spring_reach *r = &spring->reach[k];
            double own[3] = {0.0, 0.0, 0.0}, counted[3];
            moved_by_point(s, r, x, own);
            stiffness_times(&spring->pull, own, r->bound, counted);
            stiffness_times(&spring->pull, moved, 1.0, force);
            for (int a = 0; a < 3; ++a) force[a] -= counted[a]; /* the matrix has that */
            push_reach(s, r, force, true, y);
        }
    }
}

static void assemble_point(const mpm *s, const spring_reach *r, const spring_pull *pull, node_matrix *m)
{
    const int dim = s->mesh->dim, base = r->layer * dim;
    for (int i = 0; i < r->n; ++i)
        for (int j = 0; j < r->n; ++j)
            for (int c = 0; c < dim; ++c)
                for (int d = 0; d < dim; ++d) {
                    const double value = r->bound * pull->stiffness[3 * c + d] * r->node[i].S[c] * r->node[j].S[d];
                    if (value != 0.0) add_entry(m, &r->node[i], &r->node[j], base + c, base + d, value);
                }
}

void implicit_assemble_springs(const mpm *s, node_matrix *m)
{
    const struct implicit_springs *all = s->implicit->springs;
    for (int n = 0; all && n < s->scene->n_springs; ++n)
        for (int k = 0; k < all->spring[n].n; ++k) assemble_point(s, &all->spring[n].reach[k], &all->spring[n].pull, m);
}
