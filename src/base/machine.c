#include "base/machine.h"
#include "base/text.h"

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
    (void)snprintf(text, size, "%s", name);
    if (processors > 0)
        text_add(text, size, "%s%ld processor%s", text[0] ? ", " : "", processors, processors > 1 ? "s" : "");
    if (uname(&system) >= 0)
        text_add(text, size, "%s%s %s %s", text[0] ? ", " : "", system.sysname, system.release, system.machine);
}
