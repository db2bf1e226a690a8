#include "grid/mesh.h"

#include <math.h>
#include <string.h>

static const char axis_name[MESH_MAX_DIM] = {'x', 'y', 'z'};

static int divide_up(int a, int b)
{
    return (a + b - 1) / b;
}

static floe_status check_axis(context *ctx, const mesh_spec *spec, int axis, int *cells)
{
    const double lower = spec->lower[axis], upper = spec->upper[axis], h = spec->cell[axis];
    if (!(h > 0.0) || !isfinite(h))
        return fail_key(ctx, KEY("domain", "cell"), "%g m along %c: must be a finite number > 0", h, axis_name[axis]);
    if (!(upper > lower) || !isfinite(lower) || !isfinite(upper))
        return fail_key(ctx, KEY("domain", "upper"),
                        "the domain along %c runs from %g to %g m; upper must lie above lower", axis_name[axis], lower,
                        upper);
    const double ratio = (upper - lower) / h, nearest = round(ratio);
    if (ratio > 1e9)
        return fail_key(ctx, KEY("domain", "cell"),
                        "%g m: %.3g cells along %c are more than floe can number (1e9); use a larger cell", h, ratio,
                        axis_name[axis]);
    if (nearest < 1.0 || !(fabs(ratio - nearest) <= 1e-9 * fmax(1.0, ratio)))
        return fail_key(ctx, KEY("domain", "cell"),
                        "the extent along %c, %.12g m, is %.12g cells of %.12g m, not a whole number; "
                        "use a cell of %.12g m or an upper end of %.12g m",
                        axis_name[axis], upper - lower, ratio, h, (upper - lower) / fmax(1.0, nearest),
                        lower + fmax(1.0, nearest) * h);
    *cells = (int)nearest;
    return FLOE_OK;
}

static floe_status check_spec(context *ctx, const mesh_spec *spec)
{
    if (spec->dim < 1 || spec->dim > MESH_MAX_DIM)
        return fail_key(ctx, KEY("domain", "dim"), "%d: must be 1, 2 or 3", spec->dim);
    if (spec->geometry == MESH_AXISYMMETRIC && spec->dim != 2)
        return fail_key(ctx, KEY("domain", "geometry"), "an axisymmetric domain has dim 2 (r, z), not %d", spec->dim);
    if (spec->geometry == MESH_AXISYMMETRIC && spec->lower[0] < 0.0)
        return fail_key(ctx, KEY("domain", "lower"), "an axisymmetric domain cannot begin at r = %g m; use 0 or more",
                        spec->lower[0]);
    return FLOE_OK;
}

/* The first tile of block number b of `blocks` along an axis of `tiles`: as even as whole tiles allow. */
static int first_tile(int tiles, int blocks, int b)
{
    return (int)((long long)tiles * b / blocks);
}

static void init_block(const mesh *m, const int coordinate[MESH_MAX_DIM], block *b)
{
    b->dim = m->dim;
    b->n_tiles = 1;
    ptrdiff_t stride = 1;
    b->origin = 0;
    b->size = 1;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        const int t0 = first_tile(m->tiles[a], m->blocks[a], coordinate[a]);
        const int t1 = first_tile(m->tiles[a], m->blocks[a], coordinate[a] + 1);
        const int end = t1 * m->tile[a] < m->n[a] ? t1 * m->tile[a] : m->n[a];
        b->tile_lo[a] = t0;
        b->tiles[a] = t1 - t0;
        b->n_tiles *= t1 - t0;
        b->lo[a] = t0 * m->tile[a];
        b->n[a] = end - b->lo[a];
        b->at_side[a][SIDE_LOWER] = b->lo[a] == 0;
        b->at_side[a][SIDE_UPPER] = end == m->n[a];
        if (a >= m->dim) continue;
        const size_t padded = (size_t)b->n[a] + 2 * MESH_GHOST + 1;
        b->stride[a] = stride;
        b->origin += MESH_GHOST * stride;
        stride *= (ptrdiff_t)padded;
        b->size *= padded;
    }
}

static void init_blocks(mesh *m)
{
    m->n_blocks = 0;
    for (int z = 0; z < m->blocks[2]; ++z)
        for (int y = 0; y < m->blocks[1]; ++y)
            for (int x = 0; x < m->blocks[0]; ++x) {
                block *b = &m->block[m->n_blocks];
                b->id = m->n_blocks++;
                init_block(m, (const int[]){x, y, z}, b);
            }
}

/* Ghosts reach two cells into the neighbour, so a block must be wider than that; so must a periodic domain. */
static floe_status check_blocks(const mesh *m)
{
    for (int a = 0; a < m->dim; ++a) {
        if (m->periodic[a] && m->n[a] < 4)
            return fail_key(m->ctx, KEY("domain", "cell"), "a periodic axis needs at least 4 cells; %c has %d",
                            axis_name[a], m->n[a]);
        const int last = m->n[a] - (m->tiles[a] - 1) * m->tile[a];
        if (m->blocks[a] == m->tiles[a] && m->blocks[a] > 1 && last < 4)
            return fail_key(m->ctx, KEY("domain", "blocks"),
                            "the last of %d blocks along %c would have %d cells; use fewer blocks", m->blocks[a],
                            axis_name[a], last);
    }
    return FLOE_OK;
}

floe_status mesh_init(mesh *out, context *ctx, const mesh_spec *spec)
{
    memset(out, 0, sizeof *out);
    TRY(check_spec(ctx, spec));
    out->ctx = ctx;
    out->dim = spec->dim;
    out->geometry = spec->geometry;
    long long n_blocks = 1;
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        const bool used = a < spec->dim;
        out->n[a] = 1;
        out->h[a] = 1.0;
        out->tile[a] = used ? mesh_tile_width(spec->dim) : 1;
        if (used) {
            TRY(check_axis(ctx, spec, a, &out->n[a]));
            out->lower[a] = spec->lower[a];
            out->upper[a] = spec->upper[a];
            /* From the extent, not from the cell asked for, so that the last node is the upper wall to round-off. */
            out->h[a] = (spec->upper[a] - spec->lower[a]) / out->n[a];
            out->periodic[a] = spec->periodic[a];
        }
        out->tiles[a] = divide_up(out->n[a], out->tile[a]);
        out->blocks[a] = used && spec->blocks[a] > 1 ? spec->blocks[a] : 1;
        if (out->blocks[a] > out->tiles[a])
            return fail_key(ctx, KEY("domain", "blocks"),
                            "%d blocks along %c are more than its %d tiles of %d cells; use at most %d", out->blocks[a],
                            axis_name[a], out->tiles[a], out->tile[a], out->tiles[a]);
        n_blocks *= out->blocks[a];
    }
    TRY(check_blocks(out));
    if (n_blocks > MESH_MAX_BLOCKS)
        return fail_key(ctx, KEY("domain", "blocks"), "%lld blocks are more than the %d that floe holds; use fewer",
                        n_blocks, MESH_MAX_BLOCKS);
    init_blocks(out);
    return FLOE_OK;
}

double mesh_box_volume(const mesh *m)
{
    double volume = 1.0;
    for (int a = 0; a < m->dim; ++a) volume *= m->h[a];
    return volume;
}

double mesh_cell_volume(const mesh *m, int i)
{
    return m->geometry == MESH_AXISYMMETRIC ? mesh_box_volume(m) * mesh_centre(m, 0, i) : mesh_box_volume(m);
}

double mesh_face_area(const mesh *m, int axis, int i)
{
    double area = 1.0;
    for (int a = 0; a < m->dim; ++a)
        if (a != axis) area *= m->h[a];
    if (m->geometry != MESH_AXISYMMETRIC) return area;
    return area * (axis == 0 ? mesh_node(m, 0, i) : mesh_centre(m, 0, i));
}

const char *mesh_axis_name(mesh_geometry geometry, int axis)
{
    static const char *const name[2][MESH_MAX_DIM] = {{"x", "y", "z"}, {"r", "z", NULL}};
    return axis < MESH_MAX_DIM ? name[geometry == MESH_AXISYMMETRIC][axis] : NULL;
}

int mesh_cell_of(const mesh *m, int axis, double x)
{
    const double scaled = (x - m->lower[axis]) / m->h[axis];
    /* Far outside (or NaN) is still outside, without undefined conversion. */
    if (!(scaled >= -1.0)) return -1;
    if (!(scaled <= m->n[axis] + 1.0)) return m->n[axis] + 1;
    const int cell = (int)floor(scaled);
    return x <= m->upper[axis] && cell >= m->n[axis] ? m->n[axis] - 1 : cell;
}

int mesh_tile_of(const mesh *m, const int cell[MESH_MAX_DIM])
{
    const int x = cell[0] / m->tile[0], y = cell[1] / m->tile[1], z = cell[2] / m->tile[2];
    return x + m->tiles[0] * (y + m->tiles[1] * z);
}

int mesh_block_of(const mesh *m, const int cell[MESH_MAX_DIM])
{
    int coordinate[MESH_MAX_DIM];
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        const int tile = cell[a] / m->tile[a];
        int b = (int)((long long)tile * m->blocks[a] / m->tiles[a]);
        while (b > 0 && first_tile(m->tiles[a], m->blocks[a], b) > tile) --b;
        while (b < m->blocks[a] - 1 && first_tile(m->tiles[a], m->blocks[a], b + 1) <= tile) ++b;
        coordinate[a] = b;
    }
    return coordinate[0] + m->blocks[0] * (coordinate[1] + m->blocks[1] * coordinate[2]);
}

size_t mesh_cells(const mesh *m)
{
    return (size_t)m->n[0] * (size_t)m->n[1] * (size_t)m->n[2];
}

size_t mesh_tiles(const mesh *m)
{
    return (size_t)m->tiles[0] * (size_t)m->tiles[1] * (size_t)m->tiles[2];
}
