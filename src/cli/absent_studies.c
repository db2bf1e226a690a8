/* In the place of batches of runs where floe is built without them (FLOE_STUDIES). */
#include "cli/tolerance_cli.h"

static int refuse_studies(const cli *c, const char *command)
{
    cli_error(c, "this floe was built without studies: `floe %s` needs one that was configured with -DFLOE_STUDIES=ON",
              command);
    return status_exit(FLOE_BAD_INPUT);
}

int cmd_compare(cli *c, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    return refuse_studies(c, "compare");
}

int cmd_study(cli *c, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    return refuse_studies(c, "study");
}

int cmd_stability(cli *c, int argc, char **argv)
{
    (void)argc;
    (void)argv;
    return refuse_studies(c, "stability");
}

floe_status cli_check_batches(const cli *c, const cli_deck *d, const floe_description *of)
{
    (void)c;
    (void)d;
    (void)of;
    return FLOE_OK; /* nothing here could run them */
}

int tolerance_cli_run(cli *c, const tolerance_arguments *a, const tolerance_run_arguments *run)
{
    (void)a;
    (void)run;
    return refuse_studies(c, "run --tolerance");
}

/* Taken, and refused once the command is carried out. */
error_t tolerance_cli_option(tolerance_arguments *a, int key, char *arg, struct argp_state *state)
{
    if (key == TOLERANCE_KEY) a->tolerance = cli_number(state, "tolerance", arg);
    return key >= TOLERANCE_KEY && key <= TOLERANCE_KEY_METRIC ? 0 : ARGP_ERR_UNKNOWN;
}
