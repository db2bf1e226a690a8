#include "io/io.h"

#include <hdf5.h>

floe_status io_init(context *ctx)
{
    if (H5open() < 0 || H5Eset_auto2(H5E_DEFAULT, NULL, NULL) < 0) {
        return fail(ctx, FLOE_INTERNAL, "the HDF5 library does not start");
    }
    return FLOE_OK;
}
