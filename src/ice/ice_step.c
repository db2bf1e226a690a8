/* The step of the fluids, in the order of theory 5.1 (Guilkey et al. 2003, section 2.4, steps 2 to 12): four groups
 * of stages, between which the coupled step puts those of the points. */
#include "ice/equilibrium/ice_equilibrium.h"
#include "ice/exchange/ice_exchange.h"
#include "ice/flux/ice_flux.h"
#include "ice/fraction/ice_fraction.h"
#include "ice/implicit/ice_implicit.h"
#include "ice/inject/ice_inject.h"
#include "ice/points/ice_points.h"
#include "ice/pressure/ice_pressure.h"
#include "ice/source/ice_source.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_traced.h"

/* A stage is that of one region after the other. */
#define OF_REGIONS(stage)                                                         \
    floe_status stage(ice *s)                                                     \
    {                                                                             \
        for (int g = 0; g < s->n_regions; ++g) TRY(stage##_of(s, &s->region[g])); \
        return FLOE_OK;                                                           \
    }
OF_REGIONS(ice_equilibrium_pressure)
OF_REGIONS(ice_find_interfaces)
OF_REGIONS(ice_continue_pressure)
OF_REGIONS(ice_wall_fraction)
OF_REGIONS(ice_diffusion_rates)
OF_REGIONS(ice_react)
OF_REGIONS(ice_face_velocity)
OF_REGIONS(ice_implicit_pressure)
OF_REGIONS(ice_pressure_increment)
OF_REGIONS(ice_face_pressure)
OF_REGIONS(ice_sources)
OF_REGIONS(ice_mass_exchange)
OF_REGIONS(ice_exchange)
OF_REGIONS(ice_specific_volume)
OF_REGIONS(ice_advect)

floe_status ice_state_stages(ice *s)
{
    const bool m = ice_is_mixture(s), p = s->with_points, d = ice_diffuses(s), k = ice_conducts(s);
    const bool reconciled = m && ice_follows_isentropes(s, &s->region[0]), slips = m && ice_some_pair_slips(s);
    STAGE(s, ALWAYS, ice_boundary_ghosts,
          READS(C_RHO, C_VEL, C_ENERGY, WHEN(m, C_VOL), WHEN(p, C_TEMP), WHEN(p, C_STRESS_ACCEL), C_PRESSURE),
          WRITES(C_RHO, C_VEL, C_ENERGY, WHEN(m, C_VOL), WHEN(p, C_TEMP), WHEN(p, C_STRESS_ACCEL), C_PRESSURE));
    STAGE(s, ALWAYS, ice_equilibrium_pressure,
          READS(C_RHO, C_VEL, C_ENERGY, WHEN(m, C_VOL), WHEN(m, C_TEMP), C_PRESSURE),
          WRITES(C_PRESSURE, C_SOUND, WHEN(m, C_VEL), WHEN(m, C_ENERGY), WHEN(m, C_VOL), WHEN(m, C_TEMP),
                 WHEN(m, C_THETA), WHEN(m, C_KAPPA), WHEN(m, C_KAPPA_SUM), WHEN(m, C_RHO_SUM), WHEN(m, C_VEL_MEAN),
                 WHEN(m, C_MIXED), WHEN(p, C_TMV_RATIO), WHEN(reconciled, C_ENERGY_FOUND),
                 WHEN(reconciled, C_VOLUME_FOUND)));
    STAGE(s, ice_has_interfaces(s, &s->region[0]), ice_find_interfaces, READS(C_THETA, C_MIXED), WRITES(C_INTERFACE));
    STAGE(s, p, ice_continue_pressure, READS(C_PRESSURE, C_THETA, C_MIXED), WRITES(C_PRESSURE, C_DP));
    STAGE(s, slips, ice_wall_fraction, READS(C_THETA), WRITES(C_WALL));
    STAGE(s, d, ice_diffusion_rates, READS(C_RHO, C_VEL, C_ENERGY, WHEN(m, C_TEMP), WHEN(m, C_THETA)),
          WRITES(C_DIFFUSION, C_DIFFUSION_HEAT, WHEN(k, C_DIFFUSION_T)));
    STAGE(s, ice_reaction_count(s) > 0, ice_react, READS(C_RHO, C_ENERGY, C_VOL, C_TEMP, C_THETA, C_PRESSURE),
          WRITES(C_REACTED));
    return FLOE_OK;
}

floe_status ice_pressure_stages(ice *s)
{
    const bool m = ice_is_mixture(s), p = s->with_points, d = ice_diffuses(s), k = ice_conducts(s),
               t = ice_may_trace(s), part = t && ice_traces_in_part(s);
    const bool plan = s->stages->planning;
    const pressure_scheme scheme = s->scene->method.pressure;
    const bool implicit = plan ? scheme != PRESSURE_EXPLICIT : s->implicit,
               direct = plan ? scheme != PRESSURE_IMPLICIT : !s->implicit;
    const bool named = m && ice_some_pair_asks(s), slips = m && ice_some_pair_slips(s), r = ice_reaction_count(s) > 0,
               f = ice_has_interfaces(s, &s->region[0]);
    STAGE(s, ALWAYS, ice_face_velocity,
          READS(C_RHO, C_VEL, C_PRESSURE, C_SOUND, WHEN(m, C_THETA), WHEN(m, C_VEL_MEAN), WHEN(m, C_RHO_SUM),
                WHEN(m, C_KAPPA_SUM), WHEN(m, C_MIXED), WHEN(d, C_DIFFUSION), WHEN(named, C_VOL), WHEN(slips, C_WALL),
                WHEN(p, C_STRESS_ACCEL), WHEN(t, C_ENERGY), WHEN(m && t, C_VOL), WHEN(m && t, C_KAPPA),
                WHEN(t && f, C_INTERFACE), WHEN(t && d, C_DIFFUSION_HEAT)),
          WRITES(F_VEL, C_SHOCK, WHEN(ice_sharpens_contacts(s), C_CONTACT), WHEN(t, C_SLOW_SHOCK), WHEN(part, C_ALONE),
                 WHEN(t, F_PRESSURE), WHEN(t, F_DONOR_DENSITY), WHEN(t, F_DONOR_ENERGY), WHEN(t, F_DONOR_VEL),
                 WHEN(t, C_PRESSURE), WHEN(t && d, C_DIFFUSION_HEAT), WHEN(t && d, C_PRESSURE_ADVANCED)));
    STAGE(s, implicit, ice_implicit_pressure,
          READS(F_VEL, C_RHO, C_VEL, C_PRESSURE, C_SOUND, C_SHOCK, C_PRESSURE_STEP, WHEN(m, C_THETA),
                WHEN(m, C_VEL_MEAN), WHEN(m, C_RHO_SUM), WHEN(m, C_KAPPA_SUM), WHEN(m, C_MIXED), WHEN(p, C_TMV_RATIO),
                WHEN(d, C_DIFFUSION_HEAT), WHEN(d || ice_some_load_heats(s), C_ENERGY), WHEN(m, C_VOL),
                WHEN(slips, C_WALL), WHEN(r, C_REACTED), WHEN(f, C_INTERFACE)),
          WRITES(F_VEL, F_MOBILITY, C_PRESSURE_STEP, C_DP, C_PRESSURE_ADVANCED, WHEN(m, C_LIMITER), WHEN(m, F_THETA),
                 WHEN(m, F_FLUX)));
    STAGE(s, direct, ice_pressure_increment,
          READS(F_VEL, C_RHO, C_VEL, C_PRESSURE, C_SOUND, C_SHOCK, WHEN(m, C_THETA), WHEN(m, C_VEL_MEAN),
                WHEN(m, C_RHO_SUM), WHEN(m, C_KAPPA_SUM), WHEN(m, C_MIXED), WHEN(p, C_TMV_RATIO),
                WHEN(d, C_DIFFUSION_HEAT), WHEN(d, C_ENERGY), WHEN(m, C_VOL), WHEN(r, C_REACTED), WHEN(f, C_INTERFACE)),
          WRITES(C_DP, C_PRESSURE_ADVANCED, WHEN(m, C_LIMITER), WHEN(m, F_THETA), WHEN(m, F_FLUX)));
    STAGE(s, ALWAYS, ice_face_pressure,
          READS(C_PRESSURE_ADVANCED, C_RHO, WHEN(m, C_RHO_SUM), WHEN(t, F_PRESSURE), WHEN(part, C_ALONE)),
          WRITES(F_PRESSURE));
    STAGE(s, ALWAYS, ice_sources,
          READS(C_RHO, C_VEL, C_ENERGY, F_PRESSURE, F_VEL, C_DP, C_PRESSURE_ADVANCED, C_SOUND, C_PRESSURE,
                WHEN(m, F_FLUX), WHEN(m, C_THETA), WHEN(m, C_KAPPA), WHEN(m, C_KAPPA_SUM), WHEN(m, C_MIXED),
                WHEN(d, C_DIFFUSION), WHEN(d, C_DIFFUSION_HEAT), WHEN(d, C_SHOCK), WHEN(k, C_DIFFUSION_T),
                WHEN(m && d, C_VEL_MEAN)),
          WRITES(C_VEL_L, C_ENERGY_L, WHEN(m, C_HEAT_OWED), WHEN(p, C_SOURCE), WHEN(d, C_DIFFUSION),
                 WHEN(k, C_DIFFUSION_T)));
    return FLOE_OK;
}

floe_status ice_exchange_stages(ice *s)
{
    const bool m = ice_is_mixture(s), p = s->with_points, r = ice_reaction_count(s) > 0, b = ice_some_solid_burns(s),
               f = ice_has_interfaces(s, &s->region[0]);
    STAGE(s, r, ice_mass_exchange,
          READS(C_REACTED, C_RHO, C_VEL_L, C_ENERGY_L, WHEN(b, C_ENERGY), WHEN(b, C_BURNT_MOMENTUM),
                WHEN(b, C_BURNT_ENERGY), WHEN(b, C_SOURCE), WHEN(b, C_THETA), WHEN(b, C_KAPPA), WHEN(b, C_KAPPA_SUM),
                WHEN(b, C_VOL), WHEN(b, C_PRESSURE_ADVANCED)),
          WRITES(C_RHO_L, C_VEL_L, C_ENERGY_L, WHEN(b, C_SOURCE)));
    STAGE(s, m, ice_exchange,
          READS(C_RHO, C_THETA, C_VOL, C_VEL, C_HEAT_OWED, WHEN(ice_some_pair_slips(s), C_WALL), C_TEMP, C_ENERGY,
                C_MIXED, C_VEL_L, C_ENERGY_L, WHEN(p, C_TMV_RATIO), WHEN(p, C_SOURCE), WHEN(p, C_MOMENTUM_L),
                WHEN(r, C_RHO_L), WHEN(f, C_INTERFACE), WHEN(f, C_SHOCK), WHEN(f, C_KAPPA), WHEN(f, C_PRESSURE),
                WHEN(f, C_SOUND), WHEN(f, C_DP), WHEN(f, C_VEL_MEAN)),
          WRITES(C_VEL_L, C_ENERGY_L, C_HEAT_OWED, WHEN(p, C_VELOCITY_CHANGE), WHEN(s->heats_points, C_TEMP_CHANGE)));
    STAGE(s, m, ice_specific_volume,
          READS(C_RHO, C_VOL, C_THETA, C_KAPPA, C_KAPPA_SUM, C_DP, C_MIXED, WHEN(p, C_TMV_RATIO), WHEN(r, C_RHO_L),
                WHEN(r, C_REACTED)),
          WRITES(C_VOLUME_L, C_VOL));
    return FLOE_OK;
}

floe_status ice_advection_stages(ice *s)
{
    const bool m = ice_is_mixture(s), r = ice_reaction_count(s) > 0, f = ice_has_interfaces(s, &s->region[0]),
               t = ice_may_trace(s), part = t && ice_traces_in_part(s);
    STAGE(s, ALWAYS, ice_advect,
          READS(C_RHO, C_VEL, C_ENERGY, C_PRESSURE, F_VEL, F_PRESSURE, C_DP, C_SHOCK,
                WHEN(ice_sharpens_contacts(s), C_CONTACT), C_SOUND, C_VEL_L, C_ENERGY_L, WHEN(m, C_VOL),
                WHEN(m, C_VOLUME_L), WHEN(m, C_THETA), WHEN(m, C_KAPPA_SUM), WHEN(m, C_LIMITER), WHEN(m, C_TEMP),
                WHEN(r, C_RHO_L), WHEN(f, C_INTERFACE), WHEN(f, F_THETA), WHEN(t, F_DONOR_DENSITY),
                WHEN(t, F_DONOR_ENERGY), WHEN(t, F_DONOR_VEL), WHEN(part, C_ALONE)),
          WRITES(C_RHO, C_VEL, C_ENERGY, WHEN(m, C_VOL), C_VEL_L, C_ENERGY_L, WHEN(m, C_VOLUME_L), WHEN(r, C_RHO_L)));
    STAGE(s, ice_injects(s), ice_inject,
          READS(C_RHO, C_VEL, C_ENERGY, C_PRESSURE, WHEN(m, C_VOL), WHEN(m, C_KAPPA), WHEN(s->with_points, C_THETA)),
          WRITES(C_RHO, C_VEL, C_ENERGY, WHEN(m, C_VOL)));
    return FLOE_OK;
}

floe_status ice_step(ice *s)
{
    TRY(ice_state_stages(s));
    TRY(ice_pressure_stages(s));
    TRY(ice_exchange_stages(s));
    return ice_advection_stages(s);
}

void ice_rollback_step(ice *s)
{
    ice_rollback_closure(s);
    if (s->cut) s->cut->rollback(s);
}
