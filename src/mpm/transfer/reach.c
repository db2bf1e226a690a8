#include "mpm/transfer/reach.h"

#include "grid/tile_box.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/windows.h"

#include <math.h>
#include <string.h>

point_span span_of_point(const mpm *s, const tile_box *t, const point_arrays *p, size_t k)
{
    const mesh *m = s->mesh;
    point_span r = {{0, 0, 0}, {1, 1, 1}, {0.0, 0.0, 0.0}};
    for (int a = 0; a < m->dim; ++a) {
        const double inv_h = 1.0 / m->h[a], at = (p->x[a][k] - m->lower[a]) * inv_h - t->first[a];
        double w[BASIS_MAX_SUPPORT], dw[BASIS_MAX_SUPPORT];
        int cell = (int)at;
        cell = cell < 0 ? 0 : cell >= t->cells[a] ? t->cells[a] - 1 : cell;
        const int node = cell + s->basis->weights(at - cell, p->half[a] ? p->half[a][k] * inv_h : 0.5, inv_h, w, dw);
        r.first[a] = node + s->windows->reach;
        r.n[a] = s->basis->support;
        r.from[a] = (at - node) * m->h[a];
    }
    return r;
}

double *start_reach(const mpm *s, const tile_box *t, int count)
{
    double *out = domain_tile(s->domain, t->number);
    for (int k = 0; k < s->windows->window_nodes * count; ++k) out[k] = -INFINITY;
    return out;
}

void reach_to_nodes(mpm *s, tile_visitor *scatter, const field_id *id, int count)
{
    for (int g = 0; g < s->n_groups; ++g) {
        visit_tiles(s, g, scatter);
        domain_share_partials(s->domain);
        for (int b = 0; b < s->mesh->n_blocks; ++b) {
            node_target to = node_target_of(s, b, g, id, count);
            to.largest = true;
            gather_nodes(s, b, &to);
        }
        for (int c = 0; c < count; ++c) domain_fold_periodic_largest(s->domain, id[c], g);
    }
}
