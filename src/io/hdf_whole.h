/* Whether a file may be read: HDF5 would follow what a file of a stranger's asks for, to other files and into plug-ins. */
#ifndef IO_HDF_WHOLE_H
#define IO_HDF_WHOLE_H

#include "io/hdf.h"

/* FLOE_IO, with the name, unless everything in the file is as floe writes it: groups and datasets, by links that lead
 * nowhere else, the data of each in one piece, all of it within the `size` bytes of the file, and through no filter. To be
 * called before anything is opened by its path. */
floe_status hdf_check_whole(hdf_file *file, size_t size);

#endif
