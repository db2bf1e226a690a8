/* The schema as a JSON schema (draft 7): completion and first checks in editors. `floe check` is stricter. */
#include "base/json_value.h"
#include "deck/deck_internal.h"

#include <stdio.h>
#include <string.h>

typedef struct schema_writer {
    const deck_catalogue *catalogue;
    bool failed; /* memory is out */
} schema_writer;

static void add_key_members(schema_writer *j, json_t *out, const key_spec *key);

static void put_member(schema_writer *j, json_t *object, const char *name, json_t *value)
{
    j->failed = !json_put(object, name, value) || j->failed;
}

static void append_value(schema_writer *j, json_t *list, json_t *value)
{
    j->failed = json_array_append_new(list, value) != 0 || j->failed;
}

/* A new member of an object, or element of a list, which owns it. */
static json_t *new_object(schema_writer *j, json_t *object, const char *name)
{
    json_t *value = json_object();
    put_member(j, object, name, value);
    return value;
}

static json_t *new_list(schema_writer *j, json_t *object, const char *name)
{
    json_t *value = json_array();
    put_member(j, object, name, value);
    return value;
}

static json_t *append_object(schema_writer *j, json_t *list)
{
    json_t *value = json_object();
    append_value(j, list, value);
    return value;
}

/* An object of the members that are named and no others: returns its "properties". */
static json_t *begin_closed_object(schema_writer *j, json_t *out)
{
    put_member(j, out, "type", json_string("object"));
    put_member(j, out, "additionalProperties", json_false());
    return new_object(j, out, "properties");
}

/* The same of one member, which is required. */
static json_t *begin_single_object(schema_writer *j, json_t *out, const char *name)
{
    json_t *properties = begin_closed_object(j, out);
    put_member(j, out, "required", json_pack("[s]", name));
    return new_object(j, properties, name);
}

static void add_table_members(schema_writer *j, json_t *out, const key_table *table)
{
    json_t *properties = begin_closed_object(j, out), *required = new_list(j, out, "required");
    for (size_t i = 0; i < table->n; i++) {
        const key_spec *key = &table->key[i];
        add_key_members(j, new_object(j, properties, key->key), key);
        if (key->required && !key->applies) append_value(j, required, json_string(key->key));
    }
}

static json_t *reference_to(const char *definition)
{
    return json_pack("{s:s}", "$ref", definition);
}

static void add_model(schema_writer *j, json_t *any, const model_entry *entry, const model_family *family)
{
    if (stands_alone(entry)) {
        const key_spec key = key_of_param(entry, 0, family);
        add_key_members(j, begin_single_object(j, append_object(j, any), entry->name), &key);
        return;
    }
    json_t *model = begin_single_object(j, append_object(j, any), entry->name);
    json_t *properties = begin_closed_object(j, model);
    put_member(j, model, "type", json_pack("[s, s]", "object", "null"));
    for (size_t i = 0; i < entry->n_params; i++) {
        const key_spec key = key_of_param(entry, i, family);
        add_key_members(j, new_object(j, properties, key.key), &key);
    }
    const key_spec *young;
    for (size_t i = 0; (young = young_key(entry, i)); i++)
        add_key_members(j, new_object(j, properties, young->key), young);
}

static void add_family_members(schema_writer *j, json_t *out, const model_family *family)
{
    model_entry entry;
    json_t *any = new_list(j, out, "anyOf"), *names = new_list(j, append_object(j, any), "enum");
    for (size_t i = 0; family->get(j->catalogue, i, &entry); i++) {
        append_value(j, names, json_string(entry.name));
        add_model(j, any, &entry, family);
    }
    if (json_array_size(names) == 0) append_value(j, names, json_string("")); /* an empty list is no schema */
}

static void add_variants_members(schema_writer *j, json_t *out, const variants *kinds)
{
    json_t *any = new_list(j, out, "anyOf"), *names = new_list(j, append_object(j, any), "enum");
    for (size_t i = 0; i < kinds->n; i++) {
        const variant *kind = &kinds->list[i];
        append_value(j, names, json_string(kind->name));
        if (kind->table) add_table_members(j, begin_single_object(j, append_object(j, any), kind->name), kind->table);
    }
}

/* One kind for all sides, or an object of the named ones. */
static void add_boundaries(schema_writer *j, json_t *out, const char *const *names, size_t n, const char *definition)
{
    json_t *any = new_list(j, out, "anyOf");
    append_value(j, any, reference_to("#/definitions/side"));
    json_t *properties = begin_closed_object(j, append_object(j, any));
    for (size_t i = 0; i < n; i++) put_member(j, properties, names[i], reference_to(definition));
}

static void add_named_members(schema_writer *j, json_t *out, const named_items *items)
{
    put_member(j, out, "type", json_string("object"));
    json_t *item = new_object(j, out, "additionalProperties");
    if (items->table)
        add_table_members(j, item, items->table);
    else if (items->variants)
        add_variants_members(j, item, items->variants);
    else
        add_key_members(j, item, items->value);
}

static void add_choices(schema_writer *j, json_t *out, const choice *choices)
{
    json_t *names = new_list(j, out, "enum");
    for (const choice *c = choices; c->name; c++) append_value(j, names, json_string(c->name));
}

static void add_special_members(schema_writer *j, json_t *out, const special_key *special)
{
    static const char *const axes[] = {"x", "y", "z", "r"};
    if (special == &special_boundaries) {
        add_boundaries(j, out, axes, sizeof axes / sizeof axes[0], "#/definitions/axis");
    } else if (special->json) {
        json_t *members = json_loads(special->json, 0, NULL);
        j->failed = json_object_update(out, members) != 0 || j->failed;
        json_decref(members);
    } else {
        put_member(j, out, "$comment", json_string(special->form));
    }
}

/* Models that may have models of their registry as parameters are a definition: in a list, for drafts up to 7 take nothing
 * beside a $ref. */
static void add_model_members(schema_writer *j, json_t *out, const model_family *family)
{
    char definition[80];
    (void)snprintf(definition, sizeof definition, "#/definitions/%s", family->noun);
    if (family->field_size > 0)
        append_value(j, new_list(j, out, "allOf"), reference_to(definition));
    else
        add_family_members(j, out, family);
}

static void add_type_members(schema_writer *j, json_t *out, const key_spec *key)
{
    switch (key->type) {
    case KEY_NUMBER: put_member(j, out, "type", json_pack("[s, s]", "number", "string")); return;
    case KEY_NUMBERS:
    case KEY_VECTOR:
    case KEY_SPREAD: put_member(j, out, "type", json_pack("[s, s, s]", "number", "string", "array")); return;
    case KEY_WHOLE: put_member(j, out, "type", json_string("integer")); return;
    case KEY_WHOLES: put_member(j, out, "type", json_pack("[s, s]", "integer", "array")); return;
    case KEY_BOOL: put_member(j, out, "type", json_string("boolean")); return;
    case KEY_TEXT: put_member(j, out, "type", json_pack("[s, s]", "string", "number")); return;
    case KEY_MATERIAL:
    case KEY_BODY: put_member(j, out, "type", json_string("string")); return;
    case KEY_CHOICE: add_choices(j, out, key->choices); return;
    case KEY_MAP: add_table_members(j, out, key->table); return;
    case KEY_NAMED: add_named_members(j, out, key->items); return;
    case KEY_MODEL: add_model_members(j, out, key->family); return;
    case KEY_MODELS:
        put_member(j, out, "type", json_string("array"));
        put_member(j, out, "minItems", json_integer(key->least));
        add_model_members(j, new_object(j, out, "items"), key->family);
        return;
    case KEY_POINTS:
        put_member(j, out, "type", json_string("array"));
        put_member(j, out, "minItems", json_integer(key->least));
        return;
    case KEY_FILE: put_member(j, out, "type", json_string("string")); return;
    case KEY_VARIANT: add_variants_members(j, out, key->variants); return;
    case KEY_SPECIAL: add_special_members(j, out, key->special); return;
    }
}

static void add_key_members(schema_writer *j, json_t *out, const key_spec *key)
{
    const bool unit = key->unit && strcmp(key->unit, "1") != 0;
    char text[512];
    snprintf(text, sizeof text, "%s%s%s%s", key->doc ? key->doc : "", unit ? " [" : "", unit ? key->unit : "",
             unit ? "]" : "");
    if (key->doc) put_member(j, out, "description", json_plain_text(text));
    add_type_members(j, out, key);
}

static void add_definitions(schema_writer *j, json_t *out)
{
    static const char *const sides[] = {"lower", "upper"};
    json_t *definitions = new_object(j, out, "definitions");
    add_variants_members(j, new_object(j, definitions, "side"), &boundary_kinds);
    add_family_members(j, new_object(j, definitions, family_shape.noun), &family_shape);
    add_boundaries(j, new_object(j, definitions, "axis"), sides, 2, "#/definitions/side");
}

floe_status deck_json_schema(char **text, context *ctx, const deck_catalogue *catalogue)
{
    schema_writer j = {.catalogue = catalogue};
    json_t *out = json_pack("{s:s, s:s}", "$schema", "http://json-schema.org/draft-07/schema#", "title", "floe deck");
    add_definitions(&j, out);
    add_table_members(&j, out, &schema_deck);
    const floe_status status = j.failed ? fail(ctx, FLOE_NO_MEMORY, "no memory for the JSON schema") : FLOE_OK;
    if (status == FLOE_OK) return json_to_text(ctx, text, out);
    json_decref(out);
    return status;
}
