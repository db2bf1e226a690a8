/* Positions as lists of numbers. */
#include "deck/schema/schema.h"

#include <stdio.h>

floe_status read_position(reader *r, const key_spec *key, deck_node *item, double position[3])
{
    const size_t dim = (size_t)reader_dim(r);
    if (item->kind == NODE_SCALAR && dim == 1) return read_number(r, key, item, &position[0]);
    if (item->kind != NODE_LIST || item->n != dim)
        return bad(r, item, "a list with a number for each axis", "this is no place of the scene");
    size_t axis = 0;
    for (deck_node *x = item->first; x; x = x->next) TRY(read_number(r, key, x, &position[axis++]));
    return FLOE_OK;
}

floe_status read_points(reader *r, const key_spec *key, deck_node *node, void *base)
{
    param_list *list = (param_list *)(void *)((char *)base + key->offset);
    double(*position)[3];
    if (node->kind != NODE_LIST || node->n < (size_t)key->least) {
        char found[80], expected[512];
        node_describe(node, found, sizeof found);
        describe_expected(key, reader_dim(r), expected, sizeof expected);
        if (node->kind == NODE_LIST) snprintf(found, sizeof found, "a list of %zu", node->n);
        return bad(r, node, expected, "'%s' is %s", key->key, found);
    }
    TRY(scene_allocate(r->scene, &position, node->n * sizeof *position));
    list->item = position;
    for (deck_node *item = node->first; item; item = item->next) TRY(read_position(r, key, item, position[list->n++]));
    return FLOE_OK;
}

void write_position(writer *w, const double position[3])
{
    for (int axis = 0; axis < writer_dim(w); axis++) {
        strbuf_append(&w->out, "%s", axis == 0 ? "[" : ", ");
        write_number(&w->out, position[axis]);
    }
    strbuf_append(&w->out, "]");
}
