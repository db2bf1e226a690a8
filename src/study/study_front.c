/* Error against cost: who is cheapest. */
#include "study/study_internal.h"

#include "run/run_errors.h"

#include <math.h>
#include <string.h>

double study_cost_of(const study_case *one, study_cost cost)
{
    if (!study_is_done(one)) return NAN;
    switch (cost) {
    case STUDY_SECONDS: return one->timing.least;
    case STUDY_UPDATES: return one->run->summary.cell_updates + one->run->summary.point_updates;
    case STUDY_H: return one->over;
    case STUDY_COSTS: break;
    }
    return NAN;
}

bool study_is_on_front(const study *s, size_t i, const char *metric, study_cost cost)
{
    const double error = study_error(&s->list[i], metric), price = study_cost_of(&s->list[i], cost);
    if (!isfinite(error) || !isfinite(price)) return false;
    for (size_t j = 0; j < s->n; j++) {
        const double other = study_error(&s->list[j], metric), paid = study_cost_of(&s->list[j], cost);
        if (other <= error && paid <= price && (other < error || paid < price)) return false;
    }
    return true;
}

/* ---- answers ---- */

/* A group's cases by time, each with the largest error of its own and all dearer ones: what the group can do. An error
 * that happens to be small on a coarse mesh, as it passes through zero, is no accuracy. */
typedef struct curve {
    double seconds[SCENE_MAX_AXIS], error[SCENE_MAX_AXIS];
    double scatter; /* the largest of its times' */
    size_t n;
} curve;

/* The group's cheapest case beyond `seconds` that has an error. */
static bool next_case_on_front(const study *s, size_t group, const char *metric, double seconds, size_t *found)
{
    bool any = false;
    for (size_t i = 0; i < s->n; i++) {
        const study_case *one = &s->list[i];
        if (one->group != group || !(study_error(one, metric) > 0.0) || !(one->timing.least > seconds)) continue;
        if (any && s->list[*found].timing.least <= one->timing.least) continue;
        *found = i;
        any = true;
    }
    return any;
}

static curve curve_of(const study *s, size_t group, const char *metric)
{
    curve c = {.n = 0};
    double seconds = 0.0;
    size_t i = 0;
    while (c.n < SCENE_MAX_AXIS && next_case_on_front(s, group, metric, seconds, &i)) {
        c.seconds[c.n] = seconds = s->list[i].timing.least;
        c.error[c.n++] = study_error(&s->list[i], metric);
        c.scatter = fmax(c.scatter, s->list[i].timing.scatter);
    }
    for (size_t k = c.n; k-- > 1;) c.error[k - 1] = fmax(c.error[k - 1], c.error[k]);
    return c;
}

/* The time in which the group reaches the error, by interpolation between the logarithms; NAN: none of its cases
 * does. */
static double seconds_for(const curve *c, double target)
{
    for (size_t k = 0; k < c->n; k++) {
        if (c->error[k] > target) continue;
        if (k == 0) return c->seconds[0];
        const double part = log(target / c->error[k - 1]) / log(c->error[k] / c->error[k - 1]);
        return c->seconds[k - 1] * pow(c->seconds[k] / c->seconds[k - 1], part);
    }
    return NAN;
}

static study_answer answer_for(const study *s, const char *metric, double target)
{
    study_answer a = {metric, target, s->n_groups, s->n_groups, NAN, NAN, 0.0, 0.0};
    for (size_t g = 0; g < s->n_groups; g++) {
        const curve c = curve_of(s, g, metric);
        const double seconds = seconds_for(&c, target);
        if (isnan(seconds)) continue;
        if (a.best == s->n_groups || seconds < a.seconds) {
            a.next = a.best;
            a.next_seconds = a.seconds;
            a.next_scatter = a.scatter;
            a.best = g;
            a.seconds = seconds;
            a.scatter = c.scatter;
        } else if (a.next == s->n_groups || seconds < a.next_seconds) {
            a.next = g;
            a.next_seconds = seconds;
            a.next_scatter = c.scatter;
        }
    }
    return a;
}

/* The smallest and the largest error of any case. */
static bool range_of(const study *s, const char *metric, double *least, double *most)
{
    *least = INFINITY;
    *most = 0.0;
    for (size_t i = 0; i < s->n; i++) {
        const double error = study_error(&s->list[i], metric);
        if (!(error > 0.0)) continue;
        *least = fmin(*least, error);
        *most = fmax(*most, error);
    }
    return *least <= *most;
}

/* The largest of 1, 2, 5, 10, ... times any power of ten that is at most x. */
static double round_down(double x)
{
    static const double step[] = {5.0, 2.0, 1.0};
    const double decade = pow(10.0, floor(log10(x) + 1e-12));
    for (size_t i = 0; i < sizeof step / sizeof step[0]; i++) {
        if (step[i] * decade <= x * (1.0 + 1e-12)) return step[i] * decade;
    }
    return decade;
}

bool study_answer_is_close(const study_answer *a)
{
    return a->next_seconds / (1.0 + a->next_scatter) < a->seconds * (1.0 + a->scatter);
}

double study_least_level(const study *s, const char *metric)
{
    const double floors = 2.0; /* an error of one floor may be none of the run's */
    double most = 0.0;
    for (size_t i = 0; i < s->n; i++) {
        if (study_is_done(&s->list[i])) most = fmax(most, error_floor(&s->list[i].run->summary, metric));
    }
    return error_is_relative(metric) ? fmax(floors * most, STUDY_ROUND_OFF) : 0.0;
}

int study_answers(const study *s, const char *metric, study_answer out[STUDY_MAX_TARGETS])
{
    enum { FINEST = STUDY_MAX_TARGETS - 1 };
    const double one_per_cent = 0.01;
    double least, most, target[STUDY_MAX_TARGETS];
    int n = 0;
    if (!range_of(s, metric, &least, &most)) return 0;
    const double offered = study_least_level(s, metric);
    least = fmax(least, offered);
    bool has_one_per_cent = !error_is_relative(metric) || most < one_per_cent || offered > one_per_cent;
    /* The finest targets that any case reaches, coarsest first. */
    for (double t = round_down(most); t >= least && t > 0.0; t = round_down(0.99 * t)) {
        if (n == FINEST) {
            for (int k = 1; k < n; k++) target[k - 1] = target[k];
            n--;
        }
        target[n++] = t;
    }
    for (int k = 0; k < n; k++) has_one_per_cent = has_one_per_cent || fabs(target[k] - one_per_cent) < 1e-12;
    if (!has_one_per_cent) target[n++] = one_per_cent;
    for (int k = 0; k < n; k++) out[k] = answer_for(s, metric, target[k]);
    return n;
}

/* The case with the smallest error; there is one. */
static const study_case *best_case(const study *s, const char *metric)
{
    const study_case *best = s->list;
    for (size_t i = 0; i < s->n; i++) {
        const double error = study_error(&s->list[i], metric);
        if (error > 0.0 && !(study_error(best, metric) <= error)) best = &s->list[i];
    }
    return best;
}

void study_answer_text(const study *s, const study_answer *a, char *text, size_t size)
{
    const char *unit = error_unit(a->metric, s->dimensionless);
    char target[ERROR_TEXT];
    (void)snprintf(target, sizeof target, "%g%s%s", a->target * (error_is_relative(a->metric) ? 100.0 : 1.0),
                   unit[0] ? " " : "", unit);
    if (a->best == s->n_groups) {
        const study_case *best = best_case(s, a->metric);
        char least[ERROR_TEXT];
        error_text(a->metric, study_error(best, a->metric), s->dimensionless, least);
        (void)snprintf(text, size, "no variant reaches %s in %s: the smallest error is %s, %s, %.3g s", target,
                       a->metric, least, best->run->label, best->timing.least);
    } else if (a->next == s->n_groups) {
        (void)snprintf(text, size, "for %s in %s choose %s, %.3g s%s", target, a->metric, s->group[a->best], a->seconds,
                       s->n_groups > 1 ? "; no other variant reaches it" : "");
    } else if (study_answer_is_close(a)) {
        (void)snprintf(text, size, "for %s in %s, %s, %.3g s +- %.0f %%, and %s, %.3g s +- %.0f %%, are not told apart",
                       target, a->metric, s->group[a->best], a->seconds, 100.0 * a->scatter, s->group[a->next],
                       a->next_seconds, 100.0 * a->next_scatter);
    } else {
        (void)snprintf(text, size, "for %s in %s choose %s, %.3g s; the next best, %s, needs %.3g s", target, a->metric,
                       s->group[a->best], a->seconds, s->group[a->next], a->next_seconds);
    }
}
