/* Results as a table: each cell is given once, with its column, and written for people, as CSV and as JSON.
 *
 * Rows have the same columns in the same order; the first row names them. Once memory is out the rest do nothing, and what
 * is written last says so. */
#ifndef STUDY_TABLE_H
#define STUDY_TABLE_H

#include "base/json_value.h"
#include "base/strbuf.h"
#include "scene/batches.h"

/* Where a column stands; 0: nowhere. */
enum { TABLE_SHOWN = 1, TABLE_CSV = 2, TABLE_JSON = 4, TABLE_FILES = 6, TABLE_ALL = 7 };
enum { TABLE_MOST = 256 /* columns for people; those beyond are not shown */ };

typedef struct table_column {
    unsigned in;
    const char *unit;    /* of CSV, as in "time (s)"; NULL or "": none */
    const char *object;  /* member of the row's JSON that the cell is in; NULL: the row itself */
    const char *heading; /* for people; NULL: its name */
    const char *format;  /* of a double, for people; NULL: "%.6g" */
    int width;           /* for people, at least */
    bool left;           /* for people, else to the right */
    bool
        names; /* with others before it, it names the row: people see it beside all columns, if these need several sheets */
    bool quoted; /* texts of CSV */
    int digits;  /* of numbers in CSV; 0: all */
} table_column;

typedef struct table {
    context *ctx;                  /* not owned */
    strbuf names, rows;            /* of CSV */
    strbuf headings, shown;        /* texts for people, each with a NUL, a line ending with a newline */
    json_t *list, *row;            /* of JSON; the row is in the list */
    size_t n_rows, n_csv, n_shown; /* n_csv, n_shown: cells of this row so far */
    size_t n_names;                /* columns that name the rows */
    bool ended;                    /* of this row people see no more */
    int width[TABLE_MOST];
    bool left[TABLE_MOST];
} table;

void table_init(table *t, context *ctx);
void table_free(table *t);

/* Begins the next row. */
void table_row(table *t);
/* The next cell of the row, in the column of that name. */
void table_text(table *t, const char *name, table_column c, const char *text);
void table_number(table *t, const char *name, table_column c, double x);
/* A number that people see as this text. */
void table_number_as(table *t, const char *name, table_column c, double x, const char *shown);
void table_whole(table *t, const char *name, table_column c, long long n);
void table_flag(table *t, const char *name, table_column c, bool on); /* "yes" and "no" in CSV */
/* Any value, of JSON alone; it is given over. */
void table_value(table *t, const char *name, table_column c, json_t *value);
/* The values of the axes at these indices: `c` has what their columns have in common. */
void table_values(table *t, table_column c, const scene_axis *axis, int n, const int *pick);
/* A text with which the row ends for people. */
void table_last(table *t, const char *text);

/* A line of headings, then a line a row. On a terminal that is not as wide, columns that do not fit follow below, beside the names of
 * the rows again. */
floe_status table_print(const table *t, FILE *file);
/* The same at a given width in columns; 0: any. */
floe_status table_print_at(const table *t, FILE *file, int width);
/* Replaces DIR/STEM.csv. */
floe_status table_write_csv(const table *t, const char *dir, const char *stem);
/* [{name: value, ...}, ...], which the caller owns; NULL when memory is out. */
json_t *table_json(const table *t);

#endif
