#include "base/machine.h"

#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

/* The first "model name : ..." of /proc/cpuinfo; "" where there is none. */
static void processor_name(char *text, size_t size)
{
    char line[512];
    FILE *file = fopen("/proc/cpuinfo", "r");
    text[0] = '\0';
    if (!file) return;
    while (!text[0] && fgets(line, sizeof line, file)) {
        const char *value = strstr(line, ": ");
        if (strncmp(line, "model name", 10) != 0 || !value) continue;
        (void)snprintf(text, size, "%.*s", (int)strcspn(value + 2, "\n"), value + 2);
    }
    (void)fclose(file);
}

void machine_describe(char *text, size_t size)
{
    char name[256];
    struct utsname system;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    processor_name(name, sizeof name);
    size_t at = (size_t)snprintf(text, size, "%s", name);
    if (at < size && processors > 0)
        at += (size_t)snprintf(text + at, size - at, "%s%ld processor%s", at ? ", " : "", processors,
                               processors > 1 ? "s" : "");
    if (at < size && uname(&system) >= 0)
        (void)snprintf(text + at, size - at, "%s%s %s %s", at ? ", " : "", system.sysname, system.release,
                       system.machine);
}
