#include "geom/bounds.h"

bool shape_bounds(const shape *s, int dim, double lo[3], double hi[3])
{
    return s->model && s->model->bounds && s->model->bounds(s->par, dim, lo, hi);
}
