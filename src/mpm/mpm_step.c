/* The points-only step, straight down (numerics 4.1). */
#include "mpm/work.h"

#include <math.h>

/* Velocities live half a step behind positions: the first kick is half a step, later ones the mean of old and new step, which
 * makes pure MPM second order in time (design, conventions). Coupled, everything lives at n. */
floe_status mpm_begin_step(mpm *s)
{
    s->work->kick = s->coupled ? s->dt : 0.5 * (s->dt_previous + s->dt);
    set_body_forces(s);
    return FLOE_OK;
}

#define POINT_STATE \
    P_STRESS, P_J, WHEN(s->has_energy, P_ENERGY), WHEN(s->needs_F, P_F), WHEN(s->artificial, P_VISCOUS_PRESSURE)

floe_status mpm_step(mpm *s)
{
    const bool usf = s->scene->method.stress == STRESS_USF, musl = s->scene->method.stress == STRESS_MUSL;
    const bool gimp = s->basis->kind == BASIS_GIMP;
    TRY(mpm_begin_step(s));
    STAGE(s, ALWAYS, mpm_points_to_nodes, READS(P_ID, P_MASS, P_VOLUME0, P_POS, P_VEL, WHEN(gimp, P_HALF), POINT_STATE),
          WRITES(N_MASS, N_MOMENTUM, WHEN(!usf, N_FORCE)));
    STAGE(s, usf, mpm_node_velocity, READS(N_MASS, N_MOMENTUM), WRITES(N_VEL));
    STAGE(s, usf, mpm_stress_first, READS(N_VEL, P_POS, POINT_STATE), WRITES(POINT_STATE));
    STAGE(s, usf, mpm_node_force, READS(P_POS, POINT_STATE), WRITES(N_FORCE));
    STAGE(s, ALWAYS, mpm_node_update, READS(N_MASS, N_MOMENTUM, N_FORCE), WRITES(N_VEL_L));
    STAGE(s, ALWAYS, mpm_node_acceleration, READS(N_MASS, N_MOMENTUM, N_VEL_L), WRITES(N_ACCEL, N_VEL_L));
    STAGE(s, ALWAYS, mpm_nodes_to_points, READS(N_VEL_L, N_ACCEL, P_POS, P_VEL, POINT_STATE),
          WRITES(P_POS, P_VEL, WHEN(!usf && !musl, P_STRESS), WHEN(!usf && !musl, P_J), WHEN(s->has_energy, P_ENERGY),
                 WHEN(s->needs_F, P_F), WHEN(s->artificial, P_VISCOUS_PRESSURE)));
    STAGE(s, musl, mpm_remap_stress, READS(P_POS, P_VEL, POINT_STATE), WRITES(N_MASS, N_MOMENTUM, N_VEL, POINT_STATE));
    return FLOE_OK;
}
