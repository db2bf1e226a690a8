#include "io/json.h"

#include "base/memory.h"
#include "io/file.h"

floe_status json_write(context *ctx, const char *path, json_t *object)
{
    char *text;
    TRY(json_to_text(ctx, &text, object));
    const floe_status status = file_replace_text(ctx, path, text);
    memory_free(ctx, &text);
    return status;
}
