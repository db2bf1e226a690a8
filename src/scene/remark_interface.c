/* What a smeared interface gets wrong in a scene (theory 7.2; docs/defaults.md has the figures). */
#include "scene/flight.h"
#include "scene/formula.h"
#include "scene/remark_internal.h"
#include "scene/scene_reach.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { REMARK_SIZE = 1400 };

static const scene_body *first_wall(const scene *s)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (remark_is_solid(&s->material[s->body[b].material])) return &s->body[b];
    return NULL;
}

static bool has_fluid(const scene *s, bool (*is)(const scene_material *m))
{
    if (s->has_ambient && is(&s->material[s->ambient_material])) return true;
    for (int b = 0; b < s->n_bodies; ++b) {
        const scene_material *m = &s->material[s->body[b].material];
        if (m->kind == MATERIAL_FLUID && is(m)) return true;
    }
    return false;
}

static bool is_any(const scene_material *m)
{
    return m->eos.model != NULL;
}

static bool is_not_ideal(const scene_material *m)
{
    return m->eos.model && strcmp(m->eos.model->name, "ideal") != 0;
}

static bool is_inviscid_gas(const scene_material *m)
{
    return m->eos.model && !is_not_ideal(m) && !(m->shear_viscosity > 0.0);
}

/* Why floe has taken it, or what would let it take the other. */
static void say_cause(const scene *s, char *text, size_t size)
{
    static const char start[] = "auto: smeared, as ";
    if (strncmp(s->interface_reason, start, sizeof start - 1) == 0)
        (void)snprintf(text, size, "method.interface: smeared, as %s", s->interface_reason + sizeof start - 1);
    else
        (void)snprintf(text, size, "method.interface: smeared, as the deck asks; auto takes sharp where it can");
}

/* A constant ties gas and solid loosely: the foot of the wall may draw energy from nowhere, at small steps above all. */
static void warn_of_constant(const scene *s, const scene_body *wall, remark_sink *say, void *user)
{
    char text[REMARK_SIZE];
    if (!isfinite(s->method.exchange)) return;
    (void)snprintf(
        text, sizeof text,
        "method.exchange: a constant, %g, between the fluid and body '%s' of a smeared interface may end the run "
        "with energy from nowhere, at small steps above all. Measured with a shock of 7 bar at a wall of steel: "
        "1e3 and 1e5 kg/m3/s ended it in two dimensions, 1e7 a box of 50 bar, 1e8 ran. Compare with locked, and "
        "look at drift_energy.",
        s->method.exchange, wall->name);
    say(user, text);
}

void remark_flight_out(const scene *s, remark_sink *say, void *user)
{
    char text[REMARK_SIZE], side[16];
    const scene_flight f = scene_flight_out(s);
    if (s->coupling != COUPLING_ICE_MPM || s->method.interface != INTERFACE_SHARP || f.body < 0) return;
    scene_side_name(s, f.axis, f.side, side);
    (void)snprintf(
        text, sizeof text,
        "boundaries.%s: body '%s' comes to this side at t = %.3g%s if nothing stops it. Of the gas between a "
        "sharp surface and a side each step lets a share pass only: steps shrink until the run ends, or points "
        "are lost beside the side with their momentum. Take method.interface: smeared, or a larger domain",
        side, s->body[f.body].name, f.time, scene_time_unit(s));
    say(user, text);
}

static bool is_set(const scene *s, const double v[3])
{
    for (int a = 0; a < s->mesh.dim; ++a)
        if (v[a] != 0.0 || scene_formula_of(s, &v[a])) return true;
    return false;
}

static bool side_drives(const scene *s, const bc_side *side)
{
    return side->kind == BC_INLET || side->kind == BC_RESERVOIR || side->kind == BC_NON_REFLECTING ||
           is_set(s, side->velocity);
}

/* Whether something but the solids that deform sets the fluid in motion, and bounds the step by that. */
static bool is_driven(const scene *s)
{
    bool driven = s->n_mass_sources > 0 || (s->has_ambient && is_set(s, s->ambient_velocity));
    for (int a = 0; a < s->mesh.dim; ++a)
        for (int side = 0; side < 2; ++side) driven = driven || side_drives(s, &s->bc.side[a][side]);
    for (int k = 0; k < s->n_parts; ++k) driven = driven || side_drives(s, &s->part[k].condition);
    for (int b = 0; b < s->n_bodies; ++b) {
        const scene_body *body = &s->body[b];
        driven = driven || body->motion.kind == MOTION_DRIVEN ||
                 (s->material[body->material].kind == MATERIAL_FLUID && is_set(s, body->velocity));
    }
    return driven;
}

void remark_free_swing(const scene *s, remark_sink *say, void *user)
{
    remark_speaker w = {.s = s, .say = say, .user = user};
    if (!scene_bends_walls(s) || s->time.solver != SOLVER_DYNAMIC || s->contact.enabled || is_driven(s)) return;
    if (!isnan(s->time.max_step) || !isnan(s->time.fixed_step)) return;
    remark_set_key(&w, "time", "max_step", "");
    remark_key(&w,
               "nothing but solids that deform moves the fluid, and with the implicit pressure no step is bound by "
               "the period in which they swing: it is 2 %% too long with 20 steps, 0.1 %% with 100, and with 6 there "
               "is none. Give a fiftieth of the period");
}

/* A liquid at rest under gravity, about a body that does not deform, or whose motion is given, moves. */
static void warn_of_rest(const scene *s, remark_sink *say, void *user)
{
    bool pulled = false;
    for (int k = 0; k < s->n_loads; ++k) pulled = pulled || (s->load[k].kind == LOAD_BODY_FORCE && s->load[k].body < 0);
    for (int b = 0; pulled && scene_has_liquid(s) && b < s->n_bodies; ++b) {
        if (!motion_is_prescribed(&s->body[b].motion)) continue;
        remark_speaker w = {.s = s, .say = say, .user = user};
        remark_set_key(&w, "bodies", s->body[b].name, "motion");
        remark_key(&w,
                   "with a smeared interface a liquid does not stay at rest under gravity about a body that does not "
                   "deform: a block held half in water under air set it going with 14 J within 0.1 s and 1.8 kJ within "
                   "0.2 s, where nothing should move. Take a sharp interface");
        return;
    }
}

void remark_smeared(const scene *s, remark_sink *say, void *user)
{
    const scene_body *wall = first_wall(s);
    if (s->coupling != COUPLING_ICE_MPM || s->time.solver != SOLVER_DYNAMIC || !wall) return;
    if (s->method.interface != INTERFACE_SMEARED || scene_enclosing_body(s) >= 0 || !has_fluid(s, is_any)) return;
    char text[REMARK_SIZE], cause[sizeof s->interface_reason + 64];
    say_cause(s, cause, sizeof cause);
    (void)snprintf(
        text, sizeof text,
        "the fluid beside body '%s' is wrong within three cells of it (%s). Measured on a shock of 7 bar at a "
        "wall of steel: 1.0, 2.2 and 7.3 bar in the first three cells, for 7.0; the impulse was right to 3 %%. "
        "Read pressures three cells away from it.%s%s",
        wall->name, cause,
        has_fluid(s, is_inviscid_gas) ? " A gas without viscosity is held along it as if it had one, unless "
                                        "`exchange` has `tangential: free` for the pair."
                                      : "",
        has_fluid(s, is_not_ideal)
            ? " Walls under four cells lose some of a liquid's pressure: of a water hammer in a tube of steel 0.97 "
              "was left with two cells of wall, 1.00 with four. And they let it seep in, by some of it at every step: "
              "a "
              "tube full of water at 100 bar lost 3 % of its pressure each millisecond at rest and 4 % as it rang, "
              "with two cells of steel, 0.5 and 1.2 % with four."
            : "");
    say(user, text);
    warn_of_constant(s, wall, say, user);
    warn_of_rest(s, say, user);
}
