/* The cases of a comparison or a study as a report shows them. Private to src/study/report. */
#ifndef REPORT_CASE_LIST_H
#define REPORT_CASE_LIST_H

#include "report/page.h"

enum { CASE_MAX_METRICS = 16, CASE_MAX_VARIANTS = 64, CASE_MAX_AXES = 8 };

/* One case. The texts belong to the JSON that it was read of, or to the case itself. */
typedef struct case_entry {
    const struct json_t *run; /* its summary, with directory and axis */
    const char *status;       /* "done", "diverged", ... */
    const char *directory;
    const char *variant; /* all that tells it from others but the place on the curve: "mpm", "mpm, method.basis=gimp" */
    const char *value;   /* of what is varied along a curve: "0.05"; "" for nothing */
    double h;            /* m; NAN: unknown */
    double wall;    /* s, without outputs where that is known: the best of its timed runs, or that of its only one */
    double updates; /* of points and cells */
    bool disturbed; /* others used the machine while it was timed */
    int colour;     /* of its variant */
} case_entry;

typedef struct case_list {
    context *ctx;     /* not owned */
    case_entry *list; /* n, counted memory, owned */
    size_t n;
    const char *metric[CASE_MAX_METRICS]; /* those that any case has, of the JSON */
    int n_metrics;
    const char *variant[CASE_MAX_VARIANTS]; /* the distinct ones, in their order */
    int n_variants;
    const char *quantity[CASE_MAX_METRICS]; /* of the history's end, that are extrapolated */
    int n_quantities;
    const char *axes[CASE_MAX_AXES]; /* the keys that are varied */
    int n_axes;
    const char *axis;   /* what is varied along a curve: "domain.cell"; "" for nothing */
    bool dimensionless; /* its scene has `units: none` */
    bool along_h;       /* the axis is the spacing */
    bool along_value;   /* the axis is another number */
} case_list;

/* Takes the cases of compare.json. case_list_free afterwards, whatever is returned. */
floe_status case_list_read(case_list *c, context *ctx, const struct json_t *object);
void case_list_free(case_list *c);

/* Where a case stands on the axis; NAN when that is no number. */
double case_place(const case_list *c, const case_entry *e);
/* True when the run came to its end. */
bool case_is_done(const case_entry *e);
/* The case's error of that name if the run came to its end, else NAN. */
double case_error(const case_entry *e, const char *metric);
/* The case's value of a key, "" if none. */
const char *case_setting(const case_entry *e, const char *key);
/* "mpm, domain.cell = 0.05" */
void case_title(const case_list *c, const case_entry *e, char title[PAGE_TEXT]);
/* The cases that no other beats in both error and run time, by rising run time; returns how many. front: space for n,
 * gets their numbers in the list. */
size_t case_front(const case_list *c, const char *metric, size_t *front);

/* Plots of each metric over spacing, run time and updates, and of each quantity over spacing. */
floe_status case_plots(page *p, const case_list *c, const char *stem);
/* "Least eq13: 2.1 % by ..."; false, and nothing, where no case has that error. */
bool case_say_least(const case_list *c, const char *metric, strbuf *out);
/* The table of the cases, each row with a link to NAME-i. */
void case_table(const case_list *c, const char *name, strbuf *out);

#endif
