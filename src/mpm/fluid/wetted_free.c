/* Free rigid bodies in fluid points (theory 4.17). Lines give the nodes of a body impulses, and the fluid the velocity of these nodes. If each
 * node recoiled with its own mass alone the fluid would see a wall that moves by p dt over that mass in each step, and compress less than the
 * body moves: an error of the order of the step, that does not fall with h. So lines see a wall of no end of inertia, whose velocity is found
 * first. They are linear in it: a trial without a change gives the load, one for each degree of freedom what is taken from it. */
#include "mpm/fluid/wetted.h"
#include "mpm/fluid/wetted_parts.h"

#include "base/memory.h"
#include "math/small_solve.h"
#include "mpm/motion/motion.h"
#include "mpm/nodes/node.h"

#include <string.h>

static floe_status keep_nodes(mpm *s)
{
    mpm_wetted *w = s->wetted;
    if (w->kept_reserved < w->n) {
        TRY(memory_resize(s->ctx, &w->kept, (size_t)w->reserved, sizeof *w->kept));
        w->kept_reserved = w->reserved;
    }
    memcpy(w->kept, w->node, (size_t)w->n * sizeof *w->kept);
    return FLOE_OK;
}

static void restore_nodes(mpm_wetted *w)
{
    memcpy(w->node, w->kept, (size_t)w->n * sizeof *w->node);
}

/* The velocity at a node of the body by a unit of a degree of freedom. */
static void unit_at(const mpm *s, const body_motion *m, const wetted_node *n, int dof, double v[3])
{
    double x[3], r[3];
    place_of_node(s->mesh, n->at, x);
    for (int a = 0; a < 3; ++a) r[a] = x[a] - m->now.c[a];
    motion_unit(dof, r, v);
    for (int a = s->mesh->dim; a < 3; ++a) v[a] = 0.0;
}

/* A fluid at rest without pressure, and the body moves by a unit of a degree of freedom. */
static void set_unit(const mpm *s, int group, int dof)
{
    mpm_wetted *w = s->wetted;
    for (int k = 0; k < w->n; ++k) {
        wetted_node *n = &w->node[k];
        memset(n->force, 0, sizeof n->force);
        memset(n->v, 0, sizeof n->v);
        if (n->solid == group) unit_at(s, motion_of_group(s, group), n, dof, n->v[SOLID]);
    }
}

/* Lines as they are set, what they give the body, and the nodes as they were. */
static void try_lines(const mpm *s, int group, double given[MOTION_DOFS])
{
    mpm_wetted *w = s->wetted;
    const body_motion *m = motion_of_group(s, group);
    memset(given, 0, MOTION_DOFS * sizeof *given);
    wetted_constrain_lines(s);
    for (int k = 0; k < w->n; ++k) {
        if (w->node[k].solid != group) continue;
        for (int d = 0; d < MOTION_DOFS; ++d) {
            double unit[3];
            if (!motion_is_free(m, d)) continue;
            unit_at(s, m, &w->node[k], d, unit);
            given[d] += wetted_dot(unit, w->node[k].taken);
        }
    }
    restore_nodes(w);
}

/* The change of the body's motion with which it has what the lines then give it. */
static void find_change(const mpm *s, int group, double change[MOTION_DOFS])
{
    const body_motion *m = motion_of_group(s, group);
    double A[MOTION_DOFS * MOTION_DOFS], b[MOTION_DOFS], load[MOTION_DOFS], taken[MOTION_DOFS];
    int dof[MOTION_DOFS], n = 0;
    memset(change, 0, MOTION_DOFS * sizeof *change);
    for (int d = 0; d < MOTION_DOFS; ++d)
        if (motion_is_free(m, d)) dof[n++] = d;
    if (n == 0) return;
    try_lines(s, group, load);
    for (int j = 0; j < n; ++j) {
        set_unit(s, group, dof[j]);
        try_lines(s, group, taken);
        for (int i = 0; i < n; ++i) A[n * i + j] = motion_inertia(m, dof[i], dof[j]) - taken[dof[i]];
    }
    for (int i = 0; i < n; ++i) b[i] = load[dof[i]];
    if (!small_solve_general(n, A, b)) return;
    for (int i = 0; i < n; ++i) change[dof[i]] = b[i];
}

floe_status wetted_move_free(mpm *s)
{
    mpm_wetted *w = s->wetted;
    for (int g = s->n_deforming_groups; g < s->n_groups; ++g) {
        double change[MOTION_DOFS], unit[3];
        if (motion_prescribes_group(s, g)) continue;
        TRY(keep_nodes(s));
        find_change(s, g, change);
        for (int k = 0; k < w->n; ++k)
            for (int d = 0; d < MOTION_DOFS && w->node[k].solid == g; ++d) {
                unit_at(s, motion_of_group(s, g), &w->node[k], d, unit);
                for (int a = 0; a < 3; ++a) w->node[k].v[SOLID][a] += change[d] * unit[a];
            }
    }
    return FLOE_OK;
}
