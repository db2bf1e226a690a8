/* Messages on a terminal: lines broken between words. Files and pipes get each line whole, for programs that read it. */
#ifndef BASE_WRAPPED_H
#define BASE_WRAPPED_H

#include "base/compiler.h"

#include <stdio.h>

enum { WRAPPED_WIDTH = 80 }; /* columns at most */

/* Prints a text of one or more lines. On a terminal a line that is longer than it is wide, or than WRAPPED_WIDTH, goes
 * on below, four columns further in than it starts. A word that is longer than that (a path) stays whole. */
void wrapped_printf(FILE *file, const char *format, ...) FLOE_PRINTF(2, 3);

/* The same at a given width in columns; 0: each line whole. */
void wrapped_print(FILE *file, const char *text, int width);

/* Columns that a message may take in this file; 0: any number, it is no terminal. */
int wrapped_width(FILE *file);

#endif
