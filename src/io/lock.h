/* One writer a folder: a lock (POSIX, fcntl) on DIR/.lock. It goes with its process, however that ends, and is not
 * handed on to the processes that it starts. Within one process it does not exclude anything. */
#ifndef IO_LOCK_H
#define IO_LOCK_H

#include "base/context.h"

typedef struct folder_lock {
    bool taken;
    int descriptor;
} folder_lock;

/* Takes the lock of an existing folder. Errors: FLOE_IO; when another process holds it, the message names that.
 * Where the file system knows no locks, a warning is logged and the folder is used without one. */
floe_status folder_lock_take(folder_lock *lock, context *ctx, const char *dir);
/* Gives the lock back; a zeroed one is fine. */
void folder_lock_release(folder_lock *lock);

/* The process that holds the lock of a folder; 0: none, or the folder has no lock. Not to be
 * asked by the holder itself, who would lose it (as POSIX has it). */
long folder_lock_holder(const char *dir);

#endif
