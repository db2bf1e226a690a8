/* A block's arrays and metrics, gathered for the kernels. */
#include "ice/ice_constants.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_storage.h"
#include "ice/state/ice_traced.h"

#include <math.h>

static void view_vector(const fields *f, double *(*get)(const fields *, field_id, int, int), field_id id, int instance,
                        int dim, double *out[3])
{
    for (int a = 0; a < dim; ++a) out[a] = get(f, id, instance, a);
}

static void gather_material(const fields *f, int r, int dim, ice_fluid *m)
{
    m->rho = field_get(f, C_RHO, r, 0);
    m->e = field_get(f, C_ENERGY, r, 0);
    m->vol = field_get(f, C_VOL, r, 0);
    m->open = field_get(f, C_OPEN, r, 0);
    m->open1 = field_next(f, C_OPEN, r, 0);
    m->v = m->vol1 = field_next(f, C_VOL, r, 0);
    m->rho1 = field_next(f, C_RHO, r, 0);
    m->e1 = field_next(f, C_ENERGY, r, 0);
    m->T = field_get(f, C_TEMP, r, 0);
    m->theta = field_get(f, C_THETA, r, 0);
    m->c = field_get(f, C_SOUND, r, 0);
    m->kappa = field_get(f, C_KAPPA, r, 0);
    m->el = field_get(f, C_ENERGY_L, r, 0);
    m->vl = field_get(f, C_VOLUME_L, r, 0);
    m->e_found = field_get(f, C_ENERGY_FOUND, r, 0);
    m->vol_found = field_get(f, C_VOLUME_FOUND, r, 0);
    m->rhol = field_get(f, C_RHO_L, r, 0);
    m->heat = field_get(f, C_DIFFUSION_HEAT, r, 0);
    m->diffT = field_get(f, C_DIFFUSION_T, r, 0);
    m->dT = field_get(f, C_TEMP_CHANGE, r, 0);
    view_vector(f, field_get, C_DIFFUSION, r, dim, m->diff);
    view_vector(f, field_get, C_VEL_CENTRED, r, dim, m->centred);
    view_vector(f, field_get, C_VEL, r, dim, m->u);
    view_vector(f, field_next, C_VEL, r, dim, m->u1);
    view_vector(f, field_get, C_VEL_L, r, dim, m->ul);
    view_vector(f, field_get, F_VEL, r, dim, m->fu);
    view_vector(f, field_get, F_THETA, r, dim, m->ft);
    view_vector(f, field_get, C_SOURCE, r, dim, m->source);
    view_vector(f, field_get, C_MOMENTUM_L, r, dim, m->mom);
    view_vector(f, field_get, C_VELOCITY_CHANGE, r, dim, m->dv);
    view_vector(f, field_get, C_STRESS_ACCEL, r, dim, m->stress);
    view_vector(f, field_get, F_MOBILITY, r, dim, m->mobility);
}

/* What all materials of the region share. */
static void gather_shared(const fields *f, ice_view *v)
{
    const int dim = v->dim, instance = v->region;
    v->p = field_next(f, C_PRESSURE, instance, 0);
    v->P = field_get(f, C_PRESSURE_ADVANCED, instance, 0);
    v->dP = field_get(f, C_DP, instance, 0);
    v->shock = field_get(f, C_SHOCK, instance, 0);
    v->contact = field_get(f, C_CONTACT, instance, 0);
    v->kappa_sum = field_get(f, C_KAPPA_SUM, instance, 0);
    v->limiter = field_get(f, C_LIMITER, instance, 0);
    v->mixed = field_get(f, C_MIXED, instance, 0);
    v->tmv = field_get(f, C_TMV_RATIO, instance, 0);
    v->step = field_next(f, C_PRESSURE_STEP, instance, 0);
    v->last_step = field_get(f, C_PRESSURE_STEP, instance, 0);
    v->interface = field_get(f, C_INTERFACE, instance, 0);
    v->wall = field_get(f, C_WALL, instance, 0);
    v->owed = field_get(f, C_HEAT_OWED, instance, 0);
    view_vector(f, field_get, F_PRESSURE, instance, dim, v->fp);
    view_vector(f, field_get, C_SLOW_SHOCK, instance, dim, v->flat);
    view_vector(f, field_get, F_DONOR_DENSITY, instance, dim, v->donor_rho);
    view_vector(f, field_get, F_DONOR_ENERGY, instance, dim, v->donor_e);
    v->alone = field_get(f, C_ALONE, instance, 0);
    for (int a = 0; a < dim; ++a)
        for (int n = 0; n < dim; ++n) v->donor_u[a][n] = field_get(f, F_DONOR_VEL, instance, a * dim + n);
    v->rho_sum = v->multi ? field_get(f, C_RHO_SUM, instance, 0) : v->m[0].rho;
    for (int a = 0; a < dim; ++a) {
        v->mean[a] = v->multi ? field_get(f, C_VEL_MEAN, instance, a) : v->m[0].u[a];
        v->flux[a] = v->multi ? field_get(f, F_FLUX, instance, a) : v->m[0].fu[a];
    }
}

static void set_spacings(const ice *s, int block_id, ice_view *v)
{
    const mesh *m = s->mesh;
    for (int a = 0; a < 3; ++a) {
        v->h[a] = m->h[a];
        v->inv_h[a] = a < m->dim ? 1.0 / m->h[a] : 0.0;
        v->gravity[a] = s->gravity[a];
    }
    v->length = v->finest = m->h[0];
    for (int a = 1; a < m->dim; ++a) {
        v->length = most(v->length, m->h[a]);
        v->finest = least(v->finest, m->h[a]);
    }
    for (int a = 0; a < 3; ++a) v->share[a] = m->h[a] / v->length;
    const int run = v->b->n[0] + 2 * MESH_GHOST + 1;
    const double *metric = s->storage->metric[block_id] + MESH_GHOST;
    v->lower0 = metric;
    v->upper0 = metric + run;
    v->volume = metric + 2 * run;
    v->area0 = metric + 3 * run;
    v->radius0 = metric + 4 * run;
}

static void set_scheme(const ice *s, ice_view *v)
{
    const scene_method *method = &s->scene->method;
    v->base = method->centring == ICE_CENTRING_FULL ? 1.0 : 0.0;
    v->slope = method->centring == ICE_CENTRING_AUTO ? 1.0 : 0.0;
    v->advance = s->implicit && method->centring != ICE_CENTRING_HALF ? 2.0 : 1.0;
    v->limit_lo = method->limiter == ICE_LIMITER_NONE ? 1.0 : 0.0;
    v->limit_hi = method->limiter == ICE_LIMITER_FIRST_ORDER ? 0.0 : 1.0;
    v->limit_beyond = s->implicit && method->limiter == ICE_LIMITER_DEFAULT ? ICE_SLOW_OVERSHOOT : 0.0;
}

static void gather_reactions(const ice *s, const fields *f, ice_view *v)
{
    for (int k = 0; k < s->scene->n_reactions; ++k) {
        v->reacted[k] = field_get(f, C_REACTED, k, 0);
        v->burnt_energy[k] = field_get(f, C_BURNT_ENERGY, k, 0);
        v->burns = v->burns || v->burnt_energy[k];
        view_vector(f, field_get, C_BURNT_MOMENTUM, k, v->dim, v->burnt_momentum[k]);
    }
}

void ice_view_make(const ice *s, const ice_region *g, int block_id, ice_view *v)
{
    const fields *f = s->domain->fields[block_id];
    *v = (ice_view){.b = &s->mesh->block[block_id],
                    .material = s->material,
                    .dim = s->mesh->dim,
                    .radial = s->mesh->geometry == MESH_AXISYMMETRIC,
                    .n_materials = s->n_materials,
                    .multi = ice_is_mixture(s),
                    .dt = s->dt};
    if (g) {
        v->region = g->number;
        v->first = g->first;
        v->material = s->material + g->first;
        v->n_materials = g->n;
        v->multi = g->n > 1;
    }
    v->traced = g && ice_is_traced(s, g);
    v->uneven = g && s->implicit && v->multi && ice_bears_unevenly(s, g);
    set_spacings(s, block_id, v);
    set_scheme(s, v);
    v->reconcile = v->multi && ice_follows_isentropes(s, g ? g : &s->region[0]);
    const ice_span *near = s->storage->near[block_id];
    const int rows = ice_rows_of(v->b, -1, MESH_GHOST).n;
    for (int r = 0; r < v->n_materials; ++r) {
        gather_material(f, v->first + r, v->dim, &v->m[r]);
        v->m[r].near = near ? near + (ptrdiff_t)(v->first + r) * rows : NULL;
    }
    gather_shared(f, v);
    v->sharp = s->storage->sharp[block_id];
    gather_reactions(s, f, v);
}

bool ice_next_view(const ice *s, const ice_region *g, int *id, ice_view *v)
{
    if (*id >= s->mesh->n_blocks) return false;
    ice_view_make(s, g, (*id)++, v);
    return true;
}

void ice_view_lagrangian(ice_view *v)
{
    for (int r = 0; r < v->n_materials; ++r)
        if (v->m[r].rhol) v->m[r].rho = v->m[r].rhol;
}

void ice_run_cells(const ice_view *v, int ghost, ice_row *kernel)
{
    const ice_rows q = ice_rows_of(v->b, -1, ghost);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) kernel(v, ice_row_j(q, row), ice_row_k(q, row));
}

void ice_run_faces(const ice_view *v, int r, int axis, ice_material_row *kernel)
{
    const ice_rows q = ice_rows_of(v->b, axis, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) kernel(v, r, axis, ice_row_j(q, row), ice_row_k(q, row));
}
