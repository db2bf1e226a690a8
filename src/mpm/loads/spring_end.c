/* The ends of springs (theory 4.13). A place of a body is x = sum w_k x_k over the points about it, with sum w_k = 1; where the body moves
 * linearly that is the motion of the place itself. A force on it is w_k of that force on each point, which has its resultant and moment. */
#include "mpm/loads/spring_end.h"

#include "base/memory.h"
#include "math/linear_weights.h"
#include "mpm/motion/motion_springs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cells beyond the nearest point within which points belong to an end: enough for a linear motion with one point a cell. */
static const double end_reach = 0.75;
/* Sum of sizes of weights from which on the nearest point alone is the end: of points in a row weights are noise. */
static const double most_weight = 4.0;

static int own_body(const mpm *s, int named)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].scene_body == named) return b;
    return -1;
}

/* ---- its points ---- */

static int compare_ids(const void *a, const void *b)
{
    const double x = ((const spring_point *)a)->id, y = ((const spring_point *)b)->id;
    return x < y ? -1 : x > y;
}

static bool is_there(const mpm *s, int body, const spring_point *p)
{
    return p->index < s->points[p->block][body].n &&
           field_get(s->domain->fields[p->block], P_ID, body, 0)[p->index] == p->id;
}

bool spring_end_find(const mpm *s, spring_end *end)
{
    int found = 0;
    for (int k = 0; k < end->n; ++k) found += is_there(s, end->body, &end->point[k]);
    if (found == end->n) return true;
    found = 0;
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const double *ids = field_get(s->domain->fields[b], P_ID, end->body, 0);
        for (size_t k = 0; k < s->points[b][end->body].n; ++k) {
            if (ids[k] < end->point[0].id || ids[k] > end->point[end->n - 1].id) continue;
            spring_point *p =
                bsearch(&(spring_point){.id = ids[k]}, end->point, (size_t)end->n, sizeof *p, compare_ids);
            if (!p) continue;
            p->block = b;
            p->index = k;
            found++;
        }
    }
    return found == end->n;
}

/* ---- a point by its number ---- */

static floe_status start_at_point(mpm *s, const scene_spring *spring, int e, spring_end *end)
{
    const int number = spring->end[e].point;
    TRY(memory_new(s->ctx, &end->point, 1, sizeof *end->point));
    end->n = 1;
    end->point[0] = (spring_point){
        .id = (double)(((unsigned long long)end->body << 40) | (unsigned long long)(number - 1)), .weight = 1.0};
    if (spring_end_find(s, end)) return FLOE_OK;
    const size_t points = mpm_body_points(s, end->body);
    return fail_key(s->ctx, KEY("springs", spring->name, e == 0 ? "from" : "to", "point"),
                    "%d: body '%s' has only %zu point%s", number, s->scene->body[spring->end[e].body].name, points,
                    points == 1 ? "" : "s");
}

/* ---- a place ---- */

static double distance_squared(const mpm *s, int blk, int body, size_t k, const double x[3])
{
    double square = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double way = field_get(s->domain->fields[blk], P_POS, body, a)[k] - x[a];
        square += way * way;
    }
    return square;
}

/* Calls for every point of a body within a distance (m) of a place. */
typedef void near_point(const mpm *s, int blk, int body, size_t k, double square, void *user);

static void visit_near(const mpm *s, int body, const double x[3], double distance, near_point *visit, void *user)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (size_t k = 0; k < s->points[b][body].n; ++k) {
            const double square = distance_squared(s, b, body, k, x);
            if (square <= distance * distance) visit(s, b, body, k, square, user);
        }
}

typedef struct nearest_point {
    double square, id;
    int block;
    size_t index, count;
} nearest_point;

static void keep_nearest(const mpm *s, int blk, int body, size_t k, double square, void *user)
{
    nearest_point *n = user;
    const double id = field_get(s->domain->fields[blk], P_ID, body, 0)[k];
    n->count++;
    if (square > n->square || (square == n->square && id > n->id)) return;
    *n = (nearest_point){square, id, blk, k, n->count};
}

typedef struct end_filling {
    spring_end *end;
    double reach; /* m */
} end_filling;

/* The nearer and the larger a point, the more it bears. */
static void add_to_end(const mpm *s, int blk, int body, size_t k, double square, void *user)
{
    const end_filling *f = user;
    const fields *from = s->domain->fields[blk];
    const double weight = field_get(from, P_VOLUME0, body, 0)[k] * (1.0 - square / (f->reach * f->reach));
    f->end->point[f->end->n++] = (spring_point){field_get(from, P_ID, body, 0)[k], weight, blk, k};
}

/* A point from the place, in cells: row of the moments, 1 first. */
static void moment_row_of_point(const mpm *s, const spring_end *end, int k, const double x[3], double row[LINEAR_TERMS])
{
    const spring_point *p = &end->point[k];
    row[0] = 1.0;
    for (int a = 0; a < s->mesh->dim; ++a)
        row[1 + a] = (field_get(s->domain->fields[p->block], P_POS, end->body, a)[p->index] - x[a]) / s->mesh->h[a];
}

/* Weights times a linear factor, so that they sum to one and their centre is the place. False where the points do not allow it. */
static bool centre_weights(const mpm *s, spring_end *end, const double x[3])
{
    linear_weights linear = linear_weights_begin(s->mesh->dim);
    double row[LINEAR_TERMS], size = 0.0;
    for (int k = 0; k < end->n; ++k) {
        moment_row_of_point(s, end, k, x, row);
        linear_weights_add(&linear, row, end->point[k].weight);
    }
    if (!linear_weights_solve(&linear)) return false;
    for (int k = 0; k < end->n; ++k) {
        moment_row_of_point(s, end, k, x, row);
        end->point[k].weight = linear_weights_take(&linear, row, end->point[k].weight);
        size += fabs(end->point[k].weight);
    }
    return linear_weights_hold(&linear) && size <= most_weight;
}

static floe_status refuse_place(const mpm *s, const scene_spring *spring, int e, const nearest_point *nearest, int body)
{
    const double *x = spring->end[e].place;
    double at[3] = {0.0};
    for (int a = 0; a < s->mesh->dim && nearest->count > 0; ++a)
        at[a] = field_get(s->domain->fields[nearest->block], P_POS, body, a)[nearest->index];
    return fail_key(s->ctx, KEY("springs", spring->name, e == 0 ? "from" : "to", "position"),
                    "(%g, %g, %g): body '%s' is not there; its nearest point is at (%g, %g, %g)", x[0], x[1], x[2],
                    s->scene->body[spring->end[e].body].name, at[0], at[1], at[2]);
}

static floe_status start_at_place(mpm *s, const scene_spring *spring, int e, spring_end *end)
{
    const double *x = spring->end[e].place;
    nearest_point nearest = {INFINITY, INFINITY, 0, 0, 0}, within = {INFINITY, INFINITY, 0, 0, 0};
    double diagonal = 0.0, cell = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) {
        diagonal += s->mesh->h[a] * s->mesh->h[a];
        cell = fmax(cell, s->mesh->h[a]);
    }
    visit_near(s, end->body, x, INFINITY, keep_nearest, &nearest);
    if (!(nearest.square <= diagonal)) return refuse_place(s, spring, e, &nearest, end->body);
    const double reach = sqrt(nearest.square) + end_reach * cell;
    visit_near(s, end->body, x, reach, keep_nearest, &within);
    TRY(memory_new(s->ctx, &end->point, within.count, sizeof *end->point));
    visit_near(s, end->body, x, reach, add_to_end, &(end_filling){end, reach});
    qsort(end->point, (size_t)end->n, sizeof *end->point, compare_ids); /* one order, however many blocks there are */
    if (!s->body[end->body].membrane.model && centre_weights(s, end, x)) return FLOE_OK;
    end->n = 1;
    end->point[0] = (spring_point){nearest.id, 1.0, nearest.block, nearest.index};
    return FLOE_OK;
}

floe_status spring_end_start(mpm *s, const scene_spring *spring, int e, spring_end *end)
{
    *end = (spring_end){.body = -1};
    if (spring->end[e].body < 0) return FLOE_OK;
    end->body = own_body(s, spring->end[e].body);
    if (end->body < 0)
        return fail_key(s->ctx, KEY("springs", spring->name, e == 0 ? "from" : "to", "body"),
                        "'%s' has no material points here: springs act on solids, and on fluids in coupling mpm",
                        s->scene->body[spring->end[e].body].name);
    return spring->end[e].point > 0 ? start_at_point(s, spring, e, end) : start_at_place(s, spring, e, end);
}

/* ---- its motion ---- */

/* About the first point, so that a body may lie across a periodic side. */
void spring_end_position(const mpm *s, const scene_spring_end *given, const spring_end *end, bool next, double x[3])
{
    for (int a = 0; a < 3; ++a) x[a] = end->body < 0 ? given->place[a] : 0.0;
    for (int a = 0; end->body >= 0 && a < s->mesh->dim; ++a) {
        double first = 0.0;
        for (int k = 0; k < end->n; ++k) {
            const spring_point *p = &end->point[k];
            const fields *f = s->domain->fields[p->block];
            const double at = (next ? field_next(f, P_POS, end->body, a) : field_get(f, P_POS, end->body, a))[p->index];
            if (k == 0) first = at;
            x[a] += p->weight * (at - first + mesh_to_image(s->mesh, a, at, first));
        }
        x[a] = end->n == 1 ? first : first + x[a];
    }
}

void spring_end_velocity(const mpm *s, const spring_end *end, double v[3])
{
    v[0] = v[1] = v[2] = 0.0;
    for (int a = 0; end->body >= 0 && a < s->mesh->dim; ++a)
        for (int k = 0; k < end->n; ++k)
            v[a] += end->point[k].weight *
                    field_get(s->domain->fields[end->point[k].block], P_VEL, end->body, a)[end->point[k].index];
}

/* ---- how it gives way ---- */

/* By the points' own masses: nodes are heavier. */
void spring_end_comply(mpm *s, spring_end *end, const double unit[3])
{
    end->compliance = 0.0;
    if (end->body < 0) return;
    if (motion_has_body(s, end->body)) {
        double x[3];
        spring_end_position(s, NULL, end, false, x);
        end->compliance = motion_compliance(s, end->body, x, unit);
        return;
    }
    for (int k = 0; k < end->n; ++k) {
        const spring_point *p = &end->point[k];
        const double mass = field_get(s->domain->fields[p->block], P_MASS, end->body, 0)[p->index];
        if (mass > 0.0) end->compliance += p->weight * p->weight / mass;
    }
}

bool spring_ends_share(const spring_end *a, const spring_end *b)
{
    if (a->body < 0 || a->body != b->body) return false;
    for (int i = 0, j = 0; i < a->n && j < b->n;) {
        if (a->point[i].id == b->point[j].id) return true;
        if (a->point[i].id < b->point[j].id)
            ++i;
        else
            ++j;
    }
    return false;
}
