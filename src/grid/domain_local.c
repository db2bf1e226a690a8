/* The domain of one process: every block is at hand, so that an exchange is a copy. */
#include "base/memory.h"
#include "grid/domain.h"

#include <math.h>
#include <string.h>

floe_status domain_create(domain **out, context *ctx, const mesh *m)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    domain *d = *out;
    d->ctx = ctx;
    d->mesh = m;
    for (int b = 0; b < m->n_blocks; ++b) {
        const floe_status status = fields_create(&d->fields[b], ctx, &m->block[b]);
        if (status != FLOE_OK) {
            domain_destroy(out);
            return status;
        }
    }
    return FLOE_OK;
}

void domain_destroy(domain **d)
{
    if (!d || !*d) return;
    for (int b = 0; b < MESH_MAX_BLOCKS; ++b) fields_destroy(&(*d)->fields[b]);
    memory_free((*d)->ctx, &(*d)->partials);
    memory_free((*d)->ctx, d);
}

floe_status domain_add(domain *d, field_id id, int instance)
{
    for (int b = 0; b < d->mesh->n_blocks; ++b) TRY(fields_add(d->fields[b], id, instance));
    return FLOE_OK;
}

static int max_int(int a, int b)
{
    return a > b ? a : b;
}
static int min_int(int a, int b)
{
    return a < b ? a : b;
}

/* Copies cells [lo, hi) (global, in the source's numbering) of `from` to `to`, whose numbering is shifted by
 * `shift`. */
static void copy_box(const mesh *m, const block *from, const double *source, const block *to, double *target,
                     const int lo[MESH_MAX_DIM], const int hi[MESH_MAX_DIM], const int shift[MESH_MAX_DIM])
{
    const size_t row = (size_t)(hi[0] - lo[0]) * sizeof(double);
    (void)m;
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j) {
            const ptrdiff_t s = mesh_index(from, lo[0] - from->lo[0], j - from->lo[1], k - from->lo[2]);
            const ptrdiff_t t =
                mesh_index(to, lo[0] + shift[0] - to->lo[0], j + shift[1] - to->lo[1], k + shift[2] - to->lo[2]);
            memcpy(target + t, source + s, row);
        }
}

/* Copies what the shifted block `from` owns into the ghosts of `to`. */
static void fill_from(const mesh *m, const block *from, const block *to, const int shift[MESH_MAX_DIM],
                      const double *source, double *target)
{
    int lo[MESH_MAX_DIM], hi[MESH_MAX_DIM];
    bool inside = true;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        const int ghost = a < m->dim ? MESH_GHOST : 0;
        lo[a] = max_int(from->lo[a], to->lo[a] - ghost - shift[a]);
        hi[a] = min_int(from->lo[a] + from->n[a], to->lo[a] + to->n[a] + ghost - shift[a]);
        if (lo[a] >= hi[a]) return;
        inside = inside && shift[a] == 0;
    }
    if (inside && from == to) return; /* a block's own cells are no ghosts of it */
    copy_box(m, from, source, to, target, lo, hi, shift);
}

static void fill_component(const domain *d, field_id id, int instance, fill_which which, int comp)
{
    const mesh *m = d->mesh;
    double *(*get)(const fields *, field_id, int, int) = which == FILL_NEXT ? field_next : field_get;
    int reach[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a)
        reach[a] = m->periodic[a] ? (MESH_GHOST + m->n[a] - 1) / m->n[a] : 0; /* images that ghosts see */
    for (int t = 0; t < m->n_blocks; ++t)
        for (int s = 0; s < m->n_blocks; ++s)
            for (int z = -reach[2]; z <= reach[2]; ++z)
                for (int y = -reach[1]; y <= reach[1]; ++y)
                    for (int x = -reach[0]; x <= reach[0]; ++x)
                        fill_from(m, &m->block[s], &m->block[t], (const int[]){x * m->n[0], y * m->n[1], z * m->n[2]},
                                  get(d->fields[s], id, instance, comp), get(d->fields[t], id, instance, comp));
}

void domain_fill(domain *d, field_id id, int instance, fill_which which)
{
    if (d->mesh->n_blocks == 1 && !d->mesh->periodic[0] && !d->mesh->periodic[1] && !d->mesh->periodic[2]) return;
    const int components = field_component_count(field_describe(id)->components, d->mesh->dim);
    for (int c = 0; c < components; ++c) fill_component(d, id, instance, which, c);
}

void domain_sum_tiles(const mesh *m, const double *partial, int count, double *sum)
{
    const size_t tiles = mesh_tiles(m);
    for (int c = 0; c < count; ++c) sum[c] = 0.0;
    for (size_t t = 0; t < tiles; ++t)
        for (int c = 0; c < count; ++c) sum[c] += partial[t * (size_t)count + (size_t)c];
}

floe_status domain_reserve_partials(domain *d, size_t size)
{
    const mesh *m = d->mesh;
    const size_t tiles = mesh_tiles(m);
    d->partial_size = size;
    return memory_new(d->ctx, &d->partials, tiles * size, sizeof(double));
}

double *domain_tile(const domain *d, int tile)
{
    return d->partials + (size_t)tile * d->partial_size;
}

void domain_share_partials(domain *d)
{
    (void)d; /* one process: every tile is at hand */
}

/* Joins the three pairs of images of one row of nodes along a periodic axis of n cells (n of the upper block). */
static void fold_row(double *low, double *high, ptrdiff_t stride, int n, bool largest)
{
    for (int image = -1; image <= 1; ++image) {
        double *a = low + image * stride, *b = high + (n + image) * stride;
        const double both = largest ? fmax(*a, *b) : *a + *b;
        *a = both;
        *b = both;
    }
}

static void fold_pair(const block *low, const block *high, int axis, double *a, double *b, bool largest)
{
    int lo[MESH_MAX_DIM] = {0, 0, 0}, hi[MESH_MAX_DIM] = {1, 1, 1};
    for (int d = 0; d < low->dim; ++d) {
        lo[d] = d == axis ? 0 : -1;
        hi[d] = d == axis ? 1 : low->n[d] + 2;
    }
    for (int k = lo[2]; k < hi[2]; ++k)
        for (int j = lo[1]; j < hi[1]; ++j)
            for (int i = lo[0]; i < hi[0]; ++i)
                fold_row(a + mesh_index(low, i, j, k), b + mesh_index(high, i, j, k), low->stride[axis], high->n[axis],
                         largest);
}

/* The block at the upper end of the domain in the same row of blocks as `low`. */
static int opposite_block(const mesh *m, const block *low, int axis)
{
    int cell[MESH_MAX_DIM] = {low->lo[0], low->lo[1], low->lo[2]};
    cell[axis] = m->n[axis] - 1;
    return mesh_block_of(m, cell);
}

static void fold_periodic(domain *d, field_id id, int instance, bool largest)
{
    const mesh *m = d->mesh;
    const int components = field_component_count(field_describe(id)->components, m->dim);
    for (int axis = 0; axis < m->dim; ++axis) {
        if (!m->periodic[axis]) continue;
        for (int b = 0; b < m->n_blocks; ++b) {
            if (!m->block[b].at_side[axis][SIDE_LOWER]) continue;
            const int other = opposite_block(m, &m->block[b], axis);
            for (int c = 0; c < components; ++c)
                fold_pair(&m->block[b], &m->block[other], axis, field_get(d->fields[b], id, instance, c),
                          field_get(d->fields[other], id, instance, c), largest);
        }
    }
}

void domain_fold_periodic(domain *d, field_id id, int instance)
{
    fold_periodic(d, id, instance, false);
}

void domain_fold_periodic_largest(domain *d, field_id id, int instance)
{
    fold_periodic(d, id, instance, true);
}
