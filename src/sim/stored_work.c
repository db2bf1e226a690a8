/* What a scene can set in motion by itself (theory 10.3): known where open sides lead to one pressure at rest and give nothing but that, so that motion
 * beyond it is from nothing, though every flux is in the ledger. */
#include "sim/sim.h"

#include "scene/formula.h"
#include "scene/side_parts.h"

#include <math.h>

static bool is_still(const scene *s, const bc_side *side)
{
    for (int a = 0; a < s->mesh.dim; ++a)
        if (side->velocity[a] != 0.0) return false;
    return !scene_varies(s, side, sizeof *side);
}

/* The pressure behind all open sides; NAN where they differ or drive the fluids, or where there are none. */
static double pressure_outside(const scene *s)
{
    double p = (double)NAN;
    scene_condition at;
    for (int i = 0; scene_next_condition(s, &i, &at);) {
        const bc_side *side = at.side;
        if (side->kind == BC_PERIODIC) continue;
        if (side->kind == BC_INLET || side->kind == BC_VELOCITY || side->kind == BC_FREE || !is_still(s, side))
            return (double)NAN;
        if (!bc_gives_pressure(side->kind)) continue;
        if (fabs(side->pressure - p) > 1e-9 * fabs(p)) return (double)NAN;
        p = side->pressure;
    }
    return p;
}

/* Whether bodies are moved by what the deck says of them: their work is in the ledger with what crosses the sides. */
static bool is_driven(const scene *s)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].motion.kind == MOTION_DRIVEN) return true;
    for (int i = 0; i < s->n_supports; ++i)
        for (int a = 0; a < s->mesh.dim; ++a)
            if (s->support[i].velocity[a] != 0.0) return true;
    return scene_varies(s, s->support, sizeof s->support);
}

/* Whether heat becomes motion, or fluids are where only points know of them. */
static bool has_other_stores(const sim *s)
{
    const scene *sc = s->scene;
    for (int m = 0; m < sc->n_materials; ++m)
        if (sc->material[m].conductivity > 0.0) return true;
    for (int b = 0; s->mpm && b < s->mpm->n_bodies; ++b)
        if (s->mpm->body[b].fluid) return true;
    return sc->n_reactions > 0 || sc->n_vents > 0 || is_driven(sc);
}

floe_status sim_find_stored_work(sim *s, double *work)
{
    const double outside = pressure_outside(s->scene);
    *work = -1.0;
    if (!s->ice || s->quasi_static_gas || isnan(outside) || has_other_stores(s)) return FLOE_OK;
    return ice_stored_work(s->ice, outside, work);
}
