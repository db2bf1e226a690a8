/* Density of fluid points from the masses of cells (Y97 eqs 4.5 and 4.6), as an alternative to continuity.
 *     cell:       rho_c = sum_p m_p / V_c over the points of the fluid in the cell
 *     quadratic:  rho_c = sum_p m_p S_c(x_p) / V_c, S_c the quadratic B-spline about the cell's centre (Y97 table 12);
 *                 contributions beyond a side are reflected
 * Every point takes the density of its cell. The method assumes that the fluid fills its cells: in a cell that another body or a void shares, the density is
 * too small. The sums run over tiles in global order, and over the points in each, so that they have the same bits for any blocks; one thread makes them. */
#include "base/memory.h"
#include "mpm/mpm.h"

#include <string.h>

/* Weights of the cells below, at and above the one that holds a point at `r` of it (-1/2 to 1/2 about the centre). */
static void cell_weights(point_density kind, double r, double w[3])
{
    if (kind == DENSITY_CELL) {
        w[0] = w[2] = 0.0;
        w[1] = 1.0;
        return;
    }
    w[0] = 0.5 * (0.5 - r) * (0.5 - r);
    w[1] = 0.75 - r * r;
    w[2] = 0.5 * (0.5 + r) * (0.5 + r);
}

/* Cell of an index that may lie one beyond the mesh. */
static int fold_cell(const mesh *m, int axis, int cell)
{
    if (m->periodic[axis]) return mesh_index_around(m, axis, cell);
    return cell < 0 ? 0 : cell >= m->n[axis] ? m->n[axis] - 1 : cell;
}

/* The cell of a point, and the cells about it with their weights along each axis. */
typedef struct cell_stencil {
    int cell[3][3];
    double w[3][3];
} cell_stencil;

static cell_stencil stencil_of(const mpm *s, const double *const x[3], size_t k)
{
    const mesh *m = s->mesh;
    cell_stencil at = {.w = {{0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}};
    for (int a = 0; a < m->dim; ++a) {
        const int cell = mesh_cell_of(m, a, x[a][k]);
        const double r = (x[a][k] - m->lower[a]) / m->h[a] - cell - 0.5;
        cell_weights(s->scene->method.density, r < -0.5 ? -0.5 : r > 0.5 ? 0.5 : r, at.w[a]);
        for (int o = 0; o < 3; ++o) at.cell[a][o] = fold_cell(m, a, cell + o - 1);
    }
    return at;
}

static size_t cell_number(const mesh *m, int i, int j, int k)
{
    return (size_t)i + (size_t)m->n[0] * ((size_t)j + (size_t)m->n[1] * (size_t)k);
}

static void add_point_mass(const mpm *s, const cell_stencil *at, double mass, double *sum)
{
    const int dim = s->mesh->dim; /* an axis that is not there has the weights 0 1 0 */
    for (int z = dim > 2 ? 0 : 1; z < (dim > 2 ? 3 : 2); ++z)
        for (int y = dim > 1 ? 0 : 1; y < (dim > 1 ? 3 : 2); ++y) {
            const size_t row = cell_number(s->mesh, 0, at->cell[1][y], at->cell[2][z]);
            for (int x = 0; x < 3; ++x)
                sum[row + (size_t)at->cell[0][x]] += at->w[0][x] * at->w[1][y] * at->w[2][z] * mass;
        }
}

static void point_positions(const mpm *s, int blk, int body, const double *x[3])
{
    const fields *f = s->domain->fields[blk];
    const bool next = s->scene->method.stress != STRESS_USF; /* stress first: the points have not moved yet */
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = next ? field_next(f, P_POS, body, a) : field_get(f, P_POS, body, a);
}

/* The block of a global tile, and its number there. */
static void find_tile(const mesh *m, int tile, int *blk, int *local)
{
    int at[3], cell[MESH_MAX_DIM], rest = tile;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        at[a] = rest % m->tiles[a];
        rest /= m->tiles[a];
        cell[a] = at[a] * m->tile[a];
    }
    *blk = mesh_block_of(m, cell);
    const block *b = &m->block[*blk];
    *local = at[0] - b->tile_lo[0] + b->tiles[0] * (at[1] - b->tile_lo[1] + b->tiles[1] * (at[2] - b->tile_lo[2]));
}

/* The masses of one fluid in all cells. */
static void sum_masses(const mpm *s, int material, double *sum)
{
    memset(sum, 0, mesh_cells(s->mesh) * sizeof *sum);
    for (int tile = 0; tile < (int)mesh_tiles(s->mesh); ++tile) {
        int blk, local;
        find_tile(s->mesh, tile, &blk, &local);
        for (int body = 0; body < s->n_bodies; ++body) {
            if (s->body[body].scene_material != material) continue;
            const double *x[3], *mass = field_get(s->domain->fields[blk], P_MASS, body, 0);
            point_positions(s, blk, body, x);
            const size_t *at = s->points[blk][body].tile_start + local;
            for (size_t k = at[0]; k < at[1]; ++k) {
                const cell_stencil where = stencil_of(s, x, k);
                add_point_mass(s, &where, mass[k], sum);
            }
        }
    }
}

static void give_densities(const mpm *s, int blk, int body, const double *sum)
{
    double *density = field_get(s->domain->fields[blk], P_DENSITY, body, 0);
    const double *x[3];
    point_positions(s, blk, body, x);
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < s->points[blk][body].n; ++k) {
        int cell[3] = {0, 0, 0};
        for (int a = 0; a < s->mesh->dim; ++a) cell[a] = fold_cell(s->mesh, a, mesh_cell_of(s->mesh, a, x[a][k]));
        density[k] = sum[cell_number(s->mesh, cell[0], cell[1], cell[2])] / mesh_cell_volume(s->mesh, cell[0]);
    }
}

floe_status mpm_cell_density(mpm *s)
{
    double *sum = s->cell_mass;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (!s->body[body].fluid) continue;
        sum_masses(s, s->body[body].scene_material, sum);
        for (int b = 0; b < s->mesh->n_blocks; ++b) give_densities(s, b, body, sum);
    }
    return FLOE_OK;
}
