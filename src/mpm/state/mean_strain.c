/* Shared strain and pressure of nearly incompressible bodies (mean_strain.h). A node has as many velocities as the scene has dimensions, while each point of
 * a cell constrains its own volume: there are more constraints than velocities. A body that hardly changes its volume then hardly moves (locking), or its
 * pressures cancel between points. Strain and force are shared by the same projection, so that the work of the nodes is the energy that the points store. */
#include "mpm/state/mean_strain.h"

#include "mpm/mpm_constants.h"
#include "mpm/state/volume_patch.h"

static bool is_stiff(const mpm_body *b)
{
    if (b->fluid) return eos_is_liquid(&b->fluid_par.eos);
    return b->law->shear_modulus &&
           b->law->bulk_modulus(b->law_par) > MPM_STIFF_BULK * b->law->shear_modulus(b->law_par);
}

bool body_needs_mean_strain(const mpm *s, const mpm_body *b)
{
    const bool free_axis = !b->fluid && s->scene->stress_state != STRESS_FULL; /* which keeps the volume by itself */
    const bool by_cells = b->fluid && s->scene->method.density != DENSITY_CONTINUITY;
    return s->mesh->dim > 1 && !b->membrane.model && !free_axis && !by_cells && is_stiff(b);
}

bool shares_over_patches(const mpm *s, int body)
{
    return s->body[body].mean_strain && !s->body[body].fluid;
}

static bool same_cell(const mpm *s, const double *const x[MESH_MAX_DIM], size_t i, size_t j)
{
    for (int a = 0; a < s->mesh->dim; ++a)
        if (mesh_cell_of(s->mesh, a, x[a][i]) != mesh_cell_of(s->mesh, a, x[a][j])) return false;
    return true;
}

/* End of the run of points of one cell that begins at `start`: points are sorted by cell. */
static size_t end_of_cell(const mpm *s, const double *const x[MESH_MAX_DIM], size_t start, size_t end)
{
    size_t k = start + 1;
    while (k < end && same_cell(s, x, start, k)) ++k;
    return k;
}

size_t mean_strain_chunk(const mpm *s, int body, const double *const x[MESH_MAX_DIM], size_t start, size_t end)
{
    if (end - start <= SOLID_CHUNK) return end;
    size_t stop = start + SOLID_CHUNK;
    if (!s->body[body].mean_strain || shares_over_patches(s, body)) return stop;
    while (stop > start && same_cell(s, x, stop - 1, stop)) --stop;
    return stop > start ? stop : start + SOLID_CHUNK; /* a cell of more points than a chunk is several */
}

static double rate_of_volume(const solid_batch *b, size_t k)
{
    return b->L[0][k] + b->L[4][k] + b->L[8][k];
}

int straining_axes(const mpm *s)
{
    return s->mesh->geometry == MESH_AXISYMMETRIC ? 3 : s->mesh->dim;
}

int diagonal_of(const mpm *s, int axis)
{
    return axis < s->mesh->dim ? 4 * axis : 8;
}

void set_rate_of_volume(const mpm *s, solid_batch *b, size_t k, double rate)
{
    const int axes = straining_axes(s);
    const double more = (rate - rate_of_volume(b, k)) / axes;
    for (int a = 0; a < axes; ++a) b->L[diagonal_of(s, a)][k] += more;
}

static void take_means_of_cells(const mpm *s, int blk, int body, size_t start, solid_batch *b, double *growth)
{
    const fields *f = s->domain->fields[blk];
    const double *volume0 = field_get(f, P_VOLUME0, body, 0) + start, *x[MESH_MAX_DIM] = {NULL};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, body, a) + start;
    for (size_t first = 0, stop; first < b->n; first = stop) {
        stop = end_of_cell(s, x, first, b->n);
        double volume = 0.0, rate = 0.0, grown = 0.0;
        for (size_t k = first; k < stop; ++k) {
            const double own = volume0[k] * b->J_old[k];
            volume += own;
            rate += own * rate_of_volume(b, k);
            if (growth) grown += own * growth[k];
        }
        for (size_t k = first; k < stop; ++k) {
            set_rate_of_volume(s, b, k, rate / volume);
            if (growth) growth[k] = grown / volume;
        }
    }
}

void take_mean_rates(const mpm *s, int blk, int body, size_t start, solid_batch *b, double *growth)
{
    if (!shares_over_patches(s, body)) {
        take_means_of_cells(s, blk, body, start, b, growth);
        return;
    }
    const double *rate = field_get(s->domain->fields[blk], P_VOLUME_RATE, body, 0) + start;
    for (size_t k = 0; k < b->n; ++k) set_rate_of_volume(s, b, k, rate[k]);
}

/* What patches see of a body's points. */
static patch_points patch_points_of(const mpm *s, int blk, int body, bool next)
{
    const fields *f = s->domain->fields[blk];
    patch_points p = {.volume0 = field_get(f, P_VOLUME0, body, 0),
                      .J = next ? field_next(f, P_J, body, 0) : field_get(f, P_J, body, 0),
                      .free_mass = field_get(f, P_FREE_MASS, body, 0)};
    for (int a = 0; a < s->mesh->dim; ++a) p.x[a] = field_get(f, P_POS, body, a);
    return p;
}

void share_rates(const mpm *s, int blk, int body, const tile_box *t, const size_t range[2])
{
    const patch_points p = patch_points_of(s, blk, body, false);
    volume_patch patch[PATCHES_OF_TILE];
    patches_find(s->mesh, t, &p, range, patch);
    patches_project(s->mesh, t, &p, range, patch, field_get(s->domain->fields[blk], P_VOLUME_RATE, body, 0));
}

/* The points of a body in a block; of its stress what the nodes' forces are made of. */
typedef struct stressed_points {
    const double *x[MESH_MAX_DIM], *volume0, *J, *stress[3],
        *q;              /* m, m3, 1, Pa; q: NULL without artificial viscosity */
    const double *cells; /* Pa: of the cells at the points; NULL: there are none */
    double *more;        /* Pa: P_MEAN_PRESSURE */
} stressed_points;

static stressed_points stressed_points_of(const fields *f, int dim, int body, bool next)
{
    double *(*get)(const fields *, field_id, int, int) = next ? field_next : field_get;
    stressed_points p = {.volume0 = field_get(f, P_VOLUME0, body, 0),
                         .J = get(f, P_J, body, 0),
                         .q = get(f, P_VISCOUS_PRESSURE, body, 0),
                         .cells = field_get(f, P_GRID_PRESSURE, body, 0),
                         .more = field_get(f, P_MEAN_PRESSURE, body, 0)};
    for (int a = 0; a < dim; ++a) p.x[a] = field_get(f, P_POS, body, a);
    for (int c = 0; c < 3; ++c) p.stress[c] = get(f, P_STRESS, body, c);
    return p;
}

/* Mean of the normal stresses (Pa), less what artificial viscosity takes off. */
static double mean_stress(const stressed_points *p, size_t k)
{
    return (p->stress[0][k] + p->stress[1][k] + p->stress[2][k]) / 3.0 - (p->q ? p->q[k] : 0.0);
}

static void share_in_tile(const mpm *s, const stressed_points *p, const size_t range[2])
{
    for (size_t first = range[0], stop; first < range[1]; first = stop) {
        stop = end_of_cell(s, p->x, first, range[1]);
        double volume = 0.0, stress = 0.0;
        for (size_t k = first; k < stop; ++k) {
            const double own = p->volume0[k] * p->J[k];
            volume += own;
            stress += own * mean_stress(p, k);
        }
        for (size_t k = first; k < stop; ++k)
            p->more[k] = stress / volume - mean_stress(p, k) + (p->cells ? p->cells[k] : 0.0);
    }
}

/* Mean of the normal stresses along the axes that strain (Pa), less what artificial viscosity takes off: what works as volumes change. */
static double straining_stress(const mpm *s, const stressed_points *p, size_t k)
{
    const int axes = straining_axes(s);
    double sum = 0.0;
    for (int a = 0; a < axes; ++a) sum += p->stress[a < s->mesh->dim ? a : 2][k];
    return sum / axes - (p->q ? p->q[k] : 0.0);
}

static void share_over_patches(const mpm *s, int blk, int body, int tile, bool next, const stressed_points *p)
{
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const size_t *range = s->points[blk][body].tile_start + tile;
    const patch_points places = patch_points_of(s, blk, body, next);
    volume_patch patch[PATCHES_OF_TILE];
    patches_find(s->mesh, &box, &places, range, patch);
    for (size_t k = range[0]; k < range[1]; ++k) p->more[k] = straining_stress(s, p, k);
    patches_project(s->mesh, &box, &places, range, patch, p->more);
    for (size_t k = range[0]; k < range[1]; ++k)
        p->more[k] += (p->cells ? p->cells[k] : 0.0) - straining_stress(s, p, k);
}

static floe_status share_pressures(mpm *s, bool next)
{
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk)
        for (int body = 0; body < s->n_bodies; ++body) {
            if (!s->body[body].mean_strain) continue;
            const stressed_points p = stressed_points_of(s->domain->fields[blk], s->mesh->dim, body, next);
            const size_t *start = s->points[blk][body].tile_start;
#pragma omp parallel for schedule(dynamic, 4)
            for (int t = 0; t < s->mesh->block[blk].n_tiles; ++t)
                if (shares_over_patches(s, body))
                    share_over_patches(s, blk, body, t, next, &p);
                else
                    share_in_tile(s, &p, start + t);
        }
    return FLOE_OK;
}

floe_status mpm_share_pressures(mpm *s)
{
    return share_pressures(s, false);
}

floe_status mpm_share_new_pressures(mpm *s)
{
    return share_pressures(s, true);
}
