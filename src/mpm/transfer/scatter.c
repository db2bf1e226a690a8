/* From points to nodes: masses, momenta and forces of a velocity field. */
#include "mpm/transfer/scatter.h"

#include "grid/tile_box.h"
#include "mpm/loads/spring.h"
#include "mpm/membrane/enclosed_gas.h"
#include "mpm/motion/motion.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/nodes/supports.h"
#include "mpm/surface/membrane_boundary.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/surfaces.h"
#include "mpm/surface/traction.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/windows.h"

#include <string.h>

/* Doubles that a scatter has for a node. */
static int record_of(scatter_mode mode, int dim)
{
    return (mode == SCATTER_FORCE ? 0 : lanes_of(1 + dim)) + (mode == SCATTER_MOMENTUM ? 0 : lanes_of(dim));
}

/* What is taken of the points of a velocity field. */
typedef struct scatter_what {
    scatter_mode mode;
    bool next_stress, next_velocity;
    bool supported; /* with the mass of points that supports hold */
} scatter_what;

/* One tile's private sums. */
static void scatter_tile_sums(mpm *s, int group, int blk, int tile, const scatter_what *what)
{
    tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    box.shared = shared_cells(s, blk, tile, &box);
    double *out = domain_tile(s->domain, box.number);
    const size_t size = (size_t)s->windows->window_nodes * (size_t)record_of(what->mode, s->mesh->dim);
    bool any = false;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start;
        if (s->body[body].group != group || start[tile] == start[tile + 1]) continue;
        if (!any) memset(out, 0, size * sizeof(double));
        any = true;
        point_arrays p = points_of(s, blk, body, what->next_stress, what->next_velocity);
        if (what->supported) p.mass = p.all_mass;
        s->windows->kernel->scatter[what->mode](s->mesh, &box, &p, start[tile], start[tile + 1], out);
    }
    s->windows->active[box.number] = any;
}

static node_target target_of(const mpm *s, int blk, int group, scatter_mode mode)
{
    const fields *f = s->domain->fields[blk];
    const int dim = s->mesh->dim;
    node_target t = {.components = record_of(mode, dim), .reach = s->windows->reach};
    memcpy(t.window, s->windows->window, sizeof t.window);
    double **force = t.array;
    if (mode != SCATTER_FORCE) {
        t.array[0] = field_get(f, N_MASS, group, 0);
        for (int a = 0; a < dim; ++a) t.array[1 + a] = field_get(f, N_MOMENTUM, group, a);
        force += lanes_of(1 + dim);
    }
    for (int a = 0; mode != SCATTER_MOMENTUM && a < dim; ++a) force[a] = field_get(f, N_FORCE, group, a);
    return t;
}

static void scatter_points(mpm *s, int group, const scatter_what *what)
{
    const mesh *m = s->mesh;
    for (int b = 0; b < m->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < m->block[b].n_tiles; ++t) scatter_tile_sums(s, group, b, t, what);
    }
    domain_share_partials(s->domain);
    for (int b = 0; b < m->n_blocks; ++b) {
        const node_target out = target_of(s, b, group, what->mode);
        gather_nodes(s, b, &out);
    }
}

static void scatter_masses(mpm *s, int group, const scatter_what *what)
{
    scatter_points(s, group, what);
    domain_fold_periodic(s->domain, N_MASS, group);
    domain_fold_periodic(s->domain, N_MOMENTUM, group);
    fold_walls(s, group, true, false);
}

floe_status scatter_group(mpm *s, int group, scatter_mode mode, bool next_stress, bool next_velocity)
{
    scatter_what what = {mode, next_stress, next_velocity, false};
    if (mode == SCATTER_FORCE) {
        scatter_points(s, group, &what);
    } else {
        if (supported_nodes_push(s, group)) {
            scatter_masses(s, group, &(scatter_what){SCATTER_MOMENTUM, next_stress, next_velocity, true});
            keep_whole_masses(s, group);
        }
        scatter_masses(s, group, &what);
        if (supported_nodes_push(s, group)) put_whole_masses(s, group);
    }
    if (mode != SCATTER_MOMENTUM) scatter_loads(s, group);
    return FLOE_OK;
}

void scatter_loads(mpm *s, int group)
{
    motion_clear_loads(s, group);
    if (!mpm_is_solved(s)) {        /* else they follow the displacement that is solved for */
        scatter_surfaces(s, group); /* they look at the masses */
        scatter_markers(s, group, s->surfaces->markers.force);
        scatter_springs(s, group);
    }
    scatter_membrane_force(s, group);
    scatter_enclosed_pressure(s, group);
    fold_forces(s, group);
}

void fold_forces(mpm *s, int group)
{
    domain_fold_periodic(s->domain, N_FORCE, group);
    fold_walls(s, group, false, true);
}
