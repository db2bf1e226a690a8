/* The summary: DIR/summary.json, what scripts, `compare` and `study` read of a run (design, commands and outputs). */
#ifndef IO_SUMMARY_H
#define IO_SUMMARY_H

#include "base/context.h"
#include "sim/sim.h"

#include <stdint.h>

enum {
    SUMMARY_TEXT = 512,
    SUMMARY_NAME = 64,
    SUMMARY_MAX_STAGES = STAGE_MAX,
    SUMMARY_MAX_ERRORS = 64,
    SUMMARY_MAX_COUNTERS = 32,
    SUMMARY_WARNING = 1400,
    SUMMARY_MAX_WARNINGS = 8
};

/* A number with its name. NAN is written as null, and null is read as NAN. */
typedef struct summary_value {
    char name[SUMMARY_NAME];
    double value;
} summary_value;

typedef struct summary_counter {
    char name[SUMMARY_NAME];
    long long value;
} summary_counter;

/* The fields of summary.json, in their order. No member owns memory. */
typedef struct run_summary {
    char deck[SUMMARY_TEXT];     /* path of the deck */
    char coupling[SUMMARY_NAME]; /* mpm, ice, ice-mpm */
    char solver[SUMMARY_TEXT];   /* of points: dynamic or static, and why where floe chose; "" without points */
    char pressure[SUMMARY_TEXT]; /* of cells: explicit or implicit, and why where floe chose; "" without */
    /* Of points beside cells: at most, and why where floe chose; "" where the deck asks for none. */
    char substeps[SUMMARY_TEXT];
    char interface[512]; /* of solids beside fluids on cells, and why where it was left to floe; "": there is none */
    bool dimensionless;  /* "units": "none", else "si", as summaries of older versions are read */
    char status[SUMMARY_NAME];  /* done, at_rest, diverged, interrupted, ... */
    char message[SUMMARY_TEXT]; /* why it is neither done nor at rest; "" otherwise */
    double time;                /* s, reached */
    long long steps, rejected_steps;
    double wall_seconds; /* earlier legs of a resumed run included */
    /* Of it, what this leg's history, snapshots and checkpoints took; 0 where an older version wrote it. */
    double output_seconds;
    double cpu_seconds; /* processor time of this leg without outputs, all threads; 0 where an older version wrote it */
    summary_value seconds_by_stage[SUMMARY_MAX_STAGES];
    int n_stages;
    long long cells, points; /* of the whole mesh (0 without cells); at the end */
    double cell_updates, point_updates;
    long long peak_rss_bytes;
    long long field_bytes_mpm, field_bytes_ice, field_bytes_coupling;
    /* Relative, the largest of the run, and at its end; momentum: the worst axis. */
    double drift_mass, drift_momentum, drift_moment,
        drift_energy; /* moment: NAN where the scene has no account of it */
    double end_drift_mass, end_drift_momentum, end_drift_moment, end_drift_energy;
    /* What will not be right, or was not, in words; those beyond the last are left out. */
    char warnings[SUMMARY_MAX_WARNINGS][SUMMARY_WARNING];
    int n_warnings;
    double reference_accuracy; /* the relative error that the exact solution itself may have; 0: none that is known */
    char notes[SUMMARY_TEXT];  /* drifts beyond 1 %, points lost, floors, guards, merged cells; "": none */
    summary_value errors[SUMMARY_MAX_ERRORS];
    int n_errors;
    summary_counter counters[SUMMARY_MAX_COUNTERS];
    int n_counters;
    char version[SUMMARY_NAME], git[SUMMARY_NAME], compiler[SUMMARY_TEXT], flags[SUMMARY_TEXT];
    char machine[SUMMARY_TEXT]; /* what it ran on; "" where an older version wrote it */
    long long threads;
} run_summary;

/* Adds an error or a counter; what does not fit is FLOE_INTERNAL. */
floe_status summary_add_error(run_summary *r, context *ctx, const char *name, double value);
floe_status summary_add_counter(run_summary *r, context *ctx, const char *name, long long value);
void summary_add_warning(run_summary *r, const char *text);

/* Wall time without that of outputs (s): what the solver needs, and what studies compare. */
double summary_run_seconds(const run_summary *r);

/* Fills version, git, compiler, flags and machine with those of this build and of where it runs. */
void summary_set_build(run_summary *r);
/* Fills what the simulation knows: coupling, time, steps, stages, cells, points, updates, field bytes, conservation,
 * counters (those of the ledger are appended). */
floe_status summary_set_sim(run_summary *r, const sim *s);

/* Replaces `path` by the summary. */
floe_status summary_write(context *ctx, const char *path, const run_summary *r);
/* Reads a summary. FLOE_IO says what is missing or of the wrong type; unknown fields are passed over. */
floe_status summary_read(context *ctx, const char *path, run_summary *out);

/* The summary as a JSON object, for pages that hold several (compare.json, study.json). The caller owns the reference
 * (jansson's json_decref); NULL when memory is out. */
struct json_t *summary_json(const run_summary *r);

#endif
