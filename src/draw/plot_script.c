/* A figure as a gnuplot script that holds its data, and as CSV. */
#include "draw/plot_internal.h"

#include <math.h>
#include <string.h>

enum { PANEL_WIDTH = 400, PANEL_HEIGHT = 290, KEY_ROW = 19, TITLE_HEIGHT = 34, MAX_KEY = 46 /* bytes */ };

static const char *text_or_empty(const char *text)
{
    return text ? text : "";
}

/* In gnuplot's single quotes, which know no escapes; control characters become blanks. */
static void append_quoted(strbuf *out, const char *text, size_t most)
{
    strbuf_append(out, "'");
    for (size_t i = 0; text[i]; i++) {
        /* Cut only before a character of UTF-8, not within. */
        if (i >= most && ((unsigned char)text[i] & 0xC0) != 0x80) {
            strbuf_append(out, "…");
            break;
        }
        strbuf_append(out, text[i] == '\'' ? "''" : "%c", (unsigned char)text[i] < ' ' ? ' ' : text[i]);
    }
    strbuf_append(out, "'");
}

/* A label in a block of data: in double quotes, without what they would take for an end or an escape. */
static void append_label(strbuf *out, const char *text)
{
    strbuf_append(out, " \"");
    for (; *text; text++) {
        const char c = *text;
        strbuf_append(out, "%c", c == '"' ? '\'' : c == '\\' ? '/' : (unsigned char)c < ' ' ? ' ' : c);
    }
    strbuf_append(out, "\"");
}

static void append_block(strbuf *out, const plot_panel *panel, size_t p, size_t k)
{
    const plot_series *s = &panel->series[k];
    strbuf_append(out, "$p%zus%zu << EOD\n", p, k);
    for (size_t i = 0; i < s->n; i++) {
        if (plot_drawable(panel->log_x, s->x[i]) && plot_drawable(panel->log_y, s->y[i])) {
            strbuf_append(out, "%.9g %.9g", s->x[i], s->y[i]);
            if (s->label) append_label(out, text_or_empty(s->label[i]));
        }
        strbuf_append(out, "\n"); /* an empty line is a gap */
    }
    strbuf_append(out, "EOD\n");
}

static void append_blocks(strbuf *out, const plot_figure *f)
{
    for (size_t p = 0; p < f->n_panels; p++) {
        for (size_t k = 0; k < f->panel[p].n_series; k++) {
            if (plot_points(&f->panel[p], &f->panel[p].series[k]) > 0) append_block(out, &f->panel[p], p, k);
        }
    }
}

/* Columns of the key that the longest name leaves space for. */
static int key_columns(const plot_panel *panel, int *names)
{
    size_t longest = 1;
    *names = 0;
    for (size_t k = 0; k < panel->n_series; k++) {
        const plot_series *s = &panel->series[k];
        const size_t length = strlen(text_or_empty(s->name));
        if (length == 0 || plot_points(panel, s) == 0) continue;
        ++*names;
        if (length > longest) longest = length < MAX_KEY ? length : MAX_KEY;
    }
    const int columns = (PANEL_WIDTH - 20) / ((int)longest * 8 + 45);
    return columns < 1 ? 1 : columns;
}

/* Most rows of any panel's key: panels of one figure are equally high. */
static int key_rows(const plot_figure *f)
{
    int most = 0;
    for (size_t p = 0; p < f->n_panels; p++) {
        int names;
        const int columns = key_columns(&f->panel[p], &names), rows = (names + columns - 1) / columns;
        if (rows > most) most = rows;
    }
    return most;
}

/* Reference slopes start from one point in the corner that falling errors leave empty: the lower right one for slopes
 * that rise, the lower left one for those that fall. */
static void append_slopes(strbuf *out, const plot_panel *panel, const plot_axis *x, const plot_axis *y, int *plots)
{
    const double x_span = log10(x->hi / x->lo), y_span = log10(y->hi / y->lo);
    double steepest = 1.0;
    for (int i = 0; i < panel->n_slopes; i++) steepest = fmax(steepest, fabs(panel->slope[i]));
    const double length = fmin(0.3 * x_span, 0.35 * y_span / steepest);
    double label = 0.0;
    for (int i = 0; i < panel->n_slopes; i++) {
        const double side = panel->slope[i] < 0.0 ? -1.0 : 1.0;
        const double end = (side < 0.0 ? log10(x->lo) : log10(x->hi)) - side * 0.24 * x_span;
        const double foot = log10(y->lo) + 0.05 * y_span;
        const double top = foot + fabs(panel->slope[i]) * length;
        /* Labels keep a line's height apart. */
        label = i > 0 ? fmax(top, label + 0.07 * y_span) : top;
        strbuf_append(out,
                      "set label 'slope %.3g' at %.9g,%.9g %s offset %g,0 font ',11' textcolor rgb '" PLOT_INK "'\n",
                      panel->slope[i], pow(10.0, end), pow(10.0, label), side < 0.0 ? "right" : "left", 0.5 * side);
        strbuf_append(out, "$slope%d << EOD\n%.9g %.9g\n%.9g %.9g\nEOD\n", i, pow(10.0, end - side * length),
                      pow(10.0, foot), pow(10.0, end), pow(10.0, top));
    }
    strbuf_append(out, "plot ");
    for (int i = 0; i < panel->n_slopes; i++) {
        strbuf_append(out, "%s$slope%d using 1:2 with lines dt 2 lw 1.5 lc rgb '" PLOT_INK "' notitle",
                      (*plots)++ ? ", \\\n     " : "", i);
    }
}

/* Filled marks first, then open ones, as the palette comes round again. */
static int marker_of_colour(int colour)
{
    static const int filled[] = {7, 5, 9, 13, 11, 15, 2, 1}, open[] = {6, 4, 8, 12, 10, 14, 3, 1};
    return colour / PLOT_COLOURS % 2 == 0 ? filled[colour % PLOT_COLOURS] : open[colour % PLOT_COLOURS];
}

static void append_style(strbuf *out, const plot_series *s)
{
    static const char *const with[] = {"lines", "points", "linespoints", "fsteps"};
    const int colour = s->colour < 0 ? 0 : s->colour;
    strbuf_append(out, " with %s", with[s->style]);
    if (s->style != PLOT_POINTS)
        strbuf_append(out, " lw %g dt %d", s->emphasis ? 1.4 : 1.8, s->emphasis && s->style != PLOT_LINES ? 3 : 1);
    if (s->style == PLOT_POINTS || s->style == PLOT_LINES_POINTS)
        strbuf_append(out, " pt %d ps %g", s->emphasis ? 6 : marker_of_colour(colour), s->emphasis ? 1.5 : 0.7);
    strbuf_append(out, " lc rgb '%s'", s->emphasis ? PLOT_INK : plot_colour(colour, false));
}

static void append_series(strbuf *out, const plot_panel *panel, size_t p, size_t k, int *plots)
{
    const plot_series *s = &panel->series[k];
    if (plot_points(panel, s) == 0) return;
    strbuf_append(out, "%s$p%zus%zu using 1:2", (*plots)++ ? ", \\\n     " : "plot ", p, k);
    append_style(out, s);
    if (text_or_empty(s->name)[0]) {
        strbuf_append(out, " title ");
        append_quoted(out, s->name, MAX_KEY);
    } else {
        strbuf_append(out, " notitle");
    }
    if (!s->label) return;
    strbuf_append(
        out,
        ", \\\n     $p%zus%zu using 1:2:3 with labels left offset 0.6,0.5 noenhanced font ',11' textcolor rgb "
        "'" PLOT_INK "' notitle",
        p, k);
}

static void append_named(strbuf *out, const char *what, const char *text, const char *offset)
{
    strbuf_append(out, "set %s ", what);
    append_quoted(out, text_or_empty(text), 200);
    strbuf_append(out, " offset %s noenhanced textcolor rgb '" PLOT_INK "'\n", offset);
}

static void append_panel(strbuf *out, const plot_panel *panel, size_t p)
{
    plot_axis x, y;
    int names, plots = 0;
    plot_axes(panel, &x, &y);
    strbuf_append(out, "\nunset label\n");
    append_named(out, "title", panel->title, "0,-0.4");
    append_named(out, "xlabel", panel->x_label, "0,0.6");
    append_named(out, "ylabel", panel->y_label, "0.5,0");
    plot_append_axis(out, 'x', &x);
    plot_append_axis(out, 'y', &y);
    strbuf_append(out,
                  "set key bmargin center horizontal height 0.6 Left reverse noenhanced samplen 1.5 maxcols %d "
                  "textcolor rgb '" PLOT_INK "'\n",
                  key_columns(panel, &names));
    if (!x.any) {
        strbuf_append(out,
                      "set label 'no data' at graph 0.5,0.5 center textcolor rgb '" PLOT_INK "'\nplot NaN notitle\n");
        return;
    }
    if (panel->n_slopes > 0 && x.log && y.log) append_slopes(out, panel, &x, &y, &plots);
    for (size_t k = 0; k < panel->n_series; k++) append_series(out, panel, p, k, &plots);
    strbuf_append(out, "\n");
}

void plot_append_script(strbuf *out, const plot_figure *f, const char *stem)
{
    const size_t columns = f->columns < 1 ? 1 : (size_t)f->columns;
    const size_t rows = (f->n_panels + columns - 1) / columns;
    const bool titled = !f->untitled && text_or_empty(f->title)[0] != '\0';
    const int height = PANEL_HEIGHT + KEY_ROW * key_rows(f);
    strbuf_append(out, "# In this folder: gnuplot %s.gp\nreset session\nset encoding utf8\n", stem);
    append_blocks(out, f);
    strbuf_append(out,
                  "set terminal svg size %zu,%zu fixed font 'sans-serif,13' background rgb '" PLOT_PAPER "'\n"
                  "set output '%s.svg'\n",
                  columns * PANEL_WIDTH, rows * (size_t)height + (titled ? TITLE_HEIGHT : 0), stem);
    strbuf_append(out,
                  "set border 3 lc rgb '" PLOT_INK "'\nset grid lt 1 lw 1 dt 1 lc rgb '" PLOT_GRID "'\n"
                  "set multiplot layout %zu,%zu",
                  rows > 0 ? rows : 1, columns);
    if (titled) {
        strbuf_append(out, " title ");
        append_quoted(out, f->title, 200);
        strbuf_append(out, " noenhanced textcolor rgb '" PLOT_INK "'");
    }
    strbuf_append(out, "\n");
    for (size_t p = 0; p < f->n_panels; p++) append_panel(out, &f->panel[p], p);
    strbuf_append(out, "unset multiplot\nunset output\n");
}

static void append_series_rows(strbuf *out, const plot_panel *panel, const plot_series *s, int digits)
{
    for (size_t i = 0; i < s->n; i++) {
        strbuf_append_csv(out, text_or_empty(panel->title));
        strbuf_append(out, ",");
        strbuf_append_csv(out, text_or_empty(s->name));
        strbuf_append(out, ",%.*g,%.*g,", digits, s->x[i], digits, s->y[i]);
        if (s->label && s->label[i]) strbuf_append_csv(out, s->label[i]);
        strbuf_append(out, "\n");
    }
}

void plot_append_csv(strbuf *out, const plot_figure *f)
{
    strbuf_append(out, "panel,series,x,y,label\n");
    for (size_t p = 0; p < f->n_panels; p++) {
        for (size_t k = 0; k < f->panel[p].n_series; k++)
            append_series_rows(out, &f->panel[p], &f->panel[p].series[k], f->most > 0 ? 7 : 17);
    }
}
