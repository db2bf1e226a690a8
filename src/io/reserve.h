/* Room on a disk, kept by a file that goes when the room is needed. */
#ifndef IO_RESERVE_H
#define IO_RESERVE_H

#include "base/context.h"

typedef struct disk_reserve {
    context *ctx; /* not owned */
    char *path;   /* owned; NULL: none is kept */
} disk_reserve;

/* Keeps `bytes` as the file `path`, in place of one that an earlier run has left. FLOE_IO where there is not as much; where the file
 * system cannot keep room, none is, and that is no error. */
floe_status disk_reserve_take(disk_reserve *r, context *ctx, const char *path, size_t bytes);
bool disk_reserve_is_taken(const disk_reserve *r);
/* The folder of the file was moved: `path` is its path now. */
floe_status disk_reserve_move(disk_reserve *r, const char *path);
/* Gives the room back; a zeroed one is fine. */
void disk_reserve_release(disk_reserve *r);

/* What an ordinary user may still write on the disk of `path`, in bytes; a huge number where the system does not tell. */
double disk_free_bytes(const char *path);

#endif
