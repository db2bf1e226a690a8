/* Patches of points, their coupling to the nodes, and displacements with pressures (implicit_volume.h). */
#include "mpm/implicit/implicit_volume.h"
#include "mpm/nodes/supports.h"

#include "base/memory.h"
#include "mpm/implicit/implicit_constants.h"
#include "mpm/implicit/implicit_contact.h"

#include <math.h>
#include <string.h>

bool implicit_shares_volume(const mpm *s, int body)
{
    return s->body[body].mean_strain && !s->body[body].fluid;
}

floe_status implicit_volume_create(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    bool any = false;
    for (int b = 0; b < s->n_bodies; ++b) any = any || implicit_shares_volume(s, b);
    if (!any) return FLOE_OK;
    TRY(memory_new(s->ctx, &w->volume, 1, sizeof *w->volume));
    TRY(node_matrix_create(&w->volume->exact, s->ctx, &w->grid, s->mesh->dim * w->layers, implicit_width(s),
                           implicit_arm(s)));
    w->volume->margin = MPM_VOLUME_MARGIN;
    multigrid_widen(w->solver, w->volume->margin);
    return minres_create(&w->volume->solver, s->ctx, MPM_MOST_KRYLOV);
}

void implicit_volume_free(mpm *s)
{
    struct implicit_volume *v = s->implicit->volume;
    if (!v) return;
    node_matrix_destroy(&v->exact);
    minres_destroy(&v->solver);
    void *owned[] = {&v->patch,  &v->point,      &v->phi,           &v->volume,   &v->own,
                     &v->shared, &v->own_stress, &v->shared_stress, &v->cofactor, &v->tangent,
                     &v->bulk,   &v->node,       &v->change,        &v->rhs,      &v->x};
    for (size_t k = 0; k < sizeof owned / sizeof *owned; ++k) memory_free(s->ctx, owned[k]);
    memory_free(s->ctx, &s->implicit->volume);
}

static floe_status reserve_points(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    struct implicit_volume *v = w->volume;
    const size_t n = (size_t)w->n_gradient;
    double **one[] = {&v->volume, &v->own, &v->shared, &v->own_stress, &v->shared_stress, &v->bulk};
    if (w->points <= v->points_reserved && v->point) return FLOE_OK;
    for (size_t k = 0; k < sizeof one / sizeof *one; ++k) TRY(memory_resize(s->ctx, one[k], w->points, sizeof(double)));
    TRY(memory_resize(s->ctx, &v->cofactor, w->points, n * sizeof(double)));
    TRY(memory_resize(s->ctx, &v->tangent, w->points, n * n * sizeof(double)));
    TRY(memory_resize(s->ctx, &v->point, w->points, sizeof *v->point));
    TRY(memory_resize(s->ctx, &v->phi, w->points, sizeof *v->phi));
    v->points_reserved = w->points;
    return FLOE_OK;
}

/* Adds the patches of a tile. */
static floe_status list_tile(mpm *s, int blk, int tile, int body)
{
    struct implicit_volume *v = s->implicit->volume;
    const fields *f = s->domain->fields[blk];
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const size_t *range = s->points[blk][body].tile_start + tile;
    patch_points p = {.volume0 = field_get(f, P_VOLUME0, body, 0),
                      .J = field_get(f, P_J, body, 0),
                      .free_mass = field_get(f, P_FREE_MASS, body, 0)};
    volume_patch patch[PATCHES_OF_TILE];
    for (int a = 0; a < s->mesh->dim; ++a) p.x[a] = field_get(f, P_POS, body, a);
    patches_find(s->mesh, &box, &p, range, patch);
    if (v->patches + PATCHES_OF_TILE > v->patches_reserved) {
        v->patches_reserved = 2 * v->patches_reserved + PATCHES_OF_TILE;
        TRY(memory_resize(s->ctx, &v->patch, v->patches_reserved, sizeof *v->patch));
    }
    for (int n = 0; n < PATCHES_OF_TILE; ++n) {
        if (patch[n].modes == 0) continue;
        body_patch *own = &v->patch[v->patches++];
        *own = (body_patch){.body = body, .modes = patch[n].modes, .first = v->listed, .unknown = v->modes};
        v->modes += (size_t)patch[n].modes;
        for (size_t k = range[0]; k < range[1]; ++k) {
            if (patch_of_point(s->mesh, &box, &p, k) != n || !is_patched(&p, k)) continue;
            const size_t number = s->implicit->first[blk][body] + k;
            v->volume[number] = p.volume0[k] * p.J[k];
            v->point[v->listed] = number;
            patch_modes(s->mesh, &box, &patch[n], &p, k, v->phi[v->listed++]);
        }
        own->n = v->listed - own->first;
    }
    return FLOE_OK;
}

/* The nodes that a patch's points reach: those of a box, which begins at the least of its points' first ones; masters of led nodes lie beside it. */
typedef struct node_box {
    int first[MESH_MAX_DIM], count[MESH_MAX_DIM];
} node_box;

static node_box nodes_about(const mpm *s, const body_patch *patch)
{
    const struct mpm_implicit *w = s->implicit;
    node_box box = {.count = {1, 1, 1}};
    for (int a = 0; a < s->mesh->dim; ++a) {
        int least = INT32_MAX, most = INT32_MIN;
        for (size_t k = patch->first; k < patch->first + patch->n; ++k) {
            const int first = w->weights[w->volume->point[k]].axis[a].first;
            least = first < least ? first : least;
            most = first > most ? first : most;
        }
        const int beside = w->led ? SUPPORT_STEPS : 0, end = most + s->basis->support + beside;
        const bool around = w->grid.periodic[a];
        box.first[a] = around || least > beside ? least - beside : 0;
        box.count[a] = (around || end < w->grid.n[a] ? end : w->grid.n[a]) - box.first[a];
    }
    return box;
}

static int place_in_box(const node_box *box, const int node[MESH_MAX_DIM])
{
    return node[0] - box->first[0] +
           box->count[0] * (node[1] - box->first[1] + box->count[1] * (node[2] - box->first[2]));
}

/* Numbers of the nodes in a box, in the order of the box; periodic axes are wrapped. */
static void list_patch_nodes(const mpm *s, const node_box *box, int *out)
{
    const solve_grid *g = &s->implicit->grid;
    for (int k = 0; k < box->count[2]; ++k)
        for (int j = 0; j < box->count[1]; ++j)
            for (int i = 0; i < box->count[0]; ++i) {
                int at[MESH_MAX_DIM] = {box->first[0] + i, box->first[1] + j, box->first[2] + k};
                for (int a = 0; a < s->mesh->dim; ++a)
                    if (g->periodic[a]) at[a] = (at[a] % g->n[a] + g->n[a]) % g->n[a];
                *out++ = (int)solve_index(g, at[0], at[1], at[2]);
            }
}

floe_status implicit_find_patches(mpm *s)
{
    struct implicit_volume *v = s->implicit->volume;
    size_t nodes = 0, changes = 0;
    if (!v) return FLOE_OK;
    TRY(reserve_points(s));
    v->patches = v->modes = v->listed = 0;
    for (int body = 0; body < s->n_bodies; ++body)
        for (size_t t = 0; t < mesh_tiles(s->mesh) && implicit_shares_volume(s, body); ++t)
            TRY(list_tile(s, s->implicit->tile_block[t], s->implicit->tile_local[t], body));
    for (size_t n = 0; n < v->patches; ++n) {
        body_patch *p = &v->patch[n];
        const node_box box = nodes_about(s, p);
        p->node = nodes;
        p->change = changes;
        p->nodes = (size_t)box.count[0] * (size_t)box.count[1] * (size_t)box.count[2];
        nodes += p->nodes;
        changes += p->nodes * (size_t)(p->modes * s->mesh->dim);
    }
    if (nodes > v->nodes_reserved || !v->node) {
        TRY(memory_resize(s->ctx, &v->node, nodes, sizeof *v->node));
        v->nodes_reserved = nodes;
    }
    if (changes > v->change_reserved || !v->change) {
        TRY(memory_resize(s->ctx, &v->change, changes, sizeof *v->change));
        v->change_reserved = changes;
    }
    if (s->implicit->components + v->modes > v->unknowns_reserved) {
        v->unknowns_reserved = s->implicit->components + v->modes;
        TRY(memory_resize(s->ctx, &v->rhs, v->unknowns_reserved, sizeof *v->rhs));
        TRY(memory_resize(s->ctx, &v->x, v->unknowns_reserved, sizeof *v->x));
    }
    for (size_t n = 0; n < v->patches; ++n) {
        const node_box box = nodes_about(s, &v->patch[n]);
        list_patch_nodes(s, &box, v->node + v->patch[n].node);
    }
    return minres_resize(v->solver, s->implicit->components + v->modes);
}

void implicit_project_volumes(mpm *s, double *value)
{
    const struct implicit_volume *v = s->implicit->volume;
#pragma omp parallel for schedule(static)
    for (size_t n = 0; n < v->patches; ++n) {
        const body_patch *p = &v->patch[n];
        double moment[PATCH_MODES] = {0.0};
        for (size_t k = p->first; k < p->first + p->n; ++k)
            for (int r = 0; r < p->modes; ++r) moment[r] += v->volume[v->point[k]] * v->phi[k][r] * value[v->point[k]];
        for (size_t k = p->first; k < p->first + p->n; ++k) {
            double sum = 0.0;
            for (int r = 0; r < p->modes; ++r) sum += moment[r] * v->phi[k][r];
            value[v->point[k]] = sum;
        }
    }
}

/* c of the modes of a patch, from the points' V (det f) f^-T : grad S. */
static void couple_patch(const mpm *s, body_patch *patch, double *change)
{
    const struct mpm_implicit *w = s->implicit;
    const struct implicit_volume *v = w->volume;
    const node_box box = nodes_about(s, patch);
    const int dim = s->mesh->dim;
    double volume = 0.0, bulk = 0.0;
    memset(change, 0, (size_t)(patch->modes * dim) * patch->nodes * sizeof *change);
    for (size_t k = patch->first; k < patch->first + patch->n; ++k) {
        const size_t number = v->point[k];
        double grown[IMPLICIT_GRADIENTS] = {0.0};
        weighted_node node[IMPLICIT_NODES];
        const int n = implicit_nodes(s, &w->weights[number], node);
        for (int c = 0; c < w->n_gradient; ++c)
            grown[w->gradient[c]] = v->cofactor[number * (size_t)w->n_gradient + (size_t)c];
        const double hoop = s->mesh->geometry == MESH_AXISYMMETRIC ? grown[8] / w->weights[number].radius : 0.0;
        for (int i = 0; i < n; ++i)
            for (int c = 0; c < dim; ++c) {
                double sum = c == 0 ? hoop * node[i].S[0] : 0.0;
                for (int a = 0; a < dim; ++a) sum += grown[3 * c + a] * node[i].slope[c][a];
                for (int r = 0; r < patch->modes; ++r)
                    change[(size_t)(r * dim + c) * patch->nodes + (size_t)place_in_box(&box, node[i].node)] +=
                        v->phi[k][r] * sum;
            }
        volume += v->volume[number];
        bulk += v->bulk[number];
    }
    patch->bulk = bulk / volume;
}

void implicit_couple_patches(mpm *s)
{
    struct implicit_volume *v = s->implicit->volume;
#pragma omp parallel for schedule(static)
    for (size_t n = 0; n < v->patches; ++n) couple_patch(s, &v->patch[n], v->change + v->patch[n].change);
}

/* Adds c.u of every mode to `out`. */
static void changes_of_volume(const mpm *s, const double *u, double *out)
{
    const struct implicit_volume *v = s->implicit->volume;
    const int dim = s->mesh->dim;
#pragma omp parallel for schedule(static)
    for (size_t n = 0; n < v->patches; ++n) {
        const body_patch *p = &v->patch[n];
        const double *change = v->change + p->change;
        for (int r = 0; r < p->modes; ++r) {
            double sum = 0.0;
            for (int c = 0; c < dim; ++c) {
                const double *own = u + implicit_index(s->implicit, s->implicit->layer[p->body], c, 0);
                for (size_t i = 0; i < p->nodes; ++i) sum += *change++ * own[v->node[p->node + i]];
            }
            out[p->unknown + (size_t)r] += sum;
        }
    }
}

/* Adds the forces c p of pressures p. */
static void forces_of_pressures(const mpm *s, const double *pressure, double *out)
{
    const struct implicit_volume *v = s->implicit->volume;
    const int dim = s->mesh->dim;
    for (size_t n = 0; n < v->patches; ++n) {
        const body_patch *p = &v->patch[n];
        const double *change = v->change + p->change;
        for (int r = 0; r < p->modes; ++r)
            for (int c = 0; c < dim; ++c) {
                double *own = out + implicit_index(s->implicit, s->implicit->layer[p->body], c, 0);
                for (size_t i = 0; i < p->nodes; ++i)
                    own[v->node[p->node + i]] += *change++ * pressure[p->unknown + (size_t)r];
            }
    }
}

/* Leaves out what constraints and active contact conditions take. */
static void keep_free(const mpm *s, double *force)
{
    const struct mpm_implicit *w = s->implicit;
    for (size_t k = 0; k < w->components; ++k)
        if (w->constrained[k] || !w->reached[k]) force[k] = 0.0;
    implicit_contact_project(s, force);
}

/* The share of the stiffness of points in the matrix: steps of implicit dynamics have half of it (motion_stiffen). */
static double share_of_stiffness(const struct mpm_implicit *w)
{
    return w->mass ? 0.5 : 1.0;
}

static void multiply(void *user, double *x, double *y)
{
    const mpm *s = user;
    const struct mpm_implicit *w = s->implicit;
    const struct implicit_volume *v = w->volume;
    double *pressure = x + w->components, *left = y + w->components;
    node_matrix_apply(v->exact, x, y);
    enclosed_gases_stiffness(w, x, y);
    forces_of_pressures(s, pressure, y);
    keep_free(s, y);
    for (size_t n = 0; n < v->patches; ++n)
        for (size_t r = v->patch[n].unknown; r < v->patch[n].unknown + (size_t)v->patch[n].modes; ++r)
            left[r] = -pressure[r] / (share_of_stiffness(w) * v->patch[n].bulk);
    changes_of_volume(s, x, left);
}

/* Of displacements a cycle of multigrid, of pressures 1/(1/kappa + 1/(3 G)), about what both do together where the other is gone. */
static void precondition(void *user, double *x, double *y)
{
    const mpm *s = user;
    const struct mpm_implicit *w = s->implicit;
    const struct implicit_volume *v = w->volume;
    multigrid_cycle(w->solver, x, y);
    keep_free(s, y);
    for (size_t n = 0; n < v->patches; ++n) {
        const mpm_body *b = &s->body[v->patch[n].body];
        const double shear = MPM_VOLUME_SHEAR * b->law->shear_modulus(b->law_par), bulk = v->patch[n].bulk;
        for (size_t r = v->patch[n].unknown; r < v->patch[n].unknown + (size_t)v->patch[n].modes; ++r)
            y[w->components + r] = x[w->components + r] * share_of_stiffness(w) / (1.0 / bulk + 1.0 / shear);
    }
}

/* By how much a change of volume that is left is a larger share of the forces than of what minimal residuals measure. */
static double worst_ratio(const mpm *s)
{
    const struct implicit_volume *v = s->implicit->volume;
    double worst = 1.0;
    for (size_t n = 0; n < v->patches; ++n) {
        const mpm_body *b = &s->body[v->patch[n].body];
        worst = fmax(worst, v->patch[n].bulk / b->law->shear_modulus(b->law_par));
    }
    return worst;
}

floe_status implicit_solve_volume(mpm *s, double share)
{
    struct mpm_implicit *w = s->implicit;
    struct implicit_volume *v = w->volume;
    const minres_system system = {multiply, precondition, s};
    const double tolerance = fmax(share / worst_ratio(s), MPM_VOLUME_ROUND_OFF);
    memset(v->rhs, 0, (w->components + v->modes) * sizeof *v->rhs);
    changes_of_volume(s, w->constraint_step, v->rhs + w->components);
    for (size_t r = w->components; r < w->components + v->modes; ++r) v->rhs[r] = -v->rhs[r];
    memcpy(v->rhs, w->residual, w->components * sizeof *v->rhs);
    minres_result result = minres_solve(v->solver, &system, tolerance, v->rhs, v->x);
    w->krylov_iterations += result.iterations;
    while (!result.definite && v->margin < MPM_VOLUME_MOST_MARGIN) {
        v->margin *= MPM_VOLUME_WIDER;
        multigrid_widen(w->solver, v->margin);
        TRY(multigrid_prepare(w->solver));
        result = minres_solve(v->solver, &system, tolerance, v->rhs, v->x);
        w->krylov_iterations += result.iterations;
    }
    memcpy(w->change, v->x, w->components * sizeof *w->change);
    if (!result.converged && !(result.residual < 0.1 * share))
        return fail(
            s->ctx, FLOE_RETRY,
            "the matrix of the load increment cannot be solved with: %d iterations left %g of its right-hand side",
            result.iterations, result.residual);
    return FLOE_OK;
}
