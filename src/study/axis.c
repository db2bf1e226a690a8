#include "study/axis.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static bool complain_of_axis(strbuf *errors, const char *text, const char *why)
{
    strbuf_append(errors, "axis '%s': %s: write KEY=V1,V2,... as in domain.cell=0.1,0.05\n", text, why);
    return false;
}

/* Length of the value that begins at `text`: up to a comma or semicolon outside brackets and quotes. */
static size_t value_length(const char *text)
{
    int depth = 0;
    char quote = '\0';
    size_t i = 0;
    for (; text[i] && ((text[i] != ',' && text[i] != ';') || depth > 0 || quote); i++) {
        if (quote) {
            if (text[i] == quote) quote = '\0';
        } else if (text[i] == '"' || text[i] == '\'') {
            quote = text[i];
        } else if (text[i] == '[' || text[i] == '{') {
            depth++;
        } else if (text[i] == ']' || text[i] == '}') {
            depth--;
        }
    }
    return i;
}

static int find_value(const scene_axis *axis, const char *value)
{
    for (int i = 0; i < axis->n_values; i++) {
        if (axis_same_value(axis->value[i], value)) return i;
    }
    return -1;
}

/* The key before '=' at *at, which moves behind it. */
static bool parse_axis_key(const char *whole, const char **at, char key[SCENE_KEY], strbuf *errors)
{
    while (isspace((unsigned char)**at)) (*at)++;
    const size_t length = strcspn(*at, "=");
    if (length == 0 || (*at)[length] == '\0') return complain_of_axis(errors, whole, "it has no key with values");
    if (length >= SCENE_KEY) return complain_of_axis(errors, whole, "its key is too long");
    (void)snprintf(key, SCENE_KEY, "%.*s", (int)length, *at);
    *at += length + 1;
    if (**at == '\0') return complain_of_axis(errors, whole, "its list of values is empty");
    return true;
}

/* Value number n at *at, blanks around it left out; *at moves to the separator behind it. */
static bool parse_axis_value(const char *whole, const char **at, int n, char value[SCENE_VALUE], strbuf *errors)
{
    char why[SCENE_VALUE];
    const char *from = *at;
    size_t length = value_length(from);
    *at += length;
    while (length > 0 && isspace((unsigned char)*from)) from++, length--;
    while (length > 0 && isspace((unsigned char)from[length - 1])) length--;
    (void)snprintf(why, sizeof why, "its value %d is empty", n);
    if (length == 0) return complain_of_axis(errors, whole, why);
    (void)snprintf(why, sizeof why, "its value %d is longer than %d characters", n, SCENE_VALUE - 1);
    if (length >= SCENE_VALUE) return complain_of_axis(errors, whole, why);
    (void)snprintf(why, sizeof why, "it has more than %d values", SCENE_MAX_AXIS);
    if (n > SCENE_MAX_AXIS) return complain_of_axis(errors, whole, why);
    (void)snprintf(value, SCENE_VALUE, "%.*s", (int)length, from);
    return true;
}

static bool parse_axis_values(const char *whole, const char **at, scene_axis *axis, strbuf *errors)
{
    for (;; (*at)++) {
        char value[SCENE_VALUE], why[2 * SCENE_VALUE];
        if (!parse_axis_value(whole, at, axis->n_values + 1, value, errors)) return false;
        (void)snprintf(why, sizeof why, "the value '%s' is given twice", value);
        if (find_value(axis, value) >= 0) return complain_of_axis(errors, whole, why);
        memcpy(axis->value[axis->n_values++], value, sizeof value);
        if (**at != ',') return true;
    }
}

/* ";KEY=V1,V2,...": as many values as the axis has. */
static bool parse_with_values(const char *whole, const char **at, scene_axis *axis, strbuf *errors)
{
    char value[SCENE_VALUE], why[2 * SCENE_KEY + 96];
    scene_values *with = &axis->with[axis->n_with];
    int given = 0;
    (void)snprintf(why, sizeof why, "more than %d keys change along with '%s'", SCENE_MAX_WITH, axis->key);
    if (axis->n_with == SCENE_MAX_WITH) return complain_of_axis(errors, whole, why);
    if (!parse_axis_key(whole, at, with->key, errors)) return false;
    for (int n = 0; n == 0 || **at == ','; n++) {
        if (n > 0) (*at)++;
        if (!parse_axis_value(whole, at, n + 1, value, errors)) return false;
        if (n < axis->n_values) memcpy(with->value[n], value, sizeof value);
        given = n + 1;
    }
    (void)snprintf(why, sizeof why, "'%s' has %d values for %d of '%s'", with->key, given, axis->n_values, axis->key);
    if (given != axis->n_values) return complain_of_axis(errors, whole, why);
    axis->n_with++;
    return true;
}

bool axis_parse(const char *text, scene_axis *axis, strbuf *errors)
{
    const char *at = text;
    *axis = (scene_axis){0};
    if (!parse_axis_key(text, &at, axis->key, errors) || !parse_axis_values(text, &at, axis, errors)) return false;
    while (*at == ';') {
        at++;
        if (!parse_with_values(text, &at, axis, errors)) return false;
    }
    return true;
}

floe_status axis_from_text(context *ctx, const char *option, const char *text, scene_axis *axis)
{
    strbuf errors;
    strbuf_init(&errors, ctx);
    floe_status status = FLOE_OK;
    if (!axis_parse(text, axis, &errors))
        status = fail(ctx, FLOE_BAD_INPUT, "%s: %.*s", option, (int)errors.length - 1, strbuf_string(&errors));
    else if (axis->n_with > 0)
        status = fail(ctx, FLOE_BAD_INPUT, "%s: '%s' changes along with '%s': only axes of a study do that", option,
                      axis->with[0].key, axis->key);
    strbuf_free(&errors);
    return status;
}

int axis_find(const axis_list *list, const char *key)
{
    for (int i = 0; i < list->n; i++) {
        if (strcmp(list->axis[i].key, key) == 0) return i;
    }
    return -1;
}

/* What goes along with the values of `from` goes along with those of `to`, which are some of them. */
static bool take_along(scene_axis *to, const scene_axis *from, strbuf *errors)
{
    to->n_with = from->n_with;
    for (int k = 0; k < from->n_with; k++) memcpy(to->with[k].key, from->with[k].key, sizeof to->with[k].key);
    for (int i = 0; i < to->n_values; i++) {
        const int at = find_value(from, to->value[i]);
        for (int k = 0; at >= 0 && k < from->n_with; k++)
            memcpy(to->with[k].value[i], from->with[k].value[at], sizeof to->with[k].value[i]);
        if (at >= 0) continue;
        strbuf_append(
            errors,
            "axis '%s': the deck does not say what goes along with %s: add ';%s=...', a value for each of this "
            "axis, or take some of the deck's\n",
            to->key, to->value[i], from->with[0].key);
        return false;
    }
    return true;
}

bool axis_put(axis_list *list, const scene_axis *axis, strbuf *errors)
{
    const int at = axis_find(list, axis->key);
    if (at >= 0) {
        scene_axis fresh = *axis;
        const bool alone = axis->n_with == 0 && list->axis[at].n_with > 0;
        if (alone && !take_along(&fresh, &list->axis[at], errors)) return false;
        list->axis[at] = fresh;
        return true;
    }
    if (list->n == SCENE_MAX_AXES) {
        strbuf_append(errors, "axis '%s': more than %d axes: fix some of them with --set\n", axis->key, SCENE_MAX_AXES);
        return false;
    }
    list->axis[list->n++] = *axis;
    return true;
}

static bool sets_key(const scene_axis *axis, const char *key)
{
    bool found = strcmp(axis->key, key) == 0;
    for (int k = 0; k < axis->n_with; k++) found = found || strcmp(axis->with[k].key, key) == 0;
    return found;
}

static void check_key(const axis_list *list, int i, const char *key, strbuf *errors)
{
    for (int j = 0; j < i; j++) {
        if (sets_key(&list->axis[j], key))
            strbuf_append(errors, "the axes '%s' and '%s' both set '%s'\n", list->axis[j].key, list->axis[i].key, key);
    }
}

void axis_check_keys(const axis_list *list, strbuf *errors)
{
    for (int i = 1; i < list->n; i++) {
        check_key(list, i, list->axis[i].key, errors);
        for (int k = 0; k < list->axis[i].n_with; k++) check_key(list, i, list->axis[i].with[k].key, errors);
    }
}

bool axis_number(const char *value, double *number, const char **unit)
{
    char *end;
    *number = strtod(value, &end);
    if (end == value) return false;
    while (isspace((unsigned char)*end)) end++;
    *unit = end;
    return *end == '\0' || isalpha((unsigned char)*end) || *end == '%';
}

/* A text without the quotes about all of it, by its length. */
static const char *without_quotes(const char *text, size_t *length)
{
    *length = strlen(text);
    const char quote = text[0];
    if ((quote != '"' && quote != '\'') || *length < 2 || strchr(text + 1, quote) != text + *length - 1) return text;
    *length -= 2;
    return text + 1;
}

bool axis_same_value(const char *a, const char *b)
{
    double x, y;
    const char *of_x, *of_y;
    size_t length_a, length_b;
    const char *bare_a = without_quotes(a, &length_a), *bare_b = without_quotes(b, &length_b);
    if (length_a == length_b && memcmp(bare_a, bare_b, length_a) == 0) return true;
    return axis_number(a, &x, &of_x) && axis_number(b, &y, &of_y) && x == y && strcmp(of_x, of_y) == 0;
}

bool axis_is_numeric(const scene_axis *axis)
{
    double first, x;
    const char *unit, *other;
    if (axis->n_values < 2 || !axis_number(axis->value[0], &first, &unit) || !(first > 0.0)) return false;
    for (int i = 1; i < axis->n_values; i++) {
        if (!axis_number(axis->value[i], &x, &other) || !(x > 0.0) || strcmp(unit, other) != 0) return false;
    }
    return true;
}
