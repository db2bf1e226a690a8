/* Solids on points that burn to gas on cells: the area of their surface in a cell, and the mass, momentum and energy that the gas gains. */
#include "ice/exchange/ice_reactions.h"

#include "ice/ice_constants.h"

#include <math.h>

/* What a cell counts of a surface, by the fraction psi that solids fill of it: from 0 outside to 1 inside, with most of
 * its rise in cells with little solid. A surface that recedes at r then obeys psi_t + r |grad g(psi)| = 0, whose level
 * sets move the faster the farther out they lie, and catch up: the edge stays a few cells wide, where g = psi would let
 * it spread with the square root of the distance. */
static double burning_weight(double psi)
{
    const double lack = 1.0 - fmin(fmax(psi, 0.0), 1.0);
    return 1.0 - lack * lack * lack;
}

static double solid_fraction(const ice_view *v, ptrdiff_t at)
{
    double sum = 0.0;
    for (int r = 0; r < v->n_materials; ++r)
        if (v->material[r].points) sum += v->m[r].theta[at];
    return sum;
}

/* |grad g| by what lies lower on either side along each axis: along a line through a body the cells add up to g inside
 * for each side of it, whatever the profile between. Solids that touch have no surface there; what there is, each has
 * by its fraction. */
double ice_burning_surface(const ice_view *v, int r, ptrdiff_t at)
{
    const double psi = solid_fraction(v, at), here = burning_weight(psi);
    double square = 0.0;
    if (!(psi > 0.0)) return 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const ptrdiff_t st = v->b->stride[a];
        const double below = burning_weight(solid_fraction(v, at - st)),
                     above = burning_weight(solid_fraction(v, at + st));
        const double rise = v->inv_h[a] * (fmax(here - below, 0.0) + fmax(here - above, 0.0));
        square += rise * rise;
    }
    return sqrt(square) * v->m[r].theta[at] / psi;
}

/* Energy (J/m3) that new gas spends on compressing solids. The heat of 2.7 has them take their share of what the cell
 * gives off by its dilatation; what drives that is the new gas, and where it flows off as fast as it forms the solids
 * give nothing. */
static double work_on_solids(const ice *s, const ice_view *v, ptrdiff_t at)
{
    double compressibility = 0.0;
    for (int r = 0; r < v->n_materials; ++r)
        if (v->material[r].points) compressibility += v->m[r].theta[at] * v->m[r].kappa[at];
    return compressibility * v->P[at] * ice_created(s, v, at).dP;
}

/* Mass, momentum and energy of what the points have lost, the heat of the reaction, and what the solid is worth in the
 * law of the cells; kinetic energy that is lost so stays as heat. The pressure's impulse on the solid goes with its
 * mass. */
void ice_join_burnt(const ice *s, const ice_view *v, int k, ptrdiff_t at, int i)
{
    const reaction *q = &s->reactions->list[k];
    const ice_fluid *from = &v->m[q->reactant], *to = &v->m[q->product];
    const double lost = v->reacted[k][at], before = to->rhol[at], mass = before + lost;
    double heat = before * to->el[at] + lost * (from->e[at] + q->heat), kinetic = v->burnt_energy[k][at];
    const bool last = !(from->rho[at] - lost > ICE_LAST_OF_REACTANT * from->rho[at]); /* all but round-off */
    const double share = last ? 1.0 : lost / from->rho[at];
    for (int a = 0; a < v->dim; ++a) {
        const double momentum = share * from->source[a][at], u = to->ul[a][at];
        const double next = (before * u + v->burnt_momentum[k][a][at] + momentum / v->volume[i]) / mass;
        from->source[a][at] -= momentum;
        kinetic += 0.5 * (before * u * u - mass * next * next);
        to->ul[a][at] = next;
    }
    if (s->scene->method.conserve_energy) heat += kinetic;
    heat -= work_on_solids(s, v, at);
    to->el[at] = heat / mass;
    to->rhol[at] = mass;
    from->rhol[at] = last ? 0.0 : from->rho[at] - lost;
}
