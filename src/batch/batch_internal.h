/* The parts of a batch. Private to src/batch. */
#ifndef BATCH_BATCH_INTERNAL_H
#define BATCH_BATCH_INTERNAL_H

#include "batch/batch.h"
#include "batch/machine_load.h"
#include "run/live_line.h"

#include <sys/types.h>

/* A process and the case that it runs. */
typedef struct batch_job {
    pid_t pid;           /* 0: none */
    size_t index;        /* of the case */
    double started;      /* wall clock, s */
    machine_load before; /* at its start */
    bool asked;          /* to stop */
    bool killed;         /* for it did not stop when its time was up */
} batch_job;

typedef struct batch {
    context *ctx;           /* not owned */
    const batch_options *o; /* not owned */
    batch_case *list;       /* not owned */
    size_t n;
    batch_job *job; /* owned */
    int n_jobs;     /* places */
    int running;
    double started; /* wall clock, s */
    live_line line;
} batch;

/* DIR/FOLDER/NAME */
void batch_path(const batch_options *o, const batch_case *one, const char *name, char path[BATCH_PATH]);

/* batch_case.c */
/* Takes over a case that has ended before, if its case.json is of the same deck; `kept` says whether. */
void batch_case_keep(batch *b, batch_case *one);
/* Forgets what an earlier run has left of its result. */
floe_status batch_case_discard(batch *b, const batch_case *one);
/* Makes a result of how the process has ended, and notes it in case.json if it is final. */
floe_status batch_case_collect(batch *b, batch_job *j, int wait_status);

/* batch_resume.c */
/* Whether the case goes on from the checkpoint in its folder. */
bool batch_case_goes_on(const batch *b, const batch_case *one);
/* Notes of which deck and build the folder's run is, after the checkpoints of any other have gone. */
floe_status batch_case_begin(batch *b, const batch_case *one);
/* Removes that note, of a case that has ended. */
floe_status batch_case_clear_begin(batch *b, const batch_case *one);

/* batch_process.c */
/* Starts the case's process in a free place. */
floe_status batch_process_start(batch *b, size_t i);
/* Asks the process to stop. */
void batch_process_stop(batch_job *j);
/* Ends it at once. */
void batch_process_kill(batch_job *j);

/* batch_progress.c */
void batch_progress_begin(batch *b);
/* Shows where the batch stands, if it is time to. */
void batch_progress_show(batch *b);
/* Tells how a case has ended. */
void batch_progress_report(batch *b, const batch_case *one);

#endif
