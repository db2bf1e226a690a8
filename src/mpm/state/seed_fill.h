/* Seeding of points. */
#ifndef MPM_SEED_FILL_H
#define MPM_SEED_FILL_H

#include "geom/seed.h"
#include "mpm/mpm.h"

/* Seeding (seed_fill.c): fluids fill small gaps beside other bodies; `list`: one a body. */
floe_status fill_cells(const mpm *s, seed_list *list);

/* The points of a body that supports hold in part (seed_supported.c). Errors: FLOE_NO_MEMORY. */
floe_status seed_supported(const mpm *s, int body, const seed_spec *spec, seed_list *out);

/* Number of the cell of a list's point among those of the mesh, axis 0 fastest. */
size_t seed_cell_of(const mesh *m, const seed_list *list, size_t n);

#endif
