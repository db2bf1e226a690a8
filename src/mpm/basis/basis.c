#include "mpm/basis/basis.h"

#include <string.h>

const basis_model *basis_find(const char *name)
{
    for (size_t k = 0; k < basis_registry_size; ++k)
        if (strcmp(basis_registry[k]->name, name) == 0) return basis_registry[k];
    return NULL;
}

bool basis_is(const basis_model *b, const char *name)
{
    return strcmp(b->name, name) == 0;
}

int basis_number(const basis_model *b)
{
    for (size_t k = 0; k < basis_registry_size; ++k)
        if (basis_registry[k] == b) return (int)k;
    return -1;
}
