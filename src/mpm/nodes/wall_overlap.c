/* Overlaps: space for them, and the law of the springs (wall_overlap.h). */
#include "mpm/nodes/wall_overlap.h"

#include "base/memory.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/wall.h"

#include <math.h>
#include <string.h>

static double wave_modulus_of(const mpm_body *b)
{
    if (b->membrane.model) return b->membrane.model->modulus(b->membrane.par, b->membrane.biaxial);
    return b->law->bulk_modulus(b->law_par) + 4.0 / 3.0 * b->law->shear_modulus(b->law_par);
}

static overlap_surface surface_of(const mpm *s, const mpm_body *b)
{
    overlap_surface r = {.flows = (double)INFINITY};
    r.speed = sqrt(wave_modulus_of(b) / s->scene->material[b->scene_material].density);
    /* CPDI domains are cut at such sides, and overlapping ones are cut to small volume fractions whose gradients
     * tear the body: it is stopped almost at once. */
    if (s->basis->fact.shaped)
        r.flows = MPM_SIDE_YIELD;
    else if (!b->membrane.model && b->law->yield_stress)
        r.flows = b->law->yield_stress(b->law_par) /
                  (MPM_SIDE_STIFFNESS * MPM_SIDE_STIFFNESS * b->law->shear_modulus(b->law_par));
    return r;
}

/* Bodies of equal speed by their numbers. */
static void rank_bodies(const mpm *s, struct mpm_overlaps *o)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        for (int other = 0; other < s->n_bodies; ++other)
            o->rank[b] += o->surface[other].speed < o->surface[b].speed ||
                          (other < b && !(o->surface[b].speed < o->surface[other].speed));
        o->slowest[o->rank[b]] = b;
    }
}

static size_t overlap_nodes(const struct mpm_overlaps *o)
{
    return (size_t)o->nodes[0] * (size_t)o->nodes[1] * (size_t)o->nodes[2];
}

size_t overlap_of_side(const struct mpm_overlaps *o, int group, int axis, int side, const int node[MESH_MAX_DIM])
{
    size_t number = 0;
    for (int a = MESH_MAX_DIM - 1; a >= 0; --a) {
        if (a == axis) continue;
        const int at = node[a] < 0 ? node[a] + o->nodes[a] : node[a] >= o->nodes[a] ? node[a] - o->nodes[a] : node[a];
        number = number * (size_t)o->nodes[a] + (size_t)at;
    }
    return o->side[group][axis][side] + number;
}

static void count_sides(mpm *s, struct mpm_overlaps *o)
{
    for (int g = 0; g < s->n_groups; ++g)
        for (int a = 0; a < s->mesh->dim; ++a)
            for (int side = 0; side < 2; ++side) {
                if (!wall_lets_go(s, g, a, side)) continue;
                o->side[g][a][side] = o->n;
                o->n += overlap_nodes(o) / (size_t)o->nodes[a];
            }
}

floe_status overlaps_create(mpm *s)
{
    if (!walls_let_go(s)) return FLOE_OK;
    TRY(memory_new(s->ctx, &s->overlaps, 1, sizeof *s->overlaps));
    struct mpm_overlaps *o = s->overlaps;
    for (int a = 0; a < MESH_MAX_DIM; ++a)
        o->nodes[a] = s->mesh->n[a] + (a < s->mesh->dim && !s->mesh->periodic[a] ? 1 : 0);
    for (int b = 0; b < s->n_bodies; ++b)
        if (!s->body[b].fluid) o->surface[b] = surface_of(s, &s->body[b]);
    rank_bodies(s, o);
    count_sides(s, o);
    TRY(memory_new(s->ctx, &o->now, o->n, sizeof *o->now));
    return memory_new(s->ctx, &o->next, o->n, sizeof *o->next);
}

void overlaps_free(mpm *s)
{
    if (!s->overlaps) return;
    memory_free(s->ctx, &s->overlaps->now);
    memory_free(s->ctx, &s->overlaps->next);
    memory_free(s->ctx, &s->overlaps);
}

void overlaps_commit(mpm *s)
{
    struct mpm_overlaps *o = s->overlaps;
    if (!o || !o->followed) return;
    memcpy(o->now, o->next, o->n * sizeof *o->now);
    o->followed = false;
}

double *mpm_overlaps_state(mpm *s, size_t *n)
{
    *n = s->overlaps ? s->overlaps->n : 0;
    return s->overlaps ? s->overlaps->now : NULL;
}

double overlap_stiffness(double mass, double speed, double h)
{
    const double rate = MPM_SIDE_STIFFNESS * speed / h;
    return mass * rate * rate;
}

/* Where the hardening ends: 1 + 3 x^2 = MPM_SIDE_MOST_SLOPE, x in units of MPM_SIDE_HARDENING. */
static double last_hardening(void)
{
    return sqrt((MPM_SIDE_MOST_SLOPE - 1.0) / 3.0);
}

double overlap_push(double overlap, double h)
{
    const double unit = MPM_SIDE_HARDENING * h, x = fmin(overlap / unit, last_hardening());
    return unit * (x + x * x * x) + MPM_SIDE_MOST_SLOPE * (overlap - x * unit);
}

double overlap_energy(double overlap, double h)
{
    if (!(overlap > 0.0)) return 0.0;
    const double unit = MPM_SIDE_HARDENING * h, x = fmin(overlap / unit, last_hardening()), rest = overlap - x * unit;
    return unit * unit * (0.5 * x * x + 0.25 * x * x * x * x) + rest * unit * (x + x * x * x) +
           0.5 * MPM_SIDE_MOST_SLOPE * rest * rest;
}

floe_status mpm_follow_overlaps(mpm *s)
{
    memset(s->overlaps->next, 0, s->overlaps->n * sizeof *s->overlaps->next);
    s->overlaps->followed = true;
    follow_sides(s);
    return FLOE_OK;
}
