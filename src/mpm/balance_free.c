/* Whether what hangs together could move as a rigid body: then no displacement balances its loads. */
#include "base/memory.h"
#include "math/tensor.h"
#include "mpm/balance.h"

#include <math.h>
#include <string.h>

enum { MOTIONS = 6 };
/* A rigid motion of which the matrix makes less than this share of what its diagonal would is free. */
static const double hardly = 1e-9;

/* Components of the nodes' graph: the lowest row that each hangs together with. */
static int root_of(const int *parent, int row)
{
    while (parent[row] != row) row = parent[row];
    return row;
}

static void join_rows(const node_matrix *m, int *parent)
{
    for (int row = 0; row < m->rows; ++row) parent[row] = row;
    for (int row = 0; row < m->rows; ++row)
        for (int slot = 0; slot < m->slots; ++slot) {
            const int other = m->row[m->column[(size_t)row * (size_t)m->slots + (size_t)slot]];
            bool coupled = false;
            for (int c = 0; c < m->components; ++c) coupled = coupled || node_matrix_entries(m, row, c, c)[slot] != 0.0;
            if (!coupled) continue;
            const int a = root_of(parent, row), b = root_of(parent, other);
            parent[a > b ? a : b] = a > b ? b : a;
        }
    for (int row = 0; row < m->rows; ++row) parent[row] = root_of(parent, row);
}

static void node_place(const mpm *s, int place, double x[3])
{
    const solve_grid *g = &s->balance->grid;
    int rest = place - (int)g->origin;
    for (int a = MESH_MAX_DIM - 1; a >= 0; --a) {
        x[a] = 0.0;
        if (a >= g->dim) continue;
        const int i = rest / (int)g->stride[a];
        rest -= i * (int)g->stride[a];
        x[a] = mesh_node(s->mesh, a, i);
    }
}

/* Motions of the scene: along its axes, then about them. Returns how many. */
static int count_motions(const mpm *s)
{
    if (s->mesh->dim == 1) return 1;
    if (s->mesh->geometry == MESH_AXISYMMETRIC) return 1; /* along the axis */
    return s->mesh->dim == 2 ? 3 : MOTIONS;
}

/* The displacement of a rigid motion, of a unit over the domain; what is held stays, and so do other parts. */
static void set_motion(const mpm *s, const int *part, int root, int motion, double *z)
{
    const struct mpm_balance *w = s->balance;
    const node_matrix *m = node_multigrid_matrix(w->solver);
    const int dim = s->mesh->dim;
    memset(z, 0, w->components * sizeof *z);
    for (int row = 0; row < m->rows; ++row) {
        if (part[row] != root) continue;
        double x[3], value[3] = {0.0, 0.0, 0.0};
        node_place(s, m->place[row], x);
        if (s->mesh->geometry == MESH_AXISYMMETRIC) {
            value[1] = 1.0;
        } else if (motion < dim) {
            value[motion] = 1.0;
        } else {
            double axis[3] = {0.0, 0.0, 0.0}, arm[3] = {0.0, 0.0, 0.0};
            axis[dim == 2 ? 2 : motion - dim] = 1.0;
            for (int a = 0; a < dim; ++a)
                arm[a] =
                    (x[a] - 0.5 * (s->mesh->lower[a] + s->mesh->upper[a])) / (s->mesh->upper[0] - s->mesh->lower[0]);
            vec_cross(axis, arm, value);
        }
        for (int c = 0; c < dim; ++c) {
            const size_t at = (size_t)c * w->grid.size + (size_t)m->place[row];
            if (!w->held[at]) z[at] = value[c];
        }
    }
}

/* Sums over the rows of a part of x y, and of x y times the diagonal. */
static double dot_rows(const mpm *s, const double *x, const double *y, bool diagonal)
{
    const node_matrix *m = node_multigrid_matrix(s->balance->solver);
    double sum = 0.0;
    for (int row = 0; row < m->rows; ++row)
        for (int c = 0; c < m->components; ++c) {
            const size_t at = (size_t)c * m->grid.size + (size_t)m->place[row];
            sum += x[at] * y[at] * (diagonal ? node_matrix_entries(m, row, c, c)[m->slots / 2] : 1.0);
        }
    return sum;
}

/* Whether some mix of the motions makes next to no force: the smallest pivot of their stiffness after those before are taken out. */
static bool moves_freely(int n, double A[MOTIONS][MOTIONS], const double *scale)
{
    for (int j = 0; j < n; ++j) {
        if (!(scale[j] > 0.0)) continue; /* held throughout */
        if (A[j][j] <= hardly * scale[j]) return true;
        for (int i = j + 1; i < n; ++i)
            for (int k = j + 1; k < n; ++k) A[i][k] -= A[i][j] * A[j][k] / A[j][j];
    }
    return false;
}

static floe_status check_part(mpm *s, const int *part, int root, double *z[MOTIONS], double *force)
{
    const struct mpm_balance *w = s->balance;
    const node_matrix *m = node_multigrid_matrix(w->solver);
    const int n = count_motions(s);
    double A[MOTIONS][MOTIONS], scale[MOTIONS], x[3];
    for (int i = 0; i < n; ++i) set_motion(s, part, root, i, z[i]);
    for (int i = 0; i < n; ++i) {
        node_matrix_apply(m, z[i], force);
        scale[i] = dot_rows(s, z[i], z[i], true);
        for (int j = 0; j < n; ++j) A[i][j] = dot_rows(s, z[j], force, false);
    }
    if (!moves_freely(n, A, scale)) return FLOE_OK;
    node_place(s, m->place[root], x);
    return fail(s->ctx, FLOE_DIVERGED,
                "there is no static answer: the body at about (%g, %g, %g) is free to move as a rigid one; hold it by "
                "walls, symmetry or supports, or use `time.solver: dynamic`",
                x[0], x[1], x[2]);
}

static floe_status check_parts(mpm *s, int *part, double *z[MOTIONS], double *force)
{
    const node_matrix *m = node_multigrid_matrix(s->balance->solver);
    join_rows(m, part);
    for (int row = 0; row < m->rows; ++row)
        if (part[row] == row && node_matrix_entries(m, row, 0, 0)[m->slots / 2] > 0.0)
            TRY(check_part(s, part, row, z, force));
    return FLOE_OK;
}

floe_status balance_check_free(mpm *s)
{
    const node_matrix *m = node_multigrid_matrix(s->balance->solver);
    int *part = NULL;
    double *z[MOTIONS] = {NULL}, *force = NULL;
    floe_status status = memory_new(s->ctx, &part, (size_t)m->rows, sizeof *part);
    for (int k = 0; k < MOTIONS && status == FLOE_OK; ++k)
        status = memory_new(s->ctx, &z[k], s->balance->components, sizeof **z);
    if (status == FLOE_OK) status = memory_new(s->ctx, &force, s->balance->components, sizeof *force);
    if (status == FLOE_OK) status = check_parts(s, part, z, force);
    memory_free(s->ctx, &part);
    for (int k = 0; k < MOTIONS; ++k) memory_free(s->ctx, &z[k]);
    memory_free(s->ctx, &force);
    return status;
}
