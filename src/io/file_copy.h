/* Copies of what floe has written. */
#ifndef IO_FILE_COPY_H
#define IO_FILE_COPY_H

#include "base/context.h"

/* Copies the files of a folder, not the folders in it, into another one, which is made if it is not there; earlier
 * files of the same names are replaced, each whole or not at all. `left_out` (NULL: none) says which names to pass
 * over. HDF5 files, which floe never changes once they are there, are linked (two names, one file) where the file
 * system can. FLOE_IO as in io/file.h. */
floe_status folder_copy(context *ctx, const char *from, const char *to, bool (*left_out)(const char *name));

#endif
