#include "base/timer.h"

#include <stdio.h>
#include <sys/resource.h>
#include <time.h>

static double clock_seconds(clockid_t clock)
{
    struct timespec now = {0};
    if (clock_gettime(clock, &now) != 0) return 0.0;
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double wall_seconds(void)
{
    return clock_seconds(CLOCK_MONOTONIC);
}

double cpu_seconds(void)
{
    return clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

/* Linux: the high-water mark of this program. 0 when it cannot be read. */
static long long peak_rss_from_proc(void)
{
    FILE *file = fopen("/proc/self/status", "r");
    if (file == NULL) return 0;
    long long kilobytes = 0;
    char line[256];
    while (kilobytes == 0 && fgets(line, sizeof line, file) != NULL) {
        if (sscanf(line, "VmHWM: %lld kB", &kilobytes) != 1) kilobytes = 0;
    }
    fclose(file);
    return kilobytes * 1024;
}

/* getrusage alone would not do: on Linux its maximum survives exec, and so reports a large parent's size. */
long long peak_rss_bytes(void)
{
    const long long from_proc = peak_rss_from_proc();
    if (from_proc > 0) return from_proc;
    struct rusage usage = {0};
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return (long long)usage.ru_maxrss * 1024;
}
