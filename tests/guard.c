/* Storage of floe with poison before and behind it, for the tests: all of it comes from posix_memalign (base/memory.c),
 * which the linker puts these in the place of. What is read beyond an array is no number, no index and no address, and
 * what is written there ends the test when the array is freed. FLOE_NO_GUARD switches it off, for tools that watch
 * storage themselves. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SPACE = 64 };

/* As a number no number, and another one once it has been added to; as an index negative, as an address none. */
static unsigned char poison_at(const unsigned char *place)
{
    static const unsigned char poison[8] = {0x01, 0x00, 0xef, 0xbe, 0xad, 0xde, 0xf0, 0xff};
    return poison[(uintptr_t)place % 8];
}

static void put_poison(unsigned char *from, size_t size)
{
    for (size_t k = 0; k < size; ++k) from[k] = poison_at(from + k);
}

/* Stands at the end of the space before a block. */
typedef struct guard_mark {
    size_t size;
    const void *own; /* the block itself, so that nothing else looks like a mark */
} guard_mark;

/* The linker's names (--wrap). */
int __real_posix_memalign(void **out, size_t alignment, size_t size);
void __real_free(void *block);
int __wrap_posix_memalign(void **out, size_t alignment, size_t size);
void __wrap_free(void *block);

static guard_mark mark_of(const unsigned char *block)
{
    guard_mark mark;
    memcpy(&mark, block - sizeof mark, sizeof mark);
    return mark;
}

int __wrap_posix_memalign(void **out, size_t alignment, size_t size)
{
    void *base = NULL;
    if (alignment != SPACE || size > SIZE_MAX - 2 * SPACE || getenv("FLOE_NO_GUARD"))
        return __real_posix_memalign(out, alignment, size);
    const int error = __real_posix_memalign(&base, SPACE, size + 2 * SPACE);
    if (error != 0) return error;
    unsigned char *block = (unsigned char *)base + SPACE;
    put_poison(base, size < SPACE ? size + 2 * SPACE : 2 * SPACE);
    put_poison(block + size, SPACE);
    memcpy(block - sizeof(guard_mark), &(guard_mark){size, block}, sizeof(guard_mark));
    *out = block;
    return 0;
}

static void check_guard(const unsigned char *block, size_t size)
{
    for (size_t k = 0; k < SPACE; ++k) {
        if (block[size + k] == poison_at(block + size + k)) continue;
        (void)fprintf(stderr, "ERROR: something was written %zu bytes behind an array of %zu bytes\n", k, size);
        abort();
    }
}

void __wrap_free(void *block)
{
    /* Other blocks have no mark: to look for one is to read before them, which tools that watch storage tell of. */
    if (block == NULL || (uintptr_t)block % SPACE != 0 || getenv("FLOE_NO_GUARD") || mark_of(block).own != block) {
        __real_free(block);
        return;
    }
    unsigned char *own = block;
    check_guard(own, mark_of(own).size);
    put_poison(own - sizeof(guard_mark), sizeof(guard_mark));
    __real_free(own - SPACE);
}
