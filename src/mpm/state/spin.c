/* Moment of momentum of points about the origin: that of their positions and velocities, and that of the motion about
 * each point which a transfer carries (transfer.h), m_p sum_i S_ip (x_i - x_p) x C_p (x_i - x_p). */
#include "base/threads.h"
#include "grid/tile_box.h"
#include "mpm/transfer/kernels.h"
#include "mpm/transfer/point_arrays.h"
#include "mpm/transfer/scratch.h"
#include "mpm/transfer/windows.h"

#include <math.h>
#include <string.h>

enum { SUM_MOMENT, SUM_SIZE = SUM_MOMENT + 3, SUM_END = SUM_SIZE + 3 };

/* Second moments of the weights about points, D = sum S x x^T - x_p x_p^T with places from the tile's corner: xx yy zz xy yz zx. */
typedef struct weight_spread {
    double window[6][MPM_MAX_WINDOW];
    double at[6][SOLID_CHUNK];
    double corner[3];
} weight_spread;

static const int pair_of[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
static const int spread_of[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

static void fill_spread(const mpm *s, const tile_box *t, weight_spread *out)
{
    const int *size = s->windows->window, reach = s->windows->reach;
    for (int a = 0; a < 3; ++a) out->corner[a] = a < s->mesh->dim ? mesh_node(s->mesh, a, t->first[a]) : 0.0;
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
            for (int i = 0; i < size[0]; ++i) {
                const int node[3] = {i, j, k}, at = (k * size[1] + j) * size[0] + i;
                double x[3] = {0.0};
                for (int a = 0; a < s->mesh->dim; ++a) x[a] = (node[a] - reach) * s->mesh->h[a];
                for (int c = 0; c < 6; ++c) out->window[c][at] = x[pair_of[c][0]] * x[pair_of[c][1]];
            }
}

static double spread_at(const weight_spread *w, size_t k, const double x[3], int a, int b)
{
    const int c = spread_of[a][b];
    return w->at[c][k] - (x[a] - w->corner[a]) * (x[b] - w->corner[b]);
}

/* r x C r, averaged over the weights: of its component e the part with the axes a and b that follow. */
static double carried_spin(const weight_spread *w, const point_arrays *p, size_t k, size_t row, const double x[3],
                           int a, int b, int dim)
{
    double sum = 0.0;
    for (int c = 0; c < dim; ++c)
        sum += p->affine[dim * b + c][k] * spread_at(w, row, x, c, a) -
               p->affine[dim * a + c][k] * spread_at(w, row, x, c, b);
    return sum;
}

static void add_points(const mpm *s, const tile_box *t, const point_arrays *p, size_t start, size_t end,
                       weight_spread *w, double sum[SUM_END])
{
    const int dim = s->mesh->dim;
    double middle[3];
    for (int a = 0; a < 3; ++a) middle[a] = 0.5 * (s->mesh->lower[a] + s->mesh->upper[a]);
    const bool carries = dim > 1 && p->affine[0]; /* along a line no moment is carried */
    for (int c = 0; carries && c < 6; ++c)
        if (pair_of[c][0] < dim && pair_of[c][1] < dim)
            s->windows->kernel->sample(s->mesh, t, p, start, end, w->window[c], w->at[c]);
    for (size_t k = start; k < end; ++k) {
        double x[3] = {0.0}, v[3] = {0.0};
        for (int a = 0; a < dim; ++a) {
            x[a] = p->x[a][k];
            v[a] = p->v[a][k];
        }
        for (int e = dim == 2 ? 2 : 0; e < 3; ++e) {
            const int a = (e + 1) % 3, b = (e + 2) % 3;
            const double carried = carries ? carried_spin(w, p, k, k - start, x, a, b, dim) : 0.0;
            sum[SUM_MOMENT + e] += p->all_mass[k] * (x[a] * v[b] - x[b] * v[a] + carried);
            sum[SUM_SIZE + e] += p->all_mass[k] * fabs((x[a] - middle[a]) * v[b] - (x[b] - middle[b]) * v[a] + carried);
        }
    }
}

static void add_spin_tile(mpm *s, int blk, int tile, void *user, double *sum)
{
    const int body = *(const int *)user;
    const point_arrays p = points_of(s, blk, body, false, false);
    const size_t *at = s->points[blk][body].tile_start;
    const tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    weight_spread w;
    if (at[tile] == at[tile + 1]) return;
    if (p.affine[0]) fill_spread(s, &box, &w);
    for (size_t n = at[tile]; n < at[tile + 1]; n += SOLID_CHUNK)
        add_points(s, &box, &p, n, n + SOLID_CHUNK < at[tile + 1] ? n + SOLID_CHUNK : at[tile + 1], &w, sum);
}

void mpm_angular_momentum(mpm *s, int body, double out[3], double size[3])
{
    memset(out, 0, 3 * sizeof *out);
    memset(size, 0, 3 * sizeof *size);
    if (s->mesh->dim == 1) return; /* along a line nothing turns */
    double all[SUM_END];
    sum_over_tiles(s, SUM_END, add_spin_tile, &body, all);
    memcpy(out, all + SUM_MOMENT, 3 * sizeof *out);
    memcpy(size, all + SUM_SIZE, 3 * sizeof *size);
}
