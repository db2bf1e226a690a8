#include "verify/ode.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <string.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

/* A solve in progress: what must be released, and the last complaint. */
typedef struct solve {
    const ode *system;
    SUNContext sun;
    N_Vector y, absolute;
    SUNNonlinearSolver newton;
    void *cvode;
    char complaint[256];
} solve;

static int ode_rate(realtype t, N_Vector y, N_Vector dydt, void *user)
{
    const solve *s = user;
    s->system->rate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dydt), s->system->user);
    return 0;
}

/* CVODE prints by default; here its words go into the message of the error. */
static void note_cvode_error(int code, const char *module, const char *function, char *message, void *user)
{
    (void)module;
    (void)function;
    solve *s = user;
    if (code < 0) (void)snprintf(s->complaint, sizeof s->complaint, "%s", message);
}

static void release_solver(solve *s)
{
    if (s->cvode != NULL) CVodeFree(&s->cvode);
    if (s->newton != NULL) SUNNonlinSolFree(s->newton);
    if (s->absolute != NULL) N_VDestroy(s->absolute);
    if (s->y != NULL) N_VDestroy(s->y);
    if (s->sun != NULL) SUNContext_Free(&s->sun);
}

static bool prepare_solver(solve *s, const double *y)
{
    const ode *system = s->system;
    if (SUNContext_Create(NULL, &s->sun) != 0) return false;
    s->y = N_VNew_Serial((sunindextype)system->n, s->sun);
    s->absolute = N_VNew_Serial((sunindextype)system->n, s->sun);
    s->cvode = CVodeCreate(CV_ADAMS, s->sun);
    if (s->y == NULL || s->absolute == NULL || s->cvode == NULL) return false;
    memcpy(N_VGetArrayPointer(s->y), y, system->n * sizeof *y);
    memcpy(N_VGetArrayPointer(s->absolute), system->absolute, system->n * sizeof *y);
    s->newton = SUNNonlinSol_FixedPoint(s->y, 0, s->sun);
    return s->newton != NULL && CVodeSetErrHandlerFn(s->cvode, note_cvode_error, s) == CV_SUCCESS &&
           CVodeInit(s->cvode, ode_rate, 0.0, s->y) == CV_SUCCESS &&
           CVodeSVtolerances(s->cvode, system->relative, s->absolute) == CV_SUCCESS &&
           CVodeSetUserData(s->cvode, s) == CV_SUCCESS && CVodeSetMaxNumSteps(s->cvode, -1) == CV_SUCCESS &&
           CVodeSetNonlinearSolver(s->cvode, s->newton) == CV_SUCCESS;
}

static floe_status integrate_times(context *ctx, solve *s, size_t n_times, const double *t)
{
    for (size_t i = 0; i < n_times; i++) {
        realtype reached = t[i];
        if (t[i] > 0.0 && CVode(s->cvode, t[i], s->y, &reached, CV_NORMAL) < 0) {
            return fail(ctx, FLOE_BAD_INPUT, "the equations cannot be integrated to t = %g s: %s", t[i], s->complaint);
        }
        s->system->take(i, t[i], N_VGetArrayPointer(s->y), s->system->user);
    }
    return FLOE_OK;
}

floe_status ode_solve(context *ctx, const ode *system, const double *y, size_t n_times, const double *t)
{
    solve s = {.system = system};
    const floe_status status = prepare_solver(&s, y)
                                   ? integrate_times(ctx, &s, n_times, t)
                                   : fail(ctx, FLOE_NO_MEMORY, "CVODE cannot be set up: %s", s.complaint);
    release_solver(&s);
    return status;
}
