/* One side for all normals: a least spanning tree over the points (Hoppe et al. 1992). */
#include "base/memory.h"
#include "math/tensor.h"
#include "surface/neighbours.h"

#include <math.h>
#include <string.h>

enum { ALONG_2D = 6, ALONG_3D = 12 }; /* neighbours to which a side is handed on */

/* An end that waits to be given the side of its start. */
typedef struct waiting {
    double cost;
    double normal[3]; /* what its normal should be like */
    uint32_t number;
} waiting;

typedef struct orienter {
    const surface_set *s;
    surface_estimate *out;
    size_t *entry; /* 1 + the entry of each point that is no image; 0: it is lost. Owned */
    bool *done;    /* owned */
    waiting *heap; /* least cost first; owned */
    size_t n, reserved;
} orienter;

static const surface_entry *entry_of(const orienter *o, size_t number)
{
    return &o->s->points.entry[o->entry[number] - 1];
}

static bool waits_before(const waiting *a, const waiting *b)
{
    return a->cost < b->cost || (a->cost == b->cost && a->number < b->number);
}

static floe_status push_waiting(orienter *o, const waiting *one)
{
    if (o->n == o->reserved) {
        TRY(memory_resize(o->s->ctx, &o->heap, 2 * o->reserved, sizeof *o->heap));
        o->reserved *= 2;
    }
    size_t at = o->n++;
    for (; at > 0 && waits_before(one, &o->heap[(at - 1) / 2]); at = (at - 1) / 2) o->heap[at] = o->heap[(at - 1) / 2];
    o->heap[at] = *one;
    return FLOE_OK;
}

static waiting pop_waiting(orienter *o)
{
    const waiting least = o->heap[0], last = o->heap[--o->n];
    size_t at = 0;
    for (size_t next = 1; next < o->n; next = 2 * at + 1) {
        if (next + 1 < o->n && waits_before(&o->heap[next + 1], &o->heap[next])) next++;
        if (!waits_before(&o->heap[next], &last)) break;
        o->heap[at] = o->heap[next];
        at = next;
    }
    o->heap[at] = last;
    return least;
}

static void turn_to(surface_estimate *e, const double like[3])
{
    if (!(vec_dot(e->normal, like) < 0.0)) return;
    for (int a = 0; a < 3; ++a) e->normal[a] = -e->normal[a];
    e->curvature = -e->curvature;
}

/* Hands the side of a point on to its neighbours. An image behind a mirror is not its point's side. */
static floe_status hand_on(orienter *o, uint32_t number)
{
    surface_neighbour near[ALONG_3D];
    const double *n = o->out[number].normal;
    const int count = surface_nearest(o->s, entry_of(o, number), o->s->mesh->dim == 3 ? ALONG_3D : ALONG_2D, near);
    for (int k = 0; k < count; ++k) {
        const surface_estimate *to = &o->out[near[k].number];
        if (near[k].image != 0 || o->done[near[k].number] || to->basis == SURFACE_NONE) continue;
        waiting w = {.number = near[k].number};
        memcpy(w.normal, n, sizeof w.normal);
        if (near[k].square > 0.0) vec_add_scaled(-2.0 * vec_dot(n, near[k].d) / near[k].square, near[k].d, w.normal);
        w.cost = sqrt(near[k].square) * (1.5 - fabs(vec_dot(w.normal, to->normal)));
        TRY(push_waiting(o, &w));
    }
    return FLOE_OK;
}

static floe_status spread_orientation(orienter *o)
{
    while (o->n > 0) {
        const waiting w = pop_waiting(o);
        if (o->done[w.number]) continue;
        turn_to(&o->out[w.number], w.normal);
        o->done[w.number] = true;
        TRY(hand_on(o, w.number));
    }
    return FLOE_OK;
}

static void find_middle(const surface_set *s, double middle[3])
{
    for (int a = 0; a < 3; ++a) middle[a] = 0.0;
    for (size_t k = 0; k < s->points.n; ++k) vec_add_scaled(1.0 / (double)s->points.n, s->points.entry[k].x, middle);
}

/* The point farthest from the middle that has no side yet; false when there is none. */
static bool farthest_unoriented(const orienter *o, const double middle[3], uint32_t *number)
{
    double most = -1.0;
    for (size_t k = 0; k < o->s->n_points; ++k) {
        if (o->entry[k] == 0 || o->done[k] || o->out[k].basis == SURFACE_NONE) continue;
        double square = 0.0;
        for (int a = 0; a < 3; ++a) square += pow(entry_of(o, k)->x[a] - middle[a], 2.0);
        if (!(square > most)) continue;
        most = square;
        *number = (uint32_t)k;
    }
    return most >= 0.0;
}

/* Sides that are known, and from them all that they reach; then part by part what is left. */
static floe_status give_sides(orienter *o, const double *reference)
{
    double middle[3];
    uint32_t first;
    for (size_t k = 0; reference && k < o->s->n_points; ++k) {
        const double *r = reference + 3 * k;
        if (o->entry[k] == 0 || o->out[k].basis == SURFACE_NONE || !(vec_dot(r, r) > 0.0)) continue;
        turn_to(&o->out[k], r);
        o->done[k] = true;
    }
    for (size_t k = 0; reference && k < o->s->n_points; ++k)
        if (o->done[k]) TRY(hand_on(o, (uint32_t)k));
    TRY(spread_orientation(o));
    find_middle(o->s, middle);
    while (farthest_unoriented(o, middle, &first)) {
        double away[3];
        for (int a = 0; a < 3; ++a) away[a] = entry_of(o, first)->x[a] - middle[a];
        turn_to(&o->out[first], away);
        o->done[first] = true;
        TRY(hand_on(o, first));
        TRY(spread_orientation(o));
    }
    return FLOE_OK;
}

static floe_status orient_with(orienter *o, const double *reference)
{
    const surface_set *s = o->s;
    o->reserved = s->n_points + ALONG_3D;
    TRY(memory_new(s->ctx, &o->entry, s->n_points, sizeof *o->entry));
    TRY(memory_new(s->ctx, &o->done, s->n_points, sizeof *o->done));
    TRY(memory_new(s->ctx, &o->heap, o->reserved, sizeof *o->heap));
    for (size_t k = 0; k < s->points.n; ++k)
        if (s->points.entry[k].image == 0) o->entry[s->points.entry[k].number] = k + 1;
    return give_sides(o, reference);
}

/* With a side for every normal there is nothing to hand on: the way of all steps but the first. */
static bool all_known(const surface_set *s, const double *reference, const surface_estimate *out)
{
    for (size_t k = 0; k < s->n_points; ++k)
        if (out[k].basis != SURFACE_NONE && !(reference && vec_dot(reference + 3 * k, reference + 3 * k) > 0.0))
            return false;
    return true;
}

floe_status surface_orient(const surface_set *s, const double *reference, surface_estimate *out)
{
    if (all_known(s, reference, out)) {
        for (size_t k = 0; k < s->n_points; ++k)
            if (out[k].basis != SURFACE_NONE) turn_to(&out[k], reference + 3 * k);
        return FLOE_OK;
    }
    orienter o = {.s = s, .out = out};
    const floe_status status = orient_with(&o, reference);
    memory_free(s->ctx, &o.entry);
    memory_free(s->ctx, &o.done);
    memory_free(s->ctx, &o.heap);
    return status;
}
