/* `floe study` and `floe compare`: one deck along crossed axes: errors, orders, limits, and what they cost.
 *
 * A comparison is a study over the couplings of the deck and one axis. Cases that differ only in the axis `over` form a group: its
 * errors give an order, and its curve of error against cost is compared with those of the other groups. */
#ifndef STUDY_STUDY_H
#define STUDY_STUDY_H

#include "batch/batch.h"
#include "scene/remark.h"
#include "study/crossed.h"

enum { STUDY_MAX_REPEAT = 100, STUDY_LABEL = 160, STUDY_MAX_METRICS = SUMMARY_MAX_ERRORS };

typedef struct study_options {
    const char *name; /* stem of the results: "study", "compare" */
    bool compare;     /* axes are the deck's runs_as and compare.axis, not those of `study` */
    /* Deck, folder of the results, program, stop and progress; of each case its threads (times are compared at one) and
     * max_wall (0: the deck's); jobs, beside which timed runs are alone whatever it says. The rest is the study's. */
    batch_options batch;
    deck_overrides set;
    /* n_axis of "KEY=V1,V2,...": instead of the deck's axis of that key (of `compare`: of its one axis). */
    const char *const *axis;
    size_t n_axis;
    const char *over; /* instead of the deck's; NULL: the deck's */
    int repeat;       /* timed runs of each case; < 0: as the deck says */
    bool spoil;       /* each case is judged again as if frozen, doubled, ...: run/spoil.h */
    bool again;       /* run cases again that have ended before */
} study_options;

/* Times of a case. */
typedef struct study_timing {
    double seconds[STUDY_MAX_REPEAT]; /* s of wall time, of each timed run */
    double cpu[STUDY_MAX_REPEAT];     /* s of processor time of the steps, of each timed run */
    double others[STUDY_MAX_REPEAT];  /* cores that others used meanwhile; NAN: unknown */
    int n;                            /* 0: not timed */
    double best;    /* s, without outputs: the fastest timed run; not timed: the run itself, whatever ran beside it */
    double wall;    /* s: all of the best timed run */
    double least;   /* s of processor time of the steps, the least of the timed runs; not timed: of the run itself */
    double scatter; /* how far that may be from the truth, a share of it: (median - least)/least, or what is assumed */
    double during, taken; /* s of wall time of all timed runs, and of processor time that others used meanwhile */
    bool disturbed; /* others used the machine during the best one or all of them; not timed, during the run itself */
    bool differs;   /* a timed run gave other results than the first: it must not */
} study_timing;

/* What a case has come to, by the deck's study.check. */
typedef enum study_verdict {
    STUDY_UNJUDGED, /* the deck checks nothing, or it has not ended */
    STUDY_RIGHT,    /* it came to its end, and keeps to every check */
    STUDY_REFUSED,  /* floe said that it cannot: diverged (status 3), or a deck that no run can be made of (2) */
    STUDY_WRONG     /* it came to its end and breaks a check, or it crashed, hung or lost its results */
} study_verdict;

typedef struct study_range {
    double least, most; /* NAN: not measured, or not a number in some row */
} study_range;

typedef struct study_case {
    int pick[SCENE_MAX_AXES]; /* index of its value on each axis */
    size_t group;
    scene_coupling coupling;
    double h;                           /* m: domain.cell along the first axis */
    double cells;                       /* of the mesh */
    double over;                        /* value on the axis `over`, h if that is the mesh or none; NAN: no number */
    case_settings settings;             /* what makes the case of the deck; owned */
    double quantity[SCENE_MAX_METRICS]; /* last values of the study's quantities; NAN: none */
    study_verdict verdict;
    char why[BATCH_MESSAGE]; /* the first check that it breaks, or why it was refused; "" if right */
    bool of_solution;        /* a check of it compares with a solution */
    unsigned unnoticed;      /* bits of spoilers that its checks let pass, and the deck does not say why */
    unsigned excused;        /* likewise, and it does */
    study_timing timing;
    batch_case *run; /* in study.run */
} study_case;

typedef struct study {
    context *ctx;                 /* not owned */
    const study_options *options; /* not owned */
    bool dimensionless;           /* the deck says `units: none` */
    char title[256], exact[SCENE_NAME];
    scene_study plan; /* the deck's, with what the command line has changed; its axes are in `axes` */
    axis_list axes;
    int over;         /* index of the axis that orders are taken over; -1: none */
    study_case *list; /* owned; the first axis varies slowest */
    batch_case *run;  /* n as well; owned */
    size_t n, n_groups;
    char (*group)[STUDY_LABEL];            /* names of the groups; owned */
    const char *metric[STUDY_MAX_METRICS]; /* errors that any case has, in the order in which they come */
    int n_metrics;
    study_range found[SCENE_MAX_BARS]; /* of each check, over the cases that are right */
} study;

/* Runs all cases and the timed runs, and writes NAME.json, NAME.csv and the figures; *out, owned by the caller, holds the results.
 * A case that diverges or fails is a result, and the rest go on. FLOE_BAD_INPUT: axes or cases are wrong, all of them named, and nothing was run or
 * made. FLOE_INTERRUPTED: stopped; what there is was written, and the same call goes on. FLOE_MISSED_BAR: all done and
 * written, and the message names what was required and not reached, and the cases without a result of which the deck says nothing. */
floe_status study_run(study **out, context *ctx, const study_options *options);
void study_destroy(study **s);

/* ---- before anything runs ---- */

typedef struct study_rehearsal {
    size_t cases;    /* of the study */
    size_t set_up;   /* those that were made ready */
    size_t foreseen; /* those that cannot start, as study.refuse says */
    size_t refused;  /* those that cannot start, of which it says nothing */
} study_rehearsal;

/* Plans a study, or a comparison, and sets its cases up: all of them where they are small, else the first and the last. A
 * case that cannot start, which the deck does not foresee, is warned of. Of the options `batch.deck`, `set`, `name`, `compare`,
 * `repeat` (-1), `stop` and `progress` count; `dir` is not touched. Errors: those of study_run's plan. */
floe_status study_rehearse(context *ctx, const study_options *options, study_rehearsal *out);

/* The table of the results, the orders, the limits, the answers and the bars. */
floe_status study_print(const study *s, FILE *file);

#endif
