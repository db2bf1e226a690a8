#include "cli/tolerance_cli.h"
#include "study/tolerance/tolerance.h"

#include <errno.h>

error_t tolerance_cli_option(tolerance_arguments *a, int key, char *arg, struct argp_state *state)
{
    switch (key) {
    case TOLERANCE_KEY: a->tolerance = cli_number(state, "tolerance", arg); return 0;
    case TOLERANCE_KEY_BUDGET: a->budget = cli_number(state, "budget", arg); return 0;
    case TOLERANCE_KEY_METRIC: a->metric = arg; return 0;
    case ARGP_KEY_END:
        if (!(a->tolerance > 0.0) && (a->budget > 0.0 || a->metric))
            argp_error(state, "--budget and --metric belong to --tolerance");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int tolerance_cli_run(cli *c, const tolerance_arguments *a, const tolerance_run_arguments *run)
{
    char dir[CLI_PATH + CLI_SUFFIX], program[BATCH_PATH];
    tolerance *result;
    cli_default_folder(run->deck, "tolerance", dir, sizeof dir);
    batch_find_program(program, program_invocation_name);
    /* The deck's axis of couplings gives way to the one that was asked for. */
    const char *const coupling = run->deck->coupling;
    const tolerance_options o = {.study = {.batch = {.deck = run->deck->path,
                                                     .max_wall = run->max_wall,
                                                     .threads = run->threads,
                                                     .program = program,
                                                     .stop = c->stop,
                                                     .progress = run->quiet ? NULL : stderr},
                                           .set = {run->deck->set, run->deck->n_set},
                                           .axis = &coupling,
                                           .n_axis = coupling[0] ? 1 : 0},
                                 .dir = run->dir ? run->dir : dir,
                                 .tolerance = a->tolerance,
                                 .metric = a->metric,
                                 .budget = a->budget};
    c->quiet = run->quiet;
    floe_status status = tolerance_run(&result, c->ctx, &o);
    if ((status == FLOE_OK || status == FLOE_MISSED_BAR) && !run->quiet) {
        const floe_status printed = tolerance_print(result, stdout);
        printf("results: %s; all cases: %s/cases\n", o.dir, o.dir);
        if (status == FLOE_OK) status = printed;
    }
    tolerance_destroy(&result);
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
