/* `floe run --tolerance`. */
#ifndef CLI_TOLERANCE_CLI_H
#define CLI_TOLERANCE_CLI_H

#include "cli/cli.h"

typedef struct tolerance_arguments {
    double tolerance; /* 0: not asked for */
    double budget;    /* s; 0: no limit */
    const char *metric;
} tolerance_arguments;

enum { TOLERANCE_KEY = 3000, TOLERANCE_KEY_BUDGET, TOLERANCE_KEY_METRIC };

#define TOLERANCE_CLI_OPTIONS                                                                                         \
    {"tolerance",                                                                                                     \
     TOLERANCE_KEY,                                                                                                   \
     "E",                                                                                                             \
     0,                                                                                                               \
     "Choose spacing, basis, solver and whatever else the axes of the deck's study name: its cases are run from "     \
     "cheap to dear until "                                                                                           \
     "one has an error of at most E (1e-2: 1 %), and DIR gets that one's results; what was run is in DIR/cases, and " \
     "the same "                                                                                                      \
     "command goes on with it",                                                                                       \
     1},                                                                                                              \
        {"metric",                                                                                                    \
         TOLERANCE_KEY_METRIC,                                                                                        \
         "NAME",                                                                                                      \
         0,                                                                                                           \
         "Of this error of verify.metrics, or of this quantity of study.quantities, whose error is then estimated "   \
         "(default: the "                                                                                             \
         "first relative error, else the first of them)",                                                             \
         1},                                                                                                          \
    {                                                                                                                 \
        "budget", TOLERANCE_KEY_BUDGET, "S", 0,                                                                       \
            "Stop looking after S seconds of run time in all; DIR gets the best case", 1                              \
    }

/* Takes those options; ARGP_ERR_UNKNOWN for others. */
error_t tolerance_cli_option(tolerance_arguments *a, int key, char *arg, struct argp_state *state);

/* What `floe run` has been told beside them. */
typedef struct tolerance_run_arguments {
    const cli_deck *deck;
    const char *dir; /* NULL: out/DECK-tolerance */
    int threads;     /* of each case; 0: one */
    double max_wall; /* s of each case; 0: as the deck says */
    bool quiet;
} tolerance_run_arguments;

/* Runs the cases, prints what was chosen, and returns the exit status. */
int tolerance_cli_run(cli *c, const tolerance_arguments *a, const tolerance_run_arguments *run);

#endif
