/* Numbers, lists of numbers, words and references. */
#include "deck/schema/schema.h"
#include "deck/units.h"

#include "base/text.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

enum { WORDS = 512 };

bool key_has_unit(const key_spec *key)
{
    return key->unit && strcmp(key->unit, "1") != 0;
}

static void describe_number(const key_spec *key, char *text, size_t size)
{
    const param_spec spec = {.range = key->range, .lo = key->lo, .hi = key->hi};
    param_describe_range(&spec, text, size);
    if (key_has_unit(key)) text_add(text, size, " in %s, or with its unit", key->unit);
    if (key->varies)
        text_add(text, size, "; or a formula of %s%s%s", key->varies & VARIES_BY_PLACE ? "place" : "",
                 key->varies == VARIES_BY_PLACE + VARIES_BY_TIME ? " and " : "",
                 key->varies & VARIES_BY_TIME ? "time" : "");
}

static void describe_choices(const key_spec *key, char *text, size_t size)
{
    text[0] = '\0';
    for (const choice *c = key->choices; c->name; c++)
        text_add(text, size, "%s%s", c == key->choices ? "" : ", ", c->name);
}

static void describe_list(const key_spec *key, size_t n, bool alone, char *text, size_t size)
{
    char number[WORDS / 2];
    describe_number(key, number, sizeof number);
    snprintf(text, size, "%sa list of %zu, each %s", alone ? "one for all axes, or " : "", n, number);
}

static void describe_positions(const key_spec *key, int dim, char *text, size_t size)
{
    static const char *const form[] = {"", "[x, x, ...]", "[[x, y], [x, y], ...]", "[[x, y, z], [x, y, z], ...]"};
    snprintf(text, size, "a list of %d or more positions, %s", key->least, form[dim >= 1 && dim <= 3 ? dim : 0]);
    if (key_has_unit(key)) text_add(text, size, " in %s, or with units", key->unit);
}

void describe_expected(const key_spec *key, int dim, char *text, size_t size)
{
    switch (key->type) {
    case KEY_NUMBER: describe_number(key, text, size); return;
    case KEY_NUMBERS: describe_list(key, key->size / sizeof(double), false, text, size); return;
    case KEY_VECTOR: describe_list(key, (size_t)dim, false, text, size); return;
    case KEY_SPREAD: describe_list(key, (size_t)dim, true, text, size); return;
    case KEY_WHOLE: snprintf(text, size, "a whole number from %.0f to %.0f", key->lo, key->hi); return;
    case KEY_WHOLES:
        snprintf(text, size, "a whole number from %.0f to %.0f, or a list of %d", key->lo, key->hi, dim);
        return;
    case KEY_BOOL: snprintf(text, size, "true or false"); return;
    case KEY_TEXT: snprintf(text, size, "text of at most %zu bytes", key->size - 1); return;
    case KEY_CHOICE: describe_choices(key, text, size); return;
    case KEY_MATERIAL: snprintf(text, size, "the name of a material"); return;
    case KEY_BODY: snprintf(text, size, "the name of a body"); return;
    case KEY_MAP: snprintf(text, size, "a map: {key: value, ...}"); return;
    case KEY_NAMED: snprintf(text, size, "name: {...}, one entry for each %s", key->items->noun); return;
    case KEY_MODEL: snprintf(text, size, "{name: {parameters}} of one %s", key->family->noun); return;
    case KEY_MODELS:
        snprintf(text, size, "a list of %d or more, each {name: {parameters}} of one %s", key->least,
                 key->family->noun);
        return;
    case KEY_POINTS: describe_positions(key, dim, text, size); return;
    case KEY_FILE: snprintf(text, size, "the name of a file, from the deck's folder"); return;
    case KEY_VARIANT: snprintf(text, size, "{kind: {keys}} of one %s", key->variants->noun); return;
    case KEY_SPECIAL: snprintf(text, size, "%s", key->special->form); return;
    }
    snprintf(text, size, "a value");
}

static floe_status bad_value(reader *r, const key_spec *key, deck_node *node, const char *why)
{
    char expected[WORDS];
    describe_expected(key, reader_dim(r), expected, sizeof expected);
    return bad(r, node, expected, "'%s': %s", key->key, why);
}

static floe_status bad_kind(reader *r, const key_spec *key, deck_node *node)
{
    char expected[WORDS];
    describe_expected(key, reader_dim(r), expected, sizeof expected);
    return bad_form(r, key, node, expected);
}

/* false: *why says what is wrong. */
static bool convert_number(reader *r, const key_spec *key, const char *text, double *x, char *why)
{
    const char *unit;
    if (!number_split(text, x, &unit, why)) return false;
    if (unit[0] && r->scene->dimensionless) {
        snprintf(why, WHY_SIZE, "unit '%.40s' in a deck with 'units: none': write the number alone", unit);
        return false;
    }
    if (unit[0] && !units_convert(x, unit, key->unit ? key->unit : "1", why)) return false;
    const param_spec spec = {.range = key->range, .lo = key->lo, .hi = key->hi};
    if (param_in_range(&spec, *x)) return true;
    if (unit[0]) {
        snprintf(why, WHY_SIZE, "%.60s (%.6g in %s) is out of range", text, *x, key->unit ? key->unit : "1");
    } else {
        snprintf(why, WHY_SIZE, "%.60s is out of range", text);
    }
    return false;
}

floe_status read_number(reader *r, const key_spec *key, deck_node *node, double *out)
{
    char why[WHY_SIZE];
    double x;
    if (node->kind != NODE_SCALAR || node_is_null(node)) return bad_kind(r, key, node);
    if (convert_number(r, key, node->text, &x, why)) {
        *out = x;
        return FLOE_OK;
    }
    char formula_why[EXPRESSION_WHY];
    bool meant;
    TRY(read_formula(r, key, node, out, &meant, formula_why));
    if (meant && !formula_why[0]) return FLOE_OK;
    return bad_value(r, key, node, meant ? formula_why : why);
}

static floe_status read_whole(reader *r, const key_spec *key, deck_node *node, long *out)
{
    char why[WHY_SIZE];
    long x;
    if (node->kind != NODE_SCALAR || node_is_null(node)) return bad_kind(r, key, node);
    if (!number_whole(node->text, &x, why)) return bad_value(r, key, node, why);
    if (!((double)x >= key->lo && (double)x <= key->hi)) {
        snprintf(why, sizeof why, "%ld is out of range", x);
        return bad_value(r, key, node, why);
    }
    *out = x;
    return FLOE_OK;
}

static floe_status read_whole_key(reader *r, const key_spec *key, deck_node *node, char *field)
{
    long x = (long)key->lo;
    TRY(read_whole(r, key, node, &x));
    const int narrow = (int)x; /* int keys have int ranges */
    if (key->size == sizeof narrow) {
        memcpy(field, &narrow, sizeof narrow);
    } else if (key->size == sizeof x) {
        memcpy(field, &x, sizeof x);
    }
    return FLOE_OK;
}

/* [0,3, 0,3] is a list of four. */
static floe_status bad_doubled_list(reader *r, const key_spec *key, deck_node *node)
{
    char expected[WORDS];
    describe_expected(key, reader_dim(r), expected, sizeof expected);
    text_add(expected, sizeof expected, "; with decimals written with a point: 0.05, not 0,05");
    return bad_form(r, key, node, expected);
}

/* A list of `n`, or one value for every axis when `spread` (and always where n is 1). */
static floe_status read_numbers(reader *r, const key_spec *key, deck_node *node, size_t n, bool spread, double *field)
{
    if (node->kind == NODE_SCALAR && (spread || n == 1)) {
        TRY(read_number(r, key, node, &field[0]));
        for (size_t i = 1; i < n; i++) field[i] = field[0];
        return FLOE_OK;
    }
    if (node->kind == NODE_LIST && node->n == 2 * n) return bad_doubled_list(r, key, node);
    if (node->kind != NODE_LIST || node->n != n) return bad_kind(r, key, node);
    size_t i = 0;
    for (deck_node *item = node->first; item; item = item->next) TRY(read_number(r, key, item, &field[i++]));
    return FLOE_OK;
}

static floe_status read_wholes(reader *r, const key_spec *key, deck_node *node, int *field)
{
    const size_t n = (size_t)reader_dim(r);
    long x = (long)key->lo;
    if (node->kind == NODE_SCALAR) {
        TRY(read_whole(r, key, node, &x));
        for (size_t i = 0; i < n; i++) field[i] = (int)x;
        return FLOE_OK;
    }
    if (node->kind != NODE_LIST || node->n != n) return bad_kind(r, key, node);
    size_t i = 0;
    for (deck_node *item = node->first; item; item = item->next) {
        TRY(read_whole(r, key, item, &x));
        field[i++] = (int)x;
    }
    return FLOE_OK;
}

static floe_status read_bool(reader *r, const key_spec *key, deck_node *node, char *field)
{
    const bool yes = strcmp(node->text, "true") == 0;
    if (node->kind != NODE_SCALAR || (!yes && strcmp(node->text, "false") != 0)) return bad_kind(r, key, node);
    memcpy(field, &yes, sizeof yes);
    return FLOE_OK;
}

static floe_status read_text(reader *r, const key_spec *key, deck_node *node, char *field)
{
    if (node->kind != NODE_SCALAR) return bad_kind(r, key, node);
    if (strlen(node->text) >= key->size) return bad_value(r, key, node, "the text is too long");
    snprintf(field, key->size, "%s", node->text);
    return FLOE_OK;
}

static const char *choice_name(const void *user, size_t i)
{
    const choice *choices = user;
    return choices[i].name;
}

static floe_status read_choice(reader *r, const key_spec *key, deck_node *node, char *field)
{
    if (node->kind != NODE_SCALAR) return bad_kind(r, key, node);
    for (const choice *c = key->choices; c->name; c++) {
        if (strcmp(c->name, node->text) != 0) continue;
        const bool flag = c->value != 0;
        if (key->size == sizeof flag) {
            memcpy(field, &flag, sizeof flag);
        } else if (key->size == sizeof c->value) {
            memcpy(field, &c->value, sizeof c->value);
        }
        return FLOE_OK;
    }
    const char *const *renamed = key->renamed_choice;
    if (renamed[0] && strcmp(renamed[0], node->text) == 0)
        return bad(r, node, renamed[1], "'%s' is now called '%s'", renamed[0], renamed[1]);
    char noun[80];
    snprintf(noun, sizeof noun, "%s", key->key);
    return bad_name(r, node, false, noun, choice_name, key->choices);
}

static const char *material_name(const void *user, size_t i)
{
    const scene *s = user;
    return i < (size_t)s->n_materials ? s->material[i].name : NULL;
}

static const char *body_name(const void *user, size_t i)
{
    const scene *s = user;
    return i < (size_t)s->n_bodies ? s->body[i].name : NULL;
}

int find_material(const scene *s, const char *name)
{
    for (int i = 0; i < s->n_materials; i++) {
        if (strcmp(s->material[i].name, name) == 0) return i;
    }
    return -1;
}

int find_body(const scene *s, const char *name)
{
    for (int i = 0; i < s->n_bodies; i++) {
        if (strcmp(s->body[i].name, name) == 0) return i;
    }
    return -1;
}

static floe_status read_reference(reader *r, const key_spec *key, deck_node *node, char *field)
{
    if (node->kind != NODE_SCALAR) return bad_kind(r, key, node);
    const bool material = key->type == KEY_MATERIAL;
    const int found = material ? find_material(r->scene, node->text) : find_body(r->scene, node->text);
    memcpy(field, &found, sizeof found);
    if (found >= 0) return FLOE_OK;
    return bad_name(r, node, false, material ? "material" : "body", material ? material_name : body_name, r->scene);
}

floe_status read_scalar(reader *r, const key_spec *key, deck_node *node, void *base)
{
    char *field = (char *)base + key->offset;
    double *number = (double *)(void *)field;
    const size_t dim = (size_t)reader_dim(r);
    switch (key->type) {
    case KEY_NUMBER: return read_number(r, key, node, number);
    case KEY_NUMBERS: return read_numbers(r, key, node, key->size / sizeof *number, false, number);
    case KEY_VECTOR: return read_numbers(r, key, node, dim, false, number);
    case KEY_SPREAD: return read_numbers(r, key, node, dim, true, number);
    case KEY_WHOLE: return read_whole_key(r, key, node, field);
    case KEY_WHOLES: return read_wholes(r, key, node, (int *)(void *)field);
    case KEY_BOOL: return read_bool(r, key, node, field);
    case KEY_TEXT: return read_text(r, key, node, field);
    case KEY_CHOICE: return read_choice(r, key, node, field);
    case KEY_MATERIAL:
    case KEY_BODY: return read_reference(r, key, node, field);
    default: return fail(r->ctx, FLOE_INTERNAL, "key '%s' is no scalar", key->key);
    }
}
