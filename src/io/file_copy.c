#include "io/file_copy.h"

#include "base/memory.h"
#include "io/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Two paths, of one file. */
typedef struct copy_job {
    char *from, *to; /* owned */
    size_t size_from, size_to;
    size_t at_from, at_to; /* where the name begins */
} copy_job;

static floe_status copy_file(context *ctx, const char *from, const char *to)
{
    char *data;
    size_t size;
    TRY(file_read(ctx, from, &data, &size));
    const file_part part = {data, size};
    const floe_status status = file_replace(ctx, to, &part, 1);
    memory_free(ctx, &data);
    return status;
}

static bool is_hdf5(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot && strcmp(dot, ".h5") == 0;
}

/* A link to a new name; what stands there goes first. Where there are no links, a copy. */
static floe_status link_file(context *ctx, const char *from, const char *to)
{
    TRY(file_remove(ctx, to));
    return link(from, to) == 0 ? FLOE_OK : copy_file(ctx, from, to);
}

static floe_status copy_entries(context *ctx, copy_job *j, DIR *folder, bool (*left_out)(const char *name))
{
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        const char *name = entry->d_name;
        struct stat about;
        if (fstatat(dirfd(folder), name, &about, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(about.st_mode)) continue;
        if (left_out && left_out(name)) continue;
        (void)snprintf(j->from + j->at_from, j->size_from - j->at_from, "%s", name);
        (void)snprintf(j->to + j->at_to, j->size_to - j->at_to, "%s", name);
        TRY(is_hdf5(name) ? link_file(ctx, j->from, j->to) : copy_file(ctx, j->from, j->to));
    }
    return FLOE_OK;
}

/* "FOLDER/" with space for a name behind it. */
static floe_status make_path(context *ctx, const char *folder, char **path, size_t *size, size_t *at)
{
    enum { NAME = 256 };
    *at = strlen(folder) + 1;
    *size = *at + NAME;
    TRY(memory_new(ctx, path, *size, 1));
    (void)snprintf(*path, *size, "%s/", folder);
    return FLOE_OK;
}

floe_status folder_copy(context *ctx, const char *from, const char *to, bool (*left_out)(const char *name))
{
    copy_job j = {0};
    TRY(folder_make(ctx, to));
    DIR *folder = opendir(from);
    if (!folder) return file_fail(ctx, "cannot open the folder", from, errno);
    floe_status status = make_path(ctx, from, &j.from, &j.size_from, &j.at_from);
    if (status == FLOE_OK) status = make_path(ctx, to, &j.to, &j.size_to, &j.at_to);
    if (status == FLOE_OK) status = copy_entries(ctx, &j, folder, left_out);
    memory_free(ctx, &j.from);
    memory_free(ctx, &j.to);
    (void)closedir(folder);
    TRY(status);
    return folder_sync(ctx, to);
}
