/* floe check DECK */
#include "cli/cli.h"
#include "run/ready.h"

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

static void print_cells(const scene *s)
{
    for (int a = 0; a < s->mesh.dim; a++) {
        const double cells = (s->mesh.upper[a] - s->mesh.lower[a]) / s->mesh.cell[a];
        printf("%s%.0f", a ? " x " : "", cells);
    }
}

static void print_check_warning(void *user, const char *text)
{
    context_log(user, LOG_WARNING, "%s", text);
}

static void print_start(const scene *s, const run_ready *ready)
{
    if (ready->done)
        printf("ready to run: %zu points, first step %.3g%s, about %.0f steps\n", ready->points, ready->step,
               scene_time_unit(s), ready->steps);
    else
        printf("not made ready, as it has %.3g cells (%.0e at most): `floe plan` does, and says what memory it takes\n",
               ready->cells, RUN_READY_CELLS);
}

int cmd_check(cli *c, int argc, char **argv)
{
    cli_deck d = {0};
    scene *s;
    argp_parse(&argp, argc, argv, 0, NULL, &d);
    run_ready ready;
    floe_status status = cli_check(c, &d, &s);
    if (status != FLOE_OK) return cli_fail(c, status);
    status = run_make_ready(s, &ready, print_check_warning, c->ctx);
    if (status != FLOE_OK) {
        scene_destroy(&s);
        return cli_fail(c, status);
    }
    printf("%s: deck is valid: %s%s%d-D, ", d.path, s->title, s->title[0] ? ", " : "", s->mesh.dim);
    print_cells(s);
    printf(" cells, %d material%s, %d bod%s, coupling %s\n", s->n_materials, s->n_materials == 1 ? "" : "s",
           s->n_bodies, s->n_bodies == 1 ? "y" : "ies", coupling_name(s->coupling));
    print_start(s, &ready);
    status = cli_check_batches(c, &d, s);
    scene_destroy(&s);
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
