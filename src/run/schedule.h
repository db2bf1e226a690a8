/* When something that recurs is due, from times alone. */
#ifndef RUN_SCHEDULE_H
#define RUN_SCHEDULE_H

#include <stdbool.h>

/* The first multiple of `interval` (s) after `time`; INFINITY for an infinite interval. Times within 1e-9 of an
 * interval of a multiple count as having reached it. */
double schedule_next(double time, double interval);
/* Whether `time` is a multiple. */
bool schedule_is_due(double time, double interval);
/* Whether a multiple lies in (before, after]. An interval of 0 is passed at every step. */
bool schedule_is_passed(double before, double after, double interval);

#endif
