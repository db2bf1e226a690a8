#include "study/crossed.h"

#include "base/memory.h"

#include <string.h>

size_t crossed_count(const scene_axis *axis, int n)
{
    size_t count = 1;
    for (int k = 0; k < n; k++) count *= (size_t)axis[k].n_values;
    return count;
}

void crossed_pick(const scene_axis *axis, int n, size_t i, int *pick)
{
    for (int k = n - 1; k >= 0; k--) {
        pick[k] = (int)(i % (size_t)axis[k].n_values);
        i /= (size_t)axis[k].n_values;
    }
}

floe_status case_settings_make(case_settings *c, context *ctx, const deck_overrides *user, size_t more)
{
    *c = (case_settings){0};
    TRY(memory_new(ctx, &c->set, user->n + more, sizeof *c->set));
    const floe_status status = memory_new(ctx, &c->text, more, sizeof *c->text);
    if (status != FLOE_OK) memory_free(ctx, &c->set);
    TRY(status);
    for (size_t i = 0; i < user->n; i++) case_settings_add(c, user->text[i]);
    return FLOE_OK;
}

void case_settings_free(case_settings *c, context *ctx)
{
    memory_free(ctx, &c->set);
    memory_free(ctx, &c->text);
}

void case_settings_add(case_settings *c, const char *text)
{
    c->set[c->n++] = text;
}

void case_settings_put(case_settings *c, const char *key, const char *value)
{
    char *text = c->text[c->n_text++];
    (void)snprintf(text, SCENE_SETTING, "%s=%s", key, value);
    case_settings_add(c, text);
}

void case_settings_pick(case_settings *c, const scene_axis *axis, int pick)
{
    for (int i = 0; i < scene_axis_settings(axis); i++) {
        char *text = c->text[c->n_text++];
        scene_axis_setting(axis, i, pick, text);
        case_settings_add(c, text);
    }
}

json_t *crossed_json(const scene_axis *axis, int n, const int *pick)
{
    json_t *object = json_object();
    for (int k = 0; k < n; k++) json_put(object, axis[k].key, json_string(axis[k].value[pick[k]]));
    return object;
}

json_t *axis_values_json(const char (*value)[SCENE_VALUE], int n)
{
    json_t *values = json_array();
    for (int i = 0; i < n; i++) json_array_append_new(values, json_string(value[i]));
    return values;
}
