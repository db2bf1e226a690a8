#include "io/file.h"

#include "base/memory.h"
#include "base/ordinary.h"
#include "io/file_replace.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct remedy {
    int error;
    const char *text;
} remedy;

static const remedy remedies[] = {
    {ENOSPC, "the disk is full: free some space, or choose a folder on another disk with -o"},
    {EDQUOT, "the quota is used up: remove files, or choose a folder on another disk with -o"},
    {EFBIG, "the file would pass the size limit of the system or of `ulimit -f`"},
    {EACCES, "no permission: make the folder and the file writable, or choose another folder with -o"},
    {EPERM, "no permission: make the folder and the file writable, or choose another folder with -o"},
    {EROFS, "the file system is read-only: choose another folder with -o"},
    {ENOENT, "the file or its folder does not exist, or was removed meanwhile"},
    {ENOTDIR, "a part of the path is a file, not a folder: choose another folder with -o"},
    {EISDIR, "a folder stands where the file belongs: move it away, or choose another folder with -o"},
    {EEXIST, "a file stands where the folder belongs: move it away, or choose another folder with -o"},
    {ENAMETOOLONG, "the name is too long: choose a shorter folder with -o"},
    {EMFILE, "too many open files: raise `ulimit -n`"},
    {EIO, "the device reports an error: check the disk, or choose a folder on another one with -o"},
};

floe_status file_fail(context *ctx, const char *doing, const char *path, int error)
{
    const char *text = NULL;
    for (size_t i = 0; i < sizeof remedies / sizeof remedies[0]; i++) {
        if (remedies[i].error == error) text = remedies[i].text;
    }
    return fail(ctx, FLOE_IO, "%s '%s': %s%s%s%s", doing, path, strerror(error), text ? " (" : "", text ? text : "",
                text ? ")" : "");
}

floe_status file_refuse_special(context *ctx, const char *doing, const char *path, const char *special)
{
    return fail(ctx, FLOE_IO, "%s '%s': it is %s, not an ordinary file: move it away, or choose another name with -o",
                doing, path, special);
}

floe_status folder_sync(context *ctx, const char *path)
{
    const int descriptor = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return file_fail(ctx, "cannot open the folder", path, errno);
    const int error = file_sync_descriptor(descriptor);
    (void)close(descriptor);
    /* Some network file systems cannot sync a folder: nothing more can be done there. */
    if (error != 0 && error != EINVAL && error != ENOTSUP) return file_fail(ctx, "cannot sync the folder", path, error);
    return FLOE_OK;
}

/* 0, or the error number; the file may have become shorter meanwhile: *got says how much there was. */
static int read_into_buffer(int descriptor, char *data, size_t size, size_t *got)
{
    *got = 0;
    while (*got < size) {
        const ssize_t n = read(descriptor, data + *got, size - *got);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        if (n == 0) return 0;
        *got += (size_t)n;
    }
    return 0;
}

static floe_status read_descriptor(context *ctx, const char *path, int descriptor, char **data, size_t *size)
{
    struct stat about;
    if (fstat(descriptor, &about) != 0) return file_fail(ctx, "cannot read", path, errno);
    TRY(memory_new(ctx, data, (size_t)about.st_size + 1, 1));
    const int error = read_into_buffer(descriptor, *data, (size_t)about.st_size, size);
    if (error == 0) return FLOE_OK;
    memory_free(ctx, data);
    return file_fail(ctx, "cannot read", path, error);
}

floe_status file_read(context *ctx, const char *path, char **data, size_t *size)
{
    const char *special;
    *data = NULL;
    const int descriptor = ordinary_open(path, O_RDONLY, &special);
    if (special) return fail(ctx, FLOE_IO, "cannot read '%s': it is %s, not an ordinary file", path, special);
    if (descriptor < 0) return file_fail(ctx, "cannot open", path, errno);
    size_t got = 0;
    const floe_status status = read_descriptor(ctx, path, descriptor, data, &got);
    (void)close(descriptor);
    if (size) *size = got;
    return status;
}

bool file_exists(const char *path)
{
    struct stat about;
    return lstat(path, &about) == 0;
}

bool file_is_ordinary(const char *path)
{
    struct stat about;
    return lstat(path, &about) == 0 && !special_kind(about.st_mode);
}

static floe_status make_one(context *ctx, const char *path)
{
    struct stat about;
    if (mkdir(path, 0777) == 0) return FLOE_OK;
    const int error = errno;
    if (stat(path, &about) == 0 && S_ISDIR(about.st_mode)) return FLOE_OK;
    return file_fail(ctx, "cannot make the folder", path, error);
}

/* Makes each folder on the way down; `path` is changed and changed back. */
static floe_status make_all(context *ctx, char *path)
{
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        const floe_status status = make_one(ctx, path);
        *slash = '/';
        TRY(status);
    }
    return make_one(ctx, path);
}

floe_status folder_make(context *ctx, const char *path)
{
    if (!path || !*path) return fail(ctx, FLOE_BAD_INPUT, "the name of the output folder is empty: give one with -o");
    char *copy;
    TRY(memory_string(ctx, &copy, path));
    const floe_status status = make_all(ctx, copy);
    memory_free(ctx, &copy);
    TRY(status);
    if (access(path, W_OK | X_OK) != 0) return file_fail(ctx, "cannot write into the folder", path, errno);
    return FLOE_OK;
}

static floe_status remove_files(context *ctx, const char *path, DIR *folder)
{
    const int at = dirfd(folder);
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        struct stat about;
        if (fstatat(at, entry->d_name, &about, AT_SYMLINK_NOFOLLOW) != 0 || S_ISDIR(about.st_mode)) continue;
        if (unlinkat(at, entry->d_name, 0) != 0 && errno != ENOENT)
            return file_fail(ctx, "cannot remove the files in", path, errno);
    }
    return FLOE_OK;
}

floe_status folder_remove(context *ctx, const char *path)
{
    /* A link to a folder elsewhere is not followed: the files in that are not floe's to remove. */
    const int descriptor = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0 && errno == ENOENT) return FLOE_OK;
    DIR *folder = descriptor < 0 ? NULL : fdopendir(descriptor);
    if (!folder) {
        const int error = errno;
        if (descriptor >= 0) (void)close(descriptor);
        return file_fail(ctx, "cannot open the folder", path, error);
    }
    const floe_status status = remove_files(ctx, path, folder);
    (void)closedir(folder);
    TRY(status);
    if (rmdir(path) != 0 && errno != ENOTEMPTY && errno != EEXIST && errno != ENOENT)
        return file_fail(ctx, "cannot remove the folder", path, errno);
    return FLOE_OK;
}

floe_status line_file_open(line_file *file, context *ctx, const char *path)
{
    *file = (line_file){.ctx = ctx, .descriptor = -1};
    const char *special;
    TRY(memory_string(ctx, &file->path, path));
    file->descriptor = ordinary_open(path, O_WRONLY | O_APPEND | O_NOFOLLOW, &special);
    if (special) {
        line_file_close(file);
        return file_refuse_special(ctx, "cannot append to", path, special);
    }
    const off_t length = file->descriptor < 0 ? -1 : lseek(file->descriptor, 0, SEEK_END);
    if (length < 0) {
        const int error = errno;
        line_file_close(file);
        return file_fail(ctx, "cannot open for appending", path, error);
    }
    file->length = length;
    return FLOE_OK;
}

floe_status line_file_append(line_file *file, const char *line, size_t size)
{
    const int error = file_write_all(file->descriptor, line, size);
    if (error != 0) {
        if (ftruncate(file->descriptor, file->length) != 0) {
            context_log(file->ctx, LOG_WARNING, "'%s' may end in half a line: %s", file->path, strerror(errno));
        }
        return file_fail(file->ctx, "cannot append to", file->path, error);
    }
    file->length += (long long)size;
    return FLOE_OK;
}

floe_status line_file_sync(line_file *file)
{
    const int error = file_sync_descriptor(file->descriptor);
    return error == 0 ? FLOE_OK : file_fail(file->ctx, "cannot sync", file->path, error);
}

void line_file_close(line_file *file)
{
    if (!file->path) return;
    if (file->descriptor >= 0) (void)close(file->descriptor);
    memory_free(file->ctx, &file->path);
    *file = (line_file){.descriptor = -1};
}
