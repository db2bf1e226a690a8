/* New files. The folder is opened once, and everything is done by names within it: a folder that another takes the place
 * of meanwhile leads nothing astray. A file is made anew (O_EXCL), so that no link and no device is written through, and
 * takes the place of ordinary files only. */
#include "io/file_replace.h"

#include "base/memory.h"
#include "base/ordinary.h"
#include "io/file.h"
#include "io/new_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int file_write_all(int descriptor, const char *data, size_t size)
{
    while (size > 0) {
        const ssize_t written = write(descriptor, data, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        if (written == 0) return ENOSPC;
        data += written;
        size -= (size_t)written;
    }
    return 0;
}

int file_sync_descriptor(int descriptor)
{
    while (fsync(descriptor) != 0) {
        if (errno != EINTR) return errno;
    }
    return 0;
}

static void close_folder_of(new_file *f)
{
    if (f->folder >= 0) (void)close(f->folder);
    f->folder = -1;
    memory_free(f->ctx, &f->temporary);
}

/* Opens the folder of a path. */
static floe_status open_folder_of(new_file *f, context *ctx, const char *path, const char *doing)
{
    const char *slash = strrchr(path, '/');
    const size_t length = slash ? (size_t)(slash - path) : 0;
    char *folder;
    *f = (new_file){.ctx = ctx, .path = path, .name = slash ? slash + 1 : path, .folder = -1, .descriptor = -1};
    if (f->name[0] == '\0') return file_fail(ctx, doing, path, EISDIR);
    TRY(memory_string(ctx, &folder, slash ? path : "."));
    if (slash) folder[length > 0 ? length : 1] = '\0';
    f->folder = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const int error = errno;
    memory_free(ctx, &folder);
    return f->folder < 0 ? file_fail(ctx, doing, path, error) : FLOE_OK;
}

static floe_status name_temporary(new_file *f)
{
    const size_t size = strlen(f->name) + sizeof ".tmp";
    TRY(memory_new(f->ctx, &f->temporary, size, 1));
    (void)snprintf(f->temporary, size, "%s.tmp", f->name);
    return FLOE_OK;
}

/* What stands under a name of the folder: NULL for nothing or an ordinary file. */
static const char *special_at(const new_file *f, const char *name)
{
    struct stat about;
    return fstatat(f->folder, name, &about, AT_SYMLINK_NOFOLLOW) == 0 ? special_kind(about.st_mode) : NULL;
}

static floe_status refuse_special(const new_file *f, const char *doing)
{
    const char *special = special_at(f, f->name);
    return special ? file_refuse_special(f->ctx, doing, f->path, special) : FLOE_OK;
}

/* A new file, -1 on failure. What a kill has left under its name, or someone has put there, goes; a link is not followed. */
static int create_new(const new_file *f)
{
    enum { FLAGS = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC };
    const int descriptor = openat(f->folder, f->temporary, FLAGS, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
    if (unlinkat(f->folder, f->temporary, 0) != 0 && errno != ENOENT) return -1;
    return openat(f->folder, f->temporary, FLAGS, 0666);
}

floe_status new_file_begin(new_file *f, context *ctx, const char *path)
{
    TRY(open_folder_of(f, ctx, path, "cannot create"));
    TRY(refuse_special(f, "cannot write"));
    TRY(name_temporary(f));
    f->descriptor = create_new(f);
    return f->descriptor < 0 ? file_fail(f->ctx, "cannot create", f->path, errno) : FLOE_OK;
}

void new_file_write(new_file *f, uint64_t at, const void *data, size_t size)
{
    const char *from = data;
    while (size > 0 && f->error == 0) {
        const ssize_t written = pwrite(f->descriptor, from, size, (off_t)at);
        if (written <= 0) {
            if (written == 0 || errno != EINTR) f->error = written == 0 ? ENOSPC : errno;
            continue;
        }
        from += written;
        at += (uint64_t)written;
        size -= (size_t)written;
    }
}

bool new_file_read(new_file *f, uint64_t at, void *data, size_t size)
{
    char *to = data;
    while (size > 0) {
        const ssize_t read = pread(f->descriptor, to, size, (off_t)at);
        if (read < 0 && errno == EINTR) continue;
        if (read < 0 && f->error == 0) f->error = errno;
        if (read <= 0) break;
        to += read;
        at += (uint64_t)read;
        size -= (size_t)read;
    }
    memset(to, 0, size);
    return f->error == 0;
}

uint64_t new_file_size(new_file *f)
{
    struct stat about;
    if (fstat(f->descriptor, &about) == 0) return (uint64_t)about.st_size;
    if (f->error == 0) f->error = errno;
    return 0;
}

void new_file_set_size(new_file *f, uint64_t size)
{
    if (f->error == 0 && ftruncate(f->descriptor, (off_t)size) != 0) f->error = errno;
}

static floe_status sync_folder(const new_file *f)
{
    const int error = file_sync_descriptor(f->folder);
    /* Some network file systems cannot sync a folder: nothing more can be done there. */
    const bool fine = error == 0 || error == EINVAL || error == ENOTSUP;
    return fine ? FLOE_OK : file_fail(f->ctx, "cannot sync the folder of", f->path, error);
}

/* 0, or the error number. A second name first, so that the first is never without a file; where the file system has no
 * second names, the file moves. */
static int rename_keeping_both(const new_file *f, const char *kept, const char *temporary)
{
    (void)unlinkat(f->folder, temporary, 0);
    if (linkat(f->folder, f->name, f->folder, temporary, 0) != 0) {
        if (errno == ENOENT) return 0; /* there is nothing to keep */
        return renameat(f->folder, f->name, f->folder, kept) == 0 ? 0 : errno;
    }
    const int error = renameat(f->folder, temporary, f->folder, kept) == 0 ? 0 : errno;
    /* Of two names of one file, rename leaves both. */
    (void)unlinkat(f->folder, temporary, 0);
    return error;
}

static floe_status keep_earlier(const new_file *f, const char *kept)
{
    const size_t size = strlen(kept) + sizeof ".tmp";
    char *temporary;
    TRY(memory_new(f->ctx, &temporary, size, 1));
    (void)snprintf(temporary, size, "%s.tmp", kept);
    const int error = rename_keeping_both(f, kept, temporary);
    memory_free(f->ctx, &temporary);
    return error == 0 ? FLOE_OK : file_fail(f->ctx, "cannot keep the earlier", f->path, error);
}

/* Syncs and closes the new file. */
static floe_status complete_new(new_file *f)
{
    if (f->error == 0) f->error = file_sync_descriptor(f->descriptor);
    const int closed = close(f->descriptor);
    f->descriptor = -1;
    if (closed != 0 && f->error == 0 && errno != EINTR) f->error = errno;
    return f->error == 0 ? FLOE_OK : file_fail(f->ctx, "cannot write", f->path, f->error);
}

static floe_status take_name(new_file *f, const char *kept)
{
    TRY(complete_new(f));
    if (kept) TRY(keep_earlier(f, kept));
    if (renameat(f->folder, f->temporary, f->folder, f->name) != 0)
        return file_fail(f->ctx, "cannot rename a finished file to", f->path, errno);
    memory_free(f->ctx, &f->temporary); /* that name is gone */
    return sync_folder(f);
}

floe_status new_file_finish(new_file *f, floe_status so_far, const char *kept)
{
    const floe_status status = so_far == FLOE_OK ? take_name(f, kept) : so_far;
    if (f->descriptor >= 0) (void)close(f->descriptor);
    f->descriptor = -1;
    if (f->folder >= 0 && f->temporary) (void)unlinkat(f->folder, f->temporary, 0);
    close_folder_of(f);
    return status;
}

floe_status file_replace_keeping(context *ctx, const char *path, const char *kept, const file_part *part, int parts)
{
    new_file f;
    const floe_status status = new_file_begin(&f, ctx, path);
    uint64_t at = 0;
    for (int i = 0; i < parts && status == FLOE_OK; at += part[i].size, i++)
        new_file_write(&f, at, part[i].data, part[i].size);
    return new_file_finish(&f, status, kept);
}

floe_status file_replace(context *ctx, const char *path, const file_part *part, int parts)
{
    return file_replace_keeping(ctx, path, NULL, part, parts);
}

floe_status file_replace_text(context *ctx, const char *path, const char *text)
{
    const file_part part = {text, strlen(text)};
    return file_replace(ctx, path, &part, 1);
}

static floe_status remove_ordinary(const new_file *f)
{
    TRY(refuse_special(f, "cannot remove"));
    if (unlinkat(f->folder, f->name, 0) == 0 || errno == ENOENT) return FLOE_OK;
    return file_fail(f->ctx, "cannot remove", f->path, errno);
}

floe_status file_remove(context *ctx, const char *path)
{
    struct stat about;
    new_file f;
    if (lstat(path, &about) != 0 && errno == ENOENT) return FLOE_OK;
    floe_status status = open_folder_of(&f, ctx, path, "cannot remove");
    if (status == FLOE_OK) status = remove_ordinary(&f);
    close_folder_of(&f);
    return status;
}
