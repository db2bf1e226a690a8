/* Loads on points that act on their volume: body forces, energy. Those on surfaces: traction.c. */
#include "mpm/loads/point_loads.h"
#include "mpm/motion/motion.h"
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

void set_body_forces(mpm *s)
{
    memset(s->acceleration, 0, sizeof s->acceleration);
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        if (load->kind != LOAD_BODY_FORCE) continue;
        double acceleration[3];
        load_acceleration(s->scene, load, load_time(s), acceleration);
        for (int b = 0; b < s->n_bodies; ++b)
            if (load->body < 0 || load->body == s->body[b].scene_body)
                for (int a = 0; a < 3; ++a) s->acceleration[b][a] += load_now(s, load) * acceleration[a];
    }
    motions_take_body_forces(s);
}

bool is_driven(const mpm *s, int body)
{
    const scene *sc = s->scene;
    const mpm_body *b = &s->body[body];
    if (!sc->driving_solids || b->fluid || b->membrane.model) return false;
    return sc->verify.body < 0 || sc->verify.body == b->scene_body;
}

static void drive_body(const mpm *s, int blk, int body, double t)
{
    const fields *f = s->domain->fields[blk];
    const int dim = s->mesh->dim;
    const double *rest[3];
    double *out[3];
    for (int a = 0; a < dim; ++a) {
        rest[a] = field_get(f, P_REST, body, a);
        out[a] = field_get(f, P_DRIVE, body, a);
    }
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < s->points[blk][body].n; ++k) {
        double x[3] = {0.0}, force[3];
        for (int a = 0; a < dim; ++a) x[a] = rest[a][k];
        s->scene->driving_solids(s->scene->initial_user, x, t, force);
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
