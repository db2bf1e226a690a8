/* Files as floe writes them: whole or not at all. A file is made beside its place (PATH.tmp), synced, renamed over the
 * old one, and its folder synced, so that neither a kill nor a full disk leaves a damaged one or takes the earlier one
 * away. What is no ordinary file (a device, a pipe, a socket, a folder, a link) is not replaced, removed, read or
 * written through. Every failure is FLOE_IO with the path, the system's reason and what to do about it. */
#ifndef IO_FILE_H
#define IO_FILE_H

#include "base/context.h"

/* A stretch of bytes of a file that is to be written; not owned. */
typedef struct file_part {
    const void *data;
    size_t size; /* bytes */
} file_part;

/* Replaces the file `path` by the parts, one after another. On failure the earlier file is untouched. */
floe_status file_replace(context *ctx, const char *path, const file_part *part, int parts);
/* The same, and the earlier file stays in its folder under the name `kept` (NULL: it goes), which it takes once the new
 * one is whole and synced. There is a whole file under one of the two names at any time. */
floe_status file_replace_keeping(context *ctx, const char *path, const char *kept, const file_part *part, int parts);
/* The same with one text, its final NUL left out. */
floe_status file_replace_text(context *ctx, const char *path, const char *text);

/* The whole of a regular file, with a NUL after its end that `size` (may be NULL) does not count. Counted memory, owned
 * by the caller. */
floe_status file_read(context *ctx, const char *path, char **data, size_t *size);
/* True when something of that name is there. */
bool file_exists(const char *path);
/* True when an ordinary file of that name is there, not a link to one. */
bool file_is_ordinary(const char *path);
/* Removes an ordinary file; that it is not there is no error. */
floe_status file_remove(context *ctx, const char *path);

/* Makes a folder and those above it, and checks that files can be made in it. */
floe_status folder_make(context *ctx, const char *path);
/* Removes the files in a folder, and the folder unless there are folders in it; that it is not there is no error. A link
 * to a folder is an error. */
floe_status folder_remove(context *ctx, const char *path);
/* Makes what was renamed or removed in a folder last through a power cut. */
floe_status folder_sync(context *ctx, const char *path);

/* A file that grows by whole lines. */
typedef struct line_file {
    context *ctx;     /* not owned */
    char *path;       /* owned */
    int descriptor;   /* -1: closed */
    long long length; /* bytes that are whole lines */
} line_file;

/* Opens an existing file for appending at its end. */
floe_status line_file_open(line_file *file, context *ctx, const char *path);
/* Appends a line (with its newline) and hands it to the system; what a failed write has left is cut off again. */
floe_status line_file_append(line_file *file, const char *line, size_t size);
/* Waits until the lines are on the disk. */
floe_status line_file_sync(line_file *file);
/* Closes the file; a closed or zeroed one is fine. */
void line_file_close(line_file *file);

/* FLOE_IO with what was being done ("cannot write"), the path, the text of the error number and a remedy. */
floe_status file_fail(context *ctx, const char *doing, const char *path, int error);

#endif
