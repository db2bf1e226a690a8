/* Columns of numbers in a file of comma-separated values beside the deck. Private to src/deck. */
#ifndef DECK_CSV_COLUMNS_H
#define DECK_CSV_COLUMNS_H

#include "deck/schema/schema.h"

/* The file's first line names its columns, each with its unit in brackets, or without one: then its numbers are SI. Lines that begin with # are
 * passed over. */
typedef struct csv_columns {
    const char *name[3]; /* of the columns that are read; NULL: the first, the second, the third of the file */
    int n;               /* columns that are read, 1 to 3 */
    int stride;          /* numbers from row to row of `value`, n at least */
    double *value;       /* as long as the scene lives; NULL: an error has been entered */
    size_t rows;
    const char *path; /* from the root of the file system */
} csv_columns;

/* Reads the file that a node names. What is wrong with it is entered at the node; `form`: what the node should be. */
floe_status read_csv_columns(reader *r, deck_node *node, const char *form, csv_columns *out);

#endif
