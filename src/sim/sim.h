/* A simulation: scene -> facts -> plan -> steps. One object owns the mesh, the domain, both solvers and the ledger. */
#ifndef SIM_SIM_H
#define SIM_SIM_H

#include "grid/ledger.h"
#include "grid/stage.h"
#include "ice/ice.h"
#include "mpm/mpm.h"
#include "scene/scene.h"

typedef struct sim {
    context *ctx;                /* not owned */
    const scene *scene;          /* not owned */
    struct scene_layout *layout; /* owned; owns the scene where bodies are not filled as in the deck */
    scene_coupling coupling;
    mesh mesh;
    domain *domain; /* owned */
    stage_list stages;
    ledger ledger;
    mpm *mpm;                                  /* owned; NULL without points */
    ice *ice;                                  /* owned; NULL without cells */
    struct transfer *transfer;                 /* owned; NULL unless solids share cells with fluids */
    struct embedded *embedded;                 /* owned; NULL without embedded boundaries */
    struct tracers *tracers;                   /* owned; NULL unless the scene has tracers (sim/tracer.h) */
    struct quasi_static_gas *quasi_static_gas; /* owned; NULL unless steps are implicit beside gas on cells */
    char pressure_reason[256];                 /* with method.pressure auto: the last choice, and why; "" otherwise */
    /* The solver of the points, and why where time.solver is auto; "" without points. */
    char solver_reason[160];
    /* Largest number of substeps of the points beside cells, and why where time.substeps is auto; "" without. */
    char substeps_reason[200];
    const char *
        stiffness_obstacle; /* why an implicit pressure does not find the solids' stiffness in its system; NULL: it does, or is none */
    int most_substeps;     /* largest number of substeps of the points in a step of the cells */
    int n_substeps;        /* substeps of the next step */
    double time;           /* s */
    double dt;             /* s: the last accepted time step, then the proposal for the next */
    const char *dt_reason; /* what limits it */
    long steps, rejected;
    char cause[320];                    /* why the last step was rejected; "" where it was not */
    double point_updates, cell_updates; /* so far */
    double rest_since; /* s: time since which the solids are at rest (scene.rest); INFINITY: they are not */
    bool at_rest;
    bool
        has_light; /* a solid may be too light for an interface with some fluid of the scene: checked before each step (light_solid_check.h) */
    uint64_t bytes_before; /* bytes of counted memory in use before it was created */
} sim;

/* Makes a simulation ready for its first step. */
floe_status sim_create(sim **out, context *ctx, const scene *s, scene_coupling coupling);
void sim_destroy(sim **s);

/* One step that does not pass `until` (s): retried with smaller steps, at most ten times, then FLOE_DIVERGED; the state is then
 * that of the last good step. */
floe_status sim_step(sim *s, double until);

/* Plan of a scene without running it: stages and memory. */
typedef struct sim_plan_info {
    uint64_t mpm_bytes, ice_bytes, coupling_bytes; /* fields and tile partials */
    uint64_t scratch_bytes;                        /* the rest: sums of tiles, buffers of threads, order of points */
    size_t cells, points;
    double predicted_steps, predicted_dt;
    const char *dt_reason;
} sim_plan_info;
floe_status sim_plan(sim *s, sim_plan_info *out);

/* Energies and momenta now. J, kg, N s per metre of depth in 2-D, per m2 in 1-D, per radian when axisymmetric: outputs multiply by
 * the thickness or 2 pi. */
typedef struct sim_totals {
    double time;
    double mass, kinetic, strain, internal;
    double kinetic_solid;
    double momentum[3];
    bool
        turns; /* sim_sum_moments has added the moments of momentum: kg m2/s, about the origin, and sums of sizes about the mesh's middle */
    double moment[3], moment_scale[3], spin[SCENE_MAX_BODIES][3]; /* spin: of each body of points */
    ice_totals ice;
    mpm_totals mpm;
} sim_totals;
floe_status sim_sum(sim *s, sim_totals *out);
/* Adds moments of momentum to sums: a pass of its own over the points. */
void sim_sum_moments(sim *s, sim_totals *t);
/* Opens the ledger with the current totals. */
floe_status sim_open_ledger(sim *s);
/* Updates the ledger's totals, scales and largest drifts; the second from given sums. */
floe_status sim_update_ledger(sim *s);
void sim_update_ledger_from(sim *s, const sim_totals *t);
/* Updates derived fields for output: densities and velocities of solids on cells, volume fractions and temperatures.
 * Steps do not need it. */
floe_status sim_refresh(sim *s);
/* Whether the solids have come to rest (scene.rest): sets rest_since and at_rest from the totals now. */
floe_status sim_check_rest(sim *s, const sim_totals *t);
/* Time (s) for which they must be at rest: from the deck, else several sound crossings. */
double sim_rest_window(const sim *s);
/* J: what the fluids could set in motion by themselves, at the start; -1 where open sides, heat or points bring more than that. */
floe_status sim_find_stored_work(sim *s, double *work);
/* Whether, by the last checks of the ledger, spurious energy exceeds the kinetic and strain energy and a tenth of the
 * total energy: the run cannot give an answer. */
bool sim_has_grown(const sim *s);
/* Describes the spurious energy, the fastest motion and its place, and the remedy. */
enum { SIM_GROWTH_TEXT = 512 };
void sim_describe_growth(const sim *s, char text[SIM_GROWTH_TEXT]);

/* Whether steps are load increments of statics. */
static inline bool sim_is_static(const sim *s)
{
    return s->mpm && s->mpm->solver == SOLVER_STATIC;
}

/* Whether steps are implicit, with inertia or without. */
static inline bool sim_solves(const sim *s)
{
    return s->mpm && mpm_is_solved(s->mpm);
}

/* With method.pressure auto: chooses explicit or implicit, at the start and every so many steps; otherwise does nothing. */
floe_status sim_choose_pressure(sim *s);
/* Has the solids answer an implicit pressure with their stiffness, where that is possible; before the plan is made. Errors: FLOE_NO_MEMORY. */
floe_status sim_stiffen_walls(sim *s);
/* The same once the points are seeded: not where there are too many of them. */
floe_status sim_settle_walls(sim *s);
/* Chooses the largest number of substeps of the points (time.substeps). Errors: FLOE_BAD_INPUT where the deck's choice
 * is not possible. */
floe_status sim_choose_substeps(sim *s);
/* Number of substeps of the next step, from the stable steps (s) of the cells and of the points; the latter becomes
 * that of all substeps together. */
void sim_take_substeps(sim *s, double cells, step_limit *points);
/* Number of time steps in `left` seconds, if they grow from `first` to `dt` (s) by a factor `growth`. */
double sim_steps_through(double left, double first, double dt, double growth);
/* The stages of one step, run or (while planning) recorded. */
floe_status sim_run_stages(sim *s);
/* The next time step (s), the number of such steps in the run, and what limits it. */
floe_status sim_predict(sim *s, double *dt, double *steps, const char **reason);
/* The largest step (s) that is stable, with a CFL number of 1, and what limits it; INFINITY: steps are solved for. */
floe_status sim_stability_limit(sim *s, double *dt, const char **reason);

#endif
