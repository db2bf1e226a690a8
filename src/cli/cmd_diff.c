/* floe diff A B: looks at the arguments and hands over to python/floe. */
#include "cli/cli.h"
#include "plot/plot.h"

typedef struct arguments {
    const char *dir[2];
    int n_dirs;
    double tolerance; /* 0: none is asked for */
    bool exact, all;
} arguments;

static error_t parse_diff_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case 't': a->tolerance = cli_number(state, "--tolerance", arg); return 0;
    case 'e': a->exact = true; return 0;
    case 'a': a->all = true; return 0;
    case ARGP_KEY_ARG:
        if (a->n_dirs == 2) argp_error(state, "more than two folders");
        a->dir[a->n_dirs++] = arg;
        return 0;
    case ARGP_KEY_END:
        if (a->n_dirs < 2) argp_error(state, "which folders? (two that `floe run` has written)");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    {"tolerance", 't', "SHARE", 0,
     "End with status 6 where a quantity differs by more than this share of its largest value", 0},
    {"exact", 'e', NULL, 0, "End with status 6 where any differs at all", 0},
    {"all", 'a', NULL, 0, "Show all quantities that differ, not the first twenty", 0},
    {0},
};
static const struct argp argp = {
    .options = options,
    .parser = parse_diff_option,
    .args_doc = "A B",
    .doc =
        "Compare the results of two runs: columns of their histories and fields of their snapshots at the same times, "
        "points by their id. Where histories have less than half of their rows at the same times, the second one is "
        "taken between its rows. Shares are of the largest value that either run has of the quantity. Python makes "
        "it (FLOE_PYTHON; numpy, h5py).",
};

int cmd_diff(cli *c, int argc, char **argv)
{
    arguments a = {.n_dirs = 0};
    char tolerance[64];
    const char *word[8] = {"diff"};
    size_t n = 1;
    int exit_status = 0;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    (void)snprintf(tolerance, sizeof tolerance, "--tolerance=%.17g", a.exact ? 0.0 : a.tolerance);
    if (a.exact || a.tolerance > 0.0) word[n++] = tolerance;
    if (a.all) word[n++] = "--all";
    word[n++] = "--";
    for (int k = 0; k < 2; ++k) word[n++] = a.dir[k];
    const floe_status status = python_run(c->ctx, word, n, c->stop, &exit_status);
    return status == FLOE_OK ? exit_status : cli_fail(c, status);
}
