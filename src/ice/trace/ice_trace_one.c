/* The sweep (ice_trace_sweep.h) where cells hold one fluid. */
#include "ice/trace/ice_trace_sweep.h"

#define INSTANCE(d, diffuses)                                          \
    FLOE_WIDE static void trace_##d##_##diffuses(const trace_job *job) \
    {                                                                  \
        sweep_block(job, d, diffuses, false);                          \
    }
ICE_EACH(INSTANCE)
trace_slabs *const ice_trace_kernels[3][2] = ICE_TABLE(trace);
