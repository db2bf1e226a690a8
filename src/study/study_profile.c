#include "study/profile.h"

#include "base/memory.h"
#include "base/strbuf.h"
#include "io/csv.h"
#include "io/file.h"
#include "study/curves.h"

#include <string.h>

enum { MAX_PANELS = 64 };

typedef struct drawing {
    context *ctx; /* not owned */
    const profile_source *source;
    csv_table *table; /* n, owned */
    size_t n;
    const char *exact;
    bool dimensionless;
    strbuf rows;   /* of all sources; owned */
    curves curves; /* owned */
} drawing;

/* Stresses are shown in MPa. */
static bool is_large(const char *unit)
{
    return strcmp(unit, "Pa") == 0;
}

static void show_units(csv_table *t)
{
    for (size_t k = 0; k < t->n_columns; k++)
        for (size_t i = 0; i < t->n_rows && is_large(t->column[k].unit); i++) t->column[k].value[i] *= 1e-6;
}

/* The rows with the source's name and h before each; the names of the columns once. */
static void append_profile_rows(strbuf *out, const profile_source *source, bool dimensionless, const char *text)
{
    const bool first = out->length == 0;
    bool names = true;
    for (const char *end = strchr(text, '\n'); end; text = end + 1, end = strchr(text, '\n')) {
        if (names && first) strbuf_append(out, "group,h (%s),", dimensionless ? "1" : "m");
        if (!names) strbuf_append_csv(out, source->name);
        if (!names) strbuf_append(out, ",%.9g,", source->h);
        if (!names || first) strbuf_append(out, "%.*s", (int)(end + 1 - text), text);
        names = false;
    }
}

static floe_status read_table(drawing *f, const profile_source *source, csv_table *t)
{
    char *text;
    if (!file_exists(source->path)) return FLOE_OK;
    TRY(file_read(f->ctx, source->path, &text, NULL));
    append_profile_rows(&f->rows, source, f->dimensionless, text);
    const floe_status status = csv_parse(t, f->ctx, text);
    memory_free(f->ctx, &text);
    show_units(t);
    return status;
}

/* NULL if there is none of that name. */
static const csv_column *find_column(const csv_table *t, const char *prefix, const char *name)
{
    char wanted[CSV_NAME + 16];
    (void)snprintf(wanted, sizeof wanted, "%s%s", prefix, name);
    return csv_find(t, wanted);
}

static const csv_column *find_position_column(const csv_table *t)
{
    const csv_column *r = csv_find(t, "r");
    return r ? r : csv_find(t, "x");
}

static void add_series(drawing *f, const csv_table *t, const csv_column *x, const csv_column *y, plot_series like)
{
    like.x = x->value;
    like.y = y->value;
    like.n = t->n_rows;
    curves_series(&f->curves, like);
}

static char *label_of(drawing *f, const csv_column *c)
{
    return curves_label(&f->curves, c->name, is_large(c->unit) ? "MPa" : c->unit);
}

/* One quantity: as it is exactly, at the positions of the finest table, and in every source. */
static void add_panel(drawing *f, const csv_table *finest, const csv_column *column, const csv_column *exact)
{
    char *x_label = label_of(f, find_position_column(finest)), *y_label = label_of(f, column);
    curves_panel(&f->curves, (plot_panel){.x_label = x_label, .y_label = y_label});
    add_series(f, finest, find_position_column(finest), exact,
               (plot_series){.name = f->exact, .style = PLOT_LINES, .emphasis = true});
    for (size_t i = 0; i < f->n; i++) {
        const csv_table *t = &f->table[i];
        const csv_column *x = find_position_column(t), *y = csv_find(t, column->name);
        if (!x || !y) continue;
        add_series(f, t, x, y,
                   (plot_series){.name = f->source[i].name, .style = PLOT_POINTS, .colour = f->source[i].colour});
    }
}

static void add_panels(drawing *f, const csv_table *finest)
{
    if (!find_position_column(finest)) return;
    for (size_t k = 0; k < finest->n_columns && f->curves.n_panels < MAX_PANELS; k++) {
        const csv_column *exact = find_column(finest, "exact_", finest->column[k].name);
        if (exact) add_panel(f, finest, &finest->column[k], exact);
    }
}

static floe_status write_profiles(drawing *f, const char *dir, plot_names *names)
{
    const csv_table *finest = NULL;
    char path[4096];
    for (size_t i = 0; i < f->n; i++) {
        TRY(read_table(f, &f->source[i], &f->table[i]));
        if (f->table[i].n_rows > (finest ? finest->n_rows : 0)) finest = &f->table[i];
    }
    if (!finest) return FLOE_OK;
    TRY(f->rows.status);
    (void)snprintf(path, sizeof path, "%s/profiles.csv", dir);
    TRY(file_replace_text(f->ctx, path, strbuf_string(&f->rows)));
    TRY(curves_make(&f->curves, f->ctx, MAX_PANELS, (f->n + 1) * MAX_PANELS, 0, 2 * MAX_PANELS));
    add_panels(f, finest);
    return curves_write(&f->curves, dir, (plot_figure){.name = "profile"}, names);
}

floe_status profile_write(context *ctx, const char *dir, const char *exact, const profile_source *source, size_t n,
                          bool dimensionless, plot_names *names)
{
    drawing f = {
        .ctx = ctx, .curves.ctx = ctx, .source = source, .n = n, .exact = exact, .dimensionless = dimensionless};
    strbuf_init(&f.rows, ctx);
    TRY(memory_new(ctx, &f.table, n, sizeof *f.table));
    const floe_status status = write_profiles(&f, dir, names);
    for (size_t i = 0; i < n; i++) csv_free(&f.table[i]);
    memory_free(ctx, &f.table);
    strbuf_free(&f.rows);
    curves_free(&f.curves);
    return status;
}
