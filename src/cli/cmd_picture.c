/* floe picture DIR */
#include "cli/cli.h"
#include "draw/field_picture.h"
#include "draw/picture.h"
#include "io/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct arguments {
    const char *dir;
    const char *file;
    double time; /* s; NAN: the last */
    bool all;
    field_picture_options options;
    int ranges;
} arguments;

static void take_range(arguments *a, const char *arg, struct argp_state *state)
{
    char *colon, *end = NULL;
    double upper = 0.0;
    const double lower = strtod(arg, &colon);
    if (*colon == ':') upper = strtod(colon + 1, &end);
    if (colon == arg || !end || end == colon + 1 || *end != '\0' || !isfinite(lower) || !isfinite(upper) ||
        !(lower < upper))
        argp_error(state, "--range takes LO:HI, two numbers with LO < HI, not '%s'", arg);
    if (a->ranges == 2) argp_error(state, "--range: a picture has two colour bars, not more");
    a->options.range[a->ranges++] = (field_range){lower, upper};
}

static double take_time(const char *arg, struct argp_state *state)
{
    char *end;
    const double time = strtod(arg, &end);
    if (end == arg || *end != '\0' || !isfinite(time))
        argp_error(state, "--time takes a number of seconds, not '%s'", arg);
    return time;
}

static int take_width(const char *arg, struct argp_state *state)
{
    char *end;
    const long width = strtol(arg, &end, 10);
    if (end == arg || *end != '\0' || width < 240 || width > PICTURE_MAX_WIDTH)
        argp_error(state, "--width takes a whole number of pixels from 240 to %d, not '%s'", PICTURE_MAX_WIDTH, arg);
    return (int)width;
}

static error_t parse_picture_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case 't': a->time = take_time(arg, state); return 0;
    case 'a': a->all = true; return 0;
    case 'p': a->options.points = arg; return 0;
    case 'c': a->options.cells = arg; return 0;
    case 'r': take_range(a, arg, state); return 0;
    case 'd': a->options.dark = true; return 0;
    case 'w': a->options.width = take_width(arg, state); return 0;
    case 'o': a->file = arg; return 0;
    case ARGP_KEY_ARG:
        if (a->dir) argp_error(state, "one run at a time: '%s' is too much", arg);
        a->dir = arg;
        return 0;
    case ARGP_KEY_END:
        if (!a->dir) argp_error(state, "which run? (the folder that `floe run` has written)");
        if (a->all && !isnan(a->time)) argp_error(state, "--all and --time exclude each other");
        if (a->all && a->file) argp_error(state, "--output names one file; --all writes DIR/pictures");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    {"time", 't', "T", 0, "The snapshot nearest to this time, in seconds (default: the last one)", 0},
    {"all", 'a', NULL, 0, "Every snapshot, all with the same ranges", 0},
    {"points", 'p', "FIELD", 0,
     "What colours the points; none leaves them out (default: von_mises of solids, pressure of fluids)", 0},
    {"cells", 'c', "FIELD", 0,
     "What colours the cells, and a fluid's points beside solids; none leaves them out (default: pressure)", 0},
    {"range", 'r', "LO:HI", 0,
     "The range of the first colour bar, in the unit of the field; given again: of the second", 0},
    {"dark", 'd', NULL, 0, "For a dark page", 0},
    {"width", 'w', "PX", 0, "Width of the picture (default: 720)", 0},
    {"output", 'o', "FILE", 0, "The picture's file (default: DIR/pictures/NUMBER.png)", 0},
    {0},
};
static const struct argp argp = {
    .options = options,
    .parser = parse_picture_option,
    .args_doc = "DIR",
    .doc = "Draw snapshots of a run as PNG: points coloured by one field over cells coloured by another, with axes and "
           "colour bars. DIR is the folder that `floe run` has written. A vector is shown by its magnitude, or by a "
           "component: velocity_x. A run in 1-D gives curves over x, one in 3-D the plane through its middle.",
};

/* "DIR/pictures/000004-sigma_r-dark.png": what was asked for tells pictures of one snapshot apart. */
static void name_file(const arguments *a, long number, char path[2 * CLI_PATH])
{
    const field_picture_options *o = &a->options;
    (void)snprintf(path, (size_t)2 * CLI_PATH, "%s/pictures/%06ld%s%.100s%s%.100s%s.png", a->dir, number,
                   o->points ? "-" : "", o->points ? o->points : "", o->cells ? "-" : "", o->cells ? o->cells : "",
                   o->dark ? "-dark" : "");
}

static floe_status make_folder(cli *c, const char *dir)
{
    char path[2 * CLI_PATH];
    (void)snprintf(path, sizeof path, "%s/pictures", dir);
    return folder_make(c->ctx, path);
}

static floe_status draw_snapshot(cli *c, const arguments *a, long number)
{
    char path[2 * CLI_PATH];
    name_file(a, number, path);
    if (!a->file) TRY(make_folder(c, a->dir));
    TRY(field_picture_write(c->ctx, a->dir, number, &a->options, a->file ? a->file : path, NULL));
    printf("%s\n", a->file ? a->file : path);
    return FLOE_OK;
}

static floe_status draw_last(cli *c, const arguments *a)
{
    snapshot_time last;
    TRY(snapshot_last(&last, c->ctx, a->dir));
    return draw_snapshot(c, a, last.number);
}

/* The snapshot nearest to the wanted time. */
static floe_status draw_nearest(cli *c, const arguments *a, const snapshot_times *t)
{
    size_t best = 0;
    for (size_t i = 0; i < t->n; i++) {
        if (fabs(t->entry[i].time - a->time) < fabs(t->entry[best].time - a->time)) best = i;
    }
    return draw_snapshot(c, a, t->entry[best].number);
}

static floe_status draw_all(cli *c, arguments *a, const snapshot_times *t)
{
    TRY(field_picture_common_range(c->ctx, a->dir, t, &a->options));
    for (size_t i = 0; i < t->n; i++) {
        if (*c->stop) return fail(c->ctx, FLOE_INTERRUPTED, "stopped after %zu of %zu pictures", i, t->n);
        TRY(draw_snapshot(c, a, t->entry[i].number));
    }
    return FLOE_OK;
}

static floe_status draw_chosen(cli *c, arguments *a)
{
    snapshot_times times;
    if (!a->all && isnan(a->time)) return draw_last(c, a);
    TRY(snapshot_times_read(&times, c->ctx, a->dir));
    const floe_status status = a->all ? draw_all(c, a, &times) : draw_nearest(c, a, &times);
    snapshot_times_free(c->ctx, &times);
    return status;
}

int cmd_picture(cli *c, int argc, char **argv)
{
    arguments a = {.time = NAN};
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    const floe_status status = draw_chosen(c, &a);
    return status == FLOE_OK ? 0 : cli_fail(c, status);
}
