/* floe plan DECK: what a scene would do and hold. */
#include "cli/cli.h"

typedef struct arguments {
    cli_deck deck;
    bool json;
} arguments;

enum { KEY_JSON = 1000 };

static error_t parse_plan_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    if (key == KEY_JSON) {
        a->json = true;
        return 0;
    }
    return cli_deck_option(&a->deck, key, arg, state);
}

static const struct argp_option options[] = {
    CLI_OPTION_COUPLING, CLI_OPTION_SET, {"json", KEY_JSON, NULL, 0, "Write JSON", 0}, {0}};
static const struct argp argp = {
    .options = options,
    .parser = parse_plan_option,
    .args_doc = "DECK",
    .doc =
        "Show the stages of a step with what each reads and writes, the fields with their bytes, and the steps that "
        "the run would need, and whether the memory of this machine holds it. A scene of more than a million cells is "
        "described from coarser ones, and takes no memory itself. Nothing is run or written.",
};

int cmd_plan(cli *c, int argc, char **argv)
{
    arguments a = {0};
    floe_deck *deck;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    const floe_status status = cli_load(c, &a.deck, false, &deck);
    if (status != FLOE_OK) return cli_refused(c, status);
    const int exit_status = cli_end(c, floe_plan(deck, a.json, stdout));
    floe_deck_destroy(&deck);
    return exit_status;
}
