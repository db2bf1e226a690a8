/* A figure's files. */
#include "plot/plot.h"

#include "base/json_value.h"
#include "base/memory.h"
#include "base/strbuf.h"
#include "io/file.h"
#include "io/file_replace.h"

static const char *text_or_empty(const char *text)
{
    return text ? text : "";
}

/* Writes DIR/NAME.EXTENSION, or with text NULL removes it. */
static floe_status write_figure_file(context *ctx, const char *dir, const char *name, const char *extension,
                                     const char *text)
{
    strbuf path;
    strbuf_init(&path, ctx);
    strbuf_append(&path, "%s/%s.%s", dir, name, extension);
    floe_status status = path.status;
    if (status == FLOE_OK)
        status = text ? file_replace_text(ctx, strbuf_string(&path), text) : file_remove(ctx, strbuf_string(&path));
    strbuf_free(&path);
    return status;
}

static void append_series_rows(strbuf *out, const plot_panel *panel, const plot_series *s)
{
    for (size_t i = 0; i < s->n; i++) {
        strbuf_append_csv(out, text_or_empty(panel->title));
        strbuf_append(out, ",");
        strbuf_append_csv(out, text_or_empty(s->name));
        strbuf_append(out, ",%.17g,%.17g,\n", s->x[i], s->y[i]);
    }
}

static floe_status write_rows(context *ctx, const char *dir, const plot_figure *figure)
{
    strbuf csv;
    strbuf_init(&csv, ctx);
    strbuf_append(&csv, "panel,series,x,y,label\n");
    for (size_t p = 0; p < figure->n_panels; p++) {
        for (size_t k = 0; k < figure->panel[p].n_series; k++)
            append_series_rows(&csv, &figure->panel[p], &figure->panel[p].series[k]);
    }
    const floe_status status =
        csv.status == FLOE_OK ? write_figure_file(ctx, dir, figure->name, "csv", strbuf_string(&csv)) : csv.status;
    strbuf_free(&csv);
    return status;
}

static json_t *describe_series(const plot_series *s)
{
    static const char *const styles[] = {"lines", "points", "linespoints", "steps"};
    json_t *out = json_object();
    const bool whole =
        json_put(out, "name", json_plain_text(text_or_empty(s->name))) &&
        json_put(out, "style", json_string(styles[s->style])) && json_put(out, "colour", json_integer(s->colour)) &&
        json_put(out, "emphasis", json_boolean(s->emphasis)) && json_put(out, "rows", json_integer((json_int_t)s->n));
    if (whole) return out;
    json_decref(out);
    return NULL;
}

static json_t *describe_panel(const plot_panel *p)
{
    json_t *out = json_object(), *series = json_array();
    bool whole = json_put(out, "title", json_plain_text(text_or_empty(p->title))) &&
                 json_put(out, "x_label", json_plain_text(text_or_empty(p->x_label))) &&
                 json_put(out, "y_label", json_plain_text(text_or_empty(p->y_label))) &&
                 json_put(out, "log_x", json_boolean(p->log_x)) && json_put(out, "log_y", json_boolean(p->log_y)) &&
                 json_put(out, "slopes", json_numbers(p->slope, (size_t)p->n_slopes));
    for (size_t k = 0; whole && k < p->n_series; k++)
        whole = json_array_append_new(series, describe_series(&p->series[k])) == 0;
    whole = json_put(out, "series", series) && whole;
    if (whole) return out;
    json_decref(out);
    return NULL;
}

static floe_status write_description(context *ctx, const char *dir, const plot_figure *figure)
{
    char *text;
    json_t *object = json_object(), *panels = json_array();
    bool whole = json_put(object, "schema", json_integer(1)) &&
                 json_put(object, "title", json_plain_text(text_or_empty(figure->title))) &&
                 json_put(object, "columns", json_integer(figure->columns < 1 ? 1 : figure->columns));
    for (size_t p = 0; whole && p < figure->n_panels; p++)
        whole = json_array_append_new(panels, describe_panel(&figure->panel[p])) == 0;
    whole = json_put(object, "panels", panels) && whole;
    if (!whole) {
        json_decref(object);
        return fail(ctx, FLOE_NO_MEMORY, "no memory for the description of a figure");
    }
    TRY(json_to_text(ctx, &text, object));
    const floe_status status = write_figure_file(ctx, dir, figure->name, "json", text);
    memory_free(ctx, &text);
    return status;
}

floe_status plot_write_data(context *ctx, const char *dir, const plot_figure *figure, plot_names *names)
{
    TRY(folder_make(ctx, dir));
    /* An earlier picture must not stand beside newer data. */
    TRY(write_figure_file(ctx, dir, figure->name, "svg", NULL));
    TRY(write_rows(ctx, dir, figure));
    TRY(write_description(ctx, dir, figure));
    if (names->n < PLOT_MAX_NAMES) names->name[names->n++] = figure->name;
    return FLOE_OK;
}

floe_status plots_draw(context *ctx, const char *dir, const plot_names *names)
{
    const char *argument[PLOT_MAX_NAMES + 2] = {"plots", dir};
    int exit_status = 0;
    if (names->n == 0) return FLOE_OK;
    for (size_t i = 0; i < names->n; i++) argument[2 + i] = names->name[i];
    const floe_status status = python_run(ctx, argument, names->n + 2, NULL, &exit_status);
    if (status == FLOE_NO_MEMORY) return status;
    if (status != FLOE_OK) {
        context_log(ctx, LOG_WARNING, "no plots in '%s', but their data: %s", dir, context_message(ctx));
        context_clear(ctx);
    } else if (exit_status != 0) {
        context_log(ctx, LOG_WARNING, "no plots in '%s', but their data", dir);
    }
    return FLOE_OK;
}
