/* The condition of equal wall velocity on a grid line across the wall: pressure, normal velocity, slip, and the heat of the energy that is lost. */
#include "mpm/fluid/wetted.h"
#include "mpm/fluid/wetted_parts.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/node.h"

#include <math.h>

/* Nodes of a line with two velocities each, by their index in the list. */
typedef struct wetted_line {
    int n;
    int *member;
    double area[3]; /* m2 */
} wetted_line;

/* Change of the relative velocity per change of the fluid's, the solid getting the opposite impulse. */
static double recoil_of(const wetted_node *n)
{
    return 1.0 + n->mass[FLUID] / n->inertia[SOLID];
}

static void exchange_wall_impulse(wetted_node *n, const double impulse[3])
{
    for (int c = 0; c < 3; ++c) {
        n->v[FLUID][c] -= impulse[c] / n->mass[FLUID];
        n->v[SOLID][c] += impulse[c] / n->inertia[SOLID];
        n->taken[c] += impulse[c];
    }
}

/* One velocity for both. */
static void merge_node(wetted_node *n)
{
    for (int c = 0; c < 3 && isinf(n->inertia[SOLID]); ++c) {
        n->taken[c] += n->mass[FLUID] * (n->v[FLUID][c] - n->v[SOLID][c]);
        n->v[FLUID][c] = n->v[SOLID][c];
    }
    if (isinf(n->inertia[SOLID])) return;
    const double mass = n->mass[FLUID] + n->mass[SOLID];
    for (int c = 0; c < 3; ++c)
        n->v[FLUID][c] = n->v[SOLID][c] = (n->mass[FLUID] * n->v[FLUID][c] + n->mass[SOLID] * n->v[SOLID][c]) / mass;
}

/* Whether the solid of a line is so light that it goes with the fluid: its mass there says so, and that of the lightest solid. The masses
 * alone would where a surface lies just so between nodes. */
static bool is_light_wall(const mpm *s, const wetted_line *line)
{
    double mass[2] = {0.0}, density = 0.0;
    for (int k = 0; k < line->n; ++k) {
        const wetted_node *m = &s->wetted->node[line->member[k]];
        if (isinf(m->inertia[SOLID])) return false;
        const double size = sqrt(wetted_dot(m->area, m->area));
        for (int g = 0; g < 2; ++g) mass[g] += size * m->mass[g];
        density = fmax(density, m->mass[FLUID] / node_volume(s, s->wetted->fluid, m->at));
    }
    return mass[SOLID] < MPM_WALL_LIGHT * mass[FLUID] && s->wetted->density < MPM_WALL_LIGHT * density;
}

/* Merges nodes of a line that have almost none of one of the two, and drops them from the line. Where there is almost nothing of a body with a
 * motion the fluid goes on alone: the velocity of the whole body would be forced on it. */
static void merge_light_nodes(const mpm *s, wetted_line *line)
{
    mpm_wetted *w = s->wetted;
    double most = 0.0;
    int apart = 0;
    const bool light = is_light_wall(s, line);
    for (int k = 0; k < line->n; ++k) most = fmax(most, w->node[line->member[k]].mass[FLUID]);
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        const bool merged = light || m->mass[FLUID] < MPM_WALL_LEAST_NODE * most,
                   alone = m->mass[SOLID] < MPM_WALL_LEAST_NODE * m->mass[FLUID];
        if (merged || (alone && !isinf(m->inertia[SOLID]))) merge_node(m);
        if (merged || alone) continue;
        const int kept = line->member[k];
        line->member[k] = line->member[apart];
        line->member[apart++] = kept;
    }
    line->n = apart;
}

/* The nodes of the fluid lose the pressure force along N, and those of the solid get its reaction. With uniform
 * pressure these are the only forces. */
static void exchange_pressure(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->wetted;
    double push = 0.0, area = 0.0;
    for (int k = 0; k < line->n; ++k) {
        const wetted_node *m = &w->node[line->member[k]];
        push += wetted_dot(m->area, m->force);
        area += wetted_dot(m->area, m->area);
    }
    if (!(area > 0.0)) return;
    const double impulse = s->kick * push / area;
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        const double given[3] = {impulse * m->area[0], impulse * m->area[1], impulse * m->area[2]};
        exchange_wall_impulse(m, given);
    }
}

/* Removes the closing velocity, in proportion to areas and not to masses, by which the lightest node would take all of it. */
static void stop_closing(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->wetted;
    double closing = 0.0, ease = 0.0;
    for (int k = 0; k < line->n; ++k) {
        const wetted_node *m = &w->node[line->member[k]];
        for (int c = 0; c < 3; ++c) closing += m->area[c] * (m->v[FLUID][c] - m->v[SOLID][c]);
        ease += wetted_dot(m->area, m->area) * recoil_of(m);
    }
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        double given[3];
        for (int c = 0; c < 3; ++c) given[c] = m->mass[FLUID] * m->area[c] * closing / ease;
        exchange_wall_impulse(m, given);
    }
}

/* Share of the slip along a wall that is removed in a step: viscous fluids stick, others slip. Where damping brings the scene to rest it damps
 * slip as it does every motion: errors of sums over points under uniform pressure would otherwise drive gas along the wall for ever. */
static double ended_slip(const mpm *s)
{
    return s->wetted->viscous ? 1.0 : 1.0 - damping_left(s);
}

/* Removes the remaining relative velocity along the wall, also that of the mean of the line, by impulses in proportion to areas: of all that
 * end it they take the most energy. In proportion to areas of velocities instead they add some where light and heavy nodes slip in opposite
 * directions, and points that move along a wall swing up. */
static void stop_slip(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->wetted;
    const double ended = ended_slip(s);
    double slip[3] = {0.0}, ease = 0.0;
    if (!(ended > 0.0)) return;
    for (int k = 0; k < line->n; ++k) {
        const wetted_node *m = &w->node[line->member[k]];
        const double area2 = wetted_dot(m->area, m->area);
        for (int c = 0; c < 3; ++c) slip[c] += sqrt(area2) * (m->v[FLUID][c] - m->v[SOLID][c]);
        ease += area2 * recoil_of(m) / m->mass[FLUID];
    }
    const double along = wetted_dot(slip, line->area) / wetted_dot(line->area, line->area);
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        const double share = ended * sqrt(wetted_dot(m->area, m->area)) / ease;
        double given[3];
        for (int c = 0; c < 3; ++c) given[c] = share * (slip[c] - along * line->area[c]);
        exchange_wall_impulse(m, given);
    }
}

/* Whether the fluid lies along a wall there: its surface is about the face of a cell. */
static bool is_wall_node(const mpm *s, int root, const wetted_line *line)
{
    const double volume = node_volume(s, s->wetted->fluid, s->wetted->node[root].at),
                 size = sqrt(wetted_dot(line->area, line->area));
    int axis = 0;
    for (int a = 1; a < s->mesh->dim; ++a)
        if (fabs(line->area[a]) > fabs(line->area[axis])) axis = a;
    return size * s->mesh->h[axis] >= MPM_WALL_AREA * volume;
}

/* Where there is no wall, as about a solid thinner than a cell, nodes that solids fill have one velocity. */
static void merge_filled_nodes(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->wetted;
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        if (m->mass[SOLID] > MPM_WALL_FILL * w->density * node_volume(s, w->fluid, m->at)) merge_node(m);
    }
}

/* Kinetic energy (J) that a node has lost to its constraint: impulses times the means of the velocities before and
 * after the forces. Work on a solid with a prescribed or rigid motion is not a loss. */
static double lost_at(const wetted_node *n)
{
    double lost = 0.0;
    for (int g = 0; g < 2; ++g)
        for (int c = 0; c < 3; ++c) {
            const double impulse = n->v[g][c] - n->before[g][c] - n->gained[g][c];
            lost -= n->mass[g] * impulse * n->v[g][c];
        }
    for (int c = 0; c < 3 && isinf(n->inertia[SOLID]); ++c) lost -= n->taken[c] * n->v[SOLID][c];
    return lost;
}

/* The loss of a line is heat of its fluid, by mass. What it gains, by forces that were not smooth, is not taken from that heat, of which thin gas has little. */
static void share_loss(mpm_wetted *w, const wetted_line *line)
{
    double mass = 0.0, lost = 0.0;
    for (int k = 0; k < line->n; ++k) {
        mass += w->node[line->member[k]].mass[FLUID];
        lost += lost_at(&w->node[line->member[k]]);
    }
    for (int k = 0; k < line->n; ++k) w->node[line->member[k]].heat = fmax(lost, 0.0) / mass;
}

void wetted_constrain_line(const mpm *s, int root)
{
    mpm_wetted *w = s->wetted;
    wetted_line line = {.n = w->first[root + 1] - w->first[root], .member = w->member + w->first[root]};
    for (int k = 0; k < line.n; ++k)
        for (int c = 0; c < 3; ++c) line.area[c] += w->node[line.member[k]].area[c];
    const wetted_line whole = line;
    const bool wall = is_wall_node(s, root, &line);
    merge_light_nodes(s, &line);
    exchange_pressure(s, &line);
    if (!wall) {
        merge_filled_nodes(s, &line);
    } else if (line.n > 0) {
        stop_closing(s, &line);
        stop_slip(s, &line);
    }
    share_loss(w, &whole);
}

void wetted_constrain_lines(const mpm *s)
{
    for (int k = 0; k < s->wetted->n; ++k)
        if (s->wetted->node[k].root == k) wetted_constrain_line(s, k);
}
