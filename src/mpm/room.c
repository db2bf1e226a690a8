/* The room inside a membrane of a plane scene: a closed one, or one whose ends lie on mirrors. */
#include "mpm/line.h"

#include <string.h>

bool mpm_membrane_encloses(const mpm *s, int body)
{
    if (s->mesh->dim != 2 || s->mesh->geometry == MESH_AXISYMMETRIC || !s->body[body].membrane.model) return false;
    const membrane_line *line = &s->work->line[body];
    return line->n > 2 && (line->closed || (line->end[0].axis >= 0 && line->end[1].axis >= 0));
}

/* Corner k of the room: the points in order, where the ends meet their mirrors, and where those meet. */
static void corner_of(const membrane_line *line, size_t k, double x[2])
{
    const size_t at = k < line->n ? k : k == line->n ? line->n - 1 : 0;
    for (int a = 0; a < 2; ++a) x[a] = line->x[3 * at + (size_t)a];
    if (k == line->n || k == line->n + 2) x[line->end[k == line->n].axis] = line->end[k == line->n].plane;
    if (k == line->n + 1)
        for (int e = 0; e < 2; ++e) x[line->end[e].axis] = line->end[e].plane;
}

static size_t corner_count(const membrane_line *line)
{
    return line->n + (line->closed ? 0 : 3);
}

static bool is_inside(const membrane_line *line, double x, double y)
{
    const size_t n = corner_count(line);
    double a[2], b[2];
    bool inside = false;
    corner_of(line, n - 1, a);
    for (size_t k = 0; k < n; ++k) {
        corner_of(line, k, b);
        if ((a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])) inside = !inside;
        memcpy(a, b, sizeof a);
    }
    return inside;
}

static double area_of(const membrane_line *line)
{
    const size_t n = corner_count(line);
    double a[2], b[2], sum = 0.0;
    corner_of(line, n - 1, a);
    for (size_t k = 0; k < n; ++k) {
        corner_of(line, k, b);
        sum += 0.5 * (a[0] * b[1] - b[0] * a[1]);
        memcpy(a, b, sizeof a);
    }
    return sum < 0.0 ? -sum : sum;
}

enum { SUM_PRESSURE, SUM_OUTSIDE, SUM_STRESS, SUM_VOLUME, ROOM_SUMS };

static void add_fluid(const mpm *s, int blk, int tile, int body, const membrane_line *line, double *sum)
{
    const fields *f = s->domain->fields[blk];
    const size_t *at = s->points[blk][body].tile_start;
    const point_arrays p = points_of(s, blk, body, false, false);
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        const double gauge = -(p.stress[0][k] + p.stress[1][k] + p.stress[2][k]) / 3.0;
        sum[SUM_PRESSURE] += p.volume0[k] * p.J[k] * (gauge + s->scene->reference_pressure);
        if (!is_inside(line, p.x[0][k], p.x[1][k])) sum[SUM_OUTSIDE] += field_get(f, P_MASS, body, 0)[k];
    }
}

static void add_membrane(const mpm *s, int blk, int tile, int body, double *sum)
{
    const size_t *at = s->points[blk][body].tile_start;
    const point_arrays p = points_of(s, blk, body, false, false);
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        sum[SUM_STRESS] += p.volume0[k] * (p.stress[0][k] + p.stress[1][k]);
        sum[SUM_VOLUME] += p.volume0[k];
    }
}

void mpm_membrane_room(mpm *s, int body, membrane_room *out)
{
    const membrane_line *line = &s->work->line[body];
    line_update(s, body, false);
    memset(s->work->tile_sum, 0, mesh_tiles(s->mesh) * ROOM_SUMS * sizeof(double));
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            double *sum = s->work->tile_sum + (size_t)tile_box_of(s->mesh, &s->mesh->block[b], t).number * ROOM_SUMS;
            for (int k = 0; k < s->n_bodies; ++k)
                if (s->body[k].fluid) add_fluid(s, b, t, k, line, sum);
            add_membrane(s, b, t, body, sum);
        }
    }
    double sum[ROOM_SUMS];
    domain_sum_tiles(s->mesh, s->work->tile_sum, ROOM_SUMS, sum);
    out->area = area_of(line);
    out->pressure = sum[SUM_PRESSURE] / out->area;
    out->outside = sum[SUM_OUTSIDE];
    out->stress = sum[SUM_STRESS] / sum[SUM_VOLUME];
}
