/* The sweep (ice_trace_sweep.h) where cells may hold several fluids: in a file of its own, since it takes a minute to compile. */
#include "ice/trace/ice_trace_sweep.h"

#define SEVERAL(d, diffuses)                                             \
    FLOE_WIDE static void several_##d##_##diffuses(const trace_job *job) \
    {                                                                    \
        sweep_block(job, d, diffuses, true);                             \
    }
ICE_EACH(SEVERAL)
trace_slabs *const ice_trace_several_kernels[3][2] = ICE_TABLE(several);
