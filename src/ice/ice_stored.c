/* What the fluids of the cells could make of motion by themselves (theory 10.3): each kilogram that comes along its isentrope to the
 * pressure p_0 outside gives e - e_0 + p_0 (v - v_0) >= 0, whether it is pressed together or drawn apart. */
#include "ice/ice.h"
#include "ice/state/ice_cells.h"
#include "ice/state/ice_materials.h"
#include "ice/state/ice_tiles.h"
#include "ice/state/ice_walk.h"

#include "base/memory.h"
#include "coupling/isentrope.h"

/* J/kg; 0 of a state without an isentrope. */
static double work_of(const eos *law, double rho, double e, double outside)
{
    isentrope line;
    double slope;
    if (!isentrope_through(law, 1.0 / rho, e, &line) || !(outside > line.floor)) return 0.0;
    const double v = isentrope_volume(&line, outside, &slope);
    return e - isentrope_energy(&line, v) + outside * (line.v - v);
}

floe_status ice_stored_work(const ice *s, double outside, double *work)
{
    double *tile;
    TRY(memory_new(s->ctx, &tile, mesh_tiles(s->mesh), sizeof(double)));
    ice_view v;
    for (int id = 0; ice_next_view(s, NULL, &id, &v);)
        for (int r = 0; r < s->n_materials; ++r) {
            const ice_fluid *m = &v.m[r];
            for (ice_walk c = ICE_FIRST; !s->material[r].points && ice_next_cell(v.b, &c);) {
                const double open = m->open ? m->open[c.at] : 1.0, own = m->rho[c.at];
                if (!(own > 0.0) || !(open > 0.0)) continue;
                const double rho = ice_region_of(s, r)->n > 1 ? 1.0 / m->vol[c.at] : own;
                tile[mesh_tile_of(s->mesh, c.cell)] +=
                    own * v.volume[c.in[0]] * open * work_of(&s->material[r].eos, rho, m->e[c.at], outside);
            }
        }
    domain_sum_tiles(s->mesh, tile, 1, work);
    memory_free(s->ctx, &tile);
    return FLOE_OK;
}
