/* Two elastic bars that collide end to end: how their centres of mass move, and the force between them. */
#include "verify/bar_impact.h"
#include "verify/reference.h"

static const param_spec impact_params[] = {BAR_IMPACT_PARAMS};

static floe_status bar_impact_reference_prepare(context *ctx, const void *par, void *prepared)
{
    return bar_impact_solve(ctx, par, prepared);
}

enum {
    LEFT_POSITION,
    LEFT_VELOCITY,
    RIGHT_POSITION,
    RIGHT_VELOCITY,
    FORCE,
    LEFT_ENERGY,
    RIGHT_ENERGY,
    ENERGY,
    MOMENTUM,
    QUANTITIES
};

static const reference_quantity impact_quantities[QUANTITIES] = {
    [LEFT_POSITION] = {"left_position", "m", "centre of mass of the left bar", NULL, false},
    [LEFT_VELOCITY] = {"left_velocity", "m/s", "its velocity", "left_position", false},
    [RIGHT_POSITION] = {"right_position", "m", "centre of mass of the right bar", NULL, false},
    [RIGHT_VELOCITY] = {"right_velocity", "m/s", "its velocity", "right_position", false},
    [FORCE] = {"force", "N", "force between the bars, pressing positive", NULL, false},
    [LEFT_ENERGY] = {"left_energy", "J", "kinetic and strain energy of the left bar", NULL, false},
    [RIGHT_ENERGY] = {"right_energy", "J", "kinetic and strain energy of the right bar", NULL, false},
    [ENERGY] = {"energy", "J", "of both bars", NULL, true},
    [MOMENTUM] = {"momentum", "N s", "of both bars", NULL, true},
};

/* The place of the bar's centre of mass at the start. */
static double bar_centre(const impact_bar *bar, int which)
{
    return bar->face + (which == 0 ? -0.5 : 0.5) * bar->length;
}

static floe_status impact_series(context *ctx, const void *par, const void *prepared, size_t n, const double *t,
                                 double *value)
{
    (void)ctx;
    (void)par;
    const bar_impact *b = prepared;
    for (size_t i = 0; i < n; i++) {
        double all[QUANTITIES] = {0.0};
        for (int k = 0; k < 2; k++) {
            const double velocity = bar_impact_mean_velocity(b, k, t[i]);
            const double energy = bar_impact_energy(b, k, t[i]);
            all[LEFT_POSITION + 2 * k] = bar_centre(&b->bar[k], k) + bar_impact_mean_displacement(b, k, t[i]);
            all[LEFT_VELOCITY + 2 * k] = velocity;
            all[LEFT_ENERGY + k] = energy;
            all[ENERGY] += energy;
            all[MOMENTUM] += b->bar[k].mass * velocity;
        }
        all[FORCE] = -bar_impact_force(b, 0, 0.0, t[i]);
        for (size_t q = 0; q < QUANTITIES; q++) value[q * n + i] = t[i] <= b->horizon ? all[q] : (double)NAN;
    }
    return FLOE_OK;
}

static const reference_scalar impact_scalars[] = {
    {"contact", "s", "time at which the bars first meet"},
    {"release", "s", "time at which they first press no longer"},
    {"restitution", "1", "of the velocities of the centres of mass over the first contact"},
    {"left_after", "m/s", "velocity of the left bar's centre of mass after the first contact"},
    {"right_after", "m/s", "velocity of the right bar's centre of mass after the first contact"},
};

static double bar_impact_reference_scalar(const void *par, const void *prepared, size_t i)
{
    (void)par;
    const bar_impact *b = prepared;
    switch (i) {
    case 0: return b->contact;
    case 1: return b->release;
    case 2: return bar_impact_restitution(b);
    default: return bar_impact_mean_velocity(b, (int)i - 3, b->release);
    }
}

const reference_model reference_bar_impact = {
    .name = "bar_impact",
    .doc = "two elastic bars that collide end to end",
    .cite = "Saint-Venant, J. Math. Pures Appl. 12 (1867) 237; Goldsmith, Impact (1960), chapter 3; York (1997), "
            "section A.1",
    .validity = "waves along the axis alone (Poisson's ratio 0, or strain or stress along the axis only) and linear "
                "elasticity: error of the order of velocity/wave speed. Contact without friction or loss; free outer "
                "ends. Energies are for the sections given. Known until the waves have met the faces 400 times.",
    .param_size = sizeof(bar_impact_par),
    .params = impact_params,
    .n_params = COUNT_OF(impact_params),
    .quantities = impact_quantities,
    .n_quantities = QUANTITIES,
    .scalars = impact_scalars,
    .n_scalars = COUNT_OF(impact_scalars),
    .sample = &(const bar_impact_par)BAR_IMPACT_SAMPLE,
    .sample_end = 0.06,
    .prepared_size = sizeof(bar_impact),
    .prepare = bar_impact_reference_prepare,
    .series = impact_series,
    .scalar = bar_impact_reference_scalar,
};
