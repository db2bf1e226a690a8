/* The schema as Markdown: the page docs/deck.md. */
#include "deck/deck_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct page {
    strbuf out;
    const deck_catalogue *catalogue;
} page;

static void print_choices(page *p, const choice *choices)
{
    for (const choice *c = choices; c->name; c++) strbuf_append(&p->out, "%s`%s`", c == choices ? "" : ", ", c->name);
}

/* A line of documentation as a sentence. */
static void print_sentence(page *p, const char *text)
{
    if (!text || !text[0]) return;
    const bool lower = text[0] >= 'a' && text[0] <= 'z';
    strbuf_append(&p->out, "%c%s.", lower ? text[0] - 'a' + 'A' : text[0], text + 1);
}

/* What the key takes, for any dimension of the scene. */
static void print_form(page *p, const key_spec *key)
{
    char range[128];
    const param_spec spec = {.range = key->range, .lo = key->lo, .hi = key->hi};
    param_describe_range(&spec, range, sizeof range);
    switch (key->type) {
    case KEY_NUMBER: strbuf_append(&p->out, "%s", range); break;
    case KEY_NUMBERS: strbuf_append(&p->out, "a list of %zu, each %s", key->size / sizeof(double), range); break;
    case KEY_VECTOR: strbuf_append(&p->out, "a list, one for each axis: %s", range); break;
    case KEY_SPREAD: strbuf_append(&p->out, "%s, or a list with one for each axis", range); break;
    case KEY_WHOLE: strbuf_append(&p->out, "a whole number from %.0f to %.0f", key->lo, key->hi); break;
    case KEY_WHOLES:
        strbuf_append(&p->out, "a whole number from %.0f to %.0f, or a list with one for each axis", key->lo, key->hi);
        break;
    case KEY_BOOL: strbuf_append(&p->out, "`true`, `false`"); break;
    case KEY_TEXT: strbuf_append(&p->out, "text"); break;
    case KEY_CHOICE: print_choices(p, key->choices); break;
    case KEY_MATERIAL: strbuf_append(&p->out, "the name of a material"); break;
    case KEY_BODY: strbuf_append(&p->out, "the name of a body"); break;
    case KEY_MAP: strbuf_append(&p->out, "a map, see below"); break;
    case KEY_NAMED: strbuf_append(&p->out, "`name: {...}` for each %s, see below", key->items->noun); break;
    case KEY_MODEL:
        strbuf_append(&p->out, "`{name: {...}}` of one %s%s", key->family->noun, key->dim == 2 ? " of the plane" : "");
        break;
    case KEY_MODELS:
        strbuf_append(&p->out, "a list, each `{name: {...}}` of one %s; %d or more", key->family->noun, key->least);
        break;
    case KEY_POINTS: strbuf_append(&p->out, "a list of positions, `[[x, y], ...]`; %d or more", key->least); break;
    case KEY_FILE: strbuf_append(&p->out, "the name of a file, from the deck's folder"); break;
    case KEY_VARIANT: strbuf_append(&p->out, "`{kind: {...}}` of one %s", key->variants->noun); break;
    case KEY_SPECIAL: strbuf_append(&p->out, "%s", key->special->form); break;
    }
    if (key_has_unit(key)) strbuf_append(&p->out, " [%s]", key->unit);
    if (key->varies)
        strbuf_append(&p->out, "; or a formula of %s",
                      key->varies == VARIES_BY_PLACE  ? "place"
                      : key->varies == VARIES_BY_TIME ? "time"
                                                      : "place and time");
}

static void print_default(page *p, const key_spec *key)
{
    if (key->required) {
        strbuf_append(&p->out, "**required**");
    } else if (key->fallback) {
        strbuf_append(&p->out, "`%s`", key->fallback);
    } else {
        strbuf_append(&p->out, "%s", key->otherwise ? key->otherwise : "");
    }
}

static void print_doc(page *p, const key_spec *key)
{
    strbuf_append(&p->out, "%s", key->doc ? key->doc : "");
    if (key->type == KEY_CHOICE) {
        for (const choice *c = key->choices; c->name; c++) {
            if (c->doc) strbuf_append(&p->out, "%s `%s`: %s", c == key->choices ? "." : ";", c->name, c->doc);
        }
    }
    if (key->belongs) strbuf_append(&p->out, " (%.*s only)", (int)strcspn(key->belongs, ":"), key->belongs);
}

static void print_head(page *p)
{
    strbuf_append(&p->out, "\n| key | takes | default | meaning |\n|---|---|---|---|\n");
}

static void print_row(page *p, const key_spec *key)
{
    strbuf_append(&p->out, "| `%s` | ", key->key);
    print_form(p, key);
    strbuf_append(&p->out, " | ");
    print_default(p, key);
    strbuf_append(&p->out, " | ");
    print_doc(p, key);
    strbuf_append(&p->out, " |\n");
}

static void print_rows(page *p, const key_table *table)
{
    print_head(p);
    for (size_t i = 0; i < table->n; i++) print_row(p, &table->key[i]);
}

static void print_params(page *p, const model_entry *entry, const model_family *family)
{
    if (entry->n_params == 0) return;
    print_head(p);
    for (size_t i = 0; i < entry->n_params; i++) {
        key_spec key = key_of_param(entry, i, family);
        char fallback[32];
        snprintf(fallback, sizeof fallback, "%g", entry->params[i].fallback);
        if (!key.required) key.fallback = fallback;
        print_row(p, &key);
    }
    const key_spec *young;
    for (size_t i = 0; (young = young_key(entry, i)); i++) {
        key_spec key = *young;
        key.required = false;
        key.otherwise = "by the moduli";
        print_row(p, &key);
    }
}

static void print_family(page *p, const char *title, const model_family *family)
{
    strbuf_append(&p->out, "\n## %s\n", title);
    model_entry entry;
    for (size_t i = 0; family->get(p->catalogue, i, &entry); i++) {
        strbuf_append(&p->out, "\n### %s\n\n", entry.name);
        print_sentence(p, entry.doc);
        if (stands_alone(&entry)) strbuf_append(&p->out, " It is written `%s: [...]`.", entry.name);
        if (entry.cite && entry.cite[0]) strbuf_append(&p->out, " Source: %s.", entry.cite);
        strbuf_append(&p->out, "\n");
        print_params(p, &entry, family);
    }
}

static void print_variants(page *p, const variants *kinds)
{
    for (size_t i = 0; i < kinds->n; i++) {
        strbuf_append(&p->out, "\n### %s\n\n", kinds->list[i].name);
        print_sentence(p, kinds->list[i].doc);
        strbuf_append(&p->out, "\n");
        if (kinds->list[i].table) print_rows(p, kinds->list[i].table);
    }
}

static void print_names(page *p, const char *title, const deck_name *name, size_t n)
{
    strbuf_append(&p->out, "\n## %s\n\n", title);
    for (size_t i = 0; i < n; i++) strbuf_append(&p->out, "* `%s`: %s\n", name[i].name, name[i].doc ? name[i].doc : "");
}

static void print_title(page *p, const char *name, const char *doc)
{
    strbuf_append(&p->out, "\n## %s\n\n", name);
    print_sentence(p, doc);
    strbuf_append(&p->out, "\n");
}

static const char about_formulas[] =
    "\n## Formulas\n\n"
    "Any number may be a formula of numbers and `constants`: `cell: L / 40`, `pressure: 2 * p0`. Where a key says so, "
    "it may "
    "change with place (`x`, `y`, `z`,\n"
    "or `r`, `z` about an axis, in m) and with time (`t`, in s): `pressure: 1 atm + 10 kPa * exp(-(x / 5 cm)^2)`. Of a "
    "fluid on "
    "cells the first state\n"
    "is averaged over each cell, on points it is that of the point.\n\n"
    "* A number may carry a unit behind a blank, as anywhere in a deck; it ends before ` `, `+`, `-`, `*`, `(`, and a "
    "power is "
    "the unit's: `4 m/s^2`. Where "
    "any number of "
    "a formula carries one,\n"
    "  sums of unlike units and a result of another unit than the key's are refused; a number without a unit may stand "
    "for "
    "anything.\n"
    "* Operators: `+ - * /`, `^` or `**` (before a sign: `-x^2` is `-(x^2)`), `< <= > >= == !=`, `and`, `or`, `not`; "
    "what holds is "
    "1, what does not 0.\n"
    "* `pi`, the deck's `constants`, its `tables` (`push(t)`), and these functions:\n\n";

static void print_formulas(page *p)
{
    const char *form, *doc;
    strbuf_append(&p->out, "%s", about_formulas);
    for (size_t i = 0; expression_describe(i, &form, &doc); i++) strbuf_append(&p->out, "* `%s`: %s\n", form, doc);
}

/* The maps below a table, each in a section of its own; `path` names where it hangs. */
static void print_sections(page *p, const key_table *table, const char *path)
{
    for (size_t i = 0; i < table->n; i++) {
        const key_spec *key = &table->key[i];
        char name[128];
        snprintf(name, sizeof name, "%s%s%s", path, path[0] ? "." : "", key->key);
        if (key->type == KEY_MAP) {
            print_title(p, name, key->doc);
            print_rows(p, key->table);
            print_sections(p, key->table, name);
        } else if (key->type == KEY_NAMED) {
            print_title(p, name, key->doc);
            snprintf(name + strlen(name), sizeof name - strlen(name), ".NAME");
            if (key->items->table) print_rows(p, key->items->table);
            if (key->items->variants) print_variants(p, key->items->variants);
            const key_spec *value = key->items->value;
            if (value && value->type == KEY_SPECIAL)
                strbuf_append(&p->out, "\n`NAME: value`: %s.\n", value->special->form);
            else if (value)
                strbuf_append(&p->out, "\n`NAME: [x, y, z]`: a list, one number for each axis, in m.\n");
            if (key->items->table) print_sections(p, key->items->table, name);
        } else if (key->type == KEY_VARIANT && key->variants != &boundary_kinds) { /* they stand under `boundaries` */
            print_title(p, name, key->doc);
            print_variants(p, key->variants);
        } else if (key->special == &special_boundaries) {
            print_title(p, name, key->doc);
            strbuf_append(&p->out, "\n    %s\n", key->special->form);
            print_variants(p, &boundary_kinds);
        }
    }
}

static const char preface[] =
    "# The deck\n"
    "\n"
    "*Written by floe from the tables that read decks; do not edit.*\n"
    "\n"
    "A deck is one YAML file that describes a scene. `floe check DECK` reports every error in it, with its place. The "
    "order\n"
    "of keys does not matter.\n"
    "\n"
    "* **Numbers** are plain SI, or carry a unit after a space: `117 GPa`, `1.4 ms`, `8900 kg/m^3`, `20 degC`. The "
    "unit must\n"
    "  convert to the one in brackets below. `units: none` declares a dimensionless scene, in which no number carries "
    "one.\n"
    "  Octal, hexadecimal, `nan` and `inf` are refused.\n"
    "* **Lists over the axes** have as many entries as `domain.dim`; in one dimension a number will do.\n"
    "* **Models** (laws, equations of state, shapes, exact solutions, references) are written `{name: {parameter: "
    "value}}`.\n"
    "  Parameters of shapes may be shapes, to any depth.\n"
    "* **Names** of materials, bodies, loads and probes are letters, digits, `_` and `-`, a letter first.\n"
    "* `--set KEY=VALUE` replaces any key on the command line: `--set domain.cell=0.0125`,\n"
    "  `--set materials.steel.law.linear_elastic.bulk_modulus='120 GPa'`, `--set domain.lower.0=-1` (list entries "
    "count\n"
    "  from 0). The value is YAML.\n"
    "* Anchors, aliases, tags and several documents in one file are not used.\n"
    "\n"
    "## Top level\n";

floe_status deck_reference(char **text, context *ctx, const deck_catalogue *catalogue)
{
    page p = {.out = {.ctx = ctx}, .catalogue = catalogue};
    strbuf_append(&p.out, "%s", preface);
    print_rows(&p, &schema_deck);
    print_sections(&p, &schema_deck, "");
    print_formulas(&p);
    print_family(&p, "Shapes", &family_shape);
    print_family(&p, "Laws of solids", &family_law);
    print_family(&p, "Laws of membranes", &family_membrane);
    print_family(&p, "Normals of membranes", &family_normals);
    print_family(&p, "Equations of state", &family_eos);
    print_family(&p, "Exchange of momentum", &family_momentum);
    print_family(&p, "Exchange of heat", &family_heat);
    print_family(&p, "Laws of reactions", &family_reaction);
    print_family(&p, "Exact solutions", &family_exact);
    print_family(&p, "References of histories", &family_reference);
    if (catalogue && catalogue->n_basis > 0) print_names(&p, "Bases", catalogue->basis, catalogue->n_basis);
    if (catalogue && catalogue->n_transfer > 0)
        print_names(&p, "Transfers", catalogue->transfer, catalogue->n_transfer);
    if (catalogue && catalogue->n_normal > 0)
        print_names(&p, "Normals of contact", catalogue->normal, catalogue->n_normal);
    if (catalogue && catalogue->n_metric > 0) print_names(&p, "Metrics", catalogue->metric, catalogue->n_metric);
    if (catalogue && catalogue->n_quantity > 0)
        print_names(&p, "Quantities (the X of metrics)", catalogue->quantity, catalogue->n_quantity);
    return strbuf_take(&p.out, text);
}
