/* floe picture DIR: looks at the arguments and hands over to python/floe. */
#include "cli/cli.h"
#include "plot/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_WIDTH = 8000, MAX_ARGUMENTS = 16 };

/* What is handed over: words of its own, as "--width=720". */
typedef struct arguments {
    const char *dir;
    bool all, dark, timed, named;
    int ranges;
    size_t n;
    char word[MAX_ARGUMENTS][CLI_PATH];
} arguments;

static void hand_over(arguments *a, struct argp_state *state, const char *option, const char *value)
{
    if (a->n == MAX_ARGUMENTS) argp_error(state, "too many options");
    const int length = snprintf(a->word[a->n++], CLI_PATH, "%s=%s", option, value);
    if (length >= CLI_PATH) argp_error(state, "%s: the text is too long", option);
}

static void take_range(arguments *a, const char *arg, struct argp_state *state)
{
    char *colon, *end = NULL;
    double upper = 0.0;
    const double lower = strtod(arg, &colon);
    if (*colon == ':') upper = strtod(colon + 1, &end);
    if (colon == arg || !end || end == colon + 1 || *end != '\0' || !isfinite(lower) || !isfinite(upper) ||
        !(lower < upper))
        argp_error(state, "--range takes LO:HI, two numbers with LO < HI, not '%s'", arg);
    if (a->ranges++ == 2) argp_error(state, "--range: a picture has two colour bars, not more");
    hand_over(a, state, "--range", arg);
}

static void check_time(const char *arg, struct argp_state *state)
{
    char *end;
    const double time = strtod(arg, &end);
    if (end == arg || *end != '\0' || !isfinite(time))
        argp_error(state, "--time takes a number of seconds, not '%s'", arg);
}

static void check_width(const char *arg, struct argp_state *state)
{
    char *end;
    const long width = strtol(arg, &end, 10);
    if (end == arg || *end != '\0' || width < 240 || width > MOST_WIDTH)
        argp_error(state, "--width takes a whole number of pixels from 240 to %d, not '%s'", MOST_WIDTH, arg);
}

/* "z=0.5", or "1,1,0=0.5": components of a normal, and the distance from the origin along it */
static void check_plane(const char *arg, struct argp_state *state)
{
    const char *at = strchr(arg, '=');
    char *end = NULL;
    bool right = at != NULL;
    if (right && !(arg[0] >= 'x' && arg[0] <= 'z' && at == arg + 1)) {
        const char *from = arg;
        for (int c = 0; right && c < 3; ++c, from = end + 1) {
            const double component = strtod(from, &end);
            right = end != from && isfinite(component) && *end == (c < 2 ? ',' : '=');
        }
    }
    const double place = right ? strtod(at + 1, &end) : 0.0;
    if (!right || end == at + 1 || *end != '\0' || !isfinite(place))
        argp_error(state,
                   "--plane takes an axis and a place on it, as in --plane z=0.5, or a normal and a distance, as in "
                   "--plane 1,1,0=0.5, not '%s'",
                   arg);
}

/* "30,20": azimuth and elevation in degrees */
static void check_view(const char *arg, struct argp_state *state)
{
    char *comma, *end = NULL;
    double elevation = 0.0;
    const double azimuth = strtod(arg, &comma);
    if (*comma == ',') elevation = strtod(comma + 1, &end);
    if (comma == arg || !end || end == comma + 1 || *end != '\0' || !isfinite(azimuth) || !(fabs(elevation) <= 90.0))
        argp_error(state, "--view takes an azimuth and an elevation in degrees, as in --view 30,20, not '%s'", arg);
}

static void check_mirror(const char *arg, struct argp_state *state)
{
    if (strcmp(arg, "x") != 0 && strcmp(arg, "y") != 0 && strcmp(arg, "xy") != 0)
        argp_error(state, "--mirror takes x, y or xy, not '%s'", arg);
}

static void end_of_arguments(const arguments *a, struct argp_state *state)
{
    if (!a->dir) argp_error(state, "which run? (the folder that `floe run` has written)");
    if (a->all && a->timed) argp_error(state, "--all and --time exclude each other");
    if (a->all && a->named) argp_error(state, "--output names one file; --all writes DIR/pictures");
}

static void take_dir(arguments *a, const char *arg, struct argp_state *state)
{
    if (a->dir) argp_error(state, "one run at a time: '%s' is too much", arg);
    a->dir = arg;
}

static error_t parse_picture_option(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case 't':
        check_time(arg, state);
        a->timed = true;
        hand_over(a, state, "--time", arg);
        return 0;
    case 'a': a->all = true; return 0;
    case 'p': hand_over(a, state, "--points", arg); return 0;
    case 'c': hand_over(a, state, "--cells", arg); return 0;
    case 'r': take_range(a, arg, state); return 0;
    case 'l':
        check_plane(arg, state);
        hand_over(a, state, "--plane", arg);
        return 0;
    case 'm':
        check_mirror(arg, state);
        hand_over(a, state, "--mirror", arg);
        return 0;
    case 'v':
        check_view(arg, state);
        hand_over(a, state, "--view", arg);
        return 0;
    case 'd': a->dark = true; return 0;
    case 'w':
        check_width(arg, state);
        hand_over(a, state, "--width", arg);
        return 0;
    case 'o':
        a->named = true;
        hand_over(a, state, "--output", arg);
        return 0;
    case ARGP_KEY_ARG: take_dir(a, arg, state); return 0;
    case ARGP_KEY_END: end_of_arguments(a, state); return 0;
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
    {"plane", 'l', "AXIS=PLACE", 0,
     "The plane of a run in 3-D, as in z=0.5, or 1,1,0=0.5 across a direction (default: the middle one along z)", 0},
    {"view", 'v', "AZIMUTH,ELEVATION", 0,
     "A run in 3-D as it is seen from there, in degrees from x towards y and upwards: points as surfaces, cells on the "
     "--plane, or on the far sides of the domain",
     0},
    {"mirror", 'm', "AXES", 0,
     "Complete a symmetric scene at the lower side of the picture's horizontal axis (x), its upright one (y), or both "
     "(xy); with --view, of the scene's own axes x and y",
     0},
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
           "component: velocity_x. A run in 1-D gives curves over x, one in 3-D a plane, or with --view "
           "what is seen from a side. Python draws them (FLOE_PYTHON; numpy, h5py, matplotlib).",
};

int cmd_picture(cli *c, int argc, char **argv)
{
    arguments a = {0};
    const char *word[MAX_ARGUMENTS + 5] = {"picture"};
    size_t n = 1;
    int exit_status = 0;
    argp_parse(&argp, argc, argv, 0, NULL, &a);
    for (size_t i = 0; i < a.n; i++) word[n++] = a.word[i];
    if (a.all) word[n++] = "--all";
    if (a.dark) word[n++] = "--dark";
    word[n++] = "--";
    word[n++] = a.dir;
    const floe_status status = python_run(c->ctx, word, n, c->stop, &exit_status);
    return status == FLOE_OK ? exit_status : cli_fail(c, status);
}
