/* Numbers that are plausible alone, and not beside others of the scene: a gas a thousandth as dense as the one about it, a reservoir behind a
 * side a hundred times as hot as what leaves, a ramp that is over before anything can have moved. */
#include "scene/remark_internal.h"

#include <math.h>

static bool is_gas(const scene_material *m)
{
    return m->kind == MATERIAL_FLUID && m->eos.model && !eos_is_liquid(&m->eos);
}

/* A partial vacuum is at hand; one of a thousandth of the pressure about it is rarely meant, and a bar given as 100 is. */
static void remark_thin_gas(remark_speaker *w, const scene_body *b)
{
    static const double thin = 1.01e-3;
    const scene *s = w->s;
    const scene_material *m = &s->material[b->material], *about = &s->material[s->ambient_material];
    const double pressure = b->pressure / s->ambient_pressure;
    if (!is_gas(m) || !is_gas(about)) return;
    remark_set_key(w, "bodies", b->name, "pressure");
    if (pressure <= thin) {
        remark_key(w,
                   "the gas has %g Pa, %.2g of the ambient's %g Pa: hardly any of it. Give both in Pa, or with their "
                   "units",
                   b->pressure, pressure, s->ambient_pressure);
        return;
    }
    const double there = isnan(b->density) ? eos_density(&m->eos, b->pressure, b->temperature) : b->density;
    const double here = eos_density(&about->eos, s->ambient_pressure, s->ambient_temperature);
    remark_set_key(w, "bodies", b->name, isnan(b->density) ? "temperature" : "density");
    if (there <= thin * here)
        remark_key(w,
                   "the gas has %.3g kg/m3, %.2g of the ambient's %.3g: no gas is so much lighter than another at its "
                   "pressure. Give temperatures in K, and densities in kg/m3",
                   there, there / here, here);
}

static void remark_gases(remark_speaker *w)
{
    const scene *s = w->s;
    for (int k = 0; k < s->n_bodies && s->has_ambient && s->ambient_pressure > 0.0; ++k)
        remark_thin_gas(w, &s->body[k]);
}

/* Temperatures of the fluids that the scene starts with: the lowest and the highest. */
static bool temperatures_inside(const scene *s, double *low, double *high)
{
    *low = INFINITY;
    *high = 0.0;
    if (s->has_ambient && s->ambient_temperature > 0.0) *low = *high = s->ambient_temperature;
    for (int k = 0; k < s->n_bodies; ++k) {
        const double T = s->body[k].temperature;
        if (s->material[s->body[k].material].kind != MATERIAL_FLUID || !(T > 0.0)) continue;
        *low = fmin(*low, T);
        *high = fmax(*high, T);
    }
    return *high > 0.0;
}

static void remark_reservoirs(remark_speaker *w)
{
    static const double apart = 50.0;
    const scene *s = w->s;
    double low, high;
    if (!temperatures_inside(s, &low, &high)) return;
    for (int axis = 0; axis < s->mesh.dim; ++axis)
        for (int side = 0; side < 2; ++side) {
            const double T = s->bc.side[axis][side].temperature;
            if (!(T > apart * high) && !(T * apart < low)) continue;
            remark_set_key(w, "boundaries", mesh_axis_name(s->mesh.geometry, axis), side ? "upper" : "lower");
            remark_key(w,
                       "its temperature, %g K, is %.2g times that of the fluid inside (%g K): give both in K, or leave "
                       "it out where an outlet has that of what leaves",
                       T, T / (T > high ? high : low), T > high ? high : low);
        }
}

/* Below a millionth of the run a ramp is none. */
static void remark_ramps(remark_speaker *w)
{
    const scene *s = w->s;
    for (int l = 0; l < s->n_loads; ++l) {
        const double share = s->load[l].ramp / s->time.end;
        remark_set_key(w, "loads", s->load[l].name, "");
        if (share > 0.0 && share < 1e-6)
            remark_key(w,
                       "its ramp of %g%s is %.2g of the run: all of the load comes at once. Give the ramp with its "
                       "unit, or leave it out where that is meant",
                       s->load[l].ramp, scene_time_unit(s), share);
    }
}

void remark_contrasts(const scene *s, remark_sink *say, void *user)
{
    remark_speaker w = {.s = s, .say = say, .user = user};
    if (!s->dimensionless) {
        remark_gases(&w);
        remark_reservoirs(&w);
    }
    remark_ramps(&w);
}
