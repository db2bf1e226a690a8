/* Numbers that are formulas: "2 * p0", "1 atm + 10 kPa * exp(-(x / 5 cm)^2)"; and the constants that they name. */
#include "deck/deck_internal.h"
#include "deck/units.h"
#include "scene/formula.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PATH_MOST = 8 /* names of a key and what it is in */ };

/* What formulas of the deck may name. */
static expression_scope scope_of(const reader *r, expression_function *table)
{
    const scene *s = r->scene;
    expression_scope scope = {.constant = s->constant,
                              .n_constants = (size_t)s->n_constants,
                              .function = table,
                              .n_functions = (size_t)s->n_tables,
                              .unit = s->dimensionless ? NULL : units_to_si};
    for (int a = 0; a < s->mesh.dim; a++) scope.axis[a] = axis_name(&s->mesh, a);
    for (int i = 0; i < s->n_tables; i++) {
        snprintf(table[i].name, sizeof table[i].name, "%s", s->table[i].name);
        table[i].curve = s->table[i].curve;
    }
    return scope;
}

/* A text that is no number: has it a sign that only formulas have? A number with a unit has blanks at one place, and signs
 * only in the unit. */
static bool has_sign_of_formula(const char *text)
{
    static const char *const between[] = {" + ", " - ", " * ", " / ", " ^ "};
    for (size_t i = 0; i < sizeof between / sizeof between[0]; i++)
        if (strstr(text, between[i])) return true;
    const size_t number = strspn(text, "0123456789.");
    return strpbrk(text, "()*<>=") != NULL || (number > 0 && text[number] && strchr("+-/^", text[number]));
}

/* Or it begins with a name, which may be that of a constant. */
static bool may_be_formula(const char *text)
{
    const char *bare = text + strspn(text, "+- ");
    return has_sign_of_formula(text) || isalpha((unsigned char)*bare) || *bare == '_';
}

/* The key of a node with all that it is in, ended by NULL; an entry of a list has the key of its list. */
static floe_status path_of(reader *r, const deck_node *node, const char *const **out)
{
    const char *name[PATH_MOST];
    size_t n = 0;
    for (const deck_node *at = node; at && n < PATH_MOST; at = at->parent)
        if (at->key) name[n++] = at->key;
    char **path, *text;
    size_t bytes = 0;
    for (size_t i = 0; i < n; i++) bytes += strlen(name[i]) + 1;
    TRY(scene_allocate(r->scene, &path, (n + 1) * sizeof *path));
    TRY(scene_allocate(r->scene, &text, bytes + 1));
    for (size_t i = 0; i < n; i++) {
        path[i] = text;
        memcpy(text, name[n - 1 - i], strlen(name[n - 1 - i]) + 1);
        text += strlen(text) + 1;
    }
    *out = (const char *const *)path;
    return FLOE_OK;
}

/* The dimension of a formula must be that of its key, where both are known. */
static bool fits_key(const key_spec *key, const expression_dimension *dimension, char *why)
{
    expression_dimension own;
    double one;
    if (!dimension->known) return true;
    if (!units_to_si(key->unit ? key->unit : "1", 1.0, &one, &own, why)) return false;
    if (memcmp(own.power, dimension->power, sizeof own.power) == 0) return true;
    snprintf(why, EXPRESSION_WHY, "the formula does not give %s%s", key->unit ? "" : "a number without dimension",
             key->unit ? key->unit : "");
    return false;
}

static bool is_allowed(const key_spec *key, const expression *formula, char *why)
{
    const bool place = expression_has_place(formula) && !(key->varies & VARIES_BY_PLACE);
    const bool time = expression_has_time(formula) && !(key->varies & VARIES_BY_TIME);
    if (!place && !time) return true;
    snprintf(why, EXPRESSION_WHY, "a formula that changes with %s, and the key takes one that does not",
             place ? "place" : "time");
    return false;
}

static floe_status keep_formula(reader *r, const key_spec *key, const deck_node *node, double *out, expression *formula,
                                char *why)
{
    const param_spec rule = {.range = key->range, .lo = key->lo, .hi = key->hi};
    const char *const *path;
    if (!expression_has_place(formula) && !expression_has_time(formula)) {
        *out = expression_value(formula, (const double[3]){0.0, 0.0, 0.0}, 0.0);
        expression_destroy(r->ctx, &formula);
        if (!param_in_range(&rule, *out))
            snprintf(why, EXPRESSION_WHY, "the formula gives %g, which is out of range", *out);
        return FLOE_OK;
    }
    const floe_status status = path_of(r, node, &path);
    if (status != FLOE_OK) {
        expression_destroy(r->ctx, &formula);
        return status;
    }
    return scene_add_formula(r->scene, out, formula, &rule, path);
}

floe_status read_formula(reader *r, const key_spec *key, const deck_node *node, double *out, bool *meant,
                         char why[EXPRESSION_WHY])
{
    expression_function table[SCENE_MAX_TABLES];
    const expression_scope scope = scope_of(r, table);
    expression_dimension dimension;
    expression *formula;
    why[0] = '\0';
    *meant = false;
    if (!may_be_formula(node->text)) return FLOE_OK;
    const floe_status status = expression_create(r->ctx, node->text, &scope, &formula, &dimension, why);
    *meant = status == FLOE_OK || has_sign_of_formula(node->text);
    if (status == FLOE_BAD_INPUT) return FLOE_OK;
    TRY(status);
    if (fits_key(key, &dimension, why) && is_allowed(key, formula, why))
        return keep_formula(r, key, node, out, formula, why);
    expression_destroy(r->ctx, &formula);
    return FLOE_OK;
}

floe_status read_any_number(reader *r, const deck_node *node, double *out, expression_dimension *dimension,
                            char why[EXPRESSION_WHY])
{
    expression_function table[SCENE_MAX_TABLES];
    expression_scope scope = scope_of(r, table);
    expression *formula;
    *out = (double)NAN;
    why[0] = '\0';
    for (int a = 0; a < 3; a++) scope.axis[a] = NULL;
    const floe_status status = expression_create(r->ctx, node->text, &scope, &formula, dimension, why);
    if (status == FLOE_BAD_INPUT) return FLOE_OK;
    TRY(status);
    if (!expression_has_time(formula)) *out = expression_value(formula, (const double[3]){0.0, 0.0, 0.0}, 0.0);
    if (!isfinite(*out)) snprintf(why, EXPRESSION_WHY, "'%.60s' gives no number", node->text);
    expression_destroy(r->ctx, &formula);
    return FLOE_OK;
}

/* ---- constants ---- */

static floe_status read_constant(reader *r, const key_spec *key, deck_node *node, void *base)
{
    expression_constant *own = base;
    char why[EXPRESSION_WHY];
    if (!node || node->kind != NODE_SCALAR || node_is_null(node)) return bad_form(r, key, node, key->special->form);
    r->scene->n_constants--; /* it may name those before it */
    const floe_status status = read_any_number(r, node, &own->value, &own->dimension, why);
    r->scene->n_constants++;
    TRY(status);
    return why[0] ? bad(r, node, key->special->form, "'%s': %s", own->name, why) : FLOE_OK;
}

static void write_constant(writer *w, const key_spec *key, const void *base)
{
    const expression_constant *own = base;
    write_key_name(w, key->key);
    strbuf_append(&w->out, " ");
    write_number(&w->out, own->value);
    strbuf_append(&w->out, "\n");
}

const special_key special_constant = {
    .read = read_constant,
    .write = write_constant,
    .form = "a number, with its unit, or a formula of numbers and of the constants before it",
    .json = "{\"type\": [\"number\", \"string\"]}",
};
static const key_spec constant_key = {"", KEY_SPECIAL, .special = &special_constant};

floe_status check_formula_name(reader *r, deck_node *node, const char *name)
{
    static const char *const reserved[] = {"x", "y", "z", "r", "t", "pi", "and", "or", "not"};
    const char *form, *doc;
    const size_t length = strlen(name);
    bool taken = strchr(name, '-') != NULL;
    for (size_t i = 0; i < sizeof reserved / sizeof reserved[0]; i++) taken = taken || strcmp(name, reserved[i]) == 0;
    for (size_t i = 0; expression_describe(i, &form, &doc); i++)
        taken = taken || (strncmp(form, name, length) == 0 && form[length] == '(');
    for (int i = 0; i < r->scene->n_constants; i++)
        taken = taken || (name != r->scene->constant[i].name && strcmp(name, r->scene->constant[i].name) == 0);
    if (!taken) return FLOE_OK;
    return bad_key(r, node, "letters, digits and '_'; not x, y, z, r, t, pi, a word of formulas, or a constant", NULL,
                   "'%.60s' cannot be named in a formula", name);
}

static floe_status begin_constant(reader *r, deck_node *node, void *item)
{
    return check_formula_name(r, node, ((const expression_constant *)item)->name);
}

const named_items items_constants = {
    .noun = "constant",
    .item_size = sizeof(expression_constant),
    .count_offset = offsetof(scene, n_constants),
    .most = SCENE_MAX_CONSTANTS,
    .value = &constant_key,
    .begin = begin_constant,
};
