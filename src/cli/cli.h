/* The command line: main parses what comes before the command, each command its own arguments. */
#ifndef CLI_CLI_H
#define CLI_CLI_H

#include "base/context.h"
#include "floe/floe.h"

#include <argp.h>
#include <signal.h>

enum { CLI_MAX_SET = 128, CLI_PATH = 4096, CLI_SUFFIX = 192 };

typedef struct cli {
    floe_context *floe;                /* of what stands on the library; not owned */
    context *ctx;                      /* of batches, pictures and pages; not owned */
    const volatile sig_atomic_t *stop; /* becomes the number of a signal that asks to end */
    bool colour;                       /* standard error is a terminal */
    bool quiet;                        /* the log's warnings are not shown */
} cli;

typedef struct cli_command {
    const char *name;
    const char *doc;
    /* Carries out the command and returns the exit status (docs/outputs.md); argv[0] is "floe NAME". */
    int (*run)(cli *c, int argc, char **argv);
    bool ends_in_order; /* looks at cli.stop on its way: signals only ask it to end */
    bool computes;      /* steps a scene, or makes one ready to step: on threads */
} cli_command;

extern const cli_command cli_commands[];
extern const size_t cli_n_commands;
/* NULL if there is none of that name. */
const cli_command *cli_find(const char *name);

int cmd_check(cli *c, int argc, char **argv);
int cmd_plan(cli *c, int argc, char **argv);
int cmd_run(cli *c, int argc, char **argv);
int cmd_compare(cli *c, int argc, char **argv);
int cmd_study(cli *c, int argc, char **argv);
int cmd_stability(cli *c, int argc, char **argv);
int cmd_picture(cli *c, int argc, char **argv);
int cmd_report(cli *c, int argc, char **argv);
int cmd_diff(cli *c, int argc, char **argv);
int cmd_list(cli *c, int argc, char **argv);
int cmd_new(cli *c, int argc, char **argv);
/* Explains a key of decks, whole or by its last word; the exit status. */
int cli_help_key(cli *c, const char *key);
/* Starts the program again, with threads that sleep while they wait, unless the environment says how they wait. */
void cli_let_threads_sleep(char **argv);

/* A deck as the command line names it: file, --set and --coupling. */
typedef struct cli_deck {
    const char *path;
    const char *set[CLI_MAX_SET];
    size_t n_set;
    char coupling[96]; /* "coupling=NAME", one of `set` */
} cli_deck;

/* Makes the cases of the deck's study and comparison ready, as their runs would be, and prints how many there are. */
floe_status cli_check_batches(const cli *c, const cli_deck *d, const floe_description *of);

/* Takes an argument that several commands share: the deck, --set (key 's'), --coupling (key 'c'). ARGP_ERR_UNKNOWN for
 * others. */
error_t cli_deck_option(cli_deck *d, int key, char *arg, struct argp_state *state);
/* Their entries for an argp table. */
#define CLI_OPTION_SET                                                                                          \
    {                                                                                                           \
        "set", 's', "KEY=VALUE", 0, "Replace a key of the deck, as in --set domain.cell=0.0125 (repeatable)", 0 \
    }
#define CLI_OPTION_COUPLING                                                                                  \
    {                                                                                                        \
        "coupling", 'c', "NAME", 0, "How fluids are represented: mpm, ice, ice-mpm (default: the deck's)", 0 \
    }

/* Loads the deck into *out, which the caller owns; `axes`: the values of its axes, too. Errors are printed, and what the
 * command returns is cli_refused. */
floe_status cli_load(const cli *c, const cli_deck *d, bool axes, floe_deck **out);
int cli_refused(const cli *c, floe_status status);
/* The exit status that belongs to `status`, after the library's message, if there is one, or the context's. */
int cli_end(const cli *c, floe_status status);
int cli_fail(const cli *c, floe_status status);
/* Prints "floe: error: ..." with the word in colour on a terminal. */
void cli_error(const cli *c, const char *format, ...) FLOE_PRINTF(2, 3);
/* Print warnings and errors; `user` is the cli. */
void cli_sink(void *user, log_level level, const char *line);
void cli_log(void *user, floe_log_level level, const char *line);

/* Raises the stop flag as SIGTERM does once `parent` is not this process's parent any more (main.c). */
void cli_end_with_parent(int parent);

/* A number of an option, > 0; otherwise a usage error. */
double cli_number(struct argp_state *state, const char *option, const char *arg);
int cli_whole(struct argp_state *state, const char *option, const char *arg);
/* The part of a path that names the deck: "a/sod.yaml" gives "sod". */
void cli_stem(const char *path, char stem[CLI_PATH]);
/* The name of results that the user has not named: "out/STEM-KIND", and what was set beside the deck ("out/sod-ice-domain.cell=0.01"), so
 * that variants of a deck have folders of their own. */
void cli_default_folder(const cli_deck *d, const char *kind, char *dir, size_t size);

#endif
