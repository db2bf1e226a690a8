/* What is drawn on: a cairo surface, colours of the paper, text that fits, and PNG. */
#ifndef DRAW_CANVAS_H
#define DRAW_CANVAS_H

#include "base/context.h"

#include <cairo.h>
#include <stdint.h>

/* Where a text stands about its place. */
typedef enum canvas_align { ALIGN_LEFT, ALIGN_CENTRE, ALIGN_RIGHT } canvas_align;

typedef struct canvas {
    context *ctx; /* not owned */
    cairo_surface_t *surface;
    cairo_t *cr;
    double width, height;             /* px */
    double unit;                      /* px: a 720th of the width, in which sizes are given */
    uint32_t paper, ink, faint, line; /* colours 0xRRGGBB: background, text, lesser text, frames */
} canvas;

/* Makes a canvas of that size, filled with paper. FLOE_NO_MEMORY. Close it whatever comes back. */
floe_status canvas_open(canvas *c, context *ctx, double width, double height, bool dark);
void canvas_close(canvas *c);
/* Writes what is on it as PNG, whole or not at all. */
floe_status canvas_write(canvas *c, const char *path);

/* What a status of cairo is to floe. */
floe_status canvas_check(canvas *c, cairo_status_t status);

void canvas_colour(canvas *c, uint32_t rgb);
/* The width of a text in px. `size` is in units, as everywhere. */
double canvas_text_width(canvas *c, double size, bool bold, const char *text);
/* A text with its base line at (x, y) px, in the current colour. */
void canvas_text(canvas *c, double x, double y, double size, bool bold, canvas_align align, const char *text);
/* A text that is no wider than `most` px: made smaller to three quarters, then cut. */
void canvas_text_within(canvas *c, double x, double y, double size, bool bold, canvas_align align, double most,
                        const char *text);

#endif
