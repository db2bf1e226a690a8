/* floe list [TOPIC]: what decks can name. */
#include "cli/cli.h"

#include "base/text.h"

#include <string.h>

static const char *topic_name(const void *user, size_t i)
{
    (void)user;
    return floe_list_name((int)i, NULL);
}

static error_t parse_list_option(int key, char *arg, struct argp_state *state)
{
    const char **chosen = state->input;
    if (key != ARGP_KEY_ARG) return ARGP_ERR_UNKNOWN;
    *chosen = arg;
    for (int k = 0; floe_list_name(k, NULL); k++)
        if (strcmp(floe_list_name(k, NULL), arg) == 0) return 0;
    const char *near = nearest_name(arg, topic_name, NULL);
    argp_error(state, "there is no list of '%s'%s%s%s; `floe list` names them all", arg, near ? " (did you mean '" : "",
               near ? near : "", near ? "'?)" : "");
    return 0;
}

static const struct argp argp = {
    .parser = parse_list_option,
    .args_doc = "[TOPIC]",
    .doc = "List what decks can name, with parameters, units, defaults and sources. TOPIC is one of materials, eos, "
           "laws, membranes, exchange, reactions, shapes, bases, normals, exact, references, metrics, boundaries, "
           "fields; without one the topics are listed.",
};

int cmd_list(cli *c, int argc, char **argv)
{
    const char *chosen = NULL, *name, *doc;
    argp_parse(&argp, argc, argv, 0, NULL, &chosen);
    if (chosen) {
        printf("%s\n", chosen);
        return cli_end(c, floe_list(c->floe, chosen, stdout));
    }
    for (int k = 0; (name = floe_list_name(k, &doc)); k++) printf("  %-10s  %s\n", name, doc);
    return 0;
}
