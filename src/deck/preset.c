#include "deck/preset.h"

#include <string.h>

typedef struct preset_key {
    const char *key, *value;
    const char *with, *is; /* left out where the deck gives this key another value; NULL: never */
} preset_key;

typedef struct preset {
    const char *name;
    const preset_key *key;
    size_t n;
} preset;

/* Guilkey et al. 2003: trilinear basis functions; stress from the velocities that the points bring to the nodes, before
 * the forces (equations 6 to 8); points that take the nodes' acceleration (9); internal energy; solids as materials of the mixture, at one velocity
 * with their fluid, of which liquids do not slip either (section 2.4); faces
 * by means of both cells (steps 3 and 12). */
static const preset_key g03[] = {
    {"basis", "linear", NULL, NULL},      {"stress", "usf", NULL, NULL},
    {"transfer", "flip", NULL, NULL},     {"flip", "1", "transfer", "flip"},
    {"edge_penalty", "0", NULL, NULL},    {"energy", "internal", NULL, NULL},
    {"limiter", "van_leer", NULL, NULL},  {"pressure", "explicit", NULL, NULL},
    {"interface", "smeared", NULL, NULL}, {"exchange", "locked", "interface", "smeared"},
};

static const preset presets[] = {{"g03", g03, sizeof g03 / sizeof *g03}};

static const preset *find_preset(const char *name)
{
    for (size_t i = 0; i < sizeof presets / sizeof *presets; i++)
        if (strcmp(presets[i].name, name) == 0) return &presets[i];
    return NULL;
}

static floe_status add_scalar(deck_arena *arena, deck_node *map, const char *key, const char *value, deck_location at)
{
    deck_node *child;
    TRY(node_new(arena, &child, NODE_SCALAR, at));
    child->key = key;
    child->key_at = at;
    child->text = value;
    node_append(map, child);
    return FLOE_OK;
}

floe_status preset_open(deck_node *root, deck_arena *arena)
{
    deck_node *method = node_find(root, "method"), *map;
    if (!method || method->kind != NODE_SCALAR || node_is_null(method)) return FLOE_OK;
    TRY(node_new(arena, &map, NODE_MAP, method->at));
    TRY(add_scalar(arena, map, "preset", method->text, method->at));
    node_replace(method, map);
    return FLOE_OK;
}

static bool is_left_out(const deck_node *method, const preset_key *k)
{
    const deck_node *other = k->with ? node_find(method, k->with) : NULL;
    return node_find(method, k->key) || (other && other->kind == NODE_SCALAR && strcmp(other->text, k->is) != 0);
}

floe_status preset_expand(deck_node *root, deck_arena *arena, error_list *errors)
{
    deck_node *method = node_find(root, "method"), *given = node_find(method, "preset");
    if (!given || node_is_null(given)) return FLOE_OK; /* the schema says that a value is missing */
    const preset *p = given->kind == NODE_SCALAR ? find_preset(given->text) : NULL;
    if (!p) {
        char found[80];
        node_describe(given, found, sizeof found);
        return error_add(errors, given->at, "g03, or a map of keys: {basis: quadratic}", NULL,
                         "%.60s is no 'preset' of 'method'", found);
    }
    for (size_t k = 0; k < p->n; k++)
        if (!is_left_out(method, &p->key[k])) TRY(add_scalar(arena, method, p->key[k].key, p->key[k].value, given->at));
    return FLOE_OK;
}
