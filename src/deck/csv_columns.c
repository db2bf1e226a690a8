#include "deck/csv_columns.h"

#include "base/ordinary.h"
#include "deck/units.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { LINE = 1024, ROWS_MOST = 10000000 };

/* A file that is being read; columns are counted from 0. */
typedef struct csv_file {
    FILE *file;
    csv_columns *out;
    int column[3];
    double scale[3], shift[3]; /* from the unit of the head to SI */
    int heads;                 /* columns that the head names */
    bool dimensionless;        /* units of the head mean nothing to the deck */
    long line;
    char text[LINE];
    char fault[WHY_SIZE + 64]; /* what is wrong with it; "" so far */
} csv_file;

/* The next line that says something; false at the end, and where it does not fit. */
static bool next_csv_line(csv_file *t)
{
    while (fgets(t->text, sizeof t->text, t->file)) {
        t->line++;
        if (!strchr(t->text, '\n') && !feof(t->file)) {
            snprintf(t->fault, sizeof t->fault, "line %ld has more than %d characters", t->line, LINE - 2);
            return false;
        }
        const size_t blank = strspn(t->text, " \t\r\n");
        if (t->text[blank] != '\0' && t->text[blank] != '#') return true;
    }
    return false;
}

/* Cuts the first cell off a line: without the blanks about it, and of a head without its unit, as in "x (m)", which is *unit then (NULL: it
 * is no head). NULL: there is none left. */
static char *next_cell(char **rest, const char **unit)
{
    char *cell = *rest;
    if (!cell) return NULL;
    char *comma = strchr(cell, ',');
    *rest = comma ? comma + 1 : NULL;
    if (comma) *comma = '\0';
    char *bracket = unit ? strchr(cell, '(') : NULL;
    if (bracket) *bracket = '\0';
    if (unit) *unit = bracket ? bracket + 1 : "";
    cell += strspn(cell, " \t\"");
    size_t n = strlen(cell);
    while (n > 0 && strchr(" \t\r\n\"", cell[n - 1])) cell[--n] = '\0';
    return cell;
}

/* What the numbers of a column are to be multiplied by, and then added to, for SI: those of its unit, as it stands behind its bracket. */
static void read_head_unit(csv_file *t, const char *name, const char *bracket, int a)
{
    char unit[64], why[WHY_SIZE];
    double zero, one;
    expression_dimension ignored;
    const size_t length = strcspn(bracket, ")");
    t->scale[a] = 1.0;
    t->shift[a] = 0.0;
    (void)snprintf(unit, sizeof unit, "%.*s", (int)length, bracket);
    if (t->dimensionless || !unit[0] || strcmp(unit, "1") == 0 || strcmp(unit, "-") == 0) return;
    if (!units_to_si(unit, 0.0, &zero, &ignored, why) || !units_to_si(unit, 1.0, &one, &ignored, why)) {
        snprintf(t->fault, sizeof t->fault, "column '%.40s': %.140s", name, why);
        return;
    }
    t->scale[a] = one - zero;
    t->shift[a] = zero;
}

/* A head that is none. */
static void refuse_head(csv_file *t, const char *line)
{
    double x;
    const char *unit;
    char why[WHY_SIZE], first[64];
    const char *separator = strchr(line, ',') ? NULL : strpbrk(line, ";\t");
    (void)snprintf(first, sizeof first, "%.*s", (int)strcspn(line, ",;\t\r\n"), line);
    if (separator)
        snprintf(t->fault, sizeof t->fault, "its columns stand between %s: write commas, and decimals with a point",
                 *separator == ';' ? "semicolons" : "tabs");
    else if (number_split(first, &x, &unit, why))
        snprintf(t->fault, sizeof t->fault,
                 "its first line is '%.20s' and on, where names of columns belong: put a line as `t,p` above", first);
}

/* Finds the columns by their names. */
static void read_column_heads(csv_file *t)
{
    const csv_columns *out = t->out;
    for (int a = 0; a < 3; a++) t->column[a] = a < out->n && !out->name[a] ? a : -1;
    if (!next_csv_line(t)) {
        if (!t->fault[0]) snprintf(t->fault, sizeof t->fault, "it is empty");
        return;
    }
    static const char mark[] = "\xef\xbb\xbf"; /* of UTF-8, as spreadsheets put it before a text */
    char *rest = t->text + (strncmp(t->text, mark, strlen(mark)) == 0 ? strlen(mark) : 0);
    refuse_head(t, rest);
    const char *unit;
    int at = 0;
    for (const char *cell = next_cell(&rest, &unit); cell && !t->fault[0]; cell = next_cell(&rest, &unit), at++)
        for (int a = 0; a < out->n; a++) {
            if (out->name[a] && strcmp(cell, out->name[a]) == 0) t->column[a] = at;
            if (t->column[a] == at) read_head_unit(t, cell, unit, a);
        }
    t->heads = at;
    for (int a = 0; a < out->n && !t->fault[0]; a++)
        if (t->column[a] < 0)
            snprintf(t->fault, sizeof t->fault, "its first line names no column '%.60s'", out->name[a]);
}

static void read_csv_row(csv_file *t, double *row)
{
    char *rest = t->text;
    int at = 0, found = 0;
    for (const char *cell = next_cell(&rest, NULL); cell; cell = next_cell(&rest, NULL), at++) {
        if (at >= t->heads && cell[0]) {
            snprintf(t->fault, sizeof t->fault,
                     "line %ld has more columns than the first line names: write decimals with a point, 0.05, not 0,05",
                     t->line);
            return;
        }
        for (int a = 0; a < t->out->n; a++) {
            const char *unit;
            char why[WHY_SIZE];
            if (t->column[a] != at) continue;
            found++;
            if (!number_split(cell, &row[a], &unit, why) || unit[0] != '\0') {
                snprintf(t->fault, sizeof t->fault, "line %ld: '%.60s' is no number, without a unit", t->line, cell);
                return;
            }
            row[a] = row[a] * t->scale[a] + t->shift[a];
        }
    }
    if (found < t->out->n) snprintf(t->fault, sizeof t->fault, "line %ld has too few columns", t->line);
}

/* Counts the rows, then takes them. */
static floe_status read_csv_rows(reader *r, csv_file *t)
{
    size_t n = 0, row = 0;
    double *value;
    const long head = t->line, start = ftell(t->file);
    while (next_csv_line(t)) n++;
    if (n == 0 && !t->fault[0]) snprintf(t->fault, sizeof t->fault, "it has no row below its head");
    if (n > ROWS_MOST) snprintf(t->fault, sizeof t->fault, "it has more than %d rows", ROWS_MOST);
    if (t->fault[0]) return FLOE_OK;
    TRY(scene_allocate(r->scene, &value, (size_t)t->out->stride * n * sizeof *value));
    t->line = head;
    if (fseek(t->file, start, SEEK_SET) != 0)
        return fail(r->ctx, FLOE_IO, "cannot read '%s': %s", t->out->path, strerror(errno));
    while (row < n && next_csv_line(t) && !t->fault[0]) read_csv_row(t, value + (size_t)t->out->stride * row++);
    t->out->value = value;
    t->out->rows = row;
    return FLOE_OK;
}

floe_status read_csv_columns(reader *r, deck_node *node, const char *form, csv_columns *out)
{
    const char *special;
    out->value = NULL;
    TRY(resolve_path(r, node, &out->path));
    if (!out->path) return FLOE_OK;
    const int descriptor = ordinary_open(out->path, O_RDONLY, &special);
    if (descriptor < 0 && special)
        return bad(r, node, form, "cannot open '%s': it is %s, not an ordinary file", out->path, special);
    if (descriptor < 0) return bad(r, node, form, "cannot open '%s': %s", out->path, strerror(errno));
    csv_file t = {.file = fdopen(descriptor, "r"), .out = out, .dimensionless = r->scene->dimensionless};
    if (!t.file) {
        (void)close(descriptor);
        return fail(r->ctx, FLOE_NO_MEMORY, "no memory for '%s'", out->path);
    }
    read_column_heads(&t);
    const floe_status status = t.fault[0] ? FLOE_OK : read_csv_rows(r, &t);
    fclose(t.file);
    TRY(status);
    if (!t.fault[0]) return FLOE_OK;
    out->value = NULL;
    return bad(r, node, NULL, "'%s': %s", out->path, t.fault);
}
