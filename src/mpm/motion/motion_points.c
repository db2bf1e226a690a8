/* Points of bodies that do not deform: their mass, centre and inertia, and their motion. */
#include "mpm/motion/motion.h"

#include "grid/tile_box.h"
#include "mpm/surface/surfaces.h"
#include "mpm/transfer/scratch.h"

#include <math.h>
#include <string.h>

enum { SUM_MASS, SUM_PLACE, SUM_MOMENTUM = SUM_PLACE + 3, SUM_END = SUM_MOMENTUM + 3 };
enum { SUM_SPIN, SUM_INERTIA = SUM_SPIN + 3, SUM_KINETIC = SUM_INERTIA + 6, SUM_TURNING };

typedef struct point_view {
    const double *mass, *x[3], *v[3];
} point_view;

static point_view view_points(const mpm *s, int blk, int body)
{
    const fields *f = s->domain->fields[blk];
    point_view p = {.mass = field_get(f, P_MASS, body, 0)};
    for (int a = 0; a < s->mesh->dim; ++a) {
        p.x[a] = field_get(f, P_POS, body, a);
        p.v[a] = field_get(f, P_VEL, body, a);
    }
    return p;
}

/* A radius is no length along a line: about an axis only z has a place and a momentum. */
static int first_axis(const mpm *s)
{
    return s->mesh->geometry == MESH_AXISYMMETRIC ? 1 : 0;
}

static void add_inertia_tile(mpm *s, int blk, int tile, void *user, double *sum)
{
    const int body = *(const int *)user;
    const size_t *at = s->points[blk][body].tile_start;
    const point_view p = view_points(s, blk, body);
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        sum[SUM_MASS] += p.mass[k];
        for (int a = first_axis(s); a < s->mesh->dim; ++a) {
            sum[SUM_PLACE + a] += p.mass[k] * p.x[a][k];
            sum[SUM_MOMENTUM + a] += p.mass[k] * p.v[a][k];
        }
    }
}

typedef struct turning_sum {
    int body;
    const double *centre, *velocity;
} turning_sum;

static void add_turning_tile(mpm *s, int blk, int tile, void *user, double *sum)
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    const turning_sum *t = user;
    const size_t *at = s->points[blk][t->body].tile_start;
    const point_view p = view_points(s, blk, t->body);
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        double r[3] = {0.0}, v[3] = {0.0}, square = 0.0;
        for (int a = first_axis(s); a < s->mesh->dim; ++a) {
            r[a] = p.x[a][k] - t->centre[a];
            v[a] = p.v[a][k] - t->velocity[a];
            square += r[a] * r[a];
            sum[SUM_KINETIC] += 0.5 * p.mass[k] * p.v[a][k] * p.v[a][k];
        }
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            sum[SUM_SPIN + a] += p.mass[k] * (r[b] * v[c] - r[c] * v[b]);
        }
        for (int e = 0; e < 6; ++e)
            sum[SUM_INERTIA + e] += p.mass[k] * ((e < 3 ? square : 0.0) - r[pair[e][0]] * r[pair[e][1]]);
    }
}

void rigid_sum_points(mpm *s, int body, rigid_sums *out)
{
    double sum[SUM_END], turning[SUM_TURNING], velocity[3] = {0.0};
    memset(out, 0, sizeof *out);
    sum_over_tiles(s, SUM_END, add_inertia_tile, &body, sum);
    if (!(sum[SUM_MASS] > 0.0)) return; /* all of it has left */
    out->mass = sum[SUM_MASS];
    for (int a = 0; a < 3; ++a) {
        out->centre[a] = sum[SUM_PLACE + a] / out->mass;
        out->momentum[a] = sum[SUM_MOMENTUM + a];
        velocity[a] = out->momentum[a] / out->mass;
    }
    turning_sum t = {body, out->centre, velocity};
    sum_over_tiles(s, SUM_TURNING, add_turning_tile, &t, turning);
    memcpy(out->spin, turning + SUM_SPIN, sizeof out->spin);
    memcpy(out->inertia, turning + SUM_INERTIA, sizeof out->inertia);
    out->kinetic = turning[SUM_KINETIC];
}

void rigid_set_points(mpm *s, int body, const rigid_field *field)
{
    const surface_markers *k = &s->surfaces->markers;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (size_t n = 0; n < s->points[b][body].n; ++n) {
            double x[3] = {0.0}, v[3];
            for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(s->domain->fields[b], P_POS, body, a)[n];
            rigid_velocity(field, x, v);
            for (int a = 0; a < s->mesh->dim; ++a) field_get(s->domain->fields[b], P_VEL, body, a)[n] = v[a];
        }
    for (size_t n = 0; n < k->n; ++n)
        if (k->group[n] == s->body[body].group) {
            rigid_velocity(field, k->now[n].x, k->now[n].v);
            memcpy(k->next[n].v, k->now[n].v, sizeof k->now[n].v);
        }
}

/* Where the motion takes a place over the step. */
static void carry_place(const body_motion *m, const double x[3], double next[3])
{
    double r[3];
    for (int a = 0; a < 3; ++a) r[a] = x[a] - m->now.c[a];
    for (int a = 0; a < 3; ++a)
        next[a] = m->end.c[a] + (m->turn[3 * a] * r[0] + m->turn[3 * a + 1] * r[1] + m->turn[3 * a + 2] * r[2]);
}

void motion_of_place(const mpm *s, const body_motion *m, const double x[3], double next[3], double velocity[3],
                     double path[3])
{
    carry_place(m, x, next);
    rigid_velocity(&m->end, next, velocity);
    const rigid_field working = {{m->now.c[0], m->now.c[1], m->now.c[2]},
                                 {m->working[0][0], m->working[0][1], m->working[0][2]},
                                 {m->working[1][0], m->working[1][1], m->working[1][2]}};
    rigid_velocity(&working, x, path);
    for (int a = 0; a < 3; ++a) path[a] = motion_is_prescribed(m->given) ? next[a] - x[a] : s->dt * path[a];
}

void motion_sweep(const mpm *s, const body_motion *m, const double x[3], double velocity[3])
{
    double r[3];
    if (motion_is_prescribed(m->given)) {
        carry_place(m, x, r);
        for (int a = 0; a < 3; ++a) velocity[a] = (r[a] - x[a]) / s->dt;
        return;
    }
    const rigid_field gain = {{m->now.c[0], m->now.c[1], m->now.c[2]},
                              {m->next.v[0], m->next.v[1], m->next.v[2]},
                              {m->next.w[0] - m->now.w[0], m->next.w[1] - m->now.w[1], m->next.w[2] - m->now.w[2]}};
    rigid_velocity(&gain, x, velocity);
    for (int a = 0; a < 3; ++a) r[a] = x[a] - m->now.c[a];
    for (int a = 0; a < 3; ++a) {
        const double *turn = &m->coast[3 * a];
        velocity[a] += (turn[0] * r[0] + turn[1] * r[1] + turn[2] * r[2] - r[a]) / s->dt;
    }
}

/* Turns F with the body, where its domains have it. */
static void turn_shape(const mpm *s, const body_motion *m, int blk, size_t k)
{
    static const int slot[3][9] = {{0, 4, 8}, {0, 1, 3, 4, 8}, {0, 1, 2, 3, 4, 5, 6, 7, 8}};
    const fields *f = s->domain->fields[blk];
    const int count = field_component_count(FIELD_DEFORM, s->mesh->dim);
    double F[9] = {0.0};
    for (int c = 0; c < count; ++c) F[slot[s->mesh->dim - 1][c]] = field_get(f, P_F, m->body, c)[k];
    for (int c = 0; c < count; ++c) {
        const int at = slot[s->mesh->dim - 1][c], row = at / 3, column = at % 3;
        field_next(f, P_F, m->body, c)[k] =
            m->turn[3 * row] * F[column] + m->turn[3 * row + 1] * F[3 + column] + m->turn[3 * row + 2] * F[6 + column];
    }
}

static bool leaves_mesh(const mpm *s, const double x[3])
{
    for (int a = 0; a < s->mesh->dim; ++a)
        if (!s->mesh->periodic[a] && !(x[a] >= s->mesh->lower[a] && x[a] <= s->mesh->upper[a])) return true;
    return false;
}

static floe_status refuse_side(const mpm *s, const body_motion *m)
{
    return fail(s->ctx, FLOE_DIVERGED,
                "at t = %.6g%s rigid body '%s' reaches a side of the domain, which does not push it back: leave more "
                "space, or end sooner",
                s->time, scene_time_unit(s->scene), s->scene->body[s->body[m->body].scene_body].name);
}

static floe_status move_rigid_point(mpm *s, const body_motion *m, int blk, int tile, size_t k)
{
    const fields *f = s->domain->fields[blk];
    double x[3] = {0.0}, next[3], v[3];
    bool changed = false;
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, m->body, a)[k];
    carry_place(m, x, next);
    rigid_velocity(&m->end, next, v);
    for (int a = 0; a < s->mesh->dim; ++a) {
        if (!(fabs(next[a] - x[a]) <= s->mesh->h[a]))
            return fail(s->ctx, FLOE_RETRY,
                        "at t = %.6g s a point of body '%s' would cross more than a cell in one step", s->time,
                        s->scene->body[s->body[m->body].scene_body].name);
        changed = changed || mesh_cell_of(s->mesh, a, next[a]) != mesh_cell_of(s->mesh, a, x[a]);
        field_next(f, P_POS, m->body, a)[k] = next[a];
        field_next(f, P_VEL, m->body, a)[k] = v[a];
    }
    if (fields_has(f, P_F, m->body)) turn_shape(s, m, blk, k);
    const bool out = leaves_mesh(s, next);
    if (changed || out) s->moved[tile] |= UINT32_C(1) << m->body;
    return out && !motion_is_prescribed(m->given) ? refuse_side(s, m) : FLOE_OK;
}

static void keep_field(const mpm *s, int blk, int body, field_id id)
{
    const fields *f = s->domain->fields[blk];
    const size_t bytes = s->points[blk][body].n * sizeof(double);
    if (!fields_has(f, id, body) || bytes == 0) return;
    for (int c = 0; c < field_component_count(field_describe(id)->components, s->mesh->dim); ++c)
        memcpy(field_next(f, id, body, c), field_get(f, id, body, c), bytes);
}

void motions_keep(mpm *s)
{
    for (int i = 0; s->motions && i < s->motions->n; ++i)
        for (int id = 0; id < FIELD_COUNT; ++id) {
            const field_info *info = field_describe((field_id)id);
            const bool state = info->centring == FIELD_POINT && info->class == FIELD_STATE;
            for (int b = 0; state && id != P_POS && id != P_VEL && id != P_F && b < s->mesh->n_blocks; ++b)
                keep_field(s, b, s->motions->body[i].body, (field_id)id);
        }
}

floe_status rigid_move_points(mpm *s, const body_motion *m)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            const size_t *at = s->points[b][m->body].tile_start;
            const int number = tile_box_of(s->mesh, &s->mesh->block[b], t).number;
            for (size_t k = at[t]; k < at[t + 1]; ++k) TRY(move_rigid_point(s, m, b, number, k));
        }
    return FLOE_OK;
}

/* What the points have now; beyond that, what the table will have next, and what a fall makes of rest. */
double motion_rate(const mpm *s, int body)
{
    const body_motion *m = &s->motions->body[body - s->n_deforming];
    double now = 0.0, reach = 0.0, ahead = 0.0, fall = 0.0, inverse = 0.0, speed[3], spin;
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const point_view p = view_points(s, b, body);
        for (size_t k = 0; k < s->points[b][body].n; ++k) {
            double rate = 0.0, square = 0.0;
            for (int a = 0; a < s->mesh->dim; ++a) {
                rate += fabs(p.v[a][k]) / s->mesh->h[a];
                square += (p.x[a][k] - m->now.c[a]) * (p.x[a][k] - m->now.c[a]);
            }
            now = fmax(now, rate);
            reach = fmax(reach, sqrt(square));
        }
    }
    motion_largest(m->given, s->time, speed, &spin);
    for (int a = 0; a < s->mesh->dim; ++a) {
        ahead += speed[a] / s->mesh->h[a];
        fall += fabs(m->acceleration[a]) / s->mesh->h[a];
        inverse += 1.0 / s->mesh->h[a];
    }
    return fmax(fmax(now, sqrt(fall)), ahead + (spin > 0.0 ? spin * reach * inverse : 0.0));
}
