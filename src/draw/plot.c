/* A figure's three files. */
#include "draw/plot.h"

#include "base/memory.h"
#include "draw/gnuplot.h"
#include "draw/plot_internal.h"
#include "io/file.h"

#include <ctype.h>
#include <string.h>

void plot_stem(const char *text, char stem[PLOT_STEM])
{
    size_t n = 0;
    bool solid = false;
    for (; *text && n < PLOT_STEM - 1; text++) {
        const bool fits = isalnum((unsigned char)*text) || strchr("._-", *text);
        stem[n] = *text;
        if (!fits) stem[n] = '_';
        /* A dot or a dash at the front would hide the file, or make it an option. */
        if (n == 0 && (stem[n] == '.' || stem[n] == '-')) stem[n] = '_';
        solid = solid || stem[n] != '.';
        n++;
    }
    stem[n] = '\0';
    if (!solid) (void)snprintf(stem, PLOT_STEM, "plot");
}

/* Writes DIR/STEM.EXTENSION. */
static floe_status write_text(context *ctx, const char *dir, const char *stem, const char *extension,
                              const strbuf *text)
{
    strbuf path;
    TRY(text->status);
    strbuf_init(&path, ctx);
    strbuf_append(&path, "%s/%s.%s", dir, stem, extension);
    floe_status status = path.status;
    if (status == FLOE_OK) status = file_replace_text(ctx, strbuf_string(&path), strbuf_string(text));
    strbuf_free(&path);
    return status;
}

/* An earlier picture must not stand beside newer data. */
static floe_status remove_picture(context *ctx, const char *dir, const char *stem)
{
    strbuf path;
    strbuf_init(&path, ctx);
    strbuf_append(&path, "%s/%s.svg", dir, stem);
    const floe_status status = path.status == FLOE_OK ? file_remove(ctx, strbuf_string(&path)) : path.status;
    strbuf_free(&path);
    return status;
}

static floe_status write_both(context *ctx, const char *dir, const plot_figure *figure)
{
    char stem[PLOT_STEM];
    strbuf csv, script;
    plot_stem(figure->name, stem);
    strbuf_init(&csv, ctx);
    strbuf_init(&script, ctx);
    plot_append_csv(&csv, figure);
    plot_append_script(&script, figure, stem);
    floe_status status = write_text(ctx, dir, stem, "csv", &csv);
    if (status == FLOE_OK) status = write_text(ctx, dir, stem, "gp", &script);
    strbuf_free(&script);
    strbuf_free(&csv);
    return status;
}

floe_status plot_write_data(context *ctx, const char *dir, const plot_figure *figure)
{
    char stem[PLOT_STEM];
    plot_thin thin;
    plot_stem(figure->name, stem);
    TRY(folder_make(ctx, dir));
    TRY(remove_picture(ctx, dir, stem));
    floe_status status = plot_thin_make(&thin, ctx, figure);
    if (status == FLOE_OK) status = write_both(ctx, dir, &thin.figure);
    plot_thin_free(&thin, ctx);
    return status;
}

static floe_status draw_figures(context *ctx, const char *dir, const plot_figure *figure, size_t n, const char **script,
                                char (*name)[PLOT_STEM + 4], bool *missing)
{
    char stem[PLOT_STEM];
    for (size_t i = 0; i < n; i++) {
        plot_stem(figure[i].name, stem);
        (void)snprintf(name[i], sizeof name[i], "%s.gp", stem);
        script[i] = name[i];
    }
    /* What fails has no picture, and a warning. */
    if (gnuplot_run(ctx, dir, script, n) == GNUPLOT_MISSING) *missing = true;
    for (size_t i = 0; i < n; i++) {
        plot_stem(figure[i].name, stem);
        TRY(plot_finish_svg(ctx, dir, stem, figure[i].title));
    }
    return FLOE_OK;
}

floe_status plots_draw(context *ctx, const char *dir, const plot_figure *figure, size_t n, bool *missing)
{
    const char **script = NULL;
    char(*name)[PLOT_STEM + 4] = NULL;
    if (n == 0) return FLOE_OK;
    floe_status status = memory_new(ctx, &script, n, sizeof *script);
    if (status == FLOE_OK) status = memory_new(ctx, &name, n, sizeof *name);
    if (status == FLOE_OK) status = draw_figures(ctx, dir, figure, n, script, name, missing);
    memory_free(ctx, &name);
    memory_free(ctx, &script);
    return status;
}

floe_status plots_write(context *ctx, const char *dir, const plot_figure *figure, size_t n)
{
    bool missing = false;
    for (size_t i = 0; i < n; i++) TRY(plot_write_data(ctx, dir, &figure[i]));
    return plots_draw(ctx, dir, figure, n, &missing);
}

floe_status plot_write(context *ctx, const char *dir, const plot_figure *figure)
{
    return plots_write(ctx, dir, figure, 1);
}
