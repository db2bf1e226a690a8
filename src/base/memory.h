/* Counted, aligned, fault-injectable memory. All of floe's own storage comes from here. */
#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H

#include "base/context.h"

#include <stdint.h>

enum { MEMORY_ALIGNMENT = 64 }; /* bytes: a cache line */

/* Zeroed storage for `count` items of `size` bytes, aligned to MEMORY_ALIGNMENT; *out is NULL on failure.
 * count * size of 0 gives a valid pointer. Errors: FLOE_NO_MEMORY (overflow included). Owner: the caller. */
floe_status memory_new(context *ctx, void *out, size_t count, size_t size);
/* Like memory_new, keeping the first min(old, new) bytes of *out; on failure *out is unchanged. */
floe_status memory_resize(context *ctx, void *out, size_t count, size_t size);
/* Frees *out and sets it NULL (`out` is the address of the pointer). */
void memory_free(context *ctx, void *out);
/* A counted copy of a string. */
floe_status memory_string(context *ctx, char **out, const char *text);

typedef struct memory_account {
    uint64_t allocations; /* made so far */
    uint64_t live_bytes;  /* now */
    uint64_t peak_bytes;  /* most so far */
} memory_account;

memory_account memory_read_account(const context *ctx);
/* The n-th allocation from now (1 = the next) fails, and all after it; 0 switches injection off. For tests. */
void memory_inject_failure(context *ctx, uint64_t n);

#endif
