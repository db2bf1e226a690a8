/* Exchange coefficients of each pair of materials in a cell: constants, laws that depend on the state there, and the frame in which a pair slips (theory
 * 2.9). Scenes with constant coefficients and without slip do not use this file during the step. */
#include "ice/exchange/ice_pairs.h"
#include "coupling/exchange_law.h"

#include "base/memory.h"
#include "ice/ice_constants.h"
#include "ice/sides/ice_sides.h"

#include <math.h>

/* ---- resolving ---- */

static void set_pair(exchange_matrix m, int r, int q, double value)
{
    m[r][q] = m[q][r] = value;
}

/* Enters a constant; a law that depends on the state is stored, and evaluated at each position. */
static floe_status resolve_law(ice *s, const scene_exchange *given, scene_exchange_law law, ice_coefficient which,
                               int r, int q)
{
    ice_pairs *pairs = s->pairs;
    const exchange_law *model = &law.model->law[which == ICE_HEAT ? EXCHANGE_HEAT : EXCHANGE_MOMENTUM];
    if (model->uniform) {
        set_pair(pairs->table[which], r, q, model->coefficient(law.par, NULL));
        return FLOE_OK;
    }
    const double viscosity[2] = {s->material[r].shear_viscosity, s->material[q].shear_viscosity};
    const char *lacks = model->check ? model->check(law.par, viscosity) : NULL;
    if (lacks)
        return fail_key(s->ctx, KEY("exchange", given->name, which == ICE_HEAT ? "heat" : "momentum"), "law '%s': %s",
                        law.model->name, lacks);
    set_pair(pairs->table[which], r, q, 0.0);
    pairs->law[pairs->n++] = (ice_pair_law){r, q, which, model, law.par};
    return FLOE_OK;
}

/* The material whose surface gives the frame: the one that is carried by points, else the first. */
static void mark_wall(ice *s, int r, int q)
{
    s->pairs->slips = true;
    s->pairs->wall[s->material[q].points && !s->material[r].points ? q : r] = true;
}

static floe_status resolve_pair(ice *s, const scene_exchange *e)
{
    const int r = ice_material_of(s, e->material[0]), q = ice_material_of(s, e->material[1]);
    if (r < 0 || q < 0) return FLOE_OK; /* no body of one of them is in the scene */
    if (e->momentum.model) {
        TRY(resolve_law(s, e, e->momentum, ICE_NORMAL, r, q));
        if (!e->tangential.model) TRY(resolve_law(s, e, e->momentum, ICE_TANGENTIAL, r, q));
    }
    if (e->tangential.model) {
        TRY(resolve_law(s, e, e->tangential, ICE_TANGENTIAL, r, q));
        mark_wall(s, r, q);
    }
    return e->heat.model ? resolve_law(s, e, e->heat, ICE_HEAT, r, q) : FLOE_OK;
}

/* A liquid without viscosity slips along a solid, unless the deck says otherwise. A gas does not: in the cells of an oblique wall it is so light
 * that the pressure on the wall drives it along the surface, through the error of the normal (the pressurised cylinder diverges). */
static bool slips_by_default(const ice *s, int r, int q)
{
    const ice_material *fluid = &s->material[s->material[r].points ? q : r];
    const bool beside = s->material[r].points != s->material[q].points;
    return isnan(s->scene->method.exchange) && s->mesh->dim > 1 && beside && fluid->shear_viscosity == 0.0 &&
           eos_is_liquid(&fluid->eos);
}

/* Pairs that the deck names nowhere. */
static void resolve_others(ice *s)
{
    const double given = s->scene->method.exchange, all = isfinite(given) ? given : EXCHANGE_LOCKED;
    exchange_table *t = &s->exchange;
    for (int r = 0; r < s->n_materials; ++r)
        for (int q = 0; q < r; ++q) {
            const bool slips = slips_by_default(s, r, q);
            set_pair(t->K, r, q, all);
            set_pair(t->Kt, r, q, slips ? 0.0 : all);
            set_pair(t->R, r, q, s->scene->method.heat_exchange);
            if (slips) mark_wall(s, r, q);
        }
}

floe_status ice_pairs_create(ice *s)
{
    exchange_table *t = &s->exchange;
    TRY(memory_new(s->ctx, &s->pairs, 1, sizeof *s->pairs));
    ice_pairs *pairs = s->pairs;
    t->n = s->n_materials;
    pairs->table[ICE_NORMAL] = t->K;
    pairs->table[ICE_TANGENTIAL] = t->Kt;
    pairs->table[ICE_HEAT] = t->R;
    resolve_others(s);
    for (int i = 0; i < s->scene->n_exchanges; ++i) TRY(resolve_pair(s, &s->scene->exchange[i]));
    for (int r = 0; r < s->n_materials; ++r)
        for (int q = 0; q < r; ++q) {
            pairs->heat = pairs->heat || t->R[r][q] > 0.0;
            pairs->unlike = pairs->unlike || t->K[r][q] != t->K[0][1];
        }
    for (int i = 0; i < pairs->n; ++i) pairs->heat = pairs->heat || pairs->law[i].which == ICE_HEAT;
    for (int r = 0; r < s->n_materials; ++r) pairs->prescribed = pairs->prescribed || s->material[r].prescribed;
    pairs->plain = pairs->n == 0 && !pairs->slips && !pairs->prescribed;
    return FLOE_OK;
}

void ice_pairs_destroy(context *ctx, ice_pairs **w)
{
    memory_free(ctx, w);
}

bool ice_some_pair_slips(const ice *s)
{
    return s->pairs->slips;
}

bool ice_some_pair_asks(const ice *s)
{
    return !s->pairs->plain;
}

/* ---- at a place ---- */

static exchange_pair pair_at(const ice_view *v, const ice_spot *spot, int r, int q)
{
    double square = 0.0;
    for (int a = 0; a < v->dim; ++a) square += pow(spot->u[a][r] - spot->u[a][q], 2.0);
    return (exchange_pair){.theta = {spot->theta[r], spot->theta[q]},
                           .density = {spot->density[r], spot->density[q]},
                           .viscosity = {v->material[r].shear_viscosity, v->material[q].shear_viscosity},
                           .slip = sqrt(square)};
}

double (*ice_constants_of(const ice *s, const ice_view *v, ice_coefficient which))[EXCHANGE_MAX]
{
    return (double(*)[EXCHANGE_MAX]) & s->pairs->table[which][v->first][v->first];
}

double (*ice_coefficients(const ice *s, const ice_view *v, ice_coefficient which, const ice_spot *spot,
                          exchange_matrix own))[EXCHANGE_MAX]
{
    const ice_pairs *pairs = s->pairs;
    double(*const constants)[EXCHANGE_MAX] = ice_constants_of(s, v, which);
    if (pairs->n == 0) return constants;
    for (int r = 0; r < v->n_materials; ++r)
        for (int q = 0; q < v->n_materials; ++q) own[r][q] = constants[r][q];
    for (int i = 0; i < pairs->n; ++i) {
        const ice_pair_law *law = &pairs->law[i];
        const int r = law->first - v->first, q = law->second - v->first;
        if (law->which != which || r < 0 || q < 0 || r >= v->n_materials || q >= v->n_materials) continue;
        const exchange_pair pair = pair_at(v, spot, r, q);
        set_pair(own, r, q, law->model->coefficient(law->par, &pair));
    }
    return own;
}

static double wall_fraction(const ice *s, const ice_view *v, ptrdiff_t at)
{
    double sum = 0.0;
    for (int r = 0; r < v->n_materials; ++r)
        if (s->pairs->wall[v->first + r]) sum += v->m[r].theta[at];
    return sum;
}

/* Binomial weights over five cells along each axis, of those that no solid with a sharp surface fills. A normal that is off by eps takes sin^2(eps) of the slip a step from gas that is
 * locked along it: the smoother the fraction, the less (SMOOTH). */
static double smoothed_fraction(const ice *s, const ice_view *v, ptrdiff_t at)
{
    static const double weight[5] = {1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0};
    const ptrdiff_t *st = v->b->stride;
    const int nb = v->dim > 1 ? 2 : 0, nc = v->dim > 2 ? 2 : 0;
    const double *open = v->m[0].open;
    double sum = 0.0, all = 0.0;
    for (int k = -nc; k <= nc; ++k)
        for (int j = -nb; j <= nb; ++j)
            for (int i = -2; i <= 2; ++i) {
                const double w = weight[i + 2] * (nb ? weight[j + 2] : 1.0) * (nc ? weight[k + 2] : 1.0);
                const ptrdiff_t there = at + i * st[0] + (nb ? j * st[1] : 0) + (nc ? k * st[2] : 0);
                if (open && !(open[there] > 0.0)) continue;
                sum += w * wall_fraction(s, v, there);
                all += w;
            }
    return all > 0.0 ? sum / all : 0.0; /* (all weights add up to 1 to the bit) */
}

floe_status ice_wall_fraction_of(ice *s, const ice_region *g)
{
    ice_view v;
    if (s->cut) ice_fill_ghosts(s, C_OPEN, g->first, FILL_CURRENT, GHOST_EVEN);
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_rows q = ice_rows_of(v.b, -1, 0);
#pragma omp parallel for schedule(static)
        for (int row = 0; row < q.n; ++row) {
            const ptrdiff_t base = ice_row_start(v.b, q, row);
            for (ptrdiff_t at = base; at < base + v.b->n[0]; ++at) v.wall[at] = smoothed_fraction(s, &v, at);
        }
    }
    ice_fill_ghosts(s, C_WALL, g->number, FILL_CURRENT, GHOST_EVEN);
    return FLOE_OK;
}

/* Differences over two cells along `axis`, weighted 1 2 1 across it (Youngs' gradient of a volume fraction). */
static double wall_slope(const ice_view *v, ptrdiff_t at, int axis)
{
    const ptrdiff_t *st = v->b->stride;
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const int nb = b < v->dim, nc = c < v->dim;
    double sum = 0.0, weight = 0.0;
    for (int j = -nb; j <= nb; ++j)
        for (int k = -nc; k <= nc; ++k) {
            const ptrdiff_t there = at + (nb ? j * st[b] : 0) + (nc ? k * st[c] : 0);
            const double w = (j == 0 ? 2.0 : 1.0) * (k == 0 ? 2.0 : 1.0);
            sum += w * (v->wall[there + st[axis]] - v->wall[there - st[axis]]);
            weight += w;
        }
    return 0.5 * sum / weight * v->inv_h[axis];
}

void ice_wall_gradient(const ice_view *v, ptrdiff_t at, double gradient[3])
{
    for (int a = 0; a < 3; ++a) gradient[a] = a < v->dim ? wall_slope(v, at, a) : 0.0;
}

bool ice_wall_normal(const ice_view *v, const double gradient[3], double normal[3])
{
    double square = 0.0;
    for (int a = 0; a < v->dim; ++a) square += gradient[a] * gradient[a];
    const double size = sqrt(square);
    for (int a = 0; a < 3; ++a) normal[a] = size > 0.0 ? gradient[a] / size : 0.0;
    return size * v->length > ICE_LEAST_WALL_SLOPE; /* none in a uniform mixture */
}

/* A solid bears a pressure that falls across it; the fluid in its cells is driven by that difference along the normal, and by the error of the
 * normal along the surface too, where nothing stops it. So it is dragged by the solid at the rate 30 |n . grad p|/(rho c) (1 - x)/x, with x from 0
 * where it fills less than ICE_LEAST_FLUID_FRACTION of a cell to 1 where it fills half: hard in gas, by as much as the fall is more than its own pressure over a
 * cell, next to not at all in liquids, and not by waves that run along the surface. Gases keep to their law: their slip is
 * asked for by name. */
static void drag_in_solids(const ice_view *v, const double *mass, const ice_spot *spot, const double normal[3],
                           exchange_matrix a, exchange_matrix across)
{
    double fluid = 0.0, slope_along = 0.0;
    for (int r = 0; r < v->n_materials; ++r)
        if (!v->material[r].points) fluid += spot->theta[r];
    if (!(fluid < ICE_DRAG_SHARE)) return;
    for (int x = 0; x < v->dim; ++x) slope_along += spot->slope[x] * normal[x];
    const double free = most((fluid - ICE_LEAST_FLUID_FRACTION) / (ICE_DRAG_SHARE - ICE_LEAST_FLUID_FRACTION), 0.0);
    for (int r = 0; r < v->n_materials; ++r)
        for (int q = 0; q < v->n_materials; ++q) {
            if (v->material[r].points == v->material[q].points) continue;
            const int f = v->material[r].points ? q : r;
            if (!eos_is_liquid(&v->material[f].eos)) continue;
            const double rate = ICE_DRAG_STRENGTH * fabs(slope_along) / (spot->density[f] * spot->sound[f]);
            const double drag = free > 0.0 ? mass[f] * rate * v->dt * (1.0 / free - 1.0) : (double)INFINITY;
            across[r][q] = most(across[r][q], least(a[r][q], drag));
        }
}

void ice_pressure_slope(const ice_view *v, ptrdiff_t at, double slope[3])
{
    for (int a = 0; a < 3; ++a) {
        const ptrdiff_t st = a < v->dim ? v->b->stride[a] : 0;
        slope[a] = a < v->dim ? 0.5 * (v->p[at + st] - v->p[at - st]) * v->inv_h[a] : 0.0;
    }
}

void ice_relax_spot(const ice *s, const ice_view *v, const double *mass, const ice_spot *spot, double factor,
                    const double *gradient, double u[3][EXCHANGE_MAX])
{
    const int n = v->n_materials;
    exchange_matrix own, a, across;
    double normal[3];
    exchange_couple(n, ice_coefficients(s, v, ICE_NORMAL, spot, own), spot->theta, factor, a);
    if (!gradient || !ice_wall_normal(v, gradient, normal)) {
        if (s->pairs->unlike)
            exchange_relax_parts(n, mass, spot->theta, a, v->dim, u);
        else
            exchange_relax(n, mass, a, v->dim, u);
        return;
    }
    exchange_couple(n, ice_coefficients(s, v, ICE_TANGENTIAL, spot, own), spot->theta, factor, across);
    drag_in_solids(v, mass, spot, normal, a, across);
    exchange_relax_frame(n, mass, spot->theta, s->pairs->unlike, a, across, v->dim, normal, u);
}
