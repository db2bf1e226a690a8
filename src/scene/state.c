#include "scene/state.h"

#include "scene/formula.h"

#include <math.h>

/* e with p(rho, e) = p by Newton, from p/rho, which is of its size in any units; pressure is linear in e for most
 * equations of state, so that two passes do. A pressure that does not depend on e at all must be that of the density;
 * the fluid then has 300 K. */
static bool energy_at_pressure(const eos *law, double rho, double p, double *e)
{
    const double usual_temperature = 300.0;
    double now, c2, slope;
    *e = p / rho;
    for (int k = 0; k < 50; ++k) {
        law->model->pressure(law->par, 1, &rho, e, &now, &c2);
        law->model->dpde(law->par, 1, &rho, e, &slope);
        if (slope == 0.0) {
            law->model->energy(law->par, 1, &rho, &usual_temperature, e);
            return fabs(now - p) <= 1e-6 * rho * c2;
        }
        if (fabs(now - p) <= 1e-15 * fabs(p)) return true;
        const double step = (p - now) / slope;
        if (!isfinite(step)) return false;
        *e += step;
        if (fabs(step) <= 4e-16 * fabs(*e)) return true;
    }
    return false;
}

floe_status fluid_state_of(context *ctx, const eos *law, double pressure, double temperature, double density,
                           fluid_state *out)
{
    const eos_model *m = law->model;
    double dvdp, c2, v;
    *out = (fluid_state){density, NAN, temperature, pressure};
    if (isnan(density)) {
        if (pressure > m->pressure_floor(law->par)) {
            m->volume(law->par, 1, &pressure, &temperature, &v, &dvdp);
            out->density = 1.0 / v;
        }
        m->energy(law->par, 1, &out->density, &temperature, &out->energy);
    } else if (isnan(temperature)) {
        if (energy_at_pressure(law, density, pressure, &out->energy))
            m->temperature(law->par, 1, &density, &out->energy, &out->temperature);
        else
            out->energy = (double)NAN;
    } else {
        m->energy(law->par, 1, &density, &temperature, &out->energy);
    }
    if (isnan(pressure)) m->pressure(law->par, 1, &out->density, &out->energy, &out->pressure, &c2);
    if (!(out->density > 0.0) || !isfinite(out->energy) || !(out->energy >= m->energy_floor(law->par, out->density)))
        return fail_key(ctx, KEY("pressure"),
                        "equation of state %s has no state with pressure %g Pa, temperature %g K, density %g kg/m3",
                        m->name, pressure, temperature, density);
    return FLOE_OK;
}

/* Exact value of a quantity at t = 0, or `otherwise` where the exact solution has none. */
static double initial_value(const scene *s, initial_quantity quantity, int component, const double x[3],
                            double otherwise)
{
    const double value = s->initial ? s->initial(s->initial_user, quantity, component, x) : (double)NAN;
    return isnan(value) ? otherwise : value;
}

bool body_velocity_known(const scene *s, int body, const double x[3])
{
    for (int a = 0; s->body[body].initial_from_exact && a < s->mesh.dim; ++a)
        if (isnan(initial_value(s, INITIAL_VELOCITY, a, x, (double)NAN))) return false;
    return true;
}

/* A fluid without pressure has no sound, and so no step on the cells to begin with. */
static floe_status check_begins(const scene *s, const scene_body *b, const fluid_state *state)
{
    const eos *law = &s->material[b->material].eos;
    const double floor = law->model->pressure_floor(law->par);
    if (s->coupling == COUPLING_MPM || state->pressure > floor) return FLOE_OK;
    return fail_key(
        s->ctx, KEY("bodies", b->name, "state"),
        "exact: the solution '%s' starts from %g Pa, and the pressure of '%s' must be above %g Pa for a run to "
        "begin; give verify.exact.%s.pressure, far below density speed^2",
        s->verify.exact, state->pressure, s->material[b->material].name, floor, s->verify.exact);
}

floe_status body_fluid_state(const scene *s, int body, const double x[3], fluid_state *out, double velocity[3])
{
    const scene_body *b = &s->body[body];
    double pressure, temperature, density;
    TRY(scene_number(s, &b->pressure, x, 0.0, &pressure));
    TRY(scene_number(s, &b->temperature, x, 0.0, &temperature));
    TRY(scene_number(s, &b->density, x, 0.0, &density));
    for (int a = 0; a < 3; ++a) TRY(scene_number(s, &b->velocity[a], x, 0.0, &velocity[a]));
    if (b->initial_from_exact) {
        pressure = initial_value(s, INITIAL_PRESSURE, 0, x, pressure);
        density = initial_value(s, INITIAL_DENSITY, 0, x, density);
        if (!isnan(temperature) && !isnan(pressure))
            density = (double)NAN;
        else if (!isnan(density))
            temperature = (double)NAN;
        for (int a = 0; a < 3; ++a) velocity[a] = initial_value(s, INITIAL_VELOCITY, a, x, velocity[a]);
    }
    TRY(fail_under(s->ctx, fluid_state_of(s->ctx, &s->material[b->material].eos, pressure, temperature, density, out),
                   KEY("bodies", b->name)));
    return b->initial_from_exact ? check_begins(s, b, out) : FLOE_OK;
}

floe_status ambient_fluid_state(const scene *s, const double x[3], fluid_state *out, double velocity[3])
{
    const eos *law = &s->material[s->ambient_material].eos;
    double pressure, temperature;
    TRY(scene_number(s, &s->ambient_pressure, x, 0.0, &pressure));
    TRY(scene_number(s, &s->ambient_temperature, x, 0.0, &temperature));
    for (int a = 0; a < 3; ++a) TRY(scene_number(s, &s->ambient_velocity[a], x, 0.0, &velocity[a]));
    return fail_under(s->ctx, fluid_state_of(s->ctx, law, pressure, temperature, (double)NAN, out), KEY("ambient"));
}

floe_status body_solid_state(const scene *s, int body, const double x[3], double velocity[3], double stress[6])
{
    const scene_body *b = &s->body[body];
    for (int a = 0; a < 3; ++a) TRY(scene_number(s, &b->velocity[a], x, 0.0, &velocity[a]));
    for (int c = 0; c < 6; ++c) TRY(scene_number(s, &b->stress[c], x, 0.0, &stress[c]));
    if (motion_is_given(&b->motion)) (void)motion_velocity_at_start(&b->motion, b->velocity, x, velocity);
    if (!b->initial_from_exact) return FLOE_OK;
    for (int a = 0; a < 3; ++a) velocity[a] = initial_value(s, INITIAL_VELOCITY, a, x, velocity[a]);
    for (int c = 0; c < 6; ++c) stress[c] = initial_value(s, INITIAL_STRESS, c, x, stress[c]);
    return FLOE_OK;
}

static double fraction_at(const scene_load *load, double t, long steps)
{
    if (t <= load->start) return 0.0;
    if (load->ramp_steps > 0) return fmin(1.0, (double)steps / (double)load->ramp_steps);
    return load->ramp > 0.0 ? fmin(1.0, (t - load->start) / load->ramp) : 1.0;
}

scene_load load_until(const scene_load *load, double end)
{
    scene_load out = *load;
    if (load->kind == LOAD_HEAT || load->ramp > 0.0 || !(end > load->start)) return out;
    out.ramp = end - load->start;
    out.ramp_steps = 0;
    return out;
}

double load_fraction(const scene_load *load, const load_step *step)
{
    return fraction_at(load, step->t_end, step->step + 1);
}

double load_target(const scene *s, const scene_load *load, const double x[3], double t)
{
    const expression *formula = scene_formula_of(s, &load->target);
    return formula ? expression_value(formula, x, t) : load->target;
}

void load_vector(const scene *s, const scene_load *load, const double x[3], double t, double out[3])
{
    for (int a = 0; a < 3; ++a) {
        const expression *formula = scene_formula_of(s, &load->vector[a]);
        out[a] = formula ? expression_value(formula, x, t) : load->vector[a];
    }
}

void load_acceleration(const scene *s, const scene_load *load, double t, double out[3])
{
    const double nowhere[3] = {0.0, 0.0, 0.0};
    load_vector(s, load, nowhere, t, out);
}

bool load_is_uniform(const scene *s, const scene_load *load)
{
    bool varies = load->region.model != NULL;
    for (int a = 0; a < 3; ++a) {
        const expression *formula = scene_formula_of(s, &load->vector[a]);
        varies = varies || (formula && expression_has_place(formula));
    }
    return !varies;
}

bool load_is_field_on(const scene *s, const scene_load *load, int body)
{
    return load->kind == LOAD_BODY_FORCE && (load->body < 0 || load->body == body) && !load_is_uniform(s, load);
}

bool scene_has_field_on(const scene *s, int body)
{
    bool any = false;
    for (int l = 0; l < s->n_loads; ++l) any = any || load_is_field_on(s, &s->load[l], body);
    return any;
}

/* Whether a ramp is in progress in the step, or held after it. */
static bool ramp_acts(const scene_load *load, const load_step *step)
{
    return load_fraction(load, step) > 0.0 && (load->hold || fraction_at(load, step->t, step->step) < 1.0);
}

/* Whether the power is on in the step: from its start on; with a ramp and no hold, until that ends. */
static bool load_heats(const scene_load *load, const load_step *step)
{
    const bool has_ramp = load->ramp > 0.0 || load->ramp_steps > 0;
    return has_ramp ? ramp_acts(load, step) : step->t_end > load->start;
}

/* The integral of a ramp from its start to t (s). */
static double ramp_integral(const scene_load *load, double t)
{
    const double gone = fmax(t - load->start, 0.0);
    if (gone < load->ramp) return 0.5 * gone * gone / load->ramp;
    return 0.5 * load->ramp + (load->hold ? gone - load->ramp : 0.0);
}

double load_heating_time(const scene_load *load, const load_step *step)
{
    if (!load_heats(load, step)) return 0.0;
    if (load->ramp_steps > 0)
        return 0.5 * (fraction_at(load, step->t, step->step) + fraction_at(load, step->t_end, step->step + 1)) *
               (step->t_end - step->t);
    if (load->ramp > 0.0) return ramp_integral(load, step->t_end) - ramp_integral(load, step->t);
    return step->t_end - fmax(step->t, load->start);
}

static double initial_pressure(const scene *s, const scene_load *load)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        fluid_state state;
        double velocity[3];
        if (s->body[b].material == load->material &&
            body_fluid_state(s, b, (const double[3]){0.0, 0.0, 0.0}, &state, velocity) == FLOE_OK)
            return state.pressure;
    }
    return s->has_ambient ? s->ambient_pressure : s->reference_pressure;
}

double load_scheduled_pressure(const scene *s, const scene_load *load, const load_step *step, bool *active)
{
    const double fraction = load_fraction(load, step);
    *active = ramp_acts(load, step);
    const double first = initial_pressure(s, load), last = s->reference_pressure + load->target;
    return first + fraction * (last - first);
}

double scene_extent(const scene *s)
{
    const double two_pi = 6.283185307179586476925;
    if (s->mesh.geometry == MESH_AXISYMMETRIC) return two_pi;
    return s->mesh.dim == 2 ? s->thickness : 1.0;
}
