/* floe stability DECK */
#include "cli/batch_cli.h"
#include "study/stability/stability.h"

enum { MAX_AXES = 16, KEY_EACH = 1000, KEY_TOLERANCE, KEY_GROWTH, KEY_RELATIVE };

typedef struct arguments {
    batch_arguments batch;
    stability_options options;
    const char *over[MAX_AXES], *each[MAX_AXES];
} arguments;

static void add_text(struct argp_state *state, const char **list, size_t *n, const char *arg)
{
    if (*n == MAX_AXES) argp_error(state, "too many keys: '%s'", arg);
    list[(*n)++] = arg;
}

static error_t parse_stability_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    stability_options *o = &a->options;
    switch (key) {
    case 'k': add_text(state, a->over, &o->n_over, arg); return 0;
    case KEY_EACH: add_text(state, a->each, &o->n_each, arg); return 0;
    case KEY_TOLERANCE: o->tolerance = cli_number(state, "tolerance", arg); return 0;
    case KEY_GROWTH: o->growth = cli_number(state, "growth", arg); return 0;
    case KEY_RELATIVE: o->relative_to = cli_number(state, "relative-to", arg); return 0;
    default: return batch_cli_option(&a->batch, key, arg, state);
    }
}

static const struct argp_option options[] = {
    {"over", 'k', "KEY[=FROM:TO]", 0,
     "The key whose limit is sought, from its value in the deck or between two values; given twice, as KEY=V1,V2,...: "
     "a map (default: the deck's stability.over)",
     0},
    {"each", KEY_EACH, "KEY=V1,V2,...", 0, "Search for every combination of these values (repeatable)", 0},
    {"tolerance", KEY_TOLERANCE, "X", 0, "Width of the last bracket, relative (default: the deck's, else 0.01)", 0},
    {"growth", KEY_GROWTH, "X", 0,
     "Unstable: kinetic and strain energy exceed what they can be X times (default: the deck's, else 100)", 0},
    {"relative-to", KEY_RELATIVE, "X", 0, "Show values over X, in the unit of the range (a CFL step)", 0},
    CLI_OPTION_COUPLING,
    CLI_OPTION_SET,
    {"jobs", 'j', "N", 0, "Runs at a time; the limits do not depend on it", 0},
    {"threads", 't', "N", 0, "Threads of each run (default: 1)", 0},
    {"max-wall", BATCH_KEY_MAX_WALL, "S", 0, "Most seconds for each run; one that takes longer ends its search", 0},
    {"output", 'o', "DIR", 0, "Folder of the results (default: out/DECK-stability)", 0},
    {"quiet", 'q', NULL, 0, "No progress and no table", 0},
    {0},
};
static const struct argp argp = {
    .options = options,
    .parser = parse_stability_option,
    .args_doc = "DECK",
    .doc =
        "Find the largest value of a key at which a scene stays stable, by bisection, or map the values of two keys. A "
        "run is unstable if it diverges, has rejected steps, energies that are no numbers, or more kinetic and strain "
        "energy than there can be. DIR gets stability.json, stability.csv, a figure, and a folder for each run; what "
        "has been run is not run again.",
};

int cmd_stability(cli *c, int argc, char **argv)
{
    arguments a = {0};
    stability *result = NULL;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    stability_options *o = &a.options;
    const int refused = batch_cli_begin(c, &a.batch, "stability");
    if (refused) return refused;
    o->batch = a.batch.batch;
    o->set = (deck_overrides){a.batch.deck.set, a.batch.deck.n_set};
    o->over = a.over;
    o->each = a.each;
    floe_status status = stability_run(&result, c->ctx, o);
    if (result && result->n_probes > 0 && !c->quiet) {
        (void)fprintf(stderr, "\n");
        const floe_status printed = stability_print(result, stdout);
        printf("results: %s\n", o->batch.dir);
        if (status == FLOE_OK) status = printed;
    }
    stability_destroy(&result);
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
