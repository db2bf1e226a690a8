/* The schema as a JSON schema (draft 7): completion and first checks in editors. `floe check` is stricter. */
#include "deck/deck_internal.h"

#include <stdio.h>
#include <string.h>

typedef struct sheet {
    strbuf out;
    const deck_catalogue *catalogue;
} sheet;

static void print_key(sheet *j, const key_spec *key);

static void print_string(sheet *j, const char *text)
{
    strbuf_append(&j->out, "\"");
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\') {
            strbuf_append(&j->out, "\\%c", c);
        } else if (c < 0x20) {
            strbuf_append(&j->out, "\\u%04x", c);
        } else {
            strbuf_append_bytes(&j->out, text, 1);
        }
    }
    strbuf_append(&j->out, "\"");
}

/* "properties" and "required" of a table. */
static void print_table(sheet *j, const key_table *table)
{
    strbuf_append(&j->out, "\"type\": \"object\", \"additionalProperties\": false, \"properties\": {");
    for (size_t i = 0; i < table->n; i++) {
        strbuf_append(&j->out, "%s\n", i == 0 ? "" : ",");
        print_string(j, table->key[i].key);
        strbuf_append(&j->out, ": {");
        print_key(j, &table->key[i]);
        strbuf_append(&j->out, "}");
    }
    strbuf_append(&j->out, "}, \"required\": [");
    bool first = true;
    for (size_t i = 0; i < table->n; i++) {
        if (!table->key[i].required || table->key[i].applies) continue;
        strbuf_append(&j->out, "%s", first ? "" : ", ");
        print_string(j, table->key[i].key);
        first = false;
    }
    strbuf_append(&j->out, "]");
}

static void print_model(sheet *j, const model_entry *entry)
{
    strbuf_append(&j->out, "\n{\"type\": \"object\", \"additionalProperties\": false, \"required\": [");
    print_string(j, entry->name);
    strbuf_append(&j->out, "], \"properties\": {");
    print_string(j, entry->name);
    strbuf_append(&j->out, ": {\"type\": [\"object\", \"null\"], \"additionalProperties\": false, \"properties\": {");
    for (size_t i = 0; i < entry->n_params; i++) {
        const key_spec key = key_of_param(&entry->params[i]);
        strbuf_append(&j->out, "%s", i == 0 ? "" : ", ");
        print_string(j, key.key);
        strbuf_append(&j->out, ": {");
        print_key(j, &key);
        strbuf_append(&j->out, "}");
    }
    strbuf_append(&j->out, "}}}}");
}

static void print_family_schema(sheet *j, const model_family *family)
{
    model_entry entry;
    strbuf_append(&j->out, "\"anyOf\": [{\"enum\": [");
    for (size_t i = 0; family->get(j->catalogue, i, &entry); i++) {
        strbuf_append(&j->out, "%s", i == 0 ? "" : ", ");
        print_string(j, entry.name);
    }
    strbuf_append(&j->out, "%s]}", family->get(j->catalogue, 0, &entry) ? "" : "\"\"");
    for (size_t i = 0; family->get(j->catalogue, i, &entry); i++) {
        strbuf_append(&j->out, ",");
        print_model(j, &entry);
    }
    strbuf_append(&j->out, "]");
}

static void print_variants_schema(sheet *j, const variants *kinds)
{
    strbuf_append(&j->out, "\"anyOf\": [{\"enum\": [");
    for (size_t i = 0; i < kinds->n; i++) {
        strbuf_append(&j->out, "%s", i == 0 ? "" : ", ");
        print_string(j, kinds->list[i].name);
    }
    strbuf_append(&j->out, "]}");
    for (size_t i = 0; i < kinds->n; i++) {
        const variant *kind = &kinds->list[i];
        if (!kind->table) continue;
        strbuf_append(&j->out, ",\n{\"type\": \"object\", \"additionalProperties\": false, \"required\": [");
        print_string(j, kind->name);
        strbuf_append(&j->out, "], \"properties\": {");
        print_string(j, kind->name);
        strbuf_append(&j->out, ": {");
        print_table(j, kind->table);
        strbuf_append(&j->out, "}}}");
    }
    strbuf_append(&j->out, "]");
}

static void print_boundaries(sheet *j)
{
    static const char *const axes[] = {"x", "y", "z", "r"};
    strbuf_append(&j->out, "\"anyOf\": [{\"$ref\": \"#/definitions/side\"}, {\"type\": \"object\", "
                           "\"additionalProperties\": false, \"properties\": {");
    for (size_t i = 0; i < sizeof axes / sizeof axes[0]; i++) {
        strbuf_append(&j->out, "%s\"%s\": {\"$ref\": \"#/definitions/axis\"}", i == 0 ? "" : ", ", axes[i]);
    }
    strbuf_append(&j->out, "}}]");
}

static void print_named(sheet *j, const named_items *items)
{
    strbuf_append(&j->out, "\"type\": \"object\", \"additionalProperties\": {");
    if (items->table) {
        print_table(j, items->table);
    } else if (items->variants) {
        print_variants_schema(j, items->variants);
    } else {
        print_key(j, items->value);
    }
    strbuf_append(&j->out, "}");
}

static void print_choices_schema(sheet *j, const choice *choices)
{
    strbuf_append(&j->out, "\"enum\": [");
    for (const choice *c = choices; c->name; c++) {
        strbuf_append(&j->out, "%s", c == choices ? "" : ", ");
        print_string(j, c->name);
    }
    strbuf_append(&j->out, "]");
}

static void print_special(sheet *j, const special_key *special)
{
    if (special == &special_boundaries) {
        print_boundaries(j);
    } else if (special->json) {
        strbuf_append_bytes(&j->out, special->json + 1, strlen(special->json) - 2); /* without its braces */
    } else {
        strbuf_append(&j->out, "\"$comment\": ");
        print_string(j, special->form);
    }
}

static void print_type(sheet *j, const key_spec *key)
{
    switch (key->type) {
    case KEY_NUMBER: strbuf_append(&j->out, "\"type\": [\"number\", \"string\"]"); return;
    case KEY_NUMBERS:
    case KEY_VECTOR:
    case KEY_SPREAD: strbuf_append(&j->out, "\"type\": [\"number\", \"string\", \"array\"]"); return;
    case KEY_WHOLE: strbuf_append(&j->out, "\"type\": \"integer\""); return;
    case KEY_WHOLES: strbuf_append(&j->out, "\"type\": [\"integer\", \"array\"]"); return;
    case KEY_BOOL: strbuf_append(&j->out, "\"type\": \"boolean\""); return;
    case KEY_TEXT: strbuf_append(&j->out, "\"type\": [\"string\", \"number\"]"); return;
    case KEY_MATERIAL:
    case KEY_BODY: strbuf_append(&j->out, "\"type\": \"string\""); return;
    case KEY_CHOICE: print_choices_schema(j, key->choices); return;
    case KEY_MAP: print_table(j, key->table); return;
    case KEY_NAMED: print_named(j, key->items); return;
    case KEY_MODEL: print_family_schema(j, key->family); return;
    case KEY_VARIANT: print_variants_schema(j, key->variants); return;
    case KEY_SPECIAL: print_special(j, key->special); return;
    }
}

static void print_key(sheet *j, const key_spec *key)
{
    if (key->doc) {
        char text[512];
        const bool unit = key->unit && strcmp(key->unit, "1") != 0;
        snprintf(text, sizeof text, "%s%s%s%s", key->doc, unit ? " [" : "", unit ? key->unit : "", unit ? "]" : "");
        strbuf_append(&j->out, "\"description\": ");
        print_string(j, text);
        strbuf_append(&j->out, ", ");
    }
    print_type(j, key);
}

static void print_definitions(sheet *j)
{
    strbuf_append(&j->out, "\"definitions\": {\"side\": {");
    print_variants_schema(j, &boundary_kinds);
    strbuf_append(&j->out,
                  "},\n\"axis\": {\"anyOf\": [{\"$ref\": \"#/definitions/side\"}, {\"type\": \"object\", "
                  "\"additionalProperties\": false, \"properties\": {\"lower\": {\"$ref\": \"#/definitions/side\"}, "
                  "\"upper\": {\"$ref\": \"#/definitions/side\"}}}]}},\n");
}

floe_status deck_json_schema(char **text, context *ctx, const deck_catalogue *catalogue)
{
    sheet j = {.out = {.ctx = ctx}, .catalogue = catalogue};
    strbuf_append(&j.out, "{\"$schema\": \"http://json-schema.org/draft-07/schema#\", \"title\": \"floe deck\",\n");
    print_definitions(&j);
    print_table(&j, &schema_deck);
    strbuf_append(&j.out, "}\n");
    return strbuf_take(&j.out, text);
}
