#include "mpm/spread.h"

#include <string.h>

tile_weights weights_at(const mpm *s, const tile_box *t, const point_arrays *p, size_t k)
{
    tile_weights at = {.w = {{1.0}, {1.0}, {1.0}}, .n = {1, 1, 1}};
    double slope[BASIS_MAX_SUPPORT];
    int row = 1;
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double inv_h = 1.0 / s->mesh->h[a], x = (p->x[a][k] - s->mesh->lower[a]) * inv_h - t->first[a];
        int cell = (int)x;
        cell = cell < 0 ? 0 : cell >= t->cells[a] ? t->cells[a] - 1 : cell;
        const double half = p->half[a] ? p->half[a][k] * inv_h : 0.5;
        at.first += row * (cell + s->work->basis_1d(x - cell, half, inv_h, at.w[a], slope) + s->work->reach);
        at.n[a] = s->basis->support;
        row *= s->work->window[a];
    }
    return at;
}

void spread_numbers(const mpm *s, const tile_weights *at, const double *number, int count, double *window)
{
    const int *size = s->work->window;
    for (int z = 0; z < at->n[2]; ++z)
        for (int y = 0; y < at->n[1]; ++y)
            for (int x = 0; x < at->n[0]; ++x) {
                const double w = at->w[0][x] * at->w[1][y] * at->w[2][z];
                double *node = window + count * (ptrdiff_t)(at->first + x + size[0] * (y + size[1] * z));
                for (int c = 0; c < count; ++c) node[c] += w * number[c];
            }
}

void gather_numbers(mpm *s, int group, const field_id *id, int count)
{
    domain_share_partials(s->domain);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        node_target to = {.components = count, .reach = s->work->reach};
        for (int c = 0; c < count; ++c) to.array[c] = field_get(s->domain->fields[b], id[c], group, 0);
        memcpy(to.window, s->work->window, sizeof to.window);
        gather_nodes(s, b, &to);
    }
    for (int c = 0; c < count; ++c) {
        domain_fold_periodic(s->domain, id[c], group);
        if (s->work->reach > 0) fold_field(s, group, id[c]);
    }
}
