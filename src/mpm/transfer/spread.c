#include "mpm/transfer/spread.h"

#include "mpm/nodes/ghosts.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/windows.h"

void spread_numbers(const mpm *s, const tile_box *t, const point_arrays *p, size_t k, const double *number, int count,
                    double *window)
{
    s->windows->kernel->spread(s->mesh, t, p, k, k + 1, number, count, window);
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
