/* SHA-256 (FIPS 180-4), by OpenSSL: the checksum of files, of decks, and of lists that a deck names. */
#ifndef BASE_SHA256_H
#define BASE_SHA256_H

#include "base/context.h"

#include <stddef.h>

enum {
    SHA256_SIZE = 32,                 /* bytes of a digest */
    SHA256_TEXT = 2 * SHA256_SIZE + 1 /* characters of one in hexadecimal, with the NUL */
};

/* Of bytes that come one after the other: begin, add, finish. Where a call fails (FLOE_NO_MEMORY), or the sum is left before its
 * end, sha256_abandon frees it. */
typedef struct sha256 {
    context *ctx; /* not owned */
    void *state;  /* OpenSSL's; owned */
} sha256;
floe_status sha256_begin(sha256 *sum, context *ctx);
floe_status sha256_add(sha256 *sum, const void *data, size_t size);
floe_status sha256_finish(sha256 *sum, unsigned char digest[SHA256_SIZE]);
void sha256_abandon(sha256 *sum);

typedef struct sha256_part {
    const void *data;
    size_t size; /* bytes */
} sha256_part;

/* The digest of n parts, one after the other. FLOE_NO_MEMORY. */
floe_status sha256_of_parts(context *ctx, const sha256_part *part, size_t n, unsigned char digest[SHA256_SIZE]);
/* That of `size` bytes, in hexadecimal; "" with FLOE_NO_MEMORY. */
floe_status sha256_of(context *ctx, const void *data, size_t size, char hex[SHA256_TEXT]);

#endif
