/* Errors of a history y(t_i) against its reference, and their names: `hmax_X`, X a quantity of the reference.
 *
 * Lengths of y are measured in its amplitude: half the range of the reference over the times compared, or its largest
 * size where the reference does not change. Nothing is smoothed. */
#ifndef VERIFY_HISTORY_METRIC_H
#define VERIFY_HISTORY_METRIC_H

#include "verify/reference.h"

/* X(enumerator, name, doc): what a metric computes; `NAME_X` in a deck. */
#define HISTORY_METRIC_LIST(X)                                                                                    \
    X(HISTORY_MAX, "hmax", "max |y - y_ref| / amplitude, over the rows of history.csv")                           \
    X(HISTORY_RMS, "hrms", "sqrt(mean (y - y_ref)^2) / amplitude, the mean over time")                            \
    X(HISTORY_END, "hend", "|y - y_ref| / amplitude in the last row")                                             \
    X(HISTORY_LATE, "hlate", "|mean of y - y_ref| / amplitude over the last tenth of the time: what has settled") \
    X(HISTORY_PERIOD, "hperiod",                                                                                  \
      "|T - T_ref| / T_ref, T the mean time between upward crossings (and between downward ones) of the middle "  \
      "of the reference")                                                                                         \
    X(HISTORY_TURNS, "hturns", "max |t_k - t_k,ref| / t_k,ref over the turning points, in order: events")

typedef enum history_metric_kind {
#define HISTORY_METRIC_ENUM(enumerator, name, doc) enumerator,
    HISTORY_METRIC_LIST(HISTORY_METRIC_ENUM)
#undef HISTORY_METRIC_ENUM
        HISTORY_METRIC_COUNT
} history_metric_kind;

/* The name as decks have it, "hmax_X"; "" out of range. */
const char *history_metric_pattern(history_metric_kind kind);
/* One line. */
const char *history_metric_doc(history_metric_kind kind);
/* Splits "hmax_position": the kind, HISTORY_METRIC_COUNT if it is none, and the place of "position" in the name. */
history_metric_kind history_metric_parse(const char *name, const char **quantity);

/* The error of value[n] at the times t[n] (s, ascending) against expected[n]. NAN where a value is, for n = 0, and
 * where there is nothing to measure: no amplitude (both are 0 throughout), no period (fewer than two crossings of a
 * kind in either history), numbers of turning points that differ by more than one (the last may lie beyond the end of
 * either). A turning point counts once y has gone back by a tenth of its range. Its time is that of the parabola
 * through the highest row and its neighbours; a crossing's that of the straight line. */
double history_metric_value(history_metric_kind kind, size_t n, const double *t, const double *value,
                            const double *expected);

#endif
