/* Sealed files: 512 bytes of floe's own, then an HDF5 file. To HDF5 the first part is a user block, so h5dump, h5py and
 * ParaView open the file as it is; floe checks the seal, a SHA-256 of everything else in the file, before HDF5 sees a
 * byte.
 *
 *   bytes 0-7     0x89 'f' 'l' 'o' 'e' CR LF 0x1a (a transfer as text damages it)
 *   bytes 8-11    kind (sealed_kind), little-endian, as all numbers here
 *   bytes 12-15   format of that kind
 *   bytes 16-23   bytes of HDF5 that follow the 512
 *   bytes 24-55   version of floe that wrote it, text filled up with NUL
 *   bytes 56-479  NUL
 *   bytes 480-511 SHA-256 of bytes 0-479 and of all bytes from 512 on */
#ifndef IO_SEALED_H
#define IO_SEALED_H

#include "io/new_file.h"

typedef enum sealed_kind { SEALED_CHECKPOINT = 1, SEALED_SNAPSHOT = 2 } sealed_kind;

enum { SEALED_HEADER = 512 };

/* Seals a new file, whose HDF5 part has been written from byte SEALED_HEADER on, if `so_far` is FLOE_OK; finishes it in any case
 * (new_file_finish). */
floe_status sealed_finish(new_file *file, floe_status so_far, sealed_kind kind, uint32_t format, const char *kept);

/* A sealed file in memory. */
typedef struct sealed_file {
    char *data;        /* the whole file; counted memory, owned */
    const char *image; /* the HDF5 part of it */
    size_t size;       /* bytes of that */
} sealed_file;

/* Reads a file and opens its seal. FLOE_IO with a message of its own for: not a floe file, cut short, too long,
 * damaged, another kind, another format, written by another version of floe (`same_version` only). */
floe_status sealed_read(context *ctx, const char *path, sealed_kind kind, uint32_t format, bool same_version,
                        sealed_file *out);
void sealed_free(context *ctx, sealed_file *file);

#endif
