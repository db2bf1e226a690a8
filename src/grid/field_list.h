/* Every field that floe can hold, on one page. A scene registers only the ones that a stage of its plan names
 * (docs/structure.md, Fields), so a field that is not in the plan has no array.
 *
 * X(id, name, centring, components, unit, class, meaning)
 *
 * centring    POINT, NODE, CELL, FACE
 * components  how many arrays, by the scene's dimension d:
 *               SCALAR 1; VECTOR d; STRESS 3 (d=1: xx yy zz), 4 (d=2: xx yy zz xy), 6 (d=3); GRADIENT d*d (row-major, du_i/dx_j),
 *               DEFORM the deformation gradient: 3 (d=1: xx yy zz), 5 (d=2: xx xy yx yy zz), 9 (d=3); NORMAL 1 per axis of faces
 * class       STATE double-buffered, checkpointed; FIXED set when points are seeded, moves only with their order,
 *             checkpointed; SCRATCH rebuilt every step; DIAGNOSTIC written for output only
 * Per-body (points), per-group (nodes) and per-material (cells) fields have one instance each: field_get(b, id,
 * instance, comp). */
#ifndef GRID_FIELD_LIST_H
#define GRID_FIELD_LIST_H

#define FIELD_LIST(X)                                                                                                \
    /* material points, instance: body */                                                                            \
    X(P_ID, "id", POINT, SCALAR, "1", FIXED, "body << 40 | seeding ordinal, exact in a double's 53 bits")            \
    X(P_MASS, "mass", POINT, SCALAR, "kg", FIXED, "m_p")                                                             \
    X(P_VOLUME0, "initial_volume", POINT, SCALAR, "m3", FIXED, "V0_p")                                               \
    X(P_SHARE, "mass_share", POINT, SCALAR, "1", FIXED, "of the point's mass, that reactions have left")             \
    X(P_HALF, "half_width", POINT, VECTOR, "m", FIXED, "GIMP half width of the point's domain")                      \
    X(P_REST, "rest_position", POINT, VECTOR, "m", FIXED,                                                            \
      "X_p: where the point was seeded, if a manufactured force acts on it")                                         \
    X(P_STRESS_FREE, "stress_free_temperature", POINT, SCALAR, "K", FIXED,                                           \
      "T_0 of a solid that expands: without stress it has its shape at rest there")                                  \
    X(P_POS, "position", POINT, VECTOR, "m", STATE, "x_p")                                                           \
    X(P_VEL, "velocity", POINT, VECTOR, "m/s", STATE, "v_p at n-1/2 in pure MPM, n when coupled")                    \
    X(P_AFFINE, "affine_velocity", POINT, GRADIENT, "1/s", STATE,                                                    \
      "C_p: the point's velocity field is v_p + C_p (x - x_p)")                                                      \
    X(P_F, "deformation_gradient", POINT, DEFORM, "1", STATE, "F_p")                                                 \
    X(P_J, "volume_ratio", POINT, SCALAR, "1", STATE, "J_p = V/V0, for laws that need no F")                         \
    X(P_BOX, "box", POINT, VECTOR, "m", STATE, "GIMP half width of a fluid's domain, which swells with it")          \
    X(P_STRESS, "stress", POINT, STRESS, "Pa", STATE, "Cauchy, tension positive, gauge to the reference pressure")   \
    X(P_ENERGY, "internal_energy", POINT, SCALAR, "J/kg", STATE, "e_p")                                              \
    X(P_TANGENT, "tangent", POINT, VECTOR, "1", STATE, "t_p, unit, along the line of a membrane's points")           \
    X(P_NORMAL, "normal", POINT, VECTOR, "1", STATE, "n_p, unit, of a membrane without connections")                 \
    X(P_SURFACE_1, "surface_vector_1", POINT, VECTOR, "1", STATE,                                                    \
      "a_1 of a surface in space: a unit vector of it at rest, as it is now (sheet.h)")                              \
    X(P_SURFACE_2, "surface_vector_2", POINT, VECTOR, "1", STATE, "a_2: at rest unit, and normal to a_1 and n")      \
    X(P_STRAIN, "membrane_strain", POINT, SCALAR, "1", STATE, "logarithmic, along the tangent; negative: slack")     \
    X(P_STRAIN_HOOP, "membrane_strain_hoop", POINT, SCALAR, "1", STATE, "logarithmic, around the axis")              \
    X(P_VISCOUS_PRESSURE, "artificial_pressure", POINT, SCALAR, "Pa", STATE, "q_p, compression positive")            \
    X(P_HISTORY_1, "history_1", POINT, SCALAR, "1", STATE, "number 1 of those that the law remembers (solid.h)")     \
    X(P_HISTORY_2, "history_2", POINT, SCALAR, "1", STATE, "number 2 of those that the law remembers (solid.h)")     \
    X(P_HISTORY_3, "history_3", POINT, SCALAR, "1", STATE, "number 3 of those that the law remembers (solid.h)")     \
    X(P_HISTORY_4, "history_4", POINT, SCALAR, "1", STATE, "number 4 of those that the law remembers (solid.h)")     \
    X(P_HISTORY_5, "history_5", POINT, SCALAR, "1", STATE, "number 5 of those that the law remembers (solid.h)")     \
    X(P_HISTORY_6, "history_6", POINT, SCALAR, "1", STATE, "number 6 of those that the law remembers (solid.h)")     \
    X(P_HISTORY_7, "history_7", POINT, SCALAR, "1", STATE, "number 7 of those that the law remembers (solid.h)")     \
    X(P_HISTORY_8, "history_8", POINT, SCALAR, "1", STATE, "number 8 of those that the law remembers (solid.h)")     \
    X(P_HISTORY_9, "history_9", POINT, SCALAR, "1", STATE, "number 9 of those that the law remembers (solid.h)")     \
    X(P_HISTORY_10, "history_10", POINT, SCALAR, "1", STATE, "number 10 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_11, "history_11", POINT, SCALAR, "1", STATE, "number 11 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_12, "history_12", POINT, SCALAR, "1", STATE, "number 12 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_13, "history_13", POINT, SCALAR, "1", STATE, "number 13 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_14, "history_14", POINT, SCALAR, "1", STATE, "number 14 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_15, "history_15", POINT, SCALAR, "1", STATE, "number 15 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_16, "history_16", POINT, SCALAR, "1", STATE, "number 16 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_17, "history_17", POINT, SCALAR, "1", STATE, "number 17 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_18, "history_18", POINT, SCALAR, "1", STATE, "number 18 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_19, "history_19", POINT, SCALAR, "1", STATE, "number 19 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_20, "history_20", POINT, SCALAR, "1", STATE, "number 20 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_21, "history_21", POINT, SCALAR, "1", STATE, "number 21 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_22, "history_22", POINT, SCALAR, "1", STATE, "number 22 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_23, "history_23", POINT, SCALAR, "1", STATE, "number 23 of those that the law remembers (solid.h)")  \
    X(P_HISTORY_24, "history_24", POINT, SCALAR, "1", STATE, "number 24 of those that the law remembers (solid.h)")  \
    X(P_TEMP, "temperature", POINT, SCALAR, "K", STATE, "T_p of solids that have one (scene/solid_heat.h)")          \
    X(P_TEMP_GRADIENT, "temperature_gradient", POINT, VECTOR, "K/m", STATE,                                          \
      "grad T at the point, of solids that conduct heat")                                                            \
    X(P_THERMAL_STRETCH, "thermal_stretch", POINT, SCALAR, "1", STATE,                                               \
      "1 + alpha (T - T_0), of which the stress already knows")                                                      \
    X(P_DISSIPATED, "dissipated_heat", POINT, SCALAR, "J/kg", SCRATCH,                                               \
      "heat of plastic and artificial viscous work in the step, and of stress on thermal strain")                    \
    X(P_DRIVE, "manufactured_force", POINT, VECTOR, "m/s2", SCRATCH,                                                 \
      "b_p(X_p, t): force per mass that the exact solution needs")                                                   \
    X(P_MASS_LEFT, "mass_left", POINT, SCALAR, "kg", SCRATCH,                                                        \
      "m_p when reactions have taken what they do in the step")                                                      \
    X(P_FREE_MASS, "free_mass", POINT, SCALAR, "kg", SCRATCH, "m_p, but 0 of points that move with a support")       \
    X(P_DENSITY, "cell_density", POINT, SCALAR, "kg/m3", SCRATCH, "rho_p of a fluid from the masses of cells")       \
    X(P_GRID_PRESSURE, "grid_pressure", POINT, SCALAR, "Pa", SCRATCH, "p_p: cell pressure at the point less p_ref")  \
    X(P_MEAN_PRESSURE, "mean_pressure", POINT, SCALAR, "Pa", SCRATCH,                                                \
      "what points share of their pressures adds to their normal stresses, and p_p")                                 \
    X(P_VOLUME_RATE, "volume_rate", POINT, SCALAR, "1/s", SCRATCH, "what points share of their rates of volume")     \
    /* nodes, instance: velocity group */                                                                            \
    X(N_MASS, "node_mass", NODE, SCALAR, "kg", SCRATCH, "m_i")                                                       \
    X(N_MOMENTUM, "node_momentum", NODE, VECTOR, "kg m/s", SCRATCH, "m_i v_i")                                       \
    X(N_FORCE, "node_force", NODE, VECTOR, "N", SCRATCH, "f_i = internal + external")                                \
    X(N_VEL, "node_velocity", NODE, VECTOR, "m/s", SCRATCH, "v_i")                                                   \
    X(N_VEL_L, "node_velocity_lagrangian", NODE, VECTOR, "m/s", SCRATCH, "v_i^L")                                    \
    X(N_RESIDUAL, "node_velocity_residual", NODE, VECTOR, "m/s", SCRATCH, "what points do not give back of v_i")     \
    X(N_VEL_FILTERED, "node_velocity_filtered", NODE, VECTOR, "m/s", SCRATCH, "what XPIC keeps of v_i")              \
    X(N_ACCEL, "node_acceleration", NODE, VECTOR, "m/s2", SCRATCH,                                                   \
      "a_i = (v_i^L - v_i) / dt after boundary conditions")                                                          \
    X(N_LOSS, "node_loss", NODE, SCALAR, "J", SCRATCH,                                                               \
      "kinetic energy lost about the node, then J/kg of fluid points")                                               \
    X(N_DRY_MASS, "node_dry_mass", NODE, SCALAR, "kg", SCRATCH, "mass of points that are no fluid")                  \
    X(N_FILL, "node_fill", NODE, SCALAR, "m3", SCRATCH,                                                              \
      "volume of solid points about the node (mpm/edge/edge.h), then free volume beside them (mpm/fluid/settle.c)")  \
    X(N_COLOUR, "node_colour", NODE, SCALAR, "m3", SCRATCH, "phi_i = sum of V0_p times a smoothing kernel")          \
    X(N_NORMAL, "node_normal", NODE, VECTOR, "1/m", SCRATCH,                                                         \
      "-grad phi/phi: towards the outside of a body, of no unit length")                                             \
    X(N_REACH, "node_reach", NODE, SCALAR, "m", SCRATCH,                                                             \
      "how far a body's points reach from the node along its normal there")                                          \
    X(N_REACH_FIRST, "node_reach_first", NODE, SCALAR, "m", SCRATCH,                                                 \
      "the same along the normal of the first body there")                                                           \
    X(N_REACH_SECOND, "node_reach_second", NODE, SCALAR, "m", SCRATCH, "the same along that of the second")          \
    X(N_ASIDE, "node_aside", NODE, SCALAR, "m", SCRATCH,                                                             \
      "how far the nearest of a body's points lies aside of its normal, beyond its own size; negative")              \
    X(N_TOUCH, "node_touch", NODE, SCALAR, "1", SCRATCH,                                                             \
      "bits of the groups that it moves with (from 0 on) and slides on (from 16 on)")                                \
    X(N_WETTED_AREA, "node_wetted_area", NODE, VECTOR, "m2", SCRATCH,                                                \
      "of fluid points: sum of V_p grad S_ip, the integral of S_i n over their surface")                             \
    X(N_SIDE_REACH, "node_side_reach", NODE, VECTOR, "m", SCRATCH,                                                   \
      "how far a group's points reach beyond the side that the node is on, by axis")                                 \
    X(N_SIDE_BODY, "node_side_body", NODE, SCALAR, "1", SCRATCH,                                                     \
      "minus the rank by speed of sound of the slowest solid about the node of a side")                              \
    X(N_PRESSURE, "node_pressure", NODE, SCALAR, "Pa", SCRATCH, "P - p_ref averaged from the cells about a node")    \
    X(N_BURNT_SHARE, "node_burnt_share", NODE, SCALAR, "1", SCRATCH,                                                 \
      "of the mass about the node, that reactions take in the step")                                                 \
    X(N_BURNT, "node_burnt", NODE, SCALAR, "kg", SCRATCH,                                                            \
      "mass that points about the node lose to reactions in the step")                                               \
    X(N_BURNT_MOMENTUM, "node_burnt_momentum", NODE, VECTOR, "kg m/s", SCRATCH, "momentum that goes with it")        \
    X(N_BURNT_ENERGY, "node_burnt_energy", NODE, SCALAR, "J", SCRATCH, "kinetic and strain energy that go with it")  \
    X(N_CAPACITY, "node_heat_capacity", NODE, SCALAR, "J/K", SCRATCH, "C_i = sum of S_ip m_p c")                     \
    X(N_HEAT, "node_heat", NODE, SCALAR, "J", SCRATCH, "C_i T_i = sum of S_ip m_p c (T_p + grad T_p (x_i - x_p))")   \
    X(N_HEAT_GRADIENT, "node_heat_gradient", NODE, VECTOR, "J/m", SCRATCH, "sum of S_ip m_p c grad T_p")             \
    X(N_TEMP, "node_temperature", NODE, SCALAR, "K", SCRATCH, "T_i, at the end of the step once points take it")     \
    X(N_TEMP_CHANGE, "node_temperature_change", NODE, SCALAR, "K", SCRATCH, "dT_i of the step")                      \
    /* cells, instance: material */                                                                                  \
    X(C_RHO, "density", CELL, SCALAR, "kg/m3", STATE, "rho^r: mass of material r per cell volume")                   \
    X(C_VEL, "velocity", CELL, VECTOR, "m/s", STATE, "u^r")                                                          \
    X(C_ENERGY, "internal_energy", CELL, SCALAR, "J/kg", STATE, "e^r")                                               \
    X(C_VOL, "specific_volume", CELL, SCALAR, "m3/kg", STATE, "v^r of the pure material; absent with one fluid")     \
    X(C_OPEN, "open_fraction", CELL, SCALAR, "1", STATE,                                                             \
      "share of the cell that a membrane leaves to gas r; density is then per open volume")                          \
    X(C_TEMP, "temperature", CELL, SCALAR, "K", SCRATCH, "T^r")                                                      \
    X(C_THETA, "volume_fraction", CELL, SCALAR, "1", SCRATCH, "theta^r = m^r v^r / TMV")                             \
    X(C_SOUND, "sound_speed", CELL, SCALAR, "m/s", SCRATCH, "c^r")                                                   \
    X(C_KAPPA, "compressibility", CELL, SCALAR, "1/Pa", SCRATCH, "kappa^r = v^r / c^r^2")                            \
    X(C_VEL_L, "velocity_lagrangian", CELL, VECTOR, "m/s", SCRATCH, "u^r,L of fluids")                               \
    X(C_ENERGY_L, "energy_lagrangian", CELL, SCALAR, "J/kg", SCRATCH, "e^r,L of fluids")                             \
    X(C_VOLUME_L, "specific_volume_lagrangian", CELL, SCALAR, "m3/kg", SCRATCH, "v^r,L of fluids")                   \
    X(C_ENERGY_FOUND, "internal_energy_found", CELL, SCALAR, "J/kg", SCRATCH,                                        \
      "e^r of fluids before mixed cells are closed along isentropes: a rejected step goes back to it")               \
    X(C_VOLUME_FOUND, "specific_volume_found", CELL, SCALAR, "m3/kg", SCRATCH, "v^r of fluids likewise")             \
    X(C_DIFFUSION, "diffusion", CELL, VECTOR, "N/m3", SCRATCH,                                                       \
      "div tau of fluids; once the sources are formed, their velocity at half the step")                             \
    X(C_DIFFUSION_HEAT, "diffusion_heat", CELL, SCALAR, "W/m3", SCRATCH, "dissipation and conduction into fluids")   \
    X(C_DIFFUSION_T, "diffusion_temperature", CELL, SCALAR, "K", SCRATCH,                                            \
      "T of fluids that conduct; at half the step after the sources")                                                \
    X(C_VEL_CENTRED, "velocity_centred", CELL, VECTOR, "m/s", SCRATCH,                                               \
      "u^r of viscous fluids at the centres of cells, those that embedded boundaries cut and next to them included") \
    X(C_MOMENTUM_L, "momentum_lagrangian", CELL, VECTOR, "kg m/s", SCRATCH,                                          \
      "(m u)^r,L of materials carried by points")                                                                    \
    X(C_STRESS_ACCEL, "stress_acceleration", CELL, VECTOR, "m/s2", STATE,                                            \
      "of materials carried by points: what stress, supports and contact gave them in the last step")                \
    X(C_SOURCE, "momentum_source", CELL, VECTOR, "kg m/s", SCRATCH, "pressure-gradient impulse of step 8")           \
    X(C_VELOCITY_CHANGE, "velocity_change", CELL, VECTOR, "m/s", SCRATCH, "dv_c handed back to the nodes")           \
    X(C_TEMP_CHANGE, "temperature_change", CELL, SCALAR, "K", SCRATCH,                                               \
      "dT_c of materials carried by points, by heat exchange: handed back to the nodes")                             \
    /* cells, shared by all materials (instance 0) */                                                                \
    X(C_PRESSURE, "pressure", CELL, SCALAR, "Pa", STATE, "p equilibrium pressure; also the next Newton guess")       \
    X(C_PRESSURE_STEP, "pressure_step", CELL, SCALAR, "Pa", STATE,                                                   \
      "implicit: phi dP, also where the next search starts")                                                         \
    X(C_PRESSURE_ADVANCED, "pressure_advanced", CELL, SCALAR, "Pa", SCRATCH, "P = p + phi dP")                       \
    X(C_DP, "pressure_increment", CELL, SCALAR, "Pa", SCRATCH, "dP by dilatation over the full step")                \
    X(C_TMV_RATIO, "material_volume_ratio", CELL, SCALAR, "1", SCRATCH, "TMV / V")                                   \
    X(C_RHO_SUM, "density_sum", CELL, SCALAR, "kg/m3", SCRATCH, "sum of rho^r")                                      \
    X(C_KAPPA_SUM, "compressibility_sum", CELL, SCALAR, "1/Pa", SCRATCH, "S = sum theta^r kappa^r")                  \
    X(C_HEAT_OWED, "heat_owed", CELL, SCALAR, "J/m3", SCRATCH,                                                       \
      "of several fluids: what closes the energy of the pressure step beyond reversible work; after exchange, what " \
      "is left over")                                                                                                \
    X(C_SHOCK, "shock_sensor", CELL, SCALAR, "1", SCRATCH, "s: 0 smooth, 1 at a shock; phi = (1 + s) / 2")           \
    X(C_CONTACT, "contact_sensor", CELL, SCALAR, "1", SCRATCH, "of one fluid: 0 smooth, 1 across a contact")         \
    X(C_SLOW_SHOCK, "slow_shock", CELL, VECTOR, "1", SCRATCH, "by axis: 0, or 1 in a shock that stands on the mesh") \
    X(C_ALONE, "alone", CELL, SCALAR, "1", SCRATCH,                                                                  \
      "1 + number of the fluid that is alone, 1 + all fluids where several are, cells about it whole; else 0")       \
    X(C_VEL_MEAN, "mean_velocity", CELL, VECTOR, "m/s", SCRATCH, "sum of rho^r u^r over sum of rho^r")               \
    X(C_LIMITER, "fraction_limiter", CELL, SCALAR, "1", SCRATCH, "common factor on the gradients of all theta^r")    \
    X(C_INTERFACE, "interface", CELL, SCALAR, "1", SCRATCH, "1 at an interface between fluids, else 0")              \
    X(C_WALL, "wall_fraction", CELL, SCALAR, "1", SCRATCH,                                                           \
      "volume fraction of materials that others slip along, smoothed: its gradient is the normal")                   \
    X(C_REACTED, "reacted", CELL, SCALAR, "kg/m3", SCRATCH,                                                          \
      "mass per cell volume that a reaction turns over in the step; instance: reaction")                             \
    X(C_BURNT_MOMENTUM, "burnt_momentum", CELL, VECTOR, "kg/m2/s", SCRATCH,                                          \
      "of what points lose to the reaction, per cell volume")                                                        \
    X(C_BURNT_ENERGY, "burnt_energy", CELL, SCALAR, "J/m3", SCRATCH, "kinetic and strain energy likewise")           \
    X(C_RHO_L, "density_lagrangian", CELL, SCALAR, "kg/m3", SCRATCH, "rho^r,L after the mass exchange")              \
    X(C_MIXED, "mixed", CELL, SCALAR, "1", SCRATCH,                                                                  \
      "number of materials present, plus 64 where one is carried by points")                                         \
    /* faces, one array per axis; instance: material (F_VEL, F_FLUX) or 0 */                                         \
    X(F_VEL, "face_velocity", FACE, VECTOR, "m/s", SCRATCH, "u*^r: normal component on the lower face of each axis") \
    X(F_THETA, "face_volume_fraction", FACE, VECTOR, "1", SCRATCH, "theta^r,f averaged over the donor slab")         \
    X(F_MOBILITY, "face_mobility", FACE, VECTOR, "m3/kg", SCRATCH,                                                   \
      "implicit: velocity that a gradient of pressure gives a material, after exchange")                             \
    X(F_PRESSURE, "face_pressure", FACE, VECTOR, "Pa", SCRATCH, "P*")                                                \
    X(F_DONOR_DENSITY, "donor_density", FACE, VECTOR, "kg/m3", SCRATCH, "of what crosses the face")                  \
    X(F_DONOR_ENERGY, "donor_energy", FACE, VECTOR, "J/kg", SCRATCH, "internal energy of what crosses the face")     \
    X(F_DONOR_VEL, "donor_velocity", FACE, GRADIENT, "m/s", SCRATCH,                                                 \
      "of what crosses the face: the components for axis 0, then for axis 1")                                        \
    X(F_FLUX, "volume_flux", FACE, VECTOR, "m/s", SCRATCH, "sum of theta^r,f u*^r: volume per area and time")

#endif
