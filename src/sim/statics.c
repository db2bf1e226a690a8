#include "sim/statics.h"

#include "sim/quasi_static_gas.h"

#include <math.h>

static const double growth = 2.0;     /* of increments, after one was cut */
static const double round_off = 1e-9; /* what many equal increments may miss the end by */

/* Why a state of rest cannot be solved for, or NULL; `guess`: nor is likely to be. */
static const char *obstacle_to(const sim *s, time_solver solver, bool guess)
{
    const char *obstacle = mpm_implicit_obstacle(s->mpm, solver);
    return obstacle || !s->ice ? obstacle : quasi_static_gas_obstacle(s, guess);
}

static floe_status check_bulk(const sim *s)
{
    int body = 0;
    const double ratio = mpm_implicit_bulk_ratio(s->mpm, &body), most = mpm_implicit_most_bulk_ratio();
    if (ratio <= most) return FLOE_OK;
    return fail_key(
        s->ctx, KEY("time", "solver"),
        "static: the bulk modulus of body '%s' is %.3g times its shear modulus: round-off of volumes would be "
        "a stress. Take %g times at most",
        s->scene->body[body].name, ratio, most);
}

/* Why `auto` would not solve for the state of rest, or NULL. */
static const char *obstacle_to_rest(const sim *s)
{
    int body = 0;
    if (!s->scene->rest.enabled) return "the deck asks for no state of rest";
    if (mpm_implicit_bulk_ratio(s->mpm, &body) > mpm_implicit_most_bulk_ratio())
        return "of a solid that hardly changes its volume round-off would be a stress";
    return obstacle_to(s, SOLVER_STATIC, true);
}

static const char *solver_name(time_solver solver)
{
    return solver == SOLVER_STATIC ? "static" : solver == SOLVER_IMPLICIT ? "implicit" : "dynamic";
}

floe_status sim_choose_solver(sim *s)
{
    time_solver solver = s->scene->time.solver;
    const char *why = NULL;
    if (!s->mpm) return FLOE_OK;
    if (solver == SOLVER_AUTO) {
        const char *obstacle = obstacle_to_rest(s);
        solver = obstacle ? SOLVER_DYNAMIC : SOLVER_STATIC;
        why = obstacle ? obstacle : "the deck asks for the state of rest, which can be solved for";
    }
    (void)snprintf(s->solver_reason, sizeof s->solver_reason, "%s%s%s", solver_name(solver), why ? ": " : "",
                   why ? why : "");
    const scene_time *t = &s->scene->time;
    if (solver == SOLVER_IMPLICIT && t->increments == 1 && isnan(t->fixed_step) && isnan(t->max_step))
        return fail_key(s->ctx, KEY("time", "solver"),
                        "implicit takes no step of its own accord: give increments, fixed_step or max_step");
    if (solver == SOLVER_DYNAMIC) return FLOE_OK;
    const char *obstacle = obstacle_to(s, solver, false);
    if (obstacle) return fail_key(s->ctx, KEY("time", "solver"), "%s: %s; use dynamic", solver_name(solver), obstacle);
    if (solver == SOLVER_STATIC) TRY(check_bulk(s));
    TRY(mpm_solve_steps(s->mpm, solver));
    return s->ice ? quasi_static_gas_create(&s->quasi_static_gas, s) : FLOE_OK;
}

void statics_step(const sim *s, double left, double *dt, const char **reason)
{
    const scene_time *t = &s->scene->time;
    const bool is_static = s->mpm->solver == SOLVER_STATIC;
    *dt = is_static || (isnan(t->fixed_step) && isnan(t->max_step)) ? t->end / (double)t->increments
          : isnan(t->fixed_step)                                    ? t->max_step
                                                                    : t->fixed_step;
    *reason = is_static ? "load increment" : "the deck's step";
    if (s->steps > 0 && growth * s->dt < *dt) {
        *dt = growth * s->dt;
        *reason = "growth";
    }
    if (*dt > (1.0 - round_off) * left) *dt = left;
}

void statics_commit(sim *s)
{
    if (s->scene->rest.enabled && !(s->time < s->scene->time.end)) {
        s->rest_since = s->time;
        s->at_rest = true;
    }
}
