/* Equilibrium of a membrane around gas, solved for the positions of its points. No mesh lies between, so that an
 * increment may have any displacement.
 *
 *     p grad V(x) = grad U(x),     M e = E - U(x) - p_ref (V - V1),     p = p(M/V, e),
 *
 * x the positions of the points, U the strain energy of the segments between them, V the enclosed volume, E the energy
 * of gas and membrane at the start, kinetic energy included: energy dissipated on the way to equilibrium becomes heat
 * of the gas. Newton's method with viscous damping lambda m dx/dt, which vanishes at rest, added to the matrix (m the
 * points' masses): slack segments have no stiffness, and lambda is such that no segment rotates by more than
 * `most_turn` in one iteration. The matrix has the stiffness of tension alone; that of the pressure is left out, so
 * that it stays positive definite. */
#include "base/memory.h"
#include "mpm/implicit/implicit.h"
#include "mpm/implicit/implicit_constants.h"
#include "mpm/membrane/membrane_curve.h"
#include "mpm/membrane/membrane_normal.h"
#include "solve/chain.h"

#include <math.h>
#include <string.h>

static const int fits = 3; /* passes that fit segments to points; the second changes almost nothing */
enum { MOST_ITERATIONS = 5000, MOST_ENERGIES = 60 };
static const double most_turn = 0.05;
static const double least_share =
    1e-10; /* lambda over the largest stiffness: it keeps the matrix of an unconstrained ring regular */
static const double energy_close = 1e-13; /* of the gas */
static const double still =
    1e-12; /* rotation (rad) of a step by round-off alone: the residual is as small as it gets */

struct curve_rest {
    int body;
    size_t n;             /* points */
    chain_matrix *matrix; /* owned */
    /* One number a point, two for forces and positions; one allocation that `length` owns. Segments at rest: from a
     * point to the next, or from an end to the mirror. */
    double *length, *volume, *radius, *share;  /* m, m3, m; share of the mean volume of a point */
    double end_length[2], end_volume[2];       /* half a segment between an end and its image; 0: none */
    double *volume_gradient, *residual, *step; /* gradient of the enclosed volume (m); residual (N); step (m) */
    double energy;                             /* J: of them all */
};

const char *curve_rest_obstacle(const mpm *s)
{
    int membranes = 0, gas = -1;
    for (int b = 0; b < s->n_bodies; ++b) {
        const mpm_body *body = &s->body[b];
        const scene_body *given = &s->scene->body[body->scene_body];
        if (body->fluid) {
            if (gas >= 0 && gas != body->scene_material) return "gases of several kinds inside a membrane mix";
            gas = body->scene_material;
            continue;
        }
        if (!body->membrane.model || s->carries[P_SURFACE_1] || s->mesh->dim != 2 || normals_are_free(s, b) ||
            given->membrane.strain != STRAIN_BY_POSITIONS)
            return "of membranes it takes connected lines with `strain: positions` in two dimensions, and no other "
                   "solid";
        membranes++;
    }
    if (membranes != 1 || (gas < 0 && s->cells != CELLS_CUT)) return "of membranes it takes one, around gas";
    if (s->scene->n_loads > 0 || s->scene->n_supports > 0) return "membranes with loads or supports are stepped";
    return NULL;
}

floe_status curve_rest_create(mpm *s)
{
    TRY(memory_new(s->ctx, &s->implicit->curve, 1, sizeof *s->implicit->curve));
    for (int b = 0; b < s->n_bodies; ++b)
        if (!s->body[b].fluid) s->implicit->curve->body = b;
    return FLOE_OK;
}

void curve_rest_destroy(mpm *s)
{
    struct curve_rest *r = s->implicit->curve;
    if (!r) return;
    chain_destroy(&r->matrix);
    memory_free(s->ctx, &r->length);
    memory_free(s->ctx, &s->implicit->curve);
}

static membrane_curve *line_of(const mpm *s)
{
    return &s->curve[s->implicit->curve->body];
}

static bool is_radial(const mpm *s)
{
    return s->mesh->geometry == MESH_AXISYMMETRIC;
}

static floe_status reserve_curve(mpm *s)
{
    struct curve_rest *r = s->implicit->curve;
    const membrane_curve *line = line_of(s);
    if (!mpm_membrane_encloses(s, r->body) || line->n < 3)
        return fail_key(s->ctx, KEY("time", "solver"),
                        "static: membrane '%s' is neither closed nor ends on mirrors, and encloses nothing; use "
                        "dynamic",
                        s->scene->body[s->body[r->body].scene_body].name);
    if (r->matrix) return FLOE_OK;
    r->n = line->n;
    TRY(chain_create(&r->matrix, s->ctx, r->n, line->closed));
    TRY(memory_new(s->ctx, &r->length, 10 * r->n, sizeof *r->length));
    r->volume = r->length + r->n;
    r->radius = r->volume + r->n;
    r->share = r->radius + r->n;
    r->volume_gradient = r->share + r->n;
    r->residual = r->volume_gradient + 2 * r->n;
    r->step = r->residual + 2 * r->n;
    return FLOE_OK;
}

/* The next point of a piece; none after the last of an open line. */
static bool piece_of(const mpm *s, size_t k, size_t *to)
{
    const membrane_curve *line = line_of(s);
    *to = (k + 1) % line->n;
    return line->closed || k + 1 < line->n;
}

/* What the pieces are at rest; about an axis also the radius at which their strain across is nothing. */
static void measure_pieces(mpm *s)
{
    struct curve_rest *r = s->implicit->curve;
    const membrane_curve *line = line_of(s);
    double sum = 0.0;
    for (size_t k = 0; k < r->n; ++k) sum += line->volume[k];
    for (size_t k = 0; k < r->n; ++k) {
        size_t to;
        r->share[k] = line->volume[k] * (double)r->n / sum;
        if (!piece_of(s, k, &to)) continue;
        r->length[k] = 0.5 * (line->rest[k] + line->rest[to]);
        r->volume[k] = 0.5 * (line->volume[k] / line->rest[k] + line->volume[to] / line->rest[to]) * r->length[k];
        r->radius[k] = 0.5 * (line->x[3 * k] + line->x[3 * to]) * exp(-0.5 * (line->across[k] + line->across[to]));
    }
    for (int e = 0; e < 2 && !line->closed; ++e) {
        const size_t at = e ? r->n - 1 : 0;
        r->end_length[e] = line->end[e].of_itself ? 0.5 * line->rest[at] : 0.0;
        r->end_volume[e] = line->end[e].of_itself ? 0.5 * line->volume[at] : 0.0;
    }
}

/* Work (J) per strain along and across of a piece, and by how much each grows with its own strain. */
typedef struct piece_work {
    double work[2], slope[2], energy;
} piece_work;

static void work_at(const mpm *s, double volume, const double strain[2], double work[2])
{
    const membrane_response *m = &s->body[s->implicit->curve->body].membrane;
    membrane_stress(m, 1, &strain[0], &strain[1], &work[0], &work[1]);
    for (int a = 0; a < 2; ++a) work[a] *= volume * membrane_volume_ratio(m->section, strain[0], strain[1]);
    if (!is_radial(s)) work[1] = 0.0;
}

static piece_work work_of(const mpm *s, double volume, double along, double across)
{
    piece_work w;
    const double strain[2] = {along, across};
    work_at(s, volume, strain, w.work);
    for (int a = 0; a < 2; ++a) {
        double more[2] = {along, across}, next[2];
        more[a] += MPM_TANGENT_DIFFERENCE;
        work_at(s, volume, more, next);
        w.slope[a] = fmax(0.0, (next[a] - w.work[a]) / MPM_TANGENT_DIFFERENCE);
    }
    w.energy = volume * membrane_energy(&s->body[s->implicit->curve->body].membrane, along, across);
    return w;
}

static void add_piece(mpm *s, size_t a, size_t b)
{
    struct curve_rest *r = s->implicit->curve;
    const double *x = line_of(s)->x;
    const double chord[2] = {x[3 * b] - x[3 * a], x[3 * b + 1] - x[3 * a + 1]}, length = hypot(chord[0], chord[1]);
    const double radius = is_radial(s) ? 0.5 * (x[3 * a] + x[3 * b]) : 1.0;
    const piece_work w =
        work_of(s, r->volume[a], log(length / r->length[a]), is_radial(s) ? log(radius / r->radius[a]) : 0.0);
    const double tension = w.work[0] / length, hoop = w.work[1] / radius;
    r->energy += w.energy;
    for (int i = 0; i < 2; ++i) {
        const double force = tension * chord[i] / length, around = i == 0 ? 0.5 * hoop : 0.0;
        r->residual[2 * a + (size_t)i] += force - around;
        r->residual[2 * b + (size_t)i] -= force + around;
        for (int j = 0; j < 2; ++j) {
            const double tt = chord[i] * chord[j] / (length * length), across = (i == j ? 1.0 : 0.0) - tt;
            const double k = w.slope[0] / (length * length) * tt + tension / length * across;
            const double round = i == 0 && j == 0 ? 0.25 * w.slope[1] / (radius * radius) : 0.0;
            r->matrix->own[a][2 * i + j] += k + round;
            r->matrix->own[b][2 * i + j] += k + round;
            r->matrix->next[a][2 * i + j] += round - k;
        }
    }
}

/* Between an end and the mirror. */
static void add_end(mpm *s, int e)
{
    struct curve_rest *r = s->implicit->curve;
    const membrane_curve *line = line_of(s);
    const size_t at = e ? r->n - 1 : 0;
    const int axis = line->end[e].axis;
    const double off = line->x[3 * at + (size_t)axis] - line->end[e].plane, length = fabs(off);
    if (r->end_length[e] == 0.0) return;
    const double stretch = log(length / r->end_length[e]);
    const double across = !is_radial(s) ? 0.0
                          : axis == 0   ? stretch + line->across[at] /* the radius is the length */
                                        : log(line->x[3 * at] / r->radius[e ? r->n - 2 : 0]);
    const piece_work w = work_of(s, r->end_volume[e], stretch, across);
    r->energy += w.energy;
    r->residual[2 * at + (size_t)axis] -= w.work[0] / off;
    r->matrix->own[at][3 * axis] += w.slope[0] / (length * length);
    if (!is_radial(s)) return;
    r->residual[2 * at] -= w.work[1] / line->x[3 * at];
    r->matrix->own[at][0] += w.slope[1] / (line->x[3 * at] * line->x[3 * at]);
}

/* An end on its mirror stays there. */
static void pin_ends(mpm *s)
{
    struct curve_rest *r = s->implicit->curve;
    const membrane_curve *line = line_of(s);
    for (int e = 0; e < 2 && !line->closed; ++e) {
        const size_t at = e ? r->n - 1 : 0, k = 2 * at + (size_t)line->end[e].axis;
        const int i = line->end[e].axis;
        if (line->end[e].of_itself) continue;
        r->residual[k] = r->volume_gradient[k] = 0.0;
        r->matrix->own[at][0] = i == 0 ? 1.0 : r->matrix->own[at][0];
        r->matrix->own[at][3] = i == 1 ? 1.0 : r->matrix->own[at][3];
        r->matrix->own[at][1] = r->matrix->own[at][2] = 0.0;
        double *beside = r->matrix->next[e ? at - 1 : at];
        for (int j = 0; j < 2; ++j) beside[e ? 2 * j + i : 2 * i + j] = 0.0;
    }
}

static double vector_norm(size_t n, const double *x)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k) sum += x[k] * x[k];
    return sqrt(sum);
}

/* Residual and matrix at the positions of the points; pressure and stiffness of the gas. Returns the share of the
 * forces that is left. */
static floe_status curve_residual(mpm *s, enclosed_gas *gas, double *share)
{
    struct curve_rest *r = s->implicit->curve;
    const membrane_curve *line = line_of(s);
    const double enclosed = membrane_measure(s, r->body, r->volume_gradient);
    TRY(enclosed_gas_set(s, gas, enclosed - gas->volume_first));
    chain_clear(r->matrix);
    memset(r->residual, 0, 2 * r->n * sizeof *r->residual);
    r->energy = 0.0;
    for (size_t k = 0, to; k < r->n; ++k)
        if (piece_of(s, k, &to)) add_piece(s, k, to);
    for (int e = 0; e < 2 && !line->closed; ++e) add_end(s, e);
    const double pressure = gas->pressure - s->scene->reference_pressure, pulled = vector_norm(2 * r->n, r->residual);
    const double gas_force = fabs(pressure) * vector_norm(2 * r->n, r->volume_gradient);
    for (size_t k = 0; k < 2 * r->n; ++k) r->residual[k] += pressure * r->volume_gradient[k];
    pin_ends(s);
    *share = vector_norm(2 * r->n, r->residual) / fmax(gas_force, pulled);
    return FLOE_OK;
}

static double largest_stiffness(const struct curve_rest *r)
{
    double most = 0.0;
    for (size_t k = 0; k < r->n; ++k) most = fmax(most, fmax(r->matrix->own[k][0], r->matrix->own[k][3]));
    return most;
}

/* By how much a step turns or stretches a piece. */
static double turn_of(const mpm *s)
{
    const struct curve_rest *r = s->implicit->curve;
    const double *x = line_of(s)->x;
    double most = 0.0;
    for (size_t k = 0, to; k < r->n; ++k) {
        if (!piece_of(s, k, &to)) continue;
        const double length = hypot(x[3 * to] - x[3 * k], x[3 * to + 1] - x[3 * k + 1]);
        most = fmax(most, hypot(r->step[2 * to] - r->step[2 * k], r->step[2 * to + 1] - r->step[2 * k + 1]) / length);
    }
    return most;
}

/* A step in which no segment rotates too far; the lambda that it needs is where the next begins. */
static floe_status take_step(mpm *s, double stiffness, double *lambda)
{
    struct curve_rest *r = s->implicit->curve;
    double had = 0.0;
    for (int tries = 0; tries < 200; ++tries) {
        for (size_t k = 0; k < r->n; ++k) {
            r->matrix->own[k][0] += (*lambda - had) * r->share[k];
            r->matrix->own[k][3] += (*lambda - had) * r->share[k];
        }
        had = *lambda;
        TRY(chain_solve(r->matrix, stiffness, r->volume_gradient, r->residual, r->step));
        if (turn_of(s) <= most_turn) break;
        *lambda *= 2.0;
    }
    double *x = line_of(s)->x;
    for (size_t k = 0; k < r->n; ++k)
        for (size_t a = 0; a < 2; ++a) x[3 * k + a] += r->step[2 * k + a];
    if (turn_of(s) <= 0.5 * most_turn) *lambda *= 0.5;
    return FLOE_OK;
}

/* Balance along the gas's isentrope. */
static floe_status find_equilibrium(mpm *s, enclosed_gas *gas)
{
    struct mpm_implicit *w = s->implicit;
    double lambda = 0.0, share;
    for (int k = 0; k < MOST_ITERATIONS; ++k, ++w->newton) {
        TRY(curve_residual(s, gas, &share));
        if (share <= s->scene->time.tolerance) return FLOE_OK;
        const double least = least_share * largest_stiffness(w->curve);
        if (lambda == 0.0) lambda = vector_norm(2 * w->curve->n, w->curve->residual) / sqrt(gas->volume);
        if (lambda < least) lambda = least;
        TRY(take_step(s, gas->stiffness, &lambda));
        if (turn_of(s) <= still) return FLOE_OK;
    }
    return fail(s->ctx, FLOE_DIVERGED,
                "the membrane finds no rest: after %d iterations %.3g of the forces is left; use time.solver: dynamic",
                MOST_ITERATIONS, share);
}

/* A point's strain is that of the chord between its neighbours (membrane_strain.c), which on a curve is shorter than
 * the segments. Lengths of the segments at rest are such that their strain is that of their points. */
static void fit_pieces(mpm *s)
{
    struct curve_rest *r = s->implicit->curve;
    const membrane_curve *line = line_of(s);
    membrane_curve_strains_at(s, r->body);
    for (size_t k = 0, to; k < r->n; ++k) {
        if (!piece_of(s, k, &to)) continue;
        const double *a = line->x + 3 * k, *b = line->x + 3 * to;
        r->length[k] = hypot(b[0] - a[0], b[1] - a[1]) * exp(-0.5 * (line->along[k] + line->along[to]));
    }
    for (int e = 0; e < 2 && !line->closed; ++e) {
        const size_t at = e ? r->n - 1 : 0;
        const double off = line->x[3 * at + (size_t)line->end[e].axis] - line->end[e].plane;
        if (r->end_length[e] > 0.0) r->end_length[e] = fabs(off) * exp(-line->along[at]);
    }
}

/* Iterates on the entropy of the gas until its energy at equilibrium balances that of the start. */
static floe_status find_rest(mpm *s, enclosed_gas *gas, double energy, double volume_first)
{
    for (int k = 0; k < MOST_ENERGIES; ++k) {
        TRY(find_equilibrium(s, gas));
        const double external = s->scene->reference_pressure * (gas->volume - volume_first);
        const double wanted = (energy - s->implicit->curve->energy - external) / gas->mass, off = wanted - gas->energy;
        gas->volume_first = gas->volume0 = gas->volume;
        gas->energy_first = gas->energy = wanted;
        if (fabs(off) <= energy_close * fabs(wanted)) return enclosed_gas_set(s, gas, 0.0);
        if (k < fits) fit_pieces(s);
    }
    return fail(s->ctx, FLOE_DIVERGED,
                "gas and membrane find no rest of the energy that they have; use time.solver: dynamic");
}

/* What of the gas is on points. */
static void add_gas_of_points(const mpm *s, const mpm_totals *t, enclosed_gas *gas)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        if (!s->body[b].fluid) continue;
        gas->par = (solid_fluid_par){.eos = s->body[b].fluid_par.eos};
        gas->mass += t->mass[b];
        gas->volume0 += t->volume[b];
        gas->energy += t->internal[b];
    }
}

/* All gas as one enclosed gas, and the total energy. */
static floe_status gather_gas(mpm *s, enclosed_gas *gas, double *energy)
{
    mpm_totals t;
    TRY(mpm_sum(s, &t));
    *gas = (enclosed_gas){.body = -1, .scheduled = NAN};
    *energy = 0.0;
    for (int b = 0; b < s->n_bodies; ++b) *energy += t.kinetic[b] + t.strain[b] + t.internal[b];
    add_gas_of_points(s, &t, gas);
    if (s->gas) {
        if (s->n_gases != 1)
            return fail_key(s->ctx, KEY("time", "solver"),
                            "static: the gas inside the membrane is in %d parts; use dynamic", s->n_gases);
        gas->par = (solid_fluid_par){.eos = *s->gas->law};
        gas->mass = s->gas->mass;
        gas->volume0 = s->gas->volume;
        gas->energy = s->gas->mass * s->gas->energy;
        *energy += gas->energy;
    }
    gas->mass_first = gas->mass;
    gas->volume = gas->volume_first = gas->volume0;
    gas->energy = gas->energy_first = gas->energy / gas->mass;
    return FLOE_OK;
}

static void rest_points(mpm *s, int blk, int body)
{
    const fields *f = s->domain->fields[blk];
    const size_t n = s->points[blk][body].n;
    for (int a = 0; a < s->mesh->dim; ++a) {
        memset(field_next(f, P_VEL, body, a), 0, n * sizeof(double));
        memcpy(field_next(f, P_POS, body, a), field_get(f, P_POS, body, a), n * sizeof(double));
    }
    for (int c = 0; fields_has(f, P_AFFINE, body) && c < s->mesh->dim * s->mesh->dim; ++c)
        memset(field_next(f, P_AFFINE, body, c), 0, n * sizeof(double));
}

static void store_line(mpm *s, int blk)
{
    const int body = s->implicit->curve->body;
    const fields *f = s->domain->fields[blk];
    const double *x = line_of(s)->x;
    for (size_t k = 0; k < s->points[blk][body].n; ++k) {
        const size_t q = point_number(s, blk, body, k);
        for (int a = 0; a < 2; ++a) field_next(f, P_POS, body, a)[k] = x[3 * q + (size_t)a];
        if (s->carries[P_STRAIN_HOOP])
            field_next(f, P_STRAIN_HOOP, body, 0)[k] =
                field_get(f, P_STRAIN_HOOP, body, 0)[k] + log(x[3 * q] / field_get(f, P_POS, body, 0)[k]);
    }
}

static void store_rest(mpm *s, enclosed_gas *gas, double points_volume)
{
    if (s->gas) enclosed_gas_to_cells(gas, s->gas);
    gas->volume_first = points_volume;
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk)
        for (int b = 0; b < s->n_bodies; ++b) {
            rest_points(s, blk, b);
            gas->body = b;
            if (s->body[b].fluid) enclosed_gas_store(s, gas, blk);
            if (b == s->implicit->curve->body) store_line(s, blk);
        }
    for (size_t t = 0; t < mesh_tiles(s->mesh); ++t) s->moved[t] = UINT32_MAX; /* the order is made anew */
}

floe_status mpm_membrane_equilibrium(mpm *s)
{
    struct mpm_implicit *w = s->implicit;
    enclosed_gas gas;
    double energy;
    membrane_curve_update(s, w->curve->body, false);
    TRY(reserve_curve(s));
    if (s->carries[P_STRAIN_HOOP]) membrane_curve_hoop_strains(s, w->curve->body);
    measure_pieces(s);
    TRY(gather_gas(s, &gas, &energy));
    const double volume = gas.volume, enclosed = membrane_measure(s, w->curve->body, w->curve->volume_gradient);
    w->newton = 0;
    TRY(find_rest(s, &gas, energy, enclosed));
    store_rest(s, &gas, volume);
    ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, -s->scene->reference_pressure * (gas.volume - enclosed));
    ledger_tally(s->ledger, COUNT_BALANCE_ITERATIONS, w->newton);
    return FLOE_OK;
}
