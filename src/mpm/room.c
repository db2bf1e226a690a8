/* The room inside a membrane, in the plane or about an axis: a closed one, or one whose ends lie on mirrors. */
#include "mpm/line.h"

#include <string.h>

bool mpm_membrane_encloses(const mpm *s, int body)
{
    if (s->mesh->dim != 2 || !s->body[body].membrane.model) return false;
    const membrane_line *line = &s->work->line[body];
    return line->n > 2 && line->ordered && (line->closed || (line->end[0].axis >= 0 && line->end[1].axis >= 0));
}

/* What a membrane goes around: its points, and whether they stand about an axis. */
typedef struct outline {
    const membrane_line *line;
    bool radial;
} outline;

static outline outline_of(const mpm *s, int body)
{
    return (outline){&s->work->line[body], s->mesh->geometry == MESH_AXISYMMETRIC};
}

/* Corners n to n + 3 of the room of n points: where the last meets its mirror, where the mirrors meet or, about an axis, both ends' feet
 * on it, and where the first meets its mirror. */
static void corner_of(const outline *o, size_t k, double x[2])
{
    const membrane_line *line = o->line;
    const size_t last = line->n - 1, at = k <= last ? k : k <= line->n + 1 ? last : 0;
    for (int a = 0; a < 2; ++a) x[a] = line->x[3 * at + (size_t)a];
    if (k <= last) return;
    x[line->end[at == last].axis] = line->end[at == last].plane;
    if (k == line->n || k == line->n + 3) return;
    if (o->radial)
        x[0] = 0.0;
    else
        x[line->end[at != last].axis] = line->end[at != last].plane;
}

static size_t corner_count(const outline *o)
{
    return o->line->n + (o->line->closed ? 0 : 4);
}

static bool is_inside(const outline *o, double x, double y)
{
    const size_t n = corner_count(o);
    double a[2], b[2];
    bool inside = false;
    corner_of(o, n - 1, a);
    for (size_t k = 0; k < n; ++k) {
        corner_of(o, k, b);
        if ((a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])) inside = !inside;
        memcpy(a, b, sizeof a);
    }
    return inside;
}

/* Area, or about an axis volume per radian, the integral of r^2/2 dz. */
static double size_of(const outline *o)
{
    const size_t n = corner_count(o);
    double a[2], b[2], sum = 0.0;
    corner_of(o, n - 1, a);
    for (size_t k = 0; k < n; ++k) {
        corner_of(o, k, b);
        sum += o->radial ? (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) / 6.0 * (b[1] - a[1])
                         : 0.5 * (a[0] * b[1] - b[0] * a[1]);
        memcpy(a, b, sizeof a);
    }
    return sum < 0.0 ? -sum : sum;
}

enum { SUM_PRESSURE, SUM_OUTSIDE, SUM_STRESS, SUM_HOOP, SUM_VOLUME, ROOM_SUMS };

static void add_fluid(const mpm *s, int blk, int tile, int body, const outline *o, double *sum)
{
    const fields *f = s->domain->fields[blk];
    const size_t *at = s->points[blk][body].tile_start;
    const point_arrays p = points_of(s, blk, body, false, false);
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        const double gauge = -(p.stress[0][k] + p.stress[1][k] + p.stress[2][k]) / 3.0;
        sum[SUM_PRESSURE] += p.volume0[k] * p.J[k] * (gauge + s->scene->reference_pressure);
        if (!is_inside(o, p.x[0][k], p.x[1][k])) sum[SUM_OUTSIDE] += field_get(f, P_MASS, body, 0)[k];
    }
}

static void add_membrane(const mpm *s, int blk, int tile, int body, double *sum)
{
    const size_t *at = s->points[blk][body].tile_start;
    const point_arrays p = points_of(s, blk, body, false, false);
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        sum[SUM_STRESS] += p.volume0[k] * (p.stress[0][k] + p.stress[1][k]);
        sum[SUM_HOOP] += p.volume0[k] * p.stress[2][k];
        sum[SUM_VOLUME] += p.volume0[k];
    }
}

void mpm_membrane_room(mpm *s, int body, membrane_room *out)
{
    const outline o = outline_of(s, body);
    line_update(s, body, false);
    memset(s->work->tile_sum, 0, mesh_tiles(s->mesh) * ROOM_SUMS * sizeof(double));
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            double *sum = s->work->tile_sum + (size_t)tile_box_of(s->mesh, &s->mesh->block[b], t).number * ROOM_SUMS;
            for (int k = 0; k < s->n_bodies; ++k)
                if (s->body[k].fluid) add_fluid(s, b, t, k, &o, sum);
            add_membrane(s, b, t, body, sum);
        }
    }
    double sum[ROOM_SUMS];
    domain_sum_tiles(s->mesh, s->work->tile_sum, ROOM_SUMS, sum);
    out->size = size_of(&o);
    out->pressure = sum[SUM_PRESSURE] / out->size;
    out->outside = sum[SUM_OUTSIDE];
    out->stress = sum[SUM_STRESS] / sum[SUM_VOLUME];
    out->hoop = sum[SUM_HOOP] / sum[SUM_VOLUME];
}
