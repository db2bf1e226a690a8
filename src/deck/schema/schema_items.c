/* Materials, bodies, loads, probes and tracers. */
#include "deck/deck_internal.h"
#include "scene/formula.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- materials ---- */

static bool material_is_fluid(const scene *s, const void *material)
{
    (void)s;
    return ((const scene_material *)material)->kind == MATERIAL_FLUID;
}

static bool material_is_solid(const scene *s, const void *material)
{
    return !material_is_fluid(s, material);
}

static bool material_is_membrane(const scene *s, const void *material)
{
    return material_is_solid(s, material) && ((const scene_material *)material)->membrane;
}

static bool material_has_law(const scene *s, const void *material)
{
    return material_is_solid(s, material) && !((const scene_material *)material)->membrane;
}

static bool material_conducts(const scene *s, const void *material)
{
    return !material_is_membrane(s, material);
}

static const char solids_only[] = "solids: materials with a 'law' or a 'membrane' and no 'eos'";
static const char laws_only[] = "solids: materials without 'membrane' and 'eos'";
static const char membranes_only[] = "membranes: materials with a 'membrane'";
static const char conductors_only[] = "fluids and solids: materials with an 'eos' or a 'law'";
static const char fluids_only[] = "fluids: materials with an 'eos'";

static const key_spec viscosity_keys[] = {
    {"shear", KEY_NUMBER, "Pa s", PARAM_NONNEGATIVE, AT(scene_material, shear_viscosity), .fallback = "0",
     .doc = "shear viscosity"},
    {"bulk", KEY_NUMBER, "Pa s", PARAM_NONNEGATIVE, AT(scene_material, bulk_viscosity), .fallback = "0",
     .doc = "bulk viscosity lambda + 2 mu / 3"},
};
static const key_table viscosity_table = TABLE(viscosity_keys);

static const key_spec artificial_keys[] = {
    {"linear", KEY_NUMBER, NULL, WITHIN(0.0, 100.0), AT(scene_material, artificial_linear), .fallback = "0",
     .doc = "A1, linear in the compression rate"},
    {"quadratic", KEY_NUMBER, NULL, WITHIN(0.0, 100.0), AT(scene_material, artificial_quadratic), .fallback = "0",
     .doc = "A2, quadratic in the compression rate"},
};
static const key_table artificial_table = TABLE(artificial_keys);

static const key_spec material_keys[] = {
    {"membrane", KEY_MODEL, .family = &family_membrane, .applies = material_is_solid, .belongs = solids_only,
     .doc = "law of a membrane or string: what it needs to be one"},
    {"one_way", KEY_BOOL, AT(scene_material, one_way), .fallback = "false", .applies = material_is_membrane,
     .belongs = membranes_only, .doc = "true: it wrinkles instead of bearing compression"},
    {"law", KEY_MODEL, .family = &family_law, .applies = material_has_law, .belongs = laws_only,
     .doc = "law of a solid: what it needs to be one"},
    {"eos", KEY_MODEL, AT(scene_material, eos), .family = &family_eos, .applies = material_is_fluid,
     .belongs = fluids_only, .doc = "equation of state of a fluid: what it needs to be one"},
    {"density", KEY_NUMBER, "kg/m3", PARAM_POSITIVE, AT(scene_material, density), .required = true,
     .applies = material_is_solid, .belongs = solids_only, .doc = "density at rest"},
    {"specific_heat", KEY_NUMBER, "J/kg/K", PARAM_POSITIVE, AT(scene_material, specific_heat),
     .applies = material_is_solid, .belongs = solids_only,
     .otherwise = "not used; needed by ice-mpm, and by solids with a temperature",
     .doc = "specific heat of a solid. Its points carry a temperature where something heats it or responds to that: "
            "with `conductivity`, `plastic_heat`, `expansion`, a law that depends on temperature, or heat exchange "
            "with a fluid"},
    {"tension_switch", KEY_NUMBER, "Pa", PARAM_POSITIVE, AT(scene_material, tension_switch),
     .applies = material_is_solid, .belongs = solids_only, .otherwise = "the ambient pressure",
     .doc = "absolute pressure below which the cells' view of the solid switches to its tension branch"},
    {"viscosity", KEY_MAP, .table = &viscosity_table, .applies = material_is_fluid, .belongs = fluids_only,
     .doc = "viscosity of a fluid"},
    {"conductivity", KEY_NUMBER, "W/m/K", PARAM_NONNEGATIVE, AT(scene_material, conductivity), .fallback = "0",
     .applies = material_conducts, .belongs = conductors_only,
     .doc = "thermal conductivity of a fluid on the cells, or of a solid; a fluid and a solid that both have one "
            "exchange heat through a sharp surface"},
    {"plastic_heat", KEY_NUMBER, NULL, WITHIN(0.0, 1.0), AT(scene_material, plastic_heat), .applies = material_has_law,
     .belongs = laws_only, .otherwise = "0.9 of solids that have a temperature",
     .doc = "share of plastic work that heats the solid (Taylor and Quinney); the rest is stored"},
    {"expansion", KEY_NUMBER, "1/K", WITHIN(-0.1, 0.1), AT(scene_material, expansion), .fallback = "0",
     .applies = material_has_law, .belongs = laws_only,
     .doc = "linear thermal expansion: an unloaded solid is longer by this share for each kelvin"},
    {"stress_free_temperature", KEY_NUMBER, "K", PARAM_POSITIVE, AT(scene_material, stress_free_temperature),
     .applies = material_has_law, .belongs = laws_only, .otherwise = "that of each point at the start",
     .doc = "at which a solid with `expansion`, or with a Mie-Grueneisen pressure, has its shape without stress"},
    {"artificial_viscosity", KEY_MAP, .table = &artificial_table,
     .doc = "Wilkins' artificial viscosity of material points"},
};
static const key_table material_table = TABLE(material_keys);

static floe_status begin_material(reader *r, deck_node *node, void *item)
{
    scene_material *m = item;
    m->density = m->specific_heat = m->tension_switch = NAN;
    m->plastic_heat = m->stress_free_temperature = NAN;
    const bool law = node_find(node, "law") || node_find(node, "membrane");
    const bool solid = !node_find(node, "eos") && (law || node_find(node, "density"));
    m->kind = solid ? MATERIAL_SOLID : MATERIAL_FLUID;
    if (node->kind != NODE_MAP || node_find(node, "eos") || law) return FLOE_OK;
    return bad_key(r, node,
                   "law: {...} for a solid (membrane: {...} for a string or membrane), or eos: {...} for a fluid", NULL,
                   "material '%.60s' has neither 'law' nor 'eos'", node->key);
}

const named_items items_materials = {
    .noun = "material",
    .item_size = sizeof(scene_material),
    .count_offset = offsetof(scene, n_materials),
    .most = SCENE_MAX_MATERIALS,
    .table = &material_table,
    .begin = begin_material,
};

/* ---- bodies ---- */

static bool body_is_fluid(const scene *s, const void *body)
{
    const int material = ((const scene_body *)body)->material;
    return material < 0 || s->material[material].kind == MATERIAL_FLUID; /* unknown: no second error */
}

static bool body_has_shape(const scene *s, const void *body)
{
    return !body_is_membrane(s, body);
}

static bool body_is_solid(const scene *s, const void *body)
{
    return !body_is_fluid(s, body) || ((const scene_body *)body)->material < 0;
}

static bool body_has_stress(const scene *s, const void *body)
{
    return body_is_solid(s, body) && body_has_shape(s, body);
}

static const char stressed_bodies[] = "bodies made of a solid that is no membrane";
static const char solid_bodies[] = "bodies made of a solid";
static const char fluid_bodies[] = "bodies made of a fluid";
static const char shaped_bodies[] = "bodies that are no membranes: a membrane lies along its curve";
static const char membrane_bodies[] = "bodies made of a material with a membrane law";

static const choice state_choices[] = {
    {"given", 0, "by the keys of the body"},
    {"exact", 1, "by the exact solution of `verify` at t = 0; a temperature of the body goes before its density"},
    {0},
};
static const choice seeding_choices[] = {
    {"fitted", SEED_FITTED, "points fill the shape: each has the part of its sub-cell that is inside"},
    {"lattice", SEED_LATTICE, "whole sub-cells whose centre is inside, as in the papers"},
    {0},
};

static const key_spec body_keys[] = {
    {"material", KEY_MATERIAL, AT(scene_body, material), .required = true, .doc = "what it is made of"},
    {"shape", KEY_MODEL, AT(scene_body, shape), .family = &family_shape, .required = true, .applies = body_has_shape,
     .belongs = shaped_bodies, .doc = "where it is"},
    {"membrane", KEY_MAP, AT(scene_body, membrane), .table = &membrane_table, .required = true,
     .present = 1 + offsetof(scene_body, membrane.present), .applies = body_is_membrane, .belongs = membrane_bodies,
     .doc = "where a membrane or string lies, and how it is made"},
    {"velocity", KEY_VECTOR, "m/s", AT(scene_body, velocity), .varies = VARIES_BY_PLACE, .otherwise = "0",
     .doc = "at the start"},
    {"motion", KEY_SPECIAL, AT(scene_body, motion), .special = &special_motion, .applies = body_is_solid,
     .belongs = solid_bodies, .otherwise = "by its law",
     .doc =
         "of a solid that does not deform: fixed, moved as prescribed, or a free rigid body. A table is linear between "
         "its times and constant beyond them; the spin is about a point that moves with the velocity, in space about "
         "an "
         "axis that stays; a rigid body starts with its `velocity` and that spin about its centre of mass"},
    {"stress", KEY_NUMBERS, "Pa", AT(scene_body, stress), .varies = VARIES_BY_PLACE, .applies = body_has_stress,
     .belongs = stressed_bodies, .otherwise = "0",
     .doc = "at the start, beside reference_pressure, tension positive: xx, yy, zz, xy, yz, zx, of which the plane has "
            "no yz "
            "and zx; about an axis rr, zz, that around it, rz. It is in balance only if loads and what holds the body "
            "make it so"},
    {"pressure", KEY_NUMBER, "Pa", AT(scene_body, pressure), .varies = VARIES_BY_PLACE, .applies = body_is_fluid,
     .belongs = fluid_bodies,
     .doc = "absolute, at the start, to which gravity adds the weight above unless it is a formula; a fluid "
            "needs two of pressure, temperature, density"},
    {"temperature", KEY_NUMBER, "K", PARAM_POSITIVE, AT(scene_body, temperature), .varies = VARIES_BY_PLACE,
     .otherwise = "solids: the ambient temperature, or 300",
     .doc = "at the start; of solids used with heat exchange, conduction, plastic heat or expansion"},
    {"density", KEY_NUMBER, "kg/m3", PARAM_POSITIVE, AT(scene_body, density), .varies = VARIES_BY_PLACE,
     .applies = body_is_fluid, .belongs = fluid_bodies, .doc = "at the start"},
    {"fraction", KEY_NUMBER, NULL, WITHIN(1e-12, 1.0), AT(scene_body, fraction), .varies = VARIES_BY_PLACE,
     .fallback = "1", .applies = body_is_fluid, .belongs = fluid_bodies,
     .doc = "share of its shape's volume that it takes, in cells; the rest is left to bodies after it and the ambient"},
    {"state", KEY_CHOICE, AT(scene_body, initial_from_exact), .fallback = "given", .choices = state_choices,
     .doc = "where the state at the start comes from"},
    {"yields", KEY_BOOL, AT(scene_body, yields), .fallback = "false", .applies = body_has_shape,
     .belongs = shaped_bodies,
     .doc = "true: it is left out where it overlaps other solids, or other fluids if it is one; fluids always yield to "
            "solids, and else to the fluids before them; solids that overlap otherwise are refused"},
    {"points", KEY_WHOLES, WITHIN(1, 16), AT(scene_body, per_cell), .fallback = "2",
     .doc =
         "material points along each axis of a cell; of a membrane, along it. Without it solids that are long and "
         "thin, with less than 10 points across, have 4 a cell across, where 2 would be soft as they bend; membranes "
         "have 8 along a curve and 4 on a surface"},
    {"seeding", KEY_CHOICE, AT(scene_body, seeding), .fallback = "fitted", .choices = seeding_choices,
     .doc = "how points are placed"},
    {"merge", KEY_NUMBER, NULL, WITHIN(0.0, 1.0), AT(scene_body, merge), .fallback = "0.3",
     .doc = "fitted seeding: a point with less than this fraction of a sub-cell joins its neighbour"},
};
static const key_table body_table = TABLE(body_keys);

static floe_status begin_body(reader *r, deck_node *node, void *item)
{
    (void)r;
    (void)node;
    scene_body *b = item;
    b->material = -1;
    b->pressure = b->temperature = b->density = NAN;
    b->membrane.length = b->membrane.heavy_mass = NAN;
    b->membrane.encloses = -1;
    return FLOE_OK;
}

/* Pressure from density and temperature, so that a body's state is always given with its pressure. */
static void resolve_state(const scene_material *m, scene_body *b)
{
    double e, c2;
    m->eos.model->energy(m->eos.par, 1, &b->density, &b->temperature, &e);
    m->eos.model->pressure(m->eos.par, 1, &b->density, &e, &b->pressure, &c2);
    b->temperature = NAN;
}

static floe_status end_solid(reader *r, deck_node *node, const scene_body *b)
{
    if (b->motion.kind != MOTION_BY_LAW && scene_varies(r->scene, b->velocity, sizeof b->velocity))
        return bad_key(r, node_find(node, "velocity"), "a list of numbers", NULL,
                       "a body that does not deform has one velocity, and its spin");
    return FLOE_OK;
}

static floe_status end_body(reader *r, deck_node *node, void *item)
{
    scene_body *b = item;
    if (b->membrane.present && !node->bad) TRY(end_membrane(r, node, b));
    if (b->material < 0 || node->bad) return FLOE_OK;
    if (r->scene->material[b->material].kind == MATERIAL_SOLID) return end_solid(r, node, b);
    const int given = !isnan(b->pressure) + !isnan(b->temperature) + !isnan(b->density);
    if (given == 3) {
        return bad_key(r, node, "two of pressure, temperature, density", "the equation of state gives the third",
                       "fluid body '%s' has pressure, temperature and density", b->name);
    }
    if (given < 2 && !b->initial_from_exact) {
        return bad_key(r, node, "two of pressure, temperature, density; or 'state: exact'", NULL,
                       "fluid body '%s' has no state", b->name);
    }
    const bool varies = scene_formula_of(r->scene, &b->density) || scene_formula_of(r->scene, &b->temperature);
    if (given == 2 && isnan(b->pressure) && !varies && r->scene->material[b->material].eos.model) {
        resolve_state(&r->scene->material[b->material], b);
    }
    return FLOE_OK;
}

const named_items items_bodies = {
    .noun = "body",
    .item_size = sizeof(scene_body),
    .count_offset = offsetof(scene, n_bodies),
    .most = SCENE_MAX_BODIES,
    .table = &body_table,
    .begin = begin_body,
    .end = end_body,
};

/* ---- loads ---- */

#define RAMP_KEYS                                                                                                    \
    {"start", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(scene_load, start), .fallback = "0", .doc = "the load begins"}, \
        {"ramp",                                                                                                     \
         KEY_NUMBER,                                                                                                 \
         "s",                                                                                                        \
         PARAM_NONNEGATIVE,                                                                                          \
         AT(scene_load, ramp),                                                                                       \
         .fallback = "0",                                                                                            \
         .doc = "time over which it grows from nothing, in proportion; 0: at once"},                                 \
        {"ramp_steps",                                                                                               \
         KEY_WHOLE,                                                                                                  \
         NULL,                                                                                                       \
         WITHIN(0, 1e9),                                                                                             \
         AT(scene_load, ramp_steps),                                                                                 \
         .fallback = "0",                                                                                            \
         .doc = "steps over which it grows, instead of a time; 0: not used"},                                        \
    {                                                                                                                \
        "hold", KEY_BOOL, AT(scene_load, hold), .fallback = "false"

static const key_spec pressurise_keys[] = {
    {"material", KEY_MATERIAL, AT(scene_load, material), .required = true, .doc = "the fluid that is heated"},
    {"region", KEY_MODEL, AT(scene_load, region), .family = &family_shape, .otherwise = "everywhere", .doc = "where"},
    {"target", KEY_NUMBER, "Pa", PARAM_POSITIVE, AT(scene_load, target), .required = true,
     .doc = "pressure to be reached, above reference_pressure"},
    RAMP_KEYS,
    .doc = "true: the pressure is kept after the ramp; false: no energy is added any more"},
}
;
static const key_table pressurise_table = TABLE(pressurise_keys);

static const key_spec heat_keys[] = {
    {"material", KEY_MATERIAL, AT(scene_load, material), .required = true, .doc = "the fluid that is heated"},
    {"region", KEY_MODEL, AT(scene_load, region), .family = &family_shape, .otherwise = "everywhere", .doc = "where"},
    {"power", KEY_NUMBER, "W/m3", AT(scene_load, target), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .required = true,
     .doc = "power per volume"},
    RAMP_KEYS,
    .doc = "true: the power stays on after the ramp; false: it is then off"},
}
;
static const key_table heat_table = TABLE(heat_keys);

static const key_spec traction_keys[] = {
    {"body", KEY_BODY, AT(scene_load, body), .required = true, .doc = "the body that is loaded"},
    {"surface", KEY_MODEL, AT(scene_load, region), .family = &family_shape, .required = true,
     .doc = "the surface of this shape is loaded; the body lies on one side of it"},
    {"pressure", KEY_NUMBER, "Pa", AT(scene_load, target), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .fallback = "0",
     .doc =
         "normal pressure on it, above reference_pressure; compression positive. It follows the surface, as that of a "
         "gas does"},
    {"dead", KEY_BOOL, AT(scene_load, dead), .fallback = "false",
     .doc = "true: the pressure acts on the areas and along the normals at the start"},
    {"vector", KEY_VECTOR, "Pa", AT(scene_load, vector), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .otherwise = "0",
     .doc = "force per area at the start, in this direction for good, whatever the body does: shear, a pull; with a "
            "pressure, beside it"},
    {"start", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(scene_load, start), .fallback = "0", .doc = "the load begins"},
    {"ramp", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(scene_load, ramp), .fallback = "0",
     .doc = "time over which it grows from nothing, in proportion; 0: at once"},
};
static const key_table traction_table = TABLE(traction_keys);

static const key_spec gravity_keys[] = {
    {"acceleration", KEY_VECTOR, "m/s2", AT(scene_load, vector), .varies = VARIES_BY_TIME, .required = true,
     .doc = "of everything"},
};
static const key_table gravity_table = TABLE(gravity_keys);

static const key_spec body_force_keys[] = {
    {"body", KEY_BODY, AT(scene_load, body), .otherwise = "everything", .doc = "the body that it acts on"},
    {"region", KEY_MODEL, AT(scene_load, region), .family = &family_shape, .otherwise = "everywhere",
     .doc = "where it acts: a place in space, through which bodies and fluids may move"},
    {"acceleration", KEY_VECTOR, "m/s2", AT(scene_load, vector), .varies = VARIES_BY_PLACE + VARIES_BY_TIME,
     .required = true, .doc = "force per mass; in formulas x, y and z are where the material is now"},
};
static const key_table body_force_table = TABLE(body_force_keys);

enum { GRAVITY = 100 }; /* a LOAD_BODY_FORCE on everything */

static const variant load_list[] = {
    {"pressurise", LOAD_PRESSURISE, &pressurise_table,
     "energy into a fluid until its pressure has reached a target, along a ramp"},
    {"heat", LOAD_HEAT, &heat_table, "energy into a fluid at a given power"},
    {"traction", LOAD_TRACTION, &traction_table, "pressure, shear or pull on a surface of a body of material points"},
    {"gravity", GRAVITY, &gravity_table, "acceleration of everything"},
    {"body_force", LOAD_BODY_FORCE, &body_force_table,
     "force per mass on a body or on everything, in a region or everywhere"},
};

static void choose_load(void *field, int value)
{
    scene_load *load = field;
    load->kind = value == GRAVITY ? LOAD_BODY_FORCE : (load_kind)value;
    load->gravity = value == GRAVITY;
}

static int chosen_load(const void *field)
{
    const scene_load *load = field;
    return load->gravity ? GRAVITY : (int)load->kind;
}

static const variants load_kinds = {"load", load_list, sizeof load_list / sizeof load_list[0], choose_load,
                                    chosen_load};

static floe_status begin_load(reader *r, deck_node *node, void *item)
{
    (void)r;
    (void)node;
    scene_load *load = item;
    load->material = load->body = -1;
    return FLOE_OK;
}

const named_items items_loads = {
    .noun = "load",
    .item_size = sizeof(scene_load),
    .count_offset = offsetof(scene, n_loads),
    .most = SCENE_MAX_LOADS,
    .variants = &load_kinds,
    .begin = begin_load,
};

/* ---- probes ---- */

static const key_spec probe_value = {"position", KEY_VECTOR, "m", AT(scene_probe, position), .doc = "a place"};

const named_items items_probes = {
    .noun = "probe",
    .item_size = sizeof(scene_probe),
    .count_offset = offsetof(scene, n_probes),
    .most = SCENE_MAX_PROBES,
    .value = &probe_value,
};

/* ---- tracers ---- */

static const key_spec tracer_keys[] = {
    {"body", KEY_BODY, AT(scene_tracer, body), .required = true, .doc = "the body that it moves with"},
    {"position", KEY_VECTOR, "m", AT(scene_tracer, position), .required = true,
     .doc = "at the start, in the body or on its surface"},
};
static const key_table tracer_table = TABLE(tracer_keys);

static floe_status begin_tracer(reader *r, deck_node *node, void *item)
{
    (void)r;
    (void)node;
    ((scene_tracer *)item)->body = -1;
    return FLOE_OK;
}

const named_items items_tracers = {
    .noun = "tracer",
    .item_size = sizeof(scene_tracer),
    .count_offset = offsetof(scene, n_tracers),
    .most = SCENE_MAX_TRACERS,
    .table = &tracer_table,
    .begin = begin_tracer,
};
