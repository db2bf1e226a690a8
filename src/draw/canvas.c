#include "draw/canvas.h"

#include "base/memory.h"
#include "io/file.h"

#include <math.h>
#include <string.h>

enum { LONGEST_TEXT = 512 };

floe_status canvas_check(canvas *c, cairo_status_t status)
{
    if (status == CAIRO_STATUS_SUCCESS) return FLOE_OK;
    if (status == CAIRO_STATUS_NO_MEMORY) return fail(c->ctx, FLOE_NO_MEMORY, "no memory for a picture");
    return fail(c->ctx, FLOE_INTERNAL, "cairo cannot draw: %s", cairo_status_to_string(status));
}

floe_status canvas_open(canvas *c, context *ctx, double width, double height, bool dark)
{
    *c = (canvas){.ctx = ctx, .width = ceil(width), .height = ceil(height), .unit = width / 720.0};
    c->paper = dark ? 0x15181d : 0xffffff;
    c->ink = dark ? 0xe8eaed : 0x1b1e23;
    c->faint = dark ? 0xa9b0ba : 0x555c66;
    c->line = dark ? 0x6b7480 : 0x8a929c;
    c->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)c->width, (int)c->height);
    c->cr = cairo_create(c->surface);
    canvas_colour(c, c->paper);
    cairo_paint(c->cr);
    return canvas_check(c, cairo_status(c->cr));
}

void canvas_close(canvas *c)
{
    if (c->cr) cairo_destroy(c->cr);
    if (c->surface) cairo_surface_destroy(c->surface);
    *c = (canvas){0};
}

/* Bytes of a PNG on their way to its file. */
typedef struct image {
    context *ctx;
    char *data; /* counted memory */
    size_t size, capacity;
    floe_status status;
} image;

static cairo_status_t take_bytes(void *user, const unsigned char *data, unsigned int size)
{
    image *to = user;
    if (to->size + size > to->capacity) {
        const size_t capacity = 2 * to->capacity + size + 65536;
        to->status = memory_resize(to->ctx, &to->data, capacity, 1);
        if (to->status != FLOE_OK) return CAIRO_STATUS_NO_MEMORY;
        to->capacity = capacity;
    }
    memcpy(to->data + to->size, data, size);
    to->size += size;
    return CAIRO_STATUS_SUCCESS;
}

floe_status canvas_write(canvas *c, const char *path)
{
    image to = {.ctx = c->ctx};
    floe_status status = canvas_check(c, cairo_status(c->cr));
    if (status == FLOE_OK) {
        const cairo_status_t made = cairo_surface_write_to_png_stream(c->surface, take_bytes, &to);
        status = to.status != FLOE_OK ? to.status : canvas_check(c, made);
    }
    const file_part part = {to.data, to.size};
    if (status == FLOE_OK) status = file_replace(c->ctx, path, &part, 1);
    memory_free(c->ctx, &to.data);
    return status;
}

void canvas_colour(canvas *c, uint32_t rgb)
{
    cairo_set_source_rgb(c->cr, (rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0);
}

static void set_font(canvas *c, double size, bool bold)
{
    cairo_select_font_face(c->cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c->cr, size * c->unit);
}

double canvas_text_width(canvas *c, double size, bool bold, const char *text)
{
    cairo_text_extents_t extents;
    set_font(c, size, bold);
    cairo_text_extents(c->cr, text, &extents);
    return extents.x_advance;
}

void canvas_text(canvas *c, double x, double y, double size, bool bold, canvas_align align, const char *text)
{
    const double width = canvas_text_width(c, size, bold, text);
    const double before = align == ALIGN_LEFT ? 0.0 : align == ALIGN_CENTRE ? 0.5 * width : width;
    cairo_move_to(c->cr, round(x - before), round(y));
    cairo_show_text(c->cr, text);
}

/* Takes a character (of UTF-8) off the end of a text. */
static void drop_last_character(char *text)
{
    size_t length = strlen(text);
    while (length > 0 && ((unsigned char)text[length - 1] & 0xc0) == 0x80) length--;
    if (length > 0) text[length - 1] = '\0';
}

void canvas_text_within(canvas *c, double x, double y, double size, bool bold, canvas_align align, double most,
                        const char *text)
{
    char part[LONGEST_TEXT], shown[LONGEST_TEXT + 8];
    const double width = canvas_text_width(c, size, bold, text);
    const double fitting = width > most ? fmax(0.75, most / width) * size : size;
    (void)snprintf(part, sizeof part, "%s", text);
    (void)snprintf(shown, sizeof shown, "%s", part);
    while (part[0] && canvas_text_width(c, fitting, bold, shown) > most * 1.001) {
        drop_last_character(part);
        (void)snprintf(shown, sizeof shown, "%s…", part);
    }
    canvas_text(c, x, y, fitting, bold, align, shown);
}
