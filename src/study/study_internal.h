/* The parts of a study. Private to src/study. */
#ifndef STUDY_STUDY_PARTS_H
#define STUDY_STUDY_PARTS_H

#include "io/csv.h"
#include "study/judge.h"
#include "study/study.h"
#include "study/table.h"
#include "verify/richardson.h"

/* study_plan.c: axes, cases, groups; every case's deck is checked. */
floe_status study_make_plan(study *s);
batch_options study_batch_options(const study *s);
/* "h" for the mesh, else the key. */
const char *study_axis_name(const scene_axis *axis);
/* "h (m)", "h" of a dimensionless scene, or the key of `over`. */
const char *study_over_label(const study *s);

/* study_timing.c */
/* Fills the timings by what the runs themselves took. */
void study_take_times(study *s);
/* The timed runs after that, alone and on one thread, in DIR/timing. */
typedef struct study_timed {
    batch_case *list; /* n; owned by the caller */
    size_t *index;    /* of the case of each; likewise */
    size_t n;
    char dir[BATCH_PATH];
} study_timed;
/* Makes them the round's, whose batch is the study's. */
floe_status study_list_timed(study *s, study_timed *timed, case_round *round);
void study_take_timed(study *s, const study_timed *timed);
/* True if any timed run was disturbed. */
bool study_is_disturbed(const study *s);

/* study_columns.c */
/* Adds to `errors` each quantity that the histories of none of the couplings will have. */
floe_status study_check_columns(const study *s, strbuf *errors);

/* study_values.c: what the cases have come to. */
void study_take_values(study *s);
bool study_is_done(const study_case *one);
/* The error of a case that is done; NAN otherwise. */
double study_error(const study_case *one, const char *metric);

/* study_order.c */
typedef struct study_order {
    double h[SCENE_MAX_AXIS], value[SCENE_MAX_AXIS]; /* from the coarsest to the finest */
    size_t n;
    double order, standard_error; /* of the fit; NAN where nothing can be fitted */
    double pair[SCENE_MAX_AXIS];  /* n - 1 orders of neighbours; NAN where there is none */
} study_order;
/* Errors of a metric in a group over `over`. */
study_order study_order_of(const study *s, size_t group, const char *metric);
/* Values of a quantity in a group, and what they tend to; false where too few are there. `fit` is only filled from four values on
 * (fit->n > 0). */
typedef struct study_limit {
    study_order values; /* h and value alone */
    richardson limit;
    richardson_fit fit;
} study_limit;
bool study_limit_of(const study *s, size_t group, int quantity, study_limit *out);

/* study_front.c: error against cost. */
typedef enum study_cost { STUDY_SECONDS, STUDY_UPDATES, STUDY_H, STUDY_COSTS } study_cost;
double study_cost_of(const study_case *one, study_cost cost);
/* No other case has both a smaller error and a smaller cost. */
bool study_is_on_front(const study *s, size_t i, const char *metric, study_cost cost);

/* Cheapest ways to an error: of the groups that reach it, by interpolation between their own cases and never beyond. */
typedef struct study_answer {
    const char *metric;
    double target;
    size_t best, next;            /* groups; n_groups: none */
    double seconds, next_seconds; /* of processor time */
    double scatter, next_scatter; /* how far those may be off, as shares of them */
} study_answer;
enum { STUDY_MAX_TARGETS = 4 };
/* Relative errors below are those of the arithmetic: nothing is chosen by them. */
#define STUDY_ROUND_OFF 1e-9
/* The smallest error by which anything is chosen: above round-off, and above what the reference itself is good for. */
double study_least_level(const study *s, const char *metric);
/* The times of the best and the next overlap: none is the faster one. */
bool study_answer_is_close(const study_answer *a);
/* Answers for sensible targets of one metric; returns how many. */
int study_answers(const study *s, const char *metric, study_answer out[STUDY_MAX_TARGETS]);
void study_answer_text(const study *s, const study_answer *a, char *text, size_t size);

/* study_check.c: which cases are right. */
/* Fills verdict and why of all cases, after study_take_values. */
void study_judge(study *s);
bool study_has_verdicts(const study *s);
/* What a check looks at: an error, a drift of the run, or a column of its history. */
study_range study_range_of(const scene_check *check, const run_summary *errors, const run_summary *run,
                           const csv_table *history);
/* False: why says what the case breaks. */
bool study_keeps_to(const scene_check *check, study_range r, char why[BATCH_MESSAGE]);
/* "right", "refused", "wrong", "". */
const char *study_verdict_name(study_verdict verdict);
size_t study_count(const study *s, study_verdict verdict);
/* The deck's reason why this case may be refused; NULL if it gives none. */
const char *study_refusal_of(const study *s, const study_case *one);

/* study_spoil.c: which checks would let a wrong result pass. */
/* Fills unnoticed and excused of all cases that are right, after study_judge. */
floe_status study_spoil(study *s);
size_t study_count_unnoticed(const study *s);
/* "frozen doubled": what the checks of a case do not notice. */
void study_unnoticed_text(const study_case *one, char text[BATCH_MESSAGE]);
/* "solution", "bound", "blind", "refused", "wrong": by what a case is judged. */
const char *study_kind_name(const study_case *one);
/* Warns of words in study.unchanged that name nothing. */
void study_check_unchanged(const study *s, strbuf *errors);

/* study_bar.c: what the deck requires. */
/* Is the case one of those? The axis `over` counts only if `all` is set. */
bool study_belongs(const study *s, const study_case *one, const scene_where *where, bool all);
typedef struct study_bar_result {
    const scene_bar *bar;
    bool of_order;               /* else of an error */
    char where[2 * STUDY_LABEL]; /* group, or case */
    double value, limit;         /* NAN: could not be measured */
    bool met;
} study_bar_result;
/* The results of all bars: counted memory, owned by the caller. */
floe_status study_bars(const study *s, study_bar_result **out, size_t *n);
void study_bar_text(const study *s, const study_bar_result *r, char *text, size_t size);

/* study_miss.c: FLOE_MISSED_BAR with what the study has not reached, in words: bars that were missed; then cases that are wrong, or
 * that have not come to their end, and of which the deck does not say so (study.refuse). One of these is named on the last line. A
 * case that is out of time has what it was given. */
floe_status study_check_results(const study *s);

/* study_json.c, study_table.c, study_figure.c: study.json, study.csv, and the figures with their data; and all
 * of them. */
floe_status study_write(const study *s);
/* A row a case; the caller frees it. */
void study_case_table(const study *s, table *t);
floe_status study_write_json(const study *s);
floe_status study_write_csv(const study *s);
floe_status study_write_figures(const study *s);

#endif
