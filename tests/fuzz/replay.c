/* main for a fuzzer without libFuzzer: fuzz_x [-n CHANGES] FILE|FOLDER... runs each file, and then so many inputs made of them by random
 * changes. Repeatable: the changes depend on nothing but the files, in the order of their names, and the number. */
#include "fuzz.h"

#include <dirent.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_FILES = 4096, PATH = 1024, MOST_BYTES = 1 << 16 };

typedef struct corpus {
    uint8_t *data[MOST_FILES];
    size_t size[MOST_FILES];
    size_t n;
} corpus;

static uint64_t random_next(uint64_t *seed)
{
    uint64_t z = *seed += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static size_t random_below(uint64_t *seed, size_t n)
{
    return n > 0 ? (size_t)(random_next(seed) % n) : 0;
}

static void add_file(corpus *c, const char *path)
{
    FILE *file = fopen(path, "rb");
    fuzz_require(file && c->n < MOST_FILES, path);
    uint8_t *data = malloc(MOST_BYTES);
    fuzz_require(data != NULL, "no memory");
    c->size[c->n] = fread(data, 1, MOST_BYTES, file);
    c->data[c->n++] = data;
    (void)fclose(file);
}

static int is_shown(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static void add_path(corpus *c, const char *path)
{
    struct stat about;
    struct dirent **entry;
    fuzz_require(stat(path, &about) == 0, path);
    if (!S_ISDIR(about.st_mode)) {
        add_file(c, path);
        return;
    }
    const int n = scandir(path, &entry, is_shown, alphasort);
    fuzz_require(n >= 0, path);
    for (int i = 0; i < n; i++) {
        char name[PATH];
        (void)snprintf(name, sizeof name, "%s/%s", path, entry[i]->d_name);
        add_file(c, name);
        free(entry[i]);
    }
    free(entry);
}

/* Takes out, doubles, or brings in from another file, a part of at most 64 bytes; or sets one byte. */
static size_t change(const corpus *c, uint64_t *seed, uint8_t *data, size_t size)
{
    const size_t other = random_below(seed, c->n);
    const size_t at = random_below(seed, size), left = size - at;
    size_t length = 1 + random_below(seed, 64);
    switch (random_below(seed, 4)) {
    case 0:
        if (length > left) length = left;
        memmove(data + at, data + at + length, left - length);
        return size - length;
    case 1:
        if (length > left) length = left;
        if (size + length > MOST_BYTES) return size;
        memmove(data + at + length, data + at, left);
        return size + length;
    case 2: {
        const size_t from = random_below(seed, c->size[other]);
        if (length > c->size[other] - from) length = c->size[other] - from;
        if (size + length > MOST_BYTES) return size;
        memmove(data + at + length, data + at, left);
        memcpy(data + at, c->data[other] + from, length);
        return size + length;
    }
    default:
        if (size > 0) data[at] = (uint8_t)random_next(seed);
        return size;
    }
}

static void run_changed(const corpus *c, uint64_t number)
{
    static uint8_t data[MOST_BYTES];
    uint64_t seed = number;
    const size_t from = random_below(&seed, c->n);
    size_t size = c->size[from];
    memcpy(data, c->data[from], size);
    for (size_t k = 1 + random_below(&seed, 4); k > 0; k--) size = change(c, &seed, data, size);
    uint8_t *exact = malloc(size > 0 ? size : 1); /* so that a sanitizer sees its end */
    fuzz_require(exact != NULL, "no memory");
    memcpy(exact, data, size);
    (void)LLVMFuzzerTestOneInput(exact, size);
    free(exact);
}

int main(int argc, char **argv)
{
    static corpus c;
    unsigned long changes = 0;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "-n") == 0 && i + 1 < argc)
            changes = strtoul(argv[++i], NULL, 10);
        else
            add_path(&c, argv[i]);
    }
    for (size_t i = 0; i < c.n; i++) (void)LLVMFuzzerTestOneInput(c.data[i], c.size[i]);
    for (unsigned long k = 0; k < changes && c.n > 0; k++) run_changed(&c, k);
    (void)printf("%zu files, %lu changed inputs\n", c.n, changes);
    for (size_t i = 0; i < c.n; i++) free(c.data[i]);
    return c.n > 0 ? 0 : 1;
}
