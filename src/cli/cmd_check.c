/* floe check DECK */
#include "base/text.h"
#include "base/wrapped.h"
#include "cli/cli.h"

#include <math.h>

static error_t parse_check_option(int key, char *arg, struct argp_state *state)
{
    return cli_deck_option(state->input, key, arg, state);
}

static const struct argp_option options[] = {CLI_OPTION_SET, CLI_OPTION_COUPLING, {0}};
static const struct argp argp = {
    .options = options,
    .parser = parse_check_option,
    .args_doc = "DECK",
    .doc = "Validate a deck. Every error is shown with its file, line and column, what was expected, and the nearest "
           "known name. Then the scene is made ready as a run makes it, up to its first step, and so are the cases of "
           "its study and its comparison: all if they are small, else the first and the last. What can be run and will "
           "not be right is warned of, with figures. Nothing is written.",
};

static void print_deck(const cli_deck *d, const floe_description *of)
{
    char cells[64] = "";
    for (int a = 0; a < of->dimension; a++) text_add(cells, sizeof cells, "%s%.0f", a ? " x " : "", of->cells[a]);
    wrapped_printf(stdout, "%s: deck is valid: %s%s%d-D, %s cells, %d material%s, %d bod%s, coupling %s\n", d->path,
                   of->title, of->title[0] ? ", " : "", of->dimension, cells, of->materials,
                   of->materials == 1 ? "" : "s", of->bodies, of->bodies == 1 ? "y" : "ies", of->coupling);
}

static void print_start(const floe_description *of, const floe_start *start)
{
    const double gigabyte = 1e9;
    if (start->ready)
        printf("ready to run: %zu point%s, first step %.3g%s, about %.0f step%s\n", start->points,
               start->points == 1 ? "" : "s", start->step, of->dimensionless ? "" : " s", start->steps,
               nearbyint(start->steps) == 1.0 ? "" : "s");
    else if (start->bytes > 0.0 && isfinite(start->available))
        wrapped_printf(stdout,
                       "not made ready, as it has %.3g cells (%.0e at most): it would hold %.3g GB of the %.3g GB that "
                       "are available; `floe plan` says of what, and how many steps it takes\n",
                       start->cells, start->most_cells, start->bytes / gigabyte, start->available / gigabyte);
    else
        wrapped_printf(
            stdout,
            "not made ready, as it has %.3g cells (%.0e at most): `floe plan` does, and says what memory it takes\n",
            start->cells, start->most_cells);
}

int cmd_check(cli *c, int argc, char **argv)
{
    cli_deck d = {0};
    floe_deck *deck;
    floe_start start;
    argp_parse(&argp, argc, argv, 0, NULL, &d);
    floe_status status = cli_load(c, &d, true, &deck);
    if (status != FLOE_OK) return cli_refused(c, status);
    status = floe_rehearse(deck, &start);
    if (status != FLOE_OK) {
        const int exit_status = cli_end(c, status);
        floe_deck_destroy(&deck);
        return exit_status;
    }
    const floe_description of = floe_describe(deck);
    print_deck(&d, &of);
    print_start(&of, &start);
    status = cli_check_batches(c, &d, &of);
    floe_deck_destroy(&deck);
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
