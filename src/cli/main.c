/* floe COMMAND ...: finds the command and hands over. */
#include "cli/cli.h"
#include "cli/signals.h"
#include "floe/floe.h"
#include "floe_build.h"

#include "base/text.h"

#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const cli_command cli_commands[] = {
    {"check", "Validate a deck: every error, with its place", cmd_check, false, true},
    {"plan", "Show stages, fields, memory and steps, without running anything", cmd_plan, false, true},
    {"run", "Run a scene", cmd_run, true, true},
    {"compare", "Run a scene in every coupling and spacing, side by side", cmd_compare, true, true},
    {"study", "Run a scene along crossed axes: orders, limits, error against run time", cmd_study, true, true},
    {"stability", "Find how large a value keeps a scene stable, or map two values", cmd_stability, true, true},
    {"picture", "Draw snapshots of a run: points and cells in colour, as PNG", cmd_picture, true, false},
    {"report", "Make one page of HTML of the results in folders", cmd_report, false, false},
    {"diff", "Compare the results of two runs", cmd_diff, true, false},
    {"list", "List what decks can name: materials, shapes, metrics, ...", cmd_list, false, false},
    {"new", "Write a deck to start from, a JSON schema, shell completion", cmd_new, false, false},
};
const size_t cli_n_commands = sizeof cli_commands / sizeof cli_commands[0];

const cli_command *cli_find(const char *name)
{
    for (size_t i = 0; i < cli_n_commands; i++) {
        if (strcmp(cli_commands[i].name, name) == 0) return &cli_commands[i];
    }
    return NULL;
}

static const char *command_name(const void *user, size_t i)
{
    (void)user;
    return i < cli_n_commands ? cli_commands[i].name : NULL;
}

/* What comes before the command. */
typedef struct top {
    const cli_command *command;
    int first;       /* index of the command in argv */
    bool help;       /* `floe help COMMAND` */
    const char *key; /* `floe help KEY` of a deck; NULL: a command */
} top;

static error_t parse_top(int key, char *arg, struct argp_state *state)
{
    top *t = state->input;
    if (key == ARGP_KEY_ARG && !t->help && strcmp(arg, "help") == 0) {
        t->help = true;
        if (state->next == state->argc) argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    }
    if (key == ARGP_KEY_ARG) {
        t->command = cli_find(arg);
        if (!t->command && t->help) t->key = arg;
        if (!t->command && !t->help) {
            const char *near = nearest_name(arg, command_name, NULL);
            argp_error(state, "unknown command '%s'%s%s%s; `floe help` lists them", arg, near ? " (did you mean '" : "",
                       near ? near : "", near ? "'?)" : "");
        }
        t->first = state->next - 1;
        state->next = state->argc; /* the rest is the command's */
        return 0;
    }
    if (key == ARGP_KEY_NO_ARGS)
        argp_error(state, "which command? `floe help` lists them; `floe new > deck.yaml` is where to start");
    return ARGP_ERR_UNKNOWN;
}

static char *list_commands(int key, const char *text, void *input)
{
    (void)input;
    if (key != ARGP_KEY_HELP_POST_DOC) return (char *)text;
    size_t size = 512;
    for (size_t i = 0; i < cli_n_commands; i++) size += strlen(cli_commands[i].doc) + 32;
    char *out = malloc(size);
    if (!out) return (char *)text;
    (void)snprintf(out, size, "Commands:\n");
    for (size_t i = 0; i < cli_n_commands; i++)
        text_add(out, size, "  %-9s  %s\n", cli_commands[i].name, cli_commands[i].doc);
    text_add(out, size,
             "\n`floe COMMAND --help` tells more, `floe help KEY` of a key of decks. Exit status: 0 done; 2 bad usage "
             "or deck; 3 diverged; 4 input or "
             "output failed; 5 interrupted, checkpoint written; 6 a required bar was missed, or a case has no result.");
    return out;
}

static const struct argp top_argp = {
    .parser = parse_top,
    .args_doc = "COMMAND [ARGUMENT...]",
    .doc = "Fluid-structure interaction: an Eulerian multi-material fluid and material points on one mesh.\v",
    .help_filter = list_commands,
};

static void print_version(FILE *stream, struct argp_state *state)
{
    (void)state;
    (void)fprintf(stream, "floe %s (%s)\n%s, %s\n", FLOE_VERSION, FLOE_GIT, FLOE_COMPILER, FLOE_FLAGS);
}

static int run_command(cli *c, const top *t, int argc, char **argv)
{
    char name[64];
    if (t->key) return cli_help_key(c, t->key);
    (void)snprintf(name, sizeof name, "floe %s", t->command->name);
    argv[t->first] = name;
    if (t->help) {
        char *const asked[] = {name, "--help", NULL};
        return t->command->run(c, 2, (char **)asked);
    }
    context_set_sink(c->ctx, cli_sink, c, LOG_WARNING);
    floe_log(c->floe, cli_log, c, FLOE_LOG_WARNING);
    if (t->command->ends_in_order) cli_catch_signals();
    return t->command->run(c, argc - t->first, argv + t->first);
}

/* A reader that has seen enough, as in `floe list | head`, is no error to speak of. */
static int end_of_output(const cli *c)
{
    struct pollfd output = {.fd = STDOUT_FILENO};
    if (poll(&output, 1, 0) == 1 && (output.revents & POLLERR)) return 0;
    cli_error(c, "cannot write to standard output");
    return status_exit(FLOE_IO);
}

int main(int argc, char **argv)
{
    top t = {0};
    argp_err_exit_status = status_exit(FLOE_BAD_INPUT);
    argp_program_version_hook = print_version;
    argp_parse(&top_argp, argc, argv, ARGP_IN_ORDER, NULL, &t);
    if (!t.key && t.command->computes) cli_let_threads_sleep(argv);

    cli c = {.floe = floe_create(),
             .ctx = context_create(),
             .stop = cli_stop_signal(),
             .colour = isatty(STDERR_FILENO) != 0};
    if (!c.floe || !c.ctx) {
        (void)fprintf(stderr, "floe: no memory\n");
        return status_exit(FLOE_NO_MEMORY);
    }
    cli_ignore_signals();
    const floe_status ready = floe_init();
    int status = ready == FLOE_OK ? run_command(&c, &t, argc, argv) : cli_fail(&c, ready);
    if (status == 0 && (fflush(stdout) != 0 || ferror(stdout))) status = end_of_output(&c);
    context_destroy(&c.ctx);
    floe_destroy(&c.floe);
    return status;
}
