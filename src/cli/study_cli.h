/* What `floe study` and `floe compare` share. */
#ifndef CLI_STUDY_CLI_H
#define CLI_STUDY_CLI_H

#include "cli/batch_cli.h"
#include "study/study.h"

typedef struct study_arguments {
    batch_arguments batch;
    study_options options;
    const char *axis[2 * SCENE_MAX_AXES];
} study_arguments;

enum { STUDY_KEY_AGAIN = 2000, STUDY_KEY_REPEAT, STUDY_KEY_SPOIL };

#define STUDY_CLI_OPTIONS                                                                                            \
    CLI_OPTION_SET, {"threads", 't', "N", 0, "Threads of each case (default: 1, at which times are compared)", 0},   \
        {"jobs", 'j', "N", 0, "Cases at a time; their times then disturb each other", 0},                            \
        {"repeat",                                                                                                   \
         STUDY_KEY_REPEAT,                                                                                           \
         "N",                                                                                                        \
         0,                                                                                                          \
         "Time each case N times, alone and on one thread, and take the best (0: do not)",                           \
         0},                                                                                                         \
        {"max-wall", BATCH_KEY_MAX_WALL, "S", 0, "Stop a case after S seconds: that is its result", 0},              \
        {"spoil",                                                                                                    \
         STUDY_KEY_SPOIL,                                                                                            \
         NULL,                                                                                                       \
         0,                                                                                                          \
         "Judge each case again with its result frozen, doubled, halved and mirrored: checks that let one pass are " \
         "named",                                                                                                    \
         0},                                                                                                         \
        {"again", STUDY_KEY_AGAIN, NULL, 0, "Run cases again that have ended before", 0},                            \
    {                                                                                                                \
        "quiet", 'q', NULL, 0, "No progress and no table", 0                                                         \
    }

/* Takes an argument that both commands have; ARGP_ERR_UNKNOWN for others. */
error_t study_cli_option(study_arguments *a, int key, char *arg, struct argp_state *state);
/* Adds "KEY=V1,V2,..."; the text is not copied. */
void study_cli_axis(study_arguments *a, const char *text, struct argp_state *state);
/* Runs the study, prints its table, and returns the exit status. */
int study_cli_run(cli *c, study_arguments *a);

#endif
