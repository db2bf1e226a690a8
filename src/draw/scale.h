/* Scales of axes and colour bars: a range, the unit it is shown in, round ticks and their labels. */
#ifndef DRAW_SCALE_H
#define DRAW_SCALE_H

#include "base/context.h"

enum { SCALE_TEXT = 96, SCALE_MAX_TICKS = 12 };

typedef struct scale {
    double lower, upper;          /* range, in the unit of the data; lower < upper */
    bool more_below, more_above;  /* there are values beyond */
    double offset, factor;        /* shown is (value - offset) / factor */
    char offset_text[SCALE_TEXT]; /* " - 101.33 kPa", "" without an offset */
    char unit[SCALE_TEXT];        /* of what is shown, "MPa"; "" if none */
} scale;

/* Round values in a range. */
typedef struct scale_ticks {
    int n;
    double value[SCALE_MAX_TICKS]; /* in the unit of the data */
    char label[SCALE_MAX_TICKS][SCALE_TEXT];
} scale_ticks;

/* Values from several arrays, for a range. */
typedef struct scale_sample {
    double *value; /* counted memory, owned */
    size_t n, capacity;
    size_t met;         /* finite values so far */
    double least, most; /* of all finite values */
} scale_sample;

/* Takes in the finite ones of n values. */
floe_status scale_sample_add(scale_sample *sample, context *ctx, const double *value, size_t n);
void scale_sample_free(scale_sample *sample, context *ctx);

/* The range that shows a sample best: that of all values, unless few of them (half a per cent at either end) more than
 * double it; then the others'. With `about_zero`, a range that holds zero is made the same on both sides. Ends are
 * rounded outwards. Without values, or where all are the same to 1e-9, a range about them. The sample is reordered. */
void scale_from_sample(scale *s, scale_sample *sample, bool about_zero);

/* Given lower and upper, chooses how they are shown: the unit gets an SI prefix or a power of ten, and where the range
 * is narrow beside its values an offset is taken off. `unit` is in udunits2 spelling; "1": none. */
void scale_set_unit(scale *s, const char *unit);
/* The same for an axis of a place: with the prefix that suits numbers up to `size`, and no offset. */
void scale_set_unit_for(scale *s, const char *unit, double size);

/* At most `most` (from 2 to SCALE_MAX_TICKS) ticks, at multiples of 1, 2 or 5 times a power of ten of what is shown. */
void scale_make_ticks(const scale *s, int most, scale_ticks *out);

/* A single number with unit and prefix, to `digits` figures: "1.4 ms". */
void scale_number(char text[SCALE_TEXT], double value, const char *unit, int digits);

#endif
