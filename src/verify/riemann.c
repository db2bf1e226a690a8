#include "verify/riemann.h"

#include "verify/verify_internal.h"

/* A side seen outwards: `sign` is -1 on the left and +1 on the right, so that one text serves both. The equivalent
 * ideal gas has the specific volume v - b and the pressure p + p_inf. */
typedef struct outward {
    double density; /* kg/m3, 1/(v - b) */
    double velocity, gamma, sign;
    double stiff; /* Pa, p + p_inf */
    double p_inf, covolume;
    double sound; /* m/s, of the equivalent gas */
} outward;

/* v/(v - b) where the equivalent gas has that density: places of waves are stretched by it. */
static double covolume_stretch(const outward *side, double density)
{
    return 1.0 + side->covolume * density;
}

static bool is_vacuum(const riemann_side *side)
{
    return !(side->density > 0.0);
}

static outward look_outward(const riemann_side *side, double sign)
{
    const double stiff = side->pressure + side->p_inf, density = side->density / (1.0 - side->covolume * side->density);
    return (outward){.density = density,
                     .velocity = side->velocity,
                     .gamma = side->gamma,
                     .sign = sign,
                     .stiff = stiff,
                     .p_inf = side->p_inf,
                     .covolume = side->covolume,
                     .sound = sqrt(side->gamma * stiff / density)};
}

/* Change of velocity across the wave that brings the side to pressure p (Toro eqs 4.6 and 4.7). Written with the
 * logarithm of the pressure ratio, so that weak waves and near vacua keep their digits. */
static double velocity_change(const outward *side, double p)
{
    const double stiff = p + side->p_inf;
    const double g = side->gamma;
    if (stiff > side->stiff) {
        const double a = 2.0 / ((g + 1.0) * side->density);
        const double b = (g - 1.0) / (g + 1.0) * side->stiff;
        return (stiff - side->stiff) * sqrt(a / (stiff + b));
    }
    const double ratio = stiff / side->stiff;
    if (!(ratio > 0.0)) return -2.0 * side->sound / (g - 1.0);
    const double log_ratio = ratio > 0.5 ? log1p((stiff - side->stiff) / side->stiff) : log(ratio);
    return 2.0 * side->sound / (g - 1.0) * expm1(0.5 * (g - 1.0) / g * log_ratio);
}

typedef struct star_problem {
    outward left, right;
    double floor; /* Pa: the lowest pressure that both gases can reach */
} star_problem;

/* Toro eq. 4.5, in the pressure above the floor; increasing. */
static double star_residual(double above_floor, void *user)
{
    const star_problem *problem = user;
    const double p = problem->floor + above_floor;
    return velocity_change(&problem->left, p) + velocity_change(&problem->right, p) + problem->right.velocity -
           problem->left.velocity;
}

/* The wave that takes `side` to pressure p (Toro sections 4.2.1 to 4.2.4). */
static riemann_wave make_wave(const outward *side, double p)
{
    const double g = side->gamma;
    const double ratio = fmax((p + side->p_inf) / side->stiff, 0.0);
    riemann_wave wave = {.shock = ratio > 1.0};
    wave.velocity = side->velocity + side->sign * velocity_change(side, p);
    const double outer = side->sign * side->sound * covolume_stretch(side, side->density);
    double density;
    if (wave.shock) {
        const double slope = (g - 1.0) / (g + 1.0);
        density = side->density * (ratio + slope) / (slope * ratio + 1.0);
        wave.head = side->velocity + outer * sqrt(0.5 * (g + 1.0) / g * ratio + 0.5 * (g - 1.0) / g);
        wave.tail = wave.head;
    } else {
        density = side->density * pow(ratio, 1.0 / g);
        wave.head = side->velocity + outer;
        wave.tail = wave.velocity +
                    side->sign * side->sound * pow(ratio, 0.5 * (g - 1.0) / g) * covolume_stretch(side, density);
    }
    wave.density = density / covolume_stretch(side, density);
    return wave;
}

static floe_status check_side(context *ctx, const char *name, const riemann_side *side)
{
    char key[32];
    (void)snprintf(key, sizeof key, "%s_gamma", name);
    if (!(side->gamma > 1.0)) return fail_key(ctx, KEY(key), "%g: must be over 1", side->gamma);
    if (is_vacuum(side)) return FLOE_OK;
    (void)snprintf(key, sizeof key, "%s_density", name);
    if (!(side->covolume * side->density < 1.0))
        return fail_key(ctx, KEY(key), "%g kg/m3: must be under 1/covolume = %g kg/m3", side->density,
                        1.0 / side->covolume);
    (void)snprintf(key, sizeof key, "%s_pressure", name);
    if (side->pressure + side->p_inf > 0.0) return FLOE_OK;
    return fail_key(ctx, KEY(key), "%g Pa: must be over -p_inf = %g Pa", side->pressure, -side->p_inf);
}

/* Expansion into a vacuum that is there from the start (Toro section 4.6.1). */
static void solve_beside_vacuum(riemann_solution *out)
{
    const bool left_empty = is_vacuum(&out->left);
    const outward gas = left_empty ? look_outward(&out->right, 1.0) : look_outward(&out->left, -1.0);
    const riemann_wave wave = make_wave(&gas, -gas.p_inf);
    const riemann_wave front = {.velocity = wave.velocity, .head = wave.tail, .tail = wave.tail};
    out->vacuum = true;
    out->pressure = -gas.p_inf;
    out->contact = wave.velocity;
    out->left_wave = left_empty ? front : wave;
    out->right_wave = left_empty ? wave : front;
}

static floe_status solve_star(context *ctx, star_problem *problem, riemann_solution *out)
{
    double high = 2.0 * (fmax(out->left.pressure, out->right.pressure) - problem->floor);
    for (int i = 0; i < 1000 && star_residual(high, problem) < 0.0; i++) high *= 2.0;
    const double above_floor = find_root(star_residual, problem, 0.0, high);
    if (!isfinite(above_floor)) return fail(ctx, FLOE_BAD_INPUT, "the Riemann problem has no star pressure");
    out->pressure = problem->floor + above_floor;
    return FLOE_OK;
}

floe_status riemann_solve(context *ctx, const riemann_side *left, const riemann_side *right, riemann_solution *out)
{
    *out = (riemann_solution){.left = *left, .right = *right};
    TRY(check_side(ctx, "left", left));
    TRY(check_side(ctx, "right", right));
    if (is_vacuum(left) && is_vacuum(right))
        return fail_key(ctx, KEY("left_density"), "0, as right_density: both sides are a vacuum");
    if (is_vacuum(left) || is_vacuum(right)) {
        solve_beside_vacuum(out);
        return FLOE_OK;
    }

    star_problem problem = {.left = look_outward(left, -1.0), .right = look_outward(right, 1.0)};
    problem.floor = -fmin(left->p_inf, right->p_inf);
    out->vacuum = star_residual(0.0, &problem) >= 0.0; /* Toro eq. 4.40 */
    if (out->vacuum) {
        out->pressure = problem.floor;
    } else {
        TRY(solve_star(ctx, &problem, out));
    }
    out->left_wave = make_wave(&problem.left, out->pressure);
    out->right_wave = make_wave(&problem.right, out->pressure);
    out->contact = 0.5 * (out->left_wave.velocity + out->right_wave.velocity);
    if (!out->vacuum) out->left_wave.velocity = out->right_wave.velocity = out->contact;
    return FLOE_OK;
}

typedef struct fan_problem {
    const outward *side;
    double speed;
} fan_problem;

/* u + sign c - x/t in a fan, where the sound speed of the equivalent gas is `ratio` times the outer one. */
static double fan_residual(double ratio, void *user)
{
    const fan_problem *q = user;
    const outward *side = q->side;
    const double g = side->gamma, density = side->density * pow(ratio, 2.0 / (g - 1.0));
    return side->velocity - q->speed +
           side->sign * side->sound * (2.0 / (g - 1.0) * (ratio - 1.0) + ratio * covolume_stretch(side, density));
}

/* Inside a fan (Toro eqs 4.56 and 4.63); with a covolume the place belongs to the root of an equation. */
static riemann_state sample_fan(const outward *side, double speed)
{
    const double g = side->gamma;
    const double plain = 2.0 / (g + 1.0) * (side->sound + 0.5 * (g - 1.0) * side->sign * (speed - side->velocity));
    fan_problem q = {side, speed};
    const double sound = side->covolume > 0.0 ? side->sound * find_root(fan_residual, &q, 0.0, 1.0) : plain;
    const double ratio = fmax(sound / side->sound, 0.0), density = side->density * pow(ratio, 2.0 / (g - 1.0));
    return (riemann_state){.density = density / covolume_stretch(side, density),
                           .velocity = speed - side->sign * sound * covolume_stretch(side, density),
                           .pressure = side->stiff * pow(ratio, 2.0 * g / (g - 1.0)) - side->p_inf};
}

static riemann_state sample_side(const riemann_solution *solution, double speed, bool left)
{
    const riemann_side *side = left ? &solution->left : &solution->right;
    const riemann_wave *wave = left ? &solution->left_wave : &solution->right_wave;
    const double sign = left ? -1.0 : 1.0;
    /* On the discontinuity itself the state to its left is taken: the outer one of a left wave. */
    const bool outside = left ? speed <= wave->head : speed > wave->head;
    const bool inside = left ? speed > wave->tail : speed <= wave->tail;
    if (outside)
        return (riemann_state){.density = side->density, .velocity = side->velocity, .pressure = side->pressure};
    if (inside || wave->shock) {
        return (riemann_state){.density = wave->density, .velocity = wave->velocity, .pressure = solution->pressure};
    }
    const outward seen = look_outward(side, sign);
    return sample_fan(&seen, speed);
}

/* A vacuum has no velocity of its own: speed = x/t continues that of the fans' edges. */
static riemann_state sample_vacuum(const riemann_solution *solution, double speed, bool left)
{
    return (riemann_state){.velocity = speed, .pressure = solution->pressure, .left_gas = left, .empty = true};
}

riemann_state riemann_sample(const riemann_solution *solution, double speed)
{
    const bool left = speed <= solution->contact;
    const riemann_side *side = left ? &solution->left : &solution->right;
    const riemann_wave *wave = left ? &solution->left_wave : &solution->right_wave;
    const bool beyond_front = left ? speed > wave->velocity : speed <= wave->velocity;
    if (is_vacuum(side) || (solution->vacuum && beyond_front)) return sample_vacuum(solution, speed, left);
    riemann_state state = sample_side(solution, speed, left);
    state.left_gas = left;
    return state;
}
