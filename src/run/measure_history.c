/* Columns of history.csv against the scene's reference. The file is read back, so that the rows of earlier legs count
 * too. */
#include "base/memory.h"
#include "io/file.h"
#include "io/history_columns.h"
#include "run/measure.h"
#include "verify/history_metric.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The end of the cell that begins at `at`: its comma, newline or NUL. Quoted cells have no quotes inside. */
static const char *cell_end(const char *at)
{
    if (*at == '"') {
        const char *close = strchr(at + 1, '"');
        if (close) at = close + 1;
    }
    return at + strcspn(at, ",\n");
}

/* Number of the column called `name`, with or without " (unit)", in the line of names; -1 if there is none. */
static int find_column(const char *line, const char *name)
{
    const size_t length = strlen(name);
    for (int column = 0;; column++) {
        const char *end = cell_end(line);
        if ((size_t)(end - line) >= length && strncmp(line, name, length) == 0 &&
            (line + length == end || strncmp(line + length, " (", 2) == 0)) {
            return column;
        }
        if (*end != ',') return -1;
        line = end + 1;
    }
}

static double cell_number(const char *line, int column)
{
    for (; column > 0; column--) {
        const char *end = cell_end(line);
        if (*end != ',') return NAN;
        line = end + 1;
    }
    char *end;
    const double x = strtod(line, &end);
    return end == line ? (double)NAN : x;
}

/* The next line, NULL at the end. */
static const char *next_line(const char *line)
{
    const char *end = strchr(line, '\n');
    return end && end[1] ? end + 1 : NULL;
}

floe_status measure_history_check(const sim *s)
{
    const scene_verify *v = &s->scene->verify;
    strbuf names;
    if (v->n_columns == 0) return FLOE_OK;
    strbuf_init(&names, s->ctx);
    floe_status status = history_names(s, &names);
    for (int i = 0; i < v->n_columns && status == FLOE_OK; i++) {
        if (find_column(strbuf_string(&names), v->column[i].name) >= 0) continue;
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

static floe_status fill_table(sim *s, const char *text, history_table *h)
{
    const scene_verify *v = &s->scene->verify;
    for (const char *row = next_line(text); row; row = next_line(row)) h->n++;
    TRY(memory_new(s->ctx, &h->time, h->n, sizeof *h->time));
    TRY(memory_new(s->ctx, &h->value, h->n * (size_t)v->n_columns, sizeof *h->value));
    size_t i = 0;
    for (const char *row = next_line(text); row; row = next_line(row), i++) {
        h->time[i] = cell_number(row, find_column(text, "time"));
        for (int c = 0; c < v->n_columns; c++) {
            h->value[(size_t)c * h->n + i] = cell_number(row, find_column(text, v->column[c].name));
        }
    }
    return FLOE_OK;
}

static floe_status expect(sim *s, history_table *h)
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

floe_status measure_history_text(sim *s, const char *text, run_summary *r)
{
    history_table h = {0};
    if (s->scene->verify.n_columns == 0) return FLOE_OK;
    floe_status status = fill_table(s, text, &h);
    if (status == FLOE_OK) status = expect(s, &h);
    if (status == FLOE_OK) status = add_errors(s, &h, r);
    free_table(s->ctx, &h);
    return status;
}

floe_status measure_history(sim *s, const char *path, run_summary *r)
{
    char *text;
    if (s->scene->verify.n_columns == 0) return FLOE_OK;
    TRY(file_read(s->ctx, path, &text, NULL));
    const floe_status status = measure_history_text(s, text, r);
    memory_free(s->ctx, &text);
    return status;
}
