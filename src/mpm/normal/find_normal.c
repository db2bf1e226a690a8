#include "mpm/normal/normal.h"

#include <string.h>

const normal_model *normal_find(const char *name)
{
    for (size_t k = 0; k < normal_registry_size; ++k)
        if (strcmp(normal_registry[k]->name, name) == 0) return normal_registry[k];
    return NULL;
}
