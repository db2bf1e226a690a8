/* A scene made ready for its first step: what `run` goes on from, and all that `check` and `plan` do of a run. */
#ifndef RUN_SETUP_H
#define RUN_SETUP_H

#include "run/initial.h"
#include "sim/sim.h"

/* Scenes of more cells are not made ready only to be looked at (`floe check`, `floe plan`): what they need is estimated. */
#define RUN_READY_CELLS 1e6

typedef struct run_setup {
    scene *scene;             /* not owned */
    exact solution;           /* of verify.exact; owned */
    sim *sim;                 /* owned */
    double exact_seconds;     /* wall time that the exact solution has taken, s */
    double exact_cpu_seconds; /* processor time of the same, s */
} run_setup;

/* Sets the scene up under its coupling; it must stay where it is until setup_end, which is called in any case.
 * FLOE_BAD_INPUT: what a run refuses before its first step; the message has the place in the deck. */
floe_status setup_begin(run_setup *u, scene *s);
void setup_end(run_setup *u);

#endif
