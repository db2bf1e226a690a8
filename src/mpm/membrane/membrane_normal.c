#include "mpm/membrane/membrane_normal.h"

#include "base/memory.h"
#include "mpm/membrane/membrane_curve.h"
#include "mpm/nodes/sides.h"

#include <math.h>
#include <string.h>

bool normals_are_free(const mpm *s, int body)
{
    const surface_method *m = s->scene->body[s->body[body].scene_body].membrane.normals;
    return s->body[body].membrane.model && m && !m->connected;
}

/* The numbers of the normals that are there, in the order of the points' numbers; a lost point has none. */
static void load_normals(const mpm *s, int body, double *by_number)
{
    memset(by_number, 0, 3 * s->curve[body].n * sizeof *by_number);
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int a = 0; a < s->mesh->dim; ++a) {
            const double *n = field_get(s->domain->fields[b], P_NORMAL, body, a);
            for (size_t k = 0; k < s->points[b][body].n; ++k)
                by_number[3 * point_number(s, b, body, k) + (size_t)a] = n[k];
        }
}

/* A point without a direction keeps the normal that it had. */
static void store_normals(const mpm *s, int body, bool next)
{
    const membrane_normals *n = &s->normals[body];
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int a = 0; a < s->mesh->dim; ++a) {
            double *to = (next ? field_next : field_get)(s->domain->fields[b], P_NORMAL, body, a);
            for (size_t k = 0; k < s->points[b][body].n; ++k) {
                const size_t number = point_number(s, b, body, k);
                const surface_estimate *e = &n->estimate[number];
                to[k] = e->basis == SURFACE_NONE ? n->before[3 * number + (size_t)a] : e->normal[a];
            }
        }
}

static void count_bases(mpm *s, const membrane_normals *n)
{
    long long of[SURFACE_BASES] = {0};
    for (size_t k = 0; k < n->set.points.n; ++k)
        if (n->set.points.entry[k].image == 0) of[n->estimate[n->set.points.entry[k].number].basis]++;
    if (of[SURFACE_PLAIN] > 0) ledger_tally(s->ledger, COUNT_NORMALS_PLAIN, of[SURFACE_PLAIN]);
    if (of[SURFACE_NONE] > 0) ledger_tally(s->ledger, COUNT_NORMALS_KEPT, of[SURFACE_NONE]);
}

/* Places of the fluids' points, body by body in the order of their numbers. */
static void load_inside(const mpm *s, membrane_normals *n, bool next)
{
    size_t first = 0;
    for (size_t k = 0; k < 3 * n->n_inside; ++k) n->inside[k] = k % 3 < (size_t)s->mesh->dim ? (double)NAN : 0.0;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (!s->body[body].fluid) continue;
        for (int b = 0; b < s->mesh->n_blocks; ++b)
            for (int a = 0; a < s->mesh->dim; ++a) {
                const double *x = (next ? field_next : field_get)(s->domain->fields[b], P_POS, body, a);
                for (size_t k = 0; k < s->points[b][body].n; ++k)
                    n->inside[3 * (first + point_number(s, b, body, k)) + (size_t)a] = x[k];
            }
        first += n->seeded[body];
    }
}

/* Neighbours along the line, from where the points and their normals are. */
static void link_points(const mpm *s, const membrane_normals *n, membrane_curve *curve)
{
    surface_links(&n->set, n->estimate, n->link);
    for (size_t k = 0; k < 2 * curve->n; ++k) {
        const surface_link *l = &n->link[k];
        curve->link[k] = (curve_link){.of = l->of, .mirror.axis = l->axis};
        if (l->axis >= 0)
            curve->link[k].mirror.plane = l->side == SIDE_LOWER ? s->mesh->lower[l->axis] : s->mesh->upper[l->axis];
    }
}

/* Normals of a body from where its points are now, or next. */
static floe_status make_normals(mpm *s, int body, bool next)
{
    membrane_normals *n = &s->normals[body];
    membrane_curve *curve = &s->curve[body];
    const scene_membrane *m = &s->scene->body[s->body[body].scene_body].membrane;
    membrane_curve_update(s, body, next);
    TRY(surface_set_points(&n->set, curve->n, curve->x));
    if (n->inside) {
        load_inside(s, n, next);
        TRY(surface_set_inside(&n->set, n->n_inside, n->inside));
    }
    surface_normals(&n->set, m->normals, m->normals_par, n->estimate);
    TRY(surface_orient(&n->set, n->before, n->estimate));
    store_normals(s, body, next);
    if (curve->link) link_points(s, n, curve);
    return FLOE_OK;
}

floe_status mpm_membrane_normals(mpm *s)
{
    for (int body = 0; body < s->n_bodies; ++body) {
        if (!normals_are_free(s, body)) continue;
        load_normals(s, body, s->normals[body].before);
        TRY(make_normals(s, body, true));
        count_bases(s, &s->normals[body]);
    }
    return FLOE_OK;
}

static floe_status allocate_inside(const mpm *s, membrane_normals *n)
{
    for (int body = 0; body < s->n_bodies; ++body) {
        n->seeded[body] = s->body[body].fluid ? mpm_body_points(s, body) : 0;
        n->n_inside += n->seeded[body];
    }
    return memory_new(s->ctx, &n->inside, 3 * n->n_inside, sizeof *n->inside);
}

floe_status normals_start(mpm *s, int body)
{
    membrane_normals *n = &s->normals[body];
    surface_set_init(&n->set, s->ctx, s->mesh);
    n->set.measures = false;
    for (int a = 0; a < s->mesh->dim; ++a)
        for (int side = 0; side < 2; ++side) n->set.mirror[a][side] = wall_mirrors(s, s->body[body].group, a, side);
    TRY(memory_new(s->ctx, &n->estimate, s->curve[body].n, sizeof *n->estimate));
    TRY(memory_new(s->ctx, &n->before, 3 * s->curve[body].n, sizeof *n->before));
    if (s->curve[body].link) TRY(memory_new(s->ctx, &n->link, 2 * s->curve[body].n, sizeof *n->link));
    if (s->scene->body[s->body[body].scene_body].membrane.normals->needs_inside) TRY(allocate_inside(s, n));
    return make_normals(s, body, false);
}

void normals_free(membrane_normals *n)
{
    if (!n->set.ctx) return;
    context *ctx = n->set.ctx;
    memory_free(ctx, &n->estimate);
    memory_free(ctx, &n->before);
    memory_free(ctx, &n->inside);
    memory_free(ctx, &n->link);
    surface_set_free(&n->set);
}
