/* Totals over the owned cells, in tile order (docs/structure.md, Tiles), and the mean pressure of a region. */
#include "ice/source/ice_source.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_tiles.h"
#include "ice/state/ice_walk.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum {
    SUM_MASS,
    SUM_INTERNAL,
    SUM_KINETIC,
    SUM_MOMENTUM,
    SUM_SCALE = SUM_MOMENTUM + 3,
    SUM_MOMENT = SUM_SCALE + 3,
    SUM_SIZE = SUM_MOMENT + 3,
    SUM_VALUES = SUM_SIZE + 3
};

/* Moment of a cell's momentum about the origin, and its size about the middle of the mesh. */
static void add_turning(const mesh *grid, const ice_view *v, const ice_fluid *m, const int *cell, ptrdiff_t at,
                        double mass, double *sum)
{
    double own[3] = {0.0};
    for (int a = 0; a < v->dim; ++a) {
        double x[MESH_MAX_DIM] = {0.0}, from[MESH_MAX_DIM] = {0.0};
        for (int b = 0; b < v->dim; ++b) {
            x[b] = mesh_centre(grid, b, cell[b]);
            from[b] = x[b] - 0.5 * (grid->lower[b] + grid->upper[b]);
        }
        add_moment(sum + SUM_MOMENT, x, a, mass * m->u[a][at]);
        add_moment(own, from, a, mass * m->u[a][at]);
    }
    for (int a = 0; a < 3; ++a) sum[SUM_SIZE + a] += fabs(own[a]);
}

static void sum_row(const ice *s, const ice_view *v, int r, int j, int k, double *tile)
{
    const ice_fluid *m = &v->m[r];
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(v->b, i, j, k);
        const int cell[MESH_MAX_DIM] = {v->b->lo[0] + i, v->b->lo[1] + j, v->b->lo[2] + k};
        double *sum = tile + (size_t)mesh_tile_of(s->mesh, cell) * SUM_VALUES;
        const double mass = m->rho[at] * v->volume[i] * (m->open ? m->open[at] : 1.0);
        sum[SUM_MASS] += mass;
        sum[SUM_INTERNAL] += mass * m->e[at];
        for (int a = 0; a < v->dim; ++a) {
            const double u = m->u[a][at];
            sum[SUM_KINETIC] += 0.5 * mass * u * u;
            sum[SUM_MOMENTUM + a] += mass * u;
            sum[SUM_SCALE + a] += fabs(mass * u);
        }
        add_turning(s->mesh, v, m, cell, at, mass, sum);
    }
}

static void sum_material(const ice *s, int r, double *tile, double *sum)
{
    memset(tile, 0, mesh_tiles(s->mesh) * SUM_VALUES * sizeof(double));
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);) {
        const ice_rows q = ice_rows_of(v.b, -1, 0);
        const int chunk = ice_rows_chunk(s, q);
#pragma omp parallel for schedule(static, chunk)
        for (int row = 0; row < q.n; ++row) sum_row(s, &v, r, ice_row_j(q, row), ice_row_k(q, row), tile);
    }
    domain_sum_tiles(s->mesh, tile, SUM_VALUES, sum);
}

floe_status ice_sum(ice *s, ice_totals *out)
{
    memset(out, 0, sizeof *out);
    double *tile;
    TRY(memory_new(s->ctx, &tile, mesh_tiles(s->mesh) * SUM_VALUES, sizeof(double)));
    for (int r = 0; r < s->n_materials; ++r) {
        if (s->material[r].points) continue;
        double sum[SUM_VALUES];
        sum_material(s, r, tile, sum);
        out->mass[r] = sum[SUM_MASS];
        out->internal[r] = sum[SUM_INTERNAL];
        out->kinetic[r] = sum[SUM_KINETIC];
        for (int a = 0; a < s->mesh->dim; ++a) {
            out->momentum[r][a] = sum[SUM_MOMENTUM + a];
            out->momentum_scale[a] += sum[SUM_SCALE + a];
        }
        for (int a = 0; a < 3; ++a) {
            out->moment[r][a] = sum[SUM_MOMENT + a];
            out->moment_scale[a] += sum[SUM_SIZE + a];
        }
    }
    memory_free(s->ctx, &tile);
    return FLOE_OK;
}

floe_status ice_mean_pressure(ice *s, int material, const shape *region, double *pressure)
{
    double *tile, sum[2];
    TRY(memory_new(s->ctx, &tile, mesh_tiles(s->mesh) * 2, sizeof(double)));
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);)
        for (ice_walk c = ICE_FIRST; ice_next_cell(v.b, &c);) {
            const ptrdiff_t at = c.at;
            const ice_fluid *m = &v.m[material];
            const double inside = m->rho[at] > 0.0 && region ? ice_region_share(s->mesh, region, c.cell) : 1.0;
            if (!(m->rho[at] > 0.0) || !(inside > 0.0)) continue;
            const double share = (v.multi ? m->rho[at] * m->vol[at] : 1.0) * (m->open ? m->open[at] : 1.0);
            const double weight = inside * v.volume[c.in[0]] * share;
            double *t = tile + 2 * (size_t)mesh_tile_of(s->mesh, c.cell);
            t[0] += weight;
            t[1] += weight * ice_pressure_now(s, v.b->id, material, at);
        }
    domain_sum_tiles(s->mesh, tile, 2, sum);
    memory_free(s->ctx, &tile);
    *pressure = sum[1] / sum[0];
    return FLOE_OK;
}

double ice_mass_beyond(ice *s, int material)
{
    double sum = 0.0;
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);) {
        const ice_fluid *m = &v.m[material];
        for (int j = 0; j < v.b->n[1]; ++j)
            for (int i = 0; i < v.b->n[0] && m->open; ++i) {
                const ptrdiff_t at = mesh_index(v.b, i, j, 0);
                if (m->open[at] == 0.0) sum += m->rho[at] * v.volume[i];
            }
    }
    return sum;
}
