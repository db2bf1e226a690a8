/* Overlaps: space for them, and the law of the springs (wall_overlap.h). */
#include "mpm/wall_overlap.h"

#include "base/memory.h"
#include "mpm/wall.h"

#include <math.h>
#include <string.h>

/* w over c/h. At 1 half a cell's mass on such a spring is damped just critically by the waves that it sends into its body (impedance
 * rho c); stiffer, it swings by itself, at a frequency that the mesh does not carry and transfers take away. A bar of 8, 16 and 32 cells that meets
 * a side keeps 0.986, 0.995, 0.996 of its energy; with 0.7 it keeps 0.994, 0.997, 0.998, and is pressed for longer; with 1.2 it keeps 0.952, 0.985, 0.996. */
static const double stiffness_factor = 0.85;
/* Cells: where the force is twice that of the first slope; and the slope at which hardening ends, over the first. */
static const double hardening = 0.5, most_slope = 8.0;

static double modulus_of(const mpm_body *b)
{
    if (b->membrane.model) return b->membrane.model->modulus(b->membrane.par, b->membrane.biaxial);
    return b->law->bulk_modulus(b->law_par) + 4.0 / 3.0 * b->law->shear_modulus(b->law_par);
}

static overlap_surface surface_of(const mpm *s, const mpm_body *b)
{
    overlap_surface r = {.flows = (double)INFINITY};
    r.speed = sqrt(modulus_of(b) / s->scene->material[b->scene_material].density);
    /* Domains of CPDI are cut at such sides, and what overlaps them is cut to small volume fractions whose slopes tear
     * the body: it is all but stopped at once. */
    if (s->basis->fact.shaped)
        r.flows = 1e-3;
    else if (!b->membrane.model && b->law->yield_stress)
        r.flows = b->law->yield_stress(b->law_par) /
                  (stiffness_factor * stiffness_factor * b->law->shear_modulus(b->law_par));
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

static size_t all_nodes(const struct mpm_overlaps *o)
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
                o->n += all_nodes(o) / (size_t)o->nodes[a];
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

void overlaps_follow(mpm *s)
{
    memset(s->overlaps->next, 0, s->overlaps->n * sizeof *s->overlaps->next);
    s->overlaps->followed = true;
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
    const double rate = stiffness_factor * speed / h;
    return mass * rate * rate;
}

/* Where hardening ends: 1 + 3 x^2 = most_slope, x in units of `hardening`. */
static double last_hardening(void)
{
    return sqrt((most_slope - 1.0) / 3.0);
}

double overlap_push(double overlap, double h)
{
    const double unit = hardening * h, x = fmin(overlap / unit, last_hardening());
    return unit * (x + x * x * x) + most_slope * (overlap - x * unit);
}

double overlap_energy(double overlap, double h)
{
    if (!(overlap > 0.0)) return 0.0;
    const double unit = hardening * h, x = fmin(overlap / unit, last_hardening()), rest = overlap - x * unit;
    return unit * unit * (0.5 * x * x + 0.25 * x * x * x * x) + rest * unit * (x + x * x * x) +
           0.5 * most_slope * rest * rest;
}

floe_status mpm_follow_overlaps(mpm *s)
{
    overlaps_follow(s);
    follow_sides(s);
    return FLOE_OK;
}
