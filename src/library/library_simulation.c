/* Decks stepped by a program (floe/floe.h). */
#include "library/library_internal.h"

#include "base/memory.h"
#include "base/threads.h"
#include "run/advance.h"
#include "run/fixed_step.h"
#include "run/measure.h"
#include "run/memory_need.h"
#include "scene/deck_location.h"
#include "scene/remark.h"

#include <math.h>
#include <string.h>

static void take_warning(void *user, const char *text)
{
    floe_simulation *s = user;
    summary_add_warning(&s->result, text);
    context_log(s->ctx, LOG_WARNING, "%s", text);
}

static floe_status begin_simulation(floe_simulation *s)
{
    scene *of = s->deck->scene;
    TRY(scene_deck_location(of, memory_refuse(of, NULL)));
    TRY(memory_new(s->ctx, &s->setup, 1, sizeof *s->setup));
    (void)threads_use(s->options.threads > 0 ? s->options.threads : of->threads);
    TRY(setup_begin(s->setup, of));
    s->sim = s->setup->sim;
    (void)advance_choose_threads(s->sim, s->options.threads);
    truth_begin(&s->truth, s->sim);
    scene_remarks(of, take_warning, s);
    TRY(fixed_step_remark(s->sim, take_warning, s));
    return field_list_make(s);
}

floe_status floe_simulation_create(floe_deck *deck, const floe_options *options, floe_simulation **s)
{
    context *ctx = deck->floe->ctx;
    *s = NULL;
    library_clear_messages(deck->floe);
    if (deck->in_use)
        return fail(ctx, FLOE_BAD_INPUT, "'%s' has a simulation already: destroy it first, or read the deck again",
                    deck->scene->path);
    TRY(memory_new(ctx, s, 1, sizeof **s));
    deck->in_use = true;
    **s =
        (floe_simulation){.deck = deck, .ctx = ctx, .options = options ? *options : (floe_options){0}, .refreshed = -1};
    const floe_status status = begin_simulation(*s);
    if (status != FLOE_OK) floe_simulation_destroy(s);
    return status;
}

void floe_simulation_destroy(floe_simulation **s)
{
    if (!s || !*s) return;
    context *ctx = (*s)->ctx;
    field_list_free(*s);
    output_end(&(*s)->files);
    if ((*s)->setup) setup_end((*s)->setup);
    memory_free(ctx, &(*s)->setup);
    (*s)->deck->in_use = false;
    memory_free(ctx, s);
}

const char *floe_warning(const floe_simulation *s, int i)
{
    return i >= 0 && i < s->result.n_warnings ? s->result.warnings[i] : NULL;
}

floe_status library_call_back(floe_simulation *s, floe_callback *call)
{
    if (!call) return FLOE_OK;
    const bool busy = s->busy;
    s->busy = true;
    s->refreshed = -1;
    const floe_status status = call(s, s->options.user);
    s->busy = busy;
    if (status == FLOE_OK) {
        library_clear_messages(s->deck->floe); /* of what the program has tried in vain */
        return FLOE_OK;
    }
    return fail(s->ctx, status, "the program has ended the steps at t = %.6g%s", s->sim->time,
                scene_time_unit(s->sim->scene));
}

static floe_status make_step(floe_simulation *s, double until)
{
    sim *m = s->sim;
    TRY(library_call_back(s, s->options.before_step));
    const double before = m->time;
    s->refreshed = -1;
    TRY(sim_step(m, sim_is_static(m) ? m->scene->time.end : until));
    TRY(advance_check_rest(m, before));
    TRY(advance_check_ledger(m, &s->truth));
    return library_call_back(s, s->options.after_step);
}

/* The time to step to, in *until: the deck's end for what is that but for round-off. */
static floe_status check_until(floe_simulation *s, double *until)
{
    static const double round_off = 1e-9; /* of the end, as for times of outputs */
    const sim *m = s->sim;
    const char *unit = scene_time_unit(m->scene);
    library_clear_messages(s->deck->floe);
    if (s->busy) return fail(s->ctx, FLOE_BAD_INPUT, "a callback must not step its simulation");
    if (advance_is_finished(m))
        return fail(s->ctx, FLOE_BAD_INPUT, "the simulation has ended at t = %.6g%s: set time.end further on", m->time,
                    unit);
    const double end = m->scene->time.end;
    if (*until > end && *until - end <= round_off * end) *until = end;
    if (!(*until > m->time) || !(*until <= end))
        return fail(s->ctx, FLOE_BAD_INPUT,
                    "cannot step to t = %.6g%s: it is %.6g%s now, and the deck ends at time.end = %.6g%s", *until, unit,
                    m->time, unit, end, unit);
    return FLOE_OK;
}

floe_status floe_step(floe_simulation *s, double until)
{
    TRY(check_until(s, &until));
    return scene_deck_location(s->deck->scene, make_step(s, until));
}

floe_status floe_advance(floe_simulation *s, double until)
{
    TRY(check_until(s, &until));
    floe_status status = FLOE_OK;
    while (status == FLOE_OK && s->sim->time < until && !advance_is_finished(s->sim)) status = make_step(s, until);
    return scene_deck_location(s->deck->scene, status);
}

double floe_time(const floe_simulation *s)
{
    return s->sim->time;
}

double floe_end_time(const floe_simulation *s)
{
    return s->sim->scene->time.end;
}

double floe_time_step(const floe_simulation *s)
{
    return s->sim->steps > 0 ? s->sim->dt : 0.0;
}

long floe_step_count(const floe_simulation *s)
{
    return s->sim->steps;
}

bool floe_is_finished(const floe_simulation *s)
{
    return advance_is_finished(s->sim);
}

floe_status floe_save(floe_simulation *s, const char *path)
{
    library_clear_messages(s->deck->floe);
    return output_save(&s->files, s->sim, path);
}

/* Reads into a simulation made anew: what is wrong with the file leaves the present one alone. */
static floe_status restore_anew(floe_simulation *s, run_setup *setup, run_output *files, const char *path)
{
    TRY(setup_begin(setup, s->deck->scene));
    return output_restore(files, setup->sim, path);
}

floe_status floe_restore(floe_simulation *s, const char *path)
{
    run_setup *setup;
    run_output *files;
    library_clear_messages(s->deck->floe);
    if (s->busy) return fail(s->ctx, FLOE_BAD_INPUT, "a callback must not restore its simulation");
    TRY(memory_new(s->ctx, &setup, 1, sizeof *setup));
    *setup = (run_setup){0};
    const floe_status made = memory_new(s->ctx, &files, 1, sizeof *files);
    const floe_status status = made != FLOE_OK ? made : restore_anew(s, setup, files, path);
    if (status == FLOE_OK) {
        run_setup *former = s->setup;
        s->setup = setup;
        setup = former;
        const run_output other = s->files;
        s->files = *files;
        *files = other;
    }
    setup_end(setup); /* takes the exact solution out of the scene */
    initial_attach(s->deck->scene, &s->setup->solution);
    if (made == FLOE_OK) output_end(files);
    memory_free(s->ctx, &files);
    memory_free(s->ctx, &setup);
    if (status != FLOE_OK) return status;
    s->sim = s->setup->sim;
    s->refreshed = -1;
    truth_begin(&s->truth, s->sim);
    return FLOE_OK;
}

floe_status floe_error(floe_simulation *s, const char *metric, double *error)
{
    *error = (double)NAN;
    library_clear_messages(s->deck->floe);
    if (!s->setup) return fail(s->ctx, FLOE_BAD_INPUT, "errors of a run are in its results, once it has ended");
    s->result.n_errors = 0;
    TRY(scene_deck_location(s->deck->scene, measure_errors(s->sim, &s->setup->solution, &s->result)));
    for (int i = 0; i < s->result.n_errors; i++) {
        if (strcmp(s->result.errors[i].name, metric) != 0) continue;
        *error = s->result.errors[i].value;
        return FLOE_OK;
    }
    return fail(s->ctx, FLOE_BAD_INPUT, "the deck's verify.metrics do not name '%s' beside an exact solution", metric);
}
