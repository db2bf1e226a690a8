/* Points over cells, in the plane. */
#include "draw/picture_internal.h"

#include "base/memory.h"

#include <math.h>

enum { TALLEST = 860, AXIS_NAME = 58, BELOW_AXIS = 78, SMALLEST = 2 /* px */ };

/* Where the domain is drawn, in units from the left and below the head; the same scale along both axes. */
static frame place_frame(const sketch *k)
{
    const double extent[2] = {k->p->upper[0] - k->p->lower[0], k->p->upper[1] - k->p->lower[1]};
    const double guess = fmin(TALLEST, 620 * extent[1] / extent[0]);
    const double left = MARGIN + picture_tick_width(&k->axis[1], guess);
    const double width = 720 - left - MARGIN;
    const double per_metre = fmin(width / extent[0], TALLEST / extent[1]);
    frame f = {.y = AXIS_NAME, .width = extent[0] * per_metre, .height = extent[1] * per_metre};
    f.x = left + 0.5 * (width - f.width);
    return f;
}

double picture_field_height(const sketch *k)
{
    return AXIS_NAME + place_frame(k).height + BELOW_AXIS + k->p->n_scales * picture_bar_height() + 8;
}

/* The cells as an image, a pixel each; row 0 is the top one. */
static void paint_pixels(const sketch *k, cairo_surface_t *image)
{
    const picture_cells *c = k->p->cells;
    const scale *s = &k->value[c->scale];
    const int stride = cairo_image_surface_get_stride(image);
    unsigned char *data = cairo_image_surface_get_data(image);
    for (int j = 0; j < c->n[1]; j++) {
        uint32_t *row = (void *)(data + (ptrdiff_t)stride * (c->n[1] - 1 - j));
        for (int i = 0; i < c->n[0]; i++) {
            const double v = c->value[(size_t)j * (size_t)c->n[0] + (size_t)i];
            const double t = (v - s->lower) / (s->upper - s->lower);
            row[i] = isfinite(v) ? 0xff000000U | colour_of(&k->map[c->scale], t) : 0;
        }
    }
    cairo_surface_mark_dirty(image);
}

/* px of a place in the domain. */
static double field_x(const sketch *k, frame f, double x)
{
    return f.x + f.width * (x - k->p->lower[0]) / (k->p->upper[0] - k->p->lower[0]);
}
static double field_y(const sketch *k, frame f, double y)
{
    return f.y + f.height * (k->p->upper[1] - y) / (k->p->upper[1] - k->p->lower[1]);
}

static floe_status draw_cells(sketch *k, frame f)
{
    const picture_cells *c = k->p->cells;
    cairo_t *cr = k->paper.cr;
    if (c->n[0] <= 0 || c->n[1] <= 0) return FLOE_OK;
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, c->n[0], c->n[1]);
    const floe_status status = canvas_check(&k->paper, cairo_surface_status(image));
    if (status == FLOE_OK) {
        const double px = c->spacing[0] * f.width / (k->p->upper[0] - k->p->lower[0]);
        paint_pixels(k, image);
        cairo_save(cr);
        cairo_translate(cr, field_x(k, f, c->lower[0]), field_y(k, f, c->lower[1] + c->n[1] * c->spacing[1]));
        cairo_scale(cr, px, c->spacing[1] * f.height / (k->p->upper[1] - k->p->lower[1]));
        cairo_set_source_surface(cr, image, 0, 0);
        cairo_pattern_set_filter(cairo_get_source(cr), px < 1.0 ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
        cairo_paint(cr);
        cairo_restore(cr);
    }
    cairo_surface_destroy(image);
    return status;
}

static uint32_t colour_of_point(const sketch *k, const picture_points *points, size_t i)
{
    const uint32_t none = k->p->dark ? 0x7d8590 : 0x9aa2ac;
    if (!points->value || !isfinite(points->value[i])) return none;
    const scale *s = &k->value[points->scale];
    return colour_of(&k->map[points->scale], (points->value[i] - s->lower) / (s->upper - s->lower));
}

/* A square as large as the point and half a pixel more on each side, so that points close up to a solid. */
static void draw_point(cairo_t *cr, double x, double y, double edge)
{
    const double side = fmax(SMALLEST, edge + 1.0);
    cairo_rectangle(cr, x - 0.5 * side, y - 0.5 * side, side, side);
    cairo_fill(cr);
}

static void draw_points(sketch *k, frame f, const picture_points *points)
{
    const double px = f.width / (k->p->upper[0] - k->p->lower[0]);
    for (size_t i = 0; i < points->n; i++) {
        const double x = points->x[2 * i], y = points->x[2 * i + 1], edge = points->edge[i] * px;
        if (!isfinite(x) || !isfinite(y) || !isfinite(edge)) continue;
        canvas_colour(&k->paper, colour_of_point(k, points, i));
        draw_point(k->paper.cr, field_x(k, f, x), field_y(k, f, y), edge);
    }
}

floe_status picture_draw_field(sketch *k)
{
    const picture *p = k->p;
    cairo_t *cr = k->paper.cr;
    const double u = k->paper.unit;
    char x_label[2 * SCALE_TEXT], y_label[2 * SCALE_TEXT];
    frame f = place_frame(k);
    f = (frame){round(f.x * u), round((f.y + picture_head_height(p)) * u), fmax(2.0, round(f.width * u)),
                fmax(2.0, round(f.height * u))};
    cairo_save(cr);
    cairo_rectangle(cr, f.x, f.y, f.width, f.height);
    cairo_clip(cr);
    if (p->cells) TRY(draw_cells(k, f));
    for (size_t i = 0; i < p->n_points; i++) draw_points(k, f, &p->points[i]);
    cairo_restore(cr);
    picture_label(x_label, p->axis[0], &k->axis[0]);
    picture_label(y_label, p->axis[1], &k->axis[1]);
    picture_draw_axes(k, f, &k->axis[0], x_label, &k->axis[1], y_label);
    for (int n = 0; n < p->n_scales; n++) {
        picture_draw_bar(k, n, f.y + f.height + (BELOW_AXIS + n * picture_bar_height()) * u);
    }
    return FLOE_OK;
}
