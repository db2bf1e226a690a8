/* The one place where floe makes files, and what its parts share. */
#ifndef IO_FILE_REPLACE_H
#define IO_FILE_REPLACE_H

#include "base/context.h"

/* Writes all bytes; waits until they are on the disk. 0, or the error number. */
int file_write_all(int descriptor, const char *data, size_t size);
int file_sync_descriptor(int descriptor);

/* FLOE_IO: what was being done ("cannot write"), the path, and what stands there (special_kind) instead of a file. */
floe_status file_refuse_special(context *ctx, const char *doing, const char *path, const char *special);

#endif
