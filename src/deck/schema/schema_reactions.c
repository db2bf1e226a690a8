/* Reactions: what of the cells becomes another fluid. */
#include "coupling/reaction.h"
#include "deck/check/check.h"
#include "deck/deck_internal.h"

static bool rate_get(const deck_catalogue *catalogue, size_t i, model_entry *out)
{
    (void)catalogue;
    if (i >= reaction_registry_size) return false;
    const reaction_model *m = reaction_registry[i];
    *out = (model_entry){m->name, m->doc, m->cite, m->params, m->n_params, m->param_size, m};
    return true;
}

static void rate_store(void *field, const model_entry *entry, void *par)
{
    scene_reaction *q = field;
    q->model = entry->model;
    q->par = par;
}

static bool rate_fetch(const void *field, const char **name, const void **par)
{
    const scene_reaction *q = field;
    if (!q->model) return false;
    *name = q->model->name;
    *par = q->par;
    return true;
}

const model_family family_reaction = {
    .noun = "law of a reaction", .get = rate_get, .store = rate_store, .fetch = rate_fetch};

static const key_spec reaction_keys[] = {
    {"reactant", KEY_MATERIAL, AT(scene_reaction, reactant), .required = true,
     .doc = "what is used up: a fluid, or in ice-mpm a solid, whose points lose mass"},
    {"product", KEY_MATERIAL, AT(scene_reaction, product), .required = true, .doc = "the fluid that it becomes"},
    {"rate", KEY_MODEL, .family = &family_reaction, .required = true, .doc = "how fast"},
    {"heat", KEY_NUMBER, "J/kg", AT(scene_reaction, heat), .fallback = "0",
     .doc = "that each kg gives off, into the product, beside its own internal energy"},
};
static const key_table reaction_table = TABLE(reaction_keys);

static floe_status begin_reaction(reader *r, deck_node *node, void *item)
{
    (void)r;
    (void)node;
    scene_reaction *q = item;
    q->reactant = q->product = -1;
    return FLOE_OK;
}

static floe_status end_reaction(reader *r, deck_node *node, void *item)
{
    const scene_reaction *q = item;
    const scene_material *m = r->scene->material;
    if (node->bad) return FLOE_OK;
    if (q->reactant == q->product)
        return bad_key(r, node, "two fluids", NULL, "reaction '%s' makes '%s' of itself", q->name, m[q->product].name);
    if (m[q->product].kind == MATERIAL_SOLID)
        return bad_key(r, node, "a fluid, by an equation of state", NULL,
                       "reaction '%s': its product '%s' is a solid, and no points come into being", q->name,
                       m[q->product].name);
    if (scene_runs_as(r->scene, COUPLING_MPM))
        return bad_key(r, node, "coupling: ice or ice-mpm, and no mpm in runs_as", NULL,
                       "reaction '%s': what reacts does so in the cells, and 'mpm' has none", q->name);
    return FLOE_OK;
}

const named_items items_reactions = {
    .noun = "reaction",
    .item_size = sizeof(scene_reaction),
    .count_offset = offsetof(scene, n_reactions),
    .most = SCENE_MAX_REACTIONS,
    .table = &reaction_table,
    .begin = begin_reaction,
    .end = end_reaction,
};
