/* Sub-steps of the points (time.substeps): a step of the cells in which the points, whose sound is faster, take several
 * of their own, under a traction of the gas that stays as it is (mpm/point_substeps.c). How many follows from the state and the
 * step, so that a resumed run takes the same. */
#include "sim/light_solid_check.h"

#include <math.h>

static const double round_off = 1e-9; /* what a step may miss a whole number of stable ones by */
/* Density of the gas over that of the solid up to which there are substeps. A force that lags by a step amplifies vibrations of the solid, beside
 * dense gas faster than points and nodes damp them: a disc with the default transfer is stable at 0.2, drifts by 6e-5 of its energy at 0.3 and has
 * four times its energy at 0.5 (docs/results/substeps.md). */
static const double densest_gas = 0.2;

/* Why the points of this scene take the cells' step whole, or NULL. */
static const char *substep_obstacle(const sim *s)
{
    if (!s->mpm || !s->ice) return "points and cells do not share the scene";
    if (sim_solves(s)) return "the points' steps are solved for";
    if (!s->embedded)
        return "the interface is smeared, where exchange takes each step of the points (method.interface: sharp)";
    if (s->scene->method.interface != INTERFACE_SHARP)
        return "a membrane around gas is as light as the gas that it moves";
    if (walls_are_stiff(s->mpm)) return "an implicit pressure has the solids' stiffness in its system";
    if (s->ice->implicit) return "an implicit pressure answers the points' own step";
    if (s->mpm->contact) return "solids in contact are not known to keep together in sub-steps";
    if (has_dense_fluid(s, densest_gas)) return "the gas is too dense for the solid, whose vibrations it would feed";
    return NULL;
}

/* The largest step (s) in which no marker goes further than a share of a cell. */
static double marker_step(const sim *s)
{
    size_t n, stride;
    const double *marker = mpm_surface_markers(s->mpm, &n, &stride);
    double rate = 0.0;
    for (size_t k = 0; k < n; ++k) {
        double of_marker = 0.0;
        for (int a = 0; a < s->mesh.dim; ++a) of_marker += fabs(marker[k * stride + 3 + (size_t)a]) / s->mesh.h[a];
        rate = fmax(rate, of_marker);
    }
    return rate > 0.0 ? s->scene->time.cfl_mpm / rate : (double)INFINITY;
}

void sim_take_substeps(sim *s, double cells, step_limit *points)
{
    const scene_time *t = &s->scene->time;
    const double step = !isnan(t->fixed_step) ? t->fixed_step : isnan(t->max_step) ? cells : fmin(cells, t->max_step);
    const double parts = ceil((1.0 - round_off) * step / points->dt);
    s->n_substeps = t->substeps > 0 || parts >= s->most_substeps ? s->most_substeps : parts > 1.0 ? (int)parts : 1;
    if (s->n_substeps > 1 && has_dense_fluid(s, densest_gas)) s->n_substeps = 1; /* gas may have become so */
    points->dt *= s->n_substeps;
    const double marked = s->n_substeps > 1 ? marker_step(s) : (double)INFINITY;
    if (marked < points->dt) *points = (step_limit){marked, "way of the surfaces"};
}

floe_status sim_stiffen_walls(sim *s)
{
    if (!s->embedded || !s->ice->implicit || sim_solves(s)) return FLOE_OK;
    s->stiffness_obstacle = mpm_stiff_obstacle(s->mpm);
    return s->stiffness_obstacle ? FLOE_OK : mpm_stiffen_walls(s->mpm);
}

floe_status sim_settle_walls(sim *s)
{
    if (!s->mpm || !walls_are_stiff(s->mpm)) return FLOE_OK;
    return mpm_settle_walls(s->mpm, &s->stiffness_obstacle);
}

static floe_status choose_substeps(sim *s)
{
    step_limit points, cells;
    TRY(mpm_time_step(s->mpm, &points));
    TRY(ice_time_step(s->ice, &cells));
    s->most_substeps = SCENE_MAX_SUBSTEPS;
    (void)snprintf(
        s->substeps_reason, sizeof s->substeps_reason,
        "auto: as many as the step asks for, %d at most; at the start the cells' stable step is %.3g of the points'",
        s->most_substeps, cells.dt / points.dt);
    return FLOE_OK;
}

/* Whether solids that deform beside an implicit pressure have the step of their own sound. */
static bool bound_by_sound(const sim *s)
{
    return s->stiffness_obstacle && s->mpm->n_deforming > 0;
}

floe_status sim_choose_substeps(sim *s)
{
    const long asked = s->scene->time.substeps;
    const char *why_not = substep_obstacle(s);
    if (asked == 1 || asked == SCENE_SUBSTEPS_OPEN) return FLOE_OK;
    if (asked == 0 && !why_not) return choose_substeps(s);
    if (asked > 1 && why_not)
        return fail_key(s->ctx, KEY("time", "substeps"), "%ld: %s; leave it out, or use auto", asked, why_not);
    s->most_substeps = asked == 0 ? 1 : (int)asked;
    if (asked == 0)
        (void)snprintf(s->substeps_reason, sizeof s->substeps_reason, "1: %s%s%s", why_not,
                       bound_by_sound(s) ? ", which sound bounds: " : "",
                       bound_by_sound(s) ? s->stiffness_obstacle : "");
    else
        (void)snprintf(s->substeps_reason, sizeof s->substeps_reason, "%ld", asked);
    return FLOE_OK;
}
