#include "io/hdf_driver.h"

#include <stdlib.h>
#include <string.h>

/* Where the HDF5 file lies: in a file that is being made, or in memory. */
typedef struct place {
    new_file *file;    /* not owned; NULL: in memory */
    uint64_t at;       /* of its first byte in that */
    const char *image; /* not owned */
    size_t size;       /* bytes of it */
} place;

/* An open HDF5 file. */
typedef struct driven {
    H5FD_t head; /* HDF5's own part, first */
    place place;
    haddr_t allocated, written; /* bytes: what HDF5 has given out, and up to where it has written */
} driven;

static driven *driven_of(H5FD_t *file)
{
    return (driven *)file; /* head comes first */
}

static const driven *read_driven(const H5FD_t *file)
{
    return (const driven *)file;
}

static H5FD_t *open_driven(const char *name, unsigned flags, hid_t access, haddr_t most)
{
    (void)name, (void)flags, (void)most;
    const place *p = H5Pget_driver_info(access);
    driven *d = p ? calloc(1, sizeof *d) : NULL; /* HDF5's memory, not floe's: its struct is the first part */
    if (d) *d = (driven){.place = *p, .written = p->size};
    return (H5FD_t *)d;
}

static herr_t close_driven(H5FD_t *file)
{
    free(driven_of(file));
    return 0;
}

/* What HDF5 may do with small pieces, as it does in memory: the same bytes as ever. */
static herr_t query_driven(const H5FD_t *file, unsigned long *flags)
{
    (void)file;
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
    return 0;
}

static haddr_t get_allocated(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return read_driven(file)->allocated;
}

static herr_t set_allocated(H5FD_t *file, H5FD_mem_t type, haddr_t bytes)
{
    (void)type;
    driven_of(file)->allocated = bytes;
    return 0;
}

static haddr_t get_written(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return read_driven(file)->written;
}

static herr_t read_driven_bytes(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t at, size_t size, void *data)
{
    (void)type, (void)transfer;
    const place *p = &driven_of(file)->place;
    if (p->file) return new_file_read(p->file, p->at + at, data, size) ? 0 : -1;
    const size_t there = at < p->size ? p->size - (size_t)at : 0, bytes = size < there ? size : there;
    if (bytes > 0) memcpy(data, p->image + at, bytes);
    memset((char *)data + bytes, 0, size - bytes);
    return 0;
}

static herr_t write_driven_bytes(H5FD_t *file, H5FD_mem_t type, hid_t transfer, haddr_t at, size_t size,
                                 const void *data)
{
    (void)type, (void)transfer;
    driven *d = driven_of(file);
    if (!d->place.file) return -1;
    new_file_write(d->place.file, d->place.at + at, data, size);
    if (d->written < at + size) d->written = at + size;
    return 0;
}

static herr_t truncate_driven(H5FD_t *file, hid_t transfer, hbool_t closing)
{
    (void)transfer, (void)closing;
    driven *d = driven_of(file);
    if (!d->place.file || d->written == d->allocated) return 0;
    new_file_set_size(d->place.file, d->place.at + d->allocated);
    d->written = d->allocated;
    return 0;
}

static const H5FD_class_t driver = {.name = "floe_new_file",
                                    .maxaddr = INT64_MAX - 4096,
                                    .fc_degree = H5F_CLOSE_WEAK,
                                    .fapl_size = sizeof(place),
                                    .open = open_driven,
                                    .close = close_driven,
                                    .query = query_driven,
                                    .get_eoa = get_allocated,
                                    .set_eoa = set_allocated,
                                    .get_eof = get_written,
                                    .read = read_driven_bytes,
                                    .write = write_driven_bytes,
                                    .truncate = truncate_driven,
                                    .fl_map = H5FD_FLMAP_DICHOTOMY};

static hid_t access_at(const place *p)
{
    const hid_t id = H5FDregister(&driver), access = H5Pcreate(H5P_FILE_ACCESS);
    const herr_t set = H5Pset_driver(access, id, p);
    (void)H5FDunregister(id); /* the list holds it as long as it is asked for */
    if (set >= 0) return access;
    (void)H5Pclose(access);
    return H5I_INVALID_HID;
}

hid_t hdf_driver_access(new_file *file, uint64_t at)
{
    return access_at(&(place){.file = file, .at = at});
}

hid_t hdf_driver_image(const void *image, size_t size)
{
    return access_at(&(place){.image = image, .size = size});
}
