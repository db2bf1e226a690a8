/* Interfaces between immiscible fluids. In a cell at an interface, the volume that leaves is taken from a sharp profile, since a linear profile widens with
 * every cell that it crosses (THINC: F. Xiao, Y. Honma, T. Kono, Int. J. Numer. Methods Fluids 48 (2005) 1023; in several dimensions F. Xiao, S. Ii, C. Chen,
 * J. Comput. Phys. 230 (2011) 7086): along an axis, x from 0 to 1 through the cell,
 *
 *     theta(x) = 1/2 (1 + s tanh beta (x - d)),    s the sign of the slope, d from the mean of the cell,
 *
 * and the slab has the mean of this profile over it. The fluids leave with their pure states in the cell (ice_interface_flux.c), so that advection changes
 * neither pressure nor velocity. All faces of a cell together take no more of a fluid than the cell contains.
 *
 * Bubbly mixtures are not interfaces: within two cells the volume fraction must change by more than a half. */
#include "ice/fraction/ice_fraction.h"
#include "ice/ice_constants.h"
#include "ice/sides/ice_sides.h"
#include "ice/state/ice_state.h"

#include <math.h>

enum { MOST_FACES = 2 * MESH_MAX_DIM };

/* ---- where they are ---- */

static bool at_interface(const ice_view *v, ptrdiff_t at)
{
    for (int r = 0; r < v->n_materials; ++r) {
        const double *theta = v->m[r].theta;
        double lo = theta[at], hi = theta[at];
        if (!(lo > ICE_INTERFACE_PURE && lo < 1.0 - ICE_INTERFACE_PURE)) continue;
        for (int a = 0; a < v->dim; ++a)
            for (int k = -2; k <= 2; ++k) {
                const double beside = theta[at + k * v->b->stride[a]];
                lo = least(lo, beside);
                hi = most(hi, beside);
            }
        if (hi - lo > ICE_INTERFACE_RANGE) return true;
    }
    return false;
}

static void mark_interface_row(const ice_view *v, double *found, ptrdiff_t base)
{
    for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at)
        found[at] = v->mixed[at] > 1.0 && at_interface(v, at) ? 1.0 : 0.0;
}

/* From the first to the last marked cell of a row, one layer of ghosts too. */
static ice_span marked_in(const ice_view *v, int j, int k)
{
    const double *mark = v->interface + mesh_index(v->b, 0, j, k);
    ice_span q = {-1, v->b->n[0] + 1};
    while (q.first < q.end && mark[q.first] == 0.0) ++q.first;
    while (q.end > q.first && mark[q.end - 1] == 0.0) --q.end;
    return q;
}

floe_status ice_find_interfaces_of(ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        double *found = field_get(s->domain->fields[v.b->id], C_INTERFACE, g->number, 0);
        const ice_rows q = ice_rows_of(v.b, -1, 0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row) mark_interface_row(&v, found, ice_row_start(v.b, q, row));
    }
    ice_spread_interfaces(s, g);
    return FLOE_OK;
}

void ice_spread_interfaces(const ice *s, const ice_region *g)
{
    ice_view v;
    ice_fill_ghosts(s, C_INTERFACE, g->number, FILL_CURRENT, GHOST_EVEN);
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        ice_span *sharp = ice_interface_spans(s, v.b->id);
        const ice_rows q = ice_rows_of(v.b, -1, 1);
        if (!sharp) continue;
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row) {
            const int j = ice_row_j(q, row), k = ice_row_k(q, row);
            sharp[ice_row_number(v.b, j, k)] = marked_in(&v, j, k);
        }
    }
}

void ice_flatten_interfaces(const ice_view *v)
{
    const ice_rows q = ice_rows_of(v->b, -1, 1);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const int j = ice_row_j(q, row), k = ice_row_k(q, row);
        const ice_span marked = v->sharp[ice_row_number(v->b, j, k)];
        const ptrdiff_t base = mesh_index(v->b, 0, j, k);
        for (ptrdiff_t at = base + marked.first; at < base + marked.end; ++at)
            if (v->interface[at] > 0.0) v->limiter[at] = 0.0;
    }
}

/* ---- the sharp profile ---- */

/* ln cosh y2 - ln cosh y1, for arguments of any size. */
static double log_cosh_between(double y1, double y2)
{
    const double a = fabs(y1), b = fabs(y2);
    return (b - a) + log1p(exp(-2.0 * b)) - log1p(exp(-2.0 * a));
}

/* Mean of the profile of rising or falling theta, of the mean `here` over the cell, from x1 to x1 + reach. */
static double profile_mean(double here, bool rises, double beta, double x1, double reach)
{
    const double s = rises ? 1.0 : -1.0, a = exp(s * beta * (2.0 * here - 1.0)), E = (exp(beta) - a) / (a - exp(-beta));
    if (!(E > 0.0 && isfinite(E))) return here;
    const double d = 0.5 * log(E) / beta;
    const double mean = 0.5 * (1.0 + s * log_cosh_between(beta * (x1 - d), beta * (x1 + reach - d)) / (beta * reach));
    return least(most(mean, 0.0), 1.0);
}

/* Steepness along an axis: the profile is one along the normal. */
static double steepness_along(const ice_view *v, const double *theta, ptrdiff_t at, int axis)
{
    double along = 0.0, square = 0.0;
    if (v->dim == 1) return ICE_INTERFACE_STEEPNESS;
    for (int a = 0; a < v->dim; ++a) {
        const double rise = theta[at + v->b->stride[a]] - theta[at - v->b->stride[a]];
        if (a == axis) along = fabs(rise);
        square += rise * rise;
    }
    return square > 0.0 ? ICE_INTERFACE_STEEPNESS * along / sqrt(square) + ICE_INTERFACE_LEAST_STEEPNESS
                        : ICE_INTERFACE_LEAST_STEEPNESS;
}

/* A slab that leaves a cell: through its upper or lower face, `reach` cells thick, `part` of the cell's volume. */
typedef struct slab {
    int axis;
    bool upper;
    double reach, part;
} slab;

/* Fraction of a fluid in the slab. */
static double slab_fraction(const ice_view *v, const double *theta, ptrdiff_t at, const slab *q)
{
    const ptrdiff_t step = v->b->stride[q->axis];
    const double below = theta[at - step], here = theta[at], above = theta[at + step];
    const double rise = here - below, next = above - here;
    const bool rises = above > below, monotone = (rises ? least(rise, next) : -most(rise, next)) > -ICE_INTERFACE_TIE;
    if (!monotone || !(fabs(above - below) > ICE_INTERFACE_TIE) || !(q->reach > ICE_INTERFACE_LEAST_REACH) ||
        !(here > ICE_INTERFACE_PURE && here < 1.0 - ICE_INTERFACE_PURE))
        return here;
    const bool towards_more = rises == q->upper;
    if (here < ICE_INTERFACE_FOOT) return towards_more ? least(1.0, ICE_INTERFACE_FOOT_SHARE * here / q->part) : 0.0;
    if (here > 1.0 - ICE_INTERFACE_FOOT)
        return towards_more ? 1.0 : most(0.0, 1.0 - ICE_INTERFACE_FOOT_SHARE * (1.0 - here) / q->part);
    const double mean =
        profile_mean(here, rises, steepness_along(v, theta, at, q->axis), q->upper ? 1.0 - q->reach : 0.0, q->reach);
    return most(least(mean, here / q->part), (here - (1.0 - q->part)) / q->part);
}

/* Fractions of all fluids in the slab: of two, the second has what the first leaves, so that no near tie of neighbours is decided twice. */
static void slab_fractions(const ice_view *v, ptrdiff_t at, const slab *q, double *fraction)
{
    double sum = 0.0;
    fraction[0] = slab_fraction(v, v->m[0].theta, at, q);
    if (v->n_materials == 2) {
        fraction[1] = 1.0 - fraction[0];
        return;
    }
    for (int r = 0; r < v->n_materials; ++r) {
        fraction[r] = slab_fraction(v, v->m[r].theta, at, q);
        sum += fraction[r];
    }
    for (int r = 0; r < v->n_materials; ++r) fraction[r] = sum > 0.0 ? fraction[r] / sum : v->m[r].theta[at];
}

/* ---- what a cell gives ---- */

/* The faces of a cell, and what leaves through them: shares of the cell's volume, and of them the fluids' fractions; 0 where a fluid comes in. */
typedef struct giving {
    int n;
    ptrdiff_t face[MOST_FACES];
    double part[ICE_MAX_MATERIALS][MOST_FACES], fraction[ICE_MAX_MATERIALS][MOST_FACES];
} giving;

/* What leaves through one face; materials need not have one velocity. i: of the cell along axis 0. */
static void give_through(const ice_view *v, ptrdiff_t at, int i, int axis, bool upper, giving *g)
{
    const int n = g->n++;
    const ptrdiff_t face = upper ? at + v->b->stride[axis] : at;
    const double area = axis > 0 ? v->inv_h[axis] : upper ? v->upper0[i] : v->lower0[i];
    double last = 0.0, fraction[ICE_MAX_MATERIALS];
    g->face[n] = face;
    for (int r = 0; r < v->n_materials; ++r) {
        const double speed = upper ? v->m[r].fu[axis][face] : -v->m[r].fu[axis][face];
        g->part[r][n] = g->fraction[r][n] = 0.0;
        if (!(speed > 0.0)) continue;
        const slab q = {axis, upper, speed * v->dt * v->inv_h[axis], speed * v->dt * area};
        if (speed != last) slab_fractions(v, at, &q, fraction);
        last = speed;
        g->part[r][n] = q.part;
        g->fraction[r][n] = fraction[r];
    }
}

/* Fluids whose outflow would exceed their content give less at every face, and those with content left give more, in
 * proportion to it: as much as the others fall short of (all faces together take no more than the cell's volume). */
static void bound_outflow(const ice_view *v, ptrdiff_t at, giving *g)
{
    double factor[ICE_MAX_MATERIALS], left[ICE_MAX_MATERIALS];
    bool over = false;
    for (int r = 0; r < v->n_materials; ++r) {
        double out = 0.0, all = 0.0;
        for (int n = 0; n < g->n; ++n) {
            out += g->part[r][n] * g->fraction[r][n];
            all += g->part[r][n];
        }
        const double has = v->m[r].theta[at] * most(1.0, all);
        factor[r] = out > has ? has / out : 1.0;
        left[r] = most(has - out, 0.0);
        over = over || out > has;
    }
    for (int n = 0; n < g->n && over; ++n) {
        double missing = 0.0, total = 0.0;
        for (int r = 0; r < v->n_materials; ++r) {
            if (!(g->part[r][n] > 0.0)) continue;
            missing += (1.0 - factor[r]) * g->fraction[r][n];
            total += left[r];
        }
        for (int r = 0; r < v->n_materials; ++r) {
            g->fraction[r][n] *= factor[r];
            if (g->part[r][n] > 0.0 && total > 0.0) g->fraction[r][n] += missing * left[r] / total;
        }
    }
}

/* The faces among them that are the block's own take it. c: local cell. */
static void give_through_faces(const ice_view *v, const int *c)
{
    const ptrdiff_t at = mesh_index(v->b, c[0], c[1], c[2]);
    giving g = {.n = 0};
    for (int a = 0; a < v->dim; ++a)
        for (int upper = 0; upper < 2; ++upper) give_through(v, at, c[0], a, upper, &g);
    bound_outflow(v, at, &g);
    for (int n = 0; n < g.n; ++n) {
        const int axis = n / 2, number = c[axis] + n % 2;
        bool own = number >= 0 && number <= v->b->n[axis];
        for (int a = 0; a < v->dim; ++a) own = own && (a == axis || (c[a] >= 0 && c[a] < v->b->n[a]));
        for (int r = 0; own && r < v->n_materials; ++r)
            if (g.part[r][n] > 0.0) v->m[r].ft[axis][g.face[n]] = g.fraction[r][n];
    }
}

/* The volume flux of the faces of a row that are of a marked cell. */
static void renew_flux(const ice_view *v, int axis, int j, int k)
{
    const int below_j = j - (axis == 1), below_k = k - (axis == 2), faces = v->b->n[0] + (axis == 0);
    const ice_span at = v->sharp[ice_row_number(v->b, j, k)], below = v->sharp[ice_row_number(v->b, below_j, below_k)];
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    const int lo = at.first < below.first ? at.first : below.first,
              hi = (at.end > below.end ? at.end : below.end) + (axis == 0);
    if (at.end <= at.first && below.end <= below.first) return;
    for (int i = lo > 0 ? lo : 0; i < (hi < faces ? hi : faces); ++i) {
        const ptrdiff_t R = base + i;
        double sum = 0.0;
        if (v->interface[R] == 0.0 && v->interface[R - v->b->stride[axis]] == 0.0) continue;
        for (int r = 0; r < v->n_materials; ++r) sum += v->m[r].ft[axis][R] * v->m[r].fu[axis][R];
        v->flux[axis][R] = sum;
    }
}

void ice_sharpen_faces(const ice_view *v)
{
    const ice_rows cells = ice_rows_of(v->b, -1, 1);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < cells.n; ++row) {
        const int j = ice_row_j(cells, row), k = ice_row_k(cells, row);
        const ice_span marked = v->sharp[ice_row_number(v->b, j, k)];
        for (int i = marked.first; i < marked.end; ++i)
            if (v->interface[mesh_index(v->b, i, j, k)] > 0.0) give_through_faces(v, (const int[]){i, j, k});
    }
    for (int axis = 0; axis < v->dim; ++axis) {
        const ice_rows q = ice_rows_of(v->b, axis, 0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row) renew_flux(v, axis, ice_row_j(q, row), ice_row_k(q, row));
    }
}
