#include "study/table.h"

#include "base/wrapped.h"
#include "io/file.h"

#include <string.h>

void table_init(table *t, context *ctx)
{
    *t = (table){.ctx = ctx, .list = json_array()};
    strbuf_init(&t->names, ctx);
    strbuf_init(&t->rows, ctx);
    strbuf_init(&t->headings, ctx);
    strbuf_init(&t->shown, ctx);
}

void table_free(table *t)
{
    strbuf_free(&t->names);
    strbuf_free(&t->rows);
    strbuf_free(&t->headings);
    strbuf_free(&t->shown);
    json_decref(t->list);
}

/* ---- rows ---- */

void table_row(table *t)
{
    if (t->n_rows++ > 0) {
        strbuf_append(&t->rows, "\n");
        strbuf_append(&t->shown, "\n");
    }
    t->n_csv = t->n_shown = 0;
    t->ended = false;
    t->row = json_object();
    if (json_array_append_new(t->list, t->row) != 0) t->row = NULL;
}

static void append_csv(table *t, const char *name, const table_column *c, const char *text)
{
    const char *comma = t->n_csv++ > 0 ? "," : "";
    if (t->n_rows == 1) strbuf_append(&t->names, "%s%s", comma, name);
    if (t->n_rows == 1 && c->unit && c->unit[0]) strbuf_append(&t->names, " (%s)", c->unit);
    strbuf_append(&t->rows, "%s", comma);
    if (c->quoted)
        strbuf_append_csv(&t->rows, text);
    else
        strbuf_append(&t->rows, "%s", text);
}

static void append_json(table *t, const char *name, const table_column *c, json_t *value)
{
    json_t *to = t->row;
    if (c->object && !json_object_get(to, c->object)) (void)json_put(to, c->object, json_object());
    if (c->object) to = json_object_get(to, c->object);
    if (name[0])
        (void)json_put(to, name, value);
    else
        json_decref(value);
}

static void append_line(strbuf *line, const char *text, int *width)
{
    const int length = (int)strlen(text);
    if (length > *width) *width = length;
    strbuf_append_bytes(line, text, strlen(text) + 1);
}

static void append_shown(table *t, const char *name, const table_column *c, const char *text)
{
    if (t->n_shown == TABLE_MOST) return;
    int *width = &t->width[t->n_shown];
    if (t->n_rows == 1) {
        *width = c->width;
        if (c->names && t->n_names == t->n_shown) t->n_names++;
        t->left[t->n_shown] = c->left;
        append_line(&t->headings, c->heading ? c->heading : name, width);
    }
    if (!t->ended) append_line(&t->shown, text, width);
    t->n_shown++;
}

/* `value` is given over. */
static void add_cell(table *t, const char *name, const table_column *c, const char *csv, json_t *value,
                     const char *shown)
{
    if (c->in & TABLE_CSV) append_csv(t, name, c, csv);
    if (c->in & TABLE_SHOWN) append_shown(t, name, c, shown);
    if (c->in & TABLE_JSON)
        append_json(t, name, c, value);
    else
        json_decref(value);
}

void table_text(table *t, const char *name, table_column c, const char *text)
{
    add_cell(t, name, &c, text, json_plain_text(text), text);
}

void table_number_as(table *t, const char *name, table_column c, double x, const char *shown)
{
    char csv[32];
    (void)snprintf(csv, sizeof csv, "%.*g", c.digits > 0 ? c.digits : 17, x);
    add_cell(t, name, &c, csv, json_number(x), shown);
}

void table_number(table *t, const char *name, table_column c, double x)
{
    char shown[64];
    (void)snprintf(shown, sizeof shown, c.format ? c.format : "%.6g", x);
    table_number_as(t, name, c, x, shown);
}

void table_whole(table *t, const char *name, table_column c, long long n)
{
    char text[32];
    (void)snprintf(text, sizeof text, "%lld", n);
    add_cell(t, name, &c, text, json_integer((json_int_t)n), text);
}

void table_flag(table *t, const char *name, table_column c, bool on)
{
    const char *text = on ? "yes" : "no";
    add_cell(t, name, &c, text, json_boolean(on), text);
}

void table_value(table *t, const char *name, table_column c, json_t *value)
{
    append_json(t, name, &c, value);
}

void table_values(table *t, table_column c, const scene_axis *axis, int n, const int *pick)
{
    if (n == 0 && c.object) table_value(t, "", c, NULL);
    for (int k = 0; k < n; k++) table_text(t, axis[k].key, c, axis[k].value[pick[k]]);
}

void table_last(table *t, const char *text)
{
    strbuf_append_bytes(&t->shown, text, strlen(text) + 1);
    t->ended = true;
}

/* ---- what is written ---- */

/* Columns that stand side by side: those that name the rows, and the others from `from` to before `to`. */
typedef struct table_sheet {
    size_t from, to;
} table_sheet;

static bool is_in_sheet(const table *t, const table_sheet *sheet, size_t column)
{
    return column < t->n_names || (column >= sheet->from && column < sheet->to);
}

/* A line, without blanks at its end, of the texts from `at` to a newline or `end`; returns what is behind it. */
static const char *print_line(const table *t, const table_sheet *sheet, const char *at, const char *end, FILE *file)
{
    int blanks = 0;
    for (size_t k = 0; at < end && *at != '\n'; k++) {
        const int length = (int)strlen(at), rest = k < TABLE_MOST && length < t->width[k] ? t->width[k] - length : 0;
        const bool left = k < TABLE_MOST && t->left[k];
        const char *text = at;
        at += length + 1;
        if (!is_in_sheet(t, sheet, k)) continue;
        blanks += left ? 0 : rest;
        if (length > 0) {
            (void)fprintf(file, "%*s%s", blanks, "", text);
            blanks = 0;
        }
        blanks += (left ? rest : 0) + 2;
    }
    (void)fprintf(file, "\n");
    return at + 1;
}

/* The columns that fit beside the names, one at least; an empty last one takes no place. */
static table_sheet next_sheet(const table *t, size_t from, int width)
{
    table_sheet sheet = {from, from};
    int used = -2;
    for (size_t k = 0; k < t->n_names; k++) used += t->width[k] + 2;
    for (; sheet.to < t->n_shown; sheet.to++) {
        used += t->width[sheet.to] + 2;
        if (width > 0 && used > width && sheet.to > from && t->width[sheet.to] > 0) break;
    }
    return sheet;
}

floe_status table_print_at(const table *t, FILE *file, int width)
{
    TRY(t->headings.status);
    TRY(t->shown.status);
    const char *names = strbuf_string(&t->headings), *first = strbuf_string(&t->shown), *end = first + t->shown.length;
    size_t from = t->n_names;
    do {
        const table_sheet sheet = next_sheet(t, from, width);
        if (from > t->n_names) (void)fprintf(file, "\n");
        (void)print_line(t, &sheet, names, names + t->headings.length, file);
        for (const char *at = first; at < end;) at = print_line(t, &sheet, at, end, file);
        from = sheet.to;
    } while (from < t->n_shown);
    return ferror(file) ? fail(t->ctx, FLOE_IO, "cannot write the table") : FLOE_OK;
}

floe_status table_print(const table *t, FILE *file)
{
    return table_print_at(t, file, wrapped_width(file));
}

floe_status table_write_csv(const table *t, const char *dir, const char *stem)
{
    char path[4096];
    strbuf all;
    strbuf_init(&all, t->ctx);
    strbuf_append(&all, "%s\n%s%s", strbuf_string(&t->names), strbuf_string(&t->rows), t->n_rows > 0 ? "\n" : "");
    (void)snprintf(path, sizeof path, "%s/%s.csv", dir, stem);
    floe_status status = t->names.status != FLOE_OK ? t->names.status : t->rows.status;
    if (status == FLOE_OK) status = all.status;
    if (status == FLOE_OK) status = file_replace_text(t->ctx, path, strbuf_string(&all));
    strbuf_free(&all);
    return status;
}

json_t *table_json(const table *t)
{
    return json_incref(t->list);
}
