#include "io/probe.h"

#include <math.h>

/* The sums over what lies in the probe's cell. */
typedef struct probe_sum {
    double mass, momentum[MESH_MAX_DIM], volume, pressure;
} probe_sum;

static void add_cell(const sim *s, int n, ptrdiff_t at, probe_sum *sum)
{
    const fields *f = s->domain->fields[n];
    bool counted = false; /* where no membrane keeps them apart, all have one pressure */
    for (int r = 0; r < s->ice->n_materials; r++) {
        const double *rho = field_get(f, C_RHO, r, 0), *open = field_get(f, C_OPEN, r, 0);
        if (!rho) continue;
        const double share = open ? open[at] : 1.0;
        const bool present = rho[at] > 0.0 && share > 0.0;
        sum->mass += share * rho[at];
        for (int a = 0; a < s->mesh.dim; a++) {
            const double *u = field_get(f, C_VEL, r, a);
            if (u) sum->momentum[a] += share * rho[at] * u[at];
        }
        if (!present || (!open && counted)) continue;
        counted = true;
        sum->volume += share;
        sum->pressure += share * ice_pressure_now(s->ice, n, r, at);
    }
}

static void add_point(const sim *s, const fields *f, int body, size_t i, probe_sum *sum)
{
    const double m = field_get(f, P_MASS, body, 0)[i];
    const double *J = field_get(f, P_J, body, 0);
    const double *v0 = field_get(f, P_VOLUME0, body, 0);
    sum->mass += m;
    for (int a = 0; a < s->mesh.dim; a++) sum->momentum[a] += m * field_get(f, P_VEL, body, a)[i];
    if (!v0 || !field_get(f, P_STRESS, body, 0)) return;
    const double volume = v0[i] * (J ? J[i] : 1.0);
    double trace = 0.0;
    for (int c = 0; c < 3; c++) trace += field_get(f, P_STRESS, body, c)[i];
    sum->volume += volume;
    sum->pressure += volume * (s->scene->reference_pressure - trace / 3.0);
}

static bool is_in_cell(const sim *s, const fields *f, int body, size_t i, const int cell[3])
{
    for (int a = 0; a < s->mesh.dim; a++) {
        if (mesh_cell_of(&s->mesh, a, field_get(f, P_POS, body, a)[i]) != cell[a]) return false;
    }
    return true;
}

/* Number within its block of the tile that holds a cell. */
static int tile_in_block(const mesh *m, const block *b, const int cell[3])
{
    int tile = 0;
    for (int a = MESH_MAX_DIM - 1; a >= 0; a--) tile = tile * b->tiles[a] + cell[a] / m->tile[a] - b->tile_lo[a];
    return tile;
}

static void add_points(const sim *s, int n, const int cell[3], probe_sum *sum)
{
    const fields *f = s->domain->fields[n];
    const int tile = tile_in_block(&s->mesh, &s->mesh.block[n], cell);
    for (int body = 0; body < s->mpm->n_bodies; body++) {
        const mpm_points *points = &s->mpm->points[n][body];
        for (size_t i = points->tile_start[tile]; i < points->tile_start[tile + 1]; i++) {
            if (is_in_cell(s, f, body, i, cell)) add_point(s, f, body, i, sum);
        }
    }
}

probe_value probe_read(const sim *s, const double x[3])
{
    const mesh *m = &s->mesh;
    probe_value value = {NAN, {NAN, NAN, NAN}};
    probe_sum sum = {0};
    int cell[MESH_MAX_DIM] = {0};
    for (int a = 0; a < m->dim; a++) {
        if (!(x[a] >= m->lower[a] && x[a] <= m->upper[a])) return value;
        cell[a] = mesh_cell_of(m, a, x[a]);
    }
    const int n = mesh_block_of(m, cell);
    const block *b = &m->block[n];
    if (s->ice) {
        add_cell(s, n, mesh_index(b, cell[0] - b->lo[0], cell[1] - b->lo[1], cell[2] - b->lo[2]), &sum);
    } else if (s->mpm) {
        add_points(s, n, cell, &sum);
    }
    if (sum.volume > 0.0) value.pressure = sum.pressure / sum.volume;
    for (int a = 0; a < m->dim && sum.mass > 0.0; a++) value.velocity[a] = sum.momentum[a] / sum.mass;
    return value;
}
