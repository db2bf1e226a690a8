/* The Riemann problem of two ideal, stiffened or Noble-Abel stiffened gases: shock tubes of one or two materials. */
#include "verify/riemann.h"
#include "verify/verify_internal.h"

typedef struct riemann_par {
    double left_density, left_velocity, left_pressure, left_gamma, left_p_inf, left_covolume, left_heat_capacity;
    double right_density, right_velocity, right_pressure, right_gamma, right_p_inf, right_covolume, right_heat_capacity;
    double position, axis;
} riemann_par;

static const param_spec riemann_params[] = {
    PAR_NONNEGATIVE(riemann_par, left_density, "kg/m3", NAN, "density on the left; 0: a vacuum"),
    PAR_ANY(riemann_par, left_velocity, "m/s", 0.0, "velocity along the axis on the left"),
    PAR_ANY(riemann_par, left_pressure, "Pa", NAN, "pressure on the left, over -left_p_inf"),
    PAR_BETWEEN(riemann_par, left_gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats on the left, over 1"),
    PAR_NONNEGATIVE(riemann_par, left_p_inf, "Pa", 0.0, "stiffness pressure of the gas on the left; 0: ideal"),
    PAR_NONNEGATIVE(riemann_par, left_covolume, "m3/kg", 0.0, "volume of the molecules on the left (nasg); 0: none"),
    PAR_NONNEGATIVE(riemann_par, left_heat_capacity, "J/kg/K", 0.0, "c_v on the left; 0: no temperature is given"),
    PAR_NONNEGATIVE(riemann_par, right_density, "kg/m3", NAN, "density on the right; 0: a vacuum"),
    PAR_ANY(riemann_par, right_velocity, "m/s", 0.0, "velocity along the axis on the right"),
    PAR_ANY(riemann_par, right_pressure, "Pa", NAN, "pressure on the right, over -right_p_inf"),
    PAR_BETWEEN(riemann_par, right_gamma, "1", 1.0, 100.0, 1.4, "ratio of specific heats on the right, over 1"),
    PAR_NONNEGATIVE(riemann_par, right_p_inf, "Pa", 0.0, "stiffness pressure of the gas on the right; 0: ideal"),
    PAR_NONNEGATIVE(riemann_par, right_covolume, "m3/kg", 0.0, "volume of the molecules on the right (nasg); 0: none"),
    PAR_NONNEGATIVE(riemann_par, right_heat_capacity, "J/kg/K", 0.0, "c_v on the right; 0: no temperature is given"),
    PAR_ANY(riemann_par, position, "m", 0.0, "where the two states meet at t = 0"),
    PAR_BETWEEN(riemann_par, axis, "1", 0.0, 2.0, 0.0, "the axis along which they meet: 0, 1 or 2"),
};

static floe_status riemann_prepare(context *ctx, const void *par, int dim, void *prepared)
{
    const riemann_par *p = par;
    TRY(check_axis(ctx, p->axis, dim));
    const riemann_side left = {p->left_density, p->left_velocity, p->left_pressure,
                               p->left_gamma,   p->left_p_inf,    p->left_covolume};
    const riemann_side right = {p->right_density, p->right_velocity, p->right_pressure,
                                p->right_gamma,   p->right_p_inf,    p->right_covolume};
    return riemann_solve(ctx, &left, &right, prepared);
}

/* Before and at t = 0 the two states as given. */
static riemann_state riemann_state_at(const riemann_par *p, const riemann_solution *solution, const double x[3],
                                      double t)
{
    const double distance = x[whole_number(p->axis)] - p->position;
    if (t > 0.0) return riemann_sample(solution, distance / t);
    return riemann_sample(solution, distance > 0.0 ? (double)INFINITY : -(double)INFINITY);
}

/* Of the equivalent gas without a covolume. */
static double open_density(const riemann_state *state, double covolume)
{
    return state->density / (1.0 - covolume * state->density);
}

static double energy_of(const riemann_state *state, const riemann_side *side)
{
    if (!state->empty)
        return gas_energy(open_density(state, side->covolume), state->pressure, side->gamma, side->p_inf);
    return side->p_inf > 0.0 ? (double)NAN : 0.0; /* the limit at the edge of a fan */
}

static double riemann_value(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                            double t)
{
    (void)dim;
    const riemann_par *p = par;
    const riemann_solution *solution = prepared;
    const riemann_state state = riemann_state_at(p, solution, x, t);
    const riemann_side *side = state.left_gas ? &solution->left : &solution->right;
    const double heat = state.left_gas ? p->left_heat_capacity : p->right_heat_capacity;
    if (is_velocity(quantity))
        return component_along(quantity, EXACT_VELOCITY_X, whole_number(p->axis), state.velocity);
    switch (quantity) {
    case EXACT_DENSITY: return state.density;
    case EXACT_PRESSURE: return state.pressure;
    case EXACT_INTERNAL_ENERGY: return energy_of(&state, side);
    case EXACT_TEMPERATURE:
        if (state.empty) return heat > 0.0 ? 0.0 : (double)NAN;
        return gas_temperature(open_density(&state, side->covolume), state.pressure, side->gamma, side->p_inf, heat);
    case EXACT_VOLUME_FRACTION: return state.left_gas && !state.empty ? 1.0 : 0.0;
    default: return NAN;
    }
}

static void add_break(exact_breaks *out, double position)
{
    if (!isfinite(position)) return;
    if (out->count > 0 && position <= out->position[out->count - 1]) return;
    out->position[out->count++] = position;
}

static void riemann_breaks(const void *par, const void *prepared, double t, exact_breaks *out)
{
    const riemann_par *p = par;
    const riemann_solution *s = prepared;
    const double time = fmax(t, 0.0);
    *out = (exact_breaks){.axis = whole_number(p->axis)};
    add_break(out, p->position + time * s->left_wave.head);
    add_break(out, p->position + time * s->left_wave.tail);
    add_break(out, p->position + time * s->contact);
    add_break(out, p->position + time * s->right_wave.tail);
    add_break(out, p->position + time * s->right_wave.head);
}

enum {
    STAR_PRESSURE,
    STAR_VELOCITY,
    STAR_DENSITY_LEFT,
    STAR_DENSITY_RIGHT,
    LEFT_HEAD,
    LEFT_TAIL,
    CONTACT,
    RIGHT_TAIL,
    RIGHT_HEAD
};

static const exact_scalar riemann_scalars[] = {
    [STAR_PRESSURE] = {"star_pressure", "Pa", "pressure between the two waves"},
    [STAR_VELOCITY] = {"star_velocity", "m/s", "velocity between the two waves"},
    [STAR_DENSITY_LEFT] = {"star_density_left", "kg/m3", "density left of the contact"},
    [STAR_DENSITY_RIGHT] = {"star_density_right", "kg/m3", "density right of the contact"},
    [LEFT_HEAD] = {"left_head", "m", "position of the left wave's outer edge"},
    [LEFT_TAIL] = {"left_tail", "m", "position of the left wave's inner edge (the same for a shock)"},
    [CONTACT] = {"contact", "m", "position of the contact"},
    [RIGHT_TAIL] = {"right_tail", "m", "position of the right wave's inner edge"},
    [RIGHT_HEAD] = {"right_head", "m", "position of the right wave's outer edge"},
};

static double riemann_scalar(const void *par, const void *prepared, size_t i, double t)
{
    const riemann_par *p = par;
    const riemann_solution *s = prepared;
    switch (i) {
    case STAR_PRESSURE: return s->pressure;
    case STAR_VELOCITY: return s->contact;
    case STAR_DENSITY_LEFT: return s->left_wave.density;
    case STAR_DENSITY_RIGHT: return s->right_wave.density;
    case LEFT_HEAD: return p->position + t * s->left_wave.head;
    case LEFT_TAIL: return p->position + t * s->left_wave.tail;
    case CONTACT: return p->position + t * s->contact;
    case RIGHT_TAIL: return p->position + t * s->right_wave.tail;
    case RIGHT_HEAD: return p->position + t * s->right_wave.head;
    default: return NAN;
    }
}

static const riemann_par sod = {.left_density = 1.0,
                                .left_pressure = 1.0,
                                .left_gamma = 1.4,
                                .right_density = 0.125,
                                .right_pressure = 0.1,
                                .right_gamma = 1.4,
                                .left_heat_capacity = 2.5,
                                .right_heat_capacity = 2.5,
                                .position = 0.5};

const exact_model exact_riemann = {
    .name = "riemann",
    .doc = "shock tube: two uniform states of ideal, stiffened or Noble-Abel stiffened gas that meet at a plane",
    .cite = "Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed. (2009), ch. 4",
    .validity =
        "inviscid, no heat conduction, no strength; until the first wave meets a boundary. Two materials do not "
        "mix. Where a vacuum opens, its velocity is that of the ray x/t. Temperature needs heat_capacity. "
        "Energies count from heat_bond = 0.",
    .equations = EXACT_EULER,
    .param_size = sizeof(riemann_par),
    .params = riemann_params,
    .n_params = COUNT_OF(riemann_params),
    .min_dim = 1,
    .max_dim = 3,
    .provides = EXACT_FLUID_STATE | EXACT_BIT(EXACT_VOLUME_FRACTION),
    .scalars = riemann_scalars,
    .n_scalars = COUNT_OF(riemann_scalars),
    .sample = {.par = &sod, .dim = 1, .lo = {0.35}, .hi = {0.47}, .t = 0.143},
    .prepared_size = sizeof(riemann_solution),
    .prepare = riemann_prepare,
    .value = riemann_value,
    .breaks = riemann_breaks,
    .scalar = riemann_scalar,
};
