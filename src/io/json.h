/* Pages of JSON, as files. */
#ifndef IO_JSON_H
#define IO_JSON_H

#include "base/json_value.h"

/* Replaces `path` by the object, and drops the reference to it. NULL: FLOE_NO_MEMORY. */
floe_status json_write(context *ctx, const char *path, json_t *object);

#endif
