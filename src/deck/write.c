/* The echo: a scene written back through the tables that read it. */
#include "deck/deck_internal.h"
#include "scene/formula.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void write_key_name(writer *w, const char *key)
{
    strbuf_append(&w->out, "%*s%s:", 2 * w->indent, "", key);
}

/* The shortest of 15, 16 and 17 digits that reads back as the same double. */
void write_number(strbuf *out, double x)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, x);
        if (strtod(text, NULL) == x) break;
    }
    strbuf_append(out, "%s", text);
}

void write_quoted(strbuf *out, const char *text)
{
    strbuf_append(out, "\"");
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\') {
            strbuf_append(out, "\\%c", c);
        } else if (c < 0x20 || c == 0x7F) {
            strbuf_append(out, "\\x%02X", c);
        } else {
            strbuf_append_bytes(out, text, 1);
        }
    }
    strbuf_append(out, "\"");
}

/* A number, or the formula that gives it. */
static void write_number_of(writer *w, const double *x)
{
    const expression *formula = scene_formula_of(w->scene, x);
    if (formula)
        write_quoted(&w->out, expression_text(formula));
    else
        write_number(&w->out, *x);
}

static void write_numbers(writer *w, const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        strbuf_append(&w->out, "%s", i == 0 ? " [" : ", ");
        write_number_of(w, &x[i]);
    }
    strbuf_append(&w->out, "]\n");
}

static long load_whole(const key_spec *key, const void *field)
{
    int narrow;
    long wide;
    if (key->size == sizeof wide) {
        memcpy(&wide, field, sizeof wide);
        return wide;
    }
    memcpy(&narrow, field, sizeof narrow);
    return narrow;
}

static const char *choice_of(const key_spec *key, const void *field)
{
    bool flag;
    int value;
    memcpy(&flag, field, sizeof flag);
    if (key->size == sizeof flag) {
        value = flag;
    } else {
        memcpy(&value, field, sizeof value);
    }
    for (const choice *c = key->choices; c->name; c++) {
        if (c->value == value) return c->name;
    }
    return key->choices[0].name;
}

/* Nothing to write: the key was left out, and its absence means the same again. */
static bool is_unset(const key_spec *key, const void *field)
{
    double x;
    int index;
    switch (key->type) {
    case KEY_NUMBER:
    case KEY_NUMBERS:
    case KEY_VECTOR:
    case KEY_SPREAD: memcpy(&x, field, sizeof x); return !isfinite(x);
    case KEY_MATERIAL:
    case KEY_BODY: memcpy(&index, field, sizeof index); return index < 0;
    case KEY_TEXT: return *(const char *)field == '\0';
    /* What no deck may give says that it was left out. */
    case KEY_WHOLE: return key->otherwise && (double)load_whole(key, field) < key->lo;
    default: return false;
    }
}

static void write_wholes(writer *w, const int *x)
{
    for (int i = 0; i < writer_dim(w); i++) strbuf_append(&w->out, "%s%d", i == 0 ? " [" : ", ", x[i]);
    strbuf_append(&w->out, "]\n");
}

static void write_scalar(writer *w, const key_spec *key, const void *base)
{
    const char *field = (const char *)base + key->offset;
    const double *number = (const double *)(const void *)field;
    const size_t dim = (size_t)writer_dim(w);
    if (is_unset(key, field)) return;
    write_key_name(w, key->key);
    switch (key->type) {
    case KEY_NUMBER:
        strbuf_append(&w->out, " ");
        write_number_of(w, number);
        break;
    case KEY_NUMBERS: write_numbers(w, number, key->size / sizeof *number); return;
    case KEY_VECTOR:
    case KEY_SPREAD: write_numbers(w, number, dim); return;
    case KEY_WHOLES: write_wholes(w, (const int *)(const void *)field); return;
    case KEY_WHOLE: strbuf_append(&w->out, " %ld", load_whole(key, field)); break;
    case KEY_BOOL: strbuf_append(&w->out, " %s", *(const bool *)(const void *)field ? "true" : "false"); break;
    case KEY_TEXT:
        strbuf_append(&w->out, " ");
        write_quoted(&w->out, field);
        break;
    case KEY_CHOICE: strbuf_append(&w->out, " %s", choice_of(key, field)); break;
    case KEY_MATERIAL: strbuf_append(&w->out, " %s", w->scene->material[*(const int *)(const void *)field].name); break;
    case KEY_BODY: strbuf_append(&w->out, " %s", w->scene->body[*(const int *)(const void *)field].name); break;
    default: break;
    }
    strbuf_append(&w->out, "\n");
}

static bool find_entry(writer *w, const model_family *family, const char *name, model_entry *entry)
{
    for (size_t i = 0; family->get(w->catalogue, i, entry); i++) {
        if (strcmp(entry->name, name) == 0) return true;
    }
    return false;
}

static void write_models(writer *w, const key_spec *key, const param_list *list);
static void write_model(writer *w, const key_spec *key, const void *base);

/* In a comment, what the file held: a run that goes on compares resolved decks, and so sees that the file is another
 * one. */
static void write_file(writer *w, const param_file *file)
{
    strbuf_append(&w->out, " ");
    write_quoted(&w->out, file->path);
    strbuf_append(&w->out, " # %zu bytes, sha256 %s\n", file->size, file->digest);
}

static void write_points(writer *w, const param_list *list)
{
    const double(*position)[3] = list->item;
    for (size_t i = 0; i < list->n; i++) {
        strbuf_append(&w->out, "%s", i == 0 ? " [" : ", ");
        write_position(w, position[i]);
    }
    strbuf_append(&w->out, "]\n");
}

static void write_param(writer *w, const key_spec *key, const char *par)
{
    const void *field = par + key->offset;
    switch (key->type) {
    case KEY_MODEL: write_model(w, key, par); break;
    case KEY_MODELS:
        write_key_name(w, key->key);
        write_models(w, key, field);
        break;
    case KEY_POINTS:
        write_key_name(w, key->key);
        write_points(w, field);
        break;
    case KEY_FILE:
        write_key_name(w, key->key);
        write_file(w, field);
        break;
    default: write_scalar(w, key, par); break;
    }
}

/* "name:" and its parameters, the name behind a dash in a list. */
static void write_named_model(writer *w, const model_family *family, const model_entry *entry, const void *par)
{
    if (entry->n_params == 0) {
        strbuf_append(&w->out, "%s\n", entry->name);
    } else if (stands_alone(entry)) {
        const key_spec alone = key_of_param(entry, 0, family);
        strbuf_append(&w->out, "%s:", entry->name);
        write_models(w, &alone, (const param_list *)(const void *)((const char *)par + alone.offset));
    } else {
        strbuf_append(&w->out, "%s:\n", entry->name);
        w->indent++;
        for (size_t i = 0; i < entry->n_params; i++) {
            const key_spec param = key_of_param(entry, i, family);
            write_param(w, &param, par);
        }
        w->indent--;
    }
}

/* The entry that is set in a field, and its parameters; false: none is. */
static bool fetch_entry(writer *w, const model_family *family, const void *field, model_entry *entry, const void **par)
{
    const char *name;
    if (!family->fetch(field, &name, par)) return false;
    return family->chosen ? family->chosen(field, entry) : find_entry(w, family, name, entry);
}

static void write_models(writer *w, const key_spec *key, const param_list *list)
{
    const int outer = w->dim;
    if (key->dim > 0) w->dim = key->dim;
    strbuf_append(&w->out, "\n");
    w->indent += 2;
    for (size_t i = 0; i < list->n; i++) {
        const void *field = (const char *)list->item + i * key->family->field_size, *par;
        model_entry entry;
        if (!fetch_entry(w, key->family, field, &entry, &par)) continue;
        strbuf_append(&w->out, "%*s- ", 2 * (w->indent - 1), "");
        write_named_model(w, key->family, &entry, par);
    }
    w->indent -= 2;
    w->dim = outer;
}

static void write_model(writer *w, const key_spec *key, const void *base)
{
    const void *par, *field = (const char *)base + key->offset;
    const int outer = w->dim;
    model_entry entry;
    if (!fetch_entry(w, key->family, field, &entry, &par)) return;
    if (key->dim > 0) w->dim = key->dim;
    write_key_name(w, key->key);
    if (entry.n_params > 0) {
        w->indent++;
        strbuf_append(&w->out, "\n%*s", 2 * w->indent, "");
        write_named_model(w, key->family, &entry, par);
        w->indent--;
    } else {
        strbuf_append(&w->out, " ");
        write_named_model(w, key->family, &entry, par);
    }
    w->dim = outer;
}

/* After "key:", a table on lines of its own; " {}" when it has nothing to say. */
static void write_nested(writer *w, const key_table *table, const void *base)
{
    strbuf_append(&w->out, "\n");
    const size_t before = w->out.length;
    w->indent++;
    write_table(w, table, base);
    w->indent--;
    if (w->out.length == before && w->out.status == FLOE_OK) {
        w->out.length--;
        strbuf_append(&w->out, " {}\n");
    }
}

/* Whether a kind has been chosen. */
static bool has_kind(const variants *kinds, const void *field)
{
    for (size_t i = 0; i < kinds->n; i++)
        if (kinds->list[i].value == kinds->chosen(field)) return true;
    return false;
}

void write_variant(writer *w, const variants *kinds, const void *field)
{
    const int value = kinds->chosen(field);
    for (size_t i = 0; i < kinds->n; i++) {
        const variant *kind = &kinds->list[i];
        if (kind->value != value) continue;
        if (!kind->table) {
            strbuf_append(&w->out, " %s\n", kind->name);
            return;
        }
        strbuf_append(&w->out, "\n");
        w->indent++;
        write_key_name(w, kind->name);
        write_nested(w, kind->table, field);
        w->indent--;
    }
}

static void write_named(writer *w, const key_spec *key, const void *base)
{
    const named_items *items = key->items;
    int count;
    memcpy(&count, (const char *)base + items->count_offset, sizeof count);
    if (count == 0) return;
    write_key_name(w, key->key);
    strbuf_append(&w->out, "\n");
    w->indent++;
    for (int i = 0; i < count; i++) {
        const char *item = (const char *)base + key->offset + (size_t)i * items->item_size;
        if (items->value) {
            key_spec value = *items->value;
            value.key = item;
            if (value.type == KEY_SPECIAL)
                value.special->write(w, &value, item);
            else
                write_scalar(w, &value, item);
            continue;
        }
        write_key_name(w, item);
        if (items->table) {
            write_nested(w, items->table, item);
        } else {
            write_variant(w, items->variants, item);
        }
    }
    w->indent--;
}

static void write_map(writer *w, const key_spec *key, const void *base)
{
    bool present = true;
    const char *of = struct_of_map(key, base);
    if (of && key->present) memcpy(&present, of + key->present - 1, sizeof present);
    if (!of || !present) return;
    const size_t start = w->out.length;
    write_key_name(w, key->key);
    strbuf_append(&w->out, "\n");
    const size_t before = w->out.length;
    w->indent++;
    write_table(w, key->table, of + key->offset);
    w->indent--;
    if (w->out.length == before && w->out.status == FLOE_OK) {
        w->out.length = start; /* nothing under it: as if it were not there */
        w->out.data[start] = '\0';
    }
}

void write_table(writer *w, const key_table *table, const void *base)
{
    for (size_t i = 0; i < table->n; i++) {
        const key_spec *key = &table->key[i];
        if (key->applies && !key->applies(w->scene, base)) continue;
        switch (key->type) {
        case KEY_MAP: write_map(w, key, base); break;
        case KEY_NAMED: write_named(w, key, base); break;
        case KEY_MODEL: write_model(w, key, base); break;
        case KEY_VARIANT:
            if (!has_kind(key->variants, (const char *)base + key->offset)) break;
            write_key_name(w, key->key);
            write_variant(w, key->variants, (const char *)base + key->offset);
            break;
        case KEY_SPECIAL: key->special->write(w, key, base); break;
        default: write_scalar(w, key, base); break;
        }
    }
}

floe_status deck_echo(char **text, const scene *s, const deck_catalogue *catalogue)
{
    writer w = {.out = {.ctx = s->ctx}, .scene = s, .catalogue = catalogue};
    write_table(&w, &schema_deck, s);
    return strbuf_take(&w.out, text);
}
