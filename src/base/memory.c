#include "base/memory.h"

#include "base/context_internal.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Each block is a header that holds the asked size, then the caller's bytes. The header takes a whole
 * alignment unit, so that the caller's bytes are aligned too. */
typedef union memory_header {
    size_t bytes;
    char pad[MEMORY_ALIGNMENT];
} memory_header;

_Static_assert(sizeof(memory_header) == MEMORY_ALIGNMENT, "the header must keep the alignment");

/* `out` is the address of a pointer of any object type: memcpy reads and writes it without breaking aliasing rules. */
static void *pointer_read(const void *out)
{
    void *pointer;
    memcpy(&pointer, out, sizeof pointer);
    return pointer;
}

static void pointer_write(void *out, void *pointer)
{
    memcpy(out, &pointer, sizeof pointer);
}

static memory_header *header_of(void *pointer)
{
    return (memory_header *)pointer - 1;
}

static bool bytes_of(size_t count, size_t size, size_t *bytes)
{
    if (size != 0 && count > (SIZE_MAX - sizeof(memory_header)) / size) return false;
    *bytes = count * size;
    return true;
}

static bool injected_failure(context *ctx)
{
    if (ctx == NULL) return false;
    const uint64_t attempt = atomic_fetch_add(&ctx->attempts, 1) + 1;
    const uint64_t fail_from = atomic_load(&ctx->fail_from);
    return fail_from != 0 && attempt >= fail_from;
}

static void account_add(context *ctx, size_t bytes)
{
    if (ctx == NULL) return;
    atomic_fetch_add(&ctx->allocations, 1);
    const uint_fast64_t live = atomic_fetch_add(&ctx->live_bytes, bytes) + bytes;
    uint_fast64_t peak = atomic_load(&ctx->peak_bytes);
    while (live > peak && !atomic_compare_exchange_weak(&ctx->peak_bytes, &peak, live)) continue;
}

static void account_remove(context *ctx, size_t bytes)
{
    if (ctx != NULL) atomic_fetch_sub(&ctx->live_bytes, bytes);
}

/* A block whose first `keep` bytes are left for the caller to write and whose rest is zero; NULL when memory is out.
 * posix_memalign rather than aligned_alloc: it takes any size, so that the sanitizer sees an overrun by one byte. */
static void *block_new(context *ctx, size_t bytes, size_t keep)
{
    if (injected_failure(ctx)) return NULL;
    void *block = NULL;
    if (posix_memalign(&block, MEMORY_ALIGNMENT, sizeof(memory_header) + bytes) != 0) return NULL;
    memory_header *header = block;
    header->bytes = bytes;
    char *pointer = (char *)(header + 1);
    memset(pointer + keep, 0, bytes - keep);
    account_add(ctx, bytes);
    return pointer;
}

static void block_free(context *ctx, void *pointer)
{
    if (pointer == NULL) return;
    account_remove(ctx, header_of(pointer)->bytes);
    free(header_of(pointer));
}

static floe_status out_of_memory(context *ctx, size_t count, size_t size)
{
    return fail(ctx, FLOE_NO_MEMORY,
                "out of memory: %zu items of %zu bytes were asked for while %" PRIu64
                " bytes were in use; use a coarser mesh, fewer points or a larger machine",
                count, size, memory_read_account(ctx).live_bytes);
}

floe_status memory_new(context *ctx, void *out, size_t count, size_t size)
{
    pointer_write(out, NULL);
    size_t bytes = 0;
    if (!bytes_of(count, size, &bytes)) return out_of_memory(ctx, count, size);
    void *pointer = block_new(ctx, bytes, 0);
    if (pointer == NULL) return out_of_memory(ctx, count, size);
    pointer_write(out, pointer);
    return FLOE_OK;
}

floe_status memory_resize(context *ctx, void *out, size_t count, size_t size)
{
    void *old = pointer_read(out);
    size_t bytes = 0;
    if (!bytes_of(count, size, &bytes)) return out_of_memory(ctx, count, size);
    const size_t old_bytes = old == NULL ? 0 : header_of(old)->bytes;
    const size_t keep = old_bytes < bytes ? old_bytes : bytes;
    void *pointer = block_new(ctx, bytes, keep);
    if (pointer == NULL) return out_of_memory(ctx, count, size);
    if (keep > 0) memcpy(pointer, old, keep);
    block_free(ctx, old);
    pointer_write(out, pointer);
    return FLOE_OK;
}

void memory_free(context *ctx, void *out)
{
    if (out == NULL) return;
    block_free(ctx, pointer_read(out));
    pointer_write(out, NULL);
}

floe_status memory_string(context *ctx, char **out, const char *text)
{
    *out = NULL;
    if (text == NULL) return fail(ctx, FLOE_INTERNAL, "memory_string was given no text to copy");
    const size_t size = strlen(text) + 1;
    TRY(memory_new(ctx, out, size, 1));
    memcpy(*out, text, size);
    return FLOE_OK;
}

memory_account memory_read_account(const context *ctx)
{
    if (ctx == NULL) return (memory_account){0};
    return (memory_account){.allocations = atomic_load(&ctx->allocations),
                            .live_bytes = atomic_load(&ctx->live_bytes),
                            .peak_bytes = atomic_load(&ctx->peak_bytes)};
}

void memory_inject_failure(context *ctx, uint64_t n)
{
    if (ctx == NULL) return;
    atomic_store(&ctx->fail_from, n == 0 ? 0 : atomic_load(&ctx->attempts) + n);
}
