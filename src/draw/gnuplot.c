#include "draw/gnuplot.h"

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

/* gnuplot's exit status; -1 when a signal has ended it. */
static int spawn(const char *cd, const char *script)
{
    const char *const argument[] = {"gnuplot", "-e", cd, script, NULL};
    posix_spawn_file_actions_t actions;
    pid_t pid;
    int status;
    if (posix_spawn_file_actions_init(&actions) != 0) return MISSING;
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    const int error = posix_spawnp(&pid, argument[0], &actions, NULL, (char *const *)argument, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) return MISSING;
    while (waitpid(pid, &status, 0) < 0) {
        if (errno != EINTR) return -1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void gnuplot_run(context *ctx, const char *dir, const char *script)
{
    char cd[8192];
    const int status = write_cd(dir, cd, sizeof cd) ? spawn(cd, script) : -1;
    if (status == MISSING) {
        context_log(ctx, LOG_WARNING,
                    "gnuplot is not installed, so there are no plots; their data and script are in '%s': gnuplot %s",
                    dir, script);
    } else if (status != 0) {
        context_log(ctx, LOG_WARNING, "gnuplot has failed; to see why, run it in '%s': gnuplot %s", dir, script);
    }
}
