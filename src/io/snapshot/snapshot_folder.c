#include "io/snapshot/snapshot_folder.h"

#include "base/memory.h"
#include "io/file.h"
#include "io/sealed_file.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

void snapshot_file_name(char name[SNAPSHOT_NAME], long number)
{
    (void)snprintf(name, SNAPSHOT_NAME, "fields/%06ld.h5", number);
}

floe_status snapshot_join(context *ctx, char **out, const char *dir, const char *name)
{
    const size_t size = strlen(dir) + strlen(name) + 2;
    TRY(memory_new(ctx, out, size, 1));
    (void)snprintf(*out, size, "%s/%s", dir, name);
    return FLOE_OK;
}

/* The number of "NNNNNN.h5", -1 for other names. */
static long number_of(const char *name)
{
    const size_t digits = strspn(name, "0123456789");
    if (digits < 6 || digits > 12 || strcmp(name + digits, ".h5") != 0) return -1;
    return strtol(name, NULL, 10);
}

/* What a kill has left behind. */
static bool is_remnant(const char *name)
{
    const size_t digits = strspn(name, "0123456789");
    return digits >= 6 && strcmp(name + digits, ".h5.tmp") == 0;
}

static int compare_numbers(const void *a, const void *b)
{
    const long x = *(const long *)a;
    const long y = *(const long *)b;
    return (x > y) - (x < y);
}

static floe_status add_number(context *ctx, snapshot_numbers *list, long number)
{
    if (list->n == list->capacity) {
        const size_t capacity = 2 * list->capacity + 64;
        TRY(memory_resize(ctx, &list->number, capacity, sizeof *list->number));
        list->capacity = capacity;
    }
    list->number[list->n++] = number;
    return FLOE_OK;
}

static floe_status list_or_remove(context *ctx, const char *folder, const char *name, snapshot_numbers *list)
{
    const long number = number_of(name);
    char *path;
    if (number >= 0) return add_number(ctx, list, number);
    if (!is_remnant(name)) return FLOE_OK;
    TRY(snapshot_join(ctx, &path, folder, name));
    const floe_status status = file_is_ordinary(path) ? file_remove(ctx, path) : FLOE_OK;
    memory_free(ctx, &path);
    return status;
}

floe_status snapshot_numbers_list(context *ctx, const char *folder, snapshot_numbers *out)
{
    DIR *directory = opendir(folder);
    if (!directory) return file_fail(ctx, "cannot list the folder", folder, errno);
    floe_status status = FLOE_OK;
    const struct dirent *entry;
    while (status == FLOE_OK && (entry = readdir(directory))) status = list_or_remove(ctx, folder, entry->d_name, out);
    (void)closedir(directory);
    if (out->n > 0) qsort(out->number, out->n, sizeof *out->number, compare_numbers);
    return status;
}

floe_status snapshot_file_open(context *ctx, const char *path, hdf_file *out)
{
    sealed_file file;
    *out = (hdf_file){.ctx = ctx, .name = path, .id = H5I_INVALID_HID};
    TRY(sealed_read(ctx, path, SEALED_SNAPSHOT, SNAPSHOT_FORMAT, false, &file));
    const floe_status status = hdf_open(out, ctx, path, file.image, file.size);
    if (status == FLOE_OK)
        out->data = file.data;
    else
        sealed_free(ctx, &file);
    return status;
}
