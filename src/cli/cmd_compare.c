/* floe compare DECK */
#include "cli/cli.h"
#include "study/compare.h"

#include <errno.h>
#include <string.h>

typedef struct arguments {
    cli_deck deck;
    compare_options options;
    bool quiet;
    char dir[CLI_PATH + 32], program[BATCH_PATH];
} arguments;

static error_t parse(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case 'a': a->options.axis = arg; return 0;
    case 'j': a->options.jobs = cli_whole(state, "jobs", arg); return 0;
    case 'o': a->options.dir = arg; return 0;
    case 't': a->options.threads = cli_whole(state, "threads", arg); return 0;
    case 'q': a->quiet = true; return 0;
    default: return cli_deck_option(&a->deck, key, arg, state);
    }
}

static const struct argp_option options[] = {
    {"axis", 'a', "KEY=V1,V2,...", 0, "Vary this key instead of the deck's compare.axis", 0},
    {"output", 'o', "DIR", 0, "Folder of the results (default: out/DECK-compare)", 0},
    CLI_OPTION_SET,
    {"threads", 't', "N", 0, "Threads of each case (default: 1, at which times are compared)", 0},
    {"jobs", 'j', "N", 0, "Cases at a time; their times then disturb each other", 0},
    {"quiet", 'q', NULL, 0, "No progress and no table", 0},
    {0},
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "DECK",
    .doc =
        "Run a scene in every coupling of its `runs_as` and for every value of an axis, one after the other, and put "
        "errors, orders and run times side by side. DIR gets compare.json, compare.csv, errors.svg, profile.svg (where "
        "the exact solution has radial stresses), their script compare.gp, and a folder for each case.",
};

static void set_options(arguments *a, cli *c)
{
    char stem[CLI_PATH];
    compare_options *o = &a->options;
    cli_stem(a->deck.path, stem);
    (void)snprintf(a->dir, sizeof a->dir, "out/%s-compare", stem);
    if (!o->dir) o->dir = a->dir;
    batch_find_program(a->program, program_invocation_name);
    c->quiet = a->quiet;
    o->program = a->program;
    o->deck = a->deck.path;
    o->set = (deck_overrides){a->deck.set, a->deck.n_set};
    o->stop = c->stop;
    o->progress = a->quiet ? NULL : stderr;
}

int cmd_compare(cli *c, int argc, char **argv)
{
    arguments a = {0};
    comparison *result;
    scene *s;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    /* The deck's own errors are shown as `check` shows them. */
    floe_status status = cli_load(c, &a.deck, &s);
    if (status != FLOE_OK) return cli_fail(c, status);
    scene_destroy(&s);
    set_options(&a, c);
    status = compare_run(&result, c->ctx, &a.options);
    if ((status == FLOE_OK || status == FLOE_INTERRUPTED) && !a.quiet) {
        (void)fprintf(stderr, "\n");
        const floe_status printed = compare_print(result, stdout);
        printf("results: %s\n", a.options.dir);
        if (status == FLOE_OK) status = printed;
    }
    compare_destroy(&result);
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
