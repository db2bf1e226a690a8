/* Viscosity and heat conduction of the fluids (theory 2.6; the face terms: ice_stress.h), second order in time by the
 * midpoint:
 *
 *   rates       F = div tau, H = power into the cell less F.u, from the state at t^n. Half of their effect goes into the face
 *               velocities (dt F / 2 rho) and the advanced pressure (dt/2 of what H does to p), which are values at half the step
 *   sources     u and T at half the step, u + (u^L - u)/2 + dt/2 (F/rho - u.grad u) and T of the density and energy that are so
 *               advanced, give the stresses and heat fluxes of the whole step. What stresses work less what they give in kinetic
 *               energy is heat: total energy closes, and what crosses the sides goes into the ledger
 *
 * At shocks (s = 1), and temperatures of cells with several materials, stay at t^n: first order there. */
#include "ice/source/ice_lagrangian.h"
#include "ice/source/ice_stress.h"

#include "base/threads.h"
#include "ice/sides/ice_sides.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_state.h"
#include "ice/state/ice_tiles.h"
#include "scene/state.h"

#include <math.h>

bool ice_conducts(const ice *s)
{
    for (int r = 0; r < s->n_materials; ++r)
        if (s->material[r].conductivity > 0.0) return true;
    return false;
}

/* Whether forces that change with place act on fluids: those of an exact solution, and body forces. */
static bool has_force_field(const ice *s)
{
    return s->scene->driving || scene_has_field_on(s->scene, -1);
}

bool ice_has_diffusion(const ice *s)
{
    return ice_is_viscous(s) || ice_conducts(s) || has_force_field(s);
}

bool ice_diffuses(const ice *s)
{
    return !s->cut && ice_has_diffusion(s);
}

/* Whether viscosity, conduction, or forces that change with place act on a material of the cells. */
static bool material_diffuses(const ice *s, const ice_material *m)
{
    return !m->points &&
           (m->shear_viscosity > 0.0 || m->bulk_viscosity > 0.0 || m->conductivity > 0.0 || has_force_field(s));
}

/* ---- kernels ---- */

static diffusing diffusing_of(const ice_view *v, int r, const double *const u[3], const double *T)
{
    const ice_material *m = &v->material[r];
    diffusing d = {.T = T ? T : u[0],
                   .theta = v->multi ? v->m[r].theta : NULL,
                   .mu = m->shear_viscosity,
                   .dilatation = m->bulk_viscosity - 2.0 / 3.0 * m->shear_viscosity,
                   .k = m->conductivity,
                   .radius = v->radial ? v->radius0 : NULL};
    for (int a = 0; a < v->dim; ++a) {
        d.u[a] = u[a];
        d.stride[a] = v->b->stride[a];
        d.inv_h[a] = v->inv_h[a];
    }
    return d;
}

/* F and H of a row. */
FLOE_ALWAYS_INLINE void rate_row(const diffusing *d, const ice_view *v, int r, ptrdiff_t base, const int dim,
                                 const bool radial)
{
    const ice_fluid *m = &v->m[r];
    double *restrict H = m->heat, *restrict F[3] = {m->diff[0], m->diff[1], m->diff[2]};
#pragma omp simd
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = base + i;
        const cell_diffusion c = diffusion_into(d, v, at, i, dim, radial);
        double work = 0.0;
        for (int a = 0; a < dim; ++a) {
            F[a][at] = c.force[a];
            work += c.force[a] * m->u[a][at];
        }
        H[at] = c.power - work;
    }
}

/* The whole step's force and power onto the Lagrangian values of a row. */
FLOE_ALWAYS_INLINE void apply_row(const diffusing *d, const ice_view *v, int r, ptrdiff_t base, const int dim,
                                  const bool radial)
{
    const ice_fluid *m = &v->m[r];
#pragma omp simd
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = base + i;
        const cell_diffusion c = diffusion_into(d, v, at, i, dim, radial);
        take_diffusion(m, at, m->rho[at] > 0.0 ? v->dt / m->rho[at] : 0.0, dim, &c);
    }
}

typedef void diffusion_row(const diffusing *d, const ice_view *v, int r, ptrdiff_t base);

#define INSTANCE(name, label, dim, radial)                                                   \
    static void name##_##label(const diffusing *d, const ice_view *v, int r, ptrdiff_t base) \
    {                                                                                        \
        name##_row(d, v, r, base, dim, radial);                                              \
    }
#define INSTANCES(name)             \
    INSTANCE(name, 1, 1, false)     \
    INSTANCE(name, 2, 2, false)     \
    INSTANCE(name, radial, 2, true) \
    INSTANCE(name, 3, 3, false)     \
    static diffusion_row *const name##_rows[4] = {name##_1, name##_2, name##_3, name##_radial};
INSTANCES(rate)
INSTANCES(apply)

static void each_row(const ice_view *v, int r, const diffusing *d, diffusion_row *const rows[4])
{
    diffusion_row *kernel = rows[d->radius ? 3 : v->dim - 1];
    const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) kernel(d, v, r, ice_row_start(v->b, q, row));
}

/* ---- rates at the start of the step ---- */

/* Temperatures of the owned cells: with several materials those of the equilibrium. */
static void set_temperatures(const ice *s, const ice_view *v, int r)
{
    (void)s;
    const ice_fluid *m = &v->m[r];
    const eos *law = &v->material[r].eos;
    const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t from = ice_row_start(v->b, q, row), n = v->b->n[0];
        for (ptrdiff_t at = from; at < from + n && v->multi; ++at) m->diffT[at] = m->T[at];
        if (!v->multi) law->model->temperature(law->par, (size_t)n, m->rho + from, m->e + from, m->diffT + from);
    }
}

/* r: of the region. */
static void each_block(const ice *s, const ice_region *g, int r, void (*visit)(const ice *, const ice_view *, int))
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) visit(s, &v, r);
}

/* Adds a body force in a cell, at its centre, by the share of the cell that lies in its region. */
static void add_field(const ice *s, const scene_load *load, const int cell[MESH_MAX_DIM], const double x[3], double t,
                      double force[3])
{
    double vector[3];
    load_vector(s->scene, load, x, t, vector);
    const double share = load->region.model ? ice_region_share(s->mesh, &load->region, cell) : 1.0;
    for (int a = 0; a < s->mesh->dim; ++a) force[a] += share * vector[a];
}

/* Force per mass of body forces and of the scene's exact solution, and the heat per volume that this needs, in a cell, at its centre. */
static double source_at(const ice *s, const ice_view *v, int i, int j, int k, double t, double force[3])
{
    const int cell[MESH_MAX_DIM] = {v->b->lo[0] + i, v->b->lo[1] + j, v->b->lo[2] + k};
    double x[3] = {0.0, 0.0, 0.0}, heat = 0.0;
    for (int a = 0; a < v->dim; ++a) x[a] = mesh_centre(s->mesh, a, cell[a]);
    force[0] = force[1] = force[2] = 0.0;
    if (s->scene->driving) heat = s->scene->driving(s->scene->initial_user, x, t, force);
    for (int l = 0; l < s->scene->n_loads; ++l)
        if (load_is_field_on(s->scene, &s->scene->load[l], -1)) add_field(s, &s->scene->load[l], cell, x, t, force);
    return heat;
}

/* At the start of the step, into F and H. */
static void add_source_rates(const ice *s, const ice_view *v, int r)
{
    const ice_fluid *m = &v->m[r];
    const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row)
        for (int i = 0; i < v->b->n[0]; ++i) {
            const int j = ice_row_j(q, row), k = ice_row_k(q, row);
            const ptrdiff_t at = mesh_index(v->b, i, j, k);
            double force[3];
            m->heat[at] += source_at(s, v, i, j, k, s->time, force) * (v->multi ? m->theta[at] : 1.0);
            for (int a = 0; a < v->dim; ++a) m->diff[a][at] += m->rho[at] * force[a];
        }
}

/* At half the step, with the velocities there, onto the Lagrangian values and into the ledger. */
static void add_exact_sources(const ice *s, const ice_view *v, int r)
{
    const ice_fluid *m = &v->m[r];
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    const int chunk = ice_rows_chunk(s, q);
#pragma omp parallel for schedule(static, chunk)
    for (int row = 0; row < q.n; ++row)
        for (int i = 0; i < v->b->n[0]; ++i) {
            const int j = ice_row_j(q, row), k = ice_row_k(q, row);
            const ptrdiff_t at = mesh_index(v->b, i, j, k);
            if (!(m->rho[at] > 0.0)) continue;
            double force[3], *tile = ice_tile(s, v->b, i, j, k);
            const double heat = v->dt * source_at(s, v, i, j, k, s->time + 0.5 * v->dt, force) *
                                (v->multi ? m->theta[at] : 1.0) / m->rho[at];
            const double mass = m->rho[at] * v->volume[i];
            m->el[at] += heat;
            tile[TILE_SOURCE_ENERGY] += mass * heat;
            double x[MESH_MAX_DIM];
            ice_place_of(s, v->b, (const int[]){i, j, k}, x);
            for (int a = 0; a < v->dim; ++a) {
                const double du = v->dt * force[a], old = m->ul[a][at], work = du * m->diff[a][at];
                m->ul[a][at] = old + du;
                m->el[at] += work - du * (old + 0.5 * du);
                ice_add_impulse(tile + TILE_SOURCE_MOMENTUM, x, a, mass * du);
                tile[TILE_SOURCE_ENERGY] += mass * work;
            }
        }
}

static void rates_of(const ice *s, const ice_view *v, int r)
{
    (void)s;
    const ice_fluid *m = &v->m[r];
    const diffusing d = diffusing_of(v, r, (const double *const[3]){m->u[0], m->u[1], m->u[2]}, m->diffT);
    each_row(v, r, &d, rate_rows);
}

floe_status ice_diffusion_rates_of(ice *s, const ice_region *g)
{
    const bool conducts = ice_conducts(s);
    for (int r = 0; r < g->n; ++r) {
        const int material = g->first + r;
        if (s->material[material].points) continue;
        if (conducts) {
            each_block(s, g, r, set_temperatures);
            ice_fill_ghosts(s, C_DIFFUSION_T, material, FILL_CURRENT, GHOST_TEMPERATURE);
        }
        each_block(s, g, r, rates_of);
        if (has_force_field(s)) each_block(s, g, r, add_source_rates);
        ice_fill_ghosts(s, C_DIFFUSION, material, FILL_CURRENT, GHOST_EVEN);
    }
    return FLOE_OK;
}

void ice_diffusion_face_velocity(const ice *s, const ice_view *v, int r, int axis)
{
    const ice_fluid *m = &v->m[r];
    const ptrdiff_t step = v->b->stride[axis];
    const ice_rows q = ice_rows_of(v->b, axis, 0);
    if (!material_diffuses(s, &v->material[r])) return;
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        for (ptrdiff_t R = base; R < base + v->b->n[0] + (axis == 0); ++R)
            m->fu[axis][R] += 0.5 * v->advance * v->dt * (m->diff[axis][R - step] + m->diff[axis][R]) /
                              (m->rho[R - step] + m->rho[R] + ICE_TINY);
    }
}

/* Heat H into a material raises the pressure of the cell, at its volume, by Gamma kappa H / S, Gamma = (dp/de)_rho /
 * rho. */
void ice_diffusion_pressure(const ice *s, const ice_view *v, int r, double *P)
{
    const ice_fluid *m = &v->m[r];
    const eos *law = &v->material[r].eos;
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    if (!material_diffuses(s, &v->material[r])) return;
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row), n = v->b->n[0];
        double *rho = ice_buffer(s, thread_number()), *slope = rho + n;
        for (ptrdiff_t i = 0; i < n; ++i) rho[i] = v->multi ? 1.0 / m->v[base + i] : m->rho[base + i];
        law->model->dpde(law->par, (size_t)n, rho, m->e + base, slope);
        for (ptrdiff_t i = 0; i < n; ++i) {
            const ptrdiff_t at = base + i;
            const double part = v->multi ? m->kappa[at] / v->kappa_sum[at] : 1.0;
            const double phi = ice_implicit_phi(v, 0.5 * (1.0 + v->shock[at]));
            P[at] += phi * v->dt * part * slope[i] / rho[i] * m->heat[at];
        }
    }
}

/* ---- the whole step ---- */

/* x.grad of a cell field by central differences. */
static double convective_derivative(const ice_view *v, const ice_fluid *m, const double *x, ptrdiff_t at)
{
    double sum = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const ptrdiff_t st = v->b->stride[a];
        sum += 0.5 * m->u[a][at] * v->inv_h[a] * (x[at + st] - x[at - st]);
    }
    return sum;
}

/* Temperature at half the step, in cells where the fluid is alone. */
static void advance_temperature(const ice_view *v, int r, ptrdiff_t at)
{
    const ice_fluid *m = &v->m[r];
    const eos *law = &v->material[r].eos;
    const double smooth = 1.0 - v->shock[at], rho = m->rho[at], half = 0.5 * v->dt;
    if (v->multi && !(v->mixed[at] == 1.0 && rho > 0.0)) return;
    const double squeeze = v->dP[at] * (v->multi ? v->kappa_sum[at] : 1.0 / (rho * m->c[at] * m->c[at]));
    const double density = rho + smooth * (0.5 * rho * squeeze - half * convective_derivative(v, m, m->rho, at));
    const double energy = m->e[at] + smooth * (0.5 * (m->el[at] - m->e[at]) +
                                               half * (m->heat[at] / rho - convective_derivative(v, m, m->e, at)));
    double T;
    law->model->temperature(law->par, 1, &density, &energy, &T);
    if (density > 0.0 && T > 0.0 && isfinite(T)) m->diffT[at] = T;
}

/* Velocity at half the step takes the place of F. */
static void advance_velocity(const ice_view *v, int r, ptrdiff_t at)
{
    const ice_fluid *m = &v->m[r];
    const double smooth = 1.0 - v->shock[at], half = 0.5 * v->dt;
    for (int a = 0; a < v->dim; ++a) {
        const double u = m->u[a][at], impulse = m->rho[at] > 0.0 ? half * m->diff[a][at] / m->rho[at] : 0.0;
        m->diff[a][at] =
            u + smooth * (0.5 * (m->ul[a][at] - u) + impulse - half * convective_derivative(v, m, m->u[a], at));
    }
}

static void advance_to_half(const ice *s, const ice_view *v, int r)
{
    (void)s;
    const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at) {
            if (v->m[r].diffT) advance_temperature(v, r, at);
            advance_velocity(v, r, at);
        }
    }
}

static diffusing values_at_half(const ice_view *v, int r)
{
    const ice_fluid *m = &v->m[r];
    return diffusing_of(v, r, (const double *const[3]){m->diff[0], m->diff[1], m->diff[2]}, m->diffT);
}

static void apply_diffusion(const ice *s, const ice_view *v, int r)
{
    (void)s;
    const diffusing d = values_at_half(v, r);
    each_row(v, r, &d, apply_rows);
}

/* Axis 0 is a radius. */
static bool is_radial(const ice_view *v, const diffusing *d)
{
    return v->dim == 2 && d->radius != NULL;
}

/* Traction, its work and the heat through the open share of a side, into the ledger. */
static void enter_face(const ice *s, const ice_view *v, int axis, mesh_side side, side_face at, const diffusing *d)
{
    const int face_i = at.i + (axis == 0 && side == SIDE_UPPER);
    const ice_face_diffusion f = diffusion_on(d, axis, at.face, face_i, v->dim, is_radial(v, d));
    const double area = axis == 0 ? v->area0[face_i] : v->volume[at.i] * v->inv_h[axis];
    const double scale =
        at.outward * area * v->dt * ice_side_aperture(s, v, (const int[]){at.i, at.j, at.k}, axis, side);
    double *tile = ice_tile(s, v->b, at.i, at.j, at.k), x[MESH_MAX_DIM];
    ice_side_place(s, v->b, axis, side, (const int[]){at.i, at.j, at.k}, x);
    for (int a = 0; a < v->dim; ++a)
        if (!(a == 0 && is_radial(v, d))) ice_add_impulse(tile + TILE_MOMENTUM, x, a, scale * f.t[a]);
    tile[TILE_ENERGY] += scale * f.power;
}

static void enter_side_flux(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at)
{
    const diffusing d = values_at_half(v, r);
    enter_face(s, v, axis, side, at, &d);
}

static void enter_sides(const ice *s, const ice_view *v, int r)
{
    ice_visit_sides(s, v, r, enter_side_flux);
}

void ice_diffuse(const ice *s, const ice_region *g)
{
    const bool conducts = ice_conducts(s);
    for (int r = 0; r < g->n; ++r) {
        const int material = g->first + r;
        if (!material_diffuses(s, &s->material[material])) continue;
        each_block(s, g, r, advance_to_half);
        ice_fill_ghosts(s, C_DIFFUSION, material, FILL_CURRENT, GHOST_VELOCITY);
        if (conducts) ice_fill_ghosts(s, C_DIFFUSION_T, material, FILL_CURRENT, GHOST_TEMPERATURE);
        each_block(s, g, r, apply_diffusion);
        each_block(s, g, r, enter_sides);
        if (has_force_field(s)) each_block(s, g, r, add_exact_sources);
    }
}

/* ---- beside embedded boundaries ---- */

/* At t^n, with velocities at the centres of cells where a fluid is viscous (theory 7.7). */
static diffusing embedded_now(const ice_view *v, int r)
{
    const ice_fluid *m = &v->m[r];
    double *const *u = m->centred[0] ? m->centred : m->u;
    return diffusing_of(v, r, (const double *const[3]){u[0], u[1], u[2]}, m->diffT);
}

static void apply_cut(const ice *s, const ice_view *v, int r)
{
    (void)s;
    const diffusing d = embedded_now(v, r);
    each_row(v, r, &d, apply_rows);
}

static void enter_cut_side(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at)
{
    const diffusing d = embedded_now(v, r);
    enter_face(s, v, axis, side, at, &d);
}

static void enter_cut_sides(const ice *s, const ice_view *v, int r)
{
    ice_visit_sides(s, v, r, enter_cut_side);
}

ice_face_diffusion ice_cut_stress(const ice_view *v, int r, int axis, ptrdiff_t R, ptrdiff_t i)
{
    const diffusing d = embedded_now(v, r);
    return diffusion_on(&d, axis, R, i, v->dim, is_radial(v, &d));
}

double ice_cut_hoop(const ice_view *v, int r, ptrdiff_t at, ptrdiff_t i)
{
    const diffusing d = embedded_now(v, r);
    return is_radial(v, &d) ? diffusion_hoop(&d, at, i, v->dim) : 0.0;
}

void ice_diffuse_cut(const ice *s, const ice_region *g)
{
    for (int r = 0; r < g->n; ++r) {
        if (!material_diffuses(s, &s->material[g->first + r])) continue;
        each_block(s, g, r, apply_cut);
        each_block(s, g, r, enter_cut_sides);
    }
}

static void embedded_rates_of(const ice *s, const ice_view *v, int r)
{
    (void)s;
    double *const *u = v->m[r].centred;
    const diffusing d = diffusing_of(v, r, (const double *const[3]){u[0], u[1], u[2]}, NULL);
    each_row(v, r, &d, rate_rows);
}

bool ice_diffusion_moves_faces(const ice *s)
{
    return ice_diffuses(s) || (s->cut && s->implicit && ice_is_viscous(s));
}

void ice_cut_diffusion_rates(const ice *s, const ice_region *g)
{
    for (int r = 0; r < g->n; ++r) each_block(s, g, r, embedded_rates_of);
}

void ice_find_temperatures(const ice *s, const ice_region *g)
{
    for (int r = 0; r < g->n; ++r) {
        each_block(s, g, r, set_temperatures);
        ice_fill_ghosts(s, C_DIFFUSION_T, g->first + r, FILL_CURRENT, GHOST_TEMPERATURE);
    }
}
