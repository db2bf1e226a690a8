/* The history: DIR/history.csv, one row an output time, its columns named with their units in the first line. */
#ifndef IO_HISTORY_H
#define IO_HISTORY_H

#include "sim/sim.h"

typedef struct history history;

/* Begins the history of `s` at `path`, or goes on with it: rows later than `keep_until` (s; -INFINITY: all), and half a
 * row that a kill has left, are dropped in one stroke. Errors: FLOE_IO; FLOE_BAD_INPUT where the file has other
 * columns. */
floe_status history_open(history **out, const sim *s, const char *path, double keep_until);
void history_close(history **h);

/* What a row needs that is not in the simulation. */
typedef struct history_row {
    const sim_totals
        *totals; /* of sim_sum and sim_sum_moments: per metre of depth or per radian; rows hold the whole */
    const double *mean_pressure; /* Pa, by scene material; only fluids are looked at, NAN where there is none */
} history_row;

/* Appends a row and hands it to the system. */
floe_status history_append(history *h, const sim *s, const history_row *row);
/* Waits until all rows are on the disk; to be called before a checkpoint counts on them. */
/* The file has no name any more: someone has removed it, or put another in its place. */
bool history_is_removed(const history *h);
floe_status history_sync(history *h);

/* Time (s) of the last row, -INFINITY if there is none. */
double history_last_time(const history *h);

#endif
