#include "geom/shape.h"

#include <string.h>

const shape_model *shape_find(const char *name)
{
    for (size_t i = 0; i < shape_registry_size; i++) {
        if (strcmp(shape_registry[i]->name, name) == 0) return shape_registry[i];
    }
    return NULL;
}

bool shape_inside(const shape *s, int dim, const double x[3])
{
    return s->model->level(s->par, dim, x) < 0.0;
}
