/* Every key of the schema, spoiled in every way that its entry in the tables knows of: a wrong kind of value, out of range, of a wrong
 * unit, without a value, twice, missing, where it does not belong, and an unknown key beside it. Each is refused with status 2, at its
 * file, line and column, in words that name the key or the value and say what would do. */
#include "check.h"

#include "base/memory.h"
#include "deck/deck_internal.h"
#include "run/catalogue.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_LEVELS = 24, LINE = 200, TEXT = 16384 };

typedef struct walk {
    context *ctx;
    deck_catalogue *catalogue;
    struct {
        char text[LINE];
        int level;
    } line[MOST_LEVELS]; /* the way down to a table: "materials:", "x:", and what must stand beside a key */
    int depth, level;
    const model_family *within;          /* whose models are walked */
    bool in_space;                       /* the deck is of a scene in 3-D */
    int keys, spoiled, wrong, misplaced; /* misplaced: refused because the key does not belong there */
} walk;

static int set_up(void **state)
{
    static walk w;
    memset(&w, 0, sizeof w);
    deck_init();
    w.ctx = context_create();
    *state = &w;
    return w.ctx && catalogue_create(&w.catalogue, w.ctx) == FLOE_OK ? 0 : -1;
}

static int tear_down(void **state)
{
    walk *w = *state;
    catalogue_destroy(w->ctx, &w->catalogue);
    assert_int_equal(memory_read_account(w->ctx).live_bytes, 0);
    context_destroy(&w->ctx);
    return 0;
}

static void add_line(walk *w, const char *format, const char *text)
{
    assert_in_range(w->depth, 0, MOST_LEVELS - 1);
    snprintf(w->line[w->depth].text, LINE, format, text);
    w->line[w->depth++].level = w->level;
}

static void descend(walk *w, const char *name)
{
    add_line(w, "%s:", name);
    w->level++;
}

static void ascend(walk *w)
{
    w->level--;
    w->depth--;
}

/* Is the way down through this key? */
static bool is_below(const walk *w, const char *key)
{
    for (int i = 0; i < w->depth; i++) {
        if (strcmp(w->line[i].text, key) == 0) return true;
    }
    return false;
}

static const char two_materials[] = "materials: {string: {density: 1, membrane: {plane_stress: {modulus: 1}}}, gas: "
                                    "{eos: {ideal: {specific_heat: 1}}}}";
static const char one_body[] = "bodies: {b: {material: gas, shape: everywhere}}";

/* A deck in which the key stands alone at the end of its way: much is missing in it, and that is said too. *last is the number of
 * the line after the ways. */
static size_t begin_deck(const walk *w, const char *lines, char *text, int *last)
{
    const int dim = w->in_space ? 3 : 2;
    size_t n = (size_t)snprintf(text, TEXT, "floe: 1\n");
    *last = 1;
    if (!is_below(w, "domain:") && strncmp(lines, "domain", 6) != 0) {
        n += (size_t)snprintf(text + n, TEXT - n, "domain: {dim: %d, lower: %s, upper: %s, cell: 0.5}\n", dim,
                              dim == 3 ? "[0, 0, 0]" : "[0, 0]", dim == 3 ? "[1, 1, 1]" : "[1, 1]");
        ++*last;
    }
    if (!is_below(w, "materials:") && strncmp(lines, "materials", 9) != 0) {
        n += (size_t)snprintf(text + n, TEXT - n, "%s\n", two_materials);
        ++*last;
    }
    if (is_below(w, "springs:")) {
        n += (size_t)snprintf(text + n, TEXT - n, "%s\n", one_body);
        ++*last;
    }
    for (int i = 0; i < w->depth; i++) {
        const char *nothing = i + 1 == w->depth && !lines[0] ? " {}" : "";
        n += (size_t)snprintf(text + n, TEXT - n, "%*s%s%s\n", 2 * w->line[i].level, "", w->line[i].text, nothing);
        ++*last;
    }
    return n;
}

/* The message at that line which has the word, NULL if there is none. *length is up to the end of what belongs to it. */
static const char *message_at(const char *report, int line, const char *word, size_t *length)
{
    char place[64];
    snprintf(place, sizeof place, "deck.yaml:%d:", line);
    for (const char *at = strstr(report, place); at; at = strstr(at + 1, place)) {
        const char *end = strchr(at, '\n'), *next = strstr(at + 1, "deck.yaml:");
        const char *found = strstr(at, word);
        *length = next ? (size_t)(next - at) : strlen(at);
        if (found && end && found < end) return at;
    }
    return NULL;
}

static bool holds(const char *text, size_t length, const char *word)
{
    const char *at = strstr(text, word);
    return at && (size_t)(at - text) < length;
}

/* It says what would do: what is expected, a hint, the nearest name, or where the key belongs. */
static bool has_remedy(const char *text, size_t length)
{
    return holds(text, length, "expected: ") || holds(text, length, "hint: ") || holds(text, length, "did you mean ") ||
           holds(text, length, " belongs to ") || holds(text, length, "takes no keys") ||
           holds(text, length, "first at line ");
}

/* Loads the deck of the way with `lines` at its end; the error is to stand in line `at` of them (from 0; -1: the line before them) and
 * name `word`. */
static void refuse(walk *w, const char *lines, int at, const char *word)
{
    static char text[TEXT];
    int last;
    size_t n = begin_deck(w, lines, text, &last), length = 0;
    for (const char *line = lines; *line; line += strcspn(line, "\n") + 1)
        n += (size_t)snprintf(text + n, TEXT - n, "%*s%.*s\n", 2 * w->level, "", (int)strcspn(line, "\n"), line);
    deck_report report;
    scene *s;
    const floe_status status = deck_load_text(&s, w->ctx, "deck.yaml", text, strlen(text), NULL, w->catalogue, &report);
    const char *found = report.text ? message_at(report.text, last + 1 + at, word, &length) : NULL;
    w->spoiled++;
    if (found && holds(found, length, " belongs to ")) w->misplaced++;
    if (status != FLOE_BAD_INPUT || !found || !has_remedy(found, length)) {
        w->wrong++;
        print_error("status %s, %s at line %d that names %s, in\n%s->\n%s\n", status_name(status),
                    found ? "no remedy" : "nothing", last + 1 + at, word, text,
                    report.text ? report.text : "(nothing)");
    }
    scene_destroy(&s);
    deck_report_free(&report);
    context_clear(w->ctx);
}

static void refuse_value(walk *w, const char *key, const char *value, const char *word)
{
    char line[2 * LINE], quoted[LINE];
    snprintf(quoted, sizeof quoted, "'%s'", word);
    snprintf(line, sizeof line, "%s: %s\n", key, value);
    refuse(w, line, 0, quoted);
}

static void refuse_number(walk *w, const char *key, double value, const char *format)
{
    char number[64], text[LINE];
    snprintf(number, sizeof number, "%.9g", value);
    snprintf(text, sizeof text, format, number);
    refuse_value(w, key, text, key);
}

/* Beyond either end of the range, in a list where `format` has one. */
static void spoil_range(walk *w, const key_spec *key, const char *format)
{
    switch (key->range) {
    case PARAM_POSITIVE: refuse_number(w, key->key, 0.0, format); /* fall through */
    case PARAM_NONNEGATIVE: refuse_number(w, key->key, -1.0, format); break;
    case PARAM_BETWEEN:
        refuse_number(w, key->key, key->lo - fmax(1e-3, 1e-3 * fabs(key->lo)), format);
        refuse_number(w, key->key, key->hi + fmax(1e-3, 1e-3 * fabs(key->hi)), format);
        break;
    case PARAM_ANY: break;
    }
    refuse_number(w, key->key, INFINITY, format);
}

static void spoil_unit(walk *w, const key_spec *key, const char *format)
{
    char text[LINE];
    const bool plain = !key->unit || strcmp(key->unit, "1") == 0;
    snprintf(text, sizeof text, format, plain ? "1 m" : "1 candela");
    refuse_value(w, key->key, text, key->key);
}

/* "%s" in a list as long as the key wants it. */
static const char *list_format(const walk *w, const key_spec *key)
{
    const size_t n = key->type == KEY_NUMBERS ? key->size / sizeof(double) : w->in_space ? 3 : 2;
    static const char *const format[] = {
        "", "[%s]", "[1, %s]", "[1, 1, %s]", "[1, 1, 1, %s]", "[1, 1, 1, 1, %s]", "[1, 1, 1, 1, 1, %s]"};
    assert_in_range(n, 1, 6);
    return format[n];
}

static void spoil_whole(walk *w, const key_spec *key)
{
    char text[LINE];
    refuse_value(w, key->key, "1.5", key->key);
    snprintf(text, sizeof text, "%.0f", key->lo - 1.0);
    refuse_value(w, key->key, text, key->key);
    snprintf(text, sizeof text, "%.0f", key->hi + 1.0);
    refuse_value(w, key->key, text, key->key);
}

static void spoil_models(walk *w, const key_spec *key)
{
    refuse_value(w, key->key, "nonesuch", key->key);
    refuse_value(w, key->key, "[]", key->key);
    refuse_value(w, key->key, "[nonesuch]", "nonesuch");
    refuse_value(w, key->key, "[{nonesuch: {a: 1}}]", "nonesuch");
    refuse_value(w, key->key, "[{some: {a: 1}, others: {a: 1}}]", key->family->noun);
}

static void spoil_points(walk *w, const key_spec *key)
{
    char line[LINE];
    refuse_value(w, key->key, "much", key->key);
    refuse_value(w, key->key, "[]", key->key);
    refuse_value(w, key->key, w->in_space ? "[[1, 2, 3], [2, 3, 4], [much, 1, 2]]" : "[[1, 2], [2, 3], [much, 1]]",
                 key->key);
    snprintf(line, sizeof line, "%s: [[1, 2], [2, 3], [1, 2, 3, 4]]\n", key->key);
    refuse(w, line, 0, "no place");
}

/* Ways that belong to the type. */
static void spoil_type(walk *w, const key_spec *key)
{
    const char *list = NULL;
    switch (key->type) {
    case KEY_NUMBER:
        refuse_value(w, key->key, "much", key->key);
        spoil_range(w, key, "%s");
        spoil_unit(w, key, "%s");
        break;
    case KEY_NUMBERS:
    case KEY_VECTOR:
    case KEY_SPREAD:
        list = list_format(w, key);
        refuse_value(w, key->key, "much", key->key);
        refuse_value(w, key->key, "[1, 1, 1, 1, 1]", key->key);
        spoil_range(w, key, list);
        spoil_unit(w, key, list);
        break;
    case KEY_WHOLE:
    case KEY_WHOLES: spoil_whole(w, key); break;
    case KEY_BOOL: refuse_value(w, key->key, "maybe", key->key); break;
    case KEY_TEXT: break;
    case KEY_CHOICE:
    case KEY_MATERIAL:
    case KEY_BODY:
    case KEY_MODEL:
    case KEY_VARIANT: refuse_value(w, key->key, "nonesuch", "nonesuch"); break;
    case KEY_MAP:
    case KEY_NAMED: refuse_value(w, key->key, "nonesuch", key->key); break;
    case KEY_MODELS: spoil_models(w, key); break;
    case KEY_POINTS: spoil_points(w, key); break;
    case KEY_FILE: refuse_value(w, key->key, "/nonesuch.stl", "/nonesuch.stl"); break;
    case KEY_SPECIAL: break; /* test_deck_errors.c */
    }
}

/* What any key can suffer. A model or a variant of two names is told at the second of them. */
static void spoil_any(walk *w, const key_spec *key)
{
    char line[3 * LINE], quoted[LINE];
    if (key->type == KEY_MODEL || key->type == KEY_VARIANT) {
        refuse_value(w, key->key, "{nonesuch: {a: 1}}", "nonesuch");
        refuse_value(w, key->key, "{some: {a: 1}, others: {a: 1}}", key->key);
        refuse_value(w, key->key, "[1, 2]", key->key);
    } else if (key->type == KEY_MAP) {
        refuse_value(w, key->key, "{nonesuch: 1}", "nonesuch");
        refuse_value(w, key->key, "[1, 2]", key->key);
    } else if (key->type == KEY_NAMED) {
        refuse_value(w, key->key, "{9: {}}", "9");
    } else if (key->type != KEY_SPECIAL && key->type != KEY_CHOICE && key->type != KEY_MATERIAL &&
               key->type != KEY_BODY) {
        refuse_value(w, key->key, "{a: 1}", key->key);
    }
    if (key->type != KEY_TEXT && key->type != KEY_MODEL) refuse_value(w, key->key, "", key->key);
    snprintf(line, sizeof line, "%s: 1\n%s: 1\n", key->key, key->key);
    snprintf(quoted, sizeof quoted, "duplicate key '%s'", key->key);
    refuse(w, line, 1, quoted);
    snprintf(line, sizeof line, "%s: 1\n%s_not: 1\n", key->key, key->key);
    snprintf(quoted, sizeof quoted, "unknown key '%s_not'", key->key);
    refuse(w, line, 1, quoted);
}

/* Missing: told where its map begins. */
static void spoil_missing(walk *w, const key_spec *key)
{
    char quoted[LINE];
    if (!key->required || key->applies || w->depth == 0) return;
    snprintf(quoted, sizeof quoted, "missing key '%s'", key->key);
    refuse(w, "", -1, quoted);
}

/* What must stand beside a key that belongs to some items only: by the first key of its way, and its own. */
typedef struct helper {
    const char *way, *key, *beside;
} helper;

static const helper helpers[] = {
    {"materials:", "one_way", "membrane: {plane_stress: {modulus: 1}}"},
    {"materials:", "density", "law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}"},
    {"materials:", "specific_heat", "law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}"},
    {"materials:", "tension_switch", "law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}"},
    {"materials:", "plastic_heat", "law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}"},
    {"materials:", "expansion", "law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}"},
    {"materials:", "stress_free_temperature", "law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}"},
    {"bodies:", "membrane", "material: string"},
    {"contact:", "friction", "kind: friction"},
    {"method:", "filter_order", "transfer: xpic"},
    {"method:", "domain_limit", "basis: cpdi"},
    {"time:", "increments", "solver: static"},
    {"time:", "tolerance", "solver: static"},
    {"springs:", "point", "body: b"},
};

/* Adds it to the way; the number of lines added. */
static int add_helper(walk *w, const char *key)
{
    for (size_t i = 0; i < sizeof helpers / sizeof helpers[0]; i++) {
        const bool here = w->level <= 3 && w->depth > 0 && strcmp(helpers[i].way, w->line[0].text) == 0;
        if (!here || strcmp(helpers[i].key, key) != 0) continue;
        add_line(w, "%s", helpers[i].beside);
        return 1;
    }
    return 0;
}

static void walk_table(walk *w, const key_table *table);

static void walk_family(walk *w, const model_family *family)
{
    model_entry entry;
    for (size_t i = 0; family->get(w->catalogue, i, &entry); i++) {
        key_spec key[32];
        assert_in_range(entry.n_params, 0, 32);
        for (size_t k = 0; k < entry.n_params; k++) key[k] = key_of_param(&entry, k, family);
        if (stands_alone(&entry)) {
            w->keys++;
            spoil_type(w, &key[0]);
            continue;
        }
        const bool in_space = w->in_space;
        if (family->misfit && family->misfit(&entry, in_space ? 3 : 2)) w->in_space = !in_space;
        descend(w, entry.name);
        walk_table(w, &(key_table){key, entry.n_params});
        ascend(w);
        w->in_space = in_space;
    }
}

static void walk_variants(walk *w, const variants *kinds)
{
    for (size_t i = 0; i < kinds->n; i++) {
        descend(w, kinds->list[i].name);
        if (kinds->list[i].table)
            walk_table(w, kinds->list[i].table);
        else
            refuse(w, "nonesuch: 1\n", 0, kinds->list[i].name);
        ascend(w);
    }
}

static void walk_items(walk *w, const named_items *items)
{
    if (items->value) {
        spoil_type(w, items->value);
        return;
    }
    descend(w, "x");
    if (items->table) walk_table(w, items->table);
    if (items->variants) walk_variants(w, items->variants);
    ascend(w);
}

/* The keys below a key. */
static void walk_below(walk *w, const key_spec *key)
{
    descend(w, key->key);
    if (key->type == KEY_MAP) walk_table(w, key->table);
    if (key->type == KEY_NAMED) walk_items(w, key->items);
    if (key->type == KEY_MODEL && key->family != w->within) { /* models in models once */
        const model_family *outer = w->within;
        w->within = key->family;
        walk_family(w, key->family);
        w->within = outer;
    }
    if (key->type == KEY_VARIANT) walk_variants(w, key->variants);
    ascend(w);
}

static void walk_key(walk *w, const key_spec *key)
{
    const int added = add_helper(w, key->key);
    const bool in_space = w->in_space;
    w->in_space = in_space || strcmp(key->key, "surface") == 0; /* of a membrane, in 3-D alone */
    w->keys++;
    spoil_missing(w, key);
    spoil_type(w, key);
    spoil_any(w, key);
    walk_below(w, key);
    w->depth -= added;
    w->in_space = in_space;
}

static void walk_table(walk *w, const key_table *table)
{
    for (size_t i = 0; i < table->n; i++) walk_key(w, &table->key[i]);
}

static void every_key_is_refused_at_its_place(void **state)
{
    walk *w = *state;
    walk_table(w, &schema_deck);
    print_message("%d keys, %d spoiled decks, %d not refused as they should be\n", w->keys, w->spoiled, w->wrong);
    assert_int_equal(w->wrong, 0);
    assert_int_equal(w->misplaced, 0);
    check_true(w->keys > 300);
}

/* The kinds of a side, which stand below an axis and not below a key of the tables. */
static void every_key_of_a_side_is_refused(void **state)
{
    walk *w = *state;
    descend(w, "boundaries");
    descend(w, "x");
    descend(w, "lower");
    walk_variants(w, &boundary_kinds);
    print_message("%d keys, %d spoiled decks, %d not refused as they should be\n", w->keys, w->spoiled, w->wrong);
    assert_int_equal(w->wrong, 0);
    check_true(w->keys > 20);
}

/* Combinations: keys that belong to another kind of item than the one they stand in. */
typedef struct misplacement {
    const char *table, *item, *beside; /* the way, and what makes the item what it is */
    const char *keys[8];
} misplacement;

#define A_GAS "eos: {ideal: {specific_heat: 1}}"
#define A_LAW "law: {linear_elastic: {bulk_modulus: 1, shear_modulus: 1}}"
static const misplacement misplacements[] = {
    {"materials",
     "x",
     A_GAS,
     {"law", "membrane", "one_way", "density", "specific_heat", "tension_switch", "plastic_heat", "expansion"}},
    {"materials", "x", A_LAW, {"one_way", "viscosity"}},
    {"materials",
     "x",
     "membrane: {plane_stress: {modulus: 1}}",
     {"law", "viscosity", "conductivity", "plastic_heat", "expansion", "stress_free_temperature"}},
    {"bodies", "x", "material: gas", {"membrane"}},
    {"bodies", "x", "material: string", {"shape", "pressure", "density", "fraction"}},
    {"contact", NULL, "kind: stick", {"criterion", "friction"}},
    {"contact", NULL, "kind: release", {"friction"}},
    {"method", NULL, "transfer: apic", {"flip", "filter_order"}},
    {"method", NULL, "transfer: xpic", {"flip"}},
    {"method", NULL, "basis: linear", {"domain_limit"}},
};

static void keys_of_other_items_are_refused(void **state)
{
    walk *w = *state;
    for (size_t i = 0; i < sizeof misplacements / sizeof misplacements[0]; i++) {
        const misplacement *m = &misplacements[i];
        w->depth = w->level = 0;
        descend(w, m->table);
        if (m->item) descend(w, m->item);
        add_line(w, "%s", m->beside);
        for (size_t k = 0; k < 8 && m->keys[k]; k++) {
            char line[LINE], quoted[LINE];
            w->keys++;
            snprintf(line, sizeof line, "%s: 1\n", m->keys[k]);
            snprintf(quoted, sizeof quoted, "'%s' belongs to ", m->keys[k]);
            refuse(w, line, 0, quoted);
        }
    }
    assert_int_equal(w->wrong, 0);
    assert_int_equal(w->misplaced, w->keys);
    check_true(w->keys > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_key_is_refused_at_its_place, set_up, tear_down),
        cmocka_unit_test_setup_teardown(every_key_of_a_side_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(keys_of_other_items_are_refused, set_up, tear_down),
    };
    return cmocka_run_group_tests_name("deck_keys", tests, NULL, NULL);
}
