/* What a snapshot holds of a simulation: from blocks to HDF5 and XDMF. */
#ifndef IO_SNAPSHOT_CONTENT_H
#define IO_SNAPSHOT_CONTENT_H

#include "base/strbuf.h"
#include "io/hdf.h"
#include "sim/sim.h"

/* Writes cells and points into the open file, and their grids into `page`, under the name `file` of the finished
 * file. */
floe_status snapshot_content(const sim *s, hdf_file *hdf, strbuf *page, const char *file);

#endif
