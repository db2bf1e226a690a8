#include "io/history.h"

#include "base/memory.h"
#include "io/file.h"
#include "io/history_columns.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct history {
    context *ctx;     /* not owned */
    line_file file;   /* owned */
    double last_time; /* s */
};

/* The rows of `old` up to `keep_until`; half a row at the end is dropped. Rows are in the order of time. */
static void keep_rows(history *h, const char *row, double keep_until, strbuf *out)
{
    for (const char *end = strchr(row, '\n'); end; end = strchr(row, '\n')) {
        char *number_end;
        const double time = strtod(row, &number_end);
        if (number_end == row || !(time <= keep_until)) return;
        strbuf_append(out, "%.*s", (int)(end + 1 - row), row);
        h->last_time = time;
        row = end + 1;
    }
}

/* Appends what is kept of the file to `out`, which holds the line of names. */
static floe_status take_rows(history *h, const char *path, double keep_until, strbuf *out)
{
    char *old;
    if (!(keep_until > -(double)INFINITY) || !file_exists(path)) return FLOE_OK;
    TRY(file_read(h->ctx, path, &old, NULL));
    floe_status status = FLOE_OK;
    if (strncmp(old, strbuf_string(out), out->length) == 0) {
        keep_rows(h, old + out->length, keep_until, out);
        status = out->status;
    } else {
        status = fail(h->ctx, FLOE_BAD_INPUT,
                      "'%s' has other columns than this run writes: it is of another deck; move it away", path);
    }
    memory_free(h->ctx, &old);
    return status;
}

static floe_status begin_history(history *h, const sim *s, const char *path, double keep_until)
{
    strbuf content;
    strbuf_init(&content, h->ctx);
    floe_status status = history_names(s, &content);
    if (status == FLOE_OK) status = take_rows(h, path, keep_until, &content);
    if (status == FLOE_OK) status = file_replace_text(h->ctx, path, strbuf_string(&content));
    strbuf_free(&content);
    TRY(status);
    return line_file_open(&h->file, h->ctx, path);
}

floe_status history_open(history **out, const sim *s, const char *path, double keep_until)
{
    history *h;
    *out = NULL;
    TRY(memory_new(s->ctx, &h, 1, sizeof *h));
    h->ctx = s->ctx;
    h->last_time = -INFINITY;
    const floe_status status = begin_history(h, s, path, keep_until);
    if (status != FLOE_OK) history_close(&h);
    *out = h;
    return status;
}

void history_close(history **h)
{
    if (!h || !*h) return;
    context *ctx = (*h)->ctx;
    line_file_close(&(*h)->file);
    memory_free(ctx, h);
}

floe_status history_append(history *h, const sim *s, const history_row *row)
{
    strbuf values;
    strbuf_init(&values, h->ctx);
    floe_status status = history_values(s, row, &values);
    if (status == FLOE_OK) status = line_file_append(&h->file, strbuf_string(&values), values.length);
    strbuf_free(&values);
    if (status == FLOE_OK) h->last_time = row->totals->time;
    return status;
}

floe_status history_sync(history *h)
{
    return line_file_sync(&h->file);
}

bool history_is_removed(const history *h)
{
    struct stat about;
    return fstat(h->file.descriptor, &about) == 0 && about.st_nlink == 0;
}

double history_last_time(const history *h)
{
    return h->last_time;
}
