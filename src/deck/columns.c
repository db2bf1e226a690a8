/* verify.history: {position: last_string_y, ...} */
#include "deck/deck_internal.h"

#include <stdio.h>
#include <string.h>

/* The quantities of the deck's reference, by index. */
typedef struct candidates {
    const deck_catalogue *catalogue;
    const char *reference;
} candidates;

static const char *candidate_column(const void *user, size_t i)
{
    const candidates *c = user;
    if (!c->catalogue || !c->catalogue->reference_quantity || !c->reference[0]) return NULL;
    return c->catalogue->reference_quantity(c->reference, i);
}

static bool is_quantity(const candidates *c, const char *name)
{
    for (size_t i = 0; candidate_column(c, i); i++) {
        if (strcmp(candidate_column(c, i), name) == 0) return true;
    }
    return false;
}

static floe_status read_column(reader *r, deck_node *item, scene_verify *verify)
{
    const candidates quantities = {r->catalogue, verify->reference};
    scene_column *column = &verify->column[verify->n_columns];
    if (!verify->reference[0]) return bad_key(r, item, NULL, NULL, "there is no verify.reference to compare with");
    if (!is_quantity(&quantities, item->key)) {
        return bad_name(r, item, true, "quantity of the reference", candidate_column, &quantities);
    }
    if (item->kind != NODE_SCALAR || node_is_null(item) || strlen(item->text) >= sizeof column->name) {
        return bad(r, item, "the name of a column of history.csv, without its unit", "this is no name of a column");
    }
    if (verify->n_columns == SCENE_MAX_COLUMNS) {
        return bad_key(r, item, NULL, NULL, "more than %d columns", SCENE_MAX_COLUMNS);
    }
    for (int i = 0; i < verify->n_columns; i++) {
        if (strcmp(verify->column[i].quantity, item->key) == 0)
            return bad_key(r, item, NULL, NULL, "quantity '%s' has two columns", item->key);
    }
    snprintf(column->quantity, sizeof column->quantity, "%s", item->key);
    snprintf(column->name, sizeof column->name, "%s", item->text);
    verify->n_columns++;
    return FLOE_OK;
}

static floe_status read_columns(reader *r, const key_spec *key, deck_node *node, void *base)
{
    if (!node) return FLOE_OK;
    if (node->kind != NODE_MAP) return bad_form(r, key, node, special_columns.form);
    for (deck_node *item = node->first; item; item = item->next) TRY(read_column(r, item, base));
    return FLOE_OK;
}

static void write_columns(writer *w, const key_spec *key, const void *base)
{
    const scene_verify *verify = base;
    if (verify->n_columns == 0) return;
    write_key_name(w, key->key);
    for (int i = 0; i < verify->n_columns; i++) {
        strbuf_append(&w->out, "%s%s: ", i == 0 ? " {" : ", ", verify->column[i].quantity);
        write_quoted(&w->out, verify->column[i].name);
    }
    strbuf_append(&w->out, "}\n");
}

const special_key special_columns = {
    .read = read_columns,
    .write = write_columns,
    .form = "{quantity: column, ...}",
    .json = "{\"type\": \"object\", \"additionalProperties\": {\"type\": \"string\"}}",
};
