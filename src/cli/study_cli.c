#include "cli/study_cli.h"

#include <string.h>

void study_cli_axis(study_arguments *a, const char *text, struct argp_state *state)
{
    if (a->options.n_axis == sizeof a->axis / sizeof a->axis[0]) argp_error(state, "too many axes");
    a->axis[a->options.n_axis++] = text;
}

error_t study_cli_option(study_arguments *a, int key, char *arg, struct argp_state *state)
{
    study_options *o = &a->options;
    switch (key) {
    case 'a': study_cli_axis(a, arg, state); return 0;
    case STUDY_KEY_AGAIN: o->again = true; return 0;
    case STUDY_KEY_SPOIL: o->spoil = true; return 0;
    case STUDY_KEY_REPEAT: o->repeat = strcmp(arg, "0") == 0 ? 0 : cli_whole(state, "repeat", arg); return 0;
    default: return batch_cli_option(&a->batch, key, arg, state);
    }
}

int study_cli_run(cli *c, study_arguments *a)
{
    study *result;
    study_options *o = &a->options;
    const int refused = batch_cli_begin(c, &a->batch, o->name);
    if (refused) return refused;
    o->batch = a->batch.batch;
    o->set = (deck_overrides){a->batch.deck.set, a->batch.deck.n_set};
    o->axis = a->axis;
    floe_status status = study_run(&result, c->ctx, o);
    if ((status == FLOE_OK || status == FLOE_INTERRUPTED || status == FLOE_MISSED_BAR) && !c->quiet) {
        (void)fprintf(stderr, "\n");
        const floe_status printed = study_print(result, stdout);
        printf("results: %s\n", o->batch.dir);
        if (status == FLOE_OK) status = printed;
    }
    study_destroy(&result);
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
