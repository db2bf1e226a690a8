/* floe run DECK */
#include "cli/tolerance_cli.h"
#include "run/run.h"

#include <stdlib.h>
#include <string.h>

typedef struct arguments {
    cli_deck deck;
    run_options options;
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
    case 'o': a->options.dir = arg; return 0;
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

static long long counter_of(const run_summary *r, const char *name)
{
    for (int i = 0; i < r->n_counters; i++)
        if (strcmp(r->counters[i].name, name) == 0) return r->counters[i].value;
    return 0;
}

static void print_solver(const run_summary *r)
{
    if (r->solver[0] == '\0' || strncmp(r->solver, "dynamic", 7) == 0) return;
    printf("solver %s; %lld steps, %lld iterations of Newton's method, %lld of conjugate gradients\n", r->solver,
           r->steps, counter_of(r, "balance_iterations"), counter_of(r, "balance_cg_iterations"));
}

static void print_result(const run_summary *r, const char *dir)
{
    printf("%s: t = %.6g%s, %lld steps (%lld rejected), %.3g s of wall time\n", r->status, r->time,
           r->dimensionless ? "" : " s", r->steps, r->rejected_steps, r->wall_seconds);
    print_solver(r);
    printf("drift: mass %.1e, momentum %.1e, ", r->drift_mass, r->drift_momentum);
    if (!isnan(r->drift_moment)) printf("moment of momentum %.1e, ", r->drift_moment);
    printf("energy %.1e\n", r->drift_energy);
    for (int i = 0; i < r->n_errors; i++) printf("%s: %.6g\n", r->errors[i].name, r->errors[i].value);
    printf("results: %s (fields.xdmf opens in ParaView with its XDMF Reader)\n", dir);
    if (r->notes[0]) printf("note: %s\n", r->notes);
}

int cmd_run(cli *c, int argc, char **argv)
{
    arguments a = {0};
    run_summary summary;
    scene *s;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    floe_status status = cli_load(c, &a.deck, &s);
    if (status != FLOE_OK) return cli_fail(c, status);
    if (a.tolerance.tolerance > 0.0) {
        scene_destroy(&s);
        return tolerance_cli_run(
            c, &a.tolerance,
            &(tolerance_run_arguments){&a.deck, a.options.dir, a.options.threads, a.options.max_wall, a.quiet});
    }
    if (!a.options.dir) {
        cli_default_folder(&a.deck, coupling_name(s->coupling), a.dir, sizeof a.dir);
        a.options.dir = a.dir;
    }
    c->quiet = a.quiet;
    if (a.parent > 0) cli_end_with_parent(a.parent);
    a.options.stop = c->stop;
    a.options.progress = a.quiet ? NULL : stderr;
    a.options.sink = cli_sink;
    a.options.sink_user = c;
    a.options.sink_detail = LOG_WARNING;
    status = run_scene(c->ctx, s, &a.options, &summary);
    scene_destroy(&s);
    if (status != FLOE_OK) return cli_fail(c, status);
    if (!a.quiet) print_result(&summary, a.options.dir);
    /* Of a quiet run only what makes its answer doubtful. */
    if (a.quiet && strstr(summary.notes, "WARNING")) (void)fprintf(stderr, "floe: %s\n", summary.notes);
    return 0;
}
