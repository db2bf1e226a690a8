#include "cli/batch_cli.h"

#include <errno.h>

error_t batch_cli_option(batch_arguments *a, int key, char *arg, struct argp_state *state)
{
    switch (key) {
    case 'j': a->batch.jobs = cli_whole(state, "jobs", arg); return 0;
    case 'o': a->batch.dir = arg; return 0;
    case 't': a->batch.threads = cli_whole(state, "threads", arg); return 0;
    case 'q': a->quiet = true; return 0;
    case BATCH_KEY_MAX_WALL: a->batch.max_wall = cli_number(state, "max-wall", arg); return 0;
    default: return cli_deck_option(&a->deck, key, arg, state);
    }
}

int batch_cli_begin(cli *c, batch_arguments *a, const char *name)
{
    floe_deck *deck;
    const floe_status status = cli_load(c, &a->deck, false, &deck);
    if (status != FLOE_OK) return cli_refused(c, status);
    floe_deck_destroy(&deck);
    cli_default_folder(&a->deck, name, a->dir, sizeof a->dir);
    batch_find_program(a->program, program_invocation_name);
    c->quiet = a->quiet;
    a->batch.deck = a->deck.path;
    a->batch.dir = a->batch.dir ? a->batch.dir : a->dir;
    a->batch.program = a->program;
    a->batch.stop = c->stop;
    a->batch.progress = a->quiet ? NULL : stderr;
    return 0;
}
