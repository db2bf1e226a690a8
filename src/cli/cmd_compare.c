/* floe compare DECK */
#include "cli/study_cli.h"

static error_t parse_compare_option(int key, char *arg, struct argp_state *state)
{
    return study_cli_option(state->input, key, arg, state);
}

static const struct argp_option options[] = {
    {"axis", 'a', "KEY=V1,V2,...", 0, "Vary this key instead of the deck's compare.axis", 0},
    {"output", 'o', "DIR", 0, "Folder of the results (default: out/DECK-compare)", 0},
    STUDY_CLI_OPTIONS,
    {0},
};
static const struct argp argp = {
    .options = options,
    .parser = parse_compare_option,
    .args_doc = "DECK",
    .doc =
        "Run a scene in every coupling of its `runs_as` and for every value of an axis, one after the other, and put "
        "errors, orders and run times side by side. The same command goes on with a comparison that was stopped, and "
        "runs no case again that has ended; one that was cut short goes on from its checkpoint. DIR gets compare.json, "
        "compare.csv, errors.svg, profile.svg (where the "
        "exact solution has a profile) with their data and scripts, and a folder for each case.",
};

int cmd_compare(cli *c, int argc, char **argv)
{
    study_arguments a = {.options = {.name = "compare", .compare = true, .repeat = -1}};
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    return study_cli_run(c, &a);
}
