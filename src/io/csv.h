/* Tables of CSV as floe writes them: a line of names with units, then rows. Fields in quotes may hold commas. */
#ifndef IO_CSV_H
#define IO_CSV_H

#include "base/context.h"

enum { CSV_NAME = 160 };

typedef struct csv_column {
    char name[CSV_NAME]; /* "kinetic" of "kinetic (J)" */
    char unit[32];       /* "J"; "" where there is none or it is 1 */
    double *value;       /* one a row; NAN for what is no number; counted memory */
    const char **text;   /* one a row, into the table's text; counted memory */
} csv_column;

typedef struct csv_table {
    context *ctx;       /* not owned */
    char *text;         /* counted memory, owned */
    csv_column *column; /* n_columns, owned */
    size_t n_columns, n_rows;
} csv_table;

/* Reads a table; half a row at its end is left out. FLOE_IO when the file cannot be read; a file without names is an
 * empty table. csv_free afterwards, whatever it returns. */
floe_status csv_read(csv_table *t, context *ctx, const char *path);
/* The same of a text. */
floe_status csv_parse(csv_table *t, context *ctx, const char *text);
void csv_free(csv_table *t);
/* NULL if there is no column of that name. */
const csv_column *csv_find(const csv_table *t, const char *name);
/* Whether a line of names has a column of that name, with or without a unit. */
bool csv_names(const char *line, const char *name);

#endif
