#include "material/solid.h"

#include <string.h>

const solid_model *solid_find(const char *name)
{
    for (size_t i = 0; i < solid_registry_size; i++) {
        if (strcmp(solid_registry[i]->name, name) == 0) return solid_registry[i];
    }
    return NULL;
}

unsigned solid_depends_on(const solid_model *law, const void *par)
{
    const unsigned by_temperature = law->needs & SOLID_NEEDS_TEMPERATURE ? (unsigned)SOLID_BY_TEMPERATURE : 0U;
    return law->depends ? law->depends(par) : by_temperature;
}
