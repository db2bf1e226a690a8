#include "coupling/reaction.h"

#include "coupling/coupling_constants.h"

#include "base/memory.h"

#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

struct reaction_solver {
    int n;
    const reaction *list;      /* not owned */
    const reaction_cell *cell; /* of the solve in progress */
    SUNContext sun;
    N_Vector y, tolerance;
    SUNMatrix jacobian;
    SUNLinearSolver linear;
    void *cvode;
};

const reaction_model *reaction_find(const char *name)
{
    for (size_t i = 0; i < reaction_registry_size; i++)
        if (strcmp(reaction_registry[i]->name, name) == 0) return reaction_registry[i];
    return NULL;
}

/* Temperature of the solids, where there is no fluid. */
static double solid_temperature(const reaction_cell *c)
{
    for (int r = 0; r < c->n; r++)
        if (c->solid[r] && c->rho[r] > 0.0) return c->T[r];
    return 0.0;
}

/* Masses after the reactions so far, and the temperature at which the fluids hold their energy: e = e_0 + c_v (T - T_0)
 * of each. */
static double mixture_temperature(const reaction_solver *s, const double *reacted, double *rho)
{
    const reaction_cell *c = s->cell;
    double energy = 0.0, capacity = 0.0;
    for (int r = 0; r < c->n; r++) {
        rho[r] = c->rho[r];
        if (!c->solid[r]) energy += c->rho[r] * c->e[r];
    }
    for (int k = 0; k < s->n; k++) {
        rho[s->list[k].reactant] -= reacted[k];
        rho[s->list[k].product] += reacted[k];
        energy += reacted[k] * (s->list[k].heat + (c->solid[s->list[k].reactant] ? c->e[s->list[k].reactant] : 0.0));
    }
    for (int r = 0; r < c->n; r++) {
        rho[r] = fmax(rho[r], 0.0);
        if (c->solid[r]) continue;
        energy -= rho[r] * (c->e[r] - c->cv[r] * c->T[r]);
        capacity += rho[r] * c->cv[r];
    }
    return capacity > 0.0 ? energy / capacity : solid_temperature(c);
}

static void reaction_rates(const reaction_solver *s, const double *reacted, double *rate)
{
    double rho[REACTION_MAX_MATERIALS];
    const double T = mixture_temperature(s, reacted, rho);
    for (int k = 0; k < s->n; k++) {
        const reaction *q = &s->list[k];
        const reaction_state state = {.reactant = rho[q->reactant],
                                      .product = rho[q->product],
                                      .density = s->cell->density[q->reactant],
                                      .T = T,
                                      .p = s->cell->p,
                                      .surface = s->cell->surface[k]};
        rate[k] = state.reactant > 0.0 ? q->model->rate(q->par, &state) : 0.0;
    }
}

static int reaction_derivative(realtype t, N_Vector y, N_Vector dydt, void *user)
{
    (void)t;
    reaction_rates(user, N_VGetArrayPointer(y), N_VGetArrayPointer(dydt));
    return 0;
}

/* CVODE prints by default; its failure is in what it returns. */
static void ignore_message(int code, const char *module, const char *function, char *message, void *user)
{
    (void)code;
    (void)module;
    (void)function;
    (void)message;
    (void)user;
}

static bool prepare_solver(reaction_solver *s)
{
    if (SUNContext_Create(NULL, &s->sun) != 0) return false;
    s->y = N_VNew_Serial(s->n, s->sun);
    s->tolerance = N_VNew_Serial(s->n, s->sun);
    s->cvode = CVodeCreate(CV_BDF, s->sun);
    s->jacobian = SUNDenseMatrix(s->n, s->n, s->sun);
    if (!s->y || !s->tolerance || !s->cvode || !s->jacobian) return false;
    s->linear = SUNLinSol_Dense(s->y, s->jacobian, s->sun);
    N_VConst(0.0, s->y);
    N_VConst(1.0, s->tolerance);
    return s->linear && CVodeSetErrHandlerFn(s->cvode, ignore_message, NULL) == CV_SUCCESS &&
           CVodeInit(s->cvode, reaction_derivative, 0.0, s->y) == CV_SUCCESS &&
           CVodeSVtolerances(s->cvode, REACTION_RELATIVE, s->tolerance) == CV_SUCCESS &&
           CVodeSetUserData(s->cvode, s) == CV_SUCCESS && CVodeSetMaxNumSteps(s->cvode, 20000) == CV_SUCCESS &&
           CVodeSetLinearSolver(s->cvode, s->linear, s->jacobian) == CV_SUCCESS;
}

floe_status reaction_create(reaction_solver **out, context *ctx, int n, const reaction *list)
{
    TRY(memory_new(ctx, out, 1, sizeof **out));
    (*out)->n = n;
    (*out)->list = list;
    if (prepare_solver(*out)) return FLOE_OK;
    reaction_destroy(ctx, out);
    return fail(ctx, FLOE_NO_MEMORY, "CVODE cannot be set up for %d reactions", n);
}

void reaction_destroy(context *ctx, reaction_solver **s)
{
    if (!s || !*s) return;
    reaction_solver *q = *s;
    if (q->cvode) CVodeFree(&q->cvode);
    if (q->linear) SUNLinSolFree(q->linear);
    if (q->jacobian) SUNMatDestroy(q->jacobian);
    if (q->tolerance) N_VDestroy(q->tolerance);
    if (q->y) N_VDestroy(q->y);
    if (q->sun) SUNContext_Free(&q->sun);
    memory_free(ctx, s);
}

/* Never less than nothing, never more than there is; the last trace at once. */
static void keep_bounds(const reaction_solver *s, double *reacted)
{
    const reaction_cell *c = s->cell;
    double sum = 0.0;
    for (int r = 0; r < c->n; r++) sum += c->rho[r];
    for (int k = 0; k < s->n; k++) reacted[k] = fmax(reacted[k], 0.0);
    for (int r = 0; r < c->n; r++) {
        double gone = 0.0;
        for (int k = 0; k < s->n; k++)
            if (s->list[k].reactant == r) gone += reacted[k];
        if (!(gone > 0.0) || gone < c->rho[r] - REACTION_LAST * sum) continue;
        for (int k = 0; k < s->n; k++)
            if (s->list[k].reactant == r) reacted[k] *= c->rho[r] / gone;
    }
}

/* One step of the third order with an estimate of the second (Bogacki and Shampine 1989), from the rates at the start;
 * false where the two differ by more than CVODE may be off. Most cells react slowly over a step that sound has bound,
 * and need no more. */
static bool step_once(const reaction_solver *s, const double *start, const double *tolerance, double dt,
                      double *reacted)
{
    double k2[REACTION_MAX], k3[REACTION_MAX], k4[REACTION_MAX], y[REACTION_MAX];
    for (int k = 0; k < s->n; k++) y[k] = 0.5 * dt * start[k];
    reaction_rates(s, y, k2);
    for (int k = 0; k < s->n; k++) y[k] = 0.75 * dt * k2[k];
    reaction_rates(s, y, k3);
    for (int k = 0; k < s->n; k++) y[k] = dt / 9.0 * (2.0 * start[k] + 3.0 * k2[k] + 4.0 * k3[k]);
    reaction_rates(s, y, k4);
    for (int k = 0; k < s->n; k++) {
        const double error = dt * (-5.0 / 72.0 * start[k] + k2[k] / 12.0 + k3[k] / 9.0 - 0.125 * k4[k]);
        if (!(fabs(error) <= REACTION_RELATIVE * y[k] + tolerance[k])) return false;
    }
    for (int k = 0; k < s->n; k++) reacted[k] = y[k];
    return true;
}

bool reaction_integrate(reaction_solver *s, const reaction_cell *cell, double dt, double *reacted)
{
    double *y = N_VGetArrayPointer(s->y), *tolerance = N_VGetArrayPointer(s->tolerance), start[REACTION_MAX];
    bool any = false;
    s->cell = cell;
    for (int k = 0; k < s->n; k++) {
        y[k] = reacted[k] = 0.0;
        tolerance[k] = REACTION_ABSOLUTE * cell->rho[s->list[k].reactant] + 1e-200;
    }
    reaction_rates(s, reacted, start);
    for (int k = 0; k < s->n; k++) any = any || start[k] > 0.0;
    if (!any) return true;
    if (step_once(s, start, tolerance, dt, reacted)) {
        keep_bounds(s, reacted);
        return true;
    }
    realtype reached;
    if (CVodeReInit(s->cvode, 0.0, s->y) != CV_SUCCESS ||
        CVodeSVtolerances(s->cvode, REACTION_RELATIVE, s->tolerance) != CV_SUCCESS ||
        /* CVODE keeps a copy */ CVodeSetStopTime(s->cvode, dt) != CV_SUCCESS ||
        CVode(s->cvode, dt, s->y, &reached, CV_NORMAL) < 0)
        return false;
    for (int k = 0; k < s->n; k++) {
        reacted[k] = y[k];
        if (!isfinite(y[k])) return false;
    }
    keep_bounds(s, reacted);
    return true;
}
