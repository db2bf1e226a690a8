/* floe report DIR...: looks at the arguments and hands over to python/floe. */
#include "cli/cli.h"
#include "floe_build.h"
#include "plot/plot.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DIRS = 256, MAX_TIMES = 32 };

typedef struct arguments {
    const char *dir[MAX_DIRS];
    size_t n_dirs;
    char time[MAX_TIMES][48];
    size_t n_times;
    const char *file, *title;
    bool quiet;
    char default_file[CLI_PATH + 32];
} arguments;

/* "0,1e-3,5e-3" */
static void take_times(arguments *a, const char *text, struct argp_state *state)
{
    const char *at = text;
    for (;;) {
        char *end;
        errno = 0;
        const double value = strtod(at, &end);
        if (end == at || errno != 0 || !isfinite(value) || (*end != ',' && *end != '\0'))
            argp_error(state, "--times takes numbers of seconds, as in --times 0,1e-3, not '%s'", text);
        if (a->n_times == MAX_TIMES) argp_error(state, "--times takes at most %d times", MAX_TIMES);
        (void)snprintf(a->time[a->n_times++], sizeof a->time[0], "--time=%.17g", value);
        if (*end == '\0') return;
        at = end + 1;
    }
}

static error_t parse_report_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case 'o': a->file = arg; return 0;
    case 't': take_times(a, arg, state); return 0;
    case 'n': a->title = arg; return 0;
    case 'q': a->quiet = true; return 0;
    case ARGP_KEY_ARG:
        if (a->n_dirs == MAX_DIRS) argp_error(state, "more than %d folders", MAX_DIRS);
        for (size_t length = strlen(arg); length > 1 && arg[length - 1] == '/'; length--) arg[length - 1] = '\0';
        a->dir[a->n_dirs++] = arg;
        return 0;
    case ARGP_KEY_END:
        if (a->n_dirs == 0)
            argp_error(state, "which folders? (those that run, compare, study or stability have written)");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "The page (default: DIR/report.html; of several folders, report.html)", 0},
    {"times", 't', "T1,T2,...", 0, "Field pictures at these times, in s (default: up to 12 through the whole run)", 0},
    {"title", 'n', "TEXT", 0, "Title of the page (default: that of the scene)", 0},
    {"quiet", 'q', NULL, 0, "Do not say where the page is", 0},
    {0},
};
static const struct argp argp = {
    .options = options,
    .parser = parse_report_option,
    .args_doc = "DIR...",
    .doc = "Make one page of HTML of the folders that floe run, compare, study and stability have written: what was "
           "run, errors and run times, plots with their data, conservation, time by stage, pictures of the fields. The "
           "page holds all it shows and needs no network; the plots stand beside it as files too, in a folder named "
           "after it. Python makes it (FLOE_PYTHON; numpy, h5py, matplotlib, jinja2).",
};

static floe_status make_page(const cli *c, const arguments *a, int *exit_status)
{
    char title[CLI_PATH], output[CLI_PATH + 64];
    const char *word[MAX_DIRS + MAX_TIMES + 8] = {"report", output};
    size_t n = 2;
    (void)snprintf(output, sizeof output, "--output=%s", a->file);
    for (size_t i = 0; i < a->n_times; i++) word[n++] = a->time[i];
    if (a->title) {
        (void)snprintf(title, sizeof title, "--title=%s", a->title);
        word[n++] = title;
    }
    if (a->quiet) word[n++] = "--quiet";
    word[n++] = "--version=" FLOE_VERSION " (" FLOE_GIT ")";
    word[n++] = "--";
    for (size_t i = 0; i < a->n_dirs; i++) word[n++] = a->dir[i];
    return python_run(c->ctx, word, n, NULL, exit_status);
}

int cmd_report(cli *c, int argc, char **argv)
{
    arguments a = {0};
    int exit_status = 0;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    if (!a.file) {
        (void)snprintf(a.default_file, sizeof a.default_file, "%s%sreport.html", a.n_dirs == 1 ? a.dir[0] : "",
                       a.n_dirs == 1 ? "/" : "");
        a.file = a.default_file;
    }
    const floe_status status = make_page(c, &a, &exit_status);
    return status == FLOE_OK ? exit_status : cli_fail(c, status);
}
