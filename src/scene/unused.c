/* Keys that a coupling does not read, because it has no cells or no points of that kind. Only keys that stand in the
 * deck, with a value other than the default, are remarked on. */
#include "scene/deck_location.h"
#include "scene/side_parts.h"
#include "scene/solid_heat.h"
#include "scene/unsupported.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum {
    AS_MPM = 1 << COUPLING_MPM,
    AS_ICE = 1 << COUPLING_ICE,
    AS_ICE_MPM = 1 << COUPLING_ICE_MPM,
    TEXT_SIZE = 2 * SCENE_NAME + 200,
    PATH_SIZE = 2 * SCENE_NAME,
    PLACE_SIZE = 700
};

/* Where what is found is said. */
typedef struct unused_list {
    const scene *s;
    remark_sink *say;
    void *user;
} unused_list;

/* A remark that begins with the place of the key. */
static void say_at(const unused_list *list, const char *path, const char *what)
{
    char where[PLACE_SIZE], text[PLACE_SIZE + TEXT_SIZE];
    scene_key_place(list->s, path, where, sizeof where);
    (void)snprintf(text, sizeof text, "%s%s", where, what);
    list->say(list->user, text);
}

/* Neither this coupling nor another of runs_as reads it. */
static bool is_unread(const scene *s, unsigned couplings)
{
    for (int k = 0; k < s->n_runs_as; ++k)
        if (!(couplings >> s->runs_as[k] & 1U)) return false;
    return (couplings >> s->coupling & 1U) != 0;
}

static void add_key(const unused_list *list, unsigned couplings, const char *path)
{
    static const char *const lacks[COUPLING_COUNT] = {"it has no cells", "it has no material points",
                                                      "its fluids are in cells"};
    const scene_coupling coupling = list->s->coupling;
    char text[TEXT_SIZE];
    if (!is_unread(list->s, couplings) || !scene_has_key(list->s, path)) return;
    (void)snprintf(text, sizeof text, "'%s' does not read this key, as %s", coupling_name(coupling), lacks[coupling]);
    say_at(list, path, text);
}

/* ---- keys of the whole scene ---- */

#define MEMBER(member) offsetof(scene, member), sizeof(((scene *)0)->member)

static const struct {
    const char *path;
    unsigned couplings; /* that do not read it */
    size_t offset, size;
} scene_keys[] = {
    {"ambient.points", AS_ICE | AS_ICE_MPM, MEMBER(ambient_points)},
    {"domain.stress_state", AS_ICE, MEMBER(stress_state)},
    {"domain.lattice_offset", AS_ICE, MEMBER(lattice_offset)},
    {"time.cfl.mpm", AS_ICE, MEMBER(time.cfl_mpm)},
    {"time.cfl.ice", AS_MPM, MEMBER(time.cfl_ice)},
    {"time.acoustic_cfl", AS_MPM, MEMBER(time.acoustic_cfl)},
    {"time.substeps", AS_MPM | AS_ICE, MEMBER(time.substeps)},
    {"method.basis", AS_ICE, MEMBER(method.basis)},
    {"method.domain_limit", AS_ICE, MEMBER(method.domain_limit)},
    {"method.stress", AS_ICE, MEMBER(method.stress)},
    {"method.transfer", AS_ICE, MEMBER(method.transfer)},
    {"method.flip", AS_ICE, MEMBER(method.flip)},
    {"method.filter_order", AS_ICE, MEMBER(method.filter_order)},
    {"method.point_density", AS_ICE | AS_ICE_MPM, MEMBER(method.density)},
    {"method.edge_penalty", AS_ICE, MEMBER(method.edge_penalty)},
    {"method.centring", AS_MPM, MEMBER(method.centring)},
    {"method.energy", AS_MPM, MEMBER(method.conserve_energy)},
    {"method.limiter", AS_MPM, MEMBER(method.limiter)},
    {"method.volume_relaxation", AS_MPM | AS_ICE, MEMBER(method.volume_relaxation)},
    {"method.interface", AS_MPM | AS_ICE, MEMBER(method.interface)},
    {"method.pressure", AS_MPM, MEMBER(method.pressure)},
    {"method.pressure_tolerance", AS_MPM, MEMBER(method.pressure_tolerance)},
};

/* A text that was shorter than its default leaves the default's end behind it. */
static bool is_default(const scene *s, const scene *defaults, size_t offset, size_t size)
{
    return memcmp((const char *)s + offset, (const char *)defaults + offset, size) == 0;
}

static void add_scene_keys(const unused_list *list)
{
    scene *defaults;
    if (scene_create(&defaults, list->s->ctx) != FLOE_OK) return;
    for (size_t k = 0; k < sizeof scene_keys / sizeof scene_keys[0]; ++k)
        if (!is_default(list->s, defaults, scene_keys[k].offset, scene_keys[k].size))
            add_key(list, scene_keys[k].couplings, scene_keys[k].path);
    scene_destroy(&defaults);
}

/* ---- keys of materials and bodies ---- */

static void add_key_of(const unused_list *list, unsigned couplings, const char *map, const char *name, const char *key)
{
    char path[PATH_SIZE];
    (void)snprintf(path, sizeof path, "%s.%s.%s", map, name, key);
    add_key(list, couplings, path);
}

static void add_material_keys(const unused_list *list, const scene_material *m)
{
    const bool solid = m->kind == MATERIAL_SOLID;
    if (m->artificial_linear > 0.0 || m->artificial_quadratic > 0.0)
        add_key_of(list, solid ? AS_ICE : AS_ICE | AS_ICE_MPM, "materials", m->name, "artificial_viscosity");
    if (!solid) return;
    if (!isnan(m->specific_heat) && !scene_solid_has_temperature(list->s, (int)(m - list->s->material), false))
        add_key_of(list, AS_MPM | AS_ICE, "materials", m->name, "specific_heat");
    if (!isnan(m->tension_switch)) add_key_of(list, AS_MPM | AS_ICE, "materials", m->name, "tension_switch");
}

static void add_body_keys(const unused_list *list, const scene_body *b)
{
    enum { USUAL_POINTS = 2 };
    const double usual_merge = 0.3, usual_temperature = list->s->has_ambient ? list->s->ambient_temperature : 300.0;
    bool other_points = false;
    if (list->s->material[b->material].kind == MATERIAL_SOLID) {
        if (b->membrane.encloses >= 0 && b->membrane.surface.kind == SHEET_NONE)
            add_key_of(list, AS_MPM | AS_ICE, "bodies", b->name, "membrane.encloses");
        if (b->temperature != usual_temperature && !scene_solid_has_temperature(list->s, b->material, false))
            add_key_of(list, AS_MPM | AS_ICE, "bodies", b->name, "temperature");
        return;
    }
    for (int a = 0; a < list->s->mesh.dim; ++a) other_points = other_points || b->per_cell[a] != USUAL_POINTS;
    if (other_points) add_key_of(list, AS_ICE | AS_ICE_MPM, "bodies", b->name, "points");
    if (b->seeding != SEED_FITTED) add_key_of(list, AS_ICE | AS_ICE_MPM, "bodies", b->name, "seeding");
    if (b->merge != usual_merge) add_key_of(list, AS_ICE | AS_ICE_MPM, "bodies", b->name, "merge");
}

/* Tracers move with points: fluids on the cells have none. */
static void add_tracers(const unused_list *list)
{
    const scene *s = list->s;
    for (int n = 0; n < s->n_tracers; ++n)
        if (s->material[s->body[s->tracer[n].body].material].kind == MATERIAL_FLUID)
            add_key_of(list, AS_ICE | AS_ICE_MPM, "output.tracers", s->tracer[n].name, "body");
}

/* What points lose heats gas points, or the gas that surfaces of points hold. */
static void add_losses(const unused_list *list)
{
    const scene *s = list->s;
    if (s->method.losses == LOSSES_HEAT) add_key(list, scene_is_cut(s) ? AS_ICE : AS_ICE | AS_ICE_MPM, "method.losses");
}

/* The order of a filter or a sum, where no transfer is named and the default has neither. */
static void add_filter_order(const unused_list *list)
{
    const scene *s = list->s;
    if (s->coupling == COUPLING_ICE || s->method.transfer[0] || strcmp(scene_transfer(s), "flip") != 0) return;
    if (scene_has_key(s, "method.filter_order"))
        say_at(list, "method.filter_order", "transfer is flip here, which has no order: name transfer xpic or afmpm");
}

/* Cells carry absolute pressures: only a load that pressurises counts from the reference. */
static void add_reference_pressure(const unused_list *list)
{
    const scene *s = list->s;
    for (int l = 0; l < s->n_loads; ++l)
        if (s->load[l].kind == LOAD_PRESSURISE) return;
    if (s->reference_pressure != 0.0 && isnan(s->verify.probe_pressure)) add_key(list, AS_ICE, "reference_pressure");
}

/* A material of nothing is most likely a body that was forgotten. */
static void remark_idle_materials(const unused_list *list)
{
    const scene *s = list->s;
    for (int m = 0; m < s->n_materials; ++m) {
        bool used = s->has_ambient && s->ambient_material == m;
        for (int b = 0; b < s->n_bodies; ++b)
            used = used || s->body[b].material == m || s->body[b].membrane.encloses == m;
        for (int k = 0; k < s->n_reactions; ++k)
            used = used || s->reaction[k].product == m || s->reaction[k].reactant == m;
        for (int k = 0; k < s->n_mass_sources; ++k) used = used || s->mass_source[k].material == m;
        scene_condition at;
        for (int i = 0; scene_next_condition(s, &i, &at);) used = used || at.side->material == m;
        if (used) continue;
        char text[TEXT_SIZE], path[PATH_SIZE];
        (void)snprintf(text, sizeof text, "nothing is made of material '%s'", s->material[m].name);
        (void)snprintf(path, sizeof path, "materials.%s", s->material[m].name);
        say_at(list, path, text);
    }
}

/* ---- sides ---- */

static const char *const name_of_end[] = {"lower", "upper"};

/* What would flow back through an outlet; points do not. The deck says it of a side, of an axis, or of all. */
static void add_outlet_keys(const unused_list *list, int axis, int end)
{
    static const char *const key[] = {"temperature", "material"};
    const char *name = mesh_axis_name(list->s->mesh.geometry, axis);
    for (int k = 0; k < 2; ++k) {
        char side[PATH_SIZE], both[PATH_SIZE], all[PATH_SIZE];
        (void)snprintf(side, sizeof side, "boundaries.%s.%s.outlet.%s", name, name_of_end[end], key[k]);
        (void)snprintf(both, sizeof both, "boundaries.%s.outlet.%s", name, key[k]);
        (void)snprintf(all, sizeof all, "boundaries.outlet.%s", key[k]);
        add_key(list, AS_MPM, side);
        if (end == 0) add_key(list, AS_MPM, both);
        if (end == 0 && axis == 0) add_key(list, AS_MPM, all);
    }
}

static void remark_inviscid_walls(const unused_list *list)
{
    const scene *s = list->s;
    for (int m = 0; m < s->n_materials; ++m)
        if (s->material[m].kind == MATERIAL_FLUID && s->material[m].shear_viscosity > 0.0) return;
    for (int a = 0; a < s->mesh.dim && s->coupling == COUPLING_ICE; ++a)
        for (int i = 0; i < 2; ++i)
            if (s->bc.side[a][i].kind == BC_NO_SLIP) {
                char path[PATH_SIZE];
                (void)snprintf(path, sizeof path, "boundaries.%s.%s", mesh_axis_name(s->mesh.geometry, a),
                               name_of_end[i]);
                say_at(list, path,
                       "no fluid is viscous: 'no_slip' sides let the fluid slip. Give it a 'viscosity', or "
                       "take 'slip'");
                return;
            }
}

void scene_remark_unused(const scene *s, remark_sink *say, void *user)
{
    const unused_list list = {.s = s, .say = say, .user = user};
    add_scene_keys(&list);
    add_losses(&list);
    add_tracers(&list);
    add_filter_order(&list);
    add_reference_pressure(&list);
    for (int m = 0; m < s->n_materials; ++m) add_material_keys(&list, &s->material[m]);
    for (int b = 0; b < s->n_bodies; ++b) add_body_keys(&list, &s->body[b]);
    for (int a = 0; a < s->mesh.dim; ++a)
        for (int i = 0; i < 2; ++i)
            if (s->bc.side[a][i].kind == BC_OUTLET) add_outlet_keys(&list, a, i);
    remark_inviscid_walls(&list);
    remark_idle_materials(&list);
}
