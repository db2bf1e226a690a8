/* boundaries: {x: {lower: symmetry, upper: {outlet: {...}}}, y: periodic}, or one kind for every side. */
#include "deck/deck_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const key_spec inlet_keys[] = {
    {"velocity", KEY_VECTOR, "m/s", AT(bc_side, velocity), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .required = true,
     .doc = "of what enters"},
    {"pressure", KEY_NUMBER, "Pa", AT(bc_side, pressure), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .required = true,
     .doc = "absolute, of what enters"},
    {"temperature", KEY_NUMBER, "K", PARAM_POSITIVE, AT(bc_side, temperature),
     .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .required = true, .doc = "of what enters"},
    {"material", KEY_MATERIAL, AT(bc_side, material), .otherwise = "the fluid, where there is one only",
     .doc = "what enters"},
};
static const key_table inlet_table = TABLE(inlet_keys);

static const key_spec outlet_keys[] = {
    {"pressure", KEY_NUMBER, "Pa", AT(bc_side, pressure), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .required = true,
     .doc = "absolute, at the faces"},
    {"temperature", KEY_NUMBER, "K", PARAM_POSITIVE, AT(bc_side, temperature),
     .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .otherwise = "of an ambient that does not move in, else that inside",
     .doc = "of the fluid at rest behind, should flow turn back"},
    {"material", KEY_MATERIAL, AT(bc_side, material), .otherwise = "the fluid, where there is one only",
     .doc = "what is behind"},
};
static const key_table outlet_table = TABLE(outlet_keys);

static const key_spec non_reflecting_keys[] = {
    {"pressure", KEY_NUMBER, "Pa", AT(bc_side, pressure), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .required = true,
     .doc = "absolute, far outside"},
    {"velocity", KEY_VECTOR, "m/s", AT(bc_side, velocity), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .otherwise = "0",
     .doc = "far outside"},
    {"temperature", KEY_NUMBER, "K", PARAM_POSITIVE, AT(bc_side, temperature),
     .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .otherwise = "of the ambient, else that inside",
     .doc = "outside, should flow turn back"},
    {"material", KEY_MATERIAL, AT(bc_side, material), .otherwise = "the fluid, where there is one only",
     .doc = "what is outside"},
};
static const key_table non_reflecting_table = TABLE(non_reflecting_keys);

static const key_spec reservoir_keys[] = {
    {"pressure", KEY_NUMBER, "Pa", AT(bc_side, pressure), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .required = true,
     .doc = "absolute, of the fluid at rest"},
    {"temperature", KEY_NUMBER, "K", PARAM_POSITIVE, AT(bc_side, temperature),
     .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .required = true, .doc = "of the fluid at rest"},
    {"material", KEY_MATERIAL, AT(bc_side, material), .otherwise = "the fluid, where there is one only",
     .doc = "what enters"},
};
static const key_table reservoir_table = TABLE(reservoir_keys);

#define WALL_HEAT_KEYS                                                                                         \
    {"temperature",                                                                                            \
     KEY_NUMBER,                                                                                               \
     "K",                                                                                                      \
     PARAM_POSITIVE,                                                                                           \
     AT(bc_side, temperature),                                                                                 \
     .varies = VARIES_BY_PLACE + VARIES_BY_TIME,                                                               \
     .otherwise = "an insulated wall",                                                                         \
     .doc = "of the wall, for fluids and solids that conduct heat"},                                           \
    {                                                                                                          \
        "heat_flux", KEY_NUMBER, "W/m2", AT(bc_side, heat_flux),                                               \
            .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .otherwise = "0",                                      \
            .doc = "heat that the wall gives to fluids and solids that conduct heat, instead of a temperature" \
    }

static const key_spec no_slip_keys[] = {
    {"velocity", KEY_VECTOR, "m/s", AT(bc_side, velocity), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .otherwise = "0",
     .doc = "of the wall, along itself"},
    WALL_HEAT_KEYS,
};
static const key_table no_slip_table = TABLE(no_slip_keys);

static const key_spec slip_keys[] = {WALL_HEAT_KEYS};
static const key_table slip_table = TABLE(slip_keys);

static const key_spec velocity_keys[] = {
    {"velocity", KEY_VECTOR, "m/s", AT(bc_side, velocity), .varies = VARIES_BY_PLACE + VARIES_BY_TIME, .required = true,
     .doc = "imposed"},
    {"start", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(bc_side, course.start), .fallback = "0",
     .doc = "the motion begins"},
    {"ramp", KEY_NUMBER, "s", PARAM_NONNEGATIVE, AT(bc_side, course.ramp), .fallback = "0",
     .doc = "time in which the velocity is reached, along half a cosine; 0: at once"},
    {"frequency", KEY_NUMBER, "Hz", PARAM_NONNEGATIVE, AT(bc_side, course.frequency), .fallback = "0",
     .doc = "the velocity swings with a sine of this frequency; 0: it stays"},
};
static const key_table velocity_table = TABLE(velocity_keys);

static const variant side_list[] = {
    {"symmetry", BC_SYMMETRY, NULL, "a mirror, beyond which all goes on as its image; it never lets go"},
    {"slip", BC_SLIP, &slip_table,
     "an impermeable wall without friction, which solids leave as they come; to a fluid the same as symmetry"},
    {"no_slip", BC_NO_SLIP, &no_slip_table, "an impermeable wall that carries the fluid along"},
    {"periodic", BC_PERIODIC, NULL, "what leaves here enters at the opposite side"},
    {"inlet", BC_INLET, &inlet_table, "a fluid enters"},
    {"outlet", BC_OUTLET, &outlet_table, "a fluid leaves against a given pressure"},
    {"velocity", BC_VELOCITY, &velocity_table,
     "points move as imposed; a fluid has this velocity at the side, and enters or leaves with it"},
    {"reservoir", BC_RESERVOIR, &reservoir_table, "a fluid enters from rest, at total pressure and temperature"},
    {"non_reflecting", BC_NON_REFLECTING, &non_reflecting_table, "a fluid leaves, and its waves with it"},
    {"free", BC_FREE, NULL, "nothing is imposed"},
};

static void choose_side(void *field, int value)
{
    bc_side *side = field;
    *side = (bc_side){.kind = (bc_kind)value, .temperature = NAN, .material = -1};
}

static int chosen_side(const void *field)
{
    return (int)((const bc_side *)field)->kind;
}

const variants boundary_kinds = {"boundary condition", side_list, sizeof side_list / sizeof side_list[0], choose_side,
                                 chosen_side};

const char *axis_name(const mesh_spec *spec, int axis)
{
    return mesh_axis_name(spec->geometry, axis);
}

static const char *candidate_axis_name(const void *user, size_t i)
{
    const mesh_spec *spec = user;
    return i < (size_t)spec->dim ? axis_name(spec, (int)i) : NULL;
}

static const char *side_candidate(const void *user, size_t i)
{
    (void)user;
    static const char *const name[] = {"lower", "upper", NULL};
    return i < 2 ? name[i] : NULL;
}

/* true for a kind by itself, or {kind: {keys}}. */
static bool is_kind(const deck_node *node)
{
    if (node->kind == NODE_SCALAR) return true;
    if (node->kind != NODE_MAP || node->n != 1) return false;
    for (size_t i = 0; i < boundary_kinds.n; i++) {
        if (strcmp(boundary_kinds.list[i].name, node->first->key) == 0) return true;
    }
    return false;
}

/* One kind for several sides that follow each other. Each is read, for formulas are those of one number. */
static floe_status read_alike(reader *r, deck_node *node, bc_side *side, int n)
{
    for (int i = 0; i < n && !node->bad; i++) TRY(read_variant(r, &boundary_kinds, node, &side[i]));
    return FLOE_OK;
}

static floe_status read_boundary_axis(reader *r, deck_node *node, bc_side side[2])
{
    if (is_kind(node)) return read_alike(r, node, side, 2);
    if (node->kind != NODE_MAP) {
        return bad(r, node, "a kind, or {lower: ..., upper: ...}", "boundary '%.60s' is a list", node->key);
    }
    for (deck_node *child = node->first; child; child = child->next) {
        const bool lower = strcmp(child->key, "lower") == 0;
        if (node_find(node, child->key) != child) {
            TRY(bad_key(r, child, NULL, NULL, "duplicate key '%.80s' (first at line %d, column %d)", child->key,
                        node_find(node, child->key)->key_at.line, node_find(node, child->key)->key_at.column));
        } else if (!lower && strcmp(child->key, "upper") != 0) {
            TRY(bad_name(r, child, true, "side", side_candidate, NULL));
        } else {
            TRY(read_variant(r, &boundary_kinds, child, &side[lower ? SIDE_LOWER : SIDE_UPPER]));
        }
    }
    return FLOE_OK;
}

static void set_free(scene *s)
{
    for (int axis = 0; axis < MESH_MAX_DIM; axis++) {
        for (int side = 0; side < 2; side++) choose_side(&s->bc.side[axis][side], BC_FREE);
    }
    const bool at_axis = s->mesh.geometry == MESH_AXISYMMETRIC && s->mesh.lower[0] == 0.0;
    if (at_axis) choose_side(&s->bc.side[0][SIDE_LOWER], BC_SYMMETRY);
}

static int find_axis(const mesh_spec *spec, const char *name)
{
    for (int axis = 0; axis < spec->dim; axis++) {
        const char *own = axis_name(spec, axis);
        if (own && strcmp(own, name) == 0) return axis;
    }
    return -1;
}

static floe_status read_boundaries(reader *r, const key_spec *key, deck_node *node, void *base)
{
    (void)key;
    scene *s = base;
    set_free(s);
    if (!node) return FLOE_OK;
    if (is_kind(node)) return read_alike(r, node, s->bc.side[0], 2 * s->mesh.dim);
    if (node->kind != NODE_MAP) return bad(r, node, special_boundaries.form, "'boundaries' is a list");
    for (deck_node *child = node->first; child; child = child->next) {
        const int axis = find_axis(&s->mesh, child->key);
        const deck_node *first = node_find(node, child->key);
        if (first != child) {
            TRY(bad_key(r, child, NULL, NULL, "duplicate key '%.80s' (first at line %d, column %d)", child->key,
                        first->key_at.line, first->key_at.column));
        } else if (axis < 0) {
            TRY(bad_name(r, child, true, "axis", candidate_axis_name, &s->mesh));
        } else {
            TRY(read_boundary_axis(r, child, s->bc.side[axis]));
        }
    }
    return FLOE_OK;
}

static void write_boundaries(writer *w, const key_spec *key, const void *base)
{
    const scene *s = base;
    write_key_name(w, key->key);
    strbuf_append(&w->out, "\n");
    w->indent++;
    for (int axis = 0; axis < s->mesh.dim; axis++) {
        write_key_name(w, axis_name(&s->mesh, axis));
        strbuf_append(&w->out, "\n");
        w->indent++;
        for (int side = 0; side < 2; side++) {
            write_key_name(w, side == SIDE_LOWER ? "lower" : "upper");
            write_variant(w, &boundary_kinds, &s->bc.side[axis][side]);
        }
        w->indent--;
    }
    w->indent--;
}

const special_key special_boundaries = {
    .read = read_boundaries,
    .write = write_boundaries,
    .form = "{x: {lower: kind, upper: kind}, y: kind, ...} (r, z when axisymmetric), or one kind for every side",
    .json = NULL,
};

/* ---- parts of sides ---- */

/* "x.lower" */
static floe_status read_side_name(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_side_part *part = base;
    const mesh_spec *spec = &r->scene->mesh;
    if (!node) return FLOE_OK; /* required: an error has been entered */
    for (int k = 0; node->kind == NODE_SCALAR && k < 2 * spec->dim; k++) {
        char name[16];
        snprintf(name, sizeof name, "%s.%s", axis_name(spec, k / 2), k % 2 == SIDE_LOWER ? "lower" : "upper");
        if (strcmp(node->text, name) != 0) continue;
        part->axis = k / 2;
        part->end = k % 2;
        return FLOE_OK;
    }
    return bad_form(r, key, node, key->special->form);
}

static void write_side_name(writer *w, const key_spec *key, const void *base)
{
    const scene_side_part *part = base;
    write_key_name(w, key->key);
    strbuf_append(&w->out, " %s.%s\n", axis_name(&w->scene->mesh, part->axis),
                  part->end == SIDE_LOWER ? "lower" : "upper");
}

static const special_key special_side = {
    .read = read_side_name,
    .write = write_side_name,
    .form = "x.lower, x.upper, y.lower, ... (r, z when axisymmetric)",
    .json = "{\"type\": \"string\"}",
};

static const key_spec part_keys[] = {
    {"side", KEY_SPECIAL, .special = &special_side, .required = true, .doc = "the side that it is part of"},
    {"where", KEY_MODEL, AT(scene_side_part, where), .family = &family_shape, .required = true,
     .doc = "faces of the side whose middle is in this shape; of several parts the first"},
    {"condition", KEY_VARIANT, AT(scene_side_part, condition), .variants = &boundary_kinds, .required = true,
     .doc = "what holds there instead of the side's own condition"},
};
static const key_table part_table = TABLE(part_keys);

static floe_status begin_part(reader *r, deck_node *node, void *item)
{
    (void)r;
    (void)node;
    choose_side(&((scene_side_part *)item)->condition, BC_FREE);
    return FLOE_OK;
}

const named_items items_parts = {
    .noun = "part of a side",
    .item_size = sizeof(scene_side_part),
    .count_offset = offsetof(scene, n_parts),
    .most = SCENE_MAX_PARTS,
    .table = &part_table,
    .begin = begin_part,
};
