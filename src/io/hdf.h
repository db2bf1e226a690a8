/* The part of HDF5 that floe uses: files that are made on disk and read in memory, arrays, texts and attributes, by absolute
 * path. Only .c files of this module include HDF5. HDF5 is not thread-safe: main thread only. */
#ifndef IO_HDF_H
#define IO_HDF_H

#include "io/new_file.h"

#include <hdf5.h>

enum { HDF_MAX_RANK = 4 };

typedef enum hdf_type { HDF_DOUBLE, HDF_INT64 } hdf_type; /* in memory: double, int64_t */

/* An open file. */
typedef struct hdf_file {
    context *ctx;     /* not owned */
    const char *name; /* for messages; not owned */
    hid_t id;         /* < 0: closed */
    char *data;       /* what is read, where the file owns it: freed as it closes; NULL: not */
} hdf_file;

/* An array's extent; rank 0 is a single number. */
typedef struct hdf_shape {
    int rank;
    size_t extent[HDF_MAX_RANK];
} hdf_shape;

/* Makes an empty HDF5 file in a new file, behind `at` bytes of something else (io/hdf_driver.h). */
floe_status hdf_create(hdf_file *out, new_file *file, uint64_t at);
/* Closes the file, and before that writes what is left to be written: FLOE_IO if HDF5 cannot, or `so_far` where that is none.
 * Whether all of it could be written is told by new_file_finish. */
floe_status hdf_finish(hdf_file *file, floe_status so_far);
/* Opens an image of `size` bytes for reading, which must outlive the file (or be its own, `data`). FLOE_IO also for what floe does not write:
 * links that lead elsewhere, data in other files, filters (io/hdf_whole.h). */
floe_status hdf_open(hdf_file *out, context *ctx, const char *name, const void *image, size_t size);
/* Closes the file; a closed one is fine. */
void hdf_close(hdf_file *file);

/* Writes an array, row-major; folders on the way are made. */
floe_status hdf_write(hdf_file *file, const char *path, hdf_type type, hdf_shape shape, const void *data);
/* The shape and number type of an array; FLOE_IO if there is none of that name or it is of another kind. */
floe_status hdf_describe(hdf_file *file, const char *path, hdf_type *type, hdf_shape *shape);
/* Reads an array that must have this shape and number type. */
floe_status hdf_read(hdf_file *file, const char *path, hdf_type type, hdf_shape shape, void *data);
bool hdf_has(hdf_file *file, const char *path);

/* A text of fixed length. */
floe_status hdf_write_text(hdf_file *file, const char *path, const char *text);
/* The text, counted memory, owned by the caller. */
floe_status hdf_read_text(hdf_file *file, const char *path, char **text);

/* Attributes of the object at `path` ("/" is the file's root). */
floe_status hdf_attribute_text(hdf_file *file, const char *path, const char *name, const char *text);
floe_status hdf_attribute(hdf_file *file, const char *path, const char *name, hdf_type type, int count,
                          const void *data);

/* FLOE_IO: what floe was doing, and HDF5's innermost complaint on the same line. */
floe_status hdf_fail(hdf_file *file, const char *doing, const char *path);

/* Number of elements of a shape; 1 for rank 0. SIZE_MAX where it does not fit. */
size_t hdf_count(hdf_shape shape);

#endif
