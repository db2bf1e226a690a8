/* Springs between points, and supports that hold nodes. */
#include "deck/deck_internal.h"

#include <math.h>

static bool end_has_body(const scene *s, const void *end)
{
    (void)s;
    return ((const scene_spring_end *)end)->body >= 0;
}

static const key_spec end_keys[] = {
    {"body", KEY_BODY, AT(scene_spring_end, body), .otherwise = "the end is at a fixed position",
     .doc = "that it holds on to, by a point or a position"},
    {"point", KEY_WHOLE, NULL, WITHIN(1, 2e9), AT(scene_spring_end, point), .otherwise = "the position",
     .applies = end_has_body, .belongs = "ends at a body",
     .doc = "number of the point in its body, from 1 (along the curve of a membrane)"},
    {"position", KEY_VECTOR, "m", AT(scene_spring_end, place), .formerly = "place", .otherwise = "the point",
     .doc = "where the end is fixed; with a body the place of it that is there at the start, to which the spring is "
            "fastened with force and moment (of a membrane the nearest point)"},
};
static const key_table end_table = TABLE(end_keys);

static const key_spec spring_keys[] = {
    {"from", KEY_MAP, AT(scene_spring, end[0]), .table = &end_table, .doc = "first end"},
    {"to", KEY_MAP, AT(scene_spring, end[1]), .table = &end_table, .doc = "second end"},
    {"stiffness", KEY_NUMBER, "N/m", PARAM_POSITIVE, AT(scene_spring, stiffness), .required = true,
     .doc = "force per elongation, of the whole scene (for domain.thickness, or the full circle)"},
    {"damping", KEY_NUMBER, "N s/m", PARAM_NONNEGATIVE, AT(scene_spring, damping), .fallback = "0",
     .doc = "of a dashpot beside it: force per rate of elongation, of the whole scene; with one_way while it is taut"},
    {"rest_length", KEY_NUMBER, "m", PARAM_NONNEGATIVE, AT(scene_spring, rest_length),
     .otherwise = "the distance at the start", .doc = "length without force; more than the distance: slack"},
    {"one_way", KEY_BOOL, AT(scene_spring, one_way), .fallback = "false", .doc = "true: a tether, which only pulls"},
};
static const key_table spring_table = TABLE(spring_keys);

static floe_status begin_spring(reader *r, deck_node *node, void *item)
{
    scene_spring *spring = item;
    spring->end[0].body = spring->end[1].body = -1;
    spring->rest_length = NAN;
    for (int e = 0; e < 2; e++) spring->end[e].place[0] = NAN;
    static const char *const needed[] = {"from", "to"};
    for (int e = 0; e < 2 && node->kind == NODE_MAP; e++)
        if (!node_find(node, needed[e]))
            TRY(bad_key(r, node, "from: {...} and to: {...}", NULL, "spring '%.60s' has no '%s'", node->key,
                        needed[e]));
    return FLOE_OK;
}

/* One of point and position; a fixed end has a position. */
static floe_status check_end(reader *r, deck_node *node, const char *side, scene_spring_end *end)
{
    deck_node *at = node_find(node, side);
    const bool placed = !isnan(end->place[0]);
    if (!at || at->bad || at->kind != NODE_MAP) return FLOE_OK;
    if (end->body < 0 && !placed) end->place[0] = 0.0;
    if (end->body < 0 && !placed && !node_find(at, "body"))
        return bad_key(r, at, "a position, or a body with a point or a position", NULL, "this end is nowhere");
    if (end->body >= 0 && placed == (end->point > 0))
        return bad_key(r, at, "one of point and position", NULL,
                       placed ? "this end has a point and a position" : "this end is nowhere on its body");
    return FLOE_OK;
}

static floe_status end_spring(reader *r, deck_node *node, void *item)
{
    scene_spring *spring = item;
    TRY(check_end(r, node, "from", &spring->end[0]));
    TRY(check_end(r, node, "to", &spring->end[1]));
    if (node->bad || spring->end[0].body >= 0 || spring->end[1].body >= 0) return FLOE_OK;
    return bad_key(r, node, "a body and a point at one end or both", NULL, "spring '%s' holds on to no body",
                   spring->name);
}

const named_items items_springs = {
    .noun = "spring",
    .item_size = sizeof(scene_spring),
    .count_offset = offsetof(scene, n_springs),
    .most = SCENE_MAX_SPRINGS,
    .table = &spring_table,
    .begin = begin_spring,
    .end = end_spring,
};

static const key_spec support_keys[] = {
    {"region", KEY_MODEL, AT(scene_support, region), .family = &family_shape, .required = true,
     .doc = "what lies in it is constrained, solids at its surface"},
    {"velocity", KEY_VECTOR, "m/s", AT(scene_support, velocity), .otherwise = "0", .doc = "at which it moves"},
};
static const key_table support_table = TABLE(support_keys);

const named_items items_supports = {
    .noun = "support",
    .item_size = sizeof(scene_support),
    .count_offset = offsetof(scene, n_supports),
    .most = SCENE_MAX_SUPPORTS,
    .table = &support_table,
};
