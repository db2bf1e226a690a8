/* How a run of a scene would begin, for `floe check` and for the cases of a batch. */
#ifndef RUN_READY_H
#define RUN_READY_H

#include "scene/remark.h"

/* How a run of a scene would begin. */
typedef struct run_ready {
    bool done;          /* it was set up; false: it has too many cells, or is refused */
    double cells;       /* of the mesh */
    size_t points;      /* of material */
    double step, steps; /* s, and how many of its kind the run would need */
    const char *reason; /* what limits the step */
    double bytes,
        available; /* that a run of too many cells would hold, and that this machine has for it; 0: not known */
} run_ready;

/* Does with a scene what a run does before its first step, unless it has more than RUN_READY_CELLS (setup.h). FLOE_BAD_INPUT, with
 * its place, or FLOE_DIVERGED: what the run would end with. `say` takes the remarks on the scene as it is laid out, a run's own (NULL: nobody). */
floe_status run_make_ready(scene *s, run_ready *out, remark_sink *say, void *user);

#endif
