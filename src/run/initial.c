#include "run/initial.h"

#include <math.h>

/* Sources act on solids on points or on fluids on the cells, and the scene must have such. */
static floe_status check_sources(const scene *s, const exact *solution)
{
    const bool solid = exact_is_solid(solution);
    if (!s->verify.sources || s->coupling != (solid ? COUPLING_ICE : COUPLING_MPM)) return FLOE_OK;
    return fail_key(s->ctx, KEY("verify", "sources"),
                    "those of the exact solution '%s' act on %s, and coupling %s has none; take %s",
                    solution->model->name, solid ? "solids on points" : "fluids on the cells",
                    coupling_name(s->coupling), solid ? "mpm" : "ice");
}

floe_status initial_exact(const scene *s, exact *out)
{
    *out = (exact){0};
    if (s->verify.exact[0] == '\0') return FLOE_OK;
    const exact_model *model = exact_find(s->verify.exact);
    if (!model) return fail_key(s->ctx, KEY("verify", "exact"), "there is no exact solution '%s'", s->verify.exact);
    if (s->verify.sources && !model->body_force && !model->heat_source)
        return fail_key(s->ctx, KEY("verify", "sources"),
                        "the exact solution '%s' needs neither force nor heat; leave it out", model->name);
    TRY(exact_create(s->ctx, model, s->verify.exact_par, s->mesh.dim, out));
    const floe_status status = check_sources(s, out);
    if (status != FLOE_OK) exact_destroy(s->ctx, out);
    return status;
}

/* The exact solution's name for what a body asks, EXACT_QUANTITY_COUNT if it has none. */
static exact_quantity quantity_of(initial_quantity quantity, int component)
{
    switch (quantity) {
    case INITIAL_DENSITY: return EXACT_DENSITY;
    case INITIAL_PRESSURE: return EXACT_PRESSURE;
    case INITIAL_VELOCITY: return (exact_quantity)(EXACT_VELOCITY_X + component);
    case INITIAL_STRESS: return (exact_quantity)(EXACT_STRESS_XX + component);
    }
    return EXACT_QUANTITY_COUNT;
}

static double initial_value(void *user, initial_quantity quantity, int component, const double x[3])
{
    const exact_quantity which = quantity_of(quantity, component);
    return exact_provides(user, which) ? exact_value(user, which, x, 0.0) : (double)NAN;
}

static double exact_source(void *user, const double x[3], double t, double force[3])
{
    exact_body_force(user, x, t, force);
    return exact_heat_source(user, x, t);
}

void initial_attach(scene *s, exact *solution)
{
    s->initial = solution->model ? initial_value : NULL;
    s->initial_user = solution;
    source_function *source = solution->model && s->verify.sources ? exact_source : NULL;
    const bool solid = source && exact_is_solid(solution);
    s->driving = solid ? NULL : source;
    s->driving_solids = solid ? source : NULL;
}

void initial_detach(scene *s)
{
    s->initial = NULL;
    s->initial_user = NULL;
    s->driving = NULL;
    s->driving_solids = NULL;
}
