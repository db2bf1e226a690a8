#include "verify/history_metric.h"

#include <math.h>
#include <string.h>

static const struct {
    const char *name, *pattern, *doc;
} metrics[] = {
#define HISTORY_METRIC_ENTRY(enumerator, name, doc) [enumerator] = {name, name "_X", doc},
    HISTORY_METRIC_LIST(HISTORY_METRIC_ENTRY)
#undef HISTORY_METRIC_ENTRY
};

const char *history_metric_pattern(history_metric_kind kind)
{
    return (size_t)kind < HISTORY_METRIC_COUNT ? metrics[kind].pattern : "";
}

const char *history_metric_doc(history_metric_kind kind)
{
    return (size_t)kind < HISTORY_METRIC_COUNT ? metrics[kind].doc : "";
}

history_metric_kind history_metric_parse(const char *name, const char **quantity)
{
    for (size_t kind = 0; kind < HISTORY_METRIC_COUNT; kind++) {
        const size_t length = strlen(metrics[kind].name);
        if (strncmp(name, metrics[kind].name, length) != 0 || name[length] != '_') continue;
        *quantity = name + length + 1;
        return (history_metric_kind)kind;
    }
    *quantity = "";
    return HISTORY_METRIC_COUNT;
}

/* A history and its extent. */
typedef struct curve {
    size_t n;
    const double *t, *y;
    double low, high;
} curve;

static curve curve_of(size_t n, const double *t, const double *y)
{
    curve c = {n, t, y, INFINITY, -(double)INFINITY};
    for (size_t i = 0; i < n; i++) {
        c.low = fmin(c.low, y[i]);
        c.high = fmax(c.high, y[i]);
    }
    return c;
}

static double curve_amplitude(const curve *c)
{
    const double largest = fmax(fabs(c->low), fabs(c->high));
    const double half = 0.5 * (c->high - c->low);
    return half > 1e-9 * largest ? half : largest;
}

/* Time between the first and the last crossing of `level` in one direction over their number; NAN for fewer than
 * two. */
static double crossing_period(const curve *c, double level, double direction)
{
    double first = NAN;
    double last = NAN;
    size_t count = 0;
    for (size_t i = 1; i < c->n; i++) {
        const double before = direction * (c->y[i - 1] - level);
        const double after = direction * (c->y[i] - level);
        if (!(before < 0.0 && after >= 0.0)) continue;
        last = c->t[i - 1] + (c->t[i] - c->t[i - 1]) * before / (before - after);
        if (count++ == 0) first = last;
    }
    return count > 1 ? (last - first) / (double)(count - 1) : (double)NAN;
}

/* The mean of both directions, or of the one that there is. */
static double period_of(const curve *c, double level)
{
    const double up = crossing_period(c, level, 1.0);
    const double down = crossing_period(c, level, -1.0);
    if (isnan(up)) return down;
    return isnan(down) ? up : 0.5 * (up + down);
}

/* Time of the parabola's vertex through row i and its neighbours, which need not be evenly spaced. */
static double vertex_time(const curve *c, size_t i)
{
    if (i == 0 || i + 1 >= c->n) return c->t[i];
    const double back = c->t[i] - c->t[i - 1];
    const double on = c->t[i + 1] - c->t[i];
    const double slope_back = (c->y[i] - c->y[i - 1]) / back;
    const double slope_on = (c->y[i + 1] - c->y[i]) / on;
    const double bend = slope_on - slope_back;
    if (bend == 0.0) return c->t[i];
    return c->t[i] - (slope_back * on + slope_on * back) / (2.0 * bend);
}

/* The next turning point from row *from on, and the direction (+1: a maximum) in which it was approached; false at the
 * end. *from becomes the row where it was known. */
static bool next_turn(const curve *c, size_t *from, size_t *extreme, double *direction, double *time)
{
    const double least = 0.1 * (c->high - c->low);
    for (size_t i = *from; i < c->n; i++) {
        const double step = c->y[i] - c->y[*extreme];
        if (*direction == 0.0) {
            if (fabs(step) >= least) *direction = step > 0.0 ? 1.0 : -1.0;
            if (*direction != 0.0) *extreme = i;
        } else if (*direction * step >= 0.0) {
            *extreme = i;
        } else if (-*direction * step >= least) {
            *time = vertex_time(c, *extreme);
            *from = i;
            *extreme = i;
            *direction = -*direction;
            return true;
        }
    }
    return false;
}

static double turns_error(const curve *c, const curve *ref)
{
    size_t from[2] = {0, 0};
    size_t extreme[2] = {0, 0};
    double direction[2] = {0.0, 0.0};
    double error = NAN;
    int surplus = 0;
    for (;;) {
        double time, expected;
        const bool one = next_turn(c, &from[0], &extreme[0], &direction[0], &time);
        const bool other = next_turn(ref, &from[1], &extreme[1], &direction[1], &expected);
        if (!one && !other) return error;
        if (one && other) {
            error = fmax(error, fabs(time - expected) / expected);
        } else if (surplus++ > 0) {
            return NAN;
        }
    }
}

/* Means of e and e^2 over the rows from `start` on, by the trapezoidal rule over time (a lone row counts for
 * itself). */
static void mean_errors(const curve *c, const curve *ref, size_t start, double *mean, double *square)
{
    double weight = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (size_t i = start; i < c->n; i++) {
        const double e = c->y[i] - ref->y[i];
        const double before = i > start ? c->t[i] - c->t[i - 1] : 0.0;
        const double after = i + 1 < c->n ? c->t[i + 1] - c->t[i] : 0.0;
        const double w = start + 1 == c->n ? 1.0 : 0.5 * (before + after);
        weight += w;
        sum += w * e;
        squares += w * e * e;
    }
    *mean = sum / weight;
    *square = squares / weight;
}

static size_t late_row(const curve *c)
{
    const double after = c->t[c->n - 1] - 0.1 * (c->t[c->n - 1] - c->t[0]);
    size_t i = c->n - 1;
    while (i > 0 && c->t[i - 1] >= after) i--;
    return i;
}

static double largest_difference(const curve *c, const curve *ref)
{
    double most = 0.0;
    for (size_t i = 0; i < c->n; i++) most = fmax(most, fabs(c->y[i] - ref->y[i]));
    return most;
}

double history_metric_value(history_metric_kind kind, size_t n, const double *t, const double *value,
                            const double *expected)
{
    if (n == 0) return NAN;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(value[i]) || !isfinite(expected[i])) return NAN;
    }
    const curve c = curve_of(n, t, value);
    const curve ref = curve_of(n, t, expected);
    const double scale = curve_amplitude(&ref);
    const double level = 0.5 * (ref.low + ref.high);
    const double expected_period = period_of(&ref, level);
    double mean, square;
    switch (kind) {
    case HISTORY_MAX: return largest_difference(&c, &ref) / scale;
    case HISTORY_RMS: mean_errors(&c, &ref, 0, &mean, &square); return sqrt(square) / scale;
    case HISTORY_END: return fabs(value[n - 1] - expected[n - 1]) / scale;
    case HISTORY_LATE: mean_errors(&c, &ref, late_row(&c), &mean, &square); return fabs(mean) / scale;
    case HISTORY_PERIOD: return fabs(period_of(&c, level) - expected_period) / expected_period;
    case HISTORY_TURNS: return turns_error(&c, &ref);
    case HISTORY_METRIC_COUNT: break;
    }
    return NAN;
}
