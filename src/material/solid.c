#include "material/solid.h"

#include <string.h>

const solid_model *solid_find(const char *name)
{
    for (size_t i = 0; i < solid_registry_size; i++) {
        if (strcmp(solid_registry[i]->name, name) == 0) return solid_registry[i];
    }
    return NULL;
}
