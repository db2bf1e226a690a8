/* Extent of bodies at the nodes where they meet. It is determined from the points, since a node has mass of a body up to one and a half cells before the body
 * arrives. */
#include "grid/tile_box.h"
#include "math/tensor.h"
#include "mpm/contact/contact.h"
#include "mpm/mpm_constants.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/reach.h"
#include "mpm/transfer/windows.h"

#include <math.h>
#include <string.h>

/* Directions that two bodies may be apart along, from the first to the second: of their common normal, and of the own normal of each. Where more meet,
 * and along a line, there is the first alone. */
enum { ALONG_PAIR, ALONG_FIRST, ALONG_SECOND, DIRECTIONS };

static const field_id reach_field[DIRECTIONS] = {N_REACH, N_REACH_FIRST, N_REACH_SECOND};

static int directions_of(const mpm *s)
{
    return s->mesh->dim > 1 ? DIRECTIONS : 1;
}

/* The groups of the contact at a node: how many, and the first two. What is outside the contact, such as the gas behind a skin, does not count. */
static int groups_that_meet(const mpm *s, const fields *f, ptrdiff_t at, int group[2])
{
    int n = 0;
    for (int g = 0; g < s->n_groups; ++g) {
        if (!s->contact->named[g] || !(field_get(f, N_MASS, g, 0)[at] > 0.0)) continue;
        if (n < 2) group[n] = g;
        n++;
    }
    return n;
}

/* Unit normals of a group at a node: towards the other body of the contact where there is one; zero where it is alone or
 * has none. */
static void directions_at(const mpm *s, int blk, int group, ptrdiff_t at, double out[DIRECTIONS][MESH_MAX_DIM])
{
    const fields *f = s->domain->fields[blk];
    int met[2];
    const bool meets = s->contact->named[group] && field_get(f, N_MASS, group, 0)[at] > 0.0;
    const int n = groups_that_meet(s, f, at, met), others = n - (meets ? 1 : 0);
    const double way = n == 2 && group == met[1] ? -1.0 : 1.0;
    memset(out, 0, DIRECTIONS * sizeof *out);
    for (int a = 0; a < s->mesh->dim && meets && others > 0; ++a) {
        out[ALONG_PAIR][a] = field_get(f, N_NORMAL, group, a)[at];
        if (others > 1) continue;
        out[ALONG_FIRST][a] = way * field_get(f, N_NORMAL, met[0], a)[at];
        out[ALONG_SECOND][a] = -way * field_get(f, N_NORMAL, met[1], a)[at];
        out[ALONG_PAIR][a] = out[ALONG_FIRST][a] + out[ALONG_SECOND][a];
    }
    for (int d = 0; d < DIRECTIONS; ++d) (void)vec_normalize(out[d]);
}

/* Directions at the nodes of a tile's window; false where there are none. */
static bool find_directions(const mpm *s, int blk, int group, const tile_box *t,
                            double (*out)[DIRECTIONS][MESH_MAX_DIM])
{
    const block *b = &s->mesh->block[blk];
    const int *window = s->windows->window, reach = s->windows->reach;
    bool any = false;
    int nodes[MESH_MAX_DIM] = {1, 1, 1}, first[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        nodes[a] = t->cells[a] + 1 + 2 * reach;
        first[a] = t->first[a] - reach - b->lo[a];
    }
    for (int k = 0; k < nodes[2]; ++k)
        for (int j = 0; j < nodes[1]; ++j)
            for (int i = 0; i < nodes[0]; ++i) {
                double(*d)[MESH_MAX_DIM] = out[i + window[0] * (j + window[1] * k)];
                directions_at(s, blk, group, mesh_index(b, first[0] + i, first[1] + j, first[2] + k), d);
                for (int a = 0; a < s->mesh->dim; ++a) any = any || d[ALONG_PAIR][a] != 0.0;
            }
    return any;
}

/* Half the width of the cube of a point's volume (m). */
static double half_width(const mpm *s, const point_arrays *p, size_t k)
{
    const double volume = p->volume0[k] * p->J[k];
    if (s->mesh->geometry == MESH_AXISYMMETRIC) return 0.5 * sqrt(volume / p->x[0][k]);
    return 0.5 * (s->mesh->dim == 1 ? volume : s->mesh->dim == 2 ? sqrt(volume) : cbrt(volume));
}

/* m: half the width of a point's cube, and the radius of the ball about it. A point of a membrane stands for all of it between its neighbours, and for what
 * bulges between nodes: nothing lies aside of it. */
typedef struct point_size {
    double half, ball;
} point_size;

static point_size point_size_of(const mpm *s, int body, const point_arrays *p, size_t k)
{
    const double half = half_width(s, p, k);
    return (point_size){half, s->body[body].membrane.model ? (double)INFINITY : half * sqrt((double)s->mesh->dim)};
}

/* What a point says to a node: `from` is the vector to it (m), and `out` what the node has heard so far. */
typedef void node_word(const mpm *s, const double from[3], point_size size, const double (*direction)[MESH_MAX_DIM],
                       double *out);

static void tell_reach(const mpm *s, const double from[3], point_size size, const double (*direction)[MESH_MAX_DIM],
                       double *out)
{
    const int count = directions_of(s);
    for (int c = 0; c < count; ++c) out[c] = fmax(out[c], vec_dot(from, direction[c]) + size.half);
}

/* What the points of a node say, on its line along the normal: how far they reach, and how little they lie aside of it (negative). Points aside reach less far by
 * as much as they are off the line, beyond the ball about their cube: of a round body the lowest point is no surface at a node a cell ahead, which would stop
 * it early and brake its spin. */
enum { ON_LINE, ASIDE, LINE_NUMBERS };
static const field_id line_field[LINE_NUMBERS] = {N_REACH, N_ASIDE};

static void tell_line(const mpm *s, const double from[3], point_size size, const double (*direction)[MESH_MAX_DIM],
                      double *out)
{
    (void)s;
    const double along = vec_dot(from, direction[ALONG_PAIR]);
    const double across = sqrt(fmax(0.0, vec_dot(from, from) - along * along));
    const double aside = fmax(0.0, across - size.ball);
    out[ON_LINE] = fmax(out[ON_LINE], along + size.half - aside);
    out[ASIDE] = fmax(out[ASIDE], -aside);
}

/* `count` numbers a node. */
static void tell_nodes(const mpm *s, const point_span *r, point_size size,
                       const double (*direction)[DIRECTIONS][MESH_MAX_DIM], node_word *tell, int count, double *out)
{
    const int *window = s->windows->window;
    const double *h = s->mesh->h;
    for (int z = 0; z < r->n[2]; ++z)
        for (int y = 0; y < r->n[1]; ++y)
            for (int x = 0; x < r->n[0]; ++x) {
                const int node = r->first[0] + x + window[0] * (r->first[1] + y + window[1] * (r->first[2] + z));
                const double from[3] = {r->from[0] - x * h[0], r->from[1] - y * h[1], r->from[2] - z * h[2]};
                tell(s, from, size, direction[node], out + count * node);
            }
}

static void scatter_in_contact(mpm *s, int group, int blk, int tile, node_word *tell, int count)
{
    double direction[MPM_MAX_WINDOW][DIRECTIONS][MESH_MAX_DIM] = {{{0.0}}};
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    bool *any = &s->windows->active[box.number];
    *any = s->contact->near[box.number] != 0 && find_directions(s, blk, group, &box, direction);
    if (!*any) return;
    double *out = start_reach(s, &box, count);
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start;
        if (s->body[body].group != group) continue;
        const point_arrays p = points_of(s, blk, body, false, false);
        for (size_t k = start[tile]; k < start[tile + 1]; ++k) {
            if (!contact_is_near(s, &box, &p, k)) continue;
            const point_span r = span_of_point(s, &box, &p, k);
            tell_nodes(s, &r, point_size_of(s, body, &p, k), (const double(*)[DIRECTIONS][MESH_MAX_DIM])direction, tell,
                       count, out);
        }
    }
}

static void scatter_reach(mpm *s, int group, int blk, int tile)
{
    scatter_in_contact(s, group, blk, tile, tell_reach, directions_of(s));
}

static void scatter_line(mpm *s, int group, int blk, int tile)
{
    scatter_in_contact(s, group, blk, tile, tell_line, LINE_NUMBERS);
}

/* Bodies are apart, or touch, along the direction in which their points have the largest gap (a separating axis): beside the corner of a block that slides on a
 * plane that is the plane's normal, and their common one, tilted, would hold the block back. */
static void choose_direction(const mpm *s, int blk, ptrdiff_t at)
{
    const fields *f = s->domain->fields[blk];
    int met[2], best = ALONG_PAIR;
    double unit[DIRECTIONS][MESH_MAX_DIM], gap[DIRECTIONS];
    if (groups_that_meet(s, f, at, met) != 2) return;
    for (int d = 0; d < DIRECTIONS; ++d)
        gap[d] = -(field_get(f, reach_field[d], met[0], 0)[at] + field_get(f, reach_field[d], met[1], 0)[at]);
    if (!isfinite(gap[ALONG_PAIR])) return;
    directions_at(s, blk, met[0], at, unit);
    for (int d = 1; d < DIRECTIONS; ++d) {
        const bool some = unit[d][0] != 0.0 || unit[d][1] != 0.0 || unit[d][2] != 0.0;
        const double more = best == ALONG_PAIR ? MPM_TILTED_NORMAL * s->contact->h : 0.0;
        if (some && gap[d] > gap[best] + more) best = d;
    }
    for (int k = 0; k < 2 && best != ALONG_PAIR; ++k) {
        for (int a = 0; a < s->mesh->dim; ++a)
            field_get(f, N_NORMAL, met[k], a)[at] = k == 0 ? unit[best][a] : -unit[best][a];
        field_get(f, N_REACH, met[k], 0)[at] = field_get(f, reach_field[best], met[k], 0)[at];
    }
}

/* The reach along the normal that was chosen; nodes beside the end of a body see that end. */
static void find_reach_on_lines(mpm *s)
{
    reach_to_nodes(s, scatter_line, line_field, LINE_NUMBERS);
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int g = 0; g < s->n_groups; ++g) {
            double *reach = field_get(s->domain->fields[b], N_REACH, g, 0);
            const double *aside = field_get(s->domain->fields[b], N_ASIDE, g, 0);
#pragma omp parallel for schedule(static)
            for (size_t k = 0; k < s->mesh->block[b].size; ++k)
                if (isfinite(aside[k])) reach[k] -= aside[k];
        }
}

floe_status mpm_contact_reach(mpm *s)
{
    const int count = directions_of(s);
    reach_to_nodes(s, scatter_reach, reach_field, count);
    if (count == 1) return FLOE_OK;
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(static)
        for (size_t k = 0; k < s->mesh->block[b].size; ++k) choose_direction(s, b, (ptrdiff_t)k);
    }
    find_reach_on_lines(s);
    return FLOE_OK;
}
