/* Membranes (York 1997, chapter 5): one layer of points. The total strain is kept in the local frame and grows with the
 * stretch of the tangent (section 5.4.2, in the rate form t.L.t, whose integral is the logarithm of the stretch); the
 * stress is turned back to the axes of the scene, so that forces need no kernel of their own. */
#include "mpm/membrane/membrane_points.h"

#include "mpm/membrane/enclosed_gas.h"
#include "mpm/membrane/membrane_curve.h"
#include "mpm/membrane/membrane_normal.h"
#include "mpm/membrane/membrane_sheet.h"
#include "mpm/state/stress.h"
#include "mpm/surface/membrane_boundary.h"

#include <math.h>
#include <string.h>

/* Points from `start` on, at most SOLID_CHUNK, with their local frame. */
typedef struct membrane_batch {
    size_t n;
    double t[3][SOLID_CHUNK];                       /* unit tangent; zero: the point has none */
    double along[SOLID_CHUNK], across[SOLID_CHUNK]; /* logarithmic strains */
} membrane_batch;

typedef double *field_getter(const fields *f, field_id id, int instance, int comp);

static void load_strain(const mpm *s, const fields *f, int body, size_t start, size_t n, bool next, membrane_batch *b)
{
    field_getter *get = next ? field_next : field_get;
    b->n = n;
    memcpy(b->along, get(f, P_STRAIN, body, 0) + start, n * sizeof(double));
    if (s->carries[P_STRAIN_HOOP])
        memcpy(b->across, get(f, P_STRAIN_HOOP, body, 0) + start, n * sizeof(double));
    else
        memset(b->across, 0, n * sizeof(double));
}

static void load_tangent(const mpm *s, const fields *f, int body, size_t start, bool next, membrane_batch *b)
{
    field_getter *get = next ? field_next : field_get;
    memset(b->t, 0, sizeof b->t);
    for (int a = 0; a < s->mesh->dim; ++a) memcpy(b->t[a], get(f, P_TANGENT, body, a) + start, b->n * sizeof(double));
}

/* Stress s1 t(x)t and, out of the plane or around the axis, s2. */
static void put_stress(const mpm *s, const fields *f, int body, size_t start, bool next, const membrane_batch *b)
{
    static const int row[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    field_getter *get = next ? field_next : field_get;
    const membrane_response *r = &s->body[body].membrane;
    double s1[SOLID_CHUNK], s2[SOLID_CHUNK];
    membrane_stress(r, b->n, b->along, b->across, s1, s2);
    const int components = field_component_count(FIELD_STRESS, s->mesh->dim);
    for (int c = 0; c < components; ++c) {
        double *to = get(f, P_STRESS, body, c) + start;
        for (size_t k = 0; k < b->n; ++k) {
            const bool directed = b->t[0][k] != 0.0 || b->t[1][k] != 0.0 || b->t[2][k] != 0.0;
            to[k] = s1[k] * b->t[row[c][0]][k] * b->t[row[c][1]][k];
            if (c == 2 && s->mesh->dim < 3) to[k] = directed ? s2[k] : 0.0;
        }
    }
    double *J = get(f, P_J, body, 0) + start;
    for (size_t k = 0; k < b->n; ++k) J[k] = membrane_volume_ratio(r->section, b->along[k], b->across[k]);
}

/* ln |(I + dt L) t|: by how much a step stretches the tangent. To first order dt t.L.t; the rest keeps the strain of a
 * membrane that turns what the positions of its points make it. */
static double stretch_of(const solid_batch *rate, const membrane_batch *b, size_t k, double dt)
{
    double square = 0.0;
    for (int i = 0; i < 3; ++i) {
        double to = b->t[i][k];
        for (int j = 0; j < 3; ++j) to += dt * rate->L[3 * i + j][k] * b->t[j][k];
        square += to * to;
    }
    return 0.5 * log(square);
}

/* t.L.t */
static double rate_along(const solid_batch *rate, const membrane_batch *b, size_t k)
{
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum += b->t[i][k] * rate->L[3 * i + j][k] * b->t[j][k];
    return sum;
}

floe_status membrane_torn(const mpm *s, int blk, int body, size_t k)
{
    return fail(s->ctx, FLOE_RETRY, "at t = %.6g s point %zu of membrane '%s' would be crushed to nothing", s->time,
                point_number(s, blk, body, k) + 1, s->scene->body[s->body[body].scene_body].name);
}

floe_status strain_membrane(mpm *s, int blk, int body, size_t start, size_t end, const solid_batch *rate)
{
    if (is_sheet(s, body)) return strain_sheet(s, blk, body, start, end, rate);
    const fields *f = s->domain->fields[blk];
    membrane_batch b;
    load_strain(s, f, body, start, end - start, false, &b);
    load_tangent(s, f, body, start, false, &b);
    const bool places = s->curve[body].rest != NULL;
    /* USF's tangents stand at the end of the time over which it strains. */
    const double dt = strain_step(s),
                 sign = s->scene->method.stress == STRESS_USF && s->cells != CELLS_SMEARED ? -1.0 : 1.0;
    for (size_t k = 0; k < b.n; ++k) {
        if (b.t[0][k] == 0.0 && b.t[1][k] == 0.0 && b.t[2][k] == 0.0) continue;
        if (places)
            s->curve[body].pace[point_number(s, blk, body, start + k)] = dt * rate_along(rate, &b, k);
        else
            b.along[k] += sign * stretch_of(rate, &b, k, sign * dt);
        if (s->carries[P_STRAIN_HOOP]) b.across[k] += sign * log1p(sign * dt * rate->L[8][k]);
        if (!isfinite(b.along[k] + b.across[k])) return membrane_torn(s, blk, body, start + k);
    }
    memcpy(field_next(f, P_STRAIN, body, 0) + start, b.along, b.n * sizeof(double));
    if (s->carries[P_STRAIN_HOOP])
        memcpy(field_next(f, P_STRAIN_HOOP, body, 0) + start, b.across, b.n * sizeof(double));
    put_stress(s, f, body, start, true, &b);
    return FLOE_OK;
}

/* A quarter of a turn from the normals, in a plane. */
static void turn_normals(const mpm *s, int blk, int body, size_t start, bool next, membrane_batch *b)
{
    field_getter *get = next ? field_next : field_get;
    const double *x = get(s->domain->fields[blk], P_NORMAL, body, 0) + start;
    const double *y = get(s->domain->fields[blk], P_NORMAL, body, 1) + start;
    for (size_t k = 0; k < b->n; ++k) {
        b->t[0][k] = -y[k];
        b->t[1][k] = x[k];
    }
}

static void follow_line(const mpm *s, int blk, int body, size_t start, membrane_batch *b)
{
    for (size_t k = 0; k < b->n; ++k) {
        double t[3];
        if (!membrane_curve_tangent(s, body, point_number(s, blk, body, start + k), t)) continue;
        for (int a = 0; a < 3; ++a) b->t[a][k] = t[a];
    }
}

/* Tangents of a chunk, normal to its normals or along its curve; a point without one keeps its former tangent. A
 * surface in space has no single tangent, and no stress along one. */
static void find_tangents(const mpm *s, int blk, int body, size_t start, bool next, membrane_batch *b)
{
    const fields *f = s->domain->fields[blk];
    load_tangent(s, f, body, start, false, b);
    const bool free_normals = normals_are_free(s, body);
    if (!free_normals) follow_line(s, blk, body, start, b);
    if (free_normals && s->mesh->dim == 2) turn_normals(s, blk, body, start, next, b);
    for (int a = 0; a < s->mesh->dim; ++a)
        memcpy((next ? field_next : field_get)(f, P_TANGENT, body, a) + start, b->t[a], b->n * sizeof(double));
}

/* Tangents of a body; with `stress` also the stress along them. */
static void turn_body(mpm *s, int body, bool next, bool stress)
{
    const bool places = s->curve[body].rest != NULL;
    if (places || !normals_are_free(s, body)) membrane_curve_update(s, body, next);
    if (places && next && !mpm_is_solved(s)) membrane_curve_settle(s, body);
    if (places) membrane_curve_strain(s, body, next);
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) {
        const size_t n = s->points[blk][body].n, chunks = (n + SOLID_CHUNK - 1) / SOLID_CHUNK;
#pragma omp parallel for schedule(static)
        for (size_t c = 0; c < chunks; ++c) {
            const size_t start = c * SOLID_CHUNK, end = start + SOLID_CHUNK < n ? start + SOLID_CHUNK : n;
            membrane_batch b;
            load_strain(s, s->domain->fields[blk], body, start, end - start, next, &b);
            find_tangents(s, blk, body, start, next, &b);
            if (stress || places) put_stress(s, s->domain->fields[blk], body, start, next, &b);
        }
    }
}

floe_status mpm_turn_membranes(mpm *s)
{
    const bool stress = s->scene->method.stress != STRESS_USF || s->cells == CELLS_SMEARED;
    for (int body = 0; body < s->n_bodies; ++body) {
        if (!s->body[body].membrane.model) continue;
        if (is_sheet(s, body))
            turn_sheet(s, body);
        else
            turn_body(s, body, true, stress);
    }
    return FLOE_OK;
}

floe_status start_membranes(mpm *s)
{
    for (int body = 0; body < s->n_bodies; ++body) {
        if (!s->body[body].membrane.model) continue;
        TRY(membrane_curve_make(s, body));
        if (normals_are_free(s, body)) TRY(normals_start(s, body));
        if (is_sheet(s, body))
            TRY(start_sheet(s, body));
        else
            turn_body(s, body, false, true);
    }
    if (s->enclosure) TRY(start_enclosure(s));
    return s->cells == CELLS_CUT && scene_enclosing_body(s->scene) >= 0 ? start_membrane_force(s) : FLOE_OK;
}

void membrane_energies(const mpm *s, int blk, int body, size_t start, size_t end, double *psi)
{
    membrane_batch b;
    if (is_sheet(s, body)) {
        sheet_energies(s, blk, body, start, end, psi);
        return;
    }
    load_strain(s, s->domain->fields[blk], body, start, end - start, false, &b);
    for (size_t k = 0; k < b.n; ++k) psi[k] = membrane_energy(&s->body[body].membrane, b.along[k], b.across[k]);
}

static void membrane_wave_speed(const void *par, double p_ref, const solid_batch *b, double *c)
{
    const membrane_response *r = par;
    const double modulus = r->model->modulus(r->par, r->biaxial);
    (void)p_ref;
    for (size_t k = 0; k < b->n; ++k) c[k] = sqrt(modulus * b->J[k] / b->rho0[k]);
}

const solid_model point_membrane = {.name = "membrane", .wave_speed = membrane_wave_speed};

/* A direction across exists where the scene goes on out of its plane, or around its axis, and in a surface. */
membrane_response response_of(const mpm *s, const scene_body *b)
{
    const scene_material *m = &s->scene->material[b->material];
    const bool surface = b->membrane.surface.kind != SHEET_NONE;
    const bool sheet = surface || (s->mesh->dim == 2 && s->scene->stress_state == STRESS_FULL);
    return (membrane_response){.model = m->membrane,
                               .par = m->membrane_par,
                               .one_way = m->one_way,
                               .free_across = m->membrane && !sheet,
                               .biaxial = surface || s->mesh->geometry == MESH_AXISYMMETRIC,
                               .section = b->membrane.section};
}
