/* Checkpoints: DIR/checkpoint.h5 holds all that a bitwise resume needs, in an order that does not depend on blocks:
 * cells in global order, points in the order of their ids, every STATE and FIXED field of the plan, the ledger, the
 * clocks. */
#ifndef IO_CHECKPOINT_H
#define IO_CHECKPOINT_H

#include "sim/sim.h"

enum { CHECKPOINT_REASON = 96 };

/* Outputs of the time of a checkpoint that could not be written, and that a run which goes on from it writes first. */
enum { CHECKPOINT_OWED_ROW = 1, CHECKPOINT_OWED_SNAPSHOT = 2, CHECKPOINT_OWED_ALL = 3 };

/* State that is in no field, such as the positions of loaded surface points: n entries of `components` numbers, entry i
 * at data[i * stride]. Written as it is, and overwritten by reading. */
typedef struct checkpoint_extra {
    const char *name; /* unique; letters, digits and '_' */
    double *data;     /* not owned */
    size_t n, components, stride;
} checkpoint_extra;

/* What a run keeps beside the simulation. */
typedef struct checkpoint_run {
    const char *deck; /* the resolved deck. Not owned; not set by reading */
    /* The resolved deck without what a resumed run may change (end time, output schedule, threads, title): the two
     * must be equal on resume. Not owned; given when reading too. */
    const char *identity;
    const checkpoint_extra *extra; /* n_extra entries, the same when writing and reading. Not owned; NULL if none */
    int n_extra;
    double wall_seconds; /* spent so far, earlier legs included */
    int64_t owed;        /* of CHECKPOINT_OWED_ALL */
    const char
        *kept; /* the name that the earlier one gets in the folder; NULL: it goes. Not owned; not set by reading */
    /* Set by reading: sim.dt_reason points here, so that this lives as long as the sim. */
    char dt_reason[CHECKPOINT_REASON];
} checkpoint_run;

/* Replaces the checkpoint at `path` by the present state of `s`, between two steps. On failure the earlier one is
 * untouched. */
floe_status checkpoint_write(const sim *s, const char *path, const checkpoint_run *run);

/* No checkpoint of `s` as it is takes more, in bytes. */
size_t checkpoint_most_bytes(const sim *s, const checkpoint_run *run);

/* Sets `s`, fresh from sim_create for the same scene, to the state of the checkpoint; points are sorted into their
 * blocks by mpm_resort. FLOE_IO, with a message of its own, for a file that is not there, foreign, cut short, damaged,
 * of another kind, format or version; FLOE_BAD_INPUT for another deck, mesh or plan (the first difference is shown).
 * `s` is changed only when all checks have passed. */
floe_status checkpoint_read(sim *s, const char *path, checkpoint_run *run);

/* The same from the HDF5 part of a checkpoint in memory, whose seal was checked or, in fuzzing, is not to be: `name`
 * stands for the path in messages. */
floe_status checkpoint_decode(sim *s, const char *name, const void *image, size_t size, checkpoint_run *run);

#endif
