/* One velocity of the wall for fluid and solid nodes of a line across it: pressures, closing, slip, and the heat that this gives. */
#include "mpm/wetted_parts.h"

#include <math.h>

/* A line whose areas sum to less than this share of a cell's face is not a wall along which a fluid lies. */
static const double least_area = 0.3;
/* Nodes that solids fill less hold nothing where there is no wall to speak of. */
static const double least_fill = 0.1;
/* Nodes with less of a line's heaviest share of fluid, or with less solid than this many times their fluid, have one velocity: forces on
 * next to no mass of one of the two would throw the points that see the node's gradient. */
static const double least_fluid = 0.01, least_solid = 5.0;

/* Nodes of a line that move apart, by their positions in the list. */
typedef struct wetted_line {
    int n;
    int *member;
    double area[3]; /* m2 */
} wetted_line;

/* What a velocity that the fluid's node loses takes of the relative one, the solid's gaining the impulse. */
static double recoil_of(const wetted_node *n)
{
    return 1.0 + n->mass[FLUID] / n->mass[SOLID];
}

static void push_apart(wetted_node *n, const double impulse[3])
{
    for (int c = 0; c < 3; ++c) {
        n->v[FLUID][c] -= impulse[c] / n->mass[FLUID];
        n->v[SOLID][c] += impulse[c] / n->mass[SOLID];
    }
}

/* One velocity for both. */
static void join_node(wetted_node *n)
{
    const double mass = n->mass[FLUID] + n->mass[SOLID];
    for (int c = 0; c < 3; ++c)
        n->v[FLUID][c] = n->v[SOLID][c] = (n->mass[FLUID] * n->v[FLUID][c] + n->mass[SOLID] * n->v[SOLID][c]) / mass;
}

/* Merges nodes of a line with too little area of one of the two into its members and drops them from the line. */
static void join_slivers(const mpm *s, wetted_line *line)
{
    mpm_wetted *w = s->work->wetted;
    double most = 0.0;
    int apart = 0;
    for (int k = 0; k < line->n; ++k) most = fmax(most, w->node[line->member[k]].mass[FLUID]);
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        if (m->mass[FLUID] < least_fluid * most || m->mass[SOLID] < least_solid * m->mass[FLUID]) {
            join_node(m);
            continue;
        }
        const int kept = line->member[k];
        line->member[k] = line->member[apart];
        line->member[apart++] = kept;
    }
    line->n = apart;
}

/* The nodes of the fluid lose the pressure force along N, and those of the solid get its reaction. With uniform
 * pressure these are the only forces. */
static void bear_pressure(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->work->wetted;
    double push = 0.0, area = 0.0;
    for (int k = 0; k < line->n; ++k) {
        const wetted_node *m = &w->node[line->member[k]];
        push += wetted_dot(m->area, m->force);
        area += wetted_dot(m->area, m->area);
    }
    if (!(area > 0.0)) return;
    const double impulse = s->work->kick * push / area;
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        const double given[3] = {impulse * m->area[0], impulse * m->area[1], impulse * m->area[2]};
        push_apart(m, given);
    }
}

/* Ends the closing. By the nodes' areas and not by their masses: the lightest would take all of it, and go far. */
static void stop_closing(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->work->wetted;
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
        push_apart(m, given);
    }
}

/* Removes the remaining relative velocity along the wall, also that of the mean of the line. */
static void stop_slip(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->work->wetted;
    double slip[3] = {0.0}, ease = 0.0;
    for (int k = 0; k < line->n; ++k) {
        const wetted_node *m = &w->node[line->member[k]];
        const double size = sqrt(wetted_dot(m->area, m->area));
        for (int c = 0; c < 3; ++c) slip[c] += size * (m->v[FLUID][c] - m->v[SOLID][c]);
        ease += size * size * recoil_of(m);
    }
    const double along = wetted_dot(slip, line->area) / wetted_dot(line->area, line->area);
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        const double share = m->mass[FLUID] * sqrt(wetted_dot(m->area, m->area)) / ease;
        double given[3];
        for (int c = 0; c < 3; ++c) given[c] = share * (slip[c] - along * line->area[c]);
        push_apart(m, given);
    }
}

/* Whether the fluid lies along a wall there: its surface is about the face of a cell. */
static bool is_wall(const mpm *s, int root, const wetted_line *line)
{
    const double volume = node_volume(s, s->work->wetted->fluid, s->work->wetted->node[root].at),
                 size = sqrt(wetted_dot(line->area, line->area));
    int axis = 0;
    for (int a = 1; a < s->mesh->dim; ++a)
        if (fabs(line->area[a]) > fabs(line->area[axis])) axis = a;
    return size * s->mesh->h[axis] >= least_area * volume;
}

/* Where there is no wall to speak of, as about a solid thinner than a cell, nodes that solids fill hold the fluid. */
static void join_nodes(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->work->wetted;
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        if (m->mass[SOLID] > least_fill * w->density * node_volume(s, w->fluid, m->at)) join_node(m);
    }
}

/* Kinetic energy (J) that a node has lost to its constraint: impulses times the means of the velocities before and
 * after the forces. */
static double lost_at(const wetted_node *n)
{
    double lost = 0.0;
    for (int g = 0; g < 2; ++g)
        for (int c = 0; c < 3; ++c) {
            const double impulse = n->v[g][c] - n->before[g][c] - n->gained[g][c];
            lost -= n->mass[g] * impulse * n->v[g][c];
        }
    return lost;
}

/* What a line has lost is heat of its fluid, by mass. */
static void share_loss(mpm_wetted *w, const wetted_line *line)
{
    double mass = 0.0, lost = 0.0;
    for (int k = 0; k < line->n; ++k) {
        mass += w->node[line->member[k]].mass[FLUID];
        lost += lost_at(&w->node[line->member[k]]);
    }
    for (int k = 0; k < line->n; ++k) w->node[line->member[k]].heat = lost / mass;
}

void wetted_hold_line(const mpm *s, int root)
{
    mpm_wetted *w = s->work->wetted;
    wetted_line line = {.n = w->first[root + 1] - w->first[root], .member = w->member + w->first[root]};
    for (int k = 0; k < line.n; ++k)
        for (int c = 0; c < 3; ++c) line.area[c] += w->node[line.member[k]].area[c];
    const wetted_line whole = line;
    join_slivers(s, &line);
    bear_pressure(s, &line);
    if (line.n > 0 && is_wall(s, root, &line)) {
        stop_closing(s, &line);
        stop_slip(s, &line);
    } else {
        join_nodes(s, &line);
    }
    share_loss(w, &whole);
}
