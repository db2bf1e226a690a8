/* floe study DECK */
#include "cli/study_cli.h"

#include <string.h>

enum { KEY_OVER = 1000, KEY_COUPLINGS, KEY_BASES, LIST_SIZE = 512 };

typedef struct arguments {
    study_arguments study; /* first: what the shared options fill */
    char couplings[LIST_SIZE], bases[LIST_SIZE];
} arguments;

static void add_list(arguments *a, const char *key, const char *arg, char text[LIST_SIZE], struct argp_state *state)
{
    (void)snprintf(text, LIST_SIZE, "%s=%.400s", key, arg);
    study_cli_axis(&a->study, text, state);
}

static error_t parse_study_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case KEY_OVER: a->study.options.over = arg; return 0;
    case KEY_COUPLINGS: add_list(a, "coupling", arg, a->couplings, state); return 0;
    case KEY_BASES: add_list(a, "method.basis", arg, a->bases, state); return 0;
    default: return study_cli_option(&a->study, key, arg, state);
    }
}

static const struct argp_option options[] = {
    {"axis", 'a', "KEY=V1,V2,...", 0,
     "Vary this key (repeatable; all combinations are run), instead of the deck's study.axes of that key", 0},
    {"couplings", KEY_COUPLINGS, "A,B,...", 0, "The axis coupling=A,B,...", 0},
    {"bases", KEY_BASES, "A,B,...", 0, "The axis method.basis=A,B,...", 0},
    {"over", KEY_OVER, "KEY", 0, "Take orders over this axis (default: domain.cell, else the first axis of numbers)",
     0},
    {"output", 'o', "DIR", 0, "Folder of the results (default: out/DECK-study)", 0},
    STUDY_CLI_OPTIONS,
    {0},
};
static const struct argp argp = {
    .options = options,
    .parser = parse_study_option,
    .args_doc = "DECK",
    .doc =
        "Run a scene along crossed axes: errors, orders, limits without an exact solution, and error against run time. "
        "A case that diverges or fails is a result. The same command goes on with a study that was stopped or killed, "
        "and runs no case again that has ended; one that was cut short goes on from its checkpoint. DIR gets "
        "study.json, study.csv, errors.svg, profile.svg with their "
        "data and scripts, and a folder for each case.",
};

int cmd_study(cli *c, int argc, char **argv)
{
    arguments a = {.study.options = {.name = "study", .repeat = -1}};
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    return study_cli_run(c, &a.study);
}
