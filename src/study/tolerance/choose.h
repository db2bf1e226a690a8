/* Which case to run next, to reach an error in the least time: from curves of error and time against spacing, as far as
 * they are known.
 *
 * A curve is a variant of a scene (basis, coupling, solver, ...) along spacings. Its error is taken to fall as h^order
 * and its time to grow as h^-exponent, both by its own two finest cases, so that what is not known yet can be
 * predicted. Cases are run from cheap to dear; a curve whose predicted time to the tolerance is above the best one's
 * waits, and comes back if the others turn out worse. */
#ifndef STUDY_CHOOSE_H
#define STUDY_CHOOSE_H

#include <stdbool.h>
#include <stddef.h>

typedef enum choose_state { CHOOSE_OPEN, CHOOSE_DONE, CHOOSE_FAILED } choose_state;

typedef struct choose_case {
    double h;      /* > 0, spacing or any other number that gets smaller as cases get dearer */
    double weight; /* > 0, expected cost in any unit, the same for all curves; used where no time is known */
    choose_state state;
    double seconds; /* of a case that is done: what it took */
    double error;   /* of a case that is done; NAN: not known (yet) */
    bool sure;      /* the error may be relied on */
    double settled; /* the error of the next finer case if it finds what this one did; 0: not known */
} choose_case;

typedef enum choose_standing {
    CHOOSE_RUNS, /* it may go on */
    CHOOSE_SLOWER, /* predicted to take longer to the tolerance than the best one, or its next case than the best in all */
    CHOOSE_HOPELESS, /* not even its finest case would do at its measured order, or at the second if that is higher */
    CHOOSE_BROKEN,   /* two of its cases have failed */
    CHOOSE_SPENT     /* all its cases have been run */
} choose_standing;

typedef struct choose_curve {
    choose_case *list; /* n, from the coarsest to the finest; not owned */
    size_t n;

    /* Filled by choose_next. */
    double order, exponent; /* measured; NAN: not yet */
    size_t next;            /* first case that is finer than all that were run; n: none */
    double next_seconds;    /* predicted; NAN: nothing to predict by */
    size_t reach;           /* first case of those left that is predicted to reach the tolerance; n: none */
    double reach_seconds;   /* predicted time of that; INFINITY: none */
    /* By extrapolation beyond the cases: the spacing at which the tolerance would be met, and the time that it would
     * take; NAN. */
    double wanted_h, wanted_seconds;
    choose_standing standing;
} choose_curve;

typedef enum choose_action {
    CHOOSE_RUN,        /* run this case */
    CHOOSE_REACHED,    /* this case has reached the tolerance, and none that has is cheaper */
    CHOOSE_UNREACHED,  /* no case that is left is predicted to reach it; this one has the smallest error */
    CHOOSE_OUT_OF_TIME /* the next case is predicted to take longer than the time left; as UNREACHED */
} choose_action;

typedef struct choose_step {
    choose_action action;
    size_t curve, at; /* n curves: there is no such case */
} choose_step;

/* What to do now, with `left` seconds to go (INFINITY: no limit). `needed` is the number of cases from which a curve
 * has an error that can be relied on: 1 where errors are measured, 3 where they are estimated. */
choose_step choose_next(choose_curve *list, size_t n, double tolerance, size_t needed, double left);

#endif
