/* What pushes the nodes from outside in a step that is solved for: surfaces, rooms, gas of the cells; and their
 * masses. */
#include "mpm/balance/balance.h"
#include "mpm/load.h"
#include "mpm/surface/skin.h"
#include "mpm/surface/traction.h"

#include <string.h>

floe_status mpm_balance_masses(mpm *s)
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
    memset(out, 0, s->balance->components * sizeof *out);
    s->work->kick = 0.0; /* no impulse is entered */
    set_body_forces(s);
    for (int g = 0; g < s->n_groups; ++g) {
        clear_forces(s, g);
        scatter_loads(s, g);
        balance_collect(s, N_FORCE, g, out);
    }
}

/* The loads as they were when the increment before ended. */
static void collect_first_loads(mpm *s)
{
    const double dt = s->dt;
    s->dt = 0.0;
    s->step--;
    collect_loads(s, s->balance->outer_first);
    memcpy(s->balance->acceleration_first, s->work->acceleration, sizeof s->work->acceleration);
    s->dt = dt;
    s->step++;
}

floe_status mpm_balance_loads(mpm *s)
{
    TRY(rooms_take_gases(s));
    for (int r = 0; r < s->balance->n_rooms; ++r) {
        memset(s->balance->room[r].push, 0, s->balance->components * sizeof(double));
        for (int g = 0; g < s->n_groups; ++g) {
            clear_forces(s, g);
            if (s->gas && s->gas[r].push)
                scatter_skins(s, g, s->gas[r].push);
            else if (g == 0)
                scatter_room(s, r);
            fold_forces(s, g);
            balance_collect(s, N_FORCE, g, s->balance->room[r].push);
        }
    }
    if (s->balance->outer_first) collect_first_loads(s);
    collect_loads(s, s->balance->outer);
    return FLOE_OK;
}
