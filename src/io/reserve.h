/* Disk space reserved by a file, which is removed when the space is needed. */
#ifndef IO_RESERVE_H
#define IO_RESERVE_H

#include "base/context.h"

typedef struct disk_reserve {
    context *ctx; /* not owned */
    char *path;   /* owned; NULL: none is kept */
} disk_reserve;

/* Reserves `bytes` as the file `path`, replacing one of an earlier run. FLOE_IO where the disk has less; a file system
 * that cannot reserve space reserves none, which is no error. */
floe_status disk_reserve_take(disk_reserve *r, context *ctx, const char *path, size_t bytes);
/* The folder of the file was moved: `path` is its path now. */
floe_status disk_reserve_move(disk_reserve *r, const char *path);
/* Releases the space; a zeroed one is fine. */
void disk_reserve_release(disk_reserve *r);

/* What an ordinary user may still write on the disk of `path`, in bytes; a huge number where the system does not report
 * it. */
double disk_free_bytes(const char *path);

#endif
