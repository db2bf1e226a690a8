/* What a run writes, before it does: its snapshots, and the checkpoints that are there at a time, beside what is free. */
#ifndef RUN_DISK_NEED_H
#define RUN_DISK_NEED_H

#include "run/memory_need.h"
#include "scene/remark.h"

typedef struct disk_need {
    double snapshots; /* how many, the first and the last with them */
    double bytes;     /* of all, and of three checkpoints: the two latest, and space for another */
    double available; /* bytes; INFINITY: unknown */
    bool fits;
} disk_need;

/* `written`: bytes of the state (memory_need.written_bytes); `dir`: where the folder of results is, or will be made. */
void disk_need_of(const scene *s, double written, const char *dir, disk_need *out);
/* Says what does not fit, with the place of its key. */
void disk_need_remark(const sim *s, const char *dir, remark_sink *say, void *user);

#endif
