/* What the cases have come to: errors, and the last values of columns of their histories. */
#include "study/study_internal.h"

#include "base/memory.h"
#include "io/file.h"
#include "run/run_errors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool study_is_done(const study_case *one)
{
    return one->run->state == BATCH_ENDED && one->run->ran && one->run->status == FLOE_OK;
}

double study_error(const study_case *one, const char *metric)
{
    return study_is_done(one) ? error_of(&one->run->summary, metric) : (double)NAN;
}

static bool is_listed(const study *s, const char *name)
{
    for (int k = 0; k < s->n_metrics; k++) {
        if (strcmp(s->metric[k], name) == 0) return true;
    }
    return false;
}

static void list_metrics(study *s)
{
    s->n_metrics = 0;
    for (size_t i = 0; i < s->n; i++) {
        const run_summary *r = &s->run[i].summary;
        for (int k = 0; s->run[i].ran && k < r->n_errors && s->n_metrics < STUDY_MAX_METRICS; k++) {
            if (!is_listed(s, r->errors[k].name)) s->metric[s->n_metrics++] = r->errors[k].name;
        }
    }
}

/* missing[q]: the history has no such column. */
static void read_quantities(const study *s, study_case *one, bool *missing)
{
    char path[BATCH_PATH];
    csv_table history;
    (void)snprintf(path, sizeof path, "%s/%s/history.csv", s->options->batch.dir, one->run->folder);
    if (csv_read(&history, s->ctx, path) != FLOE_OK) context_clear(s->ctx);
    for (int q = 0; q < s->plan.n_quantities && history.text; q++) {
        const csv_column *column = csv_find(&history, s->plan.quantity[q]);
        missing[q] = missing[q] || !column;
        if (column && history.n_rows > 0) one->quantity[q] = column->value[history.n_rows - 1];
    }
    csv_free(&history);
}

void study_take_values(study *s)
{
    bool missing[SCENE_MAX_METRICS] = {false};
    list_metrics(s);
    for (size_t i = 0; i < s->n; i++) {
        study_case *one = &s->list[i];
        for (int q = 0; q < SCENE_MAX_METRICS; q++) one->quantity[q] = NAN;
        if (study_is_done(one) && s->plan.n_quantities > 0) read_quantities(s, one, missing);
    }
    for (int q = 0; q < s->plan.n_quantities; q++) {
        if (missing[q])
            context_log(s->ctx, LOG_WARNING, "quantity '%s' is no column of history.csv: its first line names them",
                        s->plan.quantity[q]);
    }
}
