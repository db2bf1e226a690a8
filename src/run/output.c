#include "run/output.h"

#include "base/memory.h"
#include "io/file.h"
#include "run/catalogue.h"
#include "run/pressure.h"
#include "scene/layout.h"

#include <fcntl.h>
#include <math.h>
#include <unistd.h>

void output_path(const run_output *o, const char *name, char path[OUTPUT_PATH])
{
    (void)snprintf(path, OUTPUT_PATH, "%s/%s", o->dir, name);
}

/* What a resumed run may change is set to one value: end time, output schedule, threads, title; and what only batches read. */
static floe_status echo_identity(char **out, const scene *s, const deck_catalogue *catalogue)
{
    scene *plain;
    TRY(memory_new(s->ctx, &plain, 1, sizeof *plain));
    *plain = *s;
    scene_keep_run(plain);
    plain->time.end = 1.0;
    plain->time.max_steps = 0;
    plain->output = (scene_output){INFINITY, NAN, NAN};
    const floe_status status = deck_echo(out, plain, catalogue);
    memory_free(s->ctx, &plain);
    return status;
}

static floe_status echo_deck(run_output *o, const scene *s)
{
    deck_catalogue *catalogue;
    TRY(catalogue_create(&catalogue, o->ctx));
    floe_status status = deck_echo(&o->deck, s, catalogue);
    if (status == FLOE_OK) status = echo_identity(&o->identity, s, catalogue);
    catalogue_destroy(o->ctx, &catalogue);
    return status;
}

static void add_extra(run_output *o, const checkpoint_extra *extra)
{
    if (extra->data) o->extra[o->checkpoint.n_extra++] = *extra;
}

/* The places of corners of loaded surfaces and of the markers on solids, what edges remember and how far bodies overlap with sides, are state that no field holds. */
static void name_extra(run_output *o, const sim *s)
{
    checkpoint_extra loaded = {.name = "surface_corners", .components = 3},
                     markers = {.name = "skin_position_velocity", .components = 6},
                     edges = {.name = "edge_memory", .components = 1, .stride = 1},
                     overlaps = {.name = "side_overlap", .components = 1, .stride = 1};
    if (!s->mpm) return;
    loaded.data = mpm_surface(s->mpm, &loaded.n, &loaded.stride);
    markers.data = mpm_surface_markers(s->mpm, &markers.n, &markers.stride);
    edges.data = mpm_edges_state(s->mpm, &edges.n);
    overlaps.data = mpm_overlaps_state(s->mpm, &overlaps.n);
    o->checkpoint.extra = o->extra;
    o->checkpoint.n_extra = 0;
    add_extra(o, &loaded);
    add_extra(o, &markers);
    add_extra(o, &edges);
    add_extra(o, &overlaps);
}

static floe_status prepare_outputs(run_output *o, const sim *s, const char *dir)
{
    *o = (run_output){.ctx = s->ctx, .dir = dir, .folder = -1};
    TRY(echo_deck(o, s->layout ? s->layout->deck : s->scene)); /* shapes as the deck has them */
    o->checkpoint.deck = o->deck;
    o->checkpoint.identity = o->identity;
    name_extra(o, s);
    return FLOE_OK;
}

/* Locks it, and keeps it open to be found should it be moved. */
static floe_status hold_folder(run_output *o)
{
    TRY(folder_lock_take(&o->lock, o->ctx, o->dir));
    o->folder = open(o->dir, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return FLOE_OK;
}

static void let_folder_go(run_output *o)
{
    if (o->folder >= 0) (void)close(o->folder);
    o->folder = -1;
    folder_lock_release(&o->lock);
}

static floe_status write_deck(const run_output *o)
{
    char path[OUTPUT_PATH];
    output_path(o, "deck.yaml", path);
    return file_replace_text(o->ctx, path, o->deck);
}

static floe_status open_series(run_output *o, const sim *s, double keep_until)
{
    char path[OUTPUT_PATH];
    output_path(o, "history.csv", path);
    TRY(history_open(&o->history, s, path, keep_until));
    return snapshot_open(&o->snapshots, o->ctx, o->dir, o->deck, keep_until);
}

floe_status output_begin(run_output *o, sim *s, const char *dir)
{
    static const char *const earlier[] = {OUTPUT_CHECKPOINT, OUTPUT_PREVIOUS, OUTPUT_RESERVE, "profile.csv",
                                          "summary.json"};
    char path[OUTPUT_PATH];
    TRY(prepare_outputs(o, s, dir));
    TRY(folder_make(o->ctx, dir));
    TRY(hold_folder(o));
    TRY(write_deck(o));
    for (size_t i = 0; i < sizeof earlier / sizeof earlier[0]; i++) {
        output_path(o, earlier[i], path);
        TRY(file_remove(o->ctx, path));
    }
    return open_series(o, s, -INFINITY);
}

bool output_exists(const run_output *o, const char *name)
{
    char path[OUTPUT_PATH];
    output_path(o, name, path);
    return file_exists(path);
}

static floe_status read_one(run_output *o, sim *s, const char *name)
{
    char path[OUTPUT_PATH];
    output_path(o, name, path);
    return checkpoint_read(s, path, &o->checkpoint);
}

/* The one before the newest, of which `o->note` says why it will not do. */
static floe_status read_previous(run_output *o, sim *s)
{
    char why[sizeof o->note];
    const floe_status status = read_one(o, s, OUTPUT_PREVIOUS);
    (void)snprintf(why, sizeof why, "%s", o->note);
    if (status == FLOE_OK) {
        (void)snprintf(o->note, sizeof o->note, "%.800s: going on from the one before it, " OUTPUT_PREVIOUS, why);
        return FLOE_OK;
    }
    char also[CONTEXT_MESSAGE_SIZE];
    (void)snprintf(also, sizeof also, "%s", context_message(o->ctx));
    context_clear(o->ctx);
    return fail(o->ctx, status, "%s; nor will the one before it do: %s", why, also);
}

/* The newest that is whole. */
static floe_status read_newest(run_output *o, sim *s)
{
    const bool both = output_exists(o, OUTPUT_PREVIOUS);
    if (!output_exists(o, OUTPUT_CHECKPOINT)) {
        (void)snprintf(o->note, sizeof o->note, "there is no " OUTPUT_CHECKPOINT);
        return read_previous(o, s);
    }
    const floe_status status = read_one(o, s, OUTPUT_CHECKPOINT);
    o->newest_is_whole = status == FLOE_OK;
    if (status != FLOE_IO || !both) return status;
    (void)snprintf(o->note, sizeof o->note, "%.800s", context_message(o->ctx));
    context_clear(o->ctx);
    return read_previous(o, s);
}

floe_status output_resume(run_output *o, sim *s, const char *dir)
{
    TRY(prepare_outputs(o, s, dir));
    if (!output_has_checkpoint(o))
        return fail(o->ctx, FLOE_IO,
                    "'%s' holds no run to go on with: there is no checkpoint.h5; name its folder with -o, or leave "
                    "--resume out",
                    dir);
    TRY(hold_folder(o));
    TRY(read_newest(o, s));
    TRY(write_deck(o));
    return open_series(o, s, s->time);
}

floe_status output_move(run_output *o, const char *place)
{
    char path[OUTPUT_PATH];
    (void)snprintf(o->moved, sizeof o->moved, "%.3990s", place);
    o->dir = o->moved;
    output_path(o, OUTPUT_RESERVE, path);
    TRY(disk_reserve_move(&o->reserve, path));
    return snapshot_move(o->snapshots, o->dir);
}

/* The earlier ones stay open until there are others: what is written meanwhile fails in order. */
static floe_status reopen_series(run_output *o, const sim *s)
{
    run_output other = *o;
    other.history = NULL;
    other.snapshots = NULL;
    const floe_status status = open_series(&other, s, s->time);
    run_output *closed = status == FLOE_OK ? o : &other;
    history_close(&closed->history);
    snapshot_close(&closed->snapshots);
    if (status != FLOE_OK) return status;
    o->history = other.history;
    o->snapshots = other.snapshots;
    return FLOE_OK;
}

floe_status output_reopen(run_output *o, const sim *s, const char *place)
{
    char path[OUTPUT_PATH];
    (void)snprintf(path, sizeof path, "%.3990s", place);
    TRY(folder_make(o->ctx, path));
    (void)snprintf(o->moved, sizeof o->moved, "%.3990s", path);
    o->dir = o->moved;
    disk_reserve_release(&o->reserve);
    let_folder_go(o);
    TRY(hold_folder(o));
    TRY(write_deck(o));
    o->newest_is_whole = o->newest_is_whole && output_exists(o, OUTPUT_CHECKPOINT);
    return reopen_series(o, s);
}

floe_status output_recall(run_output *o, sim *s, const char *dir)
{
    TRY(prepare_outputs(o, s, dir));
    return read_newest(o, s);
}

floe_status output_save(run_output *o, const sim *s, const char *path)
{
    if (!o->deck) TRY(prepare_outputs(o, s, NULL));
    name_extra(o, s);
    return checkpoint_write(s, path, &o->checkpoint);
}

floe_status output_restore(run_output *o, sim *s, const char *path)
{
    TRY(prepare_outputs(o, s, NULL));
    return checkpoint_read(s, path, &o->checkpoint);
}

void output_end(run_output *o)
{
    if (!o->ctx) return;
    history_close(&o->history);
    snapshot_close(&o->snapshots);
    memory_free(o->ctx, &o->deck);
    memory_free(o->ctx, &o->identity);
    disk_reserve_release(&o->reserve);
    let_folder_go(o);
}

floe_status output_row(run_output *o, sim *s)
{
    sim_totals totals;
    double pressure[SCENE_MAX_MATERIALS];
    TRY(sim_sum(s, &totals));
    sim_sum_moments(s, &totals);
    sim_update_ledger_from(s, &totals);
    for (int m = 0; m < s->scene->n_materials; m++) pressure[m] = mean_pressure(s, m);
    TRY(history_append(o->history, s, &(history_row){&totals, pressure}));
    o->checkpoint.owed &= ~(int64_t)CHECKPOINT_OWED_ROW;
    return FLOE_OK;
}

floe_status output_snapshot(run_output *o, sim *s)
{
    char path[OUTPUT_PATH];
    TRY(sim_refresh(s));
    output_path(o, "fields", path);
    if (!file_exists(path)) TRY(folder_make(o->ctx, path)); /* someone has removed it */
    TRY(snapshot_write(o->snapshots, s));
    o->checkpoint.owed &= ~(int64_t)CHECKPOINT_OWED_SNAPSHOT;
    return FLOE_OK;
}

floe_status output_reserve_disk(run_output *o, const sim *s)
{
    char path[OUTPUT_PATH];
    output_path(o, OUTPUT_RESERVE, path);
    name_extra(o, s);
    return disk_reserve_take(&o->reserve, o->ctx, path, checkpoint_most_bytes(s, &o->checkpoint));
}

void output_release_disk(run_output *o, const sim *s)
{
    char path[OUTPUT_PATH];
    disk_reserve_release(&o->reserve);
    if (!o->newest_is_whole || disk_free_bytes(o->dir) >= (double)checkpoint_most_bytes(s, &o->checkpoint)) return;
    output_path(o, OUTPUT_PREVIOUS, path);
    if (file_remove(o->ctx, path) != FLOE_OK) context_clear(o->ctx);
}

floe_status output_sync(run_output *o)
{
    return history_sync(o->history);
}

floe_status output_checkpoint(run_output *o, const sim *s, double wall)
{
    char path[OUTPUT_PATH];
    output_path(o, OUTPUT_CHECKPOINT, path);
    TRY(output_sync(o));
    o->checkpoint.wall_seconds = wall;
    /* A damaged one must not take the place of the one before it. */
    o->checkpoint.kept = o->newest_is_whole ? OUTPUT_PREVIOUS : NULL;
    name_extra(o, s); /* current and next places change roles */
    const floe_status status = checkpoint_write(s, path, &o->checkpoint);
    o->checkpoint.kept = NULL;
    if (status == FLOE_OK) o->newest_is_whole = true;
    return status;
}

bool output_has_checkpoint(const run_output *o)
{
    return output_exists(o, OUTPUT_CHECKPOINT) || output_exists(o, OUTPUT_PREVIOUS);
}
