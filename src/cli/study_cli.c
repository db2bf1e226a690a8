#include "cli/study_cli.h"

#include <errno.h>
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
    case 'j': o->jobs = cli_whole(state, "jobs", arg); return 0;
    case 'o': o->dir = arg; return 0;
    case 't': o->threads = cli_whole(state, "threads", arg); return 0;
    case 'q': a->quiet = true; return 0;
    case STUDY_KEY_AGAIN: o->again = true; return 0;
    case STUDY_KEY_SPOIL: o->spoil = true; return 0;
    case STUDY_KEY_REPEAT: o->repeat = strcmp(arg, "0") == 0 ? 0 : cli_whole(state, "repeat", arg); return 0;
    case STUDY_KEY_MAX_WALL: o->max_wall = cli_number(state, "max-wall", arg); return 0;
    default: return cli_deck_option(&a->deck, key, arg, state);
    }
}

static void set_study_options(study_arguments *a, const cli *c)
{
    study_options *o = &a->options;
    cli_default_folder(&a->deck, o->name, a->dir, sizeof a->dir);
    if (!o->dir) o->dir = a->dir;
    batch_find_program(a->program, program_invocation_name);
    o->program = a->program;
    o->deck = a->deck.path;
    o->set = (deck_overrides){a->deck.set, a->deck.n_set};
    o->axis = a->axis;
    o->stop = c->stop;
    o->progress = a->quiet ? NULL : stderr;
}

int study_cli_run(cli *c, study_arguments *a)
{
    study *result;
    scene *s;
    /* The deck's own errors are shown as `check` shows them. */
    floe_status status = cli_load(c, &a->deck, &s);
    if (status != FLOE_OK) return cli_fail(c, status);
    scene_destroy(&s);
    c->quiet = a->quiet;
    set_study_options(a, c);
    status = study_run(&result, c->ctx, &a->options);
    if ((status == FLOE_OK || status == FLOE_INTERRUPTED || status == FLOE_MISSED_BAR) && !a->quiet) {
        (void)fprintf(stderr, "\n");
        const floe_status printed = study_print(result, stdout);
        printf("results: %s\n", a->options.dir);
        if (status == FLOE_OK) status = printed;
    }
    study_destroy(&result);
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
