#include "draw/gnuplot.h"

#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>

extern char **environ; /* POSIX: handed on as it is */

enum { MISSING = 127 }; /* exit status of a program that could not be started */

/* cd 'DIR', in gnuplot's quotes. */
static bool write_cd(const char *dir, char *text, size_t size)
{
    size_t at = (size_t)snprintf(text, size, "cd '");
    for (; *dir && at + 4 < size; dir++) {
        if (*dir == '\'') text[at++] = '\'';
        text[at++] = *dir;
    }
    (void)snprintf(text + at, size - at, "'");
    return *dir == '\0';
}

/* The exit status of one gnuplot that runs the scripts in turn; -1 when a signal has ended it or memory is out. */
static int run_gnuplot(context *ctx, const char *cd, const char *const *script, size_t n)
{
    const char **argument;
    posix_spawn_file_actions_t actions;
    pid_t pid;
    int status;
    if (memory_new(ctx, &argument, n + 4, sizeof *argument) != FLOE_OK) return -1;
    argument[0] = "gnuplot";
    argument[1] = "-e";
    argument[2] = cd;
    for (size_t i = 0; i < n; i++) argument[3 + i] = script[i];
    int error = posix_spawn_file_actions_init(&actions);
    if (error == 0) {
        posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
        /* posix_spawnp does not change its arguments. */
        error = posix_spawnp(&pid, argument[0], &actions, NULL, (char *const *)argument, environ);
        posix_spawn_file_actions_destroy(&actions);
    }
    memory_free(ctx, &argument);
    if (error != 0) return MISSING;
    while (waitpid(pid, &status, 0) < 0) {
        if (errno != EINTR) return -1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void warn_of_gnuplot(context *ctx, const char *dir, const char *script, int status)
{
    if (status == MISSING) {
        context_log(ctx, LOG_WARNING,
                    "gnuplot is not installed, so there are no plots; their data and script are in '%s': gnuplot %s",
                    dir, script);
    } else if (status != 0) {
        context_log(ctx, LOG_WARNING, "gnuplot has failed; to see why, run it in '%s': gnuplot %s", dir, script);
    }
}

gnuplot_result gnuplot_run(context *ctx, const char *dir, const char *const *script, size_t n)
{
    char cd[8192];
    if (n == 0) return GNUPLOT_DONE;
    int status = write_cd(dir, cd, sizeof cd) ? run_gnuplot(ctx, cd, script, n) : -1;
    if (status == 0) return GNUPLOT_DONE;
    if (status == MISSING || n == 1) {
        warn_of_gnuplot(ctx, dir, n == 1 ? script[0] : "*.gp", status);
        return status == MISSING ? GNUPLOT_MISSING : GNUPLOT_FAILED;
    }
    /* A script that fails takes those after it along: each by itself. */
    for (size_t i = 0; i < n; i++) {
        status = run_gnuplot(ctx, cd, &script[i], 1);
        warn_of_gnuplot(ctx, dir, script[i], status);
    }
    return GNUPLOT_FAILED;
}
