/* Whether what is connected could move as a rigid body: then no displacement balances its loads. */
#include "base/memory.h"
#include "math/tensor.h"
#include "mpm/implicit/implicit_constants.h"
#include "mpm/implicit/implicit_contact.h"

#include <math.h>
#include <string.h>

enum { MOTIONS = 6 };
/* What the motions are looked at with. A unit is a layer of a row: row times layers plus layer. */
typedef struct free_search {
    int *part; /* of each unit: the lowest one that it is connected with */
    double *z[MOTIONS], *force;
} free_search;

static int root_of(int *parent, int unit)
{
    while (parent[unit] != unit) unit = parent[unit] = parent[parent[unit]];
    return unit;
}

/* Whether the matrix couples a displacement field of a row with one of the row at a slot. */
static bool couples_layers(const node_matrix *m, int row, int slot, int layer, int other)
{
    const int dim = m->grid.dim;
    for (int c = 0; c < dim; ++c)
        for (int c2 = 0; c2 < dim; ++c2)
            if (node_matrix_entries(m, row, layer * dim + c, other * dim + c2)[slot] != 0.0) return true;
    return false;
}

/* Joins units that the matrix couples; `across`: those of different layers too. */
static void join_units(const node_matrix *m, int layers, bool across, int *parent)
{
    const int units = m->rows * layers;
    for (int unit = 0; unit < units; ++unit) parent[unit] = unit;
    for (int unit = 0; unit < units; ++unit)
        for (int slot = 0; slot < m->slots; ++slot) {
            const int row = unit / layers;
            const int other = m->row[m->column[(size_t)row * (size_t)m->slots + (size_t)slot]];
            for (int l = 0; l < layers; ++l) {
                if ((!across && l != unit % layers) || !couples_layers(m, row, slot, unit % layers, l)) continue;
                const int a = root_of(parent, unit), b = root_of(parent, other * layers + l);
                parent[a > b ? a : b] = a > b ? b : a;
            }
        }
    for (int unit = 0; unit < units; ++unit) parent[unit] = root_of(parent, unit);
}

static void node_place(const mpm *s, int place, double x[3])
{
    const solve_grid *g = &s->implicit->grid;
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

/* The displacement of a rigid motion, of size one over the domain; constrained components and other parts do not
 * move. */
static void set_motion(const mpm *s, const int *part, int root, int motion, double *z)
{
    const struct mpm_implicit *w = s->implicit;
    const node_matrix *m = multigrid_matrix(w->solver);
    const int dim = s->mesh->dim;
    memset(z, 0, w->components * sizeof *z);
    for (int unit = 0; unit < m->rows * w->layers; ++unit) {
        if (part[unit] != root) continue;
        const int row = unit / w->layers;
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
            const size_t at = implicit_index(w, unit % w->layers, c, m->place[row]);
            if (!w->constrained[at]) z[at] = value[c];
        }
    }
    implicit_contact_project(s, z);
}

/* Sums over the rows of a part of x y, and of x y times the diagonal. */
static double dot_rows(const mpm *s, const double *x, const double *y, bool diagonal)
{
    const node_matrix *m = multigrid_matrix(s->implicit->solver);
    double sum = 0.0;
    for (int row = 0; row < m->rows; ++row)
        for (int c = 0; c < m->components; ++c) {
            const size_t at = (size_t)c * m->grid.size + (size_t)m->place[row];
            sum += x[at] * y[at] * (diagonal ? node_matrix_entries(m, row, c, c)[m->slots / 2] : 1.0);
        }
    return sum;
}

/* Whether some combination of the motions has almost no stiffness: the smallest pivot of their stiffness matrix. */
static bool moves_freely(int n, double A[MOTIONS][MOTIONS], const double *scale)
{
    for (int j = 0; j < n; ++j) {
        if (!(scale[j] > 0.0)) continue; /* constrained in all components */
        if (A[j][j] <= MPM_RIGID_STIFFNESS * scale[j]) return true;
        for (int i = j + 1; i < n; ++i)
            for (int k = j + 1; k < n; ++k) A[i][k] -= A[i][j] * A[j][k] / A[j][j];
    }
    return false;
}

static floe_status check_part(mpm *s, const free_search *f, int root)
{
    const struct mpm_implicit *w = s->implicit;
    const node_matrix *m = multigrid_matrix(w->solver);
    const int n = count_motions(s);
    double A[MOTIONS][MOTIONS], scale[MOTIONS], x[3];
    for (int i = 0; i < n; ++i) set_motion(s, f->part, root, i, f->z[i]);
    for (int i = 0; i < n; ++i) {
        node_matrix_apply(m, f->z[i], f->force);
        scale[i] = dot_rows(s, f->z[i], f->z[i], true);
        for (int j = 0; j < n; ++j) A[i][j] = dot_rows(s, f->z[j], f->force, false);
    }
    if (!moves_freely(n, A, scale)) return FLOE_OK;
    node_place(s, m->place[root / w->layers], x);
    return fail(
        s->ctx, FLOE_DIVERGED,
        "there is no static answer: the body at about (%g, %g, %g) is free to move as a rigid one; constrain it by "
        "walls, symmetry or supports, or use `time.solver: dynamic`",
        x[0], x[1], x[2]);
}

/* Each body by itself, against others that stay; and what is connected by contacts. */
static floe_status check_parts(mpm *s, const free_search *f)
{
    const node_matrix *m = multigrid_matrix(s->implicit->solver);
    const int layers = s->implicit->layers;
    for (int across = 0; across < (layers > 1 ? 2 : 1); ++across) {
        join_units(m, layers, across == 1, f->part);
        for (int unit = 0; unit < m->rows * layers; ++unit)
            if (f->part[unit] == unit && couples_layers(m, unit / layers, m->slots / 2, unit % layers, unit % layers))
                TRY(check_part(s, f, unit));
    }
    return FLOE_OK;
}

floe_status implicit_check_rigid_motions(mpm *s)
{
    const node_matrix *m = multigrid_matrix(s->implicit->solver);
    free_search f = {.part = NULL};
    floe_status status = memory_new(s->ctx, &f.part, (size_t)m->rows * (size_t)s->implicit->layers, sizeof *f.part);
    for (int k = 0; k < MOTIONS && status == FLOE_OK; ++k)
        status = memory_new(s->ctx, &f.z[k], s->implicit->components, sizeof **f.z);
    if (status == FLOE_OK) status = memory_new(s->ctx, &f.force, s->implicit->components, sizeof *f.force);
    if (status == FLOE_OK) status = check_parts(s, &f);
    memory_free(s->ctx, &f.part);
    for (int k = 0; k < MOTIONS; ++k) memory_free(s->ctx, &f.z[k]);
    memory_free(s->ctx, &f.force);
    return status;
}
