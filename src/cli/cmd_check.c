/* floe check DECK */
#include "cli/cli.h"
#include "scene/remark.h"

static error_t parse(int key, char *arg, struct argp_state *state)
{
    return cli_deck_option(state->input, key, arg, state);
}

static const struct argp_option options[] = {CLI_OPTION_SET, CLI_OPTION_COUPLING, {0}};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "DECK",
    .doc = "Validate a deck. Every error is shown with its file, line and column, what was expected, and the nearest "
           "known name. What can be run and will not be right is warned of, with figures. Nothing is written.",
};

static void print_cells(const scene *s)
{
    for (int a = 0; a < s->mesh.dim; a++) {
        const double cells = (s->mesh.upper[a] - s->mesh.lower[a]) / s->mesh.cell[a];
        printf("%s%.0f", a ? " x " : "", cells);
    }
}

static void warn(void *user, const char *text)
{
    context_log(user, LOG_WARNING, "%s", text);
}

int cmd_check(cli *c, int argc, char **argv)
{
    cli_deck d = {0};
    scene *s;
    argp_parse(&argp, argc, argv, 0, NULL, &d);
    const floe_status status = cli_check(c, &d, &s);
    if (status != FLOE_OK) return cli_fail(c, status);
    printf("%s: deck is valid: %s%s%d-D, ", d.path, s->title, s->title[0] ? ", " : "", s->mesh.dim);
    print_cells(s);
    printf(" cells, %d material%s, %d bod%s, coupling %s\n", s->n_materials, s->n_materials == 1 ? "" : "s",
           s->n_bodies, s->n_bodies == 1 ? "y" : "ies", coupling_name(s->coupling));
    scene_remarks(s, warn, c->ctx);
    scene_destroy(&s);
    return 0;
}
