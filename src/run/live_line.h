/* A line of progress: on a terminal one that is written over and over, elsewhere a plain one now and then. */
#ifndef RUN_LIVE_LINE_H
#define RUN_LIVE_LINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { LIVE_LINE_SIZE = 512, LIVE_LINE_DURATION = 32, LIVE_LINE_BAR = 32 };

typedef struct live_line {
    FILE *file;           /* NULL: silent; not owned */
    bool live;            /* a terminal */
    bool shown;           /* a live line stands there */
    double last;          /* wall clock of the last line, s */
    double live_interval; /* s of wall time between lines on a terminal */
    double plain_interval;
} live_line;

void live_line_begin(live_line *l, FILE *file, double live_interval, double plain_interval);
/* Is it time for the next line? Then it counts as written. */
bool live_line_is_due(live_line *l);
/* Writes the text, cut to the width of the terminal; it may be changed. */
void live_line_show(live_line *l, char *text);
/* Takes the live line away, so that other lines can be written. */
void live_line_clear(live_line *l);

/* "1:02:03", "?" where it is not known */
void live_line_duration(double seconds, char text[LIVE_LINE_DURATION]);
/* "[#####......] " */
void live_line_bar(double share, char text[LIVE_LINE_BAR]);

#endif
