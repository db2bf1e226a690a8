/* Rest (scene.rest): the solids are strained, all loads have come to their ends, and next to no motion is left for as
 * long as sound needs to cross the solids several times. */
#include "sim/sim.h"

#include "geom/bounds.h"

#include <math.h>

/* A standing wave has next to no kinetic energy for a few thousandths of its period: far less than its crossings. */
static const double crossings = 5.0;
/* Of time.end: where a sound speed of the solids is not known (membranes). */
static const double share_of_run = 0.02;

/* The longest edge (m) of what a body fills of the domain. */
static double extent_of(const sim *s, const shape *of)
{
    double lo[3], hi[3], most = 0.0;
    const bool bounded = shape_bounds(of, s->mesh.dim, lo, hi);
    for (int a = 0; a < s->mesh.dim; ++a) {
        const double lower = bounded ? fmax(lo[a], s->mesh.lower[a]) : s->mesh.lower[a];
        const double upper = bounded ? fmin(hi[a], s->mesh.upper[a]) : s->mesh.upper[a];
        most = fmax(most, upper - lower);
    }
    return most;
}

double sim_rest_window(const sim *s)
{
    const scene *sc = s->scene;
    double longest = 0.0;
    if (!isnan(sc->rest.window)) return sc->rest.window;
    for (int b = 0; b < sc->n_bodies; ++b) {
        const scene_material *m = &sc->material[sc->body[b].material];
        if (m->kind != MATERIAL_SOLID || !m->law || m->membrane) continue;
        const double modulus = m->law->bulk_modulus(m->law_par) + 4.0 / 3.0 * m->law->shear_modulus(m->law_par);
        longest = fmax(longest, extent_of(s, &sc->body[b].shape) * sqrt(m->density / modulus));
    }
    return longest > 0.0 ? crossings * longest : share_of_run * sc->time.end;
}

static bool loads_are_constant(const sim *s)
{
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        if (s->time < load->start + (load->ramp_steps > 0 ? 0.0 : load->ramp)) return false;
        if (s->steps < load->ramp_steps) return false;
    }
    return true;
}

/* More strain energy than round-off leaves in a body that nothing has reached yet. */
static bool is_strained(const sim *s, const sim_totals *t)
{
    static const double round_off = 1e-10; /* strain */
    return t->strain > round_off * round_off * s->ledger.elasticity;
}

floe_status sim_check_rest(sim *s, const sim_totals *t)
{
    const scene_rest *r = &s->scene->rest;
    if (!r->enabled || s->time < r->after || sim_is_static(s) || !loads_are_constant(s)) return FLOE_OK;
    if (!is_strained(s, t) || !(t->kinetic_solid <= r->ratio * t->strain))
        s->rest_since = INFINITY;
    else if (isinf(s->rest_since))
        s->rest_since = s->time;
    s->at_rest = s->time - s->rest_since >= sim_rest_window(s);
    return FLOE_OK;
}
