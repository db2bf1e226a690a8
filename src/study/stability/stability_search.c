#include "study/stability/stability_search.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double stride = 2.0; /* between the values of a range that is not given */
enum { MAX_STRIDES = 20, DIGITS = 9 };

void search_begin(search *s, const search_spec *spec)
{
    *s = (search){.spec = *spec};
    if (s->spec.most > SEARCH_MOST) s->spec.most = SEARCH_MOST;
}

/* Values are those that their text in a deck stands for. */
static double as_text(double x)
{
    char text[40];
    (void)snprintf(text, sizeof text, "%.*g", DIGITS, x);
    return strtod(text, NULL);
}

/* Halves ratios, or differences where the range holds zero. */
static double middle_of_range(double a, double b)
{
    return as_text(a > 0.0 && b > 0.0 ? sqrt(a) * sqrt(b) : 0.5 * (a + b));
}

static bool is_known(const search *s, double x, search_answer *answer)
{
    for (size_t i = 0; i < s->n_told; i++) {
        if (s->told[i].x != x) continue;
        *answer = s->told[i].answer;
        return true;
    }
    return false;
}

/* The judgement of x, if there is one; else x is what is wanted. */
static bool ask_answer(const search *s, search_state *at, double x, search_answer *answer)
{
    if (!is_known(s, x, answer)) {
        at->wanted = x;
        return false;
    }
    at->judged++;
    if (*answer == SEARCH_STABLE) at->stable = x;
    if (*answer == SEARCH_UNSTABLE) at->unstable = x;
    at->refused = at->refused || *answer == SEARCH_REFUSED;
    return true;
}

static search_outcome one_sided(search_answer answer)
{
    return answer == SEARCH_STABLE ? SEARCH_ALL_STABLE : SEARCH_ALL_UNSTABLE;
}

/* Judges both ends of the range; true once they differ. */
static bool judge_ends(const search *s, search_state *at)
{
    search_answer first, second;
    if (!ask_answer(s, at, s->spec.from, &first) || !ask_answer(s, at, s->spec.to, &second)) return false;
    if (first != second) return true;
    at->outcome = one_sided(first);
    return false;
}

/* Goes up from a stable start, down from an unstable one, until the other kind is met; true once it is. */
static bool find_range(const search *s, search_state *at)
{
    search_answer start, answer;
    if (!ask_answer(s, at, s->spec.from, &start)) return false;
    const double factor = start == SEARCH_STABLE ? stride : 1.0 / stride;
    double x = s->spec.from;
    for (int k = 0; k < MAX_STRIDES; k++) {
        x = as_text(x * factor);
        if (!ask_answer(s, at, x, &answer)) return false;
        if (answer == SEARCH_REFUSED) break;
        if (answer != start) return true;
    }
    at->outcome = one_sided(start);
    return false;
}

static bool is_narrow(const search *s, const search_state *at)
{
    return fabs(at->stable - at->unstable) <= s->spec.tolerance * fmax(fabs(at->stable), fabs(at->unstable));
}

search_state search_look(const search *s)
{
    search_state at = {.outcome = SEARCH_OPEN, .stable = NAN, .unstable = NAN, .wanted = NAN};
    search_answer answer;
    if (!(isnan(s->spec.to) ? find_range(s, &at) : judge_ends(s, &at))) return at;
    while (!is_narrow(s, &at)) {
        const double x = middle_of_range(at.stable, at.unstable);
        const bool spent = at.judged >= s->spec.most || x == at.stable || x == at.unstable;
        if (!spent && !ask_answer(s, &at, x, &answer)) return at;
        if (!spent && answer != SEARCH_REFUSED) continue;
        at.outcome = SEARCH_OUT_OF_PROBES;
        return at;
    }
    at.outcome = SEARCH_FOUND;
    return at;
}

static bool is_in(const double *x, size_t n, double value)
{
    for (size_t i = 0; i < n; i++) {
        if (x[i] == value) return true;
    }
    return false;
}

/* Level by level: what is wanted after k more answers, whichever they are. A supposed answer is told to a copy. */
static void list_likely_questions(const search *s, int depth, size_t most, double *x, size_t *n)
{
    const search_state at = search_look(s);
    if (at.outcome != SEARCH_OPEN || *n >= most) return;
    if (depth == 0) {
        if (!is_in(x, *n, at.wanted)) x[(*n)++] = at.wanted;
        return;
    }
    for (int answer = SEARCH_STABLE; answer <= SEARCH_UNSTABLE; answer++) {
        search copy = *s;
        search_tell(&copy, at.wanted, (search_answer)answer);
        list_likely_questions(&copy, depth - 1, most, x, n);
    }
}

size_t search_next(const search *s, size_t most, double *x)
{
    size_t n = 0;
    for (int depth = 0; n < most && depth < 8; depth++) {
        const size_t before = n;
        list_likely_questions(s, depth, most, x, &n);
        if (depth > 1 && n == before) break;
    }
    return n;
}

void search_tell(search *s, double x, search_answer answer)
{
    search_answer known;
    if (s->n_told == SEARCH_MAX_TOLD || is_known(s, x, &known)) return;
    s->told[s->n_told].x = x;
    s->told[s->n_told++].answer = answer;
}

bool search_is_monotone(const search *s)
{
    /* Stable values on both sides of an unstable one, or the other way round. */
    for (size_t i = 0; i < s->n_told; i++) {
        bool below = false, above = false;
        if (s->told[i].answer == SEARCH_REFUSED) continue;
        for (size_t k = 0; k < s->n_told; k++) {
            if (s->told[k].answer == SEARCH_REFUSED || s->told[k].answer == s->told[i].answer) continue;
            below = below || s->told[k].x < s->told[i].x;
            above = above || s->told[k].x > s->told[i].x;
        }
        if (below && above) return false;
    }
    return true;
}
