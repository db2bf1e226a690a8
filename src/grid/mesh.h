/* The mesh: one uniform rectilinear grid of cells that both solvers share, cut into tiles and blocks.
 *
 * Tiles are the unit of every sum: a tile is a fixed box of cells keyed to the global cell index, so that a sum
 * taken within tiles and then over tiles in order has the same bits for any blocks and threads (docs/structure.md, Tiles).
 * Blocks are boxes of whole tiles; each owns its fields. */
#ifndef GRID_MESH_H
#define GRID_MESH_H

#include "base/context.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    MESH_MAX_DIM = 3,
    MESH_GHOST = 3, /* ghost layers of cells, nodes and faces on each side of a used axis */
    MESH_MAX_BLOCKS = 64
};

typedef enum mesh_geometry {
    MESH_CARTESIAN,
    MESH_AXISYMMETRIC /* (r, z), r first; per radian inside (design, conventions) */
} mesh_geometry;

typedef enum mesh_side { SIDE_LOWER = 0, SIDE_UPPER = 1 } mesh_side;

/* Cells of a tile along each used axis: about 64 cells, so that a tile's node partials stay in the first cache. */
static inline int mesh_tile_width(int dim)
{
    return dim == 1 ? 64 : dim == 2 ? 8 : 4;
}

/* What a user asks for. */
typedef struct mesh_spec {
    int dim;                    /* 1, 2 or 3 */
    mesh_geometry geometry;     /* MESH_AXISYMMETRIC only with dim 2 and lower[0] >= 0 */
    double lower[MESH_MAX_DIM]; /* m, corner of the domain */
    double upper[MESH_MAX_DIM]; /* m, upper - lower is a whole multiple of cell to 1e-9, or is refused */
    double cell[MESH_MAX_DIM];  /* m, h per axis, > 0 */
    bool periodic[MESH_MAX_DIM];
    int blocks[MESH_MAX_DIM]; /* blocks along each axis, >= 1; 0 means 1 */
} mesh_spec;

/* A block: cells [lo, lo + n) of the global index range.
 * One index space serves cells, faces and nodes: cell (i,j,k), its lower face along each axis and its lower node
 * all have the linear index mesh_index(block, i, j, k); so arrays of every centring have `size` entries.
 * i, j, k are local (0 is the first owned cell) and run from -MESH_GHOST to n + MESH_GHOST (nodes, upper faces). */
typedef struct block {
    int id; /* position in mesh.block */
    int dim;
    int lo[MESH_MAX_DIM];           /* global index of the first owned cell */
    int n[MESH_MAX_DIM];            /* owned cells along each axis; 1 along unused axes */
    ptrdiff_t stride[MESH_MAX_DIM]; /* of the linear index; 0 along unused axes */
    ptrdiff_t origin;               /* linear index of local cell (0,0,0) */
    size_t size;                    /* entries of an array */
    bool at_side[MESH_MAX_DIM][2];  /* the block touches the domain's side */
    int tile_lo[MESH_MAX_DIM];      /* global tile coordinates of the first owned tile */
    int tiles[MESH_MAX_DIM];        /* owned tiles along each axis */
    int n_tiles;                    /* their product */
} block;

typedef struct mesh {
    context *ctx; /* not owned */
    int dim;
    mesh_geometry geometry;
    double lower[MESH_MAX_DIM], upper[MESH_MAX_DIM]; /* m */
    double h[MESH_MAX_DIM];                          /* m, 1 along unused axes */
    bool periodic[MESH_MAX_DIM];
    int n[MESH_MAX_DIM];    /* cells of the whole mesh, 1 along unused axes */
    int tile[MESH_MAX_DIM]; /* cells of a tile along each axis (mesh_tile_width; 1 unused); the last may be cut short */
    int tiles[MESH_MAX_DIM]; /* tiles of the whole mesh */
    int blocks[MESH_MAX_DIM];
    int n_blocks;
    block block[MESH_MAX_BLOCKS];
} mesh;

/* Checks the spec and fills *out; FLOE_BAD_INPUT says what is wrong and the nearest spec that works. No memory is
 * owned. */
floe_status mesh_init(mesh *out, context *ctx, const mesh_spec *spec);

/* "x", "y", "z", or "r" and "z" about an axis, as decks name the axes; NULL: there is no such axis. */
const char *mesh_axis_name(mesh_geometry geometry, int axis);

/* Linear index of local (i, j, k); unused axes have stride 0. */
static inline ptrdiff_t mesh_index(const block *b, int i, int j, int k)
{
    return b->origin + i * b->stride[0] + j * b->stride[1] + k * b->stride[2];
}

/* Coordinate (m) of the global node index i along an axis; cell i spans [mesh_node(i), mesh_node(i + 1)]. */
static inline double mesh_node(const mesh *m, int axis, int i)
{
    return m->lower[axis] + i * m->h[axis];
}
static inline void place_of_node(const mesh *m, const int node[MESH_MAX_DIM], double x[MESH_MAX_DIM])
{
    for (int a = 0; a < MESH_MAX_DIM; ++a) x[a] = a < m->dim ? mesh_node(m, a, node[a]) : 0.0;
}
static inline double mesh_centre(const mesh *m, int axis, int i)
{
    return m->lower[axis] + (i + 0.5) * m->h[axis];
}

/* Product of the spacings (m^dim). */
double mesh_box_volume(const mesh *m);
/* Volume of a cell (m3; per metre of depth in 2-D, per m2 in 1-D, per radian when axisymmetric), global i along axis
 * 0. */
double mesh_cell_volume(const mesh *m, int i);
/* Area of the lower face, normal to `axis`, of the cell with global index i along axis 0. */
double mesh_face_area(const mesh *m, int axis, int i);
/* The global cell along `axis` that holds x: floor, and the upper wall belongs to the last cell (design, conventions).
 * Not clamped otherwise: a point outside gives an index outside. Independent of blocks. */
int mesh_cell_of(const mesh *m, int axis, double x);

/* Number of the global tile of global cell c (row-major, axis 0 fastest), and of the block that owns that tile. */
int mesh_tile_of(const mesh *m, const int cell[MESH_MAX_DIM]);
int mesh_block_of(const mesh *m, const int cell[MESH_MAX_DIM]);

/* Steps from a global cell along an axis, around a periodic one; false: beyond a side. */
static inline bool mesh_step(const mesh *m, int cell[MESH_MAX_DIM], int axis, int step)
{
    const int n = m->n[axis];
    cell[axis] += step;
    if (cell[axis] >= 0 && cell[axis] < n) return true;
    cell[axis] += cell[axis] < 0 ? n : -n;
    return axis < m->dim && m->periodic[axis];
}
/* What to add to a place along an axis (m) to have that of its images which is nearest to another; 0 where the axis is not periodic. */
static inline double mesh_to_image(const mesh *m, int axis, double x, double near)
{
    const double length = m->upper[axis] - m->lower[axis], way = near - x;
    if (axis >= m->dim || !m->periodic[axis]) return 0.0;
    return way > 0.5 * length ? length : way < -0.5 * length ? -length : 0.0;
}
/* Index of a cell or node along an axis, brought around a periodic one (from one length beyond it at most); others stay as they are. */
static inline int mesh_index_around(const mesh *m, int axis, int i)
{
    if (axis >= m->dim || !m->periodic[axis]) return i;
    return i < 0 ? i + m->n[axis] : i >= m->n[axis] ? i - m->n[axis] : i;
}
/* The image inside the mesh of a place along an axis (m) that has gone beyond a periodic side; others stay as they are. */
static inline double mesh_brought_around(const mesh *m, int axis, double x)
{
    const double length = m->upper[axis] - m->lower[axis];
    if (axis >= m->dim || !m->periodic[axis]) return x;
    return x < m->lower[axis] ? x + length : x > m->upper[axis] ? x - length : x;
}

/* Cells of the whole mesh, and its tiles. */
size_t mesh_cells(const mesh *m);
size_t mesh_tiles(const mesh *m);

#endif
