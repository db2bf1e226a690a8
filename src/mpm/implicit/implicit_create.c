/* Creates the implicit solver: which scenes it supports, and its storage. */
#include "base/memory.h"
#include "grid/tile_box.h"
#include "mpm/contact/contact.h"
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_constants.h"
#include "mpm/implicit/implicit_contact.h"
#include "mpm/implicit/implicit_view.h"
#include "mpm/implicit/implicit_volume.h"
#include "mpm/implicit/implicit_walls.h"
#include "mpm/nodes/supports.h"
#include "mpm/state/stress.h"
#include "mpm/surface/traction.h"
#include "mpm/thermal/thermal.h"

#include <math.h>

static const char *obstacle_to_motion(const mpm *s)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].fluid) return "fluids flow";
    if (s->transfer->carry || s->transfer->filter) return "of the transfers it has flip and pic";
    return NULL;
}

bool mpm_body_is_enclosed(const mpm *s, int body)
{
    return surface_enclosed(s, body) > 1.0 - 1e-9;
}

static const char *obstacle_of_springs(const mpm *s, time_solver solver)
{
    if (s->scene->n_springs == 0) return NULL;
    if (solver == SOLVER_IMPLICIT) return "springs are in static and in explicit steps";
    if (s->cells != CELLS_NONE) return "springs beside cells are in explicit steps alone";
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].mean_strain) return "springs on nearly incompressible bodies are in explicit steps alone";
    return NULL;
}

const char *mpm_implicit_obstacle(const mpm *s, time_solver solver)
{
    if (solver == SOLVER_IMPLICIT && obstacle_to_motion(s)) return obstacle_to_motion(s);
    for (int b = 0; b < s->n_bodies; ++b)
        if (heat_goes_to_nodes(s, b) || dissipates_heat(s, b))
            return "the temperatures of solids change in explicit steps alone";
    if (s->basis->fact.shaped)
        return "the basis cpdi has no weights along the axes, of which its matrix is made; quadratic has";
    if (s->cells != CELLS_NONE && solver == SOLVER_IMPLICIT) return "fluids on cells flow";
    if (obstacle_of_springs(s, solver)) return obstacle_of_springs(s, solver);
    if (s->motions) return "a body has a motion of its own";
    if (s->curve) return solver == SOLVER_STATIC ? curve_rest_obstacle(s) : "membranes have no stiffness across";
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].fluid && !mpm_body_is_enclosed(s, s->body[b].scene_body))
            return "a fluid is not enclosed by solids all along its shape, and would flow";
    if (s->contact && solver == SOLVER_IMPLICIT) return "bodies in contact have velocities of their own";
    return implicit_contact_obstacle(s);
}

static solve_grid node_grid(const mesh *m)
{
    int n[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < m->dim; ++a) n[a] = m->n[a] + (m->periodic[a] ? 0 : 1);
    return solve_grid_make(m->dim, n, m->periodic);
}

static void choose_gradients(const mpm *s, struct mpm_implicit *w)
{
    const int dim = s->mesh->dim;
    for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) w->gradient[w->n_gradient++] = 3 * i + j;
    if (s->mesh->geometry == MESH_AXISYMMETRIC) w->gradient[w->n_gradient++] = 8;
}

static floe_status find_tiles(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    const size_t tiles = mesh_tiles(s->mesh);
    TRY(memory_new(s->ctx, &w->tile_block, tiles, sizeof *w->tile_block));
    TRY(memory_new(s->ctx, &w->tile_local, tiles, sizeof *w->tile_local));
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            const int number = tile_box_of(s->mesh, &s->mesh->block[b], t).number;
            w->tile_block[number] = b;
            w->tile_local[number] = t;
        }
    return FLOE_OK;
}

static floe_status make_solver(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    const int dim = s->mesh->dim;
    w->grid = node_grid(s->mesh);
    w->layers = s->contact ? s->n_groups : 1;
    for (int b = 0; b < s->n_bodies; ++b) w->layer[b] = implicit_layer(s, s->body[b].group);
    w->components = (size_t)(dim * w->layers) * w->grid.size;
    choose_gradients(s, w);
    TRY(find_tiles(s));
    TRY(multigrid_of_nodes(&w->solver, s->ctx, &w->grid, dim * w->layers, implicit_width(s), implicit_arm(s)));
    TRY(cg_create(&w->krylov, s->ctx, &w->grid, dim * w->layers, MPM_MOST_KRYLOV));
    TRY(enclosed_gases_find(s));
    TRY(implicit_contact_create(s));
    TRY(implicit_volume_create(s));
    TRY(implicit_springs_create(s));
    double **array[] = {&w->gas_force, &w->u,     &w->change,     &w->external,        &w->internal_first, &w->internal,
                        &w->residual,  &w->trial, &w->prescribed, &w->constraint_step, &w->steady};
    for (size_t k = 0; k < sizeof array / sizeof *array; ++k)
        TRY(memory_new(s->ctx, array[k], w->components, sizeof(double)));
    if (s->cells != CELLS_NONE) {
        TRY(memory_new(s->ctx, &w->external_first, w->components, sizeof *w->external_first));
        TRY(memory_new(s->ctx, &w->unbalanced, w->components, sizeof *w->unbalanced));
    }
    if (s->solver == SOLVER_IMPLICIT) {
        TRY(memory_new(s->ctx, &w->mass, w->components, sizeof *w->mass));
        TRY(memory_new(s->ctx, &w->velocity, w->components, sizeof *w->velocity));
    }
    TRY(memory_new(s->ctx, &w->constrained, w->components, sizeof *w->constrained));
    TRY(memory_new(s->ctx, &w->row, w->grid.size, sizeof *w->row));
    if (s->supports->n_regions > 0) TRY(memory_new(s->ctx, &w->led, w->grid.size, sizeof *w->led));
    return memory_new(s->ctx, &w->reached, w->components, sizeof *w->reached);
}

floe_status mpm_solve_steps(mpm *s, time_solver solver)
{
    s->solver = solver;
    TRY(memory_new(s->ctx, &s->implicit, 1, sizeof *s->implicit));
    return s->curve ? curve_rest_create(s) : make_solver(s);
}

static const char *obstacle_of_bodies(const mpm *s)
{
    for (int b = 0; b < s->n_deforming; ++b) {
        if (s->body[b].fluid) return "a fluid is on points";
        if (s->body[b].mean_strain) return "a solid that hardly changes its volume shares its changes over cells";
        if (has_artificial(&s->body[b])) return "artificial viscosity is explicit";
    }
    return NULL;
}

const char *mpm_stiff_obstacle(const mpm *s)
{
    if (s->n_deforming == 0) return "no solid deforms";
    if (s->contact) return "bodies are in contact";
    if (s->curve) return "membranes have no stiffness across";
    if (s->scene->n_springs > 0) return "springs are explicit";
    if (s->scene->method.stress != STRESS_USL) return "stress does not follow the motion (method.stress)";
    return obstacle_of_bodies(s);
}

floe_status mpm_stiffen_walls(mpm *s)
{
    TRY(memory_new(s->ctx, &s->implicit, 1, sizeof *s->implicit));
    struct mpm_implicit *w = s->implicit;
    s->solver = SOLVER_DYNAMIC;
    w->grid = node_grid(s->mesh);
    w->layers = 1;
    w->components = (size_t)s->mesh->dim * w->grid.size;
    choose_gradients(s, w);
    TRY(find_tiles(s));
    double **array[] = {&w->mass, &w->velocity, &w->prescribed};
    for (size_t k = 0; k < sizeof array / sizeof *array; ++k)
        TRY(memory_new(s->ctx, array[k], w->components, sizeof(double)));
    TRY(memory_new(s->ctx, &w->constrained, w->components, sizeof *w->constrained));
    TRY(memory_new(s->ctx, &w->row, w->grid.size, sizeof *w->row));
    if (s->supports->n_regions > 0) TRY(memory_new(s->ctx, &w->led, w->grid.size, sizeof *w->led));
    TRY(memory_new(s->ctx, &w->reached, w->components, sizeof *w->reached));
    return stiff_create(s);
}

/* Whether a point is within two cells of a side of a kind. */
static bool stands_at(const mpm *s, bc_kind kind, const double x[MESH_MAX_DIM])
{
    static const double near = 2.0;
    for (int a = 0; a < s->mesh->dim; ++a)
        for (int side = 0; side < 2 && !s->mesh->periodic[a]; ++side) {
            const double at = side == SIDE_LOWER ? s->mesh->lower[a] : s->mesh->upper[a];
            if (s->scene->bc.side[a][side].kind == kind && fabs(x[a] - at) < near * s->mesh->h[a]) return true;
        }
    return false;
}

static bool any_stands_at(const mpm *s, bc_kind kind)
{
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk)
        for (int body = 0; body < s->n_deforming; ++body)
            for (size_t k = 0; k < s->points[blk][body].n; ++k) {
                double x[MESH_MAX_DIM] = {0.0};
                for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(s->domain->fields[blk], P_POS, body, a)[k];
                if (stands_at(s, kind, x)) return true;
            }
    return false;
}

floe_status mpm_settle_walls(mpm *s, const char **why)
{
    double work = 0.0;
    *why = NULL;
    if (!walls_are_stiff(s)) return FLOE_OK;
    TRY(stiff_work(s, &work));
    if (any_stands_at(s, BC_SLIP)) /* where springs hold it up */
        *why = "a solid stands at a slip side";
    else if (supports_lead_by_body(s) && (s->supports->n_regions > 1 || any_stands_at(s, BC_SYMMETRY)))
        *why = "a fixed body is not all that holds solids, and its force would not be known";
    else if (stiff_meets_free_body(s))
        *why = "a solid is tied to a rigid body that is free";
    else if (work > MPM_WALL_WORK)
        *why = "of so many nodes the stiffness cannot be solved with";
    if (*why) implicit_destroy(s);
    return FLOE_OK;
}

int implicit_gases(const mpm *s)
{
    return s->implicit ? s->implicit->n_gases : 0;
}

int implicit_gas_body(const mpm *s, int gas)
{
    return s->implicit->gas_set[gas].body;
}

void implicit_destroy(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    if (!w) return;
    curve_rest_destroy(s);
    cg_destroy(&w->krylov);
    enclosed_gases_free(s);
    implicit_contact_free(s);
    implicit_volume_free(s);
    implicit_springs_free(s);
    stiff_free(s);
    multigrid_destroy(&w->solver);
    memory_free(s->ctx, &w->steady);
    memory_free(s->ctx, &w->external_first);
    memory_free(s->ctx, &w->unbalanced);
    void *owned[] = {&w->mass,     &w->velocity, &w->gas_force,  &w->weights,    &w->point_force,
                     &w->tangent,  &w->u,        &w->change,     &w->external,   &w->internal_first,
                     &w->internal, &w->residual, &w->trial,      &w->prescribed, &w->constrained,
                     &w->reached,  &w->row,      &w->tile_block, &w->tile_local, &w->constraint_step,
                     &w->led};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; ++k) memory_free(s->ctx, owned[k]);
    memory_free(s->ctx, &s->implicit);
}
