/* The filter of XPIC (Hammerquist and Nairn 2017): of the velocities V of the points, the part
 *     [I - (I - S S+)^m] V = S sum_r (-1)^(r+1) C(m, r) u_r,   u_1 = S+ V,   u_r = S+ S u_(r-1),
 * which m projections on the nodes and back retain; the rest is invisible to the mesh. */
#include "mpm/nodes/ghosts.h"
#include "mpm/nodes/node.h"
#include "mpm/nodes/wall.h"
#include "mpm/transfer/scatter.h"

#include <string.h>

/* One round: the nodes' means of what they would give the points. */
static floe_status project_again(mpm *s)
{
    TRY(sample_velocities(s, N_VEL));
    for (int g = 0; g < s->n_deforming_groups; ++g) TRY(scatter_group(s, g, SCATTER_MOMENTUM, false, true));
    return FLOE_OK;
}

/* What walls and mirrors change of the momentum in a round is in that one's u and in all later ones': `undamped` of it
 * stays with the points. */
static void set_node_velocities(mpm *s, double undamped)
{
    for (int g = 0; g < s->n_deforming_groups; ++g) {
        divide_momenta(s, g, N_VEL);
        enter_mirrored_momenta(s, g, undamped);
        impose_walls(s, g, N_VEL, undamped);
        extend_to_ghosts(s, g, N_VEL);
    }
}

/* filtered += factor v, or = where `first`. */
static void add_filtered_share(const mpm *s, int blk, int group, double factor, bool first)
{
    const fields *f = s->domain->fields[blk];
    const size_t n = s->mesh->block[blk].size;
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double *restrict v = field_get(f, N_VEL, group, a);
        double *restrict sum = field_get(f, N_VEL_FILTERED, group, a);
#pragma omp parallel for simd schedule(static)
        for (size_t k = 0; k < n; ++k) sum[k] = (first ? 0.0 : sum[k]) + factor * v[k];
    }
}

floe_status mpm_filter_velocities(mpm *s)
{
    const int order = s->order;
    double factor = order; /* (-1)^(r+1) C(m, r) */
    double undamped = 1.0; /* the sum of this factor and all later ones */
    for (int r = 1; r <= order; ++r) {
        if (r > 1) TRY(project_again(s));
        set_node_velocities(s, undamped);
        undamped -= factor;
        for (int g = 0; g < s->n_deforming_groups; ++g)
            for (int b = 0; b < s->mesh->n_blocks; ++b) add_filtered_share(s, b, g, factor, r == 1);
        factor *= -(double)(order - r) / (r + 1);
    }
    return sample_velocities(s, N_VEL_FILTERED);
}
