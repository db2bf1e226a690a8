/* Going on with a case that was cut short: FOLDER/begun.json says of which resolved deck and by which build the run is
 * whose checkpoint lies there. */
#include "batch/batch_internal.h"

#include "floe_build.h"
#include "io/file.h"
#include "io/json.h"

#include <string.h>

static const char begun[] = "begun.json";
static const char *const checkpoint[] = {"checkpoint.h5", "checkpoint-previous.h5"};
enum { CHECKPOINTS = sizeof checkpoint / sizeof checkpoint[0] };

static bool has_text(const json_t *object, const char *key, const char *wanted)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text && strcmp(text, wanted) == 0;
}

static bool was_begun(const batch *b, const batch_case *one)
{
    char path[BATCH_PATH];
    batch_path(b->o, one, begun, path);
    json_t *object = json_load_file(path, 0, NULL);
    const bool alike = has_text(object, "deck_sha256", one->hash) && has_text(object, "floe_git", FLOE_GIT);
    json_decref(object);
    return alike;
}

static bool has_checkpoint(const batch *b, const batch_case *one)
{
    char path[BATCH_PATH];
    for (int i = 0; i < CHECKPOINTS; i++) {
        batch_path(b->o, one, checkpoint[i], path);
        if (file_exists(path)) return true;
    }
    return false;
}

/* What has diverged has left the state that was refused: from there it would diverge otherwise. */
static bool has_diverged(const batch *b, const batch_case *one)
{
    char path[BATCH_PATH];
    batch_path(b->o, one, "summary.json", path);
    json_t *object = json_load_file(path, 0, NULL);
    const bool diverged = has_text(object, "status", "diverged");
    json_decref(object);
    return diverged;
}

bool batch_case_goes_on(const batch *b, const batch_case *one)
{
    return b->o->go_on && !one->start_over && was_begun(b, one) && has_checkpoint(b, one) && !has_diverged(b, one);
}

floe_status batch_case_begin(batch *b, const batch_case *one)
{
    char path[BATCH_PATH];
    TRY(batch_case_clear_begin(b, one));
    for (int i = 0; i < CHECKPOINTS; i++) {
        batch_path(b->o, one, checkpoint[i], path);
        TRY(file_remove(b->ctx, path));
    }
    batch_path(b->o, one, begun, path);
    return json_write(b->ctx, path,
                      json_pack("{s:i, s:s, s:s}", "schema", 1, "deck_sha256", one->hash, "floe_git", FLOE_GIT));
}

floe_status batch_case_clear_begin(batch *b, const batch_case *one)
{
    char path[BATCH_PATH];
    batch_path(b->o, one, begun, path);
    return file_remove(b->ctx, path);
}
