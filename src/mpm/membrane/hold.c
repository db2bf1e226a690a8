/* Gas points held by a surface in space, which is closed, alone or with mirrors.
 *
 * Sums over points are no exact integrals: gas of uniform pressure p pushes the nodes inside it by p sum_p V_p grad
 * S_i(x_p), which should be nothing, and swells by sum_p V_p div v(x_p), which should be the change of the room. The
 * points move until the sums vanish, their volumes outgrow the room, and the surface is pushed unevenly. Here points
 * push by p_p - p alone, p = sum_p p_p V_p/room, the surface bears p A n at each of its points, and once a step all
 * volumes grow by room/sum_p V_p, at the cost of their work, so that what p does on the surface is what it takes from
 * the gas. With the material vectors a of the surface
 *
 *   A = V0/thickness |a1 x a2|/|a1 x a2|_0,   room = sum_p (x_p - c) n A along each axis, c the mirror that cuts the surface, if any:
 *
 * of an axis whose mirrors cut it on both sides the caps are not known; the mean is taken over the others. */
#include "mpm/membrane/hold.h"

#include "base/memory.h"
#include "math/tensor.h"
#include "mpm/membrane/line.h"
#include "mpm/membrane/membrane.h"
#include "mpm/membrane/membrane_sheet.h"
#include "mpm/stencil.h"
#include "mpm/wall.h"

#include <math.h>
#include <string.h>

bool is_held(const mpm *s, int body)
{
    const gas_hold *h = &s->work->hold;
    return h->n > 0 && s->body[body].fluid && s->body[body].scene_material == h->material;
}

static double area_of(const mpm *s, const fields *f, int body, size_t k, double slack)
{
    const scene_membrane *m = &s->scene->body[s->body[body].scene_body].membrane;
    double a[2][3], across[3];
    for (int i = 0; i < 3; ++i) {
        a[0][i] = field_get(f, P_SURFACE_1, body, i)[k];
        a[1][i] = field_get(f, P_SURFACE_2, body, i)[k];
    }
    vec_cross(a[0], a[1], across);
    return field_get(f, P_VOLUME0, body, 0)[k] / m->thickness * exp(2.0 * slack) * vec_norm(across);
}

/* Area vectors (m2) of the surface by number of its points, into h->force, and the sum of areas (m2). */
static double measure_areas(mpm *s, gas_hold *h)
{
    double sum = 0.0;
    memset(h->force, 0, 3 * h->n * sizeof *h->force);
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
        const fields *f = s->domain->fields[b];
        for (size_t k = 0; k < s->points[b][h->body].n; ++k) {
            const size_t number = point_number(s, b, h->body, k);
            const double area = area_of(s, f, h->body, k, slack_of(s, h->body, number));
            h->area[number] = area;
            for (int a = 0; a < 3; ++a) h->force[3 * number + (size_t)a] = area * field_get(f, P_NORMAL, h->body, a)[k];
        }
    }
    for (size_t k = 0; k < h->n; ++k) sum += h->area[k];
    return sum;
}

static bool is_lost(const double *x, size_t k)
{
    return isnan(x[3 * k]);
}

/* How the surface lies along an axis. */
typedef struct hold_axis {
    bool cut[2];  /* by the mirror of that side: it comes to within a cell of it */
    double plane; /* m: where that mirror stands, or any other place */
    double net;   /* m2: sum of the area vectors */
    double room;  /* m3: sum_p (x_p - plane) n A */
} hold_axis;

static hold_axis look_along(const mpm *s, const gas_hold *h, int axis)
{
    const mesh *m = s->mesh;
    const double *x = s->work->line[h->body].x;
    hold_axis out = {.plane = 0.5 * (m->lower[axis] + m->upper[axis])};
    double least[2] = {INFINITY, INFINITY};
    for (size_t k = 0; k < h->n; ++k) {
        if (is_lost(x, k)) continue;
        least[0] = fmin(least[0], x[3 * k + (size_t)axis] - m->lower[axis]);
        least[1] = fmin(least[1], m->upper[axis] - x[3 * k + (size_t)axis]);
        out.net += h->force[3 * k + (size_t)axis];
    }
    for (int side = 0; side < 2; ++side) {
        out.cut[side] = wall_mirrors(s, s->body[h->body].group, axis, side) && least[side] < m->h[axis];
        if (out.cut[side]) out.plane = side ? m->upper[axis] : m->lower[axis];
    }
    for (size_t k = 0; k < h->n; ++k)
        if (!is_lost(x, k)) out.room += (x[3 * k + (size_t)axis] - out.plane) * h->force[3 * k + (size_t)axis];
    return out;
}

static bool tells_room(const hold_axis *a)
{
    return !(a->cut[0] && a->cut[1]);
}

/* Room (m3) inside, the mean over the axes that tell it; negative where normals look inwards, NAN where none does. */
static double room_of(const hold_axis axis[3])
{
    double sum = 0.0;
    int n = 0;
    for (int a = 0; a < 3; ++a) {
        if (!tells_room(&axis[a])) continue;
        sum += axis[a].room;
        n++;
    }
    return n > 0 ? sum / n : (double)NAN;
}

/* Area vectors, places and what they make along each axis. Returns the area (m2). */
static double measure(mpm *s, gas_hold *h, hold_axis axis[3])
{
    line_update(s, h->body, false);
    const double area = measure_areas(s, h);
    for (int a = 0; a < 3; ++a) axis[a] = look_along(s, h, a);
    return area;
}

enum { SUM_WORK, SUM_VOLUME, HOLD_SUMS };

/* sum p V (J, of gauge pressures) and sum V (m3) of the gas. */
static void sum_gas(const mpm *s, double sum[HOLD_SUMS])
{
    memset(s->work->tile_sum, 0, mesh_tiles(s->mesh) * HOLD_SUMS * sizeof(double));
    for (int b = 0; b < s->mesh->n_blocks; ++b) {
#pragma omp parallel for schedule(dynamic, 4)
        for (int t = 0; t < s->mesh->block[b].n_tiles; ++t) {
            double *to = s->work->tile_sum + (size_t)tile_box_of(s->mesh, &s->mesh->block[b], t).number * HOLD_SUMS;
            for (int body = 0; body < s->n_bodies; ++body) {
                const size_t *at = s->points[b][body].tile_start;
                if (!is_held(s, body)) continue;
                const point_arrays p = points_of(s, b, body, false, false);
                for (size_t k = at[t]; k < at[t + 1]; ++k) {
                    const double volume = p.volume0[k] * p.J[k];
                    to[SUM_WORK] -= volume * (p.stress[0][k] + p.stress[1][k] + p.stress[2][k]) / 3.0;
                    to[SUM_VOLUME] += volume;
                }
            }
        }
    }
    domain_sum_tiles(s->mesh, s->work->tile_sum, HOLD_SUMS, sum);
}

/* From area vectors to forces. A closed surface feels none as a whole; one that a mirror cuts has that of the gas on
 * the mirror. */
static void load_surface(mpm *s, gas_hold *h, const hold_axis axis[3], double outwards, double area)
{
    const double pressure = copysign(h->pressure, h->pressure * outwards), *x = s->work->line[h->body].x;
    for (int a = 0; a < 3; ++a) {
        const bool cut = axis[a].cut[0] || axis[a].cut[1];
        const double spread = cut ? 0.0 : axis[a].net / area;
        for (size_t k = 0; k < h->n; ++k) {
            double *force = h->force + 3 * k + a;
            *force = pressure * (*force - spread * h->area[k]);
        }
        double moment[3] = {0.0};
        for (size_t k = 0; cut && k < h->n; ++k)
            if (!is_lost(x, k)) add_moment(moment, x + 3 * k, a, h->force[3 * k + (size_t)a]);
        if (cut)
            ledger_add(s->ledger, (ledger_quantity)(LEDGER_MOMENTUM_X + a), LEDGER_BOUNDARY,
                       s->work->kick * pressure * axis[a].net);
        ledger_turn(s->ledger, LEDGER_BOUNDARY, moment, s->work->kick);
    }
}

floe_status mpm_hold_gas(mpm *s)
{
    gas_hold *h = &s->work->hold;
    hold_axis axis[3];
    double sum[HOLD_SUMS];
    const double area = measure(s, h, axis), room = room_of(axis);
    sum_gas(s, sum);
    h->pressure = sum[SUM_WORK] / fabs(room);
    h->growth = fabs(room) / sum[SUM_VOLUME];
    if (!isfinite(h->pressure) || !isfinite(h->growth) || room == 0.0)
        return fail(s->ctx, FLOE_DIVERGED,
                    "at t = %.6g s membrane '%s' encloses no room: it lies on too many mirrors, or is lost", s->time,
                    s->scene->body[s->body[h->body].scene_body].name);
    load_surface(s, h, axis, room, area);
    return FLOE_OK;
}

double mpm_held_room(mpm *s, int body)
{
    gas_hold *h = &s->work->hold;
    hold_axis axis[3];
    if (h->n == 0 || h->body != body) return NAN;
    (void)measure(s, h, axis);
    return fabs(room_of(axis));
}

void scatter_hold(mpm *s, int group)
{
    const gas_hold *h = &s->work->hold;
    if (h->n == 0 || s->body[h->body].group != group) return;
    const double *x = s->work->line[h->body].x;
    for (size_t k = 0; k < h->n; ++k)
        if (!is_lost(x, k)) push_nodes(s, group, x + 3 * k, h->force + 3 * k);
}

void fill_room(const mpm *s, int body, solid_batch *b)
{
    if (!is_held(s, body)) return;
    const double growth = s->work->hold.growth;
    for (size_t k = 0; k < b->n; ++k) b->J[k] *= growth;
    for (size_t k = 0; k < b->n && s->step == 0; ++k)
        b->J_old[k] *= growth; /* at the start gas fills the room, and does no work */
}

/* Rooms along different axes are the same where the surface is closed. */
static floe_status check_closed(mpm *s, gas_hold *h)
{
    hold_axis axis[3];
    (void)measure(s, h, axis);
    const double room = room_of(axis);
    const char *name = s->scene->body[s->body[h->body].scene_body].name;
    if (isnan(room))
        return fail_key(s->ctx, KEY("bodies", name, "membrane", "encloses"),
                        "it lies between mirrors on all axes, and its room is not known: leave one of them free");
    for (int a = 0; a < 3; ++a)
        if (tells_room(&axis[a]) && !(fabs(axis[a].room - room) < 0.2 * fabs(room)))
            return fail_key(s->ctx, KEY("bodies", name, "membrane", "encloses"),
                            "it is not closed, alone or with mirrors: along %c it encloses %g m3, on average %g m3; "
                            "close it, or let mirrors cut it",
                            "xyz"[a], fabs(axis[a].room), fabs(room));
    return FLOE_OK;
}

floe_status start_hold(mpm *s)
{
    gas_hold *h = &s->work->hold;
    const int holder = scene_holder(s->scene);
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].scene_body == holder) h->body = b;
    h->material = s->scene->body[holder].membrane.holds;
    h->n = s->work->line[h->body].n;
    TRY(memory_new(s->ctx, &h->force, 3 * h->n, sizeof *h->force));
    TRY(memory_new(s->ctx, &h->area, h->n, sizeof *h->area));
    return check_closed(s, h);
}

void free_hold(context *ctx, gas_hold *h)
{
    memory_free(ctx, &h->force);
    memory_free(ctx, &h->area);
}
