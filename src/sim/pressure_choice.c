/* Explicit or implicit pressure, by the predicted cost of the rest of the run (method.pressure auto): the number of
 * steps, with their growth from the present one, times the cost of a step. The prediction uses the state and counts of
 * iterations, never clocks, so that a run takes the same steps every time. */
#include "sim/sim.h"

#include <math.h>
#include <string.h>

enum { LOOK_EVERY = 64 }; /* steps */

/* Cost of an implicit step, in explicit ones: what it needs anyway, and for every iteration of conjugate gradients.
 * Measured on one core, 32 x 32 to 128 x 128 cells: 0.15 an iteration of a viscous gas, whose steps cost more, to 0.4
 * of one without viscosity. */
static const double fixed_cost = 1.3, iteration_cost = 0.3;
/* The other kind must be this much cheaper for a run to change to it. */
static const double worth_it = 0.8;

double sim_steps_through(double left, double first, double dt, double growth)
{
    if (!(dt > first)) return left / dt;
    if (!(growth > 1.0)) return left / first;
    const double ramp = (dt - first) / (growth - 1.0);
    if (ramp >= left) return log1p(left * (growth - 1.0) / first) / log(growth);
    return log(dt / first) / log(growth) + (left - ramp) / dt;
}

/* Iterations of a solve: those of this run so far, else a guess that grows with the acoustic CFL. */
static double iterations_of(const sim *s, double acoustic_cfl)
{
    const long long solves = s->ledger.count[COUNT_PRESSURE_SOLVES];
    if (solves > 0) return (double)s->ledger.count[COUNT_CG_ITERATIONS] / (double)solves;
    return 3.0 + 2.0 * log10(fmax(1.0, acoustic_cfl));
}

/* What bounds steps of either kind. */
static floe_status common_bound(sim *s, double *bound)
{
    const scene_time *t = &s->scene->time;
    *bound = fmin(s->scene->output.interval, t->end - s->time);
    if (!isnan(t->max_step)) *bound = fmin(*bound, t->max_step);
    if (!s->mpm) return FLOE_OK;
    step_limit points;
    TRY(mpm_time_step(s->mpm, &points));
    *bound = fmin(*bound, points.dt);
    return FLOE_OK;
}

static void clear_steps(sim *s)
{
    for (int b = 0; b < s->mesh.n_blocks; ++b)
        memset(field_get(s->domain->fields[b], C_PRESSURE_STEP, 0, 0), 0, s->mesh.block[b].size * sizeof(double));
}

static void choose_pressure_solver(sim *s, bool implicit, const char *reason)
{
    const bool first = s->steps == 0, changed = implicit != s->ice->implicit;
    if (!first && !changed) return;
    if (changed && implicit) clear_steps(s);
    s->ice->implicit = implicit;
    (void)snprintf(s->pressure_reason, sizeof s->pressure_reason, "%s%s: %s", first ? "" : "from now on ",
                   implicit ? "implicit" : "explicit", reason);
    context_log(s->ctx, LOG_INFO, "t = %.6g%s, pressure %s", s->time, scene_time_unit(s->scene), s->pressure_reason);
}

floe_status sim_choose_pressure(sim *s)
{
    if (!s->ice || s->quasi_static_gas || s->scene->method.pressure != PRESSURE_AUTO || s->steps % LOOK_EVERY != 0)
        return FLOE_OK;
    step_limit direct, implicit;
    double acoustic, bound;
    char reason[160];
    const scene_time *t = &s->scene->time;
    TRY(ice_time_steps(s->ice, &direct, &implicit, &acoustic));
    if (!isnan(t->fixed_step)) {
        const double largest = direct.dt / t->cfl_ice;
        (void)snprintf(reason, sizeof reason, "the fixed step is %.3g of the explicit limit", t->fixed_step / largest);
        choose_pressure_solver(s, t->fixed_step > largest, reason);
        return FLOE_OK;
    }
    TRY(common_bound(s, &bound));
    const double left = t->end - s->time, now = s->steps == 0 ? direct.dt : s->dt;
    const double dt = fmin(implicit.dt, bound), dt_direct = fmin(direct.dt, bound);
    const double first = s->steps == 0 && !isnan(t->first_step) ? t->first_step : now;
    const double cost = fixed_cost + iteration_cost * iterations_of(s, acoustic * dt);
    const double steps = sim_steps_through(left, fmin(first, dt), dt, t->growth), steps_direct = left / dt_direct;
    const double other = s->steps == 0 ? 1.0 : worth_it;
    const bool takes =
        steps * cost * (s->ice->implicit ? other : 1.0) < steps_direct * (s->ice->implicit ? 1.0 : other);
    (void)snprintf(reason, sizeof reason,
                   "about %.3g implicit steps, at the cost of %.3g explicit ones each, against %.3g explicit steps",
                   steps, cost, steps_direct);
    choose_pressure_solver(s, takes, reason);
    return FLOE_OK;
}
