#include "mpm/spread.h"

#include "mpm/locate.h"
#include "mpm/wall.h"

#include <string.h>

void spread_numbers(const mpm *s, const tile_box *t, const point_arrays *p, size_t k, const double *number, int count,
                    double *window)
{
    const int dim = s->mesh->dim;
    const basis_kind kind = s->basis->kind;
    const tile_frame frame = frame_of(s->mesh, t, dim);
    stencils at;
    locate(&at, s->mesh, &frame, p, k, 1, dim, kind);
    FOR_PIECES(j, 0, dim, kind)
    FOR_ROWS(at, j, dim, kind, {
        for (int x = 0; x < basis_support(kind); ++x) {
            double *node = window + count * (ptrdiff_t)(row + x);
            for (int c = 0; c < count; ++c) node[c] += W * at.w[0][x][j] * number[c];
        }
    });
}

void gather_numbers(mpm *s, int group, const field_id *id, int count)
{
    domain_share_partials(s->domain);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        node_target to = {.reach = s->work->reach};
        for (int k = 0; k < count; ++k)
            for (int c = 0; c < field_component_count(field_describe(id[k])->components, s->mesh->dim); ++c)
                to.array[to.components++] = field_get(s->domain->fields[b], id[k], group, c);
        memcpy(to.window, s->work->window, sizeof to.window);
        gather_nodes(s, b, &to);
    }
    for (int c = 0; c < count; ++c) {
        domain_fold_periodic(s->domain, id[c], group);
        if (s->work->reach > 0) fold_numbers(s, group, id[c]);
    }
}
