/* Loads on points that act on their volume: body forces, energy. Those on surfaces: traction.c. */
#include "mpm/loads/point_loads.h"
#include "mpm/motion/motion.h"
#include "mpm/state/region.h"
#include "mpm/transfer/scratch.h"
#include "scene/state.h"

#include <string.h>

scene_load load_as_solved(const mpm *s, const scene_load *load)
{
    return s->solver == SOLVER_STATIC ? load_until(load, s->scene->time.end) : *load;
}

/* When a step that is solved for takes its loads: at its end, with inertia in the middle. */
static double implicit_time(const mpm *s)
{
    return s->time + (s->solver == SOLVER_STATIC ? 1.0 : 0.5) * s->dt;
}

static double load_at_end(const mpm *s, const scene_load *load)
{
    const scene_load solved = load_as_solved(s, load);
    return load_fraction(&solved, &(load_step){s->time, implicit_time(s), s->step});
}

double load_now(const mpm *s, const scene_load *load)
{
    if (mpm_is_solved(s)) return load_at_end(s, load);
    if (load->ramp <= 0.0 && load->ramp_steps == 0)
        return s->time >= load->start ? 1.0 : 0.0; /* from the first kick on */
    return load_fraction(load, &(load_step){s->time, s->time, s->step - 1});
}

/* When the forces of a step are taken: points that move alone have their velocities half a step before it. */
double load_time(const mpm *s)
{
    if (mpm_is_solved(s)) return implicit_time(s);
    return s->cells == CELLS_NONE ? s->time : s->time + 0.5 * s->dt;
}

/* ---- body forces that change with place ---- */

/* Adds that of a load on a point (m/s2). */
static void add_field_at(const mpm *s, const scene_load *load, int blk, int body, size_t k, double out[3])
{
    const fields *f = s->domain->fields[blk];
    double x[3] = {0.0}, vector[3];
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, body, a)[k];
    load_vector(s->scene, load, x, load_time(s), vector);
    const double share = load_now(s, load) * point_region_share(s, f, body, k, &load->region);
    for (int a = 0; a < s->mesh->dim; ++a) out[a] += share * vector[a];
}

static void field_at(const mpm *s, int blk, int body, size_t k, double out[3])
{
    for (int l = 0; l < s->scene->n_loads; ++l)
        if (load_is_field_on(s->scene, &s->scene->load[l], s->body[body].scene_body))
            add_field_at(s, &s->scene->load[l], blk, body, k, out);
}

enum { SUM_FORCE, SUM_MOMENT = 3, SUM_END = 6 };

static void add_field_tile(mpm *s, int blk, int tile, void *user, double *sum)
{
    const int body = *(const int *)user;
    const size_t *at = s->points[blk][body].tile_start;
    const fields *f = s->domain->fields[blk];
    for (size_t k = at[tile]; k < at[tile + 1]; ++k) {
        double x[3] = {0.0}, force[3] = {0.0};
        field_at(s, blk, body, k, force);
        for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, body, a)[k];
        for (int a = 0; a < 3; ++a) {
            force[a] *= field_get(f, P_MASS, body, 0)[k];
            sum[SUM_FORCE + a] += force[a];
            add_moment(sum + SUM_MOMENT, x, a, force[a]);
        }
    }
}

/* A whole body takes the sum over its points. */
static void take_field(mpm *s, int body)
{
    double sum[SUM_END] = {0.0};
    if (s->stages->planning) return; /* there are no points yet */
    if (scene_has_field_on(s->scene, s->body[body].scene_body)) sum_over_tiles(s, SUM_END, add_field_tile, &body, sum);
    motion_take_field(s, body, sum + SUM_FORCE, sum + SUM_MOMENT);
}

/* ---- body forces ---- */

void set_body_forces(mpm *s)
{
    memset(s->acceleration, 0, sizeof s->acceleration);
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        if (load->kind != LOAD_BODY_FORCE || !load_is_uniform(s->scene, load)) continue;
        double acceleration[3];
        load_acceleration(s->scene, load, load_time(s), acceleration);
        for (int b = 0; b < s->n_bodies; ++b)
            if (load->body < 0 || load->body == s->body[b].scene_body)
                for (int a = 0; a < 3; ++a) s->acceleration[b][a] += load_now(s, load) * acceleration[a];
    }
    motions_take_body_forces(s);
    for (int b = s->n_deforming; b < s->n_bodies; ++b) take_field(s, b);
}

bool exact_drives(const mpm *s, int body)
{
    const scene *sc = s->scene;
    const mpm_body *b = &s->body[body];
    if (!sc->driving_solids || b->fluid || b->membrane.model) return false;
    return sc->verify.body < 0 || sc->verify.body == b->scene_body;
}

bool is_driven(const mpm *s, int body)
{
    if (body >= s->n_deforming) return false; /* it moves as a whole */
    return exact_drives(s, body) || scene_has_field_on(s->scene, s->body[body].scene_body);
}

static void drive_body(const mpm *s, int blk, int body, double t)
{
    const fields *f = s->domain->fields[blk];
    const int dim = s->mesh->dim;
    const bool exact = exact_drives(s, body);
    const double *rest[3];
    double *out[3];
    for (int a = 0; a < dim; ++a) {
        rest[a] = exact ? field_get(f, P_REST, body, a) : NULL;
        out[a] = field_get(f, P_DRIVE, body, a);
    }
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < s->points[blk][body].n; ++k) {
        double x[3] = {0.0}, force[3] = {0.0};
        for (int a = 0; exact && a < dim; ++a) x[a] = rest[a][k];
        if (exact) s->scene->driving_solids(s->scene->initial_user, x, t, force);
        field_at(s, blk, body, k, force);
        for (int a = 0; a < dim; ++a) out[a][k] = force[a];
    }
}

floe_status mpm_drive_points(mpm *s)
{
    const double t = mpm_is_solved(s) ? implicit_time(s) : s->time;
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int body = 0; body < s->n_bodies; ++body)
            if (is_driven(s, body)) drive_body(s, b, body, t);
    return FLOE_OK;
}

floe_status set_heating(mpm *s)
{
    const load_step step = {s->time, s->time + s->dt, s->step};
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        s->heat[l] = 0.0;
        if (s->cells != CELLS_NONE) continue;                                     /* the fluids are on the cells */
        if (load->kind == LOAD_HEAT) s->heat[l] = load_heating_time(load, &step); /* times the power at each point */
        if (load->kind != LOAD_PRESSURISE) continue;
        bool active;
        const double scheduled = load_scheduled_pressure(s->scene, load, &step, &active);
        if (!active) continue;
        double now;
        TRY(fail_under(s->ctx, mpm_mean_pressure(s, load->material, &load->region, &now), KEY("loads", load->name)));
        s->heat[l] = scheduled - now;
    }
    return FLOE_OK;
}
