#include "base/ordinary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *special_kind(mode_t mode)
{
    if (S_ISREG(mode)) return NULL;
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a named pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return S_ISLNK(mode) ? "a symbolic link" : "a device";
}

/* Why an open has failed: a socket, and a pipe without a reader, are none that can be opened. */
static const char *kind_at(const char *path, int flags)
{
    const int error = errno;
    struct stat about;
    const bool found = (flags & O_NOFOLLOW ? lstat(path, &about) : stat(path, &about)) == 0;
    errno = error;
    return found ? special_kind(about.st_mode) : NULL;
}

int ordinary_open(const char *path, int flags, const char **special)
{
    struct stat about = {.st_mode = S_IFREG};
    *special = NULL;
    /* O_NONBLOCK: a named pipe must be refused, not waited for. */
    const int descriptor = open(path, flags | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        *special = kind_at(path, flags);
        return -1;
    }
    const int error = fstat(descriptor, &about) == 0 ? EINVAL : errno;
    *special = special_kind(about.st_mode);
    if (error == EINVAL && !*special) return descriptor;
    (void)close(descriptor);
    errno = error;
    return -1;
}

/* Names under which a system has the descriptors of the process. */
static bool is_descriptor(const char *path)
{
    static const char *const folder[] = {"/dev/fd/", "/proc/self/fd/"};
    if (strcmp(path, "/dev/stdin") == 0) return true;
    for (size_t i = 0; i < sizeof folder / sizeof folder[0]; i++)
        if (strncmp(path, folder[i], strlen(folder[i])) == 0) return true;
    return false;
}

int input_open(const char *path, const char **special)
{
    if (!is_descriptor(path)) return ordinary_open(path, O_RDONLY, special);
    *special = NULL;
    return open(path, O_RDONLY | O_NOCTTY | O_CLOEXEC);
}
