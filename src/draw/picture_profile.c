/* One dimension: each quantity over x, cells as steps, points as dots. */
#include "draw/picture_internal.h"

#include <math.h>

enum { PANEL = 330, ABOVE = 58, KEY = 38, BELOW_PANEL = 46, BELOW_LAST = 84, SERIES = 6 };

/* Colours that the colour-blind can tell apart (M. Okabe and K. Ito 2008), for light and dark paper. */
static const uint32_t series_colour[2][SERIES] = {{0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0x8a6d00, 0x444b55},
                                                  {0x56b4e9, 0xff8a3d, 0x2fc79a, 0xe9a3c9, 0xf0e442, 0xc3c9d1}};

static uint32_t colour_of_series(const sketch *k, size_t n)
{
    return series_colour[k->p->dark][n % SERIES];
}

/* Series of a panel: the cells are number 0, bodies count from 1 on. */
static bool cells_in(const picture *p, int panel)
{
    return p->cells && p->cells->scale == panel;
}
static bool points_in(const picture *p, int panel, size_t body)
{
    return p->points[body].value && p->points[body].scale == panel;
}

static int series_in(const picture *p, int panel)
{
    int n = cells_in(p, panel);
    for (size_t i = 0; i < p->n_points; i++) n += points_in(p, panel, i);
    return n;
}

static double panel_head(const picture *p, int panel)
{
    return ABOVE + (series_in(p, panel) > 1 ? KEY : 0);
}

double picture_profile_height(const sketch *k)
{
    double height = BELOW_LAST - BELOW_PANEL;
    for (int n = 0; n < k->p->n_scales; n++) height += panel_head(k->p, n) + PANEL + BELOW_PANEL;
    return height;
}

static double profile_x(const sketch *k, frame f, double x)
{
    return f.x + f.width * (x - k->p->lower[0]) / (k->p->upper[0] - k->p->lower[0]);
}

static double profile_y(const scale *s, frame f, double v)
{
    return f.y + f.height * (s->upper - v) / (s->upper - s->lower);
}

/* A step a cell; where there is nothing, the line breaks. */
static void draw_steps(sketch *k, frame f, const scale *s)
{
    const picture_cells *c = k->p->cells;
    cairo_t *cr = k->paper.cr;
    bool drawing = false;
    canvas_colour(&k->paper, colour_of_series(k, 0));
    cairo_set_line_width(cr, 3 * k->paper.unit);
    for (int i = 0; i < c->n[0]; i++) {
        const double left = profile_x(k, f, c->lower[0] + i * c->spacing[0]);
        const double right = profile_x(k, f, c->lower[0] + (i + 1) * c->spacing[0]);
        const double y = profile_y(s, f, c->value[i]);
        if (!isfinite(y)) {
            drawing = false;
            continue;
        }
        if (drawing) {
            cairo_line_to(cr, left, y);
        } else {
            cairo_move_to(cr, left, y);
        }
        cairo_line_to(cr, right, y);
        drawing = true;
    }
    cairo_stroke(cr);
}

static void draw_dots(sketch *k, frame f, const scale *s, size_t body)
{
    const picture_points *points = &k->p->points[body];
    cairo_t *cr = k->paper.cr;
    const double radius = (points->n > 400 ? 2.5 : 4.5) * k->paper.unit;
    canvas_colour(&k->paper, colour_of_series(k, body + 1));
    for (size_t i = 0; i < points->n; i++) {
        const double x = profile_x(k, f, points->x[2 * i]), y = profile_y(s, f, points->value[i]);
        if (!isfinite(x) || !isfinite(y)) continue;
        cairo_arc(cr, x, y, radius, 0.0, 6.283185307179586);
        cairo_fill(cr);
    }
}

/* One name of the key with its mark; returns where the next one starts. */
static double draw_name(sketch *k, double x, double y, size_t series, const char *name)
{
    canvas *c = &k->paper;
    const double u = c->unit, most = c->width - MARGIN * u - x - 24 * u;
    if (most < 60 * u) return x;
    canvas_colour(c, colour_of_series(k, series));
    if (series == 0) {
        cairo_rectangle(c->cr, x, y - 10 * u, 18 * u, 4 * u);
    } else {
        cairo_arc(c->cr, x + 9 * u, y - 8 * u, 7 * u, 0.0, 6.283185307179586);
    }
    cairo_fill(c->cr);
    canvas_colour(c, c->ink);
    canvas_text_within(c, x + 26 * u, y, TICK_SIZE, false, ALIGN_LEFT, most, name);
    return x + 26 * u + fmin(most, canvas_text_width(c, TICK_SIZE, false, name)) + 26 * u;
}

static void draw_key(sketch *k, int panel, double y)
{
    const picture *p = k->p;
    double x = MARGIN * k->paper.unit;
    if (cells_in(p, panel)) x = draw_name(k, x, y, 0, "cells");
    for (size_t i = 0; i < p->n_points; i++) {
        if (points_in(p, panel, i)) x = draw_name(k, x, y, i + 1, p->points[i].name);
    }
}

/* Air above and below the curves. */
static scale with_margin(const sketch *k, int panel)
{
    scale s = k->value[panel];
    const double margin = 0.06 * (s.upper - s.lower);
    s.lower -= margin;
    s.upper += margin;
    return s;
}

static void draw_panel(sketch *k, int panel, frame f, bool last)
{
    const picture *p = k->p;
    cairo_t *cr = k->paper.cr;
    const scale s = with_margin(k, panel);
    char x_label[2 * SCALE_TEXT], label[2 * SCALE_TEXT];
    picture_label(x_label, p->axis[0], &k->axis[0]);
    picture_label(label, p->scale[panel].label, &s);
    cairo_save(cr);
    cairo_rectangle(cr, f.x, f.y, f.width, f.height);
    cairo_clip(cr);
    for (size_t i = 0; i < p->n_points; i++) {
        if (points_in(p, panel, i)) draw_dots(k, f, &s, i);
    }
    if (cells_in(p, panel)) draw_steps(k, f, &s);
    cairo_restore(cr);
    picture_draw_axes(k, f, &k->axis[0], last ? x_label : NULL, &s, NULL);
    canvas_colour(&k->paper, k->paper.ink);
    const double u = k->paper.unit;
    canvas_text_within(&k->paper, MARGIN * u, f.y - (panel_head(p, panel) - 34) * u, TEXT_SIZE, false, ALIGN_LEFT,
                       k->paper.width - 2 * MARGIN * u, label);
    if (series_in(p, panel) > 1) draw_key(k, panel, f.y - 12 * u);
}

void picture_draw_profile(sketch *k)
{
    const picture *p = k->p;
    const double u = k->paper.unit;
    double left = 0.0, y = picture_head_height(p) * u;
    for (int n = 0; n < p->n_scales; n++) {
        const scale s = with_margin(k, n);
        left = fmax(left, MARGIN + picture_tick_width(&s, PANEL));
    }
    for (int n = 0; n < p->n_scales; n++) {
        y += panel_head(p, n) * u;
        const frame f = {round(left * u), round(y), k->paper.width - round((left + MARGIN) * u), round(PANEL * u)};
        draw_panel(k, n, f, n == p->n_scales - 1);
        y += (PANEL + BELOW_PANEL) * u;
    }
}
