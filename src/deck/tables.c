/* tables: {push: {at: [0, 1 ms], values: [0, 5 kPa]}, inflow: {file: inflow.csv, from: time, to: velocity}}: functions of one
 * number, for formulas. */
#include "base/sha256.h"
#include "deck/csv_columns.h"
#include "deck/deck_internal.h"

#include <math.h>
#include <string.h>

/* ---- entries in the deck ---- */

static floe_status read_entry(reader *r, deck_node *item, double *out)
{
    char why[EXPRESSION_WHY];
    expression_dimension ignored;
    if (item->kind != NODE_SCALAR || node_is_null(item)) return bad(r, item, "a number", "this is no number");
    TRY(read_any_number(r, item, out, &ignored, why));
    return why[0] ? bad(r, item, "a number, with its unit", "%s", why) : FLOE_OK;
}

static floe_status read_entries(reader *r, const key_spec *key, deck_node *node, double **out, size_t *n)
{
    size_t i = 0;
    if (node->kind != NODE_LIST || node->n < 2) return bad_form(r, key, node, key->special->form);
    TRY(scene_allocate(r->scene, out, node->n * sizeof **out));
    for (deck_node *item = node->first; item; item = item->next) TRY(read_entry(r, item, &(*out)[i++]));
    *n = node->n;
    return FLOE_OK;
}

static floe_status read_at(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_table *t = base;
    return node ? read_entries(r, key, node, &t->at, &t->n) : FLOE_OK;
}

static floe_status read_values(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_table *t = base;
    size_t n = 0;
    if (!node) return FLOE_OK;
    TRY(read_entries(r, key, node, &t->value, &n));
    if (node->bad || n == t->n) return FLOE_OK;
    t->value = NULL;
    return bad(r, node, "as many as 'at' has", "there are %zu values at %zu places", n, t->n);
}

static void write_entries(writer *w, const key_spec *key, const scene_table *t, const double *value)
{
    if (t->path) return; /* the file tells them */
    write_key_name(w, key->key);
    for (size_t i = 0; i < t->n; i++) {
        strbuf_append(&w->out, i == 0 ? " [" : ", ");
        write_number(&w->out, value[i]);
    }
    strbuf_append(&w->out, "]\n");
}

static void write_at(writer *w, const key_spec *key, const void *base)
{
    write_entries(w, key, base, ((const scene_table *)base)->at);
}

static void write_values(writer *w, const key_spec *key, const void *base)
{
    write_entries(w, key, base, ((const scene_table *)base)->value);
}

#define LIST_FORM "a list of two numbers or more, with their units"
#define LIST_JSON "{\"type\": \"array\", \"minItems\": 2}"
static const special_key special_at = {.read = read_at, .write = write_at, .form = LIST_FORM, .json = LIST_JSON};
static const special_key special_values = {
    .read = read_values, .write = write_values, .form = LIST_FORM, .json = LIST_JSON};

/* ---- entries in a file ---- */

static floe_status read_table_columns(reader *r, const key_spec *key, deck_node *node, void *base)
{
    scene_table *t = base;
    if (!node) return FLOE_OK;
    if (node->kind != NODE_SCALAR || node_is_null(node)) return bad_form(r, key, node, key->special->form);
    csv_columns columns = {.name = {t->from[0] ? t->from : NULL, t->to[0] ? t->to : NULL}, .n = 2, .stride = 2};
    TRY(read_csv_columns(r, node, key->special->form, &columns));
    if (!columns.value) return FLOE_OK;
    TRY(scene_allocate(r->scene, &t->at, columns.rows * sizeof *t->at));
    TRY(scene_allocate(r->scene, &t->value, columns.rows * sizeof *t->value));
    for (size_t i = 0; i < columns.rows; i++) {
        t->at[i] = columns.value[2 * i];
        t->value[i] = columns.value[2 * i + 1];
    }
    t->n = columns.rows;
    t->path = columns.path;
    return FLOE_OK;
}

/* In a comment, what the file held: a run that goes on compares resolved decks, and so sees that the file is another one. */
static void write_table_file(writer *w, const key_spec *key, const void *base)
{
    const scene_table *t = base;
    char at[SHA256_TEXT], value[SHA256_TEXT];
    if (!t->path) return;
    strbuf_note(&w->out, sha256_of(w->out.ctx, t->at, t->n * sizeof *t->at, at));
    strbuf_note(&w->out, sha256_of(w->out.ctx, t->value, t->n * sizeof *t->value, value));
    write_key_name(w, key->key);
    strbuf_append(&w->out, " ");
    write_quoted(&w->out, t->path);
    strbuf_append(&w->out, " # %zu entries, sha256 %s, %s\n", t->n, at, value);
}

static const special_key special_table_file = {
    .read = read_table_columns,
    .write = write_table_file,
    .form = "the name of a CSV file, from the deck's folder, with a line of column names, each with its unit in "
            "brackets, else in SI",
    .json = "{\"type\": \"string\"}",
};

/* ---- either ---- */

static const choice between_choices[] = {
    {"linear", TABLE_LINEAR, "straight lines"},
    {"smooth", TABLE_SMOOTH, "cubic, with a continuous slope and without overshoot (Steffen 1990)"},
    {"steps", TABLE_STEPS, "the value of the entry before"},
    {0},
};
static const choice beyond_choices[] = {
    {"constant", TABLE_CONSTANT, "the first value, and the last"},
    {"zero", TABLE_ZERO, "nothing"},
    {"repeat", TABLE_REPEAT, "from the first to the last entry, again and again"},
    {0},
};

static const key_spec table_keys[] = {
    {"at", KEY_SPECIAL, .special = &special_at, .otherwise = "in the file", .doc = "what it is a function of, growing"},
    {"values", KEY_SPECIAL, .special = &special_values, .otherwise = "in the file", .doc = "its value at each of them"},
    {"from", KEY_TEXT, AT(scene_table, from), .otherwise = "the first",
     .doc = "column of the file that it is a function of"},
    {"to", KEY_TEXT, AT(scene_table, to), .otherwise = "the second", .doc = "column of the file with its values"},
    {"file", KEY_SPECIAL, .special = &special_table_file, .otherwise = "at and values", .doc = "file with its entries"},
    {"between", KEY_CHOICE, AT(scene_table, between), .fallback = "linear", .choices = between_choices,
     .doc = "what it is between its entries"},
    {"beyond", KEY_CHOICE, AT(scene_table, beyond), .fallback = "constant", .choices = beyond_choices,
     .doc = "what it is before the first and after the last"},
};
static const key_table table_table = TABLE(table_keys);

/* The name must be free, and it is no function yet while it is read. */
static floe_status begin_table(reader *r, deck_node *node, void *item)
{
    r->scene->n_tables--;
    return check_formula_name(r, node, ((const scene_table *)item)->name);
}

static floe_status end_table(reader *r, deck_node *node, void *item)
{
    scene_table *t = item;
    r->scene->n_tables++;
    if (node->bad) return FLOE_OK;
    if (t->path ? node_find(node, "at") || node_find(node, "values") : !t->at || !t->value)
        return bad_key(r, node, "at: [...] and values: [...], or file: NAME", NULL, "table '%s' has %s", t->name,
                       t->path ? "entries and a file" : "no entries");
    for (size_t i = 1; i < t->n; i++)
        if (!(t->at[i] > t->at[i - 1]))
            return bad_key(r, node, NULL, NULL,
                           "table '%s': its entry %zu, at %g, is not beyond the one before it, at %g", t->name, i + 1,
                           t->at[i], t->at[i - 1]);
    if (t->n < 2) return bad_key(r, node, NULL, NULL, "table '%s' has less than two entries", t->name);
    return value_table_create(r->ctx, t->at, t->value, t->n, t->between, t->beyond, &t->curve);
}

const named_items items_tables = {
    .noun = "table",
    .item_size = sizeof(scene_table),
    .count_offset = offsetof(scene, n_tables),
    .most = SCENE_MAX_TABLES,
    .table = &table_table,
    .begin = begin_table,
    .end = end_table,
};
