/* HDF5 writes straight into a new file of floe's, behind what stands before it there, and reads from an image in memory: no file is
 * ever in memory twice. */
#ifndef IO_HDF_DRIVER_H
#define IO_HDF_DRIVER_H

#include "io/new_file.h"

#include <hdf5.h>

/* The file access property list of HDF5 files that lie in `file` from place `at` on; the caller closes it. `file` must outlive
 * the HDF5 file. HDF5 learns nothing of errors in writing (it could not close its file then): `file` keeps them. Negative on
 * failure. */
hid_t hdf_driver_access(new_file *file, uint64_t at);

/* That of an HDF5 file which is read from an image of `size` bytes, which must outlive it. */
hid_t hdf_driver_image(const void *image, size_t size);

#endif
