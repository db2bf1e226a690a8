/* External nodal forces of an implicit step: loads, enclosed gases, gas on cells; on surfaces as the displacement has turned and stretched them, and
 * the stiffness that this makes (theory 9.1); and nodal masses. */
#include "mpm/implicit/implicit.h"
#include "mpm/loads/point_loads.h"
#include "mpm/surface/surface_facets.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/surfaces.h"
#include "mpm/surface/traction.h"
#include "mpm/transfer/scatter.h"
#include "scene/state.h"

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

void implicit_load_surfaces(mpm *s, const double *u, double *external)
{
    struct mpm_implicit *w = s->implicit;
    w->tried = u;
    displace_surfaces(s, implicit_displacement);
    s->kick = 0.0; /* no impulse is entered */
    for (int g = 0; g < s->n_groups; ++g) {
        clear_forces(s, g);
        scatter_surfaces(s, g);
        collect_forces(s, g, external);
    }
    for (int r = 0; r < w->n_gases; ++r) {
        if (w->gas_set[r].body < 0) continue; /* of cells: they are asked once (mpm_implicit_loads) */
        memset(w->gas_set[r].unit_force, 0, w->components * sizeof *w->gas_set[r].unit_force);
        for (int g = 0; g < s->n_groups; ++g) {
            clear_forces(s, g);
            scatter_gas_pressure(s, g, r);
            collect_forces(s, g, w->gas_set[r].unit_force);
        }
    }
}

void implicit_follow_surfaces(mpm *s, const double *u)
{
    struct mpm_implicit *w = s->implicit;
    if (!s->surfaces->pressed) return;
    memcpy(w->external, w->steady, w->components * sizeof *w->external);
    implicit_load_surfaces(s, u, w->external);
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
        memset(s->implicit->gas_set[r].unit_force, 0, s->implicit->components * sizeof(double));
        for (int g = 0; g < s->n_groups; ++g) {
            if (!s->gas || !s->gas[r].unit_force) continue;
            clear_forces(s, g);
            scatter_markers(s, g, s->gas[r].unit_force);
            fold_forces(s, g);
            implicit_collect(s, N_FORCE, g, s->implicit->gas_set[r].unit_force);
        }
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

/* Half of the stiffness and half of its transpose: on a closed surface, and where its rim is held, they are the same. */
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

void implicit_assemble_surfaces(const mpm *s, node_matrix *m)
{
    if (!s->surfaces->pressed) return;
    for (size_t k = 0; k < s->surfaces->n_facets; ++k) {
        const surface_facet *f = &s->surfaces->facet[k];
        if (f->use == SURFACE_IN_CONTACT || !facet_follows(s, f)) continue;
        const pressed_facet pressed = look_at_facet(s, f);
        if (pressed.pressure != 0.0) assemble_facet(s, &pressed, m);
    }
}
