/* The public ring (floe/floe.h) over the rooms. */
#include "floe/floe.h"

#include "base/memory.h"
#include "deck/deck.h"
#include "floe_build.h"
#include "io/io.h"
#include "run/catalogue.h"
#include "run/run.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include <pthread.h>

struct floe_context {
    context *ctx;       /* owned */
    deck_report report; /* of the last deck; owned */
};

struct floe_deck {
    floe_context *floe; /* not owned */
    scene *scene;       /* owned */
};

struct floe_run {
    context *ctx; /* not owned */
    run_summary summary;
};

/* What is said once to a process's libraries is, of necessity, state of the process. */
static pthread_once_t init_once = PTHREAD_ONCE_INIT;
static floe_status init_status = FLOE_OK;

static void init_library(void)
{
    gsl_set_error_handler_off();
    deck_init();
    init_status = io_init(NULL);
}

floe_status floe_init(void)
{
    return pthread_once(&init_once, init_library) == 0 ? init_status : FLOE_INTERNAL;
}

const char *floe_version(void)
{
    return FLOE_VERSION;
}

floe_context *floe_create(void)
{
    context *ctx = context_create();
    floe_context *floe = NULL;
    if (memory_new(ctx, &floe, 1, sizeof *floe) != FLOE_OK) {
        context_destroy(&ctx);
        return NULL;
    }
    floe->ctx = ctx;
    return floe;
}

void floe_destroy(floe_context **floe)
{
    if (!floe || !*floe) return;
    context *ctx = (*floe)->ctx;
    deck_report_free(&(*floe)->report);
    memory_free(ctx, floe);
    context_destroy(&ctx);
}

const char *floe_message(const floe_context *floe)
{
    if (!floe) return "";
    return floe->report.text ? floe->report.text : context_message(floe->ctx);
}

/* Forgets what earlier calls had to say. */
static void clear_messages(floe_context *floe)
{
    deck_report_free(&floe->report);
    context_clear(floe->ctx);
}

static floe_status load_deck(floe_deck *deck, const char *path, const deck_overrides *set)
{
    floe_context *floe = deck->floe;
    deck_catalogue *catalogue;
    TRY(catalogue_create(&catalogue, floe->ctx));
    const floe_status status = deck_load(&deck->scene, floe->ctx, path, set, catalogue, &floe->report);
    catalogue_destroy(floe->ctx, &catalogue);
    return status;
}

floe_status floe_load(floe_context *floe, const char *path, const char *const *set, size_t n_set, floe_deck **deck)
{
    *deck = NULL;
    clear_messages(floe);
    TRY(memory_new(floe->ctx, deck, 1, sizeof **deck));
    (*deck)->floe = floe;
    const floe_status status = load_deck(*deck, path, &(deck_overrides){set, n_set});
    if (status != FLOE_OK) floe_deck_destroy(deck);
    return status;
}

void floe_deck_destroy(floe_deck **deck)
{
    if (!deck || !*deck) return;
    context *ctx = (*deck)->floe->ctx;
    scene_destroy(&(*deck)->scene);
    memory_free(ctx, deck);
}

floe_status floe_execute(floe_deck *deck, const floe_options *options, floe_run **run)
{
    context *ctx = deck->floe->ctx;
    *run = NULL;
    clear_messages(deck->floe);
    if (!options || !options->directory)
        return fail(ctx, FLOE_BAD_INPUT, "a run needs a directory for its results: floe_options.directory");
    TRY(memory_new(ctx, run, 1, sizeof **run));
    (*run)->ctx = ctx;
    const run_options o = {.dir = options->directory,
                           .resume = options->resume,
                           .max_wall = options->max_wall,
                           .threads = options->threads};
    return run_scene(ctx, deck->scene, &o, &(*run)->summary);
}

void floe_run_destroy(floe_run **run)
{
    if (!run || !*run) return;
    context *ctx = (*run)->ctx;
    memory_free(ctx, run);
}

/* The rest of `name` after "PREFIX.", NULL if it begins otherwise. */
static const char *rest_after_prefix(const char *name, const char *prefix)
{
    const size_t length = strlen(prefix);
    return strncmp(name, prefix, length) == 0 && name[length] == '.' ? name + length + 1 : NULL;
}

static double find_value(const summary_value *value, int n, const char *name)
{
    for (int i = 0; i < n; i++) {
        if (strcmp(value[i].name, name) == 0) return value[i].value;
    }
    return NAN;
}

static double find_counter(const run_summary *r, const char *name)
{
    for (int i = 0; i < r->n_counters; i++) {
        if (strcmp(r->counters[i].name, name) == 0) return (double)r->counters[i].value;
    }
    return NAN;
}

static double find_summary_number(const run_summary *r, const char *name)
{
    const summary_value plain[] = {
        {"time", r->time},
        {"steps", (double)r->steps},
        {"rejected_steps", (double)r->rejected_steps},
        {"wall_seconds", r->wall_seconds},
        {"cells", (double)r->cells},
        {"points", (double)r->points},
        {"cell_updates", r->cell_updates},
        {"point_updates", r->point_updates},
        {"peak_rss_bytes", (double)r->peak_rss_bytes},
        {"conservation.mass", r->drift_mass},
        {"conservation.momentum", r->drift_momentum},
        {"conservation.angular_momentum", r->drift_moment},
        {"conservation.energy", r->drift_energy},
    };
    return find_value(plain, (int)(sizeof plain / sizeof plain[0]), name);
}

double floe_value(const floe_run *run, const char *name)
{
    const run_summary *r = &run->summary;
    if (rest_after_prefix(name, "errors")) return find_value(r->errors, r->n_errors, rest_after_prefix(name, "errors"));
    if (rest_after_prefix(name, "counters")) return find_counter(r, rest_after_prefix(name, "counters"));
    if (rest_after_prefix(name, "seconds_by_stage"))
        return find_value(r->seconds_by_stage, r->n_stages, rest_after_prefix(name, "seconds_by_stage"));
    return find_summary_number(r, name);
}

const char *floe_run_status(const floe_run *run)
{
    return run->summary.status;
}
