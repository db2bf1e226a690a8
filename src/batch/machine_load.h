/* How much of the machine others use, for times that are to be trusted. */
#ifndef BATCH_MACHINE_LOAD_H
#define BATCH_MACHINE_LOAD_H

typedef struct machine_load {
    double wall;    /* s, from an arbitrary origin */
    double all_cpu; /* s of processor time used by everything on the machine; NAN where the system does not tell */
    double own_cpu; /* s used by this process and by those of its children that have ended */
} machine_load;

machine_load machine_load_now(void);
/* Processor time that others used between two moments, per wall time: cores. NAN: unknown. What a child uses counts as
 * that of others until the child has been waited for, so both moments must have none running. */
double machine_load_of_others(const machine_load *from, const machine_load *to);

#endif
