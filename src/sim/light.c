#include "sim/light.h"

#include <math.h>

/* Least density of the solid over that of the fluid. The sharp interface beside lighter solids swings up from round-off, however small the step (1e-4); the smeared
 * one gives them the wrong share of the momentum of their cells: of that which sound brings, 0.115 off at 0.01, 1.3 times as much at 0.001
 * (docs/results/extreme.md, impedance). */
static const double least_sharp = 0.9e-3, least_smeared = 0.9e-2;

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
    const double rho = density_of(s->scene, body), least = sharp ? least_sharp : least_smeared;
    if (range[1] == 0.0 || rho >= least * range[0]) return FLOE_OK;
    return fail(s->ctx, FLOE_BAD_INPUT,
                "body '%s' (%g kg/m3) is %.3g times as heavy as the lightest fluid beside it (%g kg/m3), and "
                "method.interface: %s bears "
                "no less than %.2g: %s",
                s->scene->body[body].name, rho, rho / range[0], range[0], sharp ? "sharp" : "smeared", least,
                sharp ? "make it heavier, or leave it out" : "make it heavier, or use sharp down to 0.0009");
}

bool light_solid(const sim *s)
{
    double range[2];
    const int body = lightest_body(s->scene);
    if (body < 0) return false;
    ice_densities(s->ice, range);
    return range[1] > density_of(s->scene, body);
}

/* The pressure of a step is what the surface's velocity before it makes of the fluid, and the surface has the inertia of the nodes next to it: a layer of
 * fluid that is heavier than these throws it back and forth. Largest steps found, over h/c (density of the solid / of the fluid)^(1/2), to a hundredth of the fluid's:
 * 0.44, where the surface is in the middle of a cell, to 0.7; one oblique to the cells has up to sqrt 2 as much of them. At a CFL number of one
 * sound crosses a cell of equal sides in two steps (ice_limit.c). */
double light_step(const sim *s, double crossing)
{
    static const double share = 0.56;
    double range[2];
    const int body = s->scene->method.interface == INTERFACE_SHARP ? lightest_body(s->scene) : -1;
    if (body < 0) return INFINITY;
    ice_densities(s->ice, range);
    return share * crossing * sqrt(density_of(s->scene, body) / range[1]);
}
