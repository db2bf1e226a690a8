/* Triangles in space, cell by cell.
 *
 * Each triangle is split at the planes of the mesh, along one axis after the other, into one polygon a cell. A corner
 * on a plane counts as above it: this decides alone which cells a triangle meets, so that what two triangles, or two
 * cells, share is the same for both, to the bit. Sides of polygons that lie in faces of their cells, and their ends on
 * edges of cells, are all that apertures and nodes need (theory 7.1):
 *
 *     node above = node below + crossings of the edge between them
 *     aperture   = node of its lowest corner + sum over sides in the face of their part by Green's theorem
 *     volume     = upper aperture along axis 0 + sum over pieces of place times area along axis 0
 *
 * Everything here is in cells: lengths over the cell's along each axis, from its lower corner. A triangle that goes around
 * a periodic axis is whole here, in the nearest images of its vertices, and its cells are brought back where they are
 * written to. */
#include "embedded/cut_internal.h"

#include "base/memory.h"
#include "math/tensor.h"

#include <math.h>

enum { MOST_CORNERS = 16, IN_NO_FACE = -1 };

/* Of a cell: a corner this near to a plane lies on it. */
static const double on_plane = 1e-11;
/* Of a face: smaller pieces are round-off. */
static const double least_area = 1e-15;

/* A corner of a polygon, and the side from it to the next. */
typedef struct corner {
    double u[3];    /* place, in cells from the mesh's lower corner */
    double w[2];    /* weights of the second and the third vertex of its triangle */
    unsigned faces; /* bit 2 axis + side: it lies in that face of its cell */
    int side;       /* the face of the cell in which the side lies; IN_NO_FACE */
    int edge;       /* the side of the triangle on which it lies, if that is a rim; -1 */
} corner;

typedef struct polygon {
    corner at[MOST_CORNERS];
    int n;
} polygon;

typedef struct cutter {
    cut_surface *c;
    const cut_triangle *triangle;
    int cell[3];    /* may lie beyond sides of axes that the triangle goes around */
    bool around[3]; /* axes that it may go around: periodic ones, unless the surface ends at it on their sides */
} cutter;

static unsigned face_bit(int axis, int side)
{
    return 1u << (2 * axis + side);
}

/* Faces of the mesh on which a place lies. */
static unsigned sides_of_mesh(const cutter *t, const double u[3])
{
    const mesh *m = t->c->mesh;
    unsigned faces = 0;
    for (int a = 0; a < 3; ++a)
        faces |= t->around[a]
                     ? 0
                     : (u[a] == 0.0 ? face_bit(a, SIDE_LOWER) : 0) | (u[a] == m->n[a] ? face_bit(a, SIDE_UPPER) : 0);
    return faces;
}

static int cell_along(const cutter *t, int axis, double u)
{
    const mesh *m = t->c->mesh;
    if (t->around[axis]) return (int)floor(u);
    return !(u > 0.0) ? 0 : u >= m->n[axis] ? m->n[axis] - 1 : (int)u;
}

/* The corner at which the side from a to b crosses a plane, always computed from its lower end. It belongs to the
 * faces of the side only, not to others that its position happens to touch. */
static corner passage(const corner *a, const corner *b, int axis, int plane)
{
    const corner *lo = a->u[axis] < b->u[axis] ? a : b, *hi = lo == a ? b : a;
    const double t = fmin(fmax((plane - lo->u[axis]) / (hi->u[axis] - lo->u[axis]), 0.0), 1.0);
    corner c = {.side = a->side, .edge = a->edge, .faces = a->faces & b->faces};
    for (int k = 0; k < 3; ++k) {
        const double u = lo->u[k] + t * (hi->u[k] - lo->u[k]);
        c.u[k] = fmin(fmax(u, fmin(lo->u[k], hi->u[k])), fmax(lo->u[k], hi->u[k]));
    }
    for (int k = 0; k < 2; ++k) c.w[k] = lo->w[k] + t * (hi->w[k] - lo->w[k]);
    c.u[axis] = plane;
    return c;
}

static bool add_corner(polygon *p, const corner *c)
{
    if (p->n == MOST_CORNERS) return false;
    p->at[p->n++] = *c;
    return true;
}

/* What lies below a plane, and what lies above; false where corners are too many. */
static bool split_polygon(const cutter *t, const polygon *p, int axis, int plane, polygon *low, polygon *high)
{
    bool fits = true;
    low->n = high->n = 0;
    for (int k = 0; k < p->n; ++k) {
        const corner *a = &p->at[k], *b = &p->at[(k + 1) % p->n];
        const bool above = cell_along(t, axis, a->u[axis]) >= plane, then = cell_along(t, axis, b->u[axis]) >= plane;
        fits = fits && add_corner(above ? high : low, a);
        if (above == then) continue;
        corner at = passage(a, b, axis, plane), on = at;
        at.faces |= face_bit(axis, above ? SIDE_LOWER : SIDE_UPPER); /* of the part that is left, along the plane */
        on.faces |= face_bit(axis, above ? SIDE_UPPER : SIDE_LOWER); /* of the part that is entered */
        at.side = 2 * axis + (above ? SIDE_LOWER : SIDE_UPPER);
        at.edge = -1;
        fits = fits && add_corner(above ? high : low, &at) && add_corner(above ? low : high, &on);
    }
    return fits;
}

/* The cut cell of a cell of the triangle, brought back around periodic axes. */
static floe_status touch_around(cutter *t, const int cell[3], int *at)
{
    int inside[3];
    for (int a = 0; a < 3; ++a) inside[a] = mesh_index_around(t->c->mesh, a, cell[a]);
    return cut_touch(t->c, inside, at);
}

/* Part of a side in a face of a cell of the triangle, by Green's theorem, and its ends on the edges of the face. */
static void pass_face(cut_cell *k, const int cell[3], const corner *p, const corner *q, int face)
{
    const int axis = face / 2, side = face % 2, e = (axis + 1) % 3, f = (axis + 2) % 3;
    const double sign = side == SIDE_UPPER ? 1.0 : -1.0;
    const double yp = cell[e] + 1 - p->u[e], yq = cell[e] + 1 - q->u[e];
    const double zp = cell[f] + 1 - p->u[f], zq = cell[f] + 1 - q->u[f];
    double part = 0.5 * (yp + yq) * (zp - zq);
    for (int end = SIDE_LOWER; end <= SIDE_UPPER; ++end) {
        const bool at_p = p->faces & face_bit(e, end), at_q = q->faces & face_bit(e, end);
        const int ends = (at_q ? 1 : 0) - (at_p ? 1 : 0);
        if (end == SIDE_LOWER) part += (at_q ? zq : 0.0) - (at_p ? zp : 0.0);
        k->jump[f][2 * end + side] += (side == end ? -ends : ends);
    }
    k->face[axis][side] += sign * part;
    k->crossed |= (unsigned char)(1 << face);
}

/* The polygon lies in the lower face of its cell, with the gas below: it bounds the cell below, whole. */
static int axis_behind(const cutter *t, const polygon *p, const double area[3])
{
    for (int a = 0; a < 3; ++a) {
        bool in_face = (t->cell[a] > 0 || t->around[a]) && area[a] > 0.0;
        for (int k = 0; k < p->n && in_face; ++k) in_face = p->at[k].u[a] == t->cell[a];
        if (in_face) return a;
    }
    return -1;
}

/* Area vector, weights of the middle, and integrals over the area of u_d and of (u_d - middle of the cell)^2 / 2. */
typedef struct polygon_sums {
    double area[3], weight[3], first, square[3];
} polygon_sums;

static polygon_sums sum_polygon(const polygon *p, const int cell[3])
{
    polygon_sums s = {.first = 0.0};
    double middle[2] = {0.0, 0.0};
    for (int k = 1; k + 1 < p->n; ++k) {
        double part[3];
        triangle_normal(p->at[0].u, p->at[k].u, p->at[k + 1].u, part);
        for (int d = 0; d < 3; ++d) s.area[d] += 0.5 * part[d];
    }
    const double square = vec_dot(s.area, s.area);
    for (int k = 1; k + 1 < p->n && square > 0.0; ++k) {
        const corner *a = &p->at[0], *b = &p->at[k], *c = &p->at[k + 1];
        double part[3], share = 0.0;
        triangle_normal(a->u, b->u, c->u, part);
        for (int d = 0; d < 3; ++d) share += 0.5 * part[d] * s.area[d] / square;
        for (int i = 0; i < 2; ++i) middle[i] += share * (a->w[i] + b->w[i] + c->w[i]) / 3.0;
        for (int d = 0; d < 3; ++d) {
            const double x = a->u[d] - cell[d] - 0.5, y = b->u[d] - cell[d] - 0.5, z = c->u[d] - cell[d] - 0.5;
            s.square[d] += share * s.area[d] * (x * x + y * y + z * z + x * y + y * z + z * x) / 12.0;
            if (d == 0) s.first += share * s.area[0] * ((x + y + z) / 3.0 + 0.5);
        }
    }
    s.weight[1] = middle[0];
    s.weight[2] = middle[1];
    s.weight[0] = 1.0 - middle[0] - middle[1];
    return s;
}

static floe_status put_piece(cutter *t, const polygon *p)
{
    const mesh *m = t->c->mesh;
    polygon_sums s = sum_polygon(p, t->cell);
    const double size = sqrt(s.area[0] * s.area[0] + s.area[1] * s.area[1] + s.area[2] * s.area[2]);
    int cell[3] = {t->cell[0], t->cell[1], t->cell[2]}, at;
    if (!(size > least_area)) return FLOE_OK;
    const int behind = axis_behind(t, p, s.area);
    if (behind >= 0) {
        TRY(touch_around(t, cell, &at));
        t->c->cell[at].face[behind][SIDE_LOWER] -= s.area[behind];
        cell[behind]--;
        s = sum_polygon(p, cell);
        TRY(touch_around(t, cell, &at));
        t->c->cell[at].face[behind][SIDE_UPPER] -= s.area[behind];
    }
    cut_piece q = {.vertex = {t->triangle->vertex[0], t->triangle->vertex[1], t->triangle->vertex[2]}};
    TRY(touch_around(t, cell, &at));
    const double volume = mesh_cell_volume(m, t->c->cell[at].cell[0]);
    for (int d = 0; d < 3; ++d) {
        q.weight[d] = s.weight[d];
        q.area[d] = s.area[d] * volume / m->h[d];
    }
    const cut_part part = {s.first, {s.square[0], s.square[1], s.square[2]}};
    return cut_add_piece(t->c, t->c->cell[at].cell, &q, &part);
}

/* The face of the cell in which a side of the triangle ends on a side of the mesh. */
static int face_of_rim(const corner *p, const corner *q)
{
    for (int face = 0; face < 6; ++face)
        if ((p->faces & q->faces) >> face & 1) return face;
    return IN_NO_FACE;
}

static floe_status refuse_rim(const cutter *t, const corner *p)
{
    const mesh *m = t->c->mesh;
    return fail(t->c->ctx, FLOE_BAD_INPUT,
                "a boundary of gas ends at (%g, %g, %g), inside the domain: let it end on a symmetry or slip side, or "
                "close it",
                m->lower[0] + p->u[0] * m->h[0], m->lower[1] + p->u[1] * m->h[1], m->lower[2] + p->u[2] * m->h[2]);
}

static floe_status put_polygon(cutter *t, const polygon *p)
{
    int at;
    TRY(touch_around(t, t->cell, &at));
    for (int k = 0; k < p->n; ++k) {
        const corner *a = &p->at[k], *b = &p->at[(k + 1) % p->n];
        int face = a->side;
        if (a->edge >= 0) face = face_of_rim(a, b);
        if (a->edge >= 0 && face == IN_NO_FACE) return refuse_rim(t, a);
        if (face != IN_NO_FACE) pass_face(&t->c->cell[at], t->cell, a, b, face);
    }
    return put_piece(t, p);
}

static floe_status too_crooked(const cutter *t)
{
    return fail(t->c->ctx, FLOE_RETRY, "a boundary of gas is too crooked in cell (%d, %d, %d)", t->cell[0], t->cell[1],
                t->cell[2]);
}

/* Splits at the planes of an axis, and what lies between them along the next. */
static floe_status split_along(cutter *t, const polygon *p, int axis)
{
    polygon part[2], low;
    const polygon *rest = p;
    if (axis == 3) return put_polygon(t, p);
    int first = cell_along(t, axis, p->at[0].u[axis]), last = first;
    for (int k = 1; k < p->n; ++k) {
        const int i = cell_along(t, axis, p->at[k].u[axis]);
        first = i < first ? i : first;
        last = i > last ? i : last;
    }
    for (int i = first; i < last; ++i) {
        polygon *high = &part[(i - first) % 2];
        t->cell[axis] = i;
        if (!split_polygon(t, rest, axis, i + 1, &low, high)) return too_crooked(t);
        if (low.n > 0) TRY(split_along(t, &low, axis + 1));
        rest = high;
    }
    t->cell[axis] = last;
    return rest->n > 0 ? split_along(t, rest, axis + 1) : FLOE_OK;
}

static double in_cells(const mesh *m, int axis, double x)
{
    const double u = (x - m->lower[axis]) / m->h[axis], whole = rint(u);
    return fabs(u - whole) < on_plane ? whole : u;
}

/* A triangle's vertices in cells, in the images nearest to the first. */
static floe_status begin_triangle(cutter *t, polygon *p)
{
    const cut_surface *c = t->c;
    const mesh *m = c->mesh;
    p->n = 3;
    for (int k = 0; k < 3; ++k) {
        corner *at = &p->at[k];
        *at = (corner){.w = {k == 1, k == 2}, .side = IN_NO_FACE, .edge = -1};
        if (t->triangle->rim >> k & 1) at->edge = k;
        for (int a = 0; a < 3; ++a) {
            at->u[a] = in_cells(m, a, c->vertex[t->triangle->vertex[k]].x[a]);
            if (!t->around[a]) continue;
            const double way = at->u[a] - p->at[0].u[a], half = 0.5 * m->n[a];
            at->u[a] += way > half ? -m->n[a] : way < -half ? m->n[a] : 0;
        }
        if (!isfinite(at->u[0] + at->u[1] + at->u[2]))
            return fail(c->ctx, FLOE_RETRY, "a vertex of a boundary of gas has no place");
        at->faces = sides_of_mesh(t, at->u);
    }
    return FLOE_OK;
}

/* Bit a: the surface ends at this vertex, on a side across axis a. */
static void mark_ends(const cut_surface *c, unsigned char *ends)
{
    for (int n = 0; n < c->n_triangles; ++n)
        for (int k = 0; k < 3; ++k) {
            const int v = c->triangle[n].vertex[k], w = c->triangle[n].vertex[(k + 1) % 3];
            for (int a = 0; a < 3 && (c->triangle[n].rim >> k & 1); ++a) {
                const double x = c->vertex[v].x[a];
                if (x != c->vertex[w].x[a] || !cut_is_on_side(c->mesh, x, a)) continue;
                ends[v] |= (unsigned char)(1u << a);
                ends[w] |= (unsigned char)(1u << a);
            }
        }
}

static floe_status cut_each(cut_surface *c, const unsigned char *ends)
{
    for (int n = 0; n < c->n_triangles; ++n) {
        const int *v = c->triangle[n].vertex;
        const unsigned at_ends = ends ? ends[v[0]] | ends[v[1]] | ends[v[2]] : 0;
        cutter t = {.c = c, .triangle = &c->triangle[n]};
        polygon p;
        for (int a = 0; a < 3; ++a) t.around[a] = c->mesh->periodic[a] && !(at_ends >> a & 1);
        TRY(begin_triangle(&t, &p));
        TRY(split_along(&t, &p, 0));
    }
    return FLOE_OK;
}

floe_status cut_triangles(cut_surface *c)
{
    const mesh *m = c->mesh;
    unsigned char *ends = NULL;
    if (!(m->periodic[0] || m->periodic[1] || m->periodic[2])) return cut_each(c, NULL);
    TRY(memory_new(c->ctx, &ends, (size_t)c->n_vertices + 1, sizeof *ends));
    mark_ends(c, ends);
    const floe_status status = cut_each(c, ends);
    memory_free(c->ctx, &ends);
    return status;
}

/* ---- shares of cells, once nodes are numbered ---- */

static bool finish_shares(const cut_surface *c, cut_cell *k)
{
    const mesh *m = c->mesh;
    cut_shares found = {.sound = true};
    double upper = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            int node[3] = {k->cell[0], k->cell[1], k->cell[2]};
            node[axis] += side;
            const double share = c->node[cut_node(m, node)] + k->face[axis][side];
            k->face[axis][side] = cut_snapped_face(c, share, &found);
            if (axis == 0 && side == SIDE_UPPER)
                upper = fabs(share - k->face[axis][side]) > cut_crossing ? share : k->face[axis][side];
        }
    k->open = cut_snapped_volume(c, upper + k->open, &found);
    for (int axis = 0; axis < 3; ++axis)
        k->moment[axis] =
            m->h[axis] * (0.125 * (k->face[axis][SIDE_UPPER] - k->face[axis][SIDE_LOWER]) + k->moment[axis]);
    k->overlap = found.overlap;
    return found.sound;
}

/* Cells that are only touched are whole: the list keeps those with pieces, in order. */
static void keep_cut_cells(cut_surface *c, const bool *has_piece, int *number)
{
    int n = 0;
    for (int k = 0; k < c->n_cells; ++k) {
        int *at = &c->at[cut_index(c->mesh, c->cell[k].cell)];
        if (has_piece[k]) {
            number[k] = *at = n;
            c->cell[n++] = c->cell[k];
        } else
            *at = c->cell[k].open > 0.5 ? CUT_INSIDE : CUT_OUTSIDE;
    }
    c->n_cells = n;
}

static floe_status drop_whole_cells(cut_surface *c)
{
    bool *has_piece = NULL;
    int *number = NULL;
    floe_status status = memory_new(c->ctx, &has_piece, (size_t)c->n_cells + 1, sizeof *has_piece);
    if (status == FLOE_OK) status = memory_new(c->ctx, &number, (size_t)c->n_cells + 1, sizeof *number);
    if (status == FLOE_OK) {
        for (int k = 0; k < c->n_pieces; ++k) has_piece[c->piece[k].cell] = true;
        keep_cut_cells(c, has_piece, number);
        for (int k = 0; k < c->n_pieces; ++k) c->piece[k].cell = number[c->piece[k].cell];
    }
    memory_free(c->ctx, &has_piece);
    memory_free(c->ctx, &number);
    return status;
}

floe_status cut_finish_in_space(cut_surface *c)
{
    for (int k = 0; k < c->n_cells; ++k) {
        if (finish_shares(c, &c->cell[k])) continue;
        const int *cell = c->cell[k].cell;
        return fail(c->ctx, FLOE_RETRY,
                    "a boundary of gas crosses itself or another in cell (%d, %d, %d), at (%g, %g, %g)", cell[0],
                    cell[1], cell[2], mesh_centre(c->mesh, 0, cell[0]), mesh_centre(c->mesh, 1, cell[1]),
                    mesh_centre(c->mesh, 2, cell[2]));
    }
    return drop_whole_cells(c);
}
