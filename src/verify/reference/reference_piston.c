/* The same piston as in exact_piston, struck: all at rest, the piston alone has a velocity. Its motion is the sum over
 * the modes of velocity m/M_n sin(omega_n t)/omega_n, M_n the mode's mass at the piston. */
#include "verify/piston.h"
#include "verify/reference.h"
#include "verify/verify_internal.h"

typedef struct struck_par {
    piston system; /* first: PISTON_PARAMS */
    double velocity, origin, modes;
} struck_par;

static const param_spec struck_params[] = {
    PISTON_PARAMS,
    PAR_ANY(struck_par, velocity, "m/s", NAN, "velocity of the piston at t = 0, away from the fluid"),
    PAR_ANY(struck_par, origin, "m", 0.0, "place of the piston at rest"),
    PAR_BETWEEN(struck_par, modes, "1", 1.0, 1000.0, 100.0, "modes that are summed"),
};

/* The two modes that hold most of the energy. */
typedef struct struck_modes {
    double omega[2]; /* rad/s */
    double share[2]; /* of the energy */
} struck_modes;

static floe_status struck_prepare(context *ctx, const void *par, void *prepared)
{
    const struck_par *p = par;
    struck_modes *m = prepared;
    const piston *system = &p->system;
    TRY(check_whole(ctx, "modes", p->modes));
    TRY(piston_check(ctx, system));
    for (int n = 1; n <= whole_number(p->modes); n++) {
        const double omega = piston_frequency(system, n);
        const double share = system->mass / piston_modal_mass(system, omega);
        if (!isfinite(omega)) {
            return fail(ctx, FLOE_BAD_INPUT, "the piston has no frequency of mode %d: check mass, stiffness and fluid",
                        n);
        }
        const int rank = share > m->share[0] ? 0 : 1;
        if (share <= m->share[rank]) continue;
        if (rank == 0) {
            m->omega[1] = m->omega[0];
            m->share[1] = m->share[0];
        }
        m->omega[rank] = omega;
        m->share[rank] = share;
    }
    return FLOE_OK;
}

enum { POSITION, DISPLACEMENT, VELOCITY, QUANTITIES };

static const reference_quantity struck_quantities[QUANTITIES] = {
    [POSITION] = {"position", "m", "place of the piston", NULL, false},
    [DISPLACEMENT] = {"displacement", "m", "way of the piston from its place at rest", NULL, false},
    [VELOCITY] = {"velocity", "m/s", "velocity of the piston", "position", false},
};

static floe_status struck_series(context *ctx, const void *par, const void *prepared, size_t n, const double *t,
                                 double *value)
{
    (void)ctx;
    (void)prepared;
    const struck_par *p = par;
    const piston *system = &p->system;
    for (size_t i = 0; i < QUANTITIES * n; i++) value[i] = 0.0;
    for (int k = 1; k <= whole_number(p->modes); k++) {
        const double omega = piston_frequency(system, k);
        const double velocity = p->velocity * system->mass / piston_modal_mass(system, omega);
        for (size_t i = 0; i < n; i++) {
            value[DISPLACEMENT * n + i] += velocity / omega * sin(omega * t[i]);
            value[VELOCITY * n + i] += velocity * cos(omega * t[i]);
        }
    }
    for (size_t i = 0; i < n; i++) value[POSITION * n + i] = p->origin + value[DISPLACEMENT * n + i];
    return FLOE_OK;
}

static const reference_scalar struck_scalars[] = {
    {"omega", "rad/s", "angular frequency of the mode with the largest share of the energy"},
    {"period", "s", "its period"},
    {"share", "1", "its share of the energy"},
    {"second_omega", "rad/s", "angular frequency of the mode with the next share"},
    {"second_share", "1", "its share of the energy"},
};

static double struck_scalar(const void *par, const void *prepared, size_t i)
{
    (void)par;
    const struck_modes *m = prepared;
    const double all[] = {m->omega[0], 2.0 * VERIFY_PI / m->omega[0], m->share[0], m->omega[1], m->share[1]};
    return all[i];
}

static const struck_par york = {.system = PISTON_OF_YORK, .velocity = -1.0, .origin = 20.0, .modes = 100.0};

const reference_model reference_piston = {
    .name = "piston",
    .doc = "a piston between a column of fluid and a spring, struck at rest",
    .cite = "York (1997), eq. 6.2 and section 6.1; York, Sulsky & Schreyer (2000), section 4.2; Olson & Bathe (1983)",
    .validity =
        "linear acoustics: error of the order of displacement/length. The modes left out hold a share of the energy "
        "of the order of (fluid mass + spring mass)/(mass modes).",
    .param_size = sizeof(struck_par),
    .params = struck_params,
    .n_params = COUNT_OF(struck_params),
    .quantities = struck_quantities,
    .n_quantities = QUANTITIES,
    .scalars = struck_scalars,
    .n_scalars = COUNT_OF(struck_scalars),
    .sample = &york,
    .sample_end = 0.02,
    .prepared_size = sizeof(struck_modes),
    .prepare = struck_prepare,
    .series = struck_series,
    .scalar = struck_scalar,
};
