/* What commands that run batches share. */
#ifndef CLI_BATCH_CLI_H
#define CLI_BATCH_CLI_H

#include "batch/batch.h"
#include "cli/cli.h"

typedef struct batch_arguments {
    cli_deck deck;
    batch_options batch;
    bool quiet;
    char dir[CLI_PATH + CLI_SUFFIX], program[BATCH_PATH];
} batch_arguments;

enum { BATCH_KEY_MAX_WALL = 3100 };

/* Takes --jobs (key 'j'), --output ('o'), --threads ('t'), --quiet ('q'), --max-wall and what a deck takes;
 * ARGP_ERR_UNKNOWN for others. */
error_t batch_cli_option(batch_arguments *a, int key, char *arg, struct argp_state *state);
/* Shows the errors of the deck as `check` shows them, and sets what is left of the batch: its folder is by default
 * out/DECK-NAME. The exit status; 0: go on. */
int batch_cli_begin(cli *c, batch_arguments *a, const char *name);

#endif
