/* A case of a batch: its deck, its result, and what it leaves for the next batch (case.json). */
#include "batch/batch_internal.h"

#include "base/memory.h"
#include "base/stop.h"
#include "base/timer.h"
#include "io/file.h"
#include "io/json.h"
#include "run/catalogue.h"

#include <math.h>
#include <string.h>
#include <sys/wait.h>

void batch_path(const batch_options *o, const batch_case *one, const char *name, char path[BATCH_PATH])
{
    (void)snprintf(path, BATCH_PATH, "%s/%s/%s", o->dir, one->folder, name);
}

/* The resolved deck of the case as one number: what only `compare` and `study` read of it, its title, and the threads,
 * of which no result depends, are left out. */
static floe_status hash_deck(const scene *s, const deck_catalogue *catalogue, char hash[SHA256_TEXT])
{
    scene *plain;
    char *text;
    TRY(memory_new(s->ctx, &plain, 1, sizeof *plain));
    *plain = *s;
    scene_keep_run(plain);
    const floe_status status = deck_echo(&text, plain, catalogue);
    memory_free(s->ctx, &plain);
    TRY(status);
    const floe_status hashed = sha256_of(s->ctx, text, strlen(text), hash);
    memory_free(s->ctx, &text);
    return hashed;
}

static floe_status load_case_scene(context *ctx, const batch_options *o, const batch_case *one,
                                   const deck_catalogue *catalogue, scene **s)
{
    deck_report report = {0};
    floe_status status = deck_load(s, ctx, o->deck, &(deck_overrides){one->set, one->n_set}, catalogue, &report);
    if (status == FLOE_BAD_INPUT && report.text) {
        context_clear(ctx);
        status = fail(ctx, FLOE_BAD_INPUT, "%s", report.text);
    }
    deck_report_free(&report);
    return status;
}

floe_status batch_prepare(context *ctx, const batch_options *o, batch_case *one, scene **out)
{
    deck_catalogue *catalogue;
    scene *s = NULL;
    if (out) *out = NULL;
    TRY(catalogue_create(&catalogue, ctx));
    floe_status status = load_case_scene(ctx, o, one, catalogue, &s);
    if (status == FLOE_OK) {
        one->end = s->time.end;
        status = hash_deck(s, catalogue, one->hash);
    }
    catalogue_destroy(ctx, &catalogue);
    if (status == FLOE_OK && out)
        *out = s;
    else
        scene_destroy(&s);
    return status;
}

const char *batch_status_name(const batch_case *one)
{
    if (one->state != BATCH_ENDED) return "not_run";
    if (one->timed_out) return "timed_out";
    switch (one->status) {
    case FLOE_OK: return strcmp(one->summary.status, "at_rest") == 0 ? "at_rest" : "done";
    case FLOE_DIVERGED: return "diverged";
    case FLOE_INTERRUPTED: return "interrupted";
    default: return "failed";
    }
}

/* A final result: running the case once more would give it again. */
static bool is_final(const batch_case *one)
{
    return one->ran && (one->status == FLOE_OK || one->status == FLOE_DIVERGED || one->timed_out);
}

static void set_message(batch_case *one, const char *text)
{
    (void)snprintf(one->message, sizeof one->message, "%.*s", (int)sizeof one->message - 1, text);
    for (char *c = one->message; *c; c++) {
        if (*c == '\n') *c = c[1] ? ' ' : '\0';
    }
}

static floe_status note_case_summary(batch *b, const batch_case *one)
{
    char path[BATCH_PATH];
    batch_path(b->o, one, "case.json", path);
    return json_write(b->ctx, path,
                      json_pack("{s:i, s:s, s:s, s:s, s:{s:b, s:b, s:o, s:o}}", "schema", 1, "deck_sha256", one->hash,
                                "status", batch_status_name(one), "message", one->message, "timing", "alone",
                                one->alone, "resumed", one->resumed, "other_cores", json_number(one->other_cores),
                                "process_seconds", json_number(one->process_seconds)));
}

static const char *text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

/* What case.json says, if it is of this deck. */
static bool take_note(const batch *b, batch_case *one)
{
    char path[BATCH_PATH];
    batch_path(b->o, one, "case.json", path);
    json_t *object = json_load_file(path, 0, NULL);
    const char *status = text_of(object, "status");
    const bool same = object && strcmp(text_of(object, "deck_sha256"), one->hash) == 0;
    one->timed_out = strcmp(status, "timed_out") == 0;
    one->status = one->timed_out ? FLOE_INTERRUPTED : strcmp(status, "diverged") == 0 ? FLOE_DIVERGED : FLOE_OK;
    set_message(one, text_of(object, "message"));
    const json_t *timing = json_object_get(object, "timing");
    const json_t *cores = json_object_get(timing, "other_cores"), *own = json_object_get(timing, "process_seconds");
    one->alone = json_is_true(json_object_get(timing, "alone"));
    one->resumed = json_is_true(json_object_get(timing, "resumed"));
    one->other_cores = json_is_number(cores) ? json_number_value(cores) : (double)NAN;
    one->process_seconds = json_is_number(own) ? json_number_value(own) : (double)NAN;
    json_decref(object);
    return same;
}

static bool read_summary(const batch *b, batch_case *one)
{
    char path[BATCH_PATH];
    batch_path(b->o, one, "summary.json", path);
    one->ran = file_exists(path) && summary_read(b->ctx, path, &one->summary) == FLOE_OK;
    context_clear(b->ctx);
    /* A summary has them of its last leg alone. */
    if (one->ran && one->resumed) one->summary.cpu_seconds = one->summary.output_seconds = NAN;
    return one->ran;
}

void batch_case_keep(batch *b, batch_case *one)
{
    batch_case found = *one;
    if (!take_note(b, &found) || !read_summary(b, &found)) return;
    found.state = BATCH_ENDED;
    found.kept = true;
    /* More time may now bring it to its end. */
    const bool too_short = found.timed_out && !(b->o->max_wall > 0.0 && found.summary.wall_seconds >= b->o->max_wall);
    if (is_final(&found) && !too_short) *one = found;
}

floe_status batch_case_discard(batch *b, const batch_case *one)
{
    static const char *const name[] = {"case.json", "summary.json"};
    char path[BATCH_PATH];
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        batch_path(b->o, one, name[i], path);
        TRY(file_remove(b->ctx, path));
    }
    return FLOE_OK;
}

/* The status that belongs to an exit status of `floe run`. */
static floe_status status_of(int wait_status)
{
    static const floe_status of_exit[] = {FLOE_OK, FLOE_INTERNAL,    FLOE_BAD_INPUT, FLOE_DIVERGED,
                                          FLOE_IO, FLOE_INTERRUPTED, FLOE_MISSED_BAR};
    if (!WIFEXITED(wait_status)) return FLOE_INTERNAL;
    const size_t code = (size_t)WEXITSTATUS(wait_status);
    return code < sizeof of_exit / sizeof of_exit[0] ? of_exit[code] : FLOE_INTERNAL;
}

/* What the process has said, as far as there is space; its file goes when it is empty. */
static void take_messages(const batch *b, batch_case *one)
{
    char path[BATCH_PATH], *text;
    batch_path(b->o, one, "stderr.txt", path);
    if (file_read(b->ctx, path, &text, NULL) == FLOE_OK) {
        static const char intro[] = "floe: error: ";
        const char *from = strncmp(text, intro, sizeof intro - 1) == 0 ? text + sizeof intro - 1 : text;
        if (one->status != FLOE_OK && !one->message[0]) set_message(one, from);
        if (text[0] == '\0') (void)file_remove(b->ctx, path);
        memory_free(b->ctx, &text);
    }
    context_clear(b->ctx);
}

static void find_cause(const batch *b, const batch_job *j, batch_case *one, int wait_status)
{
    char text[BATCH_MESSAGE];
    one->message[0] = '\0';
    if (j->killed) {
        (void)snprintf(text, sizeof text, "killed, as it did not stop after %.3g s of wall time", b->o->max_wall);
        set_message(one, text);
    } else if (WIFSIGNALED(wait_status)) {
        const int number = WTERMSIG(wait_status);
        (void)snprintf(text, sizeof text, "killed by signal %d (%s)%s", number, strsignal(number),
                       number == SIGKILL ? ": by someone, or because memory ran out" : "");
        set_message(one, text);
    } else if (one->status != FLOE_OK && one->ran) {
        set_message(one, one->summary.message);
    }
    take_messages(b, one);
    if (one->status != FLOE_OK && !one->message[0]) set_message(one, status_text(one->status));
}

/* Removes what is large. */
static floe_status make_thin(const batch *b, const batch_case *one)
{
    static const char *const name[] = {"checkpoint.h5", "checkpoint-previous.h5", "fields.xdmf"};
    char path[BATCH_PATH];
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        batch_path(b->o, one, name[i], path);
        TRY(file_remove(b->ctx, path));
    }
    batch_path(b->o, one, "fields", path);
    return folder_remove(b->ctx, path);
}

/* A run that is asked to stop says so by its exit status, or, before it listens to signals, dies of the one that asks.
 * The terminal asks all processes of a batch at once. */
static bool was_stopped(const batch *b, const batch_job *j, int wait_status)
{
    const bool asked = j->asked || (b->o->stop && *b->o->stop);
    if (WIFSIGNALED(wait_status)) return asked && stop_request_is(WTERMSIG(wait_status));
    return asked && status_of(wait_status) == FLOE_INTERRUPTED;
}

/* Whether a resumed run may have failed because of its checkpoint: it ended with an error of files or of the deck. It is then begun anew. */
static bool was_refused(const batch_case *one, int wait_status)
{
    return one->resumed && WIFEXITED(wait_status) &&
           (one->status == FLOE_BAD_INPUT || one->status == FLOE_IO || one->status == FLOE_INTERNAL);
}

floe_status batch_case_collect(batch *b, batch_job *j, int wait_status)
{
    batch_case *one = &b->list[j->index];
    const machine_load after = machine_load_now();
    const bool timed = b->n_jobs == 1 && !one->resumed;
    one->alone = timed && b->o->threads <= 1;
    one->other_cores = timed ? machine_load_of_others(&j->before, &after) : (double)NAN;
    one->process_seconds = timed ? after.own_cpu - j->before.own_cpu : (double)NAN;
    one->status = status_of(wait_status);
    (void)read_summary(b, one);
    if (!one->ran && one->status == FLOE_OK) one->status = FLOE_INTERNAL;
    find_cause(b, j, one, wait_status);
    one->timed_out = j->killed || (one->status == FLOE_INTERRUPTED && b->o->max_wall > 0.0 && one->ran &&
                                   one->summary.wall_seconds >= b->o->max_wall);
    j->pid = 0;
    b->running--;
    one->state = was_stopped(b, j, wait_status) && !one->timed_out ? BATCH_WAITING : BATCH_ENDED;
    if (one->state == BATCH_WAITING) {
        one->status = FLOE_INTERRUPTED;
        return FLOE_OK;
    }
    if (was_refused(one, wait_status)) {
        context_log(b->ctx, LOG_WARNING, "%s does not go on from its checkpoint, and is begun anew: %s", one->label,
                    one->message);
        one->state = BATCH_WAITING;
        one->start_over = true;
        return FLOE_OK;
    }
    batch_progress_report(b, one);
    if (!is_final(one)) return FLOE_OK;
    if (b->o->thin) TRY(make_thin(b, one));
    TRY(note_case_summary(b, one));
    /* Last, so that a batch killed in between finds the case either as begun or as ended. */
    return batch_case_clear_begin(b, one);
}
