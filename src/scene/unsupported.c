/* What a coupling cannot do. Each rule is a row: what is looked at, the couplings that cannot do it, and why. */
#include "scene/unsupported.h"

#include "scene/formula.h"
#include "scene/scene_reach.h"
#include "scene/side_parts.h"
#include "scene/solid_heat.h"
#include "scene/state.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { AS_MPM = 1 << COUPLING_MPM, AS_ICE = 1 << COUPLING_ICE, AS_ICE_MPM = 1 << COUPLING_ICE_MPM };

static bool is_concerned(scene_coupling coupling, unsigned couplings)
{
    return (couplings >> coupling & 1U) != 0;
}

static bool has_body_of(const scene *s, int material)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].material == material) return true;
    return false;
}

/* ---- sides ---- */

static bool side_lets_in(const scene *s, const bc_side *side)
{
    (void)s;
    return side->kind == BC_INLET;
}

static bool side_is_reservoir(const scene *s, const bc_side *side)
{
    (void)s;
    return side->kind == BC_RESERVOIR;
}

static bool side_absorbs(const scene *s, const bc_side *side)
{
    (void)s;
    return side->kind == BC_NON_REFLECTING;
}

/* Points carry stress relative to the reference pressure: that is what acts on them from outside. */
static bool side_has_other_pressure(const scene *s, const bc_side *side)
{
    return side->kind == BC_OUTLET && !(fabs(side->pressure - s->reference_pressure) <= 1e-6 * fabs(side->pressure));
}

static bool side_has_heat(const scene *s, const bc_side *side)
{
    (void)s;
    const bool wall = side->kind == BC_SLIP || side->kind == BC_NO_SLIP;
    return wall && (side->temperature > 0.0 || side->heat_flux != 0.0);
}

static bool side_heats_nothing(const scene *s, const bc_side *side)
{
    return side_has_heat(s, side) && !scene_some_solid_conducts(s);
}

/* Beside fluids on points a slip side is a mirror to all points, beyond which temperatures are those of the image. */
static bool mirror_has_temperature(const scene *s, const bc_side *side)
{
    if (side->kind != BC_SLIP || !(side->temperature > 0.0)) return false;
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->material[s->body[b].material].kind == MATERIAL_FLUID) return true;
    return s->has_ambient && s->ambient_points > 0;
}

static bool wall_cannot_drag(const scene *s, const bc_side *side)
{
    if (side->kind != BC_NO_SLIP) return false;
    for (int m = 0; m < s->n_materials; ++m)
        if (s->material[m].kind == MATERIAL_FLUID && s->material[m].shear_viscosity > 0.0) return false;
    return side->velocity[0] != 0.0 || side->velocity[1] != 0.0 || side->velocity[2] != 0.0;
}

static bool velocity_has_place(const scene *s, const bc_side *side)
{
    for (int a = 0; a < s->mesh.dim; ++a) {
        const expression *formula = scene_formula_of(s, &side->velocity[a]);
        if (formula && expression_has_place(formula)) return true;
    }
    return false;
}

static const struct {
    unsigned couplings;
    bool (*applies)(const scene *s, const bc_side *side);
    const char *why;
} side_rules[] = {
    {AS_MPM, side_lets_in,
     "'inlet' lets a fluid in, and no material points come into being: take ice or ice-mpm, or 'velocity' for a side "
     "that moves bodies"},
    {AS_MPM, side_is_reservoir,
     "'reservoir' lets a fluid in, and no material points come into being: take ice or ice-mpm"},
    {AS_MPM, side_absorbs, "material points reflect the waves that 'non_reflecting' lets out: take ice or ice-mpm"},
    {AS_MPM, side_has_other_pressure,
     "outside of material points there is reference_pressure, and the outlet has another pressure: make them the same, "
     "or take ice or ice-mpm"},
    {AS_MPM, side_heats_nothing,
     "fluids of material points do not conduct heat, so that the wall's heat has no effect: leave it out, or take ice "
     "or ice-mpm"},
    {AS_MPM, mirror_has_temperature,
     "a slip side is a mirror beside fluids on points, and gives solids no temperature: take no_slip"},
    {AS_MPM, velocity_has_place,
     "material points see one velocity on all of a side, and this one changes with place: take one that changes with "
     "time alone, or ice or ice-mpm"},
    {AS_ICE, wall_cannot_drag,
     "no fluid is viscous, so that the wall's velocity has no effect: give a fluid a 'viscosity', or take 'slip'"},
};

/* A solid of points stands at a side where it would see one velocity, and the fluid another at each place. */
static bool solid_at_changing_side(const scene *s, const scene_condition *at)
{
    if (at->part || !velocity_has_place(s, at->side)) return false;
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->material[s->body[b].material].kind == MATERIAL_SOLID &&
            body_reaches_side(s, &s->body[b], at->axis, at->end))
            return true;
    return false;
}

static floe_status refuse_sides(const scene *s, scene_coupling coupling)
{
    scene_condition at;
    if (coupling == COUPLING_MPM && s->n_parts > 0)
        return fail_key(s->ctx, KEY("boundary_parts", s->part[0].name),
                        "mpm: parts of sides are for the fluids of the cells, and points meet whole sides: take ice or "
                        "ice-mpm");
    for (int i = 0; scene_next_condition(s, &i, &at);)
        if (coupling == COUPLING_ICE_MPM && solid_at_changing_side(s, &at))
            return fail_key(
                s->ctx,
                KEY("boundaries", mesh_axis_name(s->mesh.geometry, at.axis), at.end == SIDE_LOWER ? "lower" : "upper"),
                "ice-mpm: a solid reaches this side, and its points see one velocity on all of it, while "
                "this one changes with place: take one that changes with time alone, or move the solid");
    for (int i = 0; scene_next_condition(s, &i, &at);)
        for (size_t k = 0; k < sizeof side_rules / sizeof side_rules[0]; ++k) {
            if (!is_concerned(coupling, side_rules[k].couplings) || !side_rules[k].applies(s, at.side)) continue;
            const char *end = at.end == SIDE_LOWER ? "lower" : "upper",
                       *axis = mesh_axis_name(s->mesh.geometry, at.axis);
            return fail_key(s->ctx, at.part ? KEY("boundary_parts", at.part) : KEY("boundaries", axis, end), "%s: %s",
                            coupling_name(coupling), side_rules[k].why);
        }
    return FLOE_OK;
}

/* ---- materials ---- */

static floe_status refuse_materials(const scene *s, scene_coupling coupling)
{
    for (int m = 0; m < s->n_materials && coupling == COUPLING_MPM; ++m) {
        const scene_material *of = &s->material[m];
        if (of->kind != MATERIAL_FLUID || !(of->conductivity > 0.0) || !has_body_of(s, m)) continue;
        return fail_key(s->ctx, KEY("materials", of->name, "conductivity"),
                        "mpm: fluids of material points do not conduct heat; leave it out, or take ice or ice-mpm");
    }
    return FLOE_OK;
}

/* Whether the points of a material conduct, are heated or expand, whatever they share cells with. */
static const char *heat_key(const scene_material *m)
{
    if (m->conductivity > 0.0) return "conductivity";
    return m->plastic_heat > 0.0 ? "plastic_heat" : m->expansion != 0.0 ? "expansion" : "law";
}

static bool is_solved_for(const scene *s)
{
    return s->time.solver == SOLVER_STATIC || s->time.solver == SOLVER_IMPLICIT;
}

static floe_status refuse_heat_of_solid(const scene *s, const scene_material *m)
{
    const char *const *key = KEY("materials", m->name, heat_key(m));
    const int number = (int)(m - s->material);
    if (scene_material_burns(s, number))
        return fail_key(s->ctx, key, "a solid that burns carries no temperature: leave it out");
    if (m->conductivity > 0.0 && strcmp(s->method.basis, "linear") == 0)
        return fail_key(s->ctx, key,
                        "with method.basis linear conduction has no stable step where nodes are light: take quadratic, "
                        "cubic, gimp or cpdi");
    const bool changes = m->conductivity > 0.0 || m->plastic_heat > 0.0 || (m->law && m->law->needs & SOLID_HAS_ENERGY);
    if (changes && is_solved_for(s))
        return fail_key(s->ctx, key,
                        "time.solver static and implicit keep the temperatures of solids as they are, which conduction "
                        "and plastic work change: take explicit steps");
    return FLOE_OK;
}

/* What laws ask of their scene that depend on more than strain. */
static floe_status refuse_law_of_solid(const scene *s, const scene_material *m, unsigned by)
{
    if ((by & SOLID_BY_TEMPERATURE) && !(m->specific_heat > 0.0))
        return fail_key(s->ctx, KEY("materials", m->name, "law"),
                        "law '%s' depends on temperature, which a solid has with a specific_heat: give the material's, "
                        "or leave out "
                        "what depends on it (melting_temperature)",
                        m->law->name);
    if ((by & SOLID_BY_RATE) && is_solved_for(s))
        return fail_key(s->ctx, KEY("materials", m->name, "law"),
                        "law '%s' depends on the rate of strain, which time.solver static and implicit do not give it: "
                        "leave rate_coefficient out, or take explicit steps",
                        m->law->name);
    if ((by & SOLID_BY_ENERGY) && m->expansion != 0.0)
        return fail_key(s->ctx, KEY("materials", m->name, "expansion"),
                        "a Mie-Grueneisen pressure expands the solid already, by grueneisen times specific_heat times "
                        "density over three bulk moduli: leave expansion out");
    return FLOE_OK;
}

/* Of solids with a temperature by a key of their own, or a law that depends on it. */
static floe_status refuse_heat_of_solids(const scene *s, scene_coupling coupling)
{
    for (int m = 0; m < s->n_materials && coupling != COUPLING_ICE; ++m) {
        const scene_material *of = &s->material[m];
        if (of->kind != MATERIAL_SOLID || !has_body_of(s, m)) continue;
        const unsigned by = of->law ? solid_depends_on(of->law, of->law_par) : 0;
        TRY(refuse_law_of_solid(s, of, by));
        if (of->conductivity > 0.0 || of->plastic_heat > 0.0 || of->expansion != 0.0 || (by & SOLID_BY_TEMPERATURE))
            TRY(refuse_heat_of_solid(s, of));
    }
    return FLOE_OK;
}

/* The material is somewhere: in a body, the ambient, a side, a reaction or a source. */
static bool is_present(const scene *s, int material)
{
    if (has_body_of(s, material) || (s->has_ambient && s->ambient_material == material)) return true;
    scene_condition at;
    for (int i = 0; scene_next_condition(s, &i, &at);)
        if ((at.side->kind == BC_INLET || at.side->kind == BC_RESERVOIR) && at.side->material == material) return true;
    for (int k = 0; k < s->n_reactions; ++k)
        if (s->reaction[k].product == material) return true;
    for (int k = 0; k < s->n_mass_sources; ++k)
        if (s->mass_source[k].material == material) return true;
    return false;
}

/* ---- interactions ---- */

/* Beside cells, a membrane needs the gas that it holds. */
static floe_status refuse_empty_membranes(const scene *s, scene_coupling coupling)
{
    for (int b = 0; b < s->n_bodies && coupling == COUPLING_ICE_MPM; ++b) {
        const scene_membrane *m = &s->body[b].membrane;
        if (!m->present || m->encloses < 0 || is_present(s, m->encloses)) continue;
        return fail_key(s->ctx, KEY("bodies", s->body[b].name, "membrane", "encloses"),
                        "there is no '%s' to enclose: give a body of it inside the membrane",
                        s->material[m->encloses].name);
    }
    return FLOE_OK;
}

static floe_status refuse_interactions(const scene *s, scene_coupling coupling)
{
    static const char one_velocity[] =
        "mpm: where bodies meet without contact, their material points have one velocity and exchange no heat; leave "
        "it out, or take ice or ice-mpm";
    if (coupling == COUPLING_MPM && s->n_exchanges > 0)
        return fail_key(s->ctx, KEY("exchange", s->exchange[0].name), one_velocity);
    for (int k = 0; k < s->n_exchanges; ++k)
        for (int i = 0; i < 2; ++i)
            if (!is_present(s, s->exchange[k].material[i]))
                return fail_key(s->ctx, KEY("exchange", s->exchange[k].name, "between"),
                                "there is no '%s' in the scene: leave the pair out, or give a body of it",
                                s->material[s->exchange[k].material[i]].name);
    if (coupling == COUPLING_MPM && isfinite(s->method.exchange)) /* points are locked */
        return fail_key(s->ctx, KEY("method", "exchange"), one_velocity);
    if (coupling == COUPLING_MPM && s->method.heat_exchange > 0.0)
        return fail_key(s->ctx, KEY("method", "heat_exchange"), one_velocity);
    if (coupling == COUPLING_MPM && s->n_reactions > 0)
        return fail_key(s->ctx, KEY("reactions", s->reaction[0].name),
                        "mpm: materials react in cells, and there are none; leave it out, or take ice or ice-mpm");
    if (coupling == COUPLING_ICE && (s->time.solver == SOLVER_STATIC || s->time.solver == SOLVER_IMPLICIT))
        return fail_key(s->ctx, KEY("time", "solver"),
                        "ice: it is the solver of material points, and there are none; leave it out");
    if (coupling == COUPLING_ICE && s->damping.rate > 0.0)
        return fail_key(s->ctx, KEY("damping", "rate"),
                        "ice: damping acts on material points, and there are none; leave it out");
    return FLOE_OK;
}

/* ---- loads ---- */

static floe_status refuse_load(const scene *s, scene_coupling coupling, const scene_load *load)
{
    const bool heats = load->kind == LOAD_PRESSURISE || load->kind == LOAD_HEAT;
    if (heats && load->material >= 0 && !is_present(s, load->material))
        return fail_key(s->ctx, KEY("loads", load->name, load->kind == LOAD_HEAT ? "heat" : "pressurise", "material"),
                        "there is no '%s' in the scene: give a body of it, or leave the load out",
                        s->material[load->material].name);
    const expression *power = load->kind == LOAD_HEAT ? scene_formula_of(s, &load->target) : NULL;
    if (power && expression_has_place(power) && coupling == COUPLING_MPM && s->time.solver != SOLVER_DYNAMIC)
        return fail_key(s->ctx, KEY("loads", load->name, "heat", "power"),
                        "%s: gas at rest takes the heat of all of it, and this power changes with place: take one that "
                        "changes with time alone, or 'solver: dynamic'",
                        coupling_name(coupling));
    const bool solved = s->time.solver == SOLVER_STATIC || s->time.solver == SOLVER_AUTO;
    if (coupling == COUPLING_ICE_MPM && load->kind == LOAD_BODY_FORCE && solved && !load_is_uniform(s, load))
        return fail_key(s->ctx, KEY("loads", load->name, "body_force"),
                        "ice-mpm: in static balance beside cells a body force is one acceleration everywhere: take "
                        "time.solver dynamic, or leave formulas of place and the region out");
    if (load->kind != LOAD_BODY_FORCE || load->body < 0 || coupling == COUPLING_MPM) return FLOE_OK;
    if (s->material[s->body[load->body].material].kind != MATERIAL_FLUID) return FLOE_OK;
    return fail_key(s->ctx, KEY("loads", load->name, "body_force", "body"),
                    "%s: '%s' is a fluid in cells, where it mixes with others of its material: take gravity, or mpm",
                    coupling_name(coupling), s->body[load->body].name);
}

static bool has_solids_of_points(const scene *s)
{
    for (int k = 0; k < s->n_bodies; ++k) {
        const scene_material *m = &s->material[s->body[k].material];
        if (m->kind == MATERIAL_SOLID && !m->membrane) return true;
    }
    return false;
}

/* A free side has the pressure that is inside: slower than sound nothing says what comes in there, the liquid drains, bears tension, and
 * draws what has left in again, a swing with a solid that grows. Water at rest at 1.8 bar about a block of steel came to -4e8 Pa within
 * 4 ms (smeared), about one at 3 m/s to -2e7 where an outlet has -2e5 (sharp); with outlet or non_reflecting nothing grew, nor with gas. */
static floe_status refuse_open_liquids(const scene *s, scene_coupling coupling)
{
    if (coupling != COUPLING_ICE_MPM || !has_solids_of_points(s)) return FLOE_OK;
    for (int axis = 0; axis < s->mesh.dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            const char name[2] = {axis_letter(s, axis), 0};
            if (s->bc.side[axis][side].kind != BC_FREE || !liquid_reaches_side(s, axis, side)) continue;
            return fail_key(
                s->ctx, KEY("boundaries", name, side ? "upper" : "lower"),
                "ice-mpm: a free side holds no pressure against a liquid, and beside solids what leaves and comes back "
                "grows "
                "without bound (80 kPa to 80 MPa and more within 4 ms): take outlet or non_reflecting, with the "
                "pressure that is outside");
        }
    return FLOE_OK;
}

floe_status scene_refuse_unsupported(const scene *s, scene_coupling coupling)
{
    TRY(refuse_sides(s, coupling));
    TRY(refuse_open_liquids(s, coupling));
    TRY(refuse_materials(s, coupling));
    TRY(refuse_heat_of_solids(s, coupling));
    TRY(refuse_empty_membranes(s, coupling));
    TRY(refuse_interactions(s, coupling));
    TRY(scene_refuse_motions(s, coupling));
    for (int l = 0; l < s->n_loads; ++l) TRY(refuse_load(s, coupling, &s->load[l]));
    TRY(scene_refuse_sources(s, coupling));
    TRY(scene_check_formulas_in_time(s));
    return scene_check_first_states(s);
}
