/* Polynomials of second degree about cut cells by least squares (ice_wall_fit.h; theory 7.7). */
#include "ice/cut/ice_wall_fit.h"

#include "ice/ice_constants.h"

#include <math.h>
#include <string.h>

int fit_at(const ice *s, const ice_wall_flow *w, const wall_place *at)
{
    const int own = w->fit_of[cut_index(s->mesh, at->cell)];
    return own < 0 ? -1 : w->cell[own].host;
}

const ice_view *fit_view(const ice *s, const int cell[3], ptrdiff_t *at)
{
    const ice_view *v = &s->cut_cells->view[mesh_block_of(s->mesh, cell)];
    *at = mesh_index(v->b, cell[0] - v->b->lo[0], cell[1] - v->b->lo[1], cell[2] - v->b->lo[2]);
    return v;
}

bool fit_next_step(int dim, int reach, int *n, int step[3])
{
    const int wide = 2 * reach + 1, count = dim == 1 ? wide : dim == 2 ? wide * wide : wide * wide * wide;
    if (*n >= count) return false;
    step[0] = *n % wide - reach;
    step[1] = dim > 1 ? *n / wide % wide - reach : 0;
    step[2] = dim > 2 ? *n / wide / wide - reach : 0;
    ++*n;
    return true;
}

bool fit_find_cell(const mesh *m, const int from[3], const int step[3], int cell[3], double shift[3])
{
    for (int a = 0; a < 3; ++a) {
        cell[a] = from[a] + step[a];
        shift[a] = 0.0;
        if (cell[a] >= 0 && cell[a] < m->n[a]) continue;
        if (a >= m->dim || !m->periodic[a]) return false;
        const int turns = cell[a] < 0 ? -1 : 1;
        cell[a] -= turns * m->n[a];
        shift[a] = turns * (m->upper[a] - m->lower[a]);
        if (cell[a] < 0 || cell[a] >= m->n[a]) return false;
    }
    return true;
}

void fit_bring_near(const mesh *m, const fit_cell *f, double x[3])
{
    for (int a = 0; a < m->dim; ++a) x[a] += mesh_to_image(m, a, x[a], f->centre[a]);
}

double fit_length(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static int count_terms(int dim)
{
    return (dim + 1) * (dim + 2) / 2;
}

/* Where the terms of an axis, of its square, and of its product with the next stand. */
static const int linear[3] = {1, 3, 6}, square[3] = {2, 4, 7}, product[3] = {5, 8, 9};

void fit_terms(const mesh *m, const fit_cell *f, const double x[3], double t[FIT_TERMS])
{
    double y[3] = {0.0};
    for (int a = 0; a < m->dim; ++a) y[a] = (x[a] - f->centre[a]) / m->h[a];
    t[0] = 1.0;
    for (int a = 0; a < 3; ++a) {
        t[linear[a]] = y[a];
        t[square[a]] = y[a] * y[a];
        t[product[a]] = y[a] * y[(a + 1) % 3];
    }
}

void fit_slopes(const mesh *m, const fit_cell *f, const double x[3], double slope[3][FIT_TERMS])
{
    double y[3] = {0.0};
    for (int a = 0; a < m->dim; ++a) y[a] = (x[a] - f->centre[a]) / m->h[a];
    memset(slope, 0, 3 * sizeof slope[0]);
    for (int a = 0; a < m->dim; ++a) {
        slope[a][linear[a]] = 1.0 / m->h[a];
        slope[a][square[a]] = 2.0 * y[a] / m->h[a];
        slope[a][product[a]] = y[(a + 1) % 3] / m->h[a];
        slope[a][product[(a + 2) % 3]] = y[(a + 2) % 3] / m->h[a];
    }
}

void fit_add(const mesh *m, const fit_cell *f, const double x[3], double share, const double *value, fit_squares *q)
{
    double beyond = 0.0, away = 0.0, t[FIT_TERMS];
    for (int a = 0; a < m->dim; ++a) {
        beyond += f->outward[a] * (x[a] - f->wall[a]) / m->h[a];
        const double y = (x[a] - f->centre[a]) / m->h[a];
        away += y * y;
    }
    if (beyond > ICE_WALL_BEYOND) return;
    const double near = 0.25 + away, weight = share / (near * near);
    fit_terms(m, f, x, t);
    const int terms = count_terms(m->dim);
    for (int i = 0; i < terms; ++i) {
        for (int j = 0; j <= i; ++j) q->matrix[i][j] += weight * t[i] * t[j];
        for (int a = 0; a < q->components; ++a) q->right[a][i] += weight * t[i] * value[a];
    }
    q->weight += weight;
}

double fit_wall_share(const mesh *m, const wall_sample *p)
{
    double across = m->h[0];
    for (int a = 1; a < m->dim; ++a) across = least(across, m->h[a]);
    const double area = m->dim == 1 ? 1.0 : m->dim == 2 ? across : across * across;
    return 2.0 * least(1.0, p->size / area);
}

/* By Cholesky's method. A little of the weight on every term keeps those small of which the values say nothing. */
void fit_solve(fit_squares *q, int dim, double (*term)[FIT_TERMS])
{
    const int terms = count_terms(dim);
    for (int i = 1; i < terms; ++i)
        q->matrix[i][i] += q->weight * (i == linear[0] || i == linear[1] || i == linear[2] ? 1e-9 : 1e-5);
    for (int i = 0; i < terms; ++i)
        for (int j = 0; j <= i; ++j) {
            double sum = q->matrix[i][j];
            for (int k = 0; k < j; ++k) sum -= q->matrix[i][k] * q->matrix[j][k];
            q->matrix[i][j] = i == j ? sqrt(sum) : sum / q->matrix[j][j];
        }
    for (int a = 0; a < q->components; ++a) {
        double *x = term[a];
        for (int i = 0; i < terms; ++i) {
            x[i] = q->right[a][i];
            for (int k = 0; k < i; ++k) x[i] -= q->matrix[i][k] * x[k];
            x[i] /= q->matrix[i][i];
        }
        for (int i = terms; i-- > 0;) {
            for (int k = i + 1; k < terms; ++k) x[i] -= q->matrix[k][i] * x[k];
            x[i] /= q->matrix[i][i];
        }
    }
}

double fit_sum(const double t[FIT_TERMS], const double term[FIT_TERMS])
{
    double sum = 0.0;
    for (int i = 0; i < FIT_TERMS; ++i) sum += t[i] * term[i];
    return sum;
}

double fit_distance(const mesh *m, const fit_cell *f, const wall_place *w)
{
    const double size = fit_length(w->area);
    double away = 0.0, finest = m->h[0];
    for (int a = 0; a < m->dim; ++a) {
        away -= w->area[a] / size * (f->centroid[a] - w->x[a]);
        finest = least(finest, m->h[a]);
    }
    return most(away, ICE_WALL_DISTANCE * finest);
}
