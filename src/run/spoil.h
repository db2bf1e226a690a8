/* What a run has come to, as a wrong program could have it: frozen, never begun, twice or half as far, or the other way round. Checks that
 * let such a state pass are blind to it. Nothing runs again: the end is read from the run's folder. */
#ifndef RUN_SPOIL_H
#define RUN_SPOIL_H

#include "io/csv.h"
#include "io/summary.h"
#include "run/output.h"
#include "run/setup.h"

/* X(enumerator, name, motion, velocity, doc): fields, about their start, are `motion` times as far; velocities `velocity` times. */
#define SPOILER_LIST(X)                                                                    \
    X(SPOILER_FROZEN, "frozen", 0.0, 0.0, "all fields as at the start, and nothing moves") \
    X(SPOILER_INITIAL, "initial", 0.0, NAN, "all fields as at the start, velocities too")  \
    X(SPOILER_DOUBLED, "doubled", 2.0, 2.0, "all changes and velocities doubled")          \
    X(SPOILER_HALVED, "halved", 0.5, 0.5, "all changes and velocities halved")             \
    X(SPOILER_MIRRORED, "mirrored", -1.0, -1.0, "all changes and velocities the other way round")

typedef enum spoiler {
#define SPOILER_ENUM(enumerator, name, motion, velocity, doc) enumerator,
    SPOILER_LIST(SPOILER_ENUM)
#undef SPOILER_ENUM
        SPOILER_COUNT
} spoiler;

const char *spoiler_name(spoiler kind);
/* SPOILER_COUNT if there is none of that name. */
spoiler spoiler_find(const char *name, size_t length);

typedef struct spoiled_run {
    run_setup start, end; /* owned */
    run_output files;     /* owned */
} spoiled_run;

/* Reads the end of the run in DIR. `start` and `end` are two scenes of its deck, and must stay until spoil_close, which is called in any
 * case. Errors: those of a run's setup and of reading its checkpoint. */
floe_status spoil_open(spoiled_run *r, scene *start, scene *end, const char *dir);
void spoil_close(spoiled_run *r);

/* Adds the errors of the spoiled state and of its history, which spoil_history gave, to *out. */
floe_status spoil_measure(spoiled_run *r, spoiler kind, const csv_table *rows, run_summary *out);
/* Makes the values of a history those that the spoiled run would have written: energies of motion and strain go with the square, what counts and what is
 * kept (mass, drifts, ledger) stays. */
void spoil_history(csv_table *rows, spoiler kind);

#endif
