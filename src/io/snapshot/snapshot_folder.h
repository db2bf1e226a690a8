/* Where the snapshots of a run are, DIR/fields/NNNNNN.h5, and how one is opened. */
#ifndef IO_SNAPSHOT_FOLDER_H
#define IO_SNAPSHOT_FOLDER_H

#include "io/hdf.h"

enum { SNAPSHOT_FORMAT = 1, SNAPSHOT_NAME = 32 /* "fields/NNNNNN.h5" */ };

/* Numbers of snapshots, in order. */
typedef struct snapshot_numbers {
    long *number; /* counted memory, owned */
    size_t n, capacity;
} snapshot_numbers;

/* Lists a folder of snapshots (DIR/fields) into a zeroed `out`, and removes files that a killed run has left half
 * written. Free out->number whatever comes back. */
floe_status snapshot_numbers_list(context *ctx, const char *folder, snapshot_numbers *out);

/* "fields/NNNNNN.h5" */
void snapshot_file_name(char name[SNAPSHOT_NAME], long number);
/* DIR/NAME. Counted memory, owned by the caller. */
floe_status snapshot_join(context *ctx, char **out, const char *dir, const char *name);
/* Checks the seal of a snapshot, and only then lets HDF5 open it. FLOE_IO says what is wrong with it. `path` must
 * outlive *out. */
floe_status snapshot_file_open(context *ctx, const char *path, hdf_file *out);

#endif
