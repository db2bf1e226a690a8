/* Columns of history.csv against the scene's reference. The file is read back, so that the rows of earlier legs count
 * too. */
#include "base/memory.h"
#include "io/history_columns.h"
#include "run/measure.h"
#include "verify/history_metric.h"

#include <math.h>
#include <string.h>

floe_status measure_history_check(const sim *s)
{
    const scene_verify *v = &s->scene->verify;
    strbuf names;
    if (v->n_columns == 0) return FLOE_OK;
    strbuf_init(&names, s->ctx);
    floe_status status = history_names(s, &names);
    for (int i = 0; i < v->n_columns && status == FLOE_OK; i++) {
        if (csv_names(strbuf_string(&names), v->column[i].name)) continue;
        status = fail_key(s->ctx, KEY("verify", "history", v->column[i].quantity),
                          "this scene's history.csv has no column '%s'; it has %s", v->column[i].name,
                          strbuf_string(&names));
    }
    strbuf_free(&names);
    return status;
}

/* Rows of the history: times, and value[c * n + i] of column c; and expected[q * n + i] of quantity q. */
typedef struct history_table {
    size_t n;
    double *time, *value, *expected;
} history_table;

static void free_table(context *ctx, history_table *h)
{
    memory_free(ctx, &h->time);
    memory_free(ctx, &h->value);
    memory_free(ctx, &h->expected);
}

static double value_in(const csv_column *column, size_t row)
{
    return column ? column->value[row] : (double)NAN;
}

static floe_status take_rows(sim *s, const csv_table *rows, history_table *h)
{
    const scene_verify *v = &s->scene->verify;
    h->n = rows->n_rows;
    TRY(memory_new(s->ctx, &h->time, h->n, sizeof *h->time));
    TRY(memory_new(s->ctx, &h->value, h->n * (size_t)v->n_columns, sizeof *h->value));
    for (size_t i = 0; i < h->n; i++) h->time[i] = value_in(csv_find(rows, "time"), i);
    for (int c = 0; c < v->n_columns; c++) {
        const csv_column *column = csv_find(rows, v->column[c].name);
        for (size_t i = 0; i < h->n; i++) h->value[(size_t)c * h->n + i] = value_in(column, i);
    }
    return FLOE_OK;
}

static floe_status expect_history(sim *s, history_table *h)
{
    const scene_verify *v = &s->scene->verify;
    const reference_model *model = reference_find(v->reference);
    reference r;
    if (!model) return fail_key(s->ctx, KEY("verify", "reference"), "there is no reference '%s'", v->reference);
    TRY(memory_new(s->ctx, &h->expected, h->n * model->n_quantities, sizeof *h->expected));
    TRY(reference_create(s->ctx, model, v->reference_par, &r));
    const floe_status status = reference_series(s->ctx, &r, h->n, h->time, h->expected);
    reference_destroy(s->ctx, &r);
    return status;
}

static int column_of(const scene_verify *v, const char *quantity)
{
    for (int c = 0; c < v->n_columns; c++) {
        if (strcmp(v->column[c].quantity, quantity) == 0) return c;
    }
    return -1;
}

static floe_status add_errors(sim *s, const history_table *h, run_summary *r)
{
    const scene_verify *v = &s->scene->verify;
    const reference_model *model = reference_find(v->reference);
    for (int i = 0; i < v->n_metrics; i++) {
        const char *quantity;
        const history_metric_kind kind = history_metric_parse(v->metric[i], &quantity);
        const int c = column_of(v, quantity);
        if (kind == HISTORY_METRIC_COUNT || c < 0) continue;
        const double *expected = h->expected + reference_quantity_find(model, quantity) * h->n;
        TRY(summary_add_error(r, s->ctx, v->metric[i],
                              history_metric_value(kind, h->n, h->time, h->value + (size_t)c * h->n, expected)));
    }
    return FLOE_OK;
}

floe_status measure_history_rows(sim *s, const csv_table *rows, run_summary *r)
{
    history_table h = {0};
    if (s->scene->verify.n_columns == 0) return FLOE_OK;
    floe_status status = take_rows(s, rows, &h);
    if (status == FLOE_OK) status = expect_history(s, &h);
    if (status == FLOE_OK) status = add_errors(s, &h, r);
    free_table(s->ctx, &h);
    return status;
}

floe_status measure_history(sim *s, const char *path, run_summary *r)
{
    csv_table rows;
    if (s->scene->verify.n_columns == 0) return FLOE_OK;
    floe_status status = csv_read(&rows, s->ctx, path);
    if (status == FLOE_OK) status = measure_history_rows(s, &rows, r);
    csv_free(&rows);
    return status;
}
