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
    struct scene_layout *layout; /* owned; the scene is its, where bodies are not filled as the deck gives them */
    scene_coupling coupling;
    mesh mesh;
    domain *domain; /* owned */
    stage_list stages;
    ledger ledger;
    mpm *mpm;                  /* owned; NULL without points */
    ice *ice;                  /* owned; NULL without cells */
    struct transfer *transfer; /* owned; NULL unless solids share cells with fluids */
    struct sealed *sealed;     /* owned; NULL unless a membrane or surfaces of solids cut the cells of gas */
    struct gas_rest *gas_rest; /* owned; NULL unless load increments are solved for beside gas on cells */
    char pressure_reason[256]; /* of method.pressure auto: what it has chosen last, and why; "" otherwise */
    /* How points get on, dynamic or static, and why where time.solver is auto; "" without points. */
    char solver_reason[160];
    /* Of the points, beside cells: how many at most, and why where time.substeps is auto; "" without. */
    char substeps_reason[200];
    int most_parts;        /* sub-steps of the points that a step of the cells may have */
    int parts;             /* that the next step has */
    double time;           /* s */
    double dt;             /* s: the last accepted step, then the next one's proposal */
    const char *dt_reason; /* what limits it */
    long steps, rejected;
    char cause[320]; /* why the last step was rejected before it could be taken; "" where it was not */
    double point_updates, cell_updates; /* so far */
    double rest_since; /* s: since when the solids have been at rest (scene.rest); INFINITY: they are not */
    bool at_rest;
    bool
        has_light; /* a solid is lighter than an interface with some fluid of the scene bears: looked at before each step (light.h) */
    uint64_t held_before; /* bytes of counted memory that were in use before it was made */
} sim;

/* Makes a simulation ready for its first step. */
floe_status sim_create(sim **out, context *ctx, const scene *s, scene_coupling coupling);
void sim_destroy(sim **s);

/* One step that does not pass `until` (s): retried with smaller steps, at most ten times, then FLOE_DIVERGED; the state is then
 * that of the last good step. */
floe_status sim_step(sim *s, double until);

/* Plan of a scene without running it: the stages, and the bytes that it would hold. */
typedef struct sim_plan_info {
    uint64_t mpm_bytes, ice_bytes, coupling_bytes; /* fields and tile partials */
    uint64_t scratch_bytes;                        /* all else: sums of tiles, buffers of threads, order of points */
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
/* Opens the ledger's account with what is there now. */
floe_status sim_open_account(sim *s);
/* Brings the ledger's totals, scales and largest drifts up to date; from sums that are there already. */
floe_status sim_account(sim *s);
void sim_account_for(sim *s, const sim_totals *t);
/* Brings what is made from the state up to date with it, for output: the cells' view of the solids, volume fractions and temperatures.
 * Steps make it anew, and do not need it. */
floe_status sim_refresh(sim *s);
/* Whether the solids have come to rest (scene.rest): sets rest_since and at_rest from the totals now. */
floe_status sim_check_rest(sim *s, const sim_totals *t);
/* How long (s) they must be at rest: what the deck says, else as long as sound needs to cross them several times. */
double sim_rest_window(const sim *s);
/* Whether, by the last looks at the account, as much energy has come from nothing as motion and strain can have, and a
 * tenth of all that there is: no run goes on from there to an answer. */
bool sim_has_grown(const sim *s);
/* How much is from nothing, what moves fastest, where, and what to change. */
enum { SIM_GROWTH_TEXT = 512 };
void sim_describe_growth(const sim *s, char text[SIM_GROWTH_TEXT]);

/* Whether it goes by load increments that are solved for. */
static inline bool sim_is_static(const sim *s)
{
    return s->mpm && s->mpm->solver == SOLVER_STATIC;
}

/* Whether its steps are solved for, with inertia or without. */
static inline bool sim_solves(const sim *s)
{
    return s->mpm && s->mpm->balance;
}

/* With method.pressure auto: chooses explicit or implicit, at the start and every so many steps; otherwise does nothing. */
floe_status sim_choose_pressure(sim *s);
/* How many sub-steps of the points a step may have (time.substeps), and why. Errors: FLOE_BAD_INPUT where the deck asks for what cannot be. */
floe_status sim_choose_substeps(sim *s);
/* Sub-steps of the next step, where it may have several: from the cells' stable step (s) and the points', which becomes what they allow
 * for the whole. */
void sim_take_substeps(sim *s, double cells, step_limit *points);
/* How many steps lead through `left` seconds, from one of `first` that grow to `dt` (s). */
double sim_steps_through(double left, double first, double dt, double growth);
/* The stages of one step, run or (while planning) recorded. */
floe_status sim_run_stages(sim *s);
/* The step that would be taken now (s), how many of its kind the run would need, and what limits it. */
floe_status sim_predict(sim *s, double *dt, double *steps, const char **reason);

#endif
