/* Seeding of points. */
#ifndef MPM_SEED_FILL_H
#define MPM_SEED_FILL_H

#include "geom/seed.h"
#include "mpm/mpm.h"

/* Seeding (seed_fill.c): fluids fill small gaps beside other bodies; `list`: one a body. */
floe_status fill_cells(const mpm *s, seed_list *list);

/* Number of the cell of a list's point among those of the mesh, axis 0 fastest. */
size_t seed_cell_of(const mesh *m, const seed_list *list, size_t n);

#endif
