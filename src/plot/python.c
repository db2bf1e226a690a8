/* Starting python/floe. */
#include "base/memory.h"
#include "base/strbuf.h"
#include "io/file.h"
#include "plot/plot.h"

#include <errno.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ; /* POSIX: handed on as it is */

enum { PATH_SIZE = 4096, MISSING_PROGRAM = 127, MISSING_PACKAGE = 69 /* of python/floe/command.py */ };

/* FLOE_PYTHON_PROGRAM, FLOE_PYTHON_SOURCE and FLOE_PYTHON_INSTALLED are of the build (CMakeLists.txt beside this file). */
static const char *interpreter(void)
{
    const char *chosen = getenv("FLOE_PYTHON");
    return chosen && chosen[0] ? chosen : FLOE_PYTHON_PROGRAM;
}

/* The folder of the package: beside the program in an installed tree, which may have been moved, else that of the sources. */
static floe_status find_package(context *ctx, strbuf *folder)
{
    char program[PATH_SIZE];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    strbuf_init(folder, ctx);
    if (length > 0) {
        program[length] = '\0';
        *strrchr(program, '/') = '\0';
        strbuf_append(folder, "%s/%s/__main__.py", program, FLOE_PYTHON_INSTALLED);
        if (file_exists(strbuf_string(folder))) {
            folder->length -= strlen("/__main__.py");
            folder->data[folder->length] = '\0';
            return folder->status;
        }
        strbuf_free(folder);
        strbuf_init(folder, ctx);
    }
    strbuf_append(folder, "%s", FLOE_PYTHON_SOURCE);
    return folder->status;
}

/* The process's exit status; -1 when a signal has ended it. The signal that asks this process to end is passed on. */
static int wait_for_python(pid_t pid, const volatile sig_atomic_t *stop)
{
    bool told = false;
    int status;
    while (waitpid(pid, &status, 0) < 0) {
        if (errno != EINTR) return -1;
        if (told || !stop || !*stop) continue;
        (void)kill(pid, SIGINT);
        told = true;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static floe_status start_python(context *ctx, const char *package, const char *const *argument, size_t n,
                                const volatile sig_atomic_t *stop, int *exit_status)
{
    const char **all;
    pid_t pid;
    TRY(memory_new(ctx, &all, n + 3, sizeof *all));
    all[0] = interpreter();
    all[1] = package;
    for (size_t i = 0; i < n; i++) all[2 + i] = argument[i];
    (void)fflush(stdout);
    /* posix_spawnp does not change its arguments. */
    const int error = posix_spawnp(&pid, all[0], NULL, NULL, (char *const *)all, environ);
    memory_free(ctx, &all);
    *exit_status = error != 0 ? MISSING_PROGRAM : wait_for_python(pid, stop);
    return FLOE_OK;
}

floe_status python_run(context *ctx, const char *const *argument, size_t n, const volatile sig_atomic_t *stop,
                       int *exit_status)
{
    strbuf package;
    if (FLOE_PYTHON_SOURCE[0] == '\0')
        return fail(ctx, FLOE_IO, "this floe was built without pictures: configure one with -DFLOE_PICTURES=ON");
    floe_status started = find_package(ctx, &package);
    if (started == FLOE_OK) started = start_python(ctx, strbuf_string(&package), argument, n, stop, exit_status);
    strbuf_free(&package);
    TRY(started);
    const int status = *exit_status;
    if (status == MISSING_PROGRAM || status == MISSING_PACKAGE)
        return fail(ctx, FLOE_IO,
                    "'%s' %s; install python3-numpy, python3-h5py, python3-matplotlib and python3-jinja2, or set "
                    "FLOE_PYTHON to a Python that has them",
                    interpreter(),
                    status == MISSING_PACKAGE ? "lacks a package for pictures and pages"
                                              : "is not there, and pictures and pages need Python");
    if (status < 0 || status == 1)
        return fail(ctx, FLOE_IO, "'%s' has failed to make a picture, a plot, a page or a comparison", interpreter());
    return FLOE_OK;
}
