#include "study/tolerance/choose.h"

#include <math.h>

/* s: below it a run's time is that of starting it, and grows otherwise than its work. */
static const double least_seconds = 0.05;
/* Orders and exponents of two neighbours scatter: those that a method cannot have are not believed. */
static const double most_order = 4.0, most_exponent = 6.0, hoped_order = 2.0, assumed_order = 1.0;

/* The finest case before `end` that is done, and has an error if that is asked for; `end`: none. */
static size_t done_before(const choose_curve *c, size_t end, bool with_error)
{
    for (size_t k = end; k-- > 0;) {
        if (c->list[k].state == CHOOSE_DONE && (!with_error || isfinite(c->list[k].error))) return k;
    }
    return end;
}

static void measure_order(choose_curve *c)
{
    c->order = c->exponent = NAN;
    const size_t fine = done_before(c, c->n, true), coarse = fine < c->n ? done_before(c, fine, true) : fine;
    if (coarse < fine && c->list[fine].error > 0.0 && c->list[coarse].error > 0.0)
        c->order = fmin(most_order,
                        log(c->list[coarse].error / c->list[fine].error) / log(c->list[coarse].h / c->list[fine].h));
    const size_t last = done_before(c, c->n, false), before = last < c->n ? done_before(c, last, false) : last;
    if (before < last && c->list[before].seconds > least_seconds && c->list[last].seconds > least_seconds)
        c->exponent = fmin(most_exponent, log(c->list[last].seconds / c->list[before].seconds) /
                                              log(c->list[before].h / c->list[last].h));
}

/* What one unit of weight takes (s), by the cheapest thing known: the smallest ratio of any case; NAN: nothing is
 * known. */
static double seconds_of_weight(const choose_curve *list, size_t n)
{
    double least = NAN;
    for (size_t i = 0; i < n; i++) {
        const size_t last = done_before(&list[i], list[i].n, false);
        if (last < list[i].n) least = fmin(least, list[i].list[last].seconds / list[i].list[last].weight);
    }
    return least;
}

static double predict_seconds(const choose_curve *c, size_t k, double of_weight)
{
    const size_t last = done_before(c, c->n, false);
    if (last == c->n) return c->list[k].weight * of_weight;
    const choose_case *from = &c->list[last];
    const double ratio =
        c->exponent > 0.0 ? pow(from->h / c->list[k].h, c->exponent) : c->list[k].weight / from->weight;
    return from->seconds * fmax(ratio, 1.0);
}

/* The error at h by that order, or less where the coarsest value that counts is about to count no more; NAN: there is
 * nothing to predict by. */
static double predict_error(const choose_curve *c, double h, double order)
{
    const size_t last = done_before(c, c->n, true);
    if (last == c->n) return NAN;
    const double by_order = c->list[last].error * pow(h / c->list[last].h, order);
    return c->list[last].settled > 0.0 ? fmin(by_order, c->list[last].settled) : by_order;
}

static void find_next(choose_curve *c)
{
    c->next = 0;
    for (size_t k = 0; k < c->n; k++) {
        if (c->list[k].state != CHOOSE_OPEN) c->next = k + 1;
    }
}

static double order_to_use(const choose_curve *c)
{
    return isnan(c->order) ? assumed_order : c->order;
}

static size_t count_state(const choose_curve *c, choose_state state)
{
    size_t n = 0;
    for (size_t k = 0; k < c->n; k++) n += c->list[k].state == state;
    return n;
}

static void find_reach(choose_curve *c, double tolerance, size_t needed, double of_weight)
{
    const size_t done = count_state(c, CHOOSE_DONE);
    c->reach = c->n;
    c->reach_seconds = INFINITY;
    for (size_t k = c->next; k < c->n && c->reach == c->n; k++) {
        if (done + (k + 1 - c->next) >= needed && predict_error(c, c->list[k].h, order_to_use(c)) <= tolerance)
            c->reach = k;
    }
    if (c->reach < c->n) c->reach_seconds = predict_seconds(c, c->reach, of_weight);
}

/* How run time grows as h^-1: as measured, or, of runs too short to time, as their weights do. NAN: nothing tells. */
static double growth_of(const choose_curve *c, size_t last)
{
    if (c->exponent > 0.0) return c->exponent;
    return last > 0 ? log(c->list[last].weight / c->list[0].weight) / log(c->list[0].h / c->list[last].h) : (double)NAN;
}

static void extrapolate_cost(choose_curve *c, double tolerance)
{
    const size_t last = done_before(c, c->n, true);
    c->wanted_h = c->wanted_seconds = NAN;
    if (last == c->n || !(c->order > 0.0)) return;
    const choose_case *from = &c->list[last];
    c->wanted_h = from->h * pow(tolerance / from->error, 1.0 / c->order);
    c->wanted_seconds = from->seconds * pow(from->h / c->wanted_h, growth_of(c, last));
}

/* Out of the running whatever the others do. */
static choose_standing standing_alone(const choose_curve *c, double tolerance)
{
    if (count_state(c, CHOOSE_FAILED) >= 2) return CHOOSE_BROKEN;
    if (c->next == c->n) return CHOOSE_SPENT;
    const double least = predict_error(c, c->list[c->n - 1].h, fmax(c->order, hoped_order));
    return !isnan(c->order) && least > tolerance ? CHOOSE_HOPELESS : CHOOSE_RUNS;
}

static double best_reach(const choose_curve *list, size_t n)
{
    double best = INFINITY;
    for (size_t i = 0; i < n; i++) {
        if (list[i].standing == CHOOSE_RUNS) best = fmin(best, list[i].reach_seconds);
    }
    return best;
}

/* A curve without an order yet may be better than it looks: it waits only if its very next case is too dear. */
static bool is_slower(const choose_curve *c, double best)
{
    const double seconds = isnan(c->order) ? c->next_seconds : fmax(c->reach_seconds, c->next_seconds);
    return seconds > best;
}

static void judge_curves(choose_curve *list, size_t n, double tolerance, size_t needed)
{
    const double of_weight = seconds_of_weight(list, n);
    for (size_t i = 0; i < n; i++) {
        choose_curve *c = &list[i];
        measure_order(c);
        find_next(c);
        c->next_seconds = c->next < c->n ? predict_seconds(c, c->next, of_weight) : (double)NAN;
        find_reach(c, tolerance, needed, of_weight);
        extrapolate_cost(c, tolerance);
        c->standing = standing_alone(c, tolerance);
    }
    const double best = best_reach(list, n);
    for (size_t i = 0; i < n; i++) {
        if (list[i].standing == CHOOSE_RUNS && is_slower(&list[i], best)) list[i].standing = CHOOSE_SLOWER;
    }
}

/* Of the cases that are done the best: the cheapest within the tolerance if `within`, else the one with the smallest
 * error. */
static choose_step find_done(const choose_curve *list, size_t n, double tolerance, bool within)
{
    choose_step best = {within ? CHOOSE_REACHED : CHOOSE_UNREACHED, n, 0};
    double least = INFINITY;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < list[i].n; k++) {
            const choose_case *one = &list[i].list[k];
            const double value = within ? one->seconds : one->error;
            if (one->state != CHOOSE_DONE || !(value < least)) continue;
            if (within && !(one->sure && one->error <= tolerance)) continue;
            least = value;
            best.curve = i;
            best.at = k;
        }
    }
    return best;
}

/* The cheapest next case; where no time is known, the lightest. */
static choose_step find_cheapest(const choose_curve *list, size_t n)
{
    choose_step best = {CHOOSE_RUN, n, 0};
    double least = INFINITY;
    for (size_t i = 0; i < n; i++) {
        if (list[i].standing != CHOOSE_RUNS) continue;
        const double cost = isnan(list[i].next_seconds) ? list[i].list[list[i].next].weight : list[i].next_seconds;
        if (cost >= least) continue;
        least = cost;
        best.curve = i;
        best.at = list[i].next;
    }
    return best;
}

choose_step choose_next(choose_curve *list, size_t n, double tolerance, size_t needed, double left)
{
    judge_curves(list, n, tolerance, needed);
    const choose_step reached = find_done(list, n, tolerance, true);
    if (reached.curve < n) return reached;
    const choose_step next = find_cheapest(list, n);
    const bool affordable = next.curve < n && !(list[next.curve].next_seconds > left) && left > 0.0;
    if (affordable) return next;
    choose_step best = find_done(list, n, tolerance, false);
    if (next.curve < n) best.action = CHOOSE_OUT_OF_TIME;
    return best;
}
