/* External nodal forces of an implicit step: surface loads, enclosed gases, gas on cells; and their masses. */
#include "mpm/implicit/implicit.h"
#include "mpm/loads/point_loads.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/traction.h"
#include "mpm/transfer/scatter.h"

#include <string.h>

floe_status mpm_implicit_masses(mpm *s)
{
    for (int g = 0; g < s->n_groups; ++g) TRY(scatter_group(s, g, SCATTER_MOMENTUM, false, false));
    return FLOE_OK;
}

static void clear_forces(mpm *s, int group)
{
    for (int b = 0; b < s->mesh->n_blocks; ++b)
        for (int c = 0; c < s->mesh->dim; ++c)
            memset(field_get(s->domain->fields[b], N_FORCE, group, c), 0, s->mesh->block[b].size * sizeof(double));
}

static void collect_loads(mpm *s, double *out)
{
    memset(out, 0, s->implicit->components * sizeof *out);
    s->kick = 0.0; /* no impulse is entered */
    set_body_forces(s);
    for (int g = 0; g < s->n_groups; ++g) {
        clear_forces(s, g);
        scatter_loads(s, g);
        implicit_collect(s, N_FORCE, g, out);
    }
}

/* The loads as they were when the increment before ended. */
static void collect_first_loads(mpm *s)
{
    const double dt = s->dt;
    s->dt = 0.0;
    s->step--;
    collect_loads(s, s->implicit->external_first);
    memcpy(s->implicit->acceleration_first, s->acceleration, sizeof s->acceleration);
    s->dt = dt;
    s->step++;
}

floe_status mpm_implicit_loads(mpm *s)
{
    TRY(enclosed_gases_from_cells(s));
    for (int r = 0; r < s->implicit->n_gases; ++r) {
        memset(s->implicit->gas_set[r].unit_force, 0, s->implicit->components * sizeof(double));
        for (int g = 0; g < s->n_groups; ++g) {
            clear_forces(s, g);
            if (s->gas && s->gas[r].unit_force)
                scatter_markers(s, g, s->gas[r].unit_force);
            else if (g == 0)
                scatter_gas_pressure(s, r);
            fold_forces(s, g);
            implicit_collect(s, N_FORCE, g, s->implicit->gas_set[r].unit_force);
        }
    }
    if (s->implicit->external_first) collect_first_loads(s);
    collect_loads(s, s->implicit->external);
    return FLOE_OK;
}
