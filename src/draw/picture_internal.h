/* The parts of a picture: what its files share. */
#ifndef DRAW_PICTURE_INTERNAL_H
#define DRAW_PICTURE_INTERNAL_H

#include "draw/canvas.h"
#include "draw/colour_scale.h"
#include "draw/picture.h"
#include "draw/scale.h"

/* Sizes in units of a 720th of the width: half of that many px on a phone. */
enum { TITLE_SIZE = 29, TEXT_SIZE = 25, TICK_SIZE = 24, MARGIN = 22, TICK_LENGTH = 8, BAR_HEIGHT = 24 };

/* A picture on its way. */
typedef struct sketch {
    context *ctx; /* not owned */
    const picture *p;
    canvas paper;
    scale value[PICTURE_SCALES];
    colour_map map[PICTURE_SCALES];
    scale axis[2];
} sketch;

/* Height of what is drawn, in units. */
double picture_head_height(const picture *p);
double picture_bar_height(void);
/* The colour bar of scale `n`, its upper end at y px. */
void picture_draw_bar(sketch *k, int n, double y);
/* "pressure − 101.3 kPa (Pa)" */
void picture_label(char text[2 * SCALE_TEXT], const char *name, const scale *s);

/* A rectangle in px. */
typedef struct frame {
    double x, y, width, height; /* of the upper left corner */
} frame;

/* Ticks with labels left of the frame and below it, names of the axes, and the frame itself. */
void picture_draw_axes(sketch *k, frame f, const scale *x, const char *x_label, const scale *y, const char *y_label);
/* Space that the labels of an upright axis of that height need; both in units. */
double picture_tick_width(const scale *y, double height);

/* Height in units of all that is below the head. */
double picture_field_height(const sketch *k);
double picture_profile_height(const sketch *k);
floe_status picture_draw_field(sketch *k);
void picture_draw_profile(sketch *k);

#endif
