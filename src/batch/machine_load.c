#include "batch/machine_load.h"

#include "base/timer.h"

#include <math.h>
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

/* Linux: the first line of /proc/stat, in ticks: user, nice, system, idle, iowait, irq, softirq, steal. */
static double all_cpu(void)
{
    enum { FIELDS = 8, IDLE = 3, WAITING = 4 };
    unsigned long long ticks[FIELDS];
    FILE *file = fopen("/proc/stat", "r");
    if (!file) return NAN;
    const int n = fscanf(file, "cpu %llu %llu %llu %llu %llu %llu %llu %llu", &ticks[0], &ticks[1], &ticks[2],
                         &ticks[3], &ticks[4], &ticks[5], &ticks[6], &ticks[7]);
    (void)fclose(file);
    if (n != FIELDS) return NAN;
    double sum = 0.0;
    for (int i = 0; i < FIELDS; i++) {
        if (i != IDLE && i != WAITING) sum += (double)ticks[i];
    }
    return sum / (double)sysconf(_SC_CLK_TCK);
}

static double used_by(int who)
{
    struct rusage usage;
    if (getrusage(who, &usage) != 0) return NAN;
    return (double)usage.ru_utime.tv_sec + (double)usage.ru_stime.tv_sec +
           1e-6 * ((double)usage.ru_utime.tv_usec + (double)usage.ru_stime.tv_usec);
}

machine_load machine_load_now(void)
{
    return (machine_load){wall_seconds(), all_cpu(), used_by(RUSAGE_SELF) + used_by(RUSAGE_CHILDREN)};
}

double machine_load_of_others(const machine_load *from, const machine_load *to)
{
    const double wall = to->wall - from->wall;
    if (!(wall > 0.0)) return NAN;
    return fmax(0.0, (to->all_cpu - from->all_cpu) - (to->own_cpu - from->own_cpu)) / wall;
}
