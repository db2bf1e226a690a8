#include "base/json_value.h"

#include "base/memory.h"
#include "base/strbuf.h"

#include <math.h>
#include <stdlib.h>

json_t *json_number(double x)
{
    return isfinite(x) ? json_real(x) : json_null();
}

json_t *json_numbers(const double *x, size_t n)
{
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++) json_array_append_new(list, json_number(x[i]));
    return list;
}

json_t *json_plain_text(const char *text)
{
    char plain[4096];
    json_t *value = json_string(text);
    if (value) return value;
    size_t i = 0;
    for (; text[i] && i < sizeof plain - 1; i++) plain[i] = (unsigned char)text[i] < 0x80 ? text[i] : '?';
    plain[i] = '\0';
    return json_string(plain);
}

bool json_put(json_t *object, const char *key, json_t *value)
{
    return json_object_set_new(object, key, value) == 0;
}

floe_status json_to_text(context *ctx, char **text, json_t *object)
{
    strbuf out = {.ctx = ctx};
    char *plain = object ? json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) : NULL;
    *text = NULL;
    json_decref(object);
    if (!plain) return fail(ctx, FLOE_NO_MEMORY, "no memory for a text of JSON");
    strbuf_append(&out, "%s\n", plain);
    free(plain);
    return strbuf_take(&out, text);
}
