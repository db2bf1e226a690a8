/* What pairs of materials exchange. */
#include "coupling/exchange_law.h"
#include "deck/deck_internal.h"

/* ---- laws ---- */

/* The i-th model that has a law of this role. */
static bool get_law(exchange_role role, size_t i, model_entry *out)
{
    for (size_t k = 0; k < exchange_registry_size; k++) {
        const exchange_model *m = exchange_registry[k];
        const exchange_law *law = &m->law[role];
        if (!law->coefficient || i-- > 0) continue;
        *out = (model_entry){m->name, m->doc, m->cite, law->params, law->n_params, law->param_size, m};
        return true;
    }
    return false;
}

static bool momentum_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    (void)catalogue;
    return get_law(EXCHANGE_MOMENTUM, i, out);
}

static bool heat_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    (void)catalogue;
    return get_law(EXCHANGE_HEAT, i, out);
}

static void law_store(void *field, const model_entry *entry, void *par)
{
    *(scene_exchange_law *)field = (scene_exchange_law){entry->model, par};
}

static bool law_fetch(const void *field, const char **name, const void **par)
{
    const scene_exchange_law *law = field;
    if (!law->model) return false;
    *name = law->model->name;
    *par = law->par;
    return true;
}

const model_family family_momentum = {
    .noun = "exchange of momentum", .get = momentum_get, .store = law_store, .fetch = law_fetch};
const model_family family_heat = {.noun = "exchange of heat", .get = heat_get, .store = law_store, .fetch = law_fetch};

/* ---- between: [material, material] ---- */

static const char *material_candidate(const void *user, size_t i)
{
    const scene *s = user;
    return i < (size_t)s->n_materials ? s->material[i].name : NULL;
}

static floe_status read_pair(reader *r, const key_spec *key, deck_node *node, void *base)
{
    int *pair = (int *)(void *)((char *)base + key->offset);
    pair[0] = pair[1] = -1;
    if (!node) return FLOE_OK; /* `required` has said so */
    if (node->kind != NODE_LIST || node->n != 2) {
        char found[80];
        node_describe(node, found, sizeof found);
        return bad(r, node, special_pair.form, "'%s' is %s", key->key,
                   node->kind == NODE_LIST ? "a list of another length" : found);
    }
    for (int i = 0; i < 2; i++) {
        deck_node *item = node_at(node, (size_t)i);
        pair[i] = item->kind == NODE_SCALAR ? find_material(r->scene, item->text) : -1;
        if (pair[i] < 0) return bad_name(r, item, false, "material", material_candidate, r->scene);
    }
    if (pair[0] != pair[1]) return FLOE_OK;
    return bad(r, node, special_pair.form, "material '%s' is named twice", r->scene->material[pair[0]].name);
}

static void write_pair(writer *w, const key_spec *key, const void *base)
{
    const int *pair = (const int *)(const void *)((const char *)base + key->offset);
    const scene_material *material = w->scene->material;
    write_key_name(w, key->key);
    strbuf_append(&w->out, " [%s, %s]\n", material[pair[0]].name, material[pair[1]].name);
}

const special_key special_pair = {
    .read = read_pair,
    .write = write_pair,
    .form = "a list of two materials",
    .json = "{\"type\": \"array\", \"items\": {\"type\": \"string\"}, \"minItems\": 2, \"maxItems\": 2}",
};

/* ---- items ---- */

static const key_spec exchange_keys[] = {
    {"between", KEY_SPECIAL, AT(scene_exchange, material), .special = &special_pair, .required = true,
     .doc = "the two materials; laws of dispersed particles take the first as the particles"},
    {"momentum", KEY_MODEL, AT(scene_exchange, momentum), .family = &family_momentum,
     .otherwise = "constant, of method.exchange", .doc = "what holds their velocities together"},
    {"tangential", KEY_MODEL, AT(scene_exchange, tangential), .family = &family_momentum, .otherwise = "as `momentum`",
     .doc = "the same along their interface, `momentum` then being across it: `free` lets one slip along the other"},
    {"heat", KEY_MODEL, AT(scene_exchange, heat), .family = &family_heat,
     .otherwise = "constant, of method.heat_exchange", .doc = "what holds their temperatures together"},
};
static const key_table exchange_table = TABLE(exchange_keys);

static bool same_pair(const scene_exchange *a, const scene_exchange *b)
{
    return (a->material[0] == b->material[0] && a->material[1] == b->material[1]) ||
           (a->material[0] == b->material[1] && a->material[1] == b->material[0]);
}

static floe_status end_exchange(reader *r, deck_node *node, void *item)
{
    const scene_exchange *this = item;
    for (const scene_exchange *e = r->scene->exchange; e < this && !node->bad; e++)
        if (same_pair(e, this))
            return bad_key(r, node, "each pair once", NULL, "exchange '%s' is between the materials of '%s'",
                           this->name, e->name);
    return FLOE_OK;
}

const named_items items_exchanges = {
    .noun = "exchange",
    .item_size = sizeof(scene_exchange),
    .count_offset = offsetof(scene, n_exchanges),
    .most = SCENE_MAX_EXCHANGES,
    .table = &exchange_table,
    .end = end_exchange,
};
