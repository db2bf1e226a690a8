/* Extent of bodies at the nodes where they meet. It is determined from the points, since a node has mass of a body up to one and a half cells before the body
 * arrives. */
#include "grid/tile_box.h"
#include "mpm/contact/contact.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/reach.h"
#include "mpm/transfer/windows.h"

#include <math.h>

/* Unit normal of a group at a node: towards the other body of the contact where there is one; zero where it is alone or
 * has none. What is outside the contact, such as the gas behind a skin, does not count. */
static void direction_at(const mpm *s, int blk, int group, ptrdiff_t at, double out[MESH_MAX_DIM])
{
    const fields *f = s->domain->fields[blk];
    int others = 0, other = group;
    double length = 0.0;
    for (int g = 0; g < s->n_groups; ++g) {
        if (g == group || !s->contact->named[g] || !(field_get(f, N_MASS, g, 0)[at] > 0.0)) continue;
        others++;
        other = g;
    }
    const bool meets = others > 0 && field_get(f, N_MASS, group, 0)[at] > 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) {
        out[a] = meets ? field_get(f, N_NORMAL, group, a)[at] : 0.0;
        if (meets && others == 1) out[a] -= field_get(f, N_NORMAL, other, a)[at];
        length += out[a] * out[a];
    }
    for (int a = 0; a < s->mesh->dim && length > 0.0; ++a) out[a] /= sqrt(length);
}

/* Directions at the nodes of a tile's window; false where there are none. */
static bool find_directions(const mpm *s, int blk, int group, const tile_box *t, double (*out)[MESH_MAX_DIM])
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
                double *d = out[i + window[0] * (j + window[1] * k)];
                direction_at(s, blk, group, mesh_index(b, first[0] + i, first[1] + j, first[2] + k), d);
                for (int a = 0; a < s->mesh->dim; ++a) any = any || d[a] != 0.0;
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

static void scatter_reach_of_point(const mpm *s, const point_span *r, double half,
                                   const double (*direction)[MESH_MAX_DIM], double *out)
{
    const int *window = s->windows->window;
    const double *h = s->mesh->h;
    for (int z = 0; z < r->n[2]; ++z)
        for (int y = 0; y < r->n[1]; ++y)
            for (int x = 0; x < r->n[0]; ++x) {
                const int node = r->first[0] + x + window[0] * (r->first[1] + y + window[1] * (r->first[2] + z));
                const double *d = direction[node];
                const double along =
                    (r->from[0] - x * h[0]) * d[0] + (r->from[1] - y * h[1]) * d[1] + (r->from[2] - z * h[2]) * d[2];
                out[node] = fmax(out[node], along + half);
            }
}

static void scatter_reach_in_contact(mpm *s, int group, int blk, int tile)
{
    double direction[MPM_MAX_WINDOW][MESH_MAX_DIM] = {{0.0}};
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    bool *any = &s->windows->active[box.number];
    *any = s->contact->near[box.number] != 0 && find_directions(s, blk, group, &box, direction);
    if (!*any) return;
    double *out = start_reach(s, &box, 1);
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start;
        if (s->body[body].group != group) continue;
        const point_arrays p = points_of(s, blk, body, false, false);
        for (size_t k = start[tile]; k < start[tile + 1]; ++k) {
            if (!contact_is_near(s, &box, &p, k)) continue;
            const point_span r = span_of_point(s, &box, &p, k);
            scatter_reach_of_point(s, &r, half_width(s, &p, k), (const double(*)[MESH_MAX_DIM])direction, out);
        }
    }
}

floe_status mpm_contact_reach(mpm *s)
{
    reach_to_nodes(s, scatter_reach_in_contact, (const field_id[]){N_REACH}, 1);
    return FLOE_OK;
}
