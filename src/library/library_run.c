/* Decks run to their end (floe/floe.h). */
#include "library/library_internal.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

struct floe_run {
    context *ctx; /* not owned */
    run_summary summary;
};

/* A simulation for callbacks alone. */
static floe_status call_before(void *user, sim *s)
{
    floe_simulation *of = user;
    of->sim = s;
    if (!of->field) TRY(field_list_make(of));
    return library_call_back(of, of->options.before_step);
}

static floe_status call_after(void *user, sim *s)
{
    floe_simulation *of = user;
    of->sim = s;
    if (!of->field) TRY(field_list_make(of));
    return library_call_back(of, of->options.after_step);
}

static floe_status run_deck(floe_deck *deck, const floe_options *options, run_summary *summary)
{
    context *ctx = deck->floe->ctx;
    floe_simulation *watched;
    TRY(memory_new(ctx, &watched, 1, sizeof *watched));
    *watched = (floe_simulation){.deck = deck, .ctx = ctx, .options = *options, .refreshed = -1, .busy = true};
    const run_options o = {.dir = options->directory,
                           .resume = options->resume,
                           .max_wall = options->max_wall,
                           .threads = options->threads,
                           .stop = options->stop,
                           .progress = options->progress,
                           .sink = deck->floe->log ? library_log : NULL,
                           .sink_user = deck->floe,
                           .sink_detail = deck->floe->detail,
                           .before_step = options->before_step ? call_before : NULL,
                           .after_step = options->after_step ? call_after : NULL,
                           .hook_user = watched};
    deck->in_use = true;
    const floe_status status = run_scene(ctx, deck->scene, &o, summary);
    deck->in_use = false;
    field_list_free(watched);
    output_end(&watched->files);
    memory_free(ctx, &watched);
    return status;
}

floe_status floe_execute(floe_deck *deck, const floe_options *options, floe_run **run)
{
    context *ctx = deck->floe->ctx;
    *run = NULL;
    library_clear_messages(deck->floe);
    if (!options || !options->directory)
        return fail(ctx, FLOE_BAD_INPUT, "a run needs a directory for its results: floe_options.directory");
    if (deck->in_use)
        return fail(ctx, FLOE_BAD_INPUT, "'%s' has a simulation: destroy it first, or read the deck again",
                    deck->scene->path);
    TRY(memory_new(ctx, run, 1, sizeof **run));
    (*run)->ctx = ctx;
    return run_deck(deck, options, &(*run)->summary);
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

const char *floe_error_name(const floe_run *run, int i)
{
    return i >= 0 && i < run->summary.n_errors ? run->summary.errors[i].name : NULL;
}

const char *floe_text(const floe_run *run, const char *name)
{
    const run_summary *r = &run->summary;
    const struct {
        const char *name, *text;
    } texts[] = {{"coupling", r->coupling}, {"interface", r->interface}, {"message", r->message},
                 {"notes", r->notes},       {"pressure", r->pressure},   {"solver", r->solver},
                 {"status", r->status},     {"substeps", r->substeps}};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        if (strcmp(texts[i].name, name) == 0) return texts[i].text;
    return NULL;
}

const char *floe_run_status(const floe_run *run)
{
    return run->summary.status;
}
