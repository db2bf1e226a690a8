#include "draw/picture_internal.h"

#include <math.h>
#include <string.h>

enum { TITLE_LINE = 38 /* characters */, TITLE_HEIGHT = 42 };

static floe_status add_values(context *ctx, const picture *p, int k, scale_sample *sample)
{
    const picture_cells *c = p->cells;
    if (c && c->scale == k) TRY(scale_sample_add(sample, ctx, c->value, (size_t)c->n[0] * (size_t)c->n[1]));
    for (size_t i = 0; i < p->n_points; i++) {
        const picture_points *points = &p->points[i];
        if (points->value && points->scale == k) TRY(scale_sample_add(sample, ctx, points->value, points->n));
    }
    return FLOE_OK;
}

static floe_status choose_scale(context *ctx, const picture *p, int k, scale *s)
{
    const picture_scale *wanted = &p->scale[k];
    scale_sample sample = {0};
    const floe_status status = add_values(ctx, p, k, &sample);
    if (status == FLOE_OK) scale_from_sample(s, &sample, wanted->about_zero);
    if (wanted->lower < wanted->upper) {
        s->lower = wanted->lower;
        s->upper = wanted->upper;
        s->more_below = sample.met > 0 && sample.least < s->lower;
        s->more_above = sample.met > 0 && sample.most > s->upper;
    }
    scale_set_unit(s, wanted->unit);
    scale_sample_free(&sample, ctx);
    return status;
}

floe_status picture_range(context *ctx, const picture *p, int k, double *lower, double *upper)
{
    scale s = {0};
    TRY(choose_scale(ctx, p, k, &s));
    *lower = s.lower;
    *upper = s.upper;
    return FLOE_OK;
}

/* Colours say the sign where zero is in the middle. */
static bool shows_sign(const sketch *k, int n)
{
    const scale *s = &k->value[n];
    return k->p->scale[n].about_zero && fabs(s->lower + s->upper) <= 1e-9 * (s->upper - s->lower);
}

/* Two quantities of one picture never share a hue. */
static colour_kind choose_colours(const sketch *k, int n)
{
    const bool sign_elsewhere = k->p->n_scales == 2 && shows_sign(k, 1 - n);
    if (n == 1 && sign_elsewhere) return COLOUR_GREY;
    if (shows_sign(k, n)) return COLOUR_SIGNED;
    if (k->p->n_scales == 1) return COLOUR_SINGLE;
    if (n == 0) return sign_elsewhere ? COLOUR_GREY : COLOUR_WARM;
    return COLOUR_COOL;
}

/* Characters, not bytes. */
static size_t count_characters(const char *text)
{
    size_t n = 0;
    for (; *text; text++) n += ((unsigned char)*text & 0xc0) != 0x80;
    return n;
}

/* Where a title that is too long for a line is broken: at the last blank that a line holds; NULL: nowhere. */
static const char *title_break(const char *title)
{
    const char *best = NULL;
    size_t n = 0;
    if (!title || count_characters(title) <= TITLE_LINE) return NULL;
    for (const char *at = title; *at && n <= TITLE_LINE; at++) {
        if (*at == ' ' && at > title) best = at;
        n += ((unsigned char)*at & 0xc0) != 0x80;
    }
    return best;
}

double picture_head_height(const picture *p)
{
    const bool second = isfinite(p->time) || p->note;
    const int lines = p->title && p->title[0] ? 1 + (title_break(p->title) != NULL) : 0;
    return 10 + TITLE_HEIGHT * lines + (second ? 36.0 : 0.0) + 10;
}

/* "t = 1.4 ms, plane z = 0.5 m" */
static void second_line(const picture *p, char text[4 * SCALE_TEXT])
{
    char time[SCALE_TEXT] = "";
    if (isfinite(p->time)) scale_number(time, p->time, p->time_unit, 4);
    (void)snprintf(text, (size_t)4 * SCALE_TEXT, "%s%s%s%.200s", time[0] ? "t = " : "", time,
                   time[0] && p->note ? ", " : "", p->note ? p->note : "");
}

/* Title, time and note. */
static void draw_head(sketch *k)
{
    canvas *c = &k->paper;
    const double u = c->unit, most = c->width - 2 * MARGIN * u;
    char text[4 * SCALE_TEXT];
    double y = 10 * u;
    const char *title = k->p->title ? k->p->title : "";
    const char *next = title_break(title);
    (void)snprintf(text, sizeof text, "%.*s", next ? (int)(next - title) : (int)sizeof text, title);
    canvas_colour(c, c->ink);
    for (const char *line = text; line && *line; line = line == text && next ? next + 1 : NULL) {
        canvas_text_within(c, MARGIN * u, y + 38 * u, TITLE_SIZE, true, ALIGN_LEFT, most, line);
        y += TITLE_HEIGHT * u;
    }
    second_line(k->p, text);
    canvas_colour(c, c->faint);
    if (text[0]) canvas_text_within(c, MARGIN * u, y + 28 * u, TEXT_SIZE, false, ALIGN_LEFT, most, text);
}

void picture_label(char text[2 * SCALE_TEXT], const char *name, const scale *s)
{
    (void)snprintf(text, (size_t)2 * SCALE_TEXT, "%.60s%.60s%s%.60s%s", name, s->offset_text, s->unit[0] ? " (" : "",
                   s->unit, s->unit[0] ? ")" : "");
}

double picture_bar_height(void)
{
    return 112;
}

/* A triangle at an end of the bar: there are values beyond. */
static void draw_beyond(sketch *k, double x, double y, double towards, uint32_t rgb)
{
    cairo_t *cr = k->paper.cr;
    const double height = BAR_HEIGHT * k->paper.unit;
    cairo_move_to(cr, x, y);
    cairo_line_to(cr, x + towards * 0.7 * height, y + 0.5 * height);
    cairo_line_to(cr, x, y + height);
    cairo_close_path(cr);
    canvas_colour(&k->paper, rgb);
    cairo_fill(cr);
}

static void draw_bar_colours(sketch *k, int n, double x, double y, double width)
{
    canvas *c = &k->paper;
    const double height = BAR_HEIGHT * c->unit;
    cairo_set_antialias(c->cr, CAIRO_ANTIALIAS_NONE);
    for (int i = 0; i < (int)width; i++) {
        canvas_colour(c, colour_of(&k->map[n], i / fmax(1.0, width - 1)));
        cairo_rectangle(c->cr, x + i, y, 1, height);
        cairo_fill(c->cr);
    }
    cairo_set_antialias(c->cr, CAIRO_ANTIALIAS_DEFAULT);
    if (k->value[n].more_below) draw_beyond(k, x, y, -1, colour_of(&k->map[n], 0));
    if (k->value[n].more_above) draw_beyond(k, x + width, y, 1, colour_of(&k->map[n], 1));
    canvas_colour(c, c->line);
    cairo_set_line_width(c->cr, c->unit);
    cairo_rectangle(c->cr, x + 0.5, y + 0.5, width - 1, height - 1);
    cairo_stroke(c->cr);
}

/* Ticks of a bar or of a level axis: marks from y downwards, labels below, kept within the canvas. */
static void draw_level_ticks(sketch *k, const scale *s, double x, double y, double width)
{
    canvas *c = &k->paper;
    const double u = c->unit;
    scale_ticks ticks;
    int most = (int)fmax(2.0, fmin(8.0, width / (76 * u)));
    double longest = 0.0;
    scale_make_ticks(s, most, &ticks);
    for (int i = 0; i < ticks.n; i++) longest = fmax(longest, canvas_text_width(c, TICK_SIZE, false, ticks.label[i]));
    if (longest * ticks.n > 0.85 * width) scale_make_ticks(s, (int)fmax(2.0, 0.7 * width / longest), &ticks);
    for (int i = 0; i < ticks.n; i++) {
        const double at = x + width * (ticks.value[i] - s->lower) / (s->upper - s->lower);
        const double half = 0.5 * canvas_text_width(c, TICK_SIZE, false, ticks.label[i]);
        const double middle = fmin(c->width - 4 * u - half, fmax(4 * u + half, at));
        canvas_colour(c, c->line);
        cairo_set_line_width(c->cr, 2 * u);
        cairo_move_to(c->cr, at, y);
        cairo_line_to(c->cr, at, y + TICK_LENGTH * u);
        cairo_stroke(c->cr);
        canvas_colour(c, c->ink);
        canvas_text(c, middle, y + (TICK_LENGTH + 22) * u, TICK_SIZE, false, ALIGN_CENTRE, ticks.label[i]);
    }
}

void picture_draw_bar(sketch *k, int n, double y)
{
    canvas *c = &k->paper;
    const double u = c->unit, x = round((MARGIN + 20) * u), width = c->width - 2 * x;
    char text[2 * SCALE_TEXT];
    picture_label(text, k->p->scale[n].label, &k->value[n]);
    canvas_colour(c, c->ink);
    canvas_text_within(c, MARGIN * u, y + 26 * u, TEXT_SIZE, false, ALIGN_LEFT, c->width - 2 * MARGIN * u, text);
    draw_bar_colours(k, n, x, round(y + 40 * u), width);
    draw_level_ticks(k, &k->value[n], x, round(y + (40 + BAR_HEIGHT) * u), width);
}

static int upright_ticks(double height_in_units)
{
    return (int)fmax(2.0, fmin(8.0, height_in_units / 54));
}

double picture_tick_width(const scale *y, double height)
{
    scale_ticks ticks;
    size_t longest = 0;
    scale_make_ticks(y, upright_ticks(height), &ticks);
    for (int i = 0; i < ticks.n; i++) {
        const size_t length = count_characters(ticks.label[i]);
        if (length > longest) longest = length;
    }
    return 0.62 * TICK_SIZE * (double)longest + TICK_LENGTH + 6;
}

static void draw_upright_ticks(sketch *k, const scale *s, frame f)
{
    canvas *c = &k->paper;
    const double u = c->unit;
    scale_ticks ticks;
    double above = INFINITY; /* the label before, which the next one must not touch */
    scale_make_ticks(s, upright_ticks(f.height / u), &ticks);
    for (int i = 0; i < ticks.n; i++) {
        const double at = f.y + f.height * (s->upper - ticks.value[i]) / (s->upper - s->lower);
        canvas_colour(c, c->line);
        cairo_set_line_width(c->cr, 2 * u);
        cairo_move_to(c->cr, f.x, at);
        cairo_line_to(c->cr, f.x - TICK_LENGTH * u, at);
        cairo_stroke(c->cr);
        if (above - at < 1.1 * TICK_SIZE * u) continue;
        above = at;
        canvas_colour(c, c->ink);
        canvas_text(c, f.x - (TICK_LENGTH + 5) * u, at + 8 * u, TICK_SIZE, false, ALIGN_RIGHT, ticks.label[i]);
    }
}

void picture_draw_axes(sketch *k, frame f, const scale *x, const char *x_label, const scale *y, const char *y_label)
{
    canvas *c = &k->paper;
    const double u = c->unit;
    draw_level_ticks(k, x, f.x, f.y + f.height, f.width);
    draw_upright_ticks(k, y, f);
    canvas_colour(c, c->line);
    cairo_set_line_width(c->cr, 2 * u);
    cairo_rectangle(c->cr, f.x, f.y, f.width, f.height);
    cairo_stroke(c->cr);
    canvas_colour(c, c->ink);
    if (y_label) {
        const double x0 = f.x - (TICK_LENGTH + 5) * u - canvas_text_width(c, TEXT_SIZE, false, y_label);
        canvas_text(c, fmax(MARGIN * u, x0), f.y - 26 * u, TEXT_SIZE, false, ALIGN_LEFT, y_label);
    }
    if (x_label) {
        canvas_text(c, f.x + 0.5 * f.width, f.y + f.height + (TICK_LENGTH + 52) * u, TEXT_SIZE, false, ALIGN_CENTRE,
                    x_label);
    }
}

static floe_status prepare_sketch(sketch *k)
{
    const picture *p = k->p;
    for (int n = 0; n < p->n_scales; n++) TRY(choose_scale(k->ctx, p, n, &k->value[n]));
    for (int n = 0; n < p->n_scales; n++) colour_map_make(&k->map[n], choose_colours(k, n), p->dark);
    double size = 0.0;
    for (int a = 0; a < p->dim; a++) size = fmax(size, fmax(fabs(p->lower[a]), fabs(p->upper[a])));
    for (int a = 0; a < p->dim; a++) {
        k->axis[a] = (scale){.lower = p->lower[a], .upper = p->upper[a]};
        scale_set_unit_for(&k->axis[a], p->unit, size);
    }
    return FLOE_OK;
}

static floe_status draw_sketch(sketch *k, const char *path)
{
    const picture *p = k->p;
    const double width = p->width > 0 ? p->width : PICTURE_WIDTH;
    const double below = p->dim == 1 ? picture_profile_height(k) : picture_field_height(k);
    TRY(canvas_open(&k->paper, k->ctx, width, width / 720.0 * (picture_head_height(p) + below), p->dark));
    draw_head(k);
    if (p->dim == 1) {
        picture_draw_profile(k);
    } else {
        TRY(picture_draw_field(k));
    }
    return canvas_write(&k->paper, path);
}

floe_status picture_write(context *ctx, const char *path, const picture *p)
{
    sketch k = {.ctx = ctx, .p = p};
    TRY(prepare_sketch(&k));
    const floe_status status = draw_sketch(&k, path);
    canvas_close(&k.paper);
    return status;
}
