/* The search for the value of a key at which stability ends: bisection, several values at a time where there are
 * processes for them. Pure logic: whoever searches asks for values, has them judged, and tells. */
#ifndef STUDY_STABILITY_SEARCH_H
#define STUDY_STABILITY_SEARCH_H

#include <stdbool.h>
#include <stddef.h>

enum { SEARCH_MAX_TOLD = 128, SEARCH_MOST = 64 };

typedef enum search_answer {
    SEARCH_STABLE,
    SEARCH_UNSTABLE,
    SEARCH_REFUSED /* no deck can be made of the value */
} search_answer;

typedef enum search_outcome {
    SEARCH_OPEN,         /* values are still wanted */
    SEARCH_FOUND,        /* the bracket is as narrow as asked for */
    SEARCH_ALL_STABLE,   /* no limit: stable at every value that was tried */
    SEARCH_ALL_UNSTABLE, /* no limit: unstable at every value that was tried */
    SEARCH_OUT_OF_PROBES /* there is a bracket, wider than asked for */
} search_outcome;

typedef struct search_spec {
    /* The range, from != to; `to` NAN: none, `from` > 0 is where to start, and the range doubles until it holds a
     * limit. */
    double from, to;
    double tolerance; /* width of the bracket over the larger of its ends, > 0 */
    int most;         /* values judged on the way, at most SEARCH_MOST */
} search_spec;

/* Where a search stands. */
typedef struct search_state {
    search_outcome outcome;
    /* The bracket; NAN while unknown. stable > unstable: what is sought is the smallest stable value. */
    double stable, unstable;
    bool refused;  /* the range ended where the deck takes no further value */
    int judged;    /* values on the way */
    double wanted; /* while open: the value that decides next */
} search_state;

typedef struct search {
    search_spec spec;
    struct {
        double x;
        search_answer answer;
    } told[SEARCH_MAX_TOLD];
    size_t n_told;
} search;

void search_begin(search *s, const search_spec *spec);
/* The state after all that has been told. It does not depend on the order in which it was told, nor on values off the
 * way. */
search_state search_look(const search *s);
/* Fills x with up to `most` values to judge next: the one that decides, then those that may decide after it. 0: none is
 * wanted. */
size_t search_next(const search *s, size_t most, double *x);
/* Notes a judgement; what does not fit, or is known, is passed over. */
void search_tell(search *s, double x, search_answer answer);
/* false if a stable value was seen beyond an unstable one: there is more than one limit, and the search has found one
 * of them. */
bool search_is_monotone(const search *s);

#endif
