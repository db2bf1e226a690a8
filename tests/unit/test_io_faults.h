/* Faults on order: the test program's own write, pwrite, fsync and renameat, which the linker prefers to those of the C library. The
 * n-th call of any of them from fault_arm on fails, and all after it while `lasting`. */
#ifndef TESTS_UNIT_TEST_IO_FAULTS_H
#define TESTS_UNIT_TEST_IO_FAULTS_H

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

static struct {
    int countdown; /* 0: none */
    int error;
    bool lasting;
    bool fired;
    bool relents;  /* there is room again once what was kept for a checkpoint is given back */
    bool unsynced; /* nothing waits for the disk: for tests that write thousands of files */
} fault;

static inline void fault_arm(int n, int error, bool lasting)
{
    fault.countdown = n;
    fault.error = error;
    fault.lasting = lasting;
    fault.fired = false;
}

static inline bool fault_strikes(void)
{
    if (fault.countdown == 0) return false;
    if (fault.countdown > 1 && fault.countdown--) return false;
    fault.fired = true;
    if (!fault.lasting) fault.countdown = 0;
    errno = fault.error;
    return true;
}

/* A fault on a file that is being written leaves half of the bytes behind, as a full disk does. `at` < 0: at its end. */
static inline ssize_t fault_write(int descriptor, const void *data, size_t size, off_t at)
{
    struct iovec part;
    const bool strikes = descriptor > 2 && fault_strikes();
    const void **base = (const void **)&part.iov_base;
    *base = data;
    part.iov_len = strikes ? size / 2 : size;
    if (at >= 0 && lseek(descriptor, at, SEEK_SET) != at) return -1;
    const ssize_t written = writev(descriptor, &part, 1);
    if (!strikes) return written;
    errno = fault.error;
    return -1;
}

ssize_t write(int descriptor, const void *data, size_t size)
{
    return fault_write(descriptor, data, size, -1);
}

ssize_t pwrite(int descriptor, const void *data, size_t size, off_t at)
{
    return fault_write(descriptor, data, size, at);
}

int fsync(int descriptor)
{
    if (fault_strikes()) return -1;
    return fault.unsynced ? 0 : fdatasync(descriptor);
}

int unlink(const char *path)
{
    if (fault.relents && fault.fired && strstr(path, "checkpoint.reserve")) fault.countdown = 0;
    return unlinkat(AT_FDCWD, path, 0);
}

long syscall(long number, ...); /* which POSIX does not name */

int renameat(int from_folder, const char *from, int to_folder, const char *to)
{
    if (fault_strikes()) return -1;
    return (int)syscall(SYS_renameat2, from_folder, from, to_folder, to, 0);
}

#endif
