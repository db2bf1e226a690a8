/* Colour maps: perceptually uniform, so that equal steps of a value look equal, and legible to the colour-blind, as
 * lightness alone tells the order. */
#ifndef DRAW_COLOUR_H
#define DRAW_COLOUR_H

#include <stdbool.h>
#include <stdint.h>

typedef enum colour_kind {
    COLOUR_SINGLE, /* viridis (S. van der Walt, N. Smith 2015): the one quantity of a picture */
    COLOUR_WARM,   /* yellow, orange, brown: the first of two quantities */
    COLOUR_COOL,   /* pale to deep blue: the second */
    COLOUR_GREY,   /* the second, beside a signed one */
    COLOUR_SIGNED  /* blue, background, red: about zero */
} colour_kind;

enum { COLOUR_STEPS = 256 };

typedef struct colour_map {
    uint32_t rgb[COLOUR_STEPS]; /* 0xRRGGBB, lowest value first */
} colour_map;

/* Fills a map, for light paper or for dark. All but viridis are curves in the space OKLab (B. Ottosson 2020) with
 * lightness linear in the value: low values (for COLOUR_SIGNED: those about zero) are near the paper. */
void colour_map_make(colour_map *map, colour_kind kind, bool dark);
/* The colour of a number in [0, 1]; what is outside gets the colour of the nearer end. */
uint32_t colour_of(const colour_map *map, double t);

#endif
