/* Pieces of a page. All text is escaped here; the markup is HTML that is also well-formed XML. Private to
 * src/report. */
#ifndef REPORT_HTML_H
#define REPORT_HTML_H

#include "base/strbuf.h"

/* Formatted text, escaped. */
void html_text(strbuf *out, const char *format, ...) FLOE_PRINTF(2, 3);

/* A number with `digits` significant digits, its power of ten as people write it (1.3 x 10^-5); a dash for NAN. */
void html_number(strbuf *out, double value, int digits);
/* A whole number, its digits in groups of three. */
void html_count(strbuf *out, double value);
/* Seconds as "0.031 s", "12.3 s", "4 min 05 s", "2 h 10 min". */
void html_seconds(strbuf *out, double seconds);
/* Bytes as "12.3 MB". */
void html_bytes(strbuf *out, double bytes);
/* An error with its unit, of which a dimensionless scene has none but "%". */
void html_error(strbuf *out, const char *metric, double error, bool dimensionless);

/* "done", "diverged", ... in the colour of what it means. */
void html_status(strbuf *out, const char *status);

/* Starts and ends a list of facts, each a name and what follows. */
void html_facts_begin(strbuf *out);
void html_fact(strbuf *out, const char *name); /* then its content, then html_fact_end */
void html_fact_end(strbuf *out);
/* A whole fact; nothing where the text is empty, and more space where it is long. */
void html_fact_text(strbuf *out, const char *name, const char *text);
void html_facts_end(strbuf *out);

/* Starts a table in a box of its own that scrolls when the page is narrow; `names` are its columns, separated by '|';
 * those that begin with '#' hold numbers and are aligned to the right. */
void html_table_begin(strbuf *out, const char *names);
void html_table_end(strbuf *out);
void html_row_begin(strbuf *out);
void html_row_end(strbuf *out);
/* A cell of text. */
void html_cell(strbuf *out, const char *text);
/* Cells of a number as html_number, html_count and html_error show it, and of a status. */
void html_cell_number(strbuf *out, double value, int digits);
void html_cell_count(strbuf *out, double value);
void html_cell_error(strbuf *out, const char *metric, double error, bool dimensionless);
void html_cell_status(strbuf *out, const char *status);
/* Starts a cell of a number; ends with html_cell_end. */
void html_number_cell(strbuf *out);
void html_cell_end(strbuf *out);

/* A link that hands out data under a file name: the page holds it. */
void html_download(strbuf *out, const char *words, const char *name, const char *type, const char *data, size_t size);
/* A folded box, opened by its title; ends with html_fold_end. */
void html_fold_begin(strbuf *out, const char *title);
void html_fold_end(strbuf *out);
/* Text as it stands, in a box that scrolls. */
void html_verbatim(strbuf *out, const char *text);

#endif
