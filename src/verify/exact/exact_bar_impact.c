/* Two elastic bars that collide end to end: velocity, displacement and stress along them. */
#include "verify/bar_impact.h"

typedef struct impact_par {
    bar_impact_par bars; /* first: the table's entries count on it */
    double axis;
} impact_par;

static const param_spec impact_params[] = {
    BAR_IMPACT_PARAMS,
    PAR_BETWEEN(impact_par, axis, "1", 0.0, 2.0, 0.0, "the axis of the bars: 0, 1 or 2"),
};

static floe_status bar_impact_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const impact_par *p = par;
    TRY(check_axis(ctx, p->axis, dim));
    return bar_impact_solve(ctx, &p->bars, prepared);
}

static double area_of(const impact_par *p, int which)
{
    return which == 0 ? p->bars.left_area : p->bars.right_area;
}

static double density_of(const impact_par *p, int which)
{
    return which == 0 ? p->bars.left_density : p->bars.right_density;
}

static double impact_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                           double t)
{
    (void)dim;
    const impact_par *p = par;
    const bar_impact *b = prepared;
    const int axis = whole_number(p->axis);
    const int which = x[axis] <= b->bar[0].face ? 0 : 1;
    const double depth = which == 0 ? b->bar[0].face - x[axis] : x[axis] - b->bar[1].face;
    if (!(depth >= 0.0 && depth <= b->bar[which].length) || t < 0.0 || t > b->horizon) return NAN;
    if (is_velocity(quantity)) {
        return component_along(quantity, EXACT_VELOCITY_X, axis, bar_impact_velocity(b, which, depth, t));
    }
    if (is_displacement(quantity)) {
        return component_along(quantity, EXACT_DISPLACEMENT_X, axis, bar_impact_displacement(b, which, depth, t));
    }
    if (quantity >= EXACT_STRESS_XX && quantity <= EXACT_STRESS_ZZ) {
        const double stress = bar_impact_force(b, which, depth, t) / area_of(p, which);
        return (int)quantity - EXACT_STRESS_XX == axis ? stress : (double)NAN;
    }
    return quantity == EXACT_DENSITY ? density_of(p, which) : (double)NAN;
}

/* Fronts are inserted in order; where there are more than fit, those found last are left out. */
static void add_front(exact_breaks *out, double at)
{
    if (out->count == EXACT_MAX_BREAKS) return;
    int i = out->count++;
    for (; i > 0 && out->position[i - 1] > at; i--) out->position[i] = out->position[i - 1];
    out->position[i] = at;
}

static void impact_breaks(const void *par, const void *prepared, double t, exact_breaks *out)
{
    const impact_par *p = par;
    const bar_impact *b = prepared;
    *out = (exact_breaks){.axis = whole_number(p->axis)};
    for (int which = 0; which < 2; which++) {
        const impact_bar *bar = &b->bar[which];
        const double direction = which == 0 ? -1.0 : 1.0;
        add_front(out, bar->face);
        for (int i = b->n - 1; i >= 0; i--) {
            const double run = bar->speed * (t - b->step[i]);
            if (run > 2.0 * bar->length) break;
            if (run >= 0.0) add_front(out, bar->face + direction * (run < bar->length ? run : 2.0 * bar->length - run));
        }
    }
}

enum { CONTACT, RELEASE, DURATION, RESTITUTION, LARGEST_FORCE };

static const exact_scalar impact_scalars[] = {
    [CONTACT] = {"contact", "s", "time at which the bars first meet"},
    [RELEASE] = {"release", "s", "time at which they first press no longer"},
    [DURATION] = {"duration", "s", "of the first contact"},
    [RESTITUTION] = {"restitution", "1", "of the velocities of the centres of mass over the first contact"},
    [LARGEST_FORCE] = {"largest_force", "N", "largest force between the bars"},
};

static double bar_impact_scalar(const void *par, const void *prepared, size_t i, double t)
{
    (void)par;
    (void)t;
    const bar_impact *b = prepared;
    switch (i) {
    case CONTACT: return b->contact;
    case RELEASE: return b->release;
    case DURATION: return b->release - b->contact;
    case RESTITUTION: return bar_impact_restitution(b);
    default: return b->largest_force;
    }
}

const exact_model exact_bar_impact = {
    .name = "bar_impact",
    .doc = "two elastic bars that collide end to end",
    .cite = "Saint-Venant, J. Math. Pures Appl. 12 (1867) 237; Goldsmith, Impact (1960), chapter 3; York (1997), "
            "section A.1",
    .validity =
        "waves along the axis alone (Poisson's ratio 0, or strain or stress along the axis only), linear elasticity, x "
        "the place at the start: error of the order of velocity/wave speed. Contact without friction or loss; free "
        "outer ends. Known until the waves have met the faces 400 times; equal bars have 4 steps.",
    .equations = EXACT_SOLID,
    .param_size = sizeof(impact_par),
    .params = impact_params,
    .n_params = COUNT_OF(impact_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_DISPLACEMENTS | EXACT_VELOCITIES | EXACT_BIT(EXACT_STRESS_XX) | EXACT_BIT(EXACT_STRESS_YY) |
                EXACT_BIT(EXACT_STRESS_ZZ) | EXACT_BIT(EXACT_DENSITY),
    .scalars = impact_scalars,
    .n_scalars = COUNT_OF(impact_scalars),
    .sample = {.par = &(const impact_par){.bars = BAR_IMPACT_SAMPLE, .axis = 0.0},
               .dim = 1,
               .lo = {1.9},
               .hi = {2.2},
               .t = 0.004},
    .prepared_size = sizeof(bar_impact),
    .prepare = bar_impact_prepare,
    .value = impact_value,
    .breaks = impact_breaks,
    .scalar = bar_impact_scalar,
};
