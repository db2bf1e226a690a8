/* Volumes of nodes: integrals of their shape functions, cut by sides and by the axis. */
#include "mpm/nodes/node.h"
#include "mpm/nodes/sides.h"

/* Volume of a node's shape function along an axis in cells. The first ghost has a share of what is inside the mesh: the wall's own fold
 * gives twice as much to the node on the wall and takes it of the next. */
static double node_share_along(const mpm *s, int group, int axis, int node)
{
    if (s->mesh->periodic[axis]) return 1.0;
    const int side = 2 * node > s->mesh->n[axis] ? SIDE_UPPER : SIDE_LOWER;
    const int in = side == SIDE_UPPER ? s->mesh->n[axis] - node : node;
    if (in > 1) return 1.0;
    if (wall_mirrors(s, group, axis, side)) return in == 0 ? 0.5 : 1.0;
    const double ghost = s->basis->fact.ghost_share;
    return in == 0 ? 0.5 + 2.0 * ghost : 1.0 - 2.0 * ghost;
}

double node_volume(const mpm *s, int group, const int at[MESH_MAX_DIM])
{
    double volume = 1.0;
    const double r = mesh_node(s->mesh, 0, at[0]), h = s->mesh->h[0];
    for (int a = 0; a < s->mesh->dim; ++a) volume *= s->mesh->h[a] * node_share_along(s, group, a, at[a]);
    if (s->mesh->geometry != MESH_AXISYMMETRIC) return volume;
    return r > 0.5 * h ? volume * r : volume / 0.5 * s->basis->fact.axis_moment * h;
}
