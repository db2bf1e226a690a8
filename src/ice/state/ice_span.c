/* Where a material is. Most cells of most scenes hold one material, and of the others every velocity, fraction and flux
 * there is zero: kernels over one material's faces leave out what is more than two cells from it in any direction, as
 * far as gradients see. */
#include "ice/state/ice_state.h"
#include "ice/state/ice_storage.h"

static size_t count_rows(const block *b)
{
    return (size_t)ice_rows_of(b, -1, MESH_GHOST).n;
}

void ice_find_span(const ice *s, const block *b, int r, int j, int k, const double *rho)
{
    const ptrdiff_t row = mesh_index(b, 0, j, k);
    int first = -MESH_GHOST, end = b->n[0] + MESH_GHOST;
    if (!s->storage->span[b->id]) return;
    while (first < end && !(rho[row + first] > 0.0)) ++first;
    while (end > first && !(rho[row + end - 1] > 0.0)) --end;
    s->storage->span[b->id][(size_t)r * count_rows(b) + (size_t)ice_row_number(b, j, k)] = (ice_span){first, end};
}

/* Rows about j along an axis, [lo, hi), that the block has. */
static void rows_about(const block *b, int axis, int j, int *lo, int *hi)
{
    const int ghost = axis < b->dim ? MESH_GHOST : 0, reach = axis < b->dim ? 2 : 0;
    *lo = j - reach > -ghost ? j - reach : -ghost;
    *hi = j + reach + 1 < b->n[axis] + ghost ? j + reach + 1 : b->n[axis] + ghost;
}

static ice_span widened_span(const block *b, const ice_span *span, int j, int k)
{
    int j0, j1, k0, k1;
    ice_span all = {b->n[0] + MESH_GHOST, -MESH_GHOST};
    rows_about(b, 1, j, &j0, &j1);
    rows_about(b, 2, k, &k0, &k1);
    for (int l = k0; l < k1; ++l)
        for (int m = j0; m < j1; ++m) {
            const ice_span s = span[ice_row_number(b, m, l)];
            if (s.end <= s.first) continue;
            if (s.first - 2 < all.first) all.first = s.first - 2;
            if (s.end + 2 > all.end) all.end = s.end + 2;
        }
    return all;
}

void ice_widen_spans(const ice *s, const ice_region *g, int block_id)
{
    const block *b = &s->mesh->block[block_id];
    const ice_rows q = ice_rows_of(b, -1, MESH_GHOST);
    if (!s->storage->near[block_id]) return;
    for (int r = g->first; r < g->first + g->n; ++r) {
        const ice_span *span = s->storage->span[block_id] + (size_t)r * count_rows(b);
        ice_span *near = s->storage->near[block_id] + (size_t)r * count_rows(b);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row) {
            const int j = ice_row_j(q, row), k = ice_row_k(q, row);
            near[ice_row_number(b, j, k)] = widened_span(b, span, j, k);
        }
    }
}
