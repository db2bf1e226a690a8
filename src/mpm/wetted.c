/* Fluid points along walls (wetted.h). */
#include "mpm/wetted.h"

#include "base/memory.h"
#include "base/threads.h"
#include "mpm/lanes.h"
#include "mpm/wall.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FLUID, SOLID };
/* A line whose areas sum to less than this of the face of a cell is no wall that a fluid stands along. */
static const double least_area = 0.3;
/* Nodes that solids fill less hold nothing where there is no wall to speak of. */
static const double least_fill = 0.1;
/* Nodes with less of a line's heaviest share of fluid, or with less solid than this many times their fluid, have one velocity: forces on
 * next to no mass of one of the two would throw the points that see the node's gradient. */
static const double least_fluid = 0.01, least_solid = 5.0;

static size_t all_nodes(const mpm_wetted *w)
{
    return (size_t)w->nodes[0] * (size_t)w->nodes[1] * (size_t)w->nodes[2];
}

static size_t number_of(const mpm_wetted *w, const int at[MESH_MAX_DIM])
{
    return (size_t)at[0] + (size_t)w->nodes[0] * ((size_t)at[1] + (size_t)w->nodes[1] * (size_t)at[2]);
}

floe_status wetted_create(mpm *s)
{
    TRY(memory_new(s->ctx, &s->work->wetted, 1, sizeof *s->work->wetted));
    mpm_wetted *w = s->work->wetted;
    w->density = (double)INFINITY;
    for (int b = 0; b < s->n_bodies; ++b) {
        const scene_material *m = &s->scene->material[s->body[b].scene_material];
        if (s->body[b].fluid) {
            w->fluid = s->body[b].group;
        } else {
            w->solid = s->body[b].group;
            w->density = fmin(w->density, m->density);
        }
    }
    for (int a = 0; a < MESH_MAX_DIM; ++a) w->nodes[a] = a < s->mesh->dim ? s->mesh->n[a] + 1 : 1;
    TRY(memory_new(s->ctx, &w->index, all_nodes(w), sizeof *w->index));
    for (size_t k = 0; k < all_nodes(w); ++k) w->index[k] = -1;
    return FLOE_OK;
}

void wetted_free(context *ctx, mpm_wetted **w)
{
    if (!*w) return;
    memory_free(ctx, &(*w)->index);
    memory_free(ctx, &(*w)->node);
    memory_free(ctx, &(*w)->member);
    memory_free(ctx, &(*w)->first);
    memory_free(ctx, w);
}

/* ---- the fluid's areas ---- */

static bool meets_in_window(const mpm *s, int blk, const tile_box *t)
{
    const mpm_wetted *w = s->work->wetted;
    const block *b = &s->mesh->block[blk];
    const double *fluid = field_get(s->domain->fields[blk], N_MASS, w->fluid, 0),
                 *solid = field_get(s->domain->fields[blk], N_MASS, w->solid, 0);
    int lo[MESH_MAX_DIM] = {0, 0, 0}, end[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < s->mesh->dim; ++a) {
        lo[a] = t->first[a] - b->lo[a] - 1;
        end[a] = lo[a] + t->cells[a] + 3;
    }
    for (int k = lo[2]; k < end[2]; ++k)
        for (int j = lo[1]; j < end[1]; ++j)
            for (int i = lo[0]; i < end[0]; ++i) {
                const ptrdiff_t at = mesh_index(b, i, j, k);
                if (fluid[at] > 0.0 && solid[at] > 0.0) return true;
            }
    return false;
}

/* Moves on by n points. */
static void pass_by(point_arrays *p, int dim, size_t n)
{
    for (int a = 0; a < dim; ++a) {
        p->x[a] += n;
        p->v[a] += n;
        if (p->half[a]) p->half[a] += n;
    }
    for (int c = 0; c < 9; ++c)
        if (p->deform[c]) p->deform[c] += n;
    p->mass += n;
    p->volume0 += n;
    p->J += n;
}

/* As what a stress of -1 Pa pushes the nodes with, in whatever way the basis and the geometry have it. */
static void push_evenly(const mpm *s, const tile_box *t, point_arrays p, size_t start, size_t end, double *out)
{
    double even[2][SOLID_CHUNK];
    for (int k = 0; k < SOLID_CHUNK; ++k) {
        even[0][k] = -1.0;
        even[1][k] = 0.0;
    }
    p.q = p.grid_pressure = NULL;
    p.held = 0.0;
    memset(p.acceleration, 0, sizeof p.acceleration);
    for (int a = 0; a < MESH_MAX_DIM; ++a) p.drive[a] = NULL;
    for (int c = 0; c < 6; ++c) p.stress[c] = even[c < 3 ? 0 : 1];
    pass_by(&p, s->mesh->dim, start);
    for (size_t n; start < end; start += n) {
        n = end - start < SOLID_CHUNK ? end - start : SOLID_CHUNK;
        s->work->kernel.scatter[SCATTER_FORCE](s->mesh, t, &p, 0, n, out);
        pass_by(&p, s->mesh->dim, n);
    }
}

static void scatter_tile(mpm *s, int blk, int tile)
{
    tile_box box = tile_box_of(s->mesh, &s->mesh->block[blk], tile);
    const bool meets = meets_in_window(s, blk, &box);
    bool any = false;
    if (meets) box.shared = shared_cells(s, blk, tile, &box);
    double *out = domain_tile(s->domain, box.number);
    for (int body = 0; meets && body < s->n_bodies; ++body) {
        const size_t *start = s->points[blk][body].tile_start;
        if (!s->body[body].fluid || start[tile] == start[tile + 1]) continue;
        if (!any) memset(out, 0, (size_t)(s->work->window_nodes * lanes_of(s->mesh->dim)) * sizeof *out);
        any = true;
        push_evenly(s, &box, points_of(s, blk, body, false, false), start[tile], start[tile + 1], out);
    }
    s->work->active[box.number] = any;
}

floe_status mpm_wetted_area(mpm *s)
{
    const int fluid = s->work->wetted->fluid;
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) scatter_tile(s, b, t);
    }
    domain_share_partials(s->domain);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        node_target to = {.components = lanes_of(s->mesh->dim), .reach = s->work->reach};
        memcpy(to.window, s->work->window, sizeof to.window);
        for (int a = 0; a < s->mesh->dim; ++a) to.array[a] = field_get(s->domain->fields[b], N_WETTED_AREA, fluid, a);
        gather_nodes(s, b, &to);
    }
    domain_fold_periodic(s->domain, N_WETTED_AREA, fluid);
    fold_field(s, fluid, N_WETTED_AREA);
    return FLOE_OK;
}

/* ---- the list of nodes ---- */

/* Visits nodes of a block from `lo` to `end`, counted in it, at which both have mass. */
typedef floe_status shared_visitor(mpm *s, int blk, const int at[MESH_MAX_DIM], ptrdiff_t local);

static floe_status visit_shared(mpm *s, int blk, const int lo[MESH_MAX_DIM], const int end[MESH_MAX_DIM],
                                shared_visitor *visit)
{
    const mpm_wetted *w = s->work->wetted;
    const block *b = &s->mesh->block[blk];
    const double *fluid = field_get(s->domain->fields[blk], N_MASS, w->fluid, 0),
                 *solid = field_get(s->domain->fields[blk], N_MASS, w->solid, 0);
    for (int k = lo[2]; k < end[2]; ++k)
        for (int j = lo[1]; j < end[1]; ++j)
            for (int i = lo[0]; i < end[0]; ++i) {
                const ptrdiff_t local = mesh_index(b, i, j, k);
                if (!(fluid[local] > 0.0 && solid[local] > 0.0)) continue;
                TRY(visit(s, blk, (const int[]){b->lo[0] + i, b->lo[1] + j, b->lo[2] + k}, local));
            }
    return FLOE_OK;
}

/* Components that the sides hold have no area. */
static void leave_held_out(const mpm *s, wetted_node *n)
{
    for (int a = 0; a < s->mesh->dim; ++a)
        for (int side = 0; side < 2; ++side) {
            if (s->mesh->periodic[a] || n->at[a] != (side == SIDE_LOWER ? 0 : s->mesh->n[a])) continue;
            for (int c = 0; c < s->mesh->dim; ++c)
                if (wall_holds(s, 0, a, side, c)) n->area[c] = 0.0;
            n->area[a] = 0.0;
        }
}

static floe_status list_node(mpm *s, int blk, const int at[MESH_MAX_DIM], ptrdiff_t local)
{
    mpm_wetted *w = s->work->wetted;
    const fields *f = s->domain->fields[blk];
    if (w->n == w->room) {
        w->room = w->room ? 2 * w->room : 256;
        TRY(memory_resize(s->ctx, &w->node, (size_t)w->room, sizeof *w->node));
        TRY(memory_resize(s->ctx, &w->member, (size_t)w->room, sizeof *w->member));
        TRY(memory_resize(s->ctx, &w->first, (size_t)w->room + 1, sizeof *w->first));
    }
    wetted_node n = {.at = {at[0], at[1], at[2]}, .number = number_of(w, at)};
    for (int g = 0; g < 2; ++g) {
        const int group = g == FLUID ? w->fluid : w->solid;
        n.mass[g] = field_get(f, N_MASS, group, 0)[local];
        for (int c = 0; c < s->mesh->dim; ++c) {
            n.v[g][c] = field_get(f, N_VEL_L, group, c)[local];
            n.before[g][c] = field_get(f, N_MOMENTUM, group, c)[local] / n.mass[g];
            n.gained[g][c] = n.v[g][c] - n.before[g][c];
        }
    }
    for (int c = 0; c < s->mesh->dim; ++c) {
        n.area[c] = field_get(f, N_WETTED_AREA, w->fluid, c)[local];
        n.force[c] = field_get(f, N_FORCE, w->fluid, c)[local];
    }
    leave_held_out(s, &n);
    w->node[w->n++] = n;
    return FLOE_OK;
}

static int compare_numbers(const void *a, const void *b)
{
    const size_t i = ((const wetted_node *)a)->number, j = ((const wetted_node *)b)->number;
    return i < j ? -1 : i > j;
}

static floe_status list_nodes(mpm *s)
{
    mpm_wetted *w = s->work->wetted;
    for (int k = 0; k < w->n; ++k) w->index[w->node[k].number] = -1;
    w->n = 0;
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) {
        const block *b = &s->mesh->block[blk];
        int end[MESH_MAX_DIM];
        for (int a = 0; a < MESH_MAX_DIM; ++a)
            end[a] = a < s->mesh->dim ? b->n[a] + (b->at_side[a][SIDE_UPPER] && !s->mesh->periodic[a] ? 1 : 0) : 1;
        TRY(visit_shared(s, blk, (const int[]){0, 0, 0}, end, list_node));
    }
    if (w->n > 0) qsort(w->node, (size_t)w->n, sizeof *w->node, compare_numbers); /* the same for any blocks */
    for (int k = 0; k < w->n; ++k) w->index[w->node[k].number] = k;
    return FLOE_OK;
}

static int fold_index(const mesh *m, int axis, int i)
{
    return m->periodic[axis] ? (i + m->n[axis]) % m->n[axis] : i;
}

/* In the list, of a node that may lie beyond the mesh; -1: it is not there. */
static int find_node(const mpm *s, const int at[MESH_MAX_DIM])
{
    const mpm_wetted *w = s->work->wetted;
    int g[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        g[a] = fold_index(s->mesh, a, at[a]);
        if (g[a] < 0 || g[a] > s->mesh->n[a]) return -1;
    }
    return w->index[number_of(w, g)];
}

/* ---- lines across the wall ---- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Whether j, on the line of k, comes before it on the way to the wall: ties go to the place, so that no two nodes lead to each other. */
static bool leads(const wetted_node *j, const wetted_node *k)
{
    const double a = dot(j->area, j->area), b = dot(k->area, k->area);
    if (a != b) return a > b;
    for (int c = 0; c < MESH_MAX_DIM; ++c)
        if (j->at[c] != k->at[c]) return j->at[c] < k->at[c];
    return false;
}

/* The neighbour along the axis on which the surface faces most that has more of it, facing the same way; itself: it is the root. */
static int next_on_line(const mpm *s, int k)
{
    const mpm_wetted *w = s->work->wetted;
    const wetted_node *n = &w->node[k];
    int axis = 0, best = k;
    for (int a = 1; a < s->mesh->dim; ++a)
        if (fabs(n->area[a]) > fabs(n->area[axis])) axis = a;
    for (int way = -1; way <= 1; way += 2) {
        int at[MESH_MAX_DIM] = {n->at[0], n->at[1], n->at[2]};
        at[axis] += way;
        const int j = find_node(s, at);
        if (j >= 0 && dot(w->node[j].area, n->area) > 0.0 && leads(&w->node[j], &w->node[best])) best = j;
    }
    return best;
}

static void find_lines(const mpm *s)
{
    mpm_wetted *w = s->work->wetted;
    for (int k = 0; k < w->n; ++k) w->node[k].root = next_on_line(s, k);
    for (int hops = 0; hops < 4; ++hops)
        for (int k = 0; k < w->n; ++k) w->node[k].root = w->node[w->node[k].root].root;
    for (int k = 0; k <= w->n; ++k) w->first[k] = 0;
    for (int k = 0; k < w->n; ++k) w->first[w->node[k].root + 1]++;
    for (int k = 0; k < w->n; ++k) w->first[k + 1] += w->first[k];
    for (int k = 0; k < w->n; ++k) w->member[w->first[w->node[k].root]++] = k;
    for (int k = w->n; k > 0; --k) w->first[k] = w->first[k - 1];
    w->first[0] = 0;
}

/* ---- pressures of the lines ---- */

/* Nodes of a line that move apart, by their places in the list. */
typedef struct wetted_line {
    int n;
    int *member;
    double area[3]; /* m2 */
} wetted_line;

static double volume_of(const mpm *s, const int at[MESH_MAX_DIM])
{
    double volume = 1.0;
    for (int a = 0; a < s->mesh->dim; ++a) {
        const bool end = !s->mesh->periodic[a] && (at[a] == 0 || at[a] == s->mesh->n[a]);
        volume *= s->mesh->h[a] * (end ? 0.5 : 1.0);
    }
    if (s->mesh->geometry == MESH_AXISYMMETRIC) volume *= fmax(mesh_node(s->mesh, 0, at[0]), 0.25 * s->mesh->h[0]);
    return volume;
}

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

/* Joins nodes of a line that have too little of one of the two, and leaves them out of it: they stand behind its members. */
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

/* The fluid's nodes lose a pressure's push N and its reaction goes to the solid's. Of even pressure that is all they are pushed with. */
static void bear_pressure(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->work->wetted;
    double push = 0.0, area = 0.0;
    for (int k = 0; k < line->n; ++k) {
        const wetted_node *m = &w->node[line->member[k]];
        push += dot(m->area, m->force);
        area += dot(m->area, m->area);
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
        ease += dot(m->area, m->area) * recoil_of(m);
    }
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        double given[3];
        for (int c = 0; c < 3; ++c) given[c] = m->mass[FLUID] * m->area[c] * closing / ease;
        push_apart(m, given);
    }
}

/* Ends what is left of the relative velocity along the wall, in the mean of the line as well. */
static void stop_slip(const mpm *s, const wetted_line *line)
{
    mpm_wetted *w = s->work->wetted;
    double slip[3] = {0.0}, ease = 0.0;
    for (int k = 0; k < line->n; ++k) {
        const wetted_node *m = &w->node[line->member[k]];
        const double size = sqrt(dot(m->area, m->area));
        for (int c = 0; c < 3; ++c) slip[c] += size * (m->v[FLUID][c] - m->v[SOLID][c]);
        ease += size * size * recoil_of(m);
    }
    const double along = dot(slip, line->area) / dot(line->area, line->area);
    for (int k = 0; k < line->n; ++k) {
        wetted_node *m = &w->node[line->member[k]];
        const double share = m->mass[FLUID] * sqrt(dot(m->area, m->area)) / ease;
        double given[3];
        for (int c = 0; c < 3; ++c) given[c] = share * (slip[c] - along * line->area[c]);
        push_apart(m, given);
    }
}

/* Whether the fluid stands along a wall there: its surface is about the face of a cell. */
static bool is_wall(const mpm *s, int root, const wetted_line *line)
{
    const double volume = volume_of(s, s->work->wetted->node[root].at), size = sqrt(dot(line->area, line->area));
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
        if (m->mass[SOLID] > least_fill * w->density * volume_of(s, m->at)) join_node(m);
    }
}

/* Kinetic energy (J) that a node has lost to what held it: impulses times the means of the velocities before and after the kick. */
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

static void hold_line(const mpm *s, int root)
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

/* ---- back to the blocks ---- */

/* All that a block sees, ghosts too. */
static floe_status visit_all_shared(mpm *s, int blk, shared_visitor *visit)
{
    int lo[MESH_MAX_DIM] = {0, 0, 0}, end[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < s->mesh->dim; ++a) {
        lo[a] = -1;
        end[a] = s->mesh->block[blk].n[a] + 2;
    }
    return visit_shared(s, blk, lo, end, visit);
}

static floe_status store_node(mpm *s, int blk, const int at[MESH_MAX_DIM], ptrdiff_t local)
{
    const mpm_wetted *w = s->work->wetted;
    const fields *f = s->domain->fields[blk];
    const int k = find_node(s, at);
    if (k < 0) return FLOE_OK; /* a ghost beyond the mesh */
    const wetted_node *n = &w->node[k];
    for (int g = 0; g < 2; ++g)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const int group = g == FLUID ? w->fluid : w->solid;
            field_get(f, N_VEL_L, group, c)[local] = n->v[g][c];
            field_get(f, N_MOMENTUM, group, c)[local] = n->mass[g] * n->before[g][c];
        }
    return FLOE_OK;
}

floe_status mpm_hold_wetted(mpm *s)
{
    mpm_wetted *w = s->work->wetted;
    TRY(list_nodes(s));
    if (w->n == 0) return FLOE_OK;
    find_lines(s);
    for (int k = 0; k < w->n; ++k)
        if (w->node[k].root == k) hold_line(s, k);
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) TRY(visit_all_shared(s, blk, store_node));
    return FLOE_OK;
}

/* Beyond a side there is the image of what is inside. */
static int find_image(const mpm *s, const int at[MESH_MAX_DIM])
{
    int image[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        const int n = s->mesh->n[a];
        image[a] = s->mesh->periodic[a] || (at[a] >= 0 && at[a] <= n) ? at[a] : at[a] < 0 ? -at[a] : 2 * n - at[a];
    }
    return find_node(s, image);
}

static floe_status add_heat(mpm *s, int blk, const int at[MESH_MAX_DIM], ptrdiff_t local)
{
    const mpm_wetted *w = s->work->wetted;
    const int k = find_image(s, at);
    if (k >= 0) field_get(s->domain->fields[blk], N_LOSS, w->fluid, 0)[local] += w->node[k].heat;
    return FLOE_OK;
}

floe_status wetted_add_losses(mpm *s)
{
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) TRY(visit_all_shared(s, blk, add_heat));
    return FLOE_OK;
}
