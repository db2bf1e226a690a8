#include "io/csv.h"

#include "base/memory.h"
#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Length of the field at the start of a text, with its quotes. */
static size_t field_length(const char *text)
{
    const char *at = text;
    for (bool quoted = false; *at && (quoted || (*at != ',' && *at != '\n')); at++) quoted = quoted != (*at == '"');
    return (size_t)(at - text);
}

/* Cuts the field at *at out of its row: an end is put behind it, quotes around it are left out. *at goes to what
 * follows; the return is the field, or NULL where the row has ended. */
static char *cut_field(char **at, bool *row_ends)
{
    char *const field = *at, *out = field;
    if (*row_ends) return NULL;
    char *const end = field + field_length(field);
    bool quoted = false;
    for (const char *in = field; in < end; in++) {
        const bool doubled = quoted && in[0] == '"' && in[1] == '"';
        if (*in == '"' && !doubled) {
            quoted = !quoted;
            continue;
        }
        in += doubled;
        *out++ = *in;
    }
    *row_ends = *end != ',';
    *at = *end ? end + 1 : end;
    *out = '\0';
    return field;
}

static size_t count_lines(const char *text)
{
    size_t n = 0;
    for (; *text; text++) n += *text == '\n';
    return n;
}

static size_t count_fields(const char *text)
{
    size_t n = 1;
    for (; text += field_length(text), *text == ','; text++) n++;
    return n;
}

/* "kinetic (J)" to name and unit. */
static void name_column(csv_column *c, const char *text)
{
    const char *open = strrchr(text, '(');
    const size_t length = strlen(text);
    const bool unit = open && open > text && length > 0 && text[length - 1] == ')';
    (void)snprintf(c->name, sizeof c->name, "%.*s", (int)(unit ? (size_t)(open - text) - 1 : length), text);
    if (unit && strcmp(open, "(1)") != 0)
        (void)snprintf(c->unit, sizeof c->unit, "%.*s", (int)(length - (size_t)(open - text) - 2), open + 1);
}

static floe_status make_columns(csv_table *t, size_t rows)
{
    TRY(memory_new(t->ctx, &t->column, t->n_columns, sizeof *t->column));
    for (size_t k = 0; k < t->n_columns; k++) {
        TRY(memory_new(t->ctx, &t->column[k].value, rows, sizeof(double)));
        TRY(memory_new(t->ctx, &t->column[k].text, rows, sizeof(char *)));
    }
    return FLOE_OK;
}

static void read_row(csv_table *t, char **at)
{
    bool row_ends = false;
    for (size_t k = 0; !row_ends; k++) {
        const char *field = cut_field(at, &row_ends);
        char *end;
        if (k >= t->n_columns) continue;
        t->column[k].text[t->n_rows] = field;
        const double value = strtod(field, &end);
        t->column[k].value[t->n_rows] = end == field || *end ? (double)NAN : value;
    }
}

static floe_status fill_table(csv_table *t)
{
    char *at = t->text, *last = strrchr(t->text, '\n');
    if (!last) return FLOE_OK;
    last[1] = '\0'; /* half a row, if there is one */
    const size_t rows = count_lines(t->text);
    t->n_columns = count_fields(t->text);
    TRY(make_columns(t, rows));
    bool row_ends = false;
    for (size_t k = 0; !row_ends; k++) name_column(&t->column[k], cut_field(&at, &row_ends));
    while (*at) {
        for (size_t k = 0; k < t->n_columns; k++) {
            t->column[k].value[t->n_rows] = NAN;
            t->column[k].text[t->n_rows] = "";
        }
        read_row(t, &at);
        t->n_rows++;
    }
    return FLOE_OK;
}

floe_status csv_read(csv_table *t, context *ctx, const char *path)
{
    *t = (csv_table){.ctx = ctx};
    TRY(file_read(ctx, path, &t->text, NULL));
    return fill_table(t);
}

floe_status csv_parse(csv_table *t, context *ctx, const char *text)
{
    const size_t size = strlen(text) + 1;
    *t = (csv_table){.ctx = ctx};
    TRY(memory_new(ctx, &t->text, size, 1));
    memcpy(t->text, text, size);
    return fill_table(t);
}

void csv_free(csv_table *t)
{
    for (size_t k = 0; t->column && k < t->n_columns; k++) {
        memory_free(t->ctx, &t->column[k].value);
        memory_free(t->ctx, &t->column[k].text);
    }
    memory_free(t->ctx, &t->column);
    memory_free(t->ctx, &t->text);
}

const csv_column *csv_find(const csv_table *t, const char *name)
{
    for (size_t k = 0; k < t->n_columns; k++) {
        if (strcmp(t->column[k].name, name) == 0) return &t->column[k];
    }
    return NULL;
}

bool csv_names(const char *line, const char *name)
{
    const size_t wanted = strlen(name);
    for (const char *at = line;; at++) {
        const size_t length = field_length(at);
        if (length >= wanted && strncmp(at, name, wanted) == 0 &&
            (length == wanted || strncmp(at + wanted, " (", 2) == 0))
            return true;
        at += length;
        if (*at != ',') return false;
    }
}
