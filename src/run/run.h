/* Runs: a scene carried from its start, or from a checkpoint, to its end, with all that is written on the way (design
 * 6).
 *
 * What is decided on the way (when to write, whether the solids are at rest) depends on the checkpointed state alone,
 * so that a resumed run has the same bits as one that was never stopped. */
#ifndef RUN_RUN_H
#define RUN_RUN_H

#include "io/summary.h"
#include "scene/scene.h"

#include <signal.h>
#include <stdio.h>

/* Called around steps; anything but FLOE_OK ends the run as a failed step would, FLOE_INTERRUPTED in order. */
typedef floe_status step_hook(void *user, sim *s);

/* How a run is to be carried out. {0} is a quiet run without limits into no folder: `dir` must be set. */
typedef struct run_options {
    const char *dir;                   /* folder of the outputs, made if it is not there */
    bool resume;                       /* go on from DIR/checkpoint.h5 */
    double max_wall;                   /* s of wall time after which the run stops as if by a signal; 0: no limit */
    const volatile sig_atomic_t *stop; /* becomes a signal's number when the run is asked to stop; NULL: never */
    int threads;                       /* 0: the scene's, else OpenMP's default */
    FILE *progress;                    /* where progress is shown; NULL: nowhere */
    const char *label;                 /* shown before the progress; NULL: none */
    log_sink *sink;                    /* gets the log beside DIR/run.log, and stays the context's sink; NULL: none */
    void *sink_user;
    log_level sink_detail;
    step_hook *before_step, *after_step; /* NULL: none */
    void *hook_user;
} run_options;

/* Runs the scene under scene->coupling and fills *out, which is also DIR/summary.json. The result is FLOE_OK (the end,
 * or rest), FLOE_DIVERGED or FLOE_INTERRUPTED (both with a checkpoint, if the state is good), or what else went wrong;
 * the context's message says what. *out holds what was reached in any case. */
floe_status run_scene(context *ctx, scene *s, const run_options *options, run_summary *out);

#endif
