/* The points-only step, straight down (theory 4.1). */
#include "coupling/wall_response.h"
#include "mpm/fluid/fluid.h"
#include "mpm/loads/point_loads.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/light_nodes.h"
#include "mpm/nodes/sides.h"
#include "mpm/nodes/supports.h"
#include "mpm/step.h"
#include "mpm/surface/surfaces.h"
#include "mpm/thermal/thermal.h"
#include "mpm/transfer/carry.h"
#include "mpm/transfer/scatter.h"

#include <math.h>

/* Where fluids are on points and the deck gives no share of FLIP, the PIC share of a step is 0.6 for each cell that the fastest point crosses,
 * and at most 0.01, so that what it filters of a slow flow does not depend on the number of steps. A constant share per step is a viscosity that
 * grows as the step falls: a vortex at a Mach number of 1/40 lost 43 % of its energy at cfl 0.5 and all of it at 0.05 (theory 4.2). */
static void take_flip_share(mpm *s)
{
    const bool unasked = isnan(s->transfer->share) && isnan(s->scene->method.flip);
    if (unasked && has_fluid_points(s)) s->share = 1.0 - fmin(MPM_PIC_PER_CELL * s->fastest * s->dt, MPM_PIC_MOST);
}

/* Velocities live half a step behind positions: the first kick is half a step, later ones the mean of old and new step,
 * which makes pure MPM second order in time (design, conventions). Beside cells, everything lives at n. */
floe_status mpm_begin_step(mpm *s)
{
    take_flip_share(s);
    s->kick = s->cells != CELLS_NONE ? s->dt : 0.5 * (s->dt_previous + s->dt);
    s->burnt = false;
    set_body_forces(s);
    return follow_supports(s);
}

#define REMEMBERED(n) WHEN(s->n_history >= (n), P_HISTORY_##n)
#define HISTORY                                                                                                       \
    REMEMBERED(1), REMEMBERED(2), REMEMBERED(3), REMEMBERED(4), REMEMBERED(5), REMEMBERED(6), REMEMBERED(7),          \
        REMEMBERED(8), REMEMBERED(9), REMEMBERED(10), REMEMBERED(11), REMEMBERED(12), REMEMBERED(13), REMEMBERED(14), \
        REMEMBERED(15), REMEMBERED(16), REMEMBERED(17), REMEMBERED(18), REMEMBERED(19), REMEMBERED(20),               \
        REMEMBERED(21), REMEMBERED(22), REMEMBERED(23), REMEMBERED(24)
#define MEMBRANE_STRAIN WHEN(s->carries[P_TANGENT], P_STRAIN), WHEN(s->carries[P_STRAIN_HOOP], P_STRAIN_HOOP)
#define SURFACE_VECTORS WHEN(s->carries[P_SURFACE_1], P_SURFACE_1), WHEN(s->carries[P_SURFACE_1], P_SURFACE_2)
#define DOMAINS WHEN(s->basis->fact.sized, P_HALF), WHEN(s->carries[P_BOX], P_BOX), WHEN(s->basis->fact.shaped, P_F)
#define TANGENT WHEN(s->carries[P_TANGENT], P_TANGENT)
#define VOLUME_RATE WHEN(s->carries[P_VOLUME_RATE], P_VOLUME_RATE)
#define POINT_STATE                                                                                        \
    P_STRESS, P_J, WHEN(s->carries[P_ENERGY], P_ENERGY), WHEN(s->carries[P_F], P_F),                       \
        WHEN(s->carries[P_VISCOUS_PRESSURE], P_VISCOUS_PRESSURE), WHEN(s->carries[P_BOX], P_BOX), HISTORY, \
        MEMBRANE_STRAIN, SURFACE_VECTORS, WHEN(s->carries[P_THERMAL_STRETCH], P_THERMAL_STRETCH)
/* What stress also reads and writes of bodies that have a temperature. */
#define EXPANDING WHEN(s->carries[P_STRESS_FREE], P_TEMP), WHEN(s->carries[P_STRESS_FREE], P_STRESS_FREE)
#define DISSIPATED WHEN(s->carries[P_DISSIPATED], P_DISSIPATED)

static bool is_usf(const mpm *s)
{
    return s->scene->method.stress == STRESS_USF;
}

static bool advects_points(const mpm *s)
{
    return s->transfer->carry != CARRY_NOTHING;
}

static bool has_contact(const mpm *s)
{
    return s->contact != NULL;
}

static bool has_wetted(const mpm *s)
{
    return s->wetted != NULL;
}

static bool has_motions(const mpm *s)
{
    return s->motions != NULL;
}

static bool has_yielding_fluids(const mpm *s)
{
    return s->surfaces && s->surfaces->fluids;
}

/* Whether the fluids find their pressure with the walls, in one system with them. */
static bool searches_pressure(const mpm *s)
{
    return has_yielding_fluids(s) && s->surfaces->fluids->solve;
}

static bool has_edges(const mpm *s)
{
    return s->edges != NULL;
}

static bool meets_at_points(const mpm *s)
{
    return has_contact(s) && s->scene->contact.touch == CONTACT_AT_POINTS;
}

/* Forces come with the masses where nothing changes the stress before they are used, or where a contact is foreseen with
 * them. */
bool forces_at_once(const mpm *s)
{
    return s->cells != CELLS_SMEARED && (!is_usf(s) || has_contact(s));
}

static bool is_musl(const mpm *s)
{
    return s->scene->method.stress == STRESS_MUSL;
}

static bool is_usl(const mpm *s)
{
    return !is_usf(s) && !is_musl(s);
}

static floe_status node_heat_stage(mpm *s, bool when)
{
    STAGE(s, when, mpm_heat_to_nodes, READS(P_MASS, P_POS, DOMAINS, P_TEMP, WHEN(conducts(s), P_TEMP_GRADIENT)),
          WRITES(N_CAPACITY, N_HEAT, N_TEMP, N_TEMP_CHANGE, WHEN(conducts(s), N_HEAT_GRADIENT)));
    return FLOE_OK;
}

static floe_status free_point_stage(mpm *s)
{
    STAGE(s, s->carries[P_FREE_MASS], mpm_find_free_points, READS(P_MASS, P_POS), WRITES(P_FREE_MASS));
    return FLOE_OK;
}

floe_status mpm_mass_stages(mpm *s)
{
    const bool force = forces_at_once(s), drive = s->carries[P_DRIVE] && force;
    STAGE(s, s->carries[P_DRIVE], mpm_drive_points, READS(WHEN(s->carries[P_REST], P_REST), P_POS, P_J),
          WRITES(P_DRIVE));
    TRY(free_point_stage(s));
    STAGE(s, s->enclosure, mpm_enclosed_pressure,
          READS(P_ID, P_POS, P_NORMAL, P_SURFACE_1, P_SURFACE_2, P_VOLUME0, P_STRESS, P_J), WRITES(NOTHING));
    STAGE(s, force && s->carries[P_MEAN_PRESSURE], mpm_share_pressures, READS(P_POS, P_VOLUME0, POINT_STATE),
          WRITES(P_MEAN_PRESSURE));
    STAGE(s, has_motions(s), mpm_begin_motions, READS(P_MASS, P_POS, P_VEL), WRITES(NOTHING));
    STAGE(s, ALWAYS, mpm_points_to_nodes,
          READS(P_ID, P_MASS, P_VOLUME0, P_POS, P_VEL, WHEN(advects_points(s), P_AFFINE), DOMAINS, WHEN(drive, P_DRIVE),
                WHEN(force && s->carries[P_MEAN_PRESSURE], P_MEAN_PRESSURE), POINT_STATE),
          WRITES(N_MASS, N_MOMENTUM, WHEN(force, N_FORCE)));
    TRY(node_heat_stage(s, group_gives_heat(s, -1)));
    STAGE(s, has_motions(s), mpm_motion_momenta, READS(N_MASS, N_MOMENTUM), WRITES(N_MOMENTUM));
    STAGE(s, has_wetted(s), mpm_wetted_area, READS(N_MASS, P_POS, P_VOLUME0, P_J, P_STRESS, DOMAINS),
          WRITES(N_WETTED_AREA));
    STAGE(s, walls_let_go(s), mpm_side_reach, READS(P_POS, P_VOLUME0, P_J, DOMAINS), WRITES(N_SIDE_REACH, N_SIDE_BODY));
    STAGE(s, has_contact(s), mpm_contact_normals, READS(N_MASS, P_POS, P_VOLUME0, DOMAINS), WRITES(N_COLOUR, N_NORMAL));
    STAGE(s, meets_at_points(s), mpm_contact_reach, READS(N_MASS, N_NORMAL, P_POS, P_VOLUME0, P_J, DOMAINS),
          WRITES(N_REACH, N_NORMAL, WHEN(s->mesh->dim > 1, N_REACH_FIRST), WHEN(s->mesh->dim > 1, N_REACH_SECOND),
                 WHEN(s->mesh->dim > 1, N_ASIDE)));
    return FLOE_OK;
}

floe_status mpm_surface_temperature_stages(mpm *s)
{
    return node_heat_stage(s, takes_wall_heat(s));
}

floe_status mpm_burn_stages(mpm *s)
{
    STAGE(s, s->carries[P_SHARE], mpm_burn,
          READS(N_BURNT_SHARE, N_MASS, N_MOMENTUM, P_MASS, P_SHARE, P_VOLUME0, P_POS, P_VEL,
                WHEN(advects_points(s), P_AFFINE), DOMAINS, POINT_STATE),
          WRITES(N_BURNT_SHARE, N_MASS, N_MOMENTUM, N_BURNT, N_BURNT_MOMENTUM, N_BURNT_ENERGY, P_MASS_LEFT));
    return FLOE_OK;
}

floe_status mpm_conduction_stages(mpm *s)
{
    STAGE(s, conducts(s), mpm_conduct, READS(N_CAPACITY, N_TEMP, N_TEMP_CHANGE, P_POS, P_VOLUME0, P_J, DOMAINS),
          WRITES(N_TEMP, N_TEMP_CHANGE));
    return FLOE_OK;
}

floe_status mpm_force_stages(mpm *s)
{
    const bool usf = is_usf(s), apart = s->cells == CELLS_SMEARED || usf, searches = searches_pressure(s),
               several = searches && s->scene->fluids_share;
    STAGE(s, usf, mpm_node_velocity,
          READS(N_MASS, N_MOMENTUM, WHEN(has_contact(s), N_FORCE), WHEN(has_contact(s), N_NORMAL),
                WHEN(meets_at_points(s), N_REACH)),
          WRITES(N_VEL));
    STAGE(s, usf && s->cell_mass, mpm_cell_density, READS(P_MASS, P_POS), WRITES(P_DENSITY));
    STAGE(s, usf, mpm_stress_first, READS(N_VEL, P_POS, TANGENT, POINT_STATE, EXPANDING, WHEN(s->cell_mass, P_DENSITY)),
          WRITES(VOLUME_RATE, POINT_STATE, DISSIPATED));
    const bool shared = apart && s->carries[P_MEAN_PRESSURE];
    STAGE(s, shared && usf, mpm_share_new_pressures,
          READS(P_POS, P_VOLUME0, POINT_STATE, WHEN(s->cells == CELLS_SMEARED, P_GRID_PRESSURE)),
          WRITES(P_MEAN_PRESSURE));
    STAGE(s, shared && !usf, mpm_share_pressures,
          READS(P_POS, P_VOLUME0, POINT_STATE, WHEN(s->cells == CELLS_SMEARED, P_GRID_PRESSURE)),
          WRITES(P_MEAN_PRESSURE));
    STAGE(s, apart, mpm_node_force,
          READS(P_POS, POINT_STATE, WHEN(shared, P_MEAN_PRESSURE), WHEN(s->cells == CELLS_SMEARED, P_GRID_PRESSURE),
                WHEN(s->carries[P_DRIVE], P_DRIVE)),
          WRITES(N_FORCE));
    STAGE(s, has_edges(s), mpm_edge_force, READS(N_MASS, WHEN(usf, N_VEL), P_POS, P_VOLUME0, P_J, DOMAINS, N_FORCE),
          WRITES(N_FILL, N_FORCE));
    STAGE(s, has_yielding_fluids(s) && walls_are_stiff(s), mpm_find_stiffness,
          READS(N_MASS, N_MOMENTUM, N_FORCE, P_MASS, P_VOLUME0, P_POS, DOMAINS, POINT_STATE, EXPANDING),
          WRITES(NOTHING));
    /* An implicit pressure's search moves the faces of the cells (theory 7.8). */
    STAGE(s, has_yielding_fluids(s), mpm_find_wall_pressures,
          READS(N_MASS, N_MOMENTUM, N_FORCE, WHEN(searches, F_VEL), WHEN(searches, F_MOBILITY),
                WHEN(searches, C_PRESSURE_STEP), WHEN(searches, C_PRESSURE_ADVANCED), WHEN(several, C_LIMITER),
                WHEN(several, F_THETA), WHEN(several, F_FLUX)),
          WRITES(N_FORCE, N_VEL_L, WHEN(searches, F_VEL), WHEN(searches, C_PRESSURE_STEP),
                 WHEN(searches, C_PRESSURE_ADVANCED), WHEN(several, C_LIMITER), WHEN(several, F_THETA),
                 WHEN(several, F_FLUX)));
    STAGE(s, ALWAYS, mpm_node_update, READS(N_MASS, N_MOMENTUM, N_FORCE, WHEN(walls_let_go(s), N_SIDE_BODY)),
          WRITES(WHEN(walls_let_go(s), N_FORCE), N_VEL_L));
    return FLOE_OK;
}

/* Whether some membrane has its strain from the positions of its points. */
static bool has_strain_by_positions(const mpm *s)
{
    for (int b = 0; s->curve && b < s->n_bodies; ++b)
        if (s->body[b].membrane.model && s->scene->body[s->body[b].scene_body].membrane.strain == STRAIN_BY_POSITIONS)
            return true;
    return false;
}

static floe_status turn_stages(mpm *s)
{
    const bool by_positions = has_strain_by_positions(s);
    STAGE(s, s->curve, mpm_turn_membranes,
          READS(P_ID, P_POS, P_VOLUME0, WHEN(s->normals, P_NORMAL), TANGENT, P_STRESS, P_J, MEMBRANE_STRAIN,
                SURFACE_VECTORS),
          WRITES(TANGENT, P_STRESS, P_J, SURFACE_VECTORS, WHEN(by_positions, P_POS), WHEN(by_positions, P_STRAIN)));
    return FLOE_OK;
}

floe_status mpm_node_stages(mpm *s)
{
    STAGE(s, has_motions(s) && s->cells == CELLS_SMEARED, mpm_take_impulses, READS(N_MASS, N_VEL_L), WRITES(N_VEL_L));
    STAGE(s, has_contact(s), mpm_contact_velocity,
          READS(N_MASS, N_MOMENTUM, N_NORMAL, WHEN(meets_at_points(s), N_REACH), N_VEL_L),
          WRITES(N_VEL_L, N_MOMENTUM, N_TOUCH));
    STAGE(s, has_wetted(s), mpm_constrain_wetted, READS(N_MASS, N_MOMENTUM, N_FORCE, N_WETTED_AREA, N_VEL_L),
          WRITES(N_VEL_L, N_MOMENTUM));
    STAGE(s, has_motions(s) && has_wetted(s), mpm_take_impulses, READS(N_MASS, N_VEL_L), WRITES(N_VEL_L));
    STAGE(s, has_motions(s), mpm_join_motions, READS(N_MASS, N_MOMENTUM, N_VEL_L, WHEN(has_contact(s), N_TOUCH)),
          WRITES(N_VEL_L));
    STAGE(s, ALWAYS, mpm_node_acceleration, READS(N_MASS, N_MOMENTUM, N_VEL_L), WRITES(N_ACCEL, N_VEL_L));
    return FLOE_OK;
}

floe_status mpm_point_stages(mpm *s)
{
    const bool usl = is_usl(s) && !s->cell_mass; /* stress in the pass that moves the points */
    const bool nodes = group_gives_heat(s, -1);
    STAGE(s, spares_light_nodes(s), mpm_spare_light_nodes,
          READS(N_MASS, N_VEL_L, N_ACCEL, WHEN(has_contact(s), N_NORMAL), WHEN(has_contact(s), N_TOUCH), P_MASS, P_POS),
          WRITES(N_FILL, N_RESIDUAL, N_MOMENTUM, N_VEL_L, N_ACCEL));
    STAGE(s, s->transfer->filter, mpm_filter_velocities, READS(N_MASS, N_MOMENTUM, P_MASS, P_POS, P_VEL),
          WRITES(N_MASS, N_MOMENTUM, N_VEL, N_VEL_FILTERED, P_POS, P_VEL));
    STAGE(s, s->transfer->restore, mpm_restore_velocities,
          READS(N_MASS, N_VEL_L, N_MOMENTUM, WHEN(has_contact(s), N_NORMAL), WHEN(has_contact(s), N_TOUCH), P_MASS,
                P_POS, DOMAINS),
          WRITES(N_RESIDUAL, N_MOMENTUM, N_VEL_L));
    STAGE(s, walls_let_go(s), mpm_follow_overlaps, READS(N_MASS, N_VEL_L, N_SIDE_REACH, N_SIDE_BODY), WRITES(NOTHING));
    STAGE(s, usl, mpm_nodes_to_points,
          READS(N_MASS, N_VEL_L, N_ACCEL, P_POS, P_VEL, WHEN(s->carries[P_DRIVE], P_DRIVE), TANGENT, POINT_STATE,
                EXPANDING),
          WRITES(P_POS, P_VEL, WHEN(carries_gradient(s), P_AFFINE), VOLUME_RATE, POINT_STATE, DISSIPATED));
    STAGE(s, !usl, mpm_nodes_to_points,
          READS(N_MASS, N_VEL_L, N_ACCEL, P_POS, P_VEL, WHEN(s->carries[P_DRIVE], P_DRIVE)),
          WRITES(P_POS, P_VEL, WHEN(carries_gradient(s), P_AFFINE)));
    STAGE(s, advects_points(s) && !carries_gradient(s), mpm_carry_moments, READS(N_VEL_L, P_POS), WRITES(P_AFFINE));
    STAGE(s, s->cell_mass && !is_usf(s), mpm_cell_density, READS(P_MASS, P_POS), WRITES(P_DENSITY));
    STAGE(s, is_usl(s) && !usl, mpm_stress_last, READS(N_VEL_L, P_POS, P_DENSITY, TANGENT, POINT_STATE, EXPANDING),
          WRITES(VOLUME_RATE, POINT_STATE, DISSIPATED));
    STAGE(s, is_musl(s), mpm_remap_stress,
          READS(P_POS, P_VEL, WHEN(advects_points(s), P_AFFINE), WHEN(has_contact(s), N_NORMAL),
                WHEN(has_contact(s), N_TOUCH), TANGENT, POINT_STATE, EXPANDING, WHEN(s->cell_mass, P_DENSITY)),
          WRITES(N_MASS, N_MOMENTUM, N_VEL, VOLUME_RATE, POINT_STATE, DISSIPATED));
    STAGE(s, has_temperature(s), mpm_heat_to_points,
          READS(WHEN(nodes, N_CAPACITY), WHEN(nodes, N_HEAT), WHEN(nodes, N_TEMP), WHEN(nodes, N_TEMP_CHANGE), P_POS,
                P_TEMP, DOMAINS, DISSIPATED),
          WRITES(WHEN(nodes, N_TEMP), WHEN(nodes, N_TEMP_CHANGE), P_TEMP, WHEN(conducts(s), P_TEMP_GRADIENT)));
    STAGE(s, advects_points(s), mpm_stretch_gradients, READS(P_AFFINE, P_POS, P_MASS, P_VOLUME0, DOMAINS, N_MASS),
          WRITES(P_AFFINE));
    STAGE(s, s->normals, mpm_membrane_normals, READS(P_ID, P_POS, P_NORMAL), WRITES(P_NORMAL));
    TRY(turn_stages(s));
    STAGE(s, losses_are_heat(s), mpm_give_heat,
          READS(P_MASS, P_POS, P_VEL, DOMAINS, N_MASS, N_VEL_L, N_ACCEL, P_ENERGY),
          WRITES(N_LOSS, N_DRY_MASS, P_ENERGY));
    STAGE(s, fluids_keep_losses(s), mpm_keep_losses,
          READS(P_MASS, P_POS, P_VEL, DOMAINS, N_MASS, N_VEL_L, N_ACCEL, P_ENERGY), WRITES(N_LOSS, P_ENERGY));
    STAGE(s, settles_volumes(s), mpm_settle_volumes, READS(P_POS, P_VEL, P_VOLUME0, P_MASS, P_J, P_ENERGY, DOMAINS),
          WRITES(N_FILL, P_J, P_ENERGY));
    return FLOE_OK;
}

floe_status mpm_motion_stages(mpm *s)
{
    TRY(mpm_node_stages(s));
    return mpm_point_stages(s);
}

/* A step that is solved for. */
static floe_status implicit_stages(mpm *s)
{
    if (s->curve) {
        STAGE(s, ALWAYS, mpm_membrane_equilibrium, READS(P_ID, P_MASS, P_VOLUME0, P_POS, P_VEL, TANGENT, POINT_STATE),
              WRITES(P_POS, P_VEL, POINT_STATE));
        return turn_stages(s);
    }
    TRY(follow_supports(s));
    STAGE(s, s->carries[P_DRIVE], mpm_drive_points, READS(WHEN(s->carries[P_REST], P_REST), P_POS, P_J),
          WRITES(P_DRIVE));
    TRY(free_point_stage(s));
    STAGE(s, ALWAYS, mpm_implicit_masses, READS(P_ID, P_MASS, P_POS, P_VEL, DOMAINS), WRITES(N_MASS, N_MOMENTUM));
    STAGE(s, has_contact(s), mpm_contact_normals, READS(N_MASS, P_POS, P_VOLUME0, DOMAINS), WRITES(N_COLOUR, N_NORMAL));
    STAGE(s, meets_at_points(s), mpm_contact_reach, READS(N_MASS, N_NORMAL, P_POS, P_VOLUME0, P_J, DOMAINS),
          WRITES(N_REACH, N_NORMAL, WHEN(s->mesh->dim > 1, N_REACH_FIRST), WHEN(s->mesh->dim > 1, N_REACH_SECOND),
                 WHEN(s->mesh->dim > 1, N_ASIDE)));
    STAGE(s, ALWAYS, mpm_implicit_loads, READS(N_MASS), WRITES(N_FORCE));
    STAGE(s, ALWAYS, mpm_implicit_solve,
          READS(N_MASS, N_MOMENTUM, WHEN(has_contact(s), N_NORMAL), WHEN(meets_at_points(s), N_REACH), P_MASS,
                P_VOLUME0, P_POS, P_VEL, DOMAINS, WHEN(s->carries[P_DRIVE], P_DRIVE), POINT_STATE, EXPANDING),
          WRITES(N_FORCE, P_POS, P_VEL, POINT_STATE, WHEN(s->carries[P_STRESS_FREE], P_TEMP),
                 WHEN(has_edges(s), N_FILL)));
    return FLOE_OK;
}

floe_status mpm_step(mpm *s)
{
    if (mpm_is_solved(s)) return implicit_stages(s);
    TRY(mpm_begin_step(s));
    TRY(mpm_mass_stages(s));
    TRY(mpm_conduction_stages(s));
    TRY(mpm_force_stages(s));
    return mpm_motion_stages(s);
}
