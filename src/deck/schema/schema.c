/* The deck from the top. Keys are read in the order of these tables: a key may rely on those before it. */
#include "deck/deck_internal.h"

#include <string.h>

static const choice unit_choices[] = {
    {"si", 0, "numbers are SI, or carry a unit"},
    {"none", 1, "a dimensionless scene: no number carries a unit"},
    {0},
};

static const choice geometry_choices[] = {
    {"cartesian", MESH_CARTESIAN, "x, y, z"},
    {"axisymmetric", MESH_AXISYMMETRIC, "r, z: 2-D about the axis r = 0"},
    {0},
};

static const key_spec domain_keys[] = {
    {"dim", KEY_WHOLE, WITHIN(1, 3), AT(scene, mesh.dim), .fallback = "2", .doc = "dimension of the scene"},
    {"geometry", KEY_CHOICE, AT(scene, mesh.geometry), .fallback = "cartesian", .choices = geometry_choices,
     .doc = "coordinates"},
    {"stress_state", KEY_SPECIAL, AT(scene, stress_state), .special = &special_stress_state,
     .otherwise = "uniaxial_strain in 1-D, plane_strain in 2-D, else full",
     .doc = "what holds out of the plane of the scene, for material points"},
    {"lower", KEY_VECTOR, "m", AT(scene, mesh.lower), .required = true, .doc = "lower corner of the domain"},
    {"upper", KEY_VECTOR, "m", AT(scene, mesh.upper), .required = true, .doc = "upper corner of the domain"},
    {"cell", KEY_SPREAD, "m", PARAM_POSITIVE, AT(scene, mesh.cell), .required = true,
     .doc = "spacing h of the mesh; the extent must be a whole multiple of it"},
    {"blocks", KEY_WHOLES, WITHIN(1, MESH_MAX_BLOCKS), AT(scene, mesh.blocks), .fallback = "1",
     .doc = "blocks that the mesh is cut into along each axis; results do not depend on it"},
    {"lattice_offset", KEY_SPREAD, NULL, WITHIN(-0.5, 0.5), AT(scene, lattice_offset), .fallback = "0",
     .doc = "where points of 'seeding: lattice' lie, in point spacings from the middle of their sub-cell: -0.5 puts "
            "them on its lower sides"},
    {"thickness", KEY_NUMBER, "m", PARAM_POSITIVE, AT(scene, thickness), .fallback = "1",
     .doc = "depth of a 2-D scene, for masses and energies in the outputs"},
};
static const key_table domain_table = TABLE(domain_keys);

static const key_spec ambient_keys[] = {
    {"material", KEY_MATERIAL, AT(scene, ambient_material), .required = true, .doc = "a fluid"},
    {"pressure", KEY_NUMBER, "Pa", AT(scene, ambient_pressure), .varies = VARIES_BY_PLACE, .required = true,
     .doc = "absolute pressure"},
    {"temperature", KEY_NUMBER, "K", PARAM_POSITIVE, AT(scene, ambient_temperature), .varies = VARIES_BY_PLACE,
     .required = true, .doc = "temperature"},
    {"velocity", KEY_VECTOR, "m/s", AT(scene, ambient_velocity), .varies = VARIES_BY_PLACE, .otherwise = "0",
     .doc = "at the start"},
    {"points", KEY_WHOLE, NULL, WITHIN(0, 16), AT(scene, ambient_points), .fallback = "2",
     .doc =
         "as mpm: material points along each axis of a cell; 0: it is left out, and reference_pressure stands for it"},
};
static const key_table ambient_table = TABLE(ambient_keys);

static const key_spec damping_keys[] = {
    {"rate", KEY_NUMBER, "1/s", PARAM_NONNEGATIVE, AT(scene_damping, rate), .fallback = "0",
     .doc = "c of the force -c m v on nodes of material points"},
    {"start", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(scene_damping, start), .fallback = "0", .doc = "damping begins"},
    {"end", KEY_NUMBER, "s", PARAM_POSITIVE, AT(scene_damping, end), .otherwise = "the end of the run",
     .doc = "damping ends"},
};
static const key_table damping_table = TABLE(damping_keys);

static const choice solver_choices[] = {
    {"dynamic", SOLVER_DYNAMIC, "explicit steps"},
    {"static", SOLVER_STATIC, "load increments, each solved for the balance of forces; solids, with gas at rest"},
    {"implicit", SOLVER_IMPLICIT, "steps that sound does not bind, by the trapezoidal rule; solids as points alone"},
    {"auto", SOLVER_AUTO, "static where the deck asks for a state of rest (stop) and all of it can be solved for"},
    {0},
};

static bool solves_steps(const scene *s, const void *time)
{
    (void)s;
    return ((const scene_time *)time)->solver != SOLVER_DYNAMIC;
}

static const key_spec time_keys[] = {
    {"solver", KEY_CHOICE, AT(scene_time, solver), .fallback = "dynamic", .choices = solver_choices,
     .doc = "how solids get from one time to the next"},
    {"increments", KEY_WHOLE, WITHIN(1, 1e6), AT(scene_time, increments), .fallback = "1", .applies = solves_steps,
     .belongs = "solvers static, implicit and auto",
     .doc = "equal parts of the run: load increments that the run is cut into, each cut further where it does not "
            "converge; a load without a ramp grows throughout the run; steps of the implicit solver, unless fixed_step "
            "or max_step say"},
    {"tolerance", KEY_NUMBER, NULL, WITHIN(1e-14, 1e-2), AT(scene_time, tolerance), .fallback = "1e-8",
     .applies = solves_steps, .belongs = "solvers static, implicit and auto",
     .doc = "what may be left of the forces on the nodes, as a share of them"},
    {"end", KEY_NUMBER, "s", PARAM_POSITIVE, AT(scene_time, end), .required = true,
     .doc = "time at which the run ends"},
    {"cfl", KEY_SPECIAL, .special = &special_cfl, .otherwise = "0.5",
     .doc = "fraction of the stability limit of each solver"},
    {"acoustic_cfl", KEY_NUMBER, NULL, WITHIN(0.1, 1e9), AT(scene_time, acoustic_cfl), .fallback = "1000",
     .doc = "with the implicit pressure: cells that sound may cross in a step, c dt (sum of h^-2)^1/2"},
    {"first_step", KEY_NUMBER, "s", PARAM_POSITIVE, AT(scene_time, first_step), .otherwise = "from the stability limit",
     .doc = "first time step"},
    {"max_step", KEY_NUMBER, "s", PARAM_POSITIVE, AT(scene_time, max_step), .otherwise = "no limit",
     .doc = "largest time step"},
    {"growth", KEY_NUMBER, NULL, WITHIN(1.0, 10.0), AT(scene_time, growth), .fallback = "1.1",
     .doc = "largest ratio of a step to the one before"},
    {"max_steps", KEY_WHOLE, NULL, WITHIN(0, 2e9), AT(scene_time, max_steps), .fallback = "0",
     .doc = "the run ends after that many steps; 0: no limit"},
    {"fixed_step", KEY_NUMBER, "s", PARAM_POSITIVE, AT(scene_time, fixed_step), .otherwise = "steps are adaptive",
     .doc = "every step has this size"},
    {"substeps", KEY_SPECIAL, WITHIN(1, SCENE_MAX_SUBSTEPS), AT(scene_time, substeps), .special = &special_substeps,
     .otherwise = "auto beside a sharp interface, else 1",
     .doc = "steps of the points in one of the cells, beside a sharp interface; auto: as many as their stable steps "
            "ask for"},
};
static const key_table time_table = TABLE(time_keys);

static const key_spec stop_keys[] = {
    {"kinetic_over_strain", KEY_NUMBER, NULL, PARAM_POSITIVE, AT(scene_rest, ratio), .fallback = "1e-6",
     .doc = "at rest: kinetic energy of the solids at most this fraction of their strain energy"},
    {"window", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(scene_rest, window),
     .otherwise = "five times what sound needs to cross the solids", .doc = "it must stay so throughout this time"},
    {"after", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(scene_rest, after), .fallback = "0",
     .doc = "not before this time, nor before all ramps of loads are over"},
};
static const key_table stop_table = TABLE(stop_keys);

static const choice contact_choices[] = {
    {"release", CONTACT_RELEASE, "one velocity where bodies approach, each its own where they part (Y97 A.1)"},
    {"stick", CONTACT_STICK, "one velocity wherever bodies meet, as without a contact"},
    {"friction", CONTACT_FRICTION, "no penetration along the normal, Coulomb friction across it"},
    {0},
};
static const choice criterion_choices[] = {
    {"pair", CONTACT_PAIR, "they approach by their velocities (Y97 eq. 9.7)"},
    {"mean", CONTACT_MEAN, "the first of them moves into the centre-of-mass field (Y97 eq. 9.8)"},
    {"both", CONTACT_BOTH, "they part if each moves out of that field along its own normal (Y97 eq. 9.9)"},
    {0},
};

static const choice touch_choices[] = {
    {"points", CONTACT_AT_POINTS, "where their points have met, each with half the width of its volume"},
    {"nodes", CONTACT_AT_NODES, "at any node that both reach (Y97): up to a cell apart and more"},
    {0},
};

static bool contact_has_normal(const scene *s, const void *contact)
{
    (void)s;
    return ((const scene_contact *)contact)->kind != CONTACT_STICK;
}
static bool contact_rubs(const scene *s, const void *contact)
{
    (void)s;
    return ((const scene_contact *)contact)->kind == CONTACT_FRICTION;
}

static const key_spec contact_keys[] = {
    {"between", KEY_SPECIAL, .special = &special_between, .otherwise = "all solid bodies",
     .doc = "bodies with velocities of their own; all others stick to what they meet, fluids to the first of the list "
            "that is there"},
    {"kind", KEY_CHOICE, AT(scene_contact, kind), .fallback = "release", .choices = contact_choices,
     .doc = "what bodies do where they meet"},
    {"criterion", KEY_CHOICE, AT(scene_contact, criterion), .fallback = "pair", .choices = criterion_choices,
     .applies = contact_has_normal, .belongs = "kinds release and friction", .doc = "when two bodies are in contact"},
    {"touch", KEY_CHOICE, AT(scene_contact, touch), .fallback = "points", .choices = touch_choices,
     .doc = "where two bodies can be in contact"},
    {"friction", KEY_NUMBER, NULL, PARAM_NONNEGATIVE, AT(scene_contact, friction), .fallback = "0",
     .applies = contact_rubs, .belongs = "kind friction", .doc = "coefficient mu"},
    {"normals", KEY_SPECIAL, AT(scene_contact, normals), .special = &special_normals, .otherwise = "cubic_spline",
     .doc = "how the normals of bodies on the grid are made"},
};
static const key_table contact_table = TABLE(contact_keys);

static const choice stress_choices[] = {
    {"usl", STRESS_USL, "stress updated last"},
    {"usf", STRESS_USF, "stress updated first"},
    {"musl", STRESS_MUSL, "stress updated last, from velocities mapped again"},
    {0},
};
static const choice density_choices[] = {
    {"continuity", DENSITY_CONTINUITY, "each point's own volume, by the divergence of velocity there"},
    {"cell", DENSITY_CELL, "mass of the cell's points over its volume; for fluids that fill their cells"},
    {"quadratic", DENSITY_QUADRATIC, "the same, of masses spread by a quadratic B-spline"},
    {0},
};
static const choice losses_choices[] = {
    {"drift", LOSSES_DRIFT, "nothing: the drift of energy shows it"},
    {"own", LOSSES_OWN,
     "heat of each fluid point that loses it (pure MPM, transfer flip, not with basis linear or cpdi); else nothing"},
    {"heat", LOSSES_HEAT, "heat of the fluid points about them, of what solids lose and damping takes too (pure MPM)"},
    {0},
};
static const choice centring_choices[] = {
    {"auto", ICE_CENTRING_AUTO, "half where smooth, full at shocks"},
    {"half", ICE_CENTRING_HALF, "second order in time"},
    {"full", ICE_CENTRING_FULL, "first order in time"},
    {0},
};
static const choice energy_choices[] = {
    {"internal", 0, "internal energy is advanced, as in the papers"},
    {"conserving", 1, "total energy is conserved to round-off"},
    {0},
};
static const choice pressure_choices[] = {
    {"explicit", PRESSURE_EXPLICIT, "steps are bound by sound"},
    {"implicit", PRESSURE_IMPLICIT, "steps are bound by the flow; first order in time for sound"},
    {"auto", PRESSURE_AUTO, "whichever is predicted to cost less, looked at again every 64 steps"},
    {0},
};
static const choice interface_choices[] = {
    {"auto", INTERFACE_AUTO, "sharp wherever it takes the scene, else smeared, which is warned of"},
    {"smeared", INTERFACE_SMEARED, "over the cells that they share, as in the papers"},
    {"sharp", INTERFACE_SHARP, "on the surface of the solid, which cuts the cells of the fluids"},
    {0},
};
static const choice limiter_choices[] = {
    {"default", ICE_LIMITER_DEFAULT,
     "parabolas in characteristic variables, traced to half the step, beside points and cut cells where a fluid is "
     "alone; elsewhere as van_leer"},
    {"van_leer", ICE_LIMITER_VAN_LEER, "second order, limited, as in the papers"},
    {"none", ICE_LIMITER_NONE, "second order, for smooth flow"},
    {"first_order", ICE_LIMITER_FIRST_ORDER, "upwind"},
    {0},
};

static bool transfer_is_flip(const scene *s, const void *method)
{
    (void)s;
    const char *transfer = ((const scene_method *)method)->transfer;
    return !transfer[0] || strcmp(transfer, "flip") == 0;
}
/* Or none is named: the default may be afmpm (scene_transfer), and where it is not the key is remarked on. */
static bool transfer_has_order(const scene *s, const void *method)
{
    (void)s;
    const char *transfer = ((const scene_method *)method)->transfer;
    return !transfer[0] || strcmp(transfer, "xpic") == 0 || strcmp(transfer, "afmpm") == 0;
}

static bool basis_is_cpdi(const scene *s, const void *method)
{
    (void)s;
    return strcmp(((const scene_method *)method)->basis, "cpdi") == 0;
}

static const key_spec method_keys[] = {
    {"preset", KEY_SPECIAL, .special = &special_preset, .otherwise = "none",
     .doc =
         "choices under one name, which other keys here may change; `method: NAME` is the same. g03: those of Guilkey "
         "et al. 2003, linear basis functions, stress from the velocities before the forces (usf), FLIP, internal "
         "energy, a smeared interface, one velocity for solids and fluids in a cell"},
    {"basis", KEY_SPECIAL, AT(scene_method, basis), .special = &special_basis, .otherwise = "quadratic",
     .doc = "basis functions of the material points"},
    {"domain_limit", KEY_NUMBER, NULL, WITHIN(0.25, 1.0), AT(scene_method, domain_limit), .fallback = "1",
     .applies = basis_is_cpdi, .belongs = "basis cpdi",
     .doc = "cells that the domain of a point may reach from it along an axis; what is stretched farther is squeezed"},
    {"stress", KEY_CHOICE, AT(scene_method, stress), .fallback = "usl", .choices = stress_choices,
     .doc = "when stresses of points are updated in a step"},
    {"transfer", KEY_SPECIAL, AT(scene_method, transfer), .special = &special_transfer,
     .otherwise = "`afmpm` where points are solids alone, in dynamic steps, unless elastic ones are damped to rest, or "
                  "answer an implicit pressure; else "
                  "and where `flip` is given `flip`",
     .doc = "what becomes of the velocities of points in a step"},
    {"flip", KEY_NUMBER, NULL, WITHIN(0.0, 1.0), AT(scene_method, flip),
     .otherwise = "0.99; with fluids on points more where they are slow: 1 less 0.6 for each cell that the fastest "
                  "point crosses in the step",
     .applies = transfer_is_flip, .belongs = "transfer flip",
     .doc = "share of FLIP in the velocity update of points; the rest is PIC"},
    {"filter_order", KEY_WHOLE, NULL, WITHIN(2, 20), AT(scene_method, filter_order),
     .otherwise = "2; of afmpm beside cells 2, else 4, with linear and gimp alike, else with shares of their own",
     .applies = transfer_has_order, .belongs = "transfer xpic or afmpm",
     .doc = "order: passes between points and nodes of which the filter is made"},
    {"point_density", KEY_CHOICE, AT(scene_method, density), .fallback = "continuity", .choices = density_choices,
     .doc = "density of material points of fluids"},
    {"losses", KEY_CHOICE, AT(scene_method, losses), .fallback = "own", .choices = losses_choices,
     .doc = "what becomes of the kinetic energy that points lose to their nodes, and damping takes"},
    {"edge_penalty", KEY_NUMBER, NULL, WITHIN(0.0, 1.0), AT(scene_method, edge_penalty),
     .otherwise = "the basis's own: quadratic 0.005, cubic 0.001, gimp 0.0005, others 0; 0 where a solid burns",
     .doc = "penalty on bends of the motion that the basis does not have, at nodes that solids fill in part"},
    {"centring", KEY_CHOICE, AT(scene_method, centring), .fallback = "auto", .choices = centring_choices,
     .doc = "time centring of the ICE pressure"},
    {"energy", KEY_CHOICE, AT(scene_method, conserve_energy), .fallback = "conserving", .choices = energy_choices,
     .doc = "energy that ICE advances"},
    {"limiter", KEY_CHOICE, AT(scene_method, limiter), .fallback = "default", .choices = limiter_choices,
     .doc = "advection of ICE"},
    {"exchange", KEY_SPECIAL, "kg m-3 s-1", WITHIN(0.0, 1e20), AT(scene_method, exchange), .special = &special_exchange,
     .otherwise = "`locked`, but liquids without viscosity slip along solids",
     .doc = "K of the momentum exchange between each pair of materials that `exchange` does not name; locked: one "
            "velocity, in every direction"},
    {"heat_exchange", KEY_NUMBER, "W m-3 K-1", WITHIN(0.0, 1e30), AT(scene_method, heat_exchange), .fallback = "0",
     .doc = "R of the heat exchange between each pair of materials that `exchange` does not name"},
    {"volume_relaxation", KEY_NUMBER, NULL, WITHIN(0.0, 1.0), AT(scene_method, volume_relaxation), .fallback = "0",
     .doc = "share of the volume defect of a cell that is taken back each step"},
    {"interface", KEY_CHOICE, AT(scene_method, interface), .fallback = "auto", .choices = interface_choices,
     .doc = "where solids and gas of the cells push each other in ice-mpm"},
    {"pressure", KEY_CHOICE, AT(scene_method, pressure), .fallback = "explicit", .choices = pressure_choices,
     .doc = "how the pressure of ICE is advanced"},
    {"pressure_tolerance", KEY_NUMBER, NULL, WITHIN(1e-15, 1e-2), AT(scene_method, pressure_tolerance),
     .fallback = "1e-10",
     .doc = "of the implicit pressure: largest error of the volume of what is in a cell, as a fraction of the cell"},
};
static const key_table method_table = TABLE(method_keys);

static const key_spec output_keys[] = {
    {"interval", KEY_NUMBER, "s", PARAM_POSITIVE, AT(scene, output.interval), .otherwise = "first and last only",
     .doc = "time between field snapshots"},
    {"history_interval", KEY_NUMBER, "s", PARAM_POSITIVE, AT(scene, output.history_interval),
     .otherwise = "interval / 50", .doc = "time between rows of history.csv"},
    {"checkpoint_interval", KEY_SPECIAL, "s", PARAM_POSITIVE, AT(scene, output.checkpoint_interval),
     .special = &special_checkpoint_interval, .fallback = "auto",
     .doc =
         "wall time between checkpoints. `auto`: one at every snapshot and every 2 minutes of wall time, for at most 2 "
         "% of it; "
         "`off`: none on the way. One is written at the end, on a signal and when an output fails, whatever this says"},
    {"probes", KEY_NAMED, AT(scene, probe), .items = &items_probes, .doc = "places whose state goes into history.csv"},
    {"tracers", KEY_NAMED, AT(scene, tracer), .items = &items_tracers,
     .doc = "places of bodies of points, which move with them: their displacement, velocity and stress go into "
            "history.csv"},
};
static const key_table output_table = TABLE(output_keys);

static const key_spec verify_keys[] = {
    {"sources", KEY_BOOL, AT(scene_verify, sources), .fallback = "false",
     .doc = "true: the force and heat that the exact solution needs act on fluids on the cells or, of a solid, on its "
            "points"},
    {"exact", KEY_MODEL, .family = &family_exact, .otherwise = "none; metrics of fields need it",
     .doc = "exact solution that fields are compared with"},
    {"reference", KEY_MODEL, .family = &family_reference, .otherwise = "none; metrics of histories need it",
     .doc = "reference that columns of history.csv are compared with"},
    {"history", KEY_SPECIAL, .special = &special_columns, .otherwise = "none",
     .doc = "the column of history.csv, without its unit, that is compared with a quantity of the reference"},
    {"metrics", KEY_SPECIAL, .special = &special_metrics, .otherwise = "none", .doc = "errors that are reported"},
    {"body", KEY_BODY, AT(scene_verify, body), .otherwise = "all points of the material",
     .doc = "whose points are measured"},
    {"material", KEY_MATERIAL, AT(scene_verify, material),
     .otherwise = "the first fluid; in cells of several fluids all together", .doc = "whose cells are measured"},
    {"region", KEY_MODEL, AT(scene_verify, region), .family = &family_shape, .otherwise = "everywhere",
     .doc = "where it is measured"},
    {"pressure", KEY_NUMBER, "Pa", PARAM_POSITIVE, AT(scene_verify, probe_pressure), .otherwise = "not used",
     .doc = "P of eq13 and of the gas pressure's error, gauge"},
};
static const key_table verify_table = TABLE(verify_keys);

static const key_spec compare_keys[] = {
    {"axis", KEY_SPECIAL, AT(scene_batches, compare), .special = &special_axis, .required = true,
     .doc = "the key that `floe compare` varies, and its values"},
};
static const key_table compare_table = TABLE(compare_keys);

static const key_spec study_keys[] = {
    {"axes", KEY_SPECIAL, AT(scene_study, axis), .special = &special_axes, .otherwise = "those of the command line",
     .doc = "keys that `floe study` varies, and their values; all combinations are run"},
    {"over", KEY_TEXT, AT(scene_study, over), .otherwise = "domain.cell, else the first axis of numbers",
     .doc = "the axis that orders are taken over"},
    {"repeat", KEY_WHOLE, NULL, WITHIN(0, 100), AT(scene_study, repeat), .fallback = "0",
     .doc = "timed runs of each case, alone and on one thread, of which the fastest counts; 0: not timed"},
    {"max_wall", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(scene_study, max_wall), .fallback = "0",
     .doc = "wall time after which a case is stopped; 0: no limit"},
    {"quantities", KEY_SPECIAL, .special = &special_quantities, .otherwise = "none",
     .doc = "columns of history.csv whose last values are extrapolated (Richardson, grid convergence index)"},
    {"require", KEY_SPECIAL, .special = &special_require, .otherwise = "none",
     .doc = "orders and errors that must be reached: a miss gives exit status 6"},
    {"check", KEY_SPECIAL, .special = &special_check, .otherwise = "none",
     .doc = "what every case must keep to: it is right, wrong (exit status 6), or was refused"},
    {"refuse", KEY_SPECIAL, .special = &special_refuse, .otherwise = "none",
     .doc = "cases that may diverge or be refused, and why; any other that has no result gives exit status 6"},
    {"unchanged", KEY_SPECIAL, .special = &special_unchanged, .otherwise = "none",
     .doc = "what `floe study --spoil` does to a result that leaves the right answer as it is, and why"},
};
static const key_table study_table = TABLE(study_keys);

static const key_spec stability_keys[] = {
    {"over", KEY_SPECIAL, .special = &special_over, .otherwise = "that of the command line",
     .doc = "the key whose limit `floe stability` searches, and the range; or two keys and their values, for a map"},
    {"each", KEY_SPECIAL, .special = &special_each, .otherwise = "none",
     .doc = "the search is made for every combination of these values"},
    {"tolerance", KEY_NUMBER, NULL, WITHIN(1e-8, 0.5), AT(scene_stability, tolerance), .fallback = "0.01",
     .doc = "the limit lies between a stable and an unstable value this close, as a fraction of them"},
    {"growth", KEY_NUMBER, NULL, WITHIN(1.0, 1e30), AT(scene_stability, growth), .fallback = "100",
     .doc = "unstable: kinetic and strain energy exceed what they can be this many times"},
    {"relative_to", KEY_NUMBER, NULL, PARAM_POSITIVE, AT(scene_stability, relative_to), .otherwise = "nothing",
     .doc = "what limits are shown over, in the unit of the range (a CFL step)"},
};
static const key_table stability_table = TABLE(stability_keys);

static const key_spec deck_keys[] = {
    {"floe", KEY_SPECIAL, .special = &special_version, .required = true, .doc = "version of the deck format: 1"},
    {"title", KEY_TEXT, AT(scene, title), .otherwise = "none", .doc = "one line that names the scene"},
    {"source", KEY_TEXT, AT(scene, source), .otherwise = "none", .doc = "where the scene comes from"},
    {"units", KEY_CHOICE, AT(scene, dimensionless), .fallback = "si", .choices = unit_choices,
     .doc = "whether numbers have units"},
    {"constants", KEY_NAMED, AT(scene, constant), .items = &items_constants,
     .doc = "numbers with names, for formulas: `constants: {p0: 1 atm, L: 5 cm}`"},
    {"tables", KEY_NAMED, AT(scene, table), .items = &items_tables,
     .doc = "functions of one number by their entries, for formulas: `push(t)`"},
    {"coupling", KEY_CHOICE, AT(scene, coupling), .required = true, .choices = coupling_choices,
     .doc = "how fluids are represented"},
    {"runs_as", KEY_SPECIAL, .special = &special_runs_as, .otherwise = "[coupling]",
     .doc = "couplings that `floe compare` runs"},
    {"reference_pressure", KEY_NUMBER, "Pa", AT(scene, reference_pressure), .fallback = "0",
     .doc = "p_ref: material points carry stress relative to it"},
    {"domain", KEY_MAP, .table = &domain_table, .required = true, .doc = "the mesh"},
    {"materials", KEY_NAMED, AT(scene, material), .items = &items_materials, .required = true,
     .doc = "what things are made of: physics, never a representation"},
    {"ambient", KEY_MAP, .table = &ambient_table, .present = 1 + offsetof(scene, has_ambient),
     .otherwise = "none; needed by ice-mpm, and by ice where bodies leave cells empty",
     .doc = "the fluid that fills what no body fills"},
    {"boundaries", KEY_SPECIAL, AT(scene, bc), .special = &special_boundaries,
     .otherwise = "free (symmetry at the axis r = 0)", .doc = "conditions on the sides of the domain"},
    {"boundary_parts", KEY_NAMED, AT(scene, part), .items = &items_parts,
     .doc = "conditions on parts of sides, for the fluids of the cells: `nozzle: {side: x.lower, where: {box: ...}, "
            "condition: {inlet: ...}}`"},
    {"bodies", KEY_NAMED, AT(scene, body), .items = &items_bodies,
     .doc = "regions filled with a material at the start"},
    {"loads", KEY_NAMED, AT(scene, load), .items = &items_loads, .doc = "what acts on the scene from outside"},
    {"sources", KEY_NAMED, AT(scene, mass_source), .items = &items_sources,
     .doc = "fluid that comes into the cells: injectors, inflators of airbags"},
    {"vents", KEY_NAMED, AT(scene, vent), .items = &items_vents,
     .doc = "orifices between fluids of the cells, or between one and what is outside the scene"},
    {"contact", KEY_MAP, AT(scene, contact), .table = &contact_table, .present = 1 + offsetof(scene, contact.enabled),
     .otherwise = "bodies stick to each other where they meet; in ice-mpm by the exchange alone",
     .doc = "contact of bodies of material points"},
    {"exchange", KEY_NAMED, AT(scene, exchange), .items = &items_exchanges,
     .otherwise = "method.exchange and method.heat_exchange, between all pairs",
     .doc = "what named pairs of materials exchange in cells"},
    {"reactions", KEY_NAMED, AT(scene, reaction), .items = &items_reactions, .otherwise = "none",
     .doc = "what becomes another fluid of the cells"},
    {"springs", KEY_NAMED, AT(scene, spring), .items = &items_springs,
     .doc = "massless springs, tethers and dashpots between places of bodies of material points"},
    {"supports", KEY_NAMED, AT(scene, support), .items = &items_supports, .doc = "regions that hold material points"},
    {"damping", KEY_MAP, AT(scene, damping), .table = &damping_table, .doc = "damping of material points"},
    {"time", KEY_MAP, AT(scene, time), .table = &time_table, .required = true, .doc = "time stepping"},
    {"stop", KEY_MAP, AT(scene, rest), .table = &stop_table, .present = 1 + offsetof(scene, rest.enabled),
     .otherwise = "the run goes on to time.end", .doc = "the run ends once the solids are at rest"},
    {"method", KEY_MAP, AT(scene, method), .table = &method_table, .doc = "numerical method"},
    {"output", KEY_MAP, .table = &output_table, .doc = "what is written"},
    {"verify", KEY_MAP, AT(scene, verify), .table = &verify_table,
     .doc = "comparison with an exact solution or a reference"},
    {"compare", KEY_MAP, THROUGH(scene, batches), .table = &compare_table, .doc = "the axis of `floe compare`"},
    {"study", KEY_MAP, THROUGH(scene, batches), AT(scene_batches, study), .table = &study_table,
     .present = 1 + offsetof(scene_batches, study.given), .otherwise = "none", .doc = "the batch of `floe study`"},
    {"stability", KEY_MAP, THROUGH(scene, batches), AT(scene_batches, stability), .table = &stability_table,
     .present = 1 + offsetof(scene_batches, stability.given), .otherwise = "none",
     .doc = "the search of `floe stability`"},
    {"threads", KEY_WHOLE, NULL, WITHIN(0, 1024), AT(scene, threads), .fallback = "0",
     .doc = "threads; 0: as OpenMP says. Results do not depend on it"},
};
const key_table schema_deck = TABLE(deck_keys);
