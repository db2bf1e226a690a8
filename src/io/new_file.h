/* A file that is being made, beside its place (PATH.tmp) and bit by bit: what is too large to be held in memory twice. It takes
 * its name once all of it is on the disk. What goes wrong on the way is kept, and told at the end. */
#ifndef IO_NEW_FILE_H
#define IO_NEW_FILE_H

#include "base/context.h"

#include <stdint.h>

typedef struct new_file {
    context *ctx;     /* not owned */
    const char *path; /* for messages; not owned */
    const char *name; /* its last part */
    char *temporary;  /* NAME.tmp; owned */
    int folder;       /* descriptor; -1: closed */
    int descriptor;   /* of the new file, for reading and writing; -1: closed */
    int error;        /* number of the first error in writing; 0: none */
} new_file;

/* Makes NAME.tmp in the folder of `path`, which must outlive the file. new_file_finish follows in any case. */
floe_status new_file_begin(new_file *f, context *ctx, const char *path);
/* Writes `size` bytes from place `at` on; after an error nothing is written any more. */
void new_file_write(new_file *f, uint64_t at, const void *data, size_t size);
/* Reads what has been written; zeros where nothing has. False, with the error kept, where that fails. */
bool new_file_read(new_file *f, uint64_t at, void *data, size_t size);
/* Its bytes so far; 0, with the error kept, where the system does not tell. */
uint64_t new_file_size(new_file *f);
/* Cuts the file off at `size` bytes, or lengthens it by zeros. */
void new_file_set_size(new_file *f, uint64_t size);
/* With `so_far` FLOE_OK syncs the file and gives it its name; an earlier file of that name stays under the name `kept` of the same
 * folder (NULL: it goes). On failure, FLOE_IO, or with another `so_far`, which is returned, the earlier file is untouched and the new
 * one gone. The file is closed. */
floe_status new_file_finish(new_file *f, floe_status so_far, const char *kept);

#endif
