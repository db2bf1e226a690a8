/* The files of a run: history, snapshots, checkpoint, resolved deck (docs/outputs.md). */
#ifndef RUN_OUTPUT_H
#define RUN_OUTPUT_H

#include "deck/deck.h"
#include "io/checkpoint/checkpoint.h"
#include "io/history.h"
#include "io/lock.h"
#include "io/reserve.h"
#include "io/snapshot/snapshot.h"

enum { OUTPUT_PATH = 4096 };

/* The two latest: the newest, and the one before it. */
#define OUTPUT_CHECKPOINT "checkpoint.h5"
#define OUTPUT_PREVIOUS "checkpoint-previous.h5"
#define OUTPUT_RESERVE "checkpoint.reserve"

typedef struct run_output {
    context *ctx;                 /* not owned */
    const char *dir;              /* not owned, or `moved` */
    char moved[OUTPUT_PATH - 96]; /* where the folder is since it was moved or made anew */
    int folder;                   /* descriptor of DIR; -1: none */
    char *deck;                   /* the resolved deck, owned */
    char *identity;               /* what must be the same on resume, owned */
    folder_lock lock;             /* of DIR, as long as the run lasts */
    history *history;             /* owned */
    snapshot_series *snapshots;   /* owned */
    checkpoint_run checkpoint;
    disk_reserve reserve; /* space for one more */
    bool newest_is_whole; /* checkpoint.h5 is, as this run has read or written it */
    char note[1024];      /* what went otherwise than asked as the run went on, to be said; "": nothing */
    checkpoint_extra
        extra[4]; /* the loaded surface points; the markers on surfaces of solids; the edges of solids; overlaps */
} run_output;

/* Takes over DIR for a run that is at its start. Earlier outputs go, once the folder is known to take new ones. */
floe_status output_begin(run_output *o, sim *s, const char *dir);
/* Sets `s` to DIR/checkpoint.h5, or where that is damaged or gone to the one before it, and goes on with the outputs that
 * stand there up to its time. */
floe_status output_resume(run_output *o, sim *s, const char *dir);
/* Goes on in the folder `place`, to which DIR was moved. */
floe_status output_move(run_output *o, const char *place);
/* Goes on in the folder `place`, which is made if it is not there, with what there is of the outputs. */
floe_status output_reopen(run_output *o, const sim *s, const char *place);
/* Sets `s` to the last checkpoint in DIR; no file is written. */
floe_status output_recall(run_output *o, sim *s, const char *dir);
/* The state of `s` as a checkpoint at `path`, and back into an `s` at its start; *o is zeroed before the first call and
 * must stay as long as `s`. */
floe_status output_save(run_output *o, const sim *s, const char *path);
floe_status output_restore(run_output *o, sim *s, const char *path);
/* Frees what *o owns; a zeroed one is fine. */
void output_end(run_output *o);

/* A row of the history, with the ledger brought up to date. What could be written is owed no longer. */
floe_status output_row(run_output *o, sim *s);
/* A snapshot of the fields. */
floe_status output_snapshot(run_output *o, sim *s);
/* Reserves disk space for a checkpoint, as DIR/checkpoint.reserve, until it is released. */
floe_status output_reserve_disk(run_output *o, const sim *s);
/* Releases the space, and that of the checkpoint before the newest if the disk is still too full for another one. */
void output_release_disk(run_output *o, const sim *s);
/* Waits until the rows are on the disk. */
floe_status output_sync(run_output *o);
/* A new checkpoint, beside which the one before it stays; `wall` is the wall time spent so far (s), earlier legs included. */
floe_status output_checkpoint(run_output *o, const sim *s, double wall);
bool output_has_checkpoint(const run_output *o);

/* Whether DIR/NAME exists. */
bool output_exists(const run_output *o, const char *name);
/* DIR/NAME into path[OUTPUT_PATH]. */
void output_path(const run_output *o, const char *name, char path[OUTPUT_PATH]);

#endif
