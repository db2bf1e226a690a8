/* What bodies with a motion of their own cannot be combined with. Each rule is a row. */
#include "scene/formula.h"
#include "scene/scene_reach.h"
#include "scene/unsupported.h"

#include <math.h>
#include <stddef.h>

static bool turns(const scene_motion *m)
{
    bool found = m->turning[0] != 0.0 || m->turning[1] != 0.0 || m->turning[2] != 0.0;
    for (int k = 0; k < m->n; ++k) found = found || m->spin[k] != 0.0;
    return found;
}

static bool is_solved_for(const scene *s, int body)
{
    (void)body;
    return s->time.solver == SOLVER_STATIC || s->time.solver == SOLVER_IMPLICIT;
}

static bool is_membrane(const scene *s, int body)
{
    return s->material[s->body[body].material].membrane != NULL;
}

static bool has_exact_state(const scene *s, int body)
{
    return s->body[body].initial_from_exact;
}

static bool has_first_stress(const scene *s, int body)
{
    bool any = false;
    for (int c = 0; c < 6; ++c)
        any = any || s->body[body].stress[c] != 0.0 || scene_formula_of(s, &s->body[body].stress[c]);
    return any;
}

static bool has_two_velocities(const scene *s, int body)
{
    const double *v = s->body[body].velocity;
    return motion_is_prescribed(&s->body[body].motion) && (v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0);
}

static bool has_traction(const scene *s, int body)
{
    for (int l = 0; l < s->n_loads; ++l)
        if (s->load[l].kind == LOAD_TRACTION && s->load[l].body == body) return true;
    return false;
}

static bool burns(const scene *s, int body)
{
    for (int k = 0; k < s->n_reactions; ++k)
        if (s->reaction[k].reactant == s->body[body].material) return true;
    return false;
}

static bool is_damped(const scene *s, int body)
{
    return s->body[body].motion.kind == MOTION_RIGID && s->damping.rate > 0.0;
}

static bool has_sources(const scene *s, int body)
{
    (void)body;
    return s->verify.sources;
}

static bool warms_fluid(const scene *s, int body)
{
    (void)body;
    return s->method.losses == LOSSES_HEAT;
}

static bool leaves_axis(const scene *s, int body)
{
    const scene_motion *m = &s->body[body].motion;
    bool radial = s->body[body].velocity[0] != 0.0 || turns(m);
    for (int k = 0; k < m->n; ++k) radial = radial || m->velocity[k][0] != 0.0;
    return s->mesh.geometry == MESH_AXISYMMETRIC && radial;
}

static bool turns_on_line(const scene *s, int body)
{
    return s->mesh.dim == 1 && turns(&s->body[body].motion);
}

static bool is_periodic(const scene *s)
{
    for (int a = 0; a < s->mesh.dim; ++a)
        if (s->mesh.periodic[a] || s->bc.side[a][0].kind == BC_PERIODIC) return true;
    return false;
}

static bool has_no_centre(const scene *s, int body)
{
    const scene_motion *m = &s->body[body].motion;
    return is_periodic(s) && (m->kind == MOTION_RIGID || turns(m));
}

static const struct {
    bool (*applies)(const scene *s, int body);
    const char *why;
} rules[] = {
    {is_membrane, "a membrane deforms: leave the motion out, or take a solid"},
    {is_solved_for, "static and implicit steps move bodies by forces alone: take time.solver dynamic, or supports"},
    {has_exact_state, "its state is that of its motion: leave 'state: exact' out"},
    {has_first_stress, "its stress stays zero: leave 'stress' out"},
    {has_two_velocities, "its velocity is that of its motion: leave 'velocity' out"},
    {has_traction, "a traction acts on a body that deforms: leave the load out; a rigid body takes a body_force"},
    {burns, "a body that burns loses points: leave the motion out, or the reaction"},
    {is_damped, "damping acts on nodes, and a rigid body has none of its own: leave the damping out"},
    {has_sources, "the sources of verify act on bodies that deform: leave them out"},
    {warms_fluid, "what its points lose is no heat: take method.losses own or drift"},
    {leaves_axis,
     "about an axis a body moves along z alone: leave the rest of its motion out, or take a scene in space"},
    {turns_on_line, "along a line nothing turns: leave the spin out"},
    {has_no_centre, "across periodic sides a body has no centre to turn about: take other sides, or a velocity alone"},
};

/* With the smeared interface velocities in cells are those of materials. */
static floe_status refuse_common_material(const scene *s, int body)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (b != body && s->body[b].material == s->body[body].material)
            return fail_key(s->ctx, KEY("bodies", s->body[body].name, "material"),
                            "ice-mpm: with the smeared interface cells know one velocity of a material, and '%s' is of "
                            "the same: give '%s', which has a motion of its own, a material of its own",
                            s->body[b].name, s->body[body].name);
    return FLOE_OK;
}

/* The cells' pressure takes a smeared body as one that gives way cell by cell, and the body then moves as a whole. Steps of sound even that
 * out; in longer ones a liquid swings up, whatever its density and the body's. */
static floe_status refuse_long_steps(const scene *s, int body)
{
    if (s->body[body].motion.kind != MOTION_RIGID || s->method.pressure == PRESSURE_EXPLICIT || !scene_has_liquid(s))
        return FLOE_OK;
    return fail_key(
        s->ctx, KEY("bodies", s->body[body].name, "motion"),
        "ice-mpm: beside the implicit pressure a liquid swings up about a rigid body unless the interface is "
        "sharp (method.interface: %s): take method.pressure explicit, or leave the motion out",
        s->interface_reason[0] ? s->interface_reason : "smeared");
}

static floe_status refuse_smeared(const scene *s, int body)
{
    TRY(refuse_common_material(s, body));
    return refuse_long_steps(s, body);
}

floe_status scene_refuse_motions(const scene *s, scene_coupling coupling)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        if (!motion_is_given(&s->body[b].motion)) continue;
        for (size_t k = 0; k < sizeof rules / sizeof rules[0]; ++k)
            if (rules[k].applies(s, b))
                return fail_key(s->ctx, KEY("bodies", s->body[b].name, "motion"), "%s", rules[k].why);
        if (coupling == COUPLING_ICE_MPM && s->method.interface == INTERFACE_SMEARED) TRY(refuse_smeared(s, b));
    }
    return FLOE_OK;
}
