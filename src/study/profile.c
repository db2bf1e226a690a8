#include "study/profile.h"

#include "base/memory.h"
#include "base/strbuf.h"
#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COLUMNS = 64, NAME = 64, UNIT = 32, LABEL = 128, MOST_POINTS = 400 /* of a curve in the figure */ };

/* A profile.csv: columns "sigma_r (Pa)" of numbers. */
typedef struct table {
    char name[MAX_COLUMNS][NAME], unit[MAX_COLUMNS][UNIT];
    int columns;
    double *value; /* by column; owned */
    size_t rows;
} table;

typedef struct drawing {
    context *ctx; /* not owned */
    const profile_source *source;
    table *table; /* n, owned */
    size_t n;
    const char *exact;
    bool dimensionless;
    strbuf rows;          /* of all sources; owned */
    plot_panel *panel;    /* owned */
    plot_series *series;  /* owned */
    char (*label)[LABEL]; /* of axes; owned */
    size_t n_panels, n_series, n_labels;
} drawing;

static void read_names(const char *text, table *t)
{
    while (*text && *text != '\n' && t->columns < MAX_COLUMNS) {
        const size_t field = strcspn(text, ",\n"), name = strcspn(text, " ,\n");
        (void)snprintf(t->name[t->columns], NAME, "%.*s", (int)name, text);
        if (field > name + 2)
            (void)snprintf(t->unit[t->columns], UNIT, "%.*s", (int)(field - name - 3), text + name + 2);
        t->columns++;
        text += field + (text[field] == ',');
    }
}

/* Stresses are shown in MPa. */
static bool is_large(const char *unit)
{
    return strcmp(unit, "Pa") == 0;
}

static void read_rows(const char *text, table *t)
{
    for (const char *end = strchr(text, '\n'); end; text = end + 1, end = strchr(text, '\n'), t->rows++) {
        const char *field = text;
        for (int k = 0; k < t->columns; k++) {
            char *stop;
            const double x = strtod(field, &stop);
            t->value[t->rows * (size_t)t->columns + (size_t)k] = stop == field ? (double)NAN : x;
            field = stop + strcspn(stop, ",\n");
            if (*field == ',') field++;
        }
    }
}

/* Rows to columns, with the units in which they are shown. */
static floe_status by_column(context *ctx, table *t)
{
    double *turned;
    TRY(memory_new(ctx, &turned, t->rows * (size_t)t->columns, sizeof *turned));
    for (int k = 0; k < t->columns; k++) {
        const double scale = is_large(t->unit[k]) ? 1e-6 : 1.0;
        for (size_t i = 0; i < t->rows; i++)
            turned[(size_t)k * t->rows + i] = scale * t->value[i * (size_t)t->columns + (size_t)k];
    }
    memory_free(ctx, &t->value);
    t->value = turned;
    return FLOE_OK;
}

/* The rows with the source's name and h before each; the names of the columns once. */
static void append_rows(strbuf *out, const profile_source *source, bool dimensionless, const char *text)
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

static floe_status read_table(drawing *f, const profile_source *source, table *t)
{
    context *ctx = f->ctx;
    char *text;
    size_t lines = 0;
    if (!file_exists(source->path)) return FLOE_OK;
    TRY(file_read(ctx, source->path, &text, NULL));
    append_rows(&f->rows, source, f->dimensionless, text);
    for (const char *c = strchr(text, '\n'); c; c = strchr(c + 1, '\n')) lines++;
    read_names(text, t);
    floe_status status = memory_new(ctx, &t->value, lines * (size_t)t->columns, sizeof *t->value);
    if (status == FLOE_OK && lines > 0) read_rows(strchr(text, '\n') + 1, t);
    memory_free(ctx, &text);
    return status == FLOE_OK ? by_column(ctx, t) : status;
}

/* -1 if there is none of that name. */
static int find_column(const table *t, const char *prefix, const char *name)
{
    char wanted[NAME + 16];
    (void)snprintf(wanted, sizeof wanted, "%s%s", prefix, name);
    for (int k = 0; k < t->columns; k++) {
        if (strcmp(t->name[k], wanted) == 0) return k;
    }
    return -1;
}

static int find_place(const table *t)
{
    const int r = find_column(t, "", "r");
    return r >= 0 ? r : find_column(t, "", "x");
}

static void add_series(drawing *f, const table *t, int x, int y, plot_series like)
{
    like.x = &t->value[(size_t)x * t->rows];
    like.y = &t->value[(size_t)y * t->rows];
    like.n = t->rows;
    f->series[f->n_series++] = like;
    f->panel[f->n_panels].n_series++;
}

static void write_label(const table *t, int column, char label[LABEL])
{
    const char *unit = is_large(t->unit[column]) ? "MPa" : strcmp(t->unit[column], "1") == 0 ? "" : t->unit[column];
    (void)snprintf(label, LABEL, "%s%s%s%s", t->name[column], unit[0] ? " (" : "", unit, unit[0] ? ")" : "");
}

/* One quantity: as it is exactly, at the places of the finest table, and in every source. */
static void add_panel(drawing *f, const table *finest, int column)
{
    plot_panel *panel = &f->panel[f->n_panels];
    char *x_label = f->label[f->n_labels++], *y_label = f->label[f->n_labels++];
    const char *name = finest->name[column];
    write_label(finest, find_place(finest), x_label);
    write_label(finest, column, y_label);
    *panel = (plot_panel){.series = &f->series[f->n_series], .x_label = x_label, .y_label = y_label};
    add_series(f, finest, find_place(finest), find_column(finest, "exact_", name),
               (plot_series){.name = f->exact, .style = PLOT_LINES, .emphasis = true});
    for (size_t i = 0; i < f->n; i++) {
        const table *t = &f->table[i];
        const int x = find_place(t), y = find_column(t, "", name);
        if (x < 0 || y < 0) continue;
        add_series(f, t, x, y,
                   (plot_series){.name = f->source[i].name, .style = PLOT_POINTS, .colour = f->source[i].colour});
    }
    f->n_panels++;
}

static void add_panels(drawing *f, const table *finest)
{
    if (find_place(finest) < 0) return;
    for (int k = 0; k < finest->columns; k++) {
        if (find_column(finest, "exact_", finest->name[k]) >= 0) add_panel(f, finest, k);
    }
}

floe_status figure_write(context *ctx, const char *dir, const plot_figure *figure, bool *missing)
{
    TRY(plot_write_data(ctx, dir, figure));
    return *missing ? FLOE_OK : plots_draw(ctx, dir, figure, 1, missing);
}

static floe_status draw(drawing *f, const char *dir, bool *missing)
{
    const size_t most = (f->n + 1) * MAX_COLUMNS;
    const table *finest = NULL;
    char path[4096];
    for (size_t i = 0; i < f->n; i++) {
        TRY(read_table(f, &f->source[i], &f->table[i]));
        if (f->table[i].rows > (finest ? finest->rows : 0)) finest = &f->table[i];
    }
    if (!finest) return FLOE_OK;
    TRY(f->rows.status);
    (void)snprintf(path, sizeof path, "%s/profiles.csv", dir);
    TRY(file_replace_text(f->ctx, path, strbuf_string(&f->rows)));
    TRY(memory_new(f->ctx, &f->panel, MAX_COLUMNS, sizeof *f->panel));
    TRY(memory_new(f->ctx, &f->series, most, sizeof *f->series));
    TRY(memory_new(f->ctx, &f->label, 2 * MAX_COLUMNS, sizeof *f->label));
    add_panels(f, finest);
    if (f->n_panels == 0) return FLOE_OK;
    const plot_figure figure = {.name = "profile",
                                .columns = f->n_panels > 1 ? 2 : 1,
                                .most = MOST_POINTS,
                                .panel = f->panel,
                                .n_panels = f->n_panels};
    return figure_write(f->ctx, dir, &figure, missing);
}

floe_status profile_draw(context *ctx, const char *dir, const char *exact, const profile_source *source, size_t n,
                         bool dimensionless, bool *missing)
{
    drawing f = {.ctx = ctx, .source = source, .n = n, .exact = exact, .dimensionless = dimensionless};
    strbuf_init(&f.rows, ctx);
    TRY(memory_new(ctx, &f.table, n, sizeof *f.table));
    const floe_status status = draw(&f, dir, missing);
    for (size_t i = 0; i < n; i++) memory_free(ctx, &f.table[i].value);
    memory_free(ctx, &f.table);
    strbuf_free(&f.rows);
    memory_free(ctx, &f.panel);
    memory_free(ctx, &f.series);
    memory_free(ctx, &f.label);
    return status;
}
