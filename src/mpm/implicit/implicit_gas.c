/* Gas on cells at rest beside solids (sim/quasi_static_gas.h): enclosed gases without points. Where gas and solids
 * share cells its pressure p acts as in the coupled step, in which points have the force p grad theta:
 *
 *     f_i = - p sum_p V_p grad S_i(x_p)
 *
 * at the nodes in the support of the gas; inside a solid the sum vanishes. Where embedded boundaries cut the cells, the
 * pressure acts on their markers. */
#include "base/memory.h"
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_constants.h"

#include <math.h>
#include <string.h>

floe_status enclosed_gases_from_cells(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    if (!s->gas) return FLOE_OK;
    for (int r = w->n_gases; r < s->n_gases; ++r) {
        TRY(memory_resize(s->ctx, &w->gas_set, (size_t)r + 1, sizeof *w->gas_set));
        w->gas_set[r] = (enclosed_gas){.body = -1};
        w->n_gases = r + 1;
        TRY(memory_new(s->ctx, &w->gas_set[r].unit_force, w->components, sizeof *w->gas_set[r].unit_force));
    }
    for (int r = s->n_gases; r < w->n_gases; ++r) {
        memory_free(s->ctx, &w->gas_set[r].unit_force);
        memory_free(s->ctx, &w->gas_set[r].marker_force);
    }
    w->n_gases = s->n_gases;
    return FLOE_OK;
}

enum { NO_GAS = -1 };

/* Share of the integral of a node's shape function along an axis that lies in the n-th cell above it; for B-splines,
 * and GIMP is treated as one. */
static double cell_share_along(int support, int n)
{
    const int cell = n < 0 ? -1 - n : n;
    const double external = support < 3 ? 0.0 : support == 3 ? 1.0 / 48.0 : 1.0 / 24.0;
    return cell == 0 ? 0.5 - external : external;
}

/* The two gases of which a node's function reaches most, and the shares of it that lie in their cells. */
typedef struct gas_view {
    int gas[2];
    double share[2];
} gas_view;

static void add_gas_share(gas_view *v, int gas, double share)
{
    const int k = gas == v->gas[0] || v->gas[0] == NO_GAS ? 0 : 1;
    v->gas[k] = gas;
    v->share[k] += share;
}

static gas_view see_gas(const mpm *s, const int node[MESH_MAX_DIM])
{
    const mesh *m = s->mesh;
    const int support = s->basis->support, reach = (support + 1) / 2;
    int lo[MESH_MAX_DIM] = {0, 0, 0}, hi[MESH_MAX_DIM] = {1, 1, 1}, n[MESH_MAX_DIM];
    gas_view v = {{NO_GAS, NO_GAS}, {0.0, 0.0}};
    for (int a = 0; a < m->dim; ++a) {
        lo[a] = -reach;
        hi[a] = reach;
    }
    for (n[2] = lo[2]; n[2] < hi[2]; ++n[2])
        for (n[1] = lo[1]; n[1] < hi[1]; ++n[1])
            for (n[0] = lo[0]; n[0] < hi[0]; ++n[0]) {
                int at[MESH_MAX_DIM] = {0, 0, 0};
                bool inside = true;
                double share = 1.0;
                for (int a = 0; a < m->dim; ++a) {
                    at[a] = mesh_index_around(m, a, node[a] + n[a]);
                    inside = inside && at[a] >= 0 && at[a] < m->n[a];
                    share *= cell_share_along(support, n[a]);
                }
                const int found = inside ? s->gas_of[at[0] + m->n[0] * (at[1] + m->n[1] * at[2])] : NO_GAS;
                if (found != NO_GAS) add_gas_share(&v, found, share);
            }
    return v;
}

/* Of a node that reaches two gases one must be next to nothing, or their pressure the same. */
static bool tells_apart(const mpm *s, const gas_view *v)
{
    if (v->gas[1] == NO_GAS || !(fmin(v->share[0], v->share[1]) > MPM_TWO_GASES_SHARE)) return true;
    const mpm_gas *gas[2] = {&s->gas[v->gas[0]], &s->gas[v->gas[1]]};
    return gas[0]->open && gas[1]->open && gas[0]->prescribed_pressure == gas[1]->prescribed_pressure;
}

static floe_status too_thin(const mpm *s, const int node[MESH_MAX_DIM])
{
    double x[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = mesh_node(s->mesh, a, node[a]);
    return fail_key(s->ctx, KEY("time", "solver"),
                    "static: the solid at about (%g, %g, %g) is too thin for its nodes to tell the gases of "
                    "its two sides apart: refine domain.cell, or use method.interface: sharp",
                    x[0], x[1], x[2]);
}

/* Stores the volume gradients of the nodes beside a gas as its unit forces. */
static floe_status share_squeeze(mpm *s, const double *squeeze)
{
    struct mpm_implicit *w = s->implicit;
    int node[MESH_MAX_DIM];
    for (node[2] = 0; node[2] < w->grid.n[2]; ++node[2])
        for (node[1] = 0; node[1] < w->grid.n[1]; ++node[1])
            for (node[0] = 0; node[0] < w->grid.n[0]; ++node[0]) {
                const size_t at = (size_t)solve_index(&w->grid, node[0], node[1], node[2]);
                if (!w->row[at]) continue;
                const gas_view v = see_gas(s, node);
                const int gas = v.gas[v.share[1] > v.share[0]];
                if (gas == NO_GAS) continue;
                if (!tells_apart(s, &v)) return too_thin(s, node);
                for (int c = 0; c < s->mesh->dim; ++c) {
                    const size_t k = (size_t)c * w->grid.size + at;
                    w->gas_set[gas].unit_force[k] = squeeze[k];
                }
            }
    return FLOE_OK;
}

floe_status enclosed_gases_smear(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    if (!s->gas || s->n_gases == 0 || s->gas[0].unit_force) return FLOE_OK;
    for (int r = 0; r < w->n_gases; ++r)
        memset(w->gas_set[r].unit_force, 0, w->components * sizeof *w->gas_set[r].unit_force);
    memset(w->trial, 0, w->components * sizeof *w->trial);
    implicit_volume_gradient(s, w->trial);
    return share_squeeze(s, w->trial);
}
