#include "study/axis.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static bool complain(strbuf *errors, const char *text, const char *why)
{
    strbuf_append(errors, "axis '%s': %s: write KEY=V1,V2,... as in domain.cell=0.1,0.05\n", text, why);
    return false;
}

/* Length of the value that begins at `text`: up to a comma outside brackets and quotes. */
static size_t value_length(const char *text)
{
    int depth = 0;
    char quote = '\0';
    size_t i = 0;
    for (; text[i] && (text[i] != ',' || depth > 0 || quote); i++) {
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

static bool is_listed(const scene_axis *axis, const char *value)
{
    for (int i = 0; i < axis->n_values; i++) {
        if (axis_same_value(axis->value[i], value)) return true;
    }
    return false;
}

/* One value, blanks around it left out. */
static bool add_value(const char *whole, scene_axis *axis, const char *from, size_t length, strbuf *errors)
{
    char value[SCENE_VALUE], why[2 * SCENE_VALUE];
    while (length > 0 && isspace((unsigned char)*from)) from++, length--;
    while (length > 0 && isspace((unsigned char)from[length - 1])) length--;
    (void)snprintf(why, sizeof why, "its value %d is empty", axis->n_values + 1);
    if (length == 0) return complain(errors, whole, why);
    (void)snprintf(why, sizeof why, "its value %d is longer than %d characters", axis->n_values + 1, SCENE_VALUE - 1);
    if (length >= sizeof value) return complain(errors, whole, why);
    (void)snprintf(value, sizeof value, "%.*s", (int)length, from);
    (void)snprintf(why, sizeof why, "the value '%s' is given twice", value);
    if (is_listed(axis, value)) return complain(errors, whole, why);
    (void)snprintf(why, sizeof why, "it has more than %d values", SCENE_MAX_AXIS);
    if (axis->n_values == SCENE_MAX_AXIS) return complain(errors, whole, why);
    memcpy(axis->value[axis->n_values++], value, sizeof value);
    return true;
}

bool axis_parse(const char *text, scene_axis *axis, strbuf *errors)
{
    const char *at = strchr(text, '=');
    *axis = (scene_axis){0};
    if (!at || at == text) return complain(errors, text, "it has no key with values");
    if ((size_t)(at - text) >= sizeof axis->key) return complain(errors, text, "its key is too long");
    (void)snprintf(axis->key, sizeof axis->key, "%.*s", (int)(at - text), text);
    if (at[1] == '\0') return complain(errors, text, "its list of values is empty");
    do {
        at++;
        const size_t length = value_length(at);
        if (!add_value(text, axis, at, length, errors)) return false;
        at += length;
    } while (*at == ',');
    return true;
}

floe_status axis_from_text(context *ctx, const char *option, const char *text, scene_axis *axis)
{
    strbuf errors;
    strbuf_init(&errors, ctx);
    floe_status status = FLOE_OK;
    if (!axis_parse(text, axis, &errors))
        status = fail(ctx, FLOE_BAD_INPUT, "%s: %.*s", option, (int)errors.length - 1, strbuf_string(&errors));
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

bool axis_put(axis_list *list, const scene_axis *axis, strbuf *errors)
{
    const int at = axis_find(list, axis->key);
    if (at >= 0) {
        list->axis[at] = *axis;
        return true;
    }
    if (list->n == SCENE_MAX_AXES) {
        strbuf_append(errors, "axis '%s': more than %d axes: fix some of them with --set\n", axis->key, SCENE_MAX_AXES);
        return false;
    }
    list->axis[list->n++] = *axis;
    return true;
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

bool axis_same_value(const char *a, const char *b)
{
    double x, y;
    const char *of_x, *of_y;
    if (strcmp(a, b) == 0) return true;
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
