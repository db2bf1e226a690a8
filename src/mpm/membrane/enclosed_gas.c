/* Gas points that a surface in three dimensions encloses. The surface is closed, alone or by mirrors.
 *
 * Sums over points are not exact integrals. Gas of uniform pressure p exerts the force p sum_p V_p grad S_i(x_p) on
 * interior nodes, which should vanish, and its volume changes by sum_p V_p div v(x_p), which should be the change of
 * the enclosed volume V. The points move until these sums vanish; their volumes then exceed V, and the force on the
 * surface is not uniform. Therefore a gas point exerts only p_p - p, with the mean pressure p = sum_p p_p V_p/V, the
 * surface bears the force p A n at each of its points, and once a step all volumes are scaled by V/sum_p V_p. The work
 * of this scaling is taken from the gas, so that the work done on the surface equals the energy lost by the gas. With
 * the material vectors a of the surface
 *
 *   A = V0/thickness |a1 x a2|/|a1 x a2|_0,   V = sum_p (x_p - c) n A along each axis, c the mirror that cuts the surface, if any:
 *
 * Along an axis on which mirrors cut the surface on both sides the areas of the caps are not known; V is the mean over
 * the other axes. */
#include "mpm/membrane/enclosed_gas.h"

#include "base/memory.h"
#include "grid/tile_box.h"
#include "math/tensor.h"
#include "mpm/membrane/membrane_curve.h"
#include "mpm/membrane/membrane_points.h"
#include "mpm/membrane/membrane_sheet.h"
#include "mpm/nodes/sides.h"
#include "mpm/transfer/scratch.h"
#include "mpm/transfer/stencil.h"

#include <math.h>
#include <string.h>

bool is_enclosed_gas(const mpm *s, int body)
{
    const gas_enclosure *h = s->enclosure;
    return h && h->n > 0 && s->body[body].fluid && s->body[body].scene_material == h->material;
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
    const double rest = field_get(f, P_VOLUME0, body, 0)[k] / m->thickness;
    return rest * (m->section == SECTION_THICKNESS ? 1.0 : exp(2.0 * slack)) * vec_norm(across);
}

/* Area vectors (m2) of the surface by number of its points, into h->force, and the sum of areas (m2). */
static double measure_areas(mpm *s, gas_enclosure *h)
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
typedef struct enclosure_axis {
    bool cut[2];   /* by the mirror of that side: it comes to within a cell of it */
    double plane;  /* m: coordinate of that mirror, or any other */
    double net;    /* m2: sum of the area vectors */
    double volume; /* m3: sum_p (x_p - plane) n A */
} enclosure_axis;

static enclosure_axis look_along(const mpm *s, const gas_enclosure *h, int axis)
{
    const mesh *m = s->mesh;
    const double *x = s->curve[h->body].x;
    enclosure_axis out = {.plane = 0.5 * (m->lower[axis] + m->upper[axis])};
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
        if (!is_lost(x, k)) out.volume += (x[3 * k + (size_t)axis] - out.plane) * h->force[3 * k + (size_t)axis];
    return out;
}

static bool tells_volume(const enclosure_axis *a)
{
    return !(a->cut[0] && a->cut[1]);
}

/* Enclosed volume (m3), the mean over the axes that determine it; negative where normals point inwards, NAN where no
 * axis does. */
static double mean_volume(const enclosure_axis axis[3])
{
    double sum = 0.0;
    int n = 0;
    for (int a = 0; a < 3; ++a) {
        if (!tells_volume(&axis[a])) continue;
        sum += axis[a].volume;
        n++;
    }
    return n > 0 ? sum / n : (double)NAN;
}

/* Area vectors, positions, and the volume that they give along each axis. Returns the area (m2). */
static double measure_enclosure(mpm *s, gas_enclosure *h, enclosure_axis axis[3])
{
    membrane_curve_update(s, h->body, false);
    const double area = measure_areas(s, h);
    for (int a = 0; a < 3; ++a) axis[a] = look_along(s, h, a);
    return area;
}

enum { SUM_WORK, SUM_VOLUME, GAS_SUMS };

/* p V (J, of gauge pressures) and V (m3) of the gas. */
static void add_gas_in_tile(mpm *s, int blk, int tile, void *unused, double *sum)
{
    (void)unused;
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *at = s->points[blk][body].tile_start;
        if (!is_enclosed_gas(s, body)) continue;
        const fields *f = s->domain->fields[blk];
        const double *volume0 = field_get(f, P_VOLUME0, body, 0), *J = field_get(f, P_J, body, 0), *stress[3];
        for (int c = 0; c < 3; ++c) stress[c] = field_get(f, P_STRESS, body, c);
        for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
            const double volume = volume0[k] * J[k];
            sum[SUM_WORK] -= volume * (stress[0][k] + stress[1][k] + stress[2][k]) / 3.0;
            sum[SUM_VOLUME] += volume;
        }
    }
}

/* From area vectors to forces. A closed surface feels none as a whole; one that a mirror cuts has that of the gas on
 * the mirror. */
static void load_surface(mpm *s, gas_enclosure *h, const enclosure_axis axis[3], double outwards, double area)
{
    const double pressure = copysign(h->pressure, h->pressure * outwards), *x = s->curve[h->body].x;
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
                       s->kick * pressure * axis[a].net);
        ledger_turn(s->ledger, LEDGER_BOUNDARY, moment, s->kick);
    }
}

floe_status mpm_enclosed_pressure(mpm *s)
{
    gas_enclosure *h = s->enclosure;
    enclosure_axis axis[3];
    double sum[GAS_SUMS];
    const double area = measure_enclosure(s, h, axis), volume = mean_volume(axis);
    sum_over_tiles(s, GAS_SUMS, add_gas_in_tile, NULL, sum);
    h->pressure = sum[SUM_WORK] / fabs(volume);
    h->growth = fabs(volume) / sum[SUM_VOLUME];
    if (!isfinite(h->pressure) || !isfinite(h->growth) || volume == 0.0)
        return fail(s->ctx, FLOE_DIVERGED,
                    "at t = %.6g s membrane '%s' encloses no volume: it lies on too many mirrors, or is lost", s->time,
                    s->scene->body[s->body[h->body].scene_body].name);
    load_surface(s, h, axis, volume, area);
    return FLOE_OK;
}

double mpm_enclosed_volume(mpm *s, int body)
{
    gas_enclosure *h = s->enclosure;
    enclosure_axis axis[3];
    if (!h || h->n == 0 || h->body != body) return NAN;
    (void)measure_enclosure(s, h, axis);
    return fabs(mean_volume(axis));
}

void scatter_enclosed_pressure(mpm *s, int group)
{
    const gas_enclosure *h = s->enclosure;
    if (!h || h->n == 0 || s->body[h->body].group != group) return;
    const double *x = s->curve[h->body].x;
    for (size_t k = 0; k < h->n; ++k)
        if (!is_lost(x, k)) push_nodes(s, group, x + 3 * k, h->force + 3 * k);
}

void scale_to_enclosed_volume(const mpm *s, int body, solid_batch *b)
{
    if (!is_enclosed_gas(s, body)) return;
    const double growth = s->enclosure->growth;
    for (size_t k = 0; k < b->n; ++k) b->J[k] *= growth;
    for (size_t k = 0; k < b->n && s->step == 0; ++k)
        b->J_old[k] *= growth; /* at the start the gas fills the enclosed volume without work */
}

/* Volumes by different axes are equal where the surface is closed. */
static floe_status check_closed(mpm *s, gas_enclosure *h)
{
    enclosure_axis axis[3];
    (void)measure_enclosure(s, h, axis);
    const double volume = mean_volume(axis);
    const char *name = s->scene->body[s->body[h->body].scene_body].name;
    if (isnan(volume))
        return fail_key(s->ctx, KEY("bodies", name, "membrane", "encloses"),
                        "it lies between mirrors on all axes, and its volume is not known: leave one of them free");
    for (int a = 0; a < 3; ++a)
        if (tells_volume(&axis[a]) && !(fabs(axis[a].volume - volume) < 0.2 * fabs(volume)))
            return fail_key(s->ctx, KEY("bodies", name, "membrane", "encloses"),
                            "it is not closed, alone or with mirrors: along %c it encloses %g m3, on average %g m3; "
                            "close it, or let mirrors cut it",
                            "xyz"[a], fabs(axis[a].volume), fabs(volume));
    return FLOE_OK;
}

floe_status start_enclosure(mpm *s)
{
    gas_enclosure *h = s->enclosure;
    const int holder = scene_enclosing_body(s->scene);
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].scene_body == holder) h->body = b;
    h->material = s->scene->body[holder].membrane.encloses;
    h->n = s->curve[h->body].n;
    TRY(memory_new(s->ctx, &h->force, 3 * h->n, sizeof *h->force));
    TRY(memory_new(s->ctx, &h->area, h->n, sizeof *h->area));
    return check_closed(s, h);
}

void free_enclosure(mpm *s)
{
    if (!s->enclosure) return;
    memory_free(s->ctx, &s->enclosure->force);
    memory_free(s->ctx, &s->enclosure->area);
    memory_free(s->ctx, &s->enclosure);
}
