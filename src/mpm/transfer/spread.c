#include "mpm/transfer/spread.h"

#include "grid/tile_box.h"
#include "mpm/nodes/ghosts.h"
#include "mpm/transfer/locate.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/windows.h"

void spread_numbers(const mpm *s, const tile_box *t, const point_arrays *p, size_t k, const double *number, int count,
                    double *window)
{
    const int dim = s->mesh->dim;
    const int basis = basis_number(s->basis);
    const tile_frame frame = frame_of(s->mesh, t, dim);
    stencils at;
    locate(&at, s->mesh, &frame, p, k, 1, dim, basis);
    FOR_PIECES(j, 0, dim, basis)
    FOR_ROWS(at, j, dim, basis, {
        for (int x = 0; x < basis_support(basis); ++x) {
            double *node = window + count * (ptrdiff_t)(row + x);
            for (int c = 0; c < count; ++c) node[c] += W * at.w[0][x][j] * number[c];
        }
    });
}

void gather_unfolded(mpm *s, int group, const field_id *id, int count)
{
    domain_share_partials(s->domain);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const node_target to = node_target_of(s, b, group, id, count);
        gather_nodes(s, b, &to);
    }
    for (int c = 0; c < count; ++c) domain_fold_periodic(s->domain, id[c], group);
}

void gather_numbers(mpm *s, int group, const field_id *id, int count)
{
    gather_unfolded(s, group, id, count);
    for (int c = 0; c < count && s->windows->reach > 0; ++c) fold_numbers(s, group, id[c]);
}
