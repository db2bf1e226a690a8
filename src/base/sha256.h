/* SHA-256 (FIPS 180-4): the checksum of files, of decks, and of lists that a deck names. */
#ifndef BASE_SHA256_H
#define BASE_SHA256_H

#include <stddef.h>
#include <stdint.h>

enum {
    SHA256_SIZE = 32,                 /* bytes of a digest */
    SHA256_TEXT = 2 * SHA256_SIZE + 1 /* characters of one in hexadecimal, with the NUL */
};

typedef struct sha256 {
    uint32_t state[8];
    uint64_t length; /* bytes so far */
    unsigned char block[64];
    size_t filled; /* bytes of block in use */
} sha256;

void sha256_begin(sha256 *h);
void sha256_add(sha256 *h, const void *data, size_t size);
void sha256_end(sha256 *h, unsigned char digest[SHA256_SIZE]);

/* The digest of `size` bytes, or of one text, in hexadecimal. */
void sha256_of(const void *data, size_t size, char hex[SHA256_TEXT]);
void sha256_of_text(const char *text, char hex[SHA256_TEXT]);

#endif
