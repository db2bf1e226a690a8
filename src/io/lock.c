#include "io/lock.h"

#include "base/ordinary.h"
#include "io/file.h"
#include "io/file_replace.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

enum { LOCK_PATH = 4096 };

static void lock_path(const char *dir, char path[LOCK_PATH])
{
    (void)snprintf(path, LOCK_PATH, "%s/.lock", dir);
}

static struct flock whole_file(void)
{
    return (struct flock){.l_type = F_WRLCK, .l_whence = SEEK_SET};
}

/* The process that keeps a lock from being taken; 0: none. */
static long holder_of(int descriptor)
{
    struct flock lock = whole_file();
    if (fcntl(descriptor, F_GETLK, &lock) != 0 || lock.l_type == F_UNLCK) return 0;
    return (long)lock.l_pid;
}

static floe_status refuse_second_writer(context *ctx, const char *dir, int descriptor, int error)
{
    if (error == EACCES || error == EAGAIN) {
        return fail(ctx, FLOE_IO,
                    "process %ld is writing into '%s': wait for it to end, or choose another folder with -o",
                    holder_of(descriptor), dir);
    }
    if (error != ENOLCK && error != EINVAL && error != ENOTSUP)
        return file_fail(ctx, "cannot lock the folder", dir, error);
    context_log(ctx, LOG_WARNING, "'%s' cannot be locked: take care that no other run writes into it", dir);
    return FLOE_OK;
}

floe_status folder_lock_take(folder_lock *lock, context *ctx, const char *dir)
{
    char path[LOCK_PATH];
    const char *special;
    struct flock wanted = whole_file();
    *lock = (folder_lock){0};
    lock_path(dir, path);
    const int descriptor = ordinary_open(path, O_RDWR | O_CREAT | O_NOFOLLOW, &special);
    if (special) return file_refuse_special(ctx, "cannot lock", path, special);
    if (descriptor < 0) return file_fail(ctx, "cannot open", path, errno);
    if (fcntl(descriptor, F_SETLK, &wanted) == 0) {
        *lock = (folder_lock){true, descriptor};
        return FLOE_OK;
    }
    const floe_status status = refuse_second_writer(ctx, dir, descriptor, errno);
    (void)close(descriptor);
    return status;
}

void folder_lock_release(folder_lock *lock)
{
    if (lock->taken) (void)close(lock->descriptor);
    *lock = (folder_lock){0};
}

long folder_lock_holder(const char *dir)
{
    char path[LOCK_PATH];
    const char *special;
    lock_path(dir, path);
    const int descriptor = ordinary_open(path, O_RDWR | O_NOFOLLOW, &special);
    if (descriptor < 0) return 0;
    const long holder = holder_of(descriptor);
    (void)close(descriptor);
    return holder;
}
