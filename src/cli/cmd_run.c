/* floe run DECK */
#include "base/wrapped.h"
#include "cli/tolerance_cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct arguments {
    cli_deck deck;
    floe_options options;
    tolerance_arguments tolerance;
    bool quiet;
    int parent; /* process that the run ends with; 0: none */
    char dir[CLI_PATH + CLI_SUFFIX];
} arguments;

enum { KEY_MAX_WALL = 1000, KEY_RESUME, KEY_PARENT };

static error_t parse_run_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case 'o': a->options.directory = arg; return 0;
    case 't': a->options.threads = cli_whole(state, "threads", arg); return 0;
    case 'q': a->quiet = true; return 0;
    case KEY_RESUME: a->options.resume = true; return 0;
    case KEY_PARENT: a->parent = atoi(arg); return 0;
    case KEY_MAX_WALL: a->options.max_wall = cli_number(state, "max-wall", arg); return 0;
    case ARGP_KEY_END:
        if (a->tolerance.tolerance > 0.0 && a->options.resume)
            argp_error(state, "--tolerance goes on by itself with what it has run: leave --resume out");
        (void)tolerance_cli_option(&a->tolerance, key, arg, state);
        return cli_deck_option(&a->deck, key, arg, state);
    default:
        if (tolerance_cli_option(&a->tolerance, key, arg, state) == 0) return 0;
        return cli_deck_option(&a->deck, key, arg, state);
    }
}

static const struct argp_option options[] = {
    {"output", 'o', "DIR", 0,
     "Folder of the results (default: out/DECK-COUPLING, out/DECK-tolerance, followed by what --set sets)", 0},
    CLI_OPTION_COUPLING,
    CLI_OPTION_SET,
    {"threads", 't', "N", 0, "Threads (default: what the scene can use); the results do not depend on it", 0},
    {"resume", KEY_RESUME, NULL, 0, "Go on from the checkpoint in DIR, to the same bits as a run that was not stopped",
     0},
    {"max-wall", KEY_MAX_WALL, "S", 0, "Stop with a checkpoint after S seconds, as Ctrl-C does", 0},
    {"parent", KEY_PARENT, "PID", OPTION_HIDDEN, "End as on a signal once this is not the parent process any more", 0},
    {"quiet", 'q', NULL, 0, "No progress and no result on standard output", 0},
    {0, 0, 0, 0, "The answer to within an error:", 1},
    TOLERANCE_CLI_OPTIONS,
    {0},
};
static const struct argp argp = {
    .options = options,
    .parser = parse_run_option,
    .args_doc = "DECK",
    .doc = "Run a scene. DIR gets summary.json, history.csv, fields/ with fields.xdmf (for ParaView and VisIt), "
           "checkpoint.h5, the resolved deck.yaml and run.log. Ctrl-C and the signals of batch systems end the run "
           "with a checkpoint.",
};

static long long count_of(const floe_run *r, const char *name)
{
    const double n = floe_value(r, name);
    return isnan(n) ? 0 : (long long)n;
}

static void print_solver(const floe_run *r)
{
    const char *solver = floe_text(r, "solver");
    if (solver[0] == '\0' || strncmp(solver, "dynamic", 7) == 0) return;
    printf("solver %s; %lld steps, %lld iterations of Newton's method, %lld of conjugate gradients\n", solver,
           count_of(r, "steps"), count_of(r, "counters.balance_iterations"),
           count_of(r, "counters.balance_cg_iterations"));
}

static void print_result(const floe_run *r, bool dimensionless, const char *dir)
{
    const double moment = floe_value(r, "conservation.angular_momentum");
    const char *metric;
    printf("%s: t = %.6g%s, %lld steps (%lld rejected), %.3g s of wall time\n", floe_run_status(r),
           floe_value(r, "time"), dimensionless ? "" : " s", count_of(r, "steps"), count_of(r, "rejected_steps"),
           floe_value(r, "wall_seconds"));
    print_solver(r);
    printf("drift: mass %.1e, momentum %.1e, ", floe_value(r, "conservation.mass"),
           floe_value(r, "conservation.momentum"));
    if (!isnan(moment)) printf("moment of momentum %.1e, ", moment);
    printf("energy %.1e\n", floe_value(r, "conservation.energy"));
    for (int i = 0; (metric = floe_error_name(r, i)); i++) {
        char name[128];
        (void)snprintf(name, sizeof name, "errors.%s", metric);
        printf("%s: %.6g\n", metric, floe_value(r, name));
    }
    printf("results: %s (fields.xdmf opens in ParaView with its XDMF Reader)\n", dir);
    if (floe_text(r, "notes")[0]) wrapped_printf(stdout, "note: %s\n", floe_text(r, "notes"));
}

/* Runs the deck, and says what it has come to. */
static int run_deck(cli *c, arguments *a, floe_deck *deck)
{
    const floe_description of = floe_describe(deck);
    floe_run *run;
    if (!a->options.directory) {
        cli_default_folder(&a->deck, of.coupling, a->dir, sizeof a->dir);
        a->options.directory = a->dir;
    }
    a->options.stop = c->stop;
    a->options.progress = a->quiet ? NULL : stderr;
    const floe_status status = floe_execute(deck, &a->options, &run);
    if (status == FLOE_OK && !a->quiet) print_result(run, of.dimensionless, a->options.directory);
    /* Of a quiet run only what makes its answer doubtful. */
    if (status == FLOE_OK && a->quiet && strstr(floe_text(run, "notes"), "WARNING"))
        wrapped_printf(stderr, "floe: %s\n", floe_text(run, "notes"));
    floe_run_destroy(&run);
    return cli_end(c, status);
}

int cmd_run(cli *c, int argc, char **argv)
{
    arguments a = {0};
    floe_deck *deck;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    const floe_status loaded = cli_load(c, &a.deck, false, &deck);
    if (loaded != FLOE_OK) return cli_refused(c, loaded);
    if (a.tolerance.tolerance > 0.0) {
        floe_deck_destroy(&deck);
        return tolerance_cli_run(
            c, &a.tolerance,
            &(tolerance_run_arguments){&a.deck, a.options.directory, a.options.threads, a.options.max_wall, a.quiet});
    }
    c->quiet = a.quiet;
    if (a.parent > 0) cli_end_with_parent(a.parent);
    const int status = run_deck(c, &a, deck);
    floe_deck_destroy(&deck);
    return status;
}
