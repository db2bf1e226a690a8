/* The columns of the history, in one walk that makes both the first line and a row. */
#ifndef IO_HISTORY_COLUMNS_H
#define IO_HISTORY_COLUMNS_H

#include "base/strbuf.h"
#include "io/history.h"

/* Appends the line of names, or that of values, with its newline. `row` is not read for names. */
floe_status history_names(const sim *s, strbuf *out);
floe_status history_values(const sim *s, const history_row *row, strbuf *out);

#endif
