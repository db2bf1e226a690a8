#include "study/axis_text.h"

#include <string.h>

/* Characters up to the next comma outside brackets and braces. */
static size_t value_length(const char *text)
{
    size_t n = 0;
    for (int depth = 0; text[n] && (depth > 0 || text[n] != ','); n++) {
        if (strchr("[{", text[n])) depth++;
        if (strchr("]}", text[n])) depth--;
    }
    return n;
}

static floe_status bad_axis(context *ctx, const char *option, const char *text)
{
    return fail(ctx, FLOE_BAD_INPUT, "%s takes KEY=V1,V2,... with at most %d values, not '%s'", option, SCENE_MAX_AXIS,
                text);
}

floe_status axis_from_text(context *ctx, const char *option, const char *text, scene_axis *axis)
{
    const char *at = strchr(text, '=');
    *axis = (scene_axis){0};
    if (!at || at == text || (size_t)(at - text) >= sizeof axis->key) return bad_axis(ctx, option, text);
    (void)snprintf(axis->key, sizeof axis->key, "%.*s", (int)(at - text), text);
    do {
        at++;
        const size_t length = value_length(at);
        if (length == 0 || length >= sizeof axis->value[0] || axis->n_values == SCENE_MAX_AXIS)
            return bad_axis(ctx, option, text);
        (void)snprintf(axis->value[axis->n_values++], sizeof axis->value[0], "%.*s", (int)length, at);
        at += length;
    } while (*at == ',');
    return FLOE_OK;
}
