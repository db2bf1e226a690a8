/* Initialises what the io module needs of a process: called once, by floe_init. */
#ifndef IO_IO_H
#define IO_IO_H

#include "base/context.h"

/* Starts HDF5 and stops it from printing its errors: floe puts them into its own messages. Process-wide; main
 * thread. */
floe_status io_init(context *ctx);

#endif
