#include "sim/light.h"

#include <math.h>

/* Least density of the solid over that of the fluid. Beside lighter solids the sharp interface swings up from round-off, in steps a hundred times smaller than sound
 * asks for at 1e-3, however small they are at 1e-4; the smeared one gives them the wrong share of the momentum of their cells: of that which sound brings, 0.115 off at
 * 0.01, 1.3 times as much at 0.001 (docs/results/extreme.md, impedance). */
static const double least_share = 0.9e-2;

/* The lightest solid of the scene that is no membrane; -1: there is none. */
static int lightest_body(const scene *s)
{
    int found = -1;
    for (int b = 0; b < s->n_bodies; ++b) {
        const scene_material *m = &s->material[s->body[b].material];
        if (m->kind != MATERIAL_SOLID || !m->law) continue;
        if (found < 0 || m->density < s->material[s->body[found].material].density) found = b;
    }
    return found;
}

static double density_of(const scene *s, int body)
{
    return s->material[s->body[body].material].density;
}

floe_status light_check(const sim *s)
{
    double range[2];
    const bool sharp = s->scene->method.interface == INTERFACE_SHARP;
    const int body = s->mpm && s->ice ? lightest_body(s->scene) : -1;
    if (body < 0 || (s->sealed && !sharp) || sim_is_static(s)) return FLOE_OK;
    ice_densities(s->ice, range);
    const double rho = density_of(s->scene, body);
    if (range[1] == 0.0 || rho >= least_share * range[0]) return FLOE_OK;
    return fail_key(
        s->ctx, KEY("materials", s->scene->material[s->scene->body[body].material].name, "density"),
        "body '%s' (%g kg/m3) is %.3g times as heavy as the lightest fluid beside it (%g kg/m3), and no interface "
        "bears less than %.2g: make it heavier, or leave it out",
        s->scene->body[body].name, rho, rho / range[0], range[0], least_share);
}

/* Density of the lightest solid over that of the densest fluid; infinity where there is no such solid. */
static double least_ratio(const sim *s)
{
    double range[2];
    const int body = lightest_body(s->scene);
    if (body < 0) return INFINITY;
    ice_densities(s->ice, range);
    return density_of(s->scene, body) / range[1];
}

bool light_solid(const sim *s)
{
    return least_ratio(s) < 1.0;
}

/* The pressure of a step is what the surface's velocity before it makes of the fluid, and the surface has the inertia of the nodes next to it: a layer of
 * fluid that is heavier than these throws it back and forth. Over h/c (density of the solid / of the fluid)^(1/2), at a hundredth of the fluid's density, a surface in
 * the middle of a cell is calm in steps of 0.2 and swings up at 0.28; elsewhere in the cell it bears more. At a CFL number of one sound crosses a cell of equal sides
 * in two steps (ice_limit.c). At equal densities a CFL number of 0.9 is too much there, at twice the density it is not. */
double light_step(const sim *s, double crossing)
{
    static const double share = 0.35;
    return s->scene->method.interface == INTERFACE_SHARP ? share * crossing * sqrt(least_ratio(s)) : (double)INFINITY;
}
