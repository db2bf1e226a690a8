#include "draw/field_picture.h"

#include "base/memory.h"
#include "base/text.h"
#include "draw/field_choice.h"
#include "draw/picture.h"
#include "draw/scale.h"

#include <math.h>
#include <string.h>

/* A picture in the making. */
typedef struct sheet {
    snapshot s;
    const field_picture_options *o;
    picture p;
    picture_cells cells;
    picture_points *points;                             /* one a body; counted memory */
    char label[PICTURE_SCALES][SNAPSHOT_TEXT];          /* of the scales */
    char of_points[SNAPSHOT_TEXT], note[SNAPSHOT_TEXT]; /* labels of what points show; the note of the picture */
    bool found_points, found_cells;                     /* something has the field that was asked for */
    size_t shown;                                       /* bodies */
    double plane, half;                                 /* m, 3-D: what lies within `half` of z = plane is shown */
} sheet;

static void free_points(context *ctx, picture_points *points)
{
    memory_free(ctx, &points->x);
    memory_free(ctx, &points->edge);
    memory_free(ctx, &points->value);
}

static void sheet_free(sheet *h)
{
    context *ctx = h->s.ctx;
    for (size_t b = 0; h->points && b < h->s.n_bodies; b++) free_points(ctx, &h->points[b]);
    memory_free(ctx, &h->points);
    memory_free(ctx, &h->cells.value);
    snapshot_free(&h->s);
}

/* The scale for such a choice: one that is there already, or a new one. */
static floe_status find_scale(sheet *h, const field_choice *choice, int *out)
{
    picture *p = &h->p;
    for (*out = 0; *out < p->n_scales; ++*out) {
        if (strcmp(h->label[*out], choice->label) == 0) return FLOE_OK;
    }
    if (p->n_scales == PICTURE_SCALES) {
        return fail(
            h->s.ctx, FLOE_BAD_INPUT,
            "a picture shows two quantities, not '%s', '%s' and '%s': choose by --points and --cells, 'none' included",
            h->label[0], h->label[1], choice->label);
    }
    const int n = p->n_scales++;
    (void)snprintf(h->label[n], SNAPSHOT_TEXT, "%s", choice->label);
    p->scale[n] = (picture_scale){.label = h->label[n],
                                  .unit = choice->field->unit,
                                  .about_zero = choice->is_signed,
                                  .lower = h->o->range[n].lower,
                                  .upper = h->o->range[n].upper};
    return FLOE_OK;
}

static bool is_none(const char *name)
{
    return name && strcmp(name, "none") == 0;
}

/* Number of the layer of cells that the plane goes through. */
static int middle_layer(const snapshot *s)
{
    return s->cells[2] / 2;
}

/* The whole grid, or the layer in the plane. */
static void cut_cells(const sheet *h, double *value)
{
    const size_t layer = (size_t)h->s.cells[0] * (size_t)h->s.cells[1];
    if (h->s.dim == 3) memmove(value, value + layer * (size_t)middle_layer(&h->s), layer * sizeof *value);
}

static floe_status draw_cells(sheet *h)
{
    const snapshot *s = &h->s;
    field_choice choice;
    double *value;
    if (is_none(h->o->cells) || s->grid.n == 0) return FLOE_OK;
    if (h->o->cells) {
        field_choose(s, &s->grid, h->o->cells, &choice);
    } else {
        field_choose_for_cells(s, &choice);
    }
    if (!choice.field) return FLOE_OK;
    h->found_cells = true;
    TRY(find_scale(h, &choice, &h->cells.scale));
    TRY(field_values(s, &s->grid, &choice, &value));
    cut_cells(h, value);
    h->cells.value = value;
    for (int a = 0; a < 2; a++) {
        h->cells.n[a] = s->cells[a];
        h->cells.lower[a] = s->lower[a];
        h->cells.spacing[a] = s->cell[a];
    }
    h->p.cells = &h->cells;
    return FLOE_OK;
}

/* An array of a body, NULL where it has none of that name. */
static floe_status read_if_there(const snapshot *s, const snapshot_group *body, const char *name, double **out)
{
    const snapshot_field *field = snapshot_find(body, name);
    *out = NULL;
    return field ? snapshot_values(s, body, field, out) : FLOE_OK;
}

/* How much larger each point has become: by its volume ratio, or in the plane by its deformation gradient. */
static floe_status multiply_by_growth(const snapshot *s, const snapshot_group *body, double *size)
{
    const char *const of_plane[] = {"deformation_gradient_xx", "deformation_gradient_yy", "deformation_gradient_xy",
                                    "deformation_gradient_yx"};
    double *ratio = NULL, *f[4] = {NULL};
    floe_status status = read_if_there(s, body, "volume_ratio", &ratio);
    for (int i = 0; i < 4 && status == FLOE_OK && !ratio && s->dim == 2; i++) {
        status = read_if_there(s, body, of_plane[i], &f[i]);
    }
    for (size_t i = 0; i < body->n && status == FLOE_OK; i++) {
        if (ratio) size[i] *= ratio[i];
        if (f[0] && f[1] && f[2] && f[3]) size[i] *= fabs(f[0][i] * f[1][i] - f[2][i] * f[3][i]);
    }
    memory_free(s->ctx, &ratio);
    for (int i = 0; i < 4; i++) memory_free(s->ctx, &f[i]);
    return status;
}

/* From the volume of a point, as it is written, to the edge of a square (a cube) of its size. */
static void volumes_to_edges(const snapshot *s, size_t n, const double *x, double *size)
{
    for (size_t i = 0; i < n; i++) {
        const double round = s->axisymmetric ? fmax(x[3 * i], 0.25 * s->cell[0]) : 1.0;
        size[i] = s->dim == 3 ? cbrt(size[i]) : sqrt(size[i] / (s->volume_scale * round));
    }
}

static floe_status read_edges(const snapshot *s, const snapshot_group *body, const double *x, double **out)
{
    TRY(read_if_there(s, body, "initial_volume", out));
    if (*out) {
        TRY(multiply_by_growth(s, body, *out));
        volumes_to_edges(s, body->n, x, *out);
        return FLOE_OK;
    }
    TRY(memory_new(s->ctx, out, body->n, sizeof **out));
    for (size_t i = 0; i < body->n; i++) (*out)[i] = 0.5 * s->cell[0];
    return FLOE_OK;
}

/* Positions become pairs; in 3-D only the points near the plane stay. */
static size_t cut_points(const sheet *h, size_t n, double *x, double *edge, double *value)
{
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        if (h->s.dim == 3 && !(fabs(x[3 * i + 2] - h->plane) <= h->half)) continue;
        x[2 * kept] = x[3 * i];
        x[2 * kept + 1] = x[3 * i + 1];
        edge[kept] = edge[i];
        if (value) value[kept] = value[i];
        kept++;
    }
    return kept;
}

static bool has_solids(const snapshot *s)
{
    for (size_t b = 0; b < s->n_bodies; b++) {
        if (!s->body[b].fluid) return true;
    }
    return false;
}

/* What was asked for a body, NULL if nothing was: beside solids, points of a fluid stand for the cells that it has in
 * other couplings, so that one command draws the same picture of both. */
static const char *field_of_body(const sheet *h, const snapshot_group *body)
{
    return body->fluid && has_solids(&h->s) ? h->o->cells : h->o->points;
}

static void choose_for_body(sheet *h, const snapshot_group *body, field_choice *out)
{
    const char *name = field_of_body(h, body);
    if (name) {
        field_choose(&h->s, body, name, out);
        if (name == h->o->points && out->field) h->found_points = true;
        if (name == h->o->cells && out->field) h->found_cells = true;
    } else {
        field_choose_for_points(&h->s, body, out);
    }
}

static void note_label(sheet *h, const char *label)
{
    if (strstr(h->of_points, label)) return;
    text_add(h->of_points, SNAPSHOT_TEXT, "%s%s", h->of_points[0] ? " and " : "", label);
}

static floe_status draw_body(sheet *h, const snapshot_group *body, picture_points *points)
{
    const snapshot *s = &h->s;
    const snapshot_field *position = snapshot_find(body, "position");
    double *x = NULL, *edge = NULL, *value = NULL;
    field_choice choice;
    if (!position) return fail(s->ctx, FLOE_IO, "'%s': body '%s' has no positions", s->path, body->name);
    points->name = body->name;
    choose_for_body(h, body, &choice);
    if (choice.field) TRY(find_scale(h, &choice, &points->scale));
    TRY(snapshot_values(s, body, position, &x));
    points->x = x;
    floe_status status = read_edges(s, body, x, &edge);
    points->edge = edge;
    if (status == FLOE_OK && choice.field) {
        status = field_values(s, body, &choice, &value);
        points->value = value;
        note_label(h, choice.label);
    }
    TRY(status);
    points->n = cut_points(h, body->n, x, edge, value);
    h->shown++;
    return FLOE_OK;
}

/* Solids take the first scale, fluids the second; but fluids are drawn first, so that solids keep their outlines. */
static floe_status draw_points(sheet *h)
{
    size_t fluids = 0, slot[2] = {0, 0};
    TRY(memory_new(h->s.ctx, &h->points, h->s.n_bodies, sizeof *h->points));
    for (size_t b = 0; b < h->s.n_bodies; b++) fluids += h->s.body[b].fluid;
    slot[0] = fluids;
    for (int fluid = 0; fluid < 2; fluid++) {
        for (size_t b = 0; b < h->s.n_bodies; b++) {
            if (is_none(field_of_body(h, &h->s.body[b]))) continue;
            if (h->s.body[b].fluid == (fluid == 1)) TRY(draw_body(h, &h->s.body[b], &h->points[slot[fluid]++]));
        }
    }
    h->p.points = h->points;
    h->p.n_points = h->shown > 0 ? h->s.n_bodies : 0;
    return FLOE_OK;
}

static void set_frame(sheet *h)
{
    const snapshot *s = &h->s;
    picture *p = &h->p;
    char number[SCALE_TEXT];
    p->dim = s->dim == 1 ? 1 : 2;
    p->title = s->title;
    p->time = s->time;
    p->time_unit = s->time_unit;
    p->unit = s->unit;
    p->dark = h->o->dark;
    p->width = h->o->width;
    p->axis[0] = s->axisymmetric ? "r" : "x";
    p->axis[1] = s->axisymmetric ? "z" : "y";
    for (int a = 0; a < 2; a++) {
        p->lower[a] = s->lower[a];
        p->upper[a] = s->upper[a];
    }
    (void)snprintf(h->note, sizeof h->note, "%.40s", s->coupling);
    if (s->dim == 3) {
        h->half = 0.5 * s->cell[2];
        h->plane = s->lower[2] + s->cell[2] * middle_layer(s) + h->half;
        scale_number(number, h->plane, s->unit, 4);
        (void)snprintf(h->note, sizeof h->note, "%.40s, plane z = %.90s", s->coupling, number);
    }
    p->note = h->note;
}

static bool is_missing(const char *name, bool found)
{
    return name && !is_none(name) && !found;
}

/* Fills a zeroed sheet; free it whatever comes back. */
static floe_status sheet_make(sheet *h, context *ctx, const char *dir, long number, const field_picture_options *o)
{
    h->o = o;
    h->s.ctx = ctx;
    TRY(snapshot_read(&h->s, ctx, dir, number));
    set_frame(h);
    TRY(draw_points(h));
    TRY(draw_cells(h));
    if (is_missing(o->points, h->found_points)) return field_unknown(&h->s, true, o->points);
    if (is_missing(o->cells, h->found_cells)) return field_unknown(&h->s, h->s.grid.n == 0, o->cells);
    if (h->p.cells || h->p.n_points > 0) return FLOE_OK;
    return fail(ctx, FLOE_BAD_INPUT,
                "there is nothing to draw: '%s' holds neither points nor cells that are asked for; "
                "leave --points or --cells out",
                h->s.path);
}

static void write_caption(const sheet *h, char *caption)
{
    char time[SCALE_TEXT], points[SNAPSHOT_TEXT + 16] = "", cells[SNAPSHOT_TEXT + 16] = "";
    scale_number(time, h->s.time, h->s.time_unit, 4);
    if (h->shown > 0) (void)snprintf(points, sizeof points, "%s%spoints", h->of_points, h->of_points[0] ? " of " : "");
    if (h->p.cells) (void)snprintf(cells, sizeof cells, "%s of cells", h->label[h->cells.scale]);
    (void)snprintf(caption, FIELD_CAPTION, "%s%s%s%s at t = %s", points, points[0] && cells[0] ? " over " : "", cells,
                   h->s.dim == 3 ? " in the middle plane" : "", time);
}

floe_status field_picture_write(context *ctx, const char *dir, long number, const field_picture_options *o,
                                const char *path, char *caption)
{
    sheet h = {0};
    floe_status status = sheet_make(&h, ctx, dir, number, o);
    if (status == FLOE_OK) status = picture_write(ctx, path, &h.p);
    if (status == FLOE_OK && caption) write_caption(&h, caption);
    sheet_free(&h);
    return status;
}

/* Widens the ranges by those of one snapshot. */
static floe_status add_ranges(context *ctx, const char *dir, long number, const field_picture_options *o,
                              field_range range[2])
{
    sheet h = {0};
    floe_status status = sheet_make(&h, ctx, dir, number, o);
    for (int k = 0; k < h.p.n_scales && status == FLOE_OK; k++) {
        double lower, upper;
        status = picture_range(ctx, &h.p, k, &lower, &upper);
        const bool first = !(range[k].lower < range[k].upper);
        range[k].lower = first ? lower : fmin(range[k].lower, lower);
        range[k].upper = first ? upper : fmax(range[k].upper, upper);
    }
    sheet_free(&h);
    return status;
}

floe_status field_picture_common_range(context *ctx, const char *dir, const snapshot_times *t, field_picture_options *o)
{
    field_range range[2] = {{0.0, 0.0}, {0.0, 0.0}};
    for (size_t i = 0; i < t->n; i++) TRY(add_ranges(ctx, dir, t->entry[i].number, o, range));
    for (int k = 0; k < 2; k++) {
        if (!(o->range[k].lower < o->range[k].upper)) o->range[k] = range[k];
    }
    return FLOE_OK;
}
