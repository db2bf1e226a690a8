/* floe as a library: decks run by a program.
 *
 *     floe_context *floe = floe_create();
 *     floe_deck *deck;
 *     floe_run *run;
 *     if (floe_init() == FLOE_OK && floe_load(floe, "sod.yaml", NULL, 0, &deck) == FLOE_OK &&
 *         floe_execute(deck, &(floe_options){.directory = "out/sod"}, &run) == FLOE_OK)
 *         printf("L1 of density: %g\n", floe_value(run, "errors.l1_density"));
 *     else
 *         fprintf(stderr, "%s\n", floe_message(floe));
 *
 * Objects of one context must not be used by two threads at once; different contexts may. HDF5 is not thread-safe: only
 * one thread of a program may execute runs. */
#ifndef FLOE_FLOE_H
#define FLOE_FLOE_H

#include "floe/status.h"

#include <stdbool.h>
#include <stddef.h>

#if defined(__GNUC__)
#define FLOE_API __attribute__((visibility("default")))
#else
#define FLOE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct floe_context floe_context; /* messages and memory */
typedef struct floe_deck floe_deck;       /* a deck that was read */
typedef struct floe_run floe_run;         /* a run and its results */

/* Process-wide settings of the libraries behind floe (HDF5, GSL and udunits report to floe instead of printing or
 * aborting). Once for a process is enough, more often is fine. */
FLOE_API floe_status floe_init(void);
/* "0.1.0" */
FLOE_API const char *floe_version(void);

/* A context; NULL only when memory is out. Everything made with it must be destroyed before it. */
FLOE_API floe_context *floe_create(void);
FLOE_API void floe_destroy(floe_context **floe);
/* What went wrong in the last call that failed, with places in the deck; "" if nothing. Valid until the next call. */
FLOE_API const char *floe_message(const floe_context *floe);

/* Reads the deck at `path`, with n_set replacements "KEY=VALUE" (may be NULL). FLOE_BAD_INPUT: the message holds all
 * errors. */
FLOE_API floe_status floe_load(floe_context *floe, const char *path, const char *const *set, size_t n_set,
                               floe_deck **deck);
FLOE_API void floe_deck_destroy(floe_deck **deck);

typedef struct floe_options {
    const char *directory; /* of the results; it is made if it is not there */
    bool resume;           /* go on from its checkpoint */
    double max_wall;       /* s of wall time, then stop with a checkpoint; 0: no limit */
    int threads;           /* 0: as the deck or OpenMP says */
} floe_options;

/* Runs the deck to its end. *run holds what was reached, whatever the result; NULL only when memory is out. */
FLOE_API floe_status floe_execute(floe_deck *deck, const floe_options *options, floe_run **run);
FLOE_API void floe_run_destroy(floe_run **run);

/* A number of the run's summary: time, steps, rejected_steps, wall_seconds, cells, points, cell_updates, point_updates,
 * peak_rss_bytes, conservation.mass (momentum, energy), errors.METRIC, counters.NAME, seconds_by_stage.NAME; NAN if
 * there is none. */
FLOE_API double floe_value(const floe_run *run, const char *name);
/* "done", "at_rest", "diverged", "interrupted" or "failed". */
FLOE_API const char *floe_run_status(const floe_run *run);

#ifdef __cplusplus
}
#endif

#endif
