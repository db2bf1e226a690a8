#include "coupling/exchange.h"

#include "coupling/coupling_constants.h"
#include "coupling/exchange_law.h"

#include <math.h>
#include <string.h>

const exchange_model *exchange_find(const char *name)
{
    for (size_t i = 0; i < exchange_registry_size; ++i)
        if (strcmp(exchange_registry[i]->name, name) == 0) return exchange_registry[i];
    return NULL;
}

/* The materials that take part: present and of finite mass. */
typedef struct present {
    int n;
    int index[EXCHANGE_MAX];
    double mass[EXCHANGE_MAX];
    double total; /* of the finite masses */
    double largest;
    int fixed; /* a material of infinite mass, or -1 */
} present;

/* Materials that are connected by couplings are solved for about their own centre of mass, the others beside them: what
 * is free of the rest must not lose its momentum in the rounding of a far heavier one. */
typedef struct parts {
    int n, of[EXCHANGE_MAX]; /* -1: absent */
} parts;

static parts find_parts(int n, const double *mass, exchange_matrix a)
{
    parts p = {0};
    int stack[EXCHANGE_MAX];
    for (int r = 0; r < n; ++r) p.of[r] = -1;
    for (int first = 0; first < n; ++first) {
        if (!(mass[first] > 0.0) || p.of[first] >= 0) continue;
        int depth = 0;
        p.of[first] = p.n;
        stack[depth++] = first;
        while (depth > 0) {
            const int r = stack[--depth];
            for (int s = 0; s < n; ++s) {
                if (!(mass[s] > 0.0) || p.of[s] >= 0 || !(a[r][s] > 0.0)) continue;
                p.of[s] = p.n;
                stack[depth++] = s;
            }
        }
        p.n++;
    }
    return p;
}

/* The materials of one group (find_parts), all of them where `part` is negative: which are free and which is prescribed. */
static present find_present(int n, const double *mass, const parts *all, int part)
{
    present p = {.fixed = -1};
    for (int r = 0; r < n; ++r) {
        if (part >= 0 && all->of[r] != part) continue;
        if (isinf(mass[r])) {
            p.fixed = r;
        } else if (mass[r] > 0.0) {
            p.index[p.n] = r;
            p.mass[p.n++] = mass[r];
            p.total += mass[r];
            p.largest = fmax(p.largest, mass[r]);
        }
    }
    return p;
}

void exchange_couple(int n, exchange_matrix coefficient, const double *theta, double factor_matrix, exchange_matrix a)
{
    for (int r = 0; r < n; ++r)
        for (int s = 0; s < n; ++s) a[r][s] = r == s ? 0.0 : factor_matrix * theta[r] * theta[s] * coefficient[r][s];
}

static double centre_of_mass(const present *p, const double *u)
{
    double sum = 0.0;
    for (int k = 0; k < p->n; ++k) sum += p->mass[k] * u[p->index[k]];
    return sum / p->total;
}

/* Lower triangle of diag(m) + A over the free materials, factored L D L^T in place without pivots: it is positive definite. */
static void factor_matrix(const present *p, exchange_matrix a, int n, const double *mass, exchange_matrix f)
{
    const double most = EXCHANGE_RIGID * p->largest;
    for (int i = 0; i < p->n; ++i) {
        const int r = p->index[i];
        double row = p->mass[i];
        for (int s = 0; s < n; ++s)
            if (s != r && mass[s] > 0.0) row += fmin(a[r][s], most);
        f[i][i] = row;
        for (int k = 0; k < i; ++k) f[i][k] = -fmin(a[r][p->index[k]], most);
    }
    for (int j = 0; j < p->n; ++j) {
        for (int k = 0; k < j; ++k) f[j][j] -= f[j][k] * f[j][k] * f[k][k];
        for (int i = j + 1; i < p->n; ++i) {
            for (int k = 0; k < j; ++k) f[i][j] -= f[i][k] * f[k][k] * f[j][k];
            f[i][j] /= f[j][j];
        }
    }
}

static void substitute_back(int n, exchange_matrix f, double *y)
{
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < i; ++k) y[i] -= f[i][k] * y[k];
    for (int i = 0; i < n; ++i) y[i] /= f[i][i];
    for (int i = n - 1; i >= 0; --i)
        for (int k = i + 1; k < n; ++k) y[i] -= f[k][i] * y[k];
}

/* Deviations y from `reference`, of (diag(m) + A) y = m (u - reference) + sum over prescribed s of a_rs (u_s - reference). */
static void relax_column(const present *p, exchange_matrix a, exchange_matrix f, int n, const double *mass, double *u)
{
    const double reference = p->fixed >= 0 ? u[p->fixed] : centre_of_mass(p, u);
    const double most = EXCHANGE_RIGID * p->largest;
    double y[EXCHANGE_MAX];
    for (int i = 0; i < p->n; ++i) {
        y[i] = p->mass[i] * (u[p->index[i]] - reference);
        for (int s = 0; s < n; ++s)
            if (isinf(mass[s])) y[i] += fmin(a[p->index[i]][s], most) * (u[s] - reference);
    }
    substitute_back(p->n, f, y);
    double drift = 0.0;
    for (int i = 0; i < p->n; ++i) drift += p->mass[i] * y[i];
    drift = p->fixed >= 0 ? 0.0 : drift / p->total;
    for (int i = 0; i < p->n; ++i) u[p->index[i]] = reference + (y[i] - drift);
}

static void fill_absent(const present *p, int n, const double *mass, double *u)
{
    if (p->n == 0 && p->fixed < 0) return;
    const double mean = p->fixed >= 0 ? u[p->fixed] : centre_of_mass(p, u);
    for (int r = 0; r < n; ++r)
        if (!(mass[r] > 0.0)) u[r] = mean;
}

/* Relaxes the materials of one group: two free ones in closed form, more by the factored matrix. */
static void relax_part(const present *p, int n, const double *mass, exchange_matrix a, int columns,
                       double value[][EXCHANGE_MAX])
{
    const bool pair = p->n == 2 && p->fixed < 0;
    exchange_matrix f;
    exchange_two two = {0};
    if (p->n == 0 || p->n + (p->fixed >= 0) < 2) return;
    if (pair)
        two = exchange_of_two(p->mass[0], p->mass[1], a[p->index[0]][p->index[1]]);
    else
        factor_matrix(p, a, n, mass, f);
    for (int c = 0; c < columns; ++c) {
        if (pair)
            exchange_relax_two(two, &value[c][p->index[0]], &value[c][p->index[1]]);
        else
            relax_column(p, a, f, n, mass, value[c]);
    }
}

void exchange_relax(int n, const double *mass, exchange_matrix a, int columns, double value[][EXCHANGE_MAX])
{
    const parts all = find_parts(n, mass, a);
    for (int part = 0; part < all.n; ++part) {
        const present p = find_present(n, mass, &all, part);
        relax_part(&p, n, mass, a, columns, value);
    }
    const present p = find_present(n, mass, &all, -1);
    for (int c = 0; c < columns; ++c) fill_absent(&p, n, mass, value[c]);
}

/* Reflects vectors so that the normal and the first axis change places; twice is the identity. */
static void reflect_normal_to_axis(int n, int dim, const double *normal, double u[3][EXCHANGE_MAX])
{
    double w[3] = {normal[0], 0.0, 0.0}, square = 0.0;
    const double sign = normal[0] > 0.0 ? -1.0 : 1.0; /* to -e_0 or +e_0, whichever is further away */
    for (int a = 1; a < dim; ++a) w[a] = normal[a];
    w[0] -= sign;
    for (int a = 0; a < dim; ++a) square += w[a] * w[a];
    for (int r = 0; r < n; ++r) {
        double along = 0.0;
        for (int a = 0; a < dim; ++a) along += w[a] * u[a][r];
        for (int a = 0; a < dim; ++a) u[a][r] -= 2.0 * along / square * w[a];
    }
}

void exchange_relax_frame(int n, const double *mass, const double *theta, bool unlike, exchange_matrix a,
                          exchange_matrix tangential, int dim, const double *normal, double u[3][EXCHANGE_MAX])
{
    reflect_normal_to_axis(n, dim, normal, u);
    if (unlike)
        exchange_relax_parts(n, mass, theta, a, 1, u);
    else
        exchange_relax(n, mass, a, 1, u);
    exchange_relax_parts(n, mass, theta, tangential, dim - 1, u + 1);
    reflect_normal_to_axis(n, dim, normal, u);
}
