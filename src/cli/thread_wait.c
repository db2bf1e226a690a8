/* Threads that wait for others sleep. Unasked, OpenMP lets them go round in a loop, which on a machine that does other things too takes the time from
 * those that work: short steps on two threads took five to fifteen times as long there. The library of OpenMP reads how threads wait once, before main
 * begins: so commands that compute say it in the environment and start again in their own place, which takes 20 ms. */
#include "cli/cli.h"

#include <stdlib.h>
#include <unistd.h>

void cli_let_threads_sleep(char **argv)
{
    static const char *const asked[] = {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT", "KMP_BLOCKTIME"};
    char path[4096];
    for (size_t k = 0; k < sizeof asked / sizeof *asked; ++k)
        if (getenv(asked[k])) return;
    const ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    if (length <= 0 || setenv(asked[0], "passive", 1) != 0) return;
    path[length] = '\0';
    (void)execv(path, argv); /* where it returns, threads wait as they do */
}
