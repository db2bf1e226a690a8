/* Inspection of an HDF5 file of unknown content: names, attributes, numbers of any type. */
#ifndef IO_HDF_LOOK_H
#define IO_HDF_LOOK_H

#include "io/hdf.h"

enum { HDF_NAME = 160 }; /* bytes of a name or a short text, its NUL included */

/* The number of entries of a folder; 0 if there is no such folder. */
size_t hdf_entries(hdf_file *file, const char *path);
/* The name of the n-th entry, in alphabetical order. FLOE_IO for a longer one. */
floe_status hdf_entry(hdf_file *file, const char *path, size_t n, char name[HDF_NAME]);

/* Reads an attribute of at most `most` numbers; *count says how many there are. FLOE_IO if there is none, or of another
 * kind. */
floe_status hdf_get_attribute(hdf_file *file, const char *path, const char *name, int most, double *value, int *count);
/* Reads a text; one that is longer is cut. */
floe_status hdf_get_text(hdf_file *file, const char *path, const char *name, char text[HDF_NAME]);

/* Reads the `n` numbers of an array, of whatever number type, as doubles. */
floe_status hdf_read_numbers(hdf_file *file, const char *path, size_t n, double *to);

#endif
