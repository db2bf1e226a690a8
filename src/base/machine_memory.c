/* Memory that is to be had: of the machine, and of the control groups that the process is in. */
#include "base/machine.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { PATH_SIZE = 4096 };

/* The number after `key` in a file of lines, in the file's unit; NAN: there is none. `key` "": the first number. */
static double number_in(const char *path, const char *key)
{
    char line[512];
    double value = NAN;
    FILE *file = fopen(path, "r");
    if (!file) return value;
    while (isnan(value) && fgets(line, sizeof line, file)) {
        char *end;
        if (strncmp(line, key, strlen(key)) != 0) continue;
        const char *from = line + strlen(key);
        const double x = strtod(from, &end);
        if (end != from) value = x;
        if (!key[0]) break;
    }
    (void)fclose(file);
    return value;
}

/* What a group leaves: its limit less what it uses, pages of files that can be dropped not counted. */
static double left_in(const char *folder, const char *limit, const char *used, const char *droppable)
{
    char path[PATH_SIZE + 64];
    (void)snprintf(path, sizeof path, "%s/%s", folder, limit);
    const double most = number_in(path, ""); /* "max" is none */
    (void)snprintf(path, sizeof path, "%s/%s", folder, used);
    const double now = number_in(path, "");
    (void)snprintf(path, sizeof path, "%s/memory.stat", folder);
    const double files = number_in(path, droppable);
    if (isnan(most) || isnan(now)) return (double)INFINITY;
    return fmax(0.0, most - now + (isnan(files) ? 0.0 : files));
}

/* The least of a group and those above it, up to the root of the hierarchy. `path` begins with '/'. */
static double left_up_from(const char *root, char *path, bool unified)
{
    double least = (double)INFINITY;
    for (;;) {
        char folder[PATH_SIZE];
        (void)snprintf(folder, sizeof folder, "%s%s", root, strcmp(path, "/") == 0 ? "" : path);
        least = fmin(
            least, unified ? left_in(folder, "memory.max", "memory.current", "inactive_file ")
                           : left_in(folder, "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file "));
        char *slash = strrchr(path, '/');
        if (!slash || strcmp(path, "/") == 0) return least;
        slash[slash == path ? 1 : 0] = '\0';
    }
}

static double left_in_groups(void)
{
    char line[PATH_SIZE];
    double least = (double)INFINITY;
    FILE *file = fopen("/proc/self/cgroup", "r");
    if (!file) return least;
    while (fgets(line, sizeof line, file)) {
        line[strcspn(line, "\n")] = '\0';
        char *list = strchr(line, ':'), *path = list ? strchr(list + 1, ':') : NULL;
        if (!path) continue;
        *path++ = '\0';
        if (path[0] != '/') continue;
        if (strcmp(list + 1, "memory") == 0) least = fmin(least, left_up_from("/sys/fs/cgroup/memory", path, false));
        if (list[1] == '\0') least = fmin(least, left_up_from("/sys/fs/cgroup", path, true));
    }
    (void)fclose(file);
    return least;
}

double machine_memory_available(void)
{
    struct rlimit limit;
    const double kilobytes = number_in("/proc/meminfo", "MemAvailable:"),
                 swap = number_in("/proc/meminfo", "SwapFree:");
    double least = isnan(kilobytes) ? (double)INFINITY : 1024.0 * (kilobytes + (isnan(swap) ? 0.0 : swap));
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        least = fmin(least, (double)limit.rlim_cur);
    return fmin(least, left_in_groups());
}
