/* Reactions that use up a solid, against the rest of the scene. */
#include "deck/check/check.h"

/* The deck says what a pair of materials exchanges. */
static bool pair_has_exchange(const scene *s, int a, int b)
{
    for (int k = 0; k < s->n_exchanges; k++) {
        const int *pair = s->exchange[k].material;
        if (((pair[0] == a && pair[1] == b) || (pair[0] == b && pair[1] == a)) && s->exchange[k].momentum.model)
            return true;
    }
    return false;
}

/* What of the scene sees solids in a way that knows nothing of points that lose mass. */
static floe_status check_burning(reader *r, const scene_reaction *q)
{
    const scene *s = r->scene;
    const char *name = s->material[q->reactant].name;
    if (s->material[q->reactant].membrane)
        return bad_at(r, KEY("reactions", q->name, "reactant"), NULL, NULL,
                      "'%s' is a membrane's material, whose points keep their mass", name);
    if (scene_is_cut(s))
        return bad_at(r, KEY("reactions", q->name, "reactant"), "interface: smeared, and no membrane that holds gas",
                      NULL, "solid '%s' cannot burn where surfaces cut the cells: these do not recede", name);
    if (s->method.edge_penalty > 0.0)
        return bad_at(r, KEY("method", "edge_penalty"), "no edge_penalty", NULL,
                      "solid '%s' burns, and its edge with it: there is nothing to hold", name);
    for (int l = 0; l < s->n_loads; l++)
        if (s->load[l].kind == LOAD_TRACTION && s->load[l].body >= 0 &&
            s->body[s->load[l].body].material == q->reactant)
            return bad_at(r, KEY("loads", s->load[l].name), NULL, NULL,
                          "the surface of body '%s', which is loaded, burns away", s->body[s->load[l].body].name);
    if (!pair_has_exchange(s, q->reactant, q->product))
        return bad_at(r, KEY("reactions", q->name, "product"), "exchange: a pair of the two, with momentum: free", NULL,
                      "gas that burns off solid '%s' would be locked in the cells that it shares with it: say what the "
                      "two exchange",
                      name);
    for (const scene_reaction *other = s->reaction; other < q; other++)
        if (other->reactant == q->reactant)
            return bad_at(r, KEY("reactions", q->name, "reactant"), "one reaction for each solid", NULL,
                          "reaction '%s' uses up the solid '%s' already", other->name, name);
    return FLOE_OK;
}

floe_status check_reactions(reader *r)
{
    for (int k = 0; k < r->scene->n_reactions; k++) {
        const scene_reaction *q = &r->scene->reaction[k];
        if (!is_clean(r->root, KEY("reactions", q->name)) || q->reactant < 0) continue;
        if (r->scene->material[q->reactant].kind == MATERIAL_SOLID) TRY(check_burning(r, q));
    }
    return FLOE_OK;
}
