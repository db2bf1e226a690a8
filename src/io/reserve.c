#include "io/reserve.h"

#include "base/memory.h"
#include "io/file.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <sys/statvfs.h>
#include <unistd.h>

/* 0, or the error number. */
static int allocate_bytes(int descriptor, size_t bytes)
{
    int error = EINTR;
    while (error == EINTR) error = posix_fallocate(descriptor, 0, (off_t)bytes);
    return error;
}

floe_status disk_reserve_take(disk_reserve *r, context *ctx, const char *path, size_t bytes)
{
    *r = (disk_reserve){.ctx = ctx};
    TRY(file_remove(ctx, path));
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (descriptor < 0) return file_fail(ctx, "cannot create", path, errno);
    const int error = allocate_bytes(descriptor, bytes);
    (void)close(descriptor);
    floe_status status = FLOE_OK;
    if (error == 0) status = memory_string(ctx, &r->path, path);
    if (error == 0 && status == FLOE_OK) return FLOE_OK;
    (void)unlink(path);
    if (error == 0 || error == EINVAL || error == EOPNOTSUPP || error == ENOTSUP) return status;
    return file_fail(ctx, "cannot reserve disk space as", path, error);
}

floe_status disk_reserve_move(disk_reserve *r, const char *path)
{
    if (!r->path) return FLOE_OK;
    memory_free(r->ctx, &r->path);
    return memory_string(r->ctx, &r->path, path);
}

void disk_reserve_release(disk_reserve *r)
{
    if (!r->path) return;
    (void)unlink(r->path);
    memory_free(r->ctx, &r->path);
}

double disk_free_bytes(const char *path)
{
    struct statvfs about;
    if (statvfs(path, &about) != 0) return INFINITY;
    return (double)about.f_bavail * (double)about.f_frsize;
}
