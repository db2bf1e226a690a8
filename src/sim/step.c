/* Time steps: chosen, taken, and, where they go bad, taken again smaller (docs/structure.md, A step). */
#include "mpm/surface/boundary.h"
#include "sim/embedded.h"
#include "sim/light_solid_check.h"
#include "sim/quasi_static_gas.h"
#include "sim/statics.h"

#include <math.h>
#include <string.h>

enum { MAX_REJECTIONS = 10 };
static const double cut = 0.5; /* of the step, at each rejection */
static const double even_steps =
    16.0; /* before an output, with the implicit pressure: a sixteenth of a change at most */

/* Names the tightest of the limits so far. */
static void limit_step(double *dt, const char **reason, double candidate, const char *name)
{
    if (candidate < *dt) {
        *dt = candidate;
        *reason = name;
    }
}

static floe_status stable_step(sim *s, double *dt, const char **reason)
{
    *dt = INFINITY;
    *reason = "nothing";
    step_limit points = {INFINITY, *reason}, cells = points;
    if (s->mpm) TRY(mpm_time_step(s->mpm, &points));
    if (s->ice) TRY(ice_time_step(s->ice, &cells));
    if (s->most_substeps > 1) sim_take_substeps(s, cells.dt, &points);
    limit_step(dt, reason, points.dt, points.reason);
    limit_step(dt, reason, cells.dt, cells.reason);
    if (!s->embedded) return FLOE_OK;
    limit_step(dt, reason, light_solid_step(s, cells.dt / s->scene->time.cfl_ice), "gas on a solid lighter than it");
    limit_step(dt, reason, mpm_wall_heat_step(s->mpm), "heat through the surfaces of solids");
    return FLOE_OK;
}

/* The implicit pressure starts with the explicit step, unless the deck gives one: the velocity of a flow from rest is not known. */
static floe_status first_step(sim *s, double *dt, const char **reason)
{
    const double given = s->scene->time.first_step;
    if (!isnan(given)) {
        limit_step(dt, reason, given, "first step");
    } else if (s->ice && s->ice->implicit) {
        step_limit direct, implicit;
        double acoustic;
        TRY(ice_time_steps(s->ice, &direct, &implicit, &acoustic));
        limit_step(dt, reason, direct.dt, "first step");
    }
    return FLOE_OK;
}

/* FLOE_DIVERGED if the steps are so small that no run could take as many, for example if each step lets only half of the remaining gas escape. */
static floe_status check_step(const sim *s, double dt, const char *reason)
{
    static const double share = 1e-13; /* of the time so far */
    const char *unit = scene_time_unit(s->scene), *cause = s->cause[0] ? "; the last one was rejected because " : "";
    const bool lost = dt <= share * s->time;
    if (dt > 0.0 && isfinite(dt) && !lost) return FLOE_OK;
    return fail(s->ctx, FLOE_DIVERGED, "the time step has shrunk to %g%s at t = %.6g%s (limited by %s%s%s)", dt, unit,
                s->time, unit, reason, cause, s->cause);
}

/* The last steps before an output time divide the remaining time, so that none of them is very small. With the implicit pressure these are more steps: the
 * force on a body is by several per cent that of a longer or shorter step, where one is not as long as those before it (theory 7.8). */
static void divide_rest(const sim *s, double left, double *dt, const char **reason)
{
    const bool divides = isnan(s->scene->time.fixed_step) && !sim_solves(s);
    const double most = !divides ? 1.0 : s->ice && s->ice->implicit ? even_steps : 2.0;
    const double steps = ceil(left / *dt - 1e-9);
    if (*dt >= left)
        limit_step(dt, reason, left, "output time");
    else if (steps <= most)
        limit_step(dt, reason, left / steps, "output time");
}

static floe_status choose_step(sim *s, double until, double *dt, const char **reason)
{
    const scene_time *t = &s->scene->time;
    if (sim_solves(s)) {
        statics_step(s, until - s->time, dt, reason);
    } else if (!isnan(t->fixed_step)) {
        if (s->most_substeps > 1) TRY(stable_step(s, dt, reason)); /* it says how many sub-steps this takes */
        *dt = t->fixed_step;
        *reason = "fixed step";
    } else {
        TRY(stable_step(s, dt, reason));
        if (s->steps == 0) TRY(first_step(s, dt, reason));
        if (s->steps > 0) limit_step(dt, reason, t->growth * s->dt, "growth");
        if (!isnan(t->max_step)) limit_step(dt, reason, t->max_step, "largest step");
    }
    TRY(check_step(s, *dt, *reason));
    divide_rest(s, until - s->time, dt, reason);
    return FLOE_OK;
}

static void set_step(sim *s, double dt)
{
    if (s->mpm) {
        s->mpm->dt = dt;
        s->mpm->time = s->time;
        s->mpm->step = s->steps;
        s->mpm->n_substeps = s->n_substeps;
        s->mpm->substep = 0;
    }
    if (s->ice) {
        s->ice->dt = dt;
        s->ice->time = s->time;
        s->ice->step = s->steps;
        ice_set_gravity(s->ice, s->time + 0.5 * dt);
    }
}

static void give_back(sim *s)
{
    if (s->mpm) mpm_rollback_step(s->mpm);
    if (s->ice) ice_rollback_step(s->ice);
    ledger_discard(&s->ledger);
}

/* Takes the step, cutting it while it is rejected; state is written to next arrays, or kept, so that rejection is forgetting. */
static floe_status take_step(sim *s, double *dt, const char **reason)
{
    const char *unit = scene_time_unit(s->scene);
    s->cause[0] = '\0';
    for (int tries = 0; tries <= MAX_REJECTIONS; ++tries) {
        set_step(s, *dt);
        const floe_status status = sim_run_stages(s);
        if (status == FLOE_OK) return status;
        give_back(s);
        if (status != FLOE_RETRY) return status;
        s->rejected++;
        (void)snprintf(s->cause, sizeof s->cause, "%s", context_message(s->ctx));
        context_log(s->ctx, LOG_DETAIL, "step %ld at t = %.6g%s rejected with dt = %.3g%s: %s", s->steps + 1, s->time,
                    unit, *dt, unit, s->cause);
        context_clear(s->ctx);
        *dt *= cut;
        *reason = "rejected step";
    }
    return fail(s->ctx, FLOE_DIVERGED,
                "the step at t = %.6g%s was rejected %d times, down to dt = %.3g%s; the last cause: %s", s->time, unit,
                MAX_REJECTIONS + 1, *dt, unit, s->cause);
}

static floe_status commit_step(sim *s, double dt)
{
    for (int b = 0; b < s->mesh.n_blocks; ++b) fields_commit(s->domain->fields[b]);
    if (s->mpm) {
        s->point_updates += (double)s->mpm->n_substeps * (double)mpm_count(s->mpm);
        TRY(mpm_commit(s->mpm));
    }
    if (s->ice) s->cell_updates += (double)mesh_cells(&s->mesh);
    if (s->quasi_static_gas) TRY(quasi_static_gas_commit(s));
    ledger_commit(&s->ledger);
    s->time += dt;
    s->steps++;
    return FLOE_OK;
}

floe_status sim_step(sim *s, double until)
{
    double dt;
    const char *reason;
    if (s->has_light) TRY(light_solid_check(s));
    TRY(sim_choose_pressure(s));
    if (s->embedded) embedded_use_wall_response(s->embedded, wall_pressure_is_implicit(s));
    TRY(choose_step(s, until, &dt, &reason));
    const bool last = dt == until - s->time;
    const double full = dt;
    TRY(take_step(s, &dt, &reason));
    TRY(commit_step(s, dt));
    if (last && dt == full) s->time = until; /* no round-off in an output time */
    if (s->mpm) s->mpm->time = s->time;
    /* A step shortened to meet an output time must not hold the next one back. */
    if (strcmp(reason, "output time") != 0 || dt > s->dt) s->dt = dt;
    s->dt_reason = reason;
    if (sim_is_static(s)) statics_commit(s);
    return FLOE_OK;
}

floe_status sim_stability_limit(sim *s, double *dt, const char **reason)
{
    const scene_time *t = &s->scene->time;
    *dt = INFINITY;
    *reason = "nothing";
    if (sim_solves(s)) return FLOE_OK;
    TRY(stable_step(s, dt, reason));
    *dt /= fmin(1.0, fmax(s->mpm ? t->cfl_mpm : 0.0, s->ice ? t->cfl_ice : 0.0));
    return FLOE_OK;
}

floe_status sim_predict(sim *s, double *dt, double *steps, const char **reason)
{
    const scene_time *t = &s->scene->time;
    TRY(choose_step(s, t->end, dt, reason));
    double full = *dt;
    const char *unused;
    if (isnan(t->fixed_step) && !sim_solves(s)) TRY(stable_step(s, &full, &unused));
    if (!isnan(t->max_step)) full = fmin(full, t->max_step);
    *steps = ceil(sim_steps_through(t->end - s->time, *dt, fmin(full, t->end - s->time), t->growth) - 1e-9);
    return FLOE_OK;
}
