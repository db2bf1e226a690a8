#include "mpm/transfer/transfer.h"

#include <string.h>

const transfer_model *transfer_find(const char *name)
{
    for (size_t k = 0; k < transfer_registry_size; ++k)
        if (strcmp(transfer_registry[k]->name, name) == 0) return transfer_registry[k];
    return NULL;
}
