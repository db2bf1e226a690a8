/* Small helps with JSON, which jansson writes wherever floe does. */
#ifndef BASE_JSON_VALUE_H
#define BASE_JSON_VALUE_H

#include "base/context.h"

#include <jansson.h>

/* A number; NaN and infinities, which JSON does not have, are null. */
json_t *json_number(double x);
json_t *json_numbers(const double *x, size_t n);
/* A text that may not be UTF-8, as a path or a message that names one: its odd bytes are replaced. */
json_t *json_plain_text(const char *text);
/* Sets a member; false when memory is out. `value` may be NULL for such a failure, which is passed on. */
bool json_put(json_t *object, const char *key, json_t *value);

/* The object as text with a newline at its end, counted memory that the caller owns; drops the reference to it. NULL:
 * FLOE_NO_MEMORY. */
floe_status json_to_text(context *ctx, char **text, json_t *object);

#endif
