/* What floe runs on, for results that are compared. */
#ifndef BASE_MACHINE_H
#define BASE_MACHINE_H

#include <stddef.h>

/* "AMD EPYC 7B13, 8 processors, Linux 6.1.0 x86_64"; what the system does not report is left out. */
void machine_describe(char *text, size_t size);

/* Bytes of memory that a program may still take, the limit of its control group (cgroup) counted in; INFINITY where the
 * system does not report it. */
double machine_memory_available(void);

#endif
