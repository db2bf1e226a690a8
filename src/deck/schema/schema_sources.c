/* Sources of mass, and vents between fluids. */
#include "deck/deck_internal.h"

#include <math.h>

static const key_spec source_keys[] = {
    {"material", KEY_MATERIAL, AT(scene_mass_source, material), .otherwise = "what the membrane `inside` encloses",
     .doc = "the fluid that comes in"},
    {"inside", KEY_BODY, AT(scene_mass_source, inside), .otherwise = "not used",
     .doc = "a membrane that encloses the fluid: the fluid comes into what it encloses"},
    {"region", KEY_MODEL, AT(scene_mass_source, region), .family = &family_shape,
     .otherwise = "everywhere that the fluid can be",
     .doc = "where: spread evenly over the volume that fluids have in this shape"},
    {"mass_rate", KEY_NUMBER, "kg/s", PARAM_NONNEGATIVE, AT(scene_mass_source, mass_rate), .varies = VARIES_BY_TIME,
     .required = true, .doc = "mass per time, of the whole scene (for domain.thickness, or the full circle)"},
    {"temperature", KEY_NUMBER, "K", PARAM_POSITIVE, AT(scene_mass_source, temperature), .varies = VARIES_BY_TIME,
     .required = true, .doc = "of what comes in, which brings its enthalpy with it"},
    {"velocity", KEY_VECTOR, "m/s", AT(scene_mass_source, velocity), .varies = VARIES_BY_TIME, .otherwise = "0",
     .doc = "of what comes in"},
    {"start", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(scene_mass_source, start), .fallback = "0", .doc = "it begins"},
    {"end", KEY_NUMBER, "s", PARAM_POSITIVE, AT(scene_mass_source, end), .otherwise = "the end of the run",
     .doc = "it ends"},
};
static const key_table source_table = TABLE(source_keys);

static floe_status begin_source(reader *r, deck_node *node, void *item)
{
    (void)r;
    (void)node;
    scene_mass_source *source = item;
    source->material = source->inside = -1;
    source->end = INFINITY;
    return FLOE_OK;
}

static floe_status end_source(reader *r, deck_node *node, void *item)
{
    scene_mass_source *source = item;
    if (node->bad) return FLOE_OK;
    if (source->inside >= 0) {
        const scene_body *bag = &r->scene->body[source->inside];
        if (!bag->membrane.present || bag->membrane.encloses < 0)
            return bad_key(r, node_find(node, "inside"), "a membrane with 'encloses'", NULL,
                           "body '%s' encloses no gas", bag->name);
        if (source->material >= 0 && source->material != bag->membrane.encloses)
            return bad_key(r, node_find(node, "material"), "the fluid that the membrane encloses", "leave it out",
                           "membrane '%s' encloses another fluid", bag->name);
        source->material = bag->membrane.encloses;
    }
    if (source->material >= 0) return FLOE_OK;
    return bad_key(r, node, "material: the name of a fluid", NULL, "source '%s' has no fluid", source->name);
}

const named_items items_sources = {
    .noun = "source",
    .item_size = sizeof(scene_mass_source),
    .count_offset = offsetof(scene, n_mass_sources),
    .most = SCENE_MAX_SOURCES,
    .table = &source_table,
    .begin = begin_source,
    .end = end_source,
};

static const key_spec side_keys[] = {
    {"material", KEY_MATERIAL, AT(scene_vent_side, material), .required = true,
     .doc = "the fluid on this side, an ideal gas. What comes through from another fluid becomes this one, with its "
            "mass and energy"},
    {"region", KEY_MODEL, AT(scene_vent_side, region), .family = &family_shape,
     .otherwise = "everywhere that the fluid is",
     .doc = "where: the mean state of the fluid in this shape drives the flow, which leaves and enters there"},
};
static const key_table side_table = TABLE(side_keys);

static const key_spec outside_keys[] = {
    {"pressure", KEY_NUMBER, "Pa", PARAM_NONNEGATIVE, AT(scene_vent, outside_pressure), .required = true,
     .doc = "absolute"},
    {"temperature", KEY_NUMBER, "K", PARAM_POSITIVE, AT(scene_vent, outside_temperature), .required = true,
     .doc = "of what comes back in"},
};
static const key_table outside_table = TABLE(outside_keys);

static const key_spec vent_keys[] = {
    {"from", KEY_MAP, AT(scene_vent, side[0]), .table = &side_table, .doc = "one side"},
    {"to", KEY_MAP, AT(scene_vent, side[1]), .table = &side_table, .present = 1 + offsetof(scene_vent, to_fluid),
     .otherwise = "`outside`", .doc = "the other side: a fluid of the cells"},
    {"outside", KEY_MAP, .table = &outside_table, .present = 1 + offsetof(scene_vent, to_outside), .otherwise = "`to`",
     .doc = "in place of `to`: surroundings that do not change"},
    {"area", KEY_NUMBER, "m2", PARAM_NONNEGATIVE, AT(scene_vent, area), .varies = VARIES_BY_TIME, .required = true,
     .doc = "of the opening, of the whole scene (for domain.thickness, or the full circle)"},
    {"discharge_coefficient", KEY_NUMBER, NULL, WITHIN(0.0, 1.0), AT(scene_vent, discharge), .fallback = "1",
     .doc = "mass that passes over that of an ideal nozzle of this area"},
    {"one_way", KEY_BOOL, AT(scene_vent, one_way), .fallback = "false",
     .doc = "true: a valve, through which nothing comes back"},
    {"start", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(scene_vent, start), .fallback = "0", .doc = "it opens"},
    {"end", KEY_NUMBER, "s", PARAM_POSITIVE, AT(scene_vent, end), .otherwise = "the end of the run",
     .doc = "it closes"},
};
static const key_table vent_table = TABLE(vent_keys);

static floe_status begin_vent(reader *r, deck_node *node, void *item)
{
    scene_vent *vent = item;
    vent->side[0].material = vent->side[1].material = -1;
    vent->end = INFINITY;
    if (node->kind == NODE_MAP && !node_find(node, "from"))
        return bad_key(r, node, "from: {material: ...}", NULL, "vent '%.60s' has no 'from'", node->key);
    return FLOE_OK;
}

static floe_status end_vent(reader *r, deck_node *node, void *item)
{
    const scene_vent *vent = item;
    if (node->bad || vent->to_fluid != vent->to_outside) return FLOE_OK;
    return bad_key(r, node, "one of to: {material: ...} and outside: {pressure: ..., temperature: ...}", NULL,
                   vent->to_fluid ? "vent '%s' leads to a fluid and outside" : "vent '%s' leads nowhere", vent->name);
}

const named_items items_vents = {
    .noun = "vent",
    .item_size = sizeof(scene_vent),
    .count_offset = offsetof(scene, n_vents),
    .most = SCENE_MAX_VENTS,
    .table = &vent_table,
    .begin = begin_vent,
    .end = end_vent,
};
