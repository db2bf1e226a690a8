#include "scene/batches.h"

#include <stdio.h>

int scene_axis_settings(const scene_axis *axis)
{
    return 1 + axis->n_with;
}

void scene_axis_setting(const scene_axis *axis, int k, int pick, char text[SCENE_SETTING])
{
    const char *key = k == 0 ? axis->key : axis->with[k - 1].key;
    const char *value = k == 0 ? axis->value[pick] : axis->with[k - 1].value[pick];
    (void)snprintf(text, SCENE_SETTING, "%s=%s", key, value);
}
