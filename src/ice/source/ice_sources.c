/* Lagrangian values of the fluids: pressure and gravity (theory 2.6), heat (2.7, 2.8), viscosity and conduction, loads; and the impulse of
 * the pressure on materials carried by points. Guilkey et al. 2003, steps 8 and 9.
 *
 *     u^L = u - dt (theta/rho) grad P* + dt g
 *     conserving:      heat Q = -dt sum_f A_f P* F - sum_r D_p . (u + u^L)/2, D_p the pressure's impulse, shared by f^r (2.8 i);
 *                      gravity's impulse D_g then does the work D_g . (u + u^L)/2, and a column at rest is not heated
 *     where it cannot: Q^r = theta^r kappa^r P dP per volume (2.7) */
#include "ice/source/ice_lagrangian.h"

#include "coupling/isentrope.h"
#include "ice/equilibrium/ice_equilibrium.h"
#include "ice/ice_constants.h"
#include "ice/sides/ice_sides.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_tiles.h"

#include <math.h>

/* What the pressure on a block's faces is made of: apart from the view, so that the compiler knows that no store
 * changes it. */
typedef struct pressed {
    const double *fp[3], *flux[3], *lower0, *upper0;
    double dt, inv_h[3];
    ptrdiff_t stride[3];
} pressed;

FLOE_ALWAYS_INLINE pressed pressed_of(const ice_view *v)
{
    pressed f = {.lower0 = v->lower0, .upper0 = v->upper0, .dt = v->dt};
    for (int a = 0; a < MESH_MAX_DIM; ++a) {
        f.fp[a] = v->fp[a];
        f.flux[a] = v->flux[a];
        f.inv_h[a] = v->inv_h[a];
        f.stride[a] = v->b->stride[a];
    }
    return f;
}

/* Pressure gradient impulse per volume and the work that faces do on the cell per volume. */
typedef struct pressure_force {
    double impulse[3], work;
} pressure_force;

FLOE_ALWAYS_INLINE pressure_force pressure_force_of(const pressed *f, ptrdiff_t at, ptrdiff_t i, const int dim)
{
    const double *fp = f->fp[0], *flux = f->flux[0];
    /* (All of it has a value: what is set in part stays in memory in clang's vectors, one for all lanes.) */
    pressure_force q = {{-f->dt * f->inv_h[0] * (fp[at + 1] - fp[at])},
                        f->lower0[i] * fp[at] * flux[at] - f->upper0[i] * fp[at + 1] * flux[at + 1]};
    for (int a = 1; a < dim; ++a) {
        const ptrdiff_t up = at + f->stride[a];
        q.impulse[a] = -f->dt * f->inv_h[a] * (f->fp[a][up] - f->fp[a][at]);
        q.work += (f->fp[a][at] * f->flux[a][at] - f->fp[a][up] * f->flux[a][up]) * f->inv_h[a];
    }
    q.work *= f->dt;
    return q;
}

/* P dP of 2.7. P has been smoothed over neighbours; gas that expands gives no more work than its own pressure does, or a cold cell
 * beside hot ones would pay with energy that it has not got. */
FLOE_ALWAYS_INLINE double compression_work(const double *advanced, const double *current, const double *increment,
                                           ptrdiff_t at)
{
    const double P = advanced[at], p = current[at], dP = increment[at];
    return (dP < 0.0 && p < P ? p : P) * dP;
}

double ice_compression_work(const ice_view *v, ptrdiff_t at)
{
    return compression_work(v->P, v->p, v->dP, at);
}

/* One fluid, as its rows are worked on. */
typedef struct single {
    pressed faces;
    ice_fluid m;
    const double *P, *p, *dP;
    double gravity_impulse[3], floor; /* m/s: gravity's in the step; J/kg */
    bool conserve;
    bool whole; /* the energy of the whole step is looked at after advection alone (theory 2.17) */
} single;

/* u^L and e^L of a cell. Returns whether it fell back to 2.7. */
FLOE_ALWAYS_INLINE bool single_cell(const single *g, ptrdiff_t at, ptrdiff_t i, const int dim)
{
    const pressure_force f = pressure_force_of(&g->faces, at, i, dim);
    const ice_fluid *m = &g->m;
    const double rho = m->rho[at], inverse = 1.0 / rho, inv_c = 1.0 / m->c[at];
    double kinetic = 0.0, gain = 0.0;
    for (int a = 0; a < dim; ++a) {
        const double u = m->u[a][at], du = f.impulse[a] * inverse, next = u + (du + g->gravity_impulse[a]);
        gain += du * 0.5 * (u + next);
        kinetic += 0.5 * next * next;
        m->ul[a][at] = next;
    }
    const double conserving = m->e[at] + f.work * inverse - gain;
    const double plain = m->e[at] + compression_work(g->P, g->p, g->dP, at) * (inverse * inverse * inv_c * inv_c);
    const bool usable = g->conserve && (g->whole || conserving - g->floor > ICE_THERMAL_SHARE * kinetic);
    m->el[at] = usable ? conserving : plain;
    return g->conserve && !usable;
}

/* Returns how many cells fell back to 2.7. */
FLOE_ALWAYS_INLINE int single_row(const ice_view *v, int j, int k, bool conserve, double floor, const int dim)
{
    single g = {pressed_of(v), v->m[0], v->P, v->p, v->dP, {0.0}, floor, conserve, v->traced && !v->alone};
    for (int a = 0; a < dim; ++a) g.gravity_impulse[a] = v->dt * v->gravity[a];
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    int guarded = 0;
#pragma omp simd reduction(+ : guarded)
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) guarded += single_cell(&g, base + i, i, dim);
    return guarded;
}

/* A fluid's gain of energy per mass by the reversible work of dP: P dP, and where its volume changes by more than a twentieth, what its isentrope
 * has between the volumes (ice_volume.c), since a trace of gas in a liquid would else gain in one step what it expands against. */
double ice_reversible_gain(const ice_view *v, int r, ptrdiff_t at, double work)
{
    const ice_fluid *m = &v->m[r];
    const double linear = m->theta[at] * m->kappa[at] * work / m->rho[at], squeeze = m->kappa[at] * v->dP[at];
    isentrope path;
    if (!v->reconcile || fabs(squeeze) <= ICE_LINEAR_SQUEEZE) return linear;
    if (!isentrope_through(&v->material[r].eos, m->v[at], m->e[at], &path)) return linear;
    return isentrope_energy(&path, ice_specific_volume_after(m, at, v->dP[at], false)) - m->e[at];
}

/* sum theta kappa of those that points carry. */
FLOE_ALWAYS_INLINE double solids_compressibility(const ice_view *v, ptrdiff_t at, const bool *points)
{
    double sum = 0.0;
    for (int r = 0; r < v->n_materials; ++r)
        if (points[r]) sum += v->m[r].theta[at] * v->m[r].kappa[at];
    return sum;
}

/* Several materials. In cells of several fluids only the reversible part is given here: velocities that the pressure drives apart come together
 * again in the exchange, and what closes the energy is known after it (C_HEAT_OWED, ice_exchange.c). */
FLOE_ALWAYS_INLINE int multi_row(const ice_view *v, int j, int k, bool conserve, const double *floor,
                                 const bool *points, const int dim)
{
    const ptrdiff_t base = mesh_index(v->b, 0, j, k);
    const pressed faces = pressed_of(v);
    int guarded = 0;
    for (ptrdiff_t i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = base + i;
        const pressure_force f = pressure_force_of(&faces, at, i, dim);
        double gain = 0.0;
        for (int r = 0; r < v->n_materials; ++r) {
            const ice_fluid *m = &v->m[r];
            const double rho = m->rho[at], mobility = rho > 0.0 ? m->theta[at] / rho : 0.0;
            for (int a = 0; a < dim; ++a) {
                const double u = m->u[a][at], du = f.impulse[a] * mobility, next = u + (du + v->dt * v->gravity[a]);
                gain += rho * du * 0.5 * (u + next);
                if (points[r])
                    m->source[a][at] = f.impulse[a] * m->theta[at] * v->volume[i];
                else
                    m->ul[a][at] = next;
            }
        }
        const bool beside = ice_holds_points(v, at), whole = conserve && (!beside || v->burns);
        const bool shared = whole && !beside && v->mixed[at] > 1.0;
        const double solid = beside ? solids_compressibility(v, at, points) : 0.0,
                     plain = compression_work(v->P, v->p, v->dP, at);
        const double heat = f.work - gain - solid * plain, share = 1.0 / (v->kappa_sum[at] - solid);
        bool usable = whole && !shared;
        double given = 0.0;
        for (int r = 0; r < v->n_materials && usable; ++r) {
            const ice_fluid *m = &v->m[r];
            if (points[r] || !(m->rho[at] > 0.0)) continue;
            double kinetic = 0.0;
            for (int a = 0; a < dim; ++a) kinetic += 0.5 * m->ul[a][at] * m->ul[a][at];
            const double e = m->e[at] + m->theta[at] * m->kappa[at] * share * heat / m->rho[at];
            usable = e - floor[r] > ICE_THERMAL_SHARE * kinetic;
        }
        guarded += whole && !usable && !shared;
        for (int r = 0; r < v->n_materials; ++r) {
            const ice_fluid *m = &v->m[r];
            if (points[r]) continue;
            const double theta = m->theta[at], trace_factor = !beside ? 1.0 : fmin(1.0, theta / ICE_FULL_HEAT);
            if (shared && m->rho[at] > 0.0) {
                const double gained = ice_reversible_gain(v, r, at, plain);
                m->el[at] = m->e[at] + gained;
                given += m->rho[at] * gained;
                continue;
            }
            const double part = theta * m->kappa[at] * (usable ? share * heat : plain) * trace_factor;
            m->el[at] = m->e[at] + (m->rho[at] > 0.0 ? part / m->rho[at] : 0.0);
        }
        v->owed[at] = shared ? heat - given : 0.0;
    }
    return guarded;
}

/* Energy per volume of the pressure step that 2.7 made or lost in a cell. */
static double pressure_defect(const ice_view *v, ptrdiff_t at, int i)
{
    const pressed faces = pressed_of(v);
    double made = -pressure_force_of(&faces, at, i, v->dim).work;
    for (int r = 0; r < v->n_materials; ++r) {
        const ice_fluid *m = &v->m[r];
        double square = 0.0;
        if (v->material[r].points) continue;
        for (int a = 0; a < v->dim; ++a) {
            const double after = m->ul[a][at], before = m->u[a][at];
            square += (after - before - v->dt * v->gravity[a]) * (after + before);
        }
        made += m->rho[at] * (m->el[at] - m->e[at] + 0.5 * square);
    }
    return made;
}

/* The row again, cell by cell: cells whose energy does not close are those that were guarded. */
static void enter_guards(const ice *s, const ice_view *v, int j, int k)
{
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(v->b, i, j, k);
        if (v->multi && v->mixed[at] > 1.0) continue;         /* several fluids, or a solid */
        if (v->m[0].open && v->m[0].open[at] < 1.0) continue; /* merged cells have sums of their own */
        const double made = pressure_defect(v, at, i);
        double scale = 0.0;
        for (int r = 0; r < v->n_materials; ++r)
            if (!v->material[r].points) scale += v->m[r].rho[at] * fabs(v->m[r].el[at]);
        if (!(fabs(made) > 1e-13 * scale)) continue;
        double *tile = ice_tile(s, v->b, i, j, k);
        tile[TILE_DEFECT] += made * v->volume[i];
        tile[TILE_GUARDS] += 1.0;
    }
}

/* Gravity's momentum and work on the fluids, into the tiles. */
static void enter_gravity(const ice *s, const ice_view *v, int j, int k)
{
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(v->b, i, j, k);
        if (s->cut && s->cut->is_merged(s, v->region, v->b, i, j, k)) continue; /* sums of their own */
        double *tile = ice_tile(s, v->b, i, j, k), x[MESH_MAX_DIM];
        ice_place_of(s, v->b, (const int[]){i, j, k}, x);
        for (int r = 0; r < v->n_materials; ++r) {
            if (v->material[r].points) continue;
            const double mass = v->m[r].rho[at] * v->volume[i];
            for (int a = 0; a < v->dim; ++a) {
                const double du = v->dt * v->gravity[a];
                ice_add_impulse(tile + TILE_SOURCE_MOMENTUM, x, a, mass * du);
                tile[TILE_SOURCE_ENERGY] += 0.5 * mass * du * (v->m[r].u[a][at] + v->m[r].ul[a][at]);
            }
        }
    }
}

#define INSTANCE(d)                                                                 \
    FLOE_WIDE static int single_##d(const ice_view *v, int j, int k, bool conserve) \
    {                                                                               \
        return single_row(v, j, k, conserve, ice_least_energy(v, 0), d);            \
    }                                                                               \
    static int multi_##d(const ice_view *v, int j, int k, bool conserve)            \
    {                                                                               \
        bool points[ICE_MAX_MATERIALS];                                             \
        double floor[ICE_MAX_MATERIALS];                                            \
        for (int r = 0; r < v->n_materials; ++r) {                                  \
            points[r] = v->material[r].points;                                      \
            floor[r] = ice_least_energy(v, r);                                      \
        }                                                                           \
        return multi_row(v, j, k, conserve, floor, points, d);                      \
    }
INSTANCE(1)
INSTANCE(2)
INSTANCE(3)
/* Return the number of cells with a guard; indexed [dim - 1][multi]. */
typedef int source_row(const ice_view *v, int j, int k, bool conserve);
static source_row *const source_row_kernels[3][2] = {{single_1, multi_1}, {single_2, multi_2}, {single_3, multi_3}};

static void source_rows(const ice *s, const ice_view *v)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
    const int chunk = ice_rows_chunk(s, q);
    const bool gravity = s->gravity[0] != 0.0 || s->gravity[1] != 0.0 || s->gravity[2] != 0.0,
               conserve = s->scene->method.conserve_energy;
    source_row *kernel = source_row_kernels[v->dim - 1][v->multi];
#pragma omp parallel for schedule(static, chunk)
    for (int row = 0; row < q.n; ++row) {
        const int j = ice_row_j(q, row), k = ice_row_k(q, row);
        if (kernel(v, j, k, conserve) > 0) enter_guards(s, v, j, k);
        if (gravity) enter_gravity(s, v, j, k);
    }
}

void ice_find_sources(ice *s, const ice_region *g)
{
    ice_clear_tiles(s);
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) source_rows(s, &v);
    if (!ice_has_diffusion(s)) return;
    (s->cut ? ice_diffuse_cut : ice_diffuse)(s, g);
    ice_diffuse_between(s, g);
}

floe_status ice_finish_sources(ice *s, const ice_region *g)
{
    ice_boundary_work(s, g);
    TRY(ice_apply_loads(s, g));
    ice_enter_tiles(s);
    return FLOE_OK;
}

floe_status ice_sources_of(ice *s, const ice_region *g)
{
    ice_find_sources(s, g);
    return ice_finish_sources(s, g);
}
