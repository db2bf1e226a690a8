#include "material/eos.h"

#include <string.h>

const eos_model *eos_find(const char *name)
{
    for (size_t i = 0; i < eos_registry_size; i++) {
        if (strcmp(eos_registry[i]->name, name) == 0) return eos_registry[i];
    }
    return NULL;
}
