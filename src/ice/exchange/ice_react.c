/* Mass exchange (step 4 of Guilkey et al. 2003; theory 2.3, 2.10): the mass that reactions convert in the step, the pressure due to its new volume, and the
 * sources of mass, momentum, energy and volume. The product gets the reactant's momentum and energy, and the heat; sums over materials are conserved to
 * round-off. For solids on points the losses come from the points (ice_burn.c, mpm/state/burn.c). */
#include "ice/exchange/ice_reactions.h"
#include "ice/state/ice_tiles.h"

#include "base/memory.h"
#include "base/threads.h"

#include <math.h>

/* ---- making ---- */

static floe_status resolve_one(ice *s, const scene_reaction *given)
{
    ice_reactions *all = s->reactions;
    const int reactant = ice_material_of(s, given->reactant), product = ice_material_of(s, given->product);
    if (reactant < 0) return FLOE_OK; /* there is none to react */
    if (s->material[product].points)
        return fail_key(s->ctx, KEY("reactions", given->name, "product"),
                        "'%s' is a solid, and no points come into being; name a fluid",
                        s->scene->material[given->product].name);
    if (s->material[reactant].points && ice_burning_of(s, reactant) >= 0)
        return fail_key(s->ctx, KEY("reactions", given->name, "reactant"),
                        "another reaction uses up the solid '%s' already; leave one out",
                        s->scene->material[given->reactant].name);
    all->burns[all->n] = s->material[reactant].points;
    all->list[all->n++] = (reaction){given->model, given->par, reactant, product, given->heat};
    return FLOE_OK;
}

int ice_burning_of(const ice *s, int material)
{
    const ice_reactions *all = s->reactions;
    for (int k = 0; k < ice_reaction_count(s); ++k)
        if (all->burns[k] && all->list[k].reactant == material) return k;
    return -1;
}

static floe_status create_solvers(ice *s)
{
    ice_reactions *all = s->reactions;
    all->threads = threads_most();
    TRY(memory_new(s->ctx, &all->solver, (size_t)all->threads, sizeof(reaction_solver *)));
    for (int t = 0; t < all->threads; ++t) TRY(reaction_create(&all->solver[t], s->ctx, all->n, all->list));
    return FLOE_OK;
}

floe_status ice_reactions_create(ice *s)
{
    if (s->scene->n_reactions == 0) return FLOE_OK;
    TRY(memory_new(s->ctx, &s->reactions, 1, sizeof *s->reactions));
    for (int k = 0; k < s->scene->n_reactions; ++k) TRY(resolve_one(s, &s->scene->reaction[k]));
    return s->reactions->n > 0 ? create_solvers(s) : FLOE_OK;
}

void ice_reactions_destroy(context *ctx, ice_reactions **w)
{
    if (!*w) return;
    for (int t = 0; (*w)->solver && t < (*w)->threads; ++t) reaction_destroy(ctx, &(*w)->solver[t]);
    memory_free(ctx, &(*w)->solver);
    memory_free(ctx, w);
}

int ice_reaction_count(const ice *s)
{
    return s->reactions ? s->reactions->n : 0;
}

bool ice_burns(const ice *s, int k)
{
    return s->reactions && s->reactions->burns[k];
}

bool ice_some_solid_burns(const ice *s)
{
    for (int k = 0; k < ice_reaction_count(s); ++k)
        if (s->reactions->burns[k]) return true;
    return false;
}

/* ---- rates ---- */

static double surface_of(const ice_view *v, int r, ptrdiff_t at)
{
    const double *theta = v->m[r].theta;
    double square = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const ptrdiff_t st = v->b->stride[a];
        const double slope = 0.5 * v->inv_h[a] * (theta[at + st] - theta[at - st]);
        square += slope * slope;
    }
    return sqrt(square);
}

/* False: nothing can react. */
static bool gather_reaction_cell(const ice *s, const ice_view *v, ptrdiff_t at, reaction_cell *c)
{
    const ice_reactions *all = s->reactions;
    bool any = false;
    if (v->m[0].open && !(v->m[0].open[at] > 0.0)) return false; /* a solid fills it */
    for (int k = 0; k < all->n; ++k) any = any || v->m[all->list[k].reactant].rho[at] > 0.0;
    if (!any) return false;
    c->n = v->n_materials;
    c->p = v->p[at];
    for (int r = 0; r < c->n; ++r) {
        const ice_fluid *m = &v->m[r];
        const eos *law = &v->material[r].eos;
        double alpha;
        c->density[r] = 1.0 / m->v[at];
        c->e[r] = m->e[at];
        c->T[r] = m->T[at];
        c->solid[r] = v->material[r].points;
        c->rho[r] = c->solid[r] && ice_burning_of(s, v->first + r) < 0 ? 0.0 : m->rho[at];
        law->model->heat(law->par, 1, &c->density[r], &c->e[r], &c->cv[r], &alpha);
    }
    for (int k = 0; k < all->n; ++k) {
        const int r = all->list[k].reactant;
        c->surface[k] = all->burns[k] ? ice_burning_surface(v, r, at) : surface_of(v, r, at);
    }
    return true;
}

static bool react_row(const ice *s, const ice_view *v, ptrdiff_t base)
{
    const ice_reactions *all = s->reactions;
    bool good = true;
    for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at) {
        double reacted[REACTION_MAX] = {0.0};
        reaction_cell c;
        if (gather_reaction_cell(s, v, at, &c))
            good = reaction_integrate(all->solver[thread_number()], &c, v->dt, reacted) && good;
        for (int k = 0; k < all->n; ++k) v->reacted[k][at] = reacted[k];
    }
    return good;
}

floe_status ice_react_of(ice *s, const ice_region *g)
{
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_rows q = ice_rows_of(v.b, -1, 0);
        int bad = 0;
#pragma omp parallel for schedule(static) reduction(+ : bad)
        for (int row = 0; row < q.n; ++row) bad += !react_row(s, &v, ice_row_start(v.b, q, row));
        if (bad)
            return fail(s->ctx, FLOE_RETRY, "reactions: CVODE cannot follow the rates of %d rows of cells over %g s",
                        bad, s->dt);
    }
    return FLOE_OK;
}

/* ---- pressure and volume ---- */

ice_creation ice_created(const ice *s, const ice_view *v, ptrdiff_t at)
{
    const ice_reactions *all = s->reactions;
    ice_creation c = {.any = false};
    double sum = 0.0, compressibility = v->kappa_sum[at];
    for (int k = 0; k < all->n; ++k) {
        const double reacted = v->reacted[k][at];
        const int r = all->list[k].reactant, p = all->list[k].product;
        if (!(reacted > 0.0)) continue;
        c.any = true;
        c.mass[r] -= reacted;
        c.mass[p] += reacted;
        c.volume[r] -= reacted * v->m[r].v[at];
        c.volume[p] += reacted * v->m[p].v[at];
    }
    for (int r = 0; r < v->n_materials; ++r) {
        sum += c.volume[r];
        c.theta[r] = v->m[r].theta[at] + fmax(c.volume[r], 0.0); /* what is new yields, too */
        compressibility += fmax(c.volume[r], 0.0) * v->m[r].kappa[at];
    }
    c.dP = sum / compressibility;
    return c;
}

double ice_created_pressure_at(const ice *s, const ice_view *v, ptrdiff_t at)
{
    return ice_created(s, v, at).dP;
}

void ice_created_pressure(const ice *s, const ice_view *v, double *P)
{
    const ice_rows q = ice_rows_of(v->b, -1, 0);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < q.n; ++row) {
        const ptrdiff_t base = ice_row_start(v->b, q, row);
        for (ptrdiff_t at = base; at < base + v->b->n[0]; ++at)
            P[at] += ice_implicit_phi(v, 0.5 * (1.0 + v->shock[at])) * ice_created(s, v, at).dP;
    }
}

/* ---- sources ---- */

/* `reacted` joins the product, at the reactant's velocity. The kinetic energy that is lost so stays in the product as
 * heat. */
static void add_to_product(const ice *s, const ice_view *v, const reaction *q, double reacted, ptrdiff_t at)
{
    const ice_fluid *from = &v->m[q->reactant], *to = &v->m[q->product];
    const double before = to->rhol[at], mass = before + reacted;
    double square = 0.0;
    for (int a = 0; a < v->dim; ++a) {
        const double slip = from->ul[a][at] - to->ul[a][at];
        square += slip * slip;
        to->ul[a][at] += reacted / mass * slip;
    }
    const double lost = s->scene->method.conserve_energy ? 0.5 * before * reacted / mass * square : 0.0;
    to->el[at] = (before * to->el[at] + reacted * (from->el[at] + q->heat) + lost) / mass;
    to->rhol[at] = mass;
    from->rhol[at] = fmax(from->rhol[at] - reacted, 0.0);
}

static void exchange_row(const ice *s, const ice_view *v, int j, int k)
{
    const ice_reactions *all = s->reactions;
    for (int i = 0; i < v->b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(v->b, i, j, k);
        for (int r = 0; r < v->n_materials; ++r) v->m[r].rhol[at] = v->m[r].rho[at];
        for (int n = 0; n < all->n; ++n) {
            const reaction *q = &all->list[n];
            const double reacted = v->reacted[n][at];
            if (!(reacted > 0.0)) continue;
            if (all->burns[n])
                ice_join_burnt(s, v, n, at, i);
            else
                add_to_product(s, v, q, reacted, at);
            /* The heat of solids is not in the ledger (their temperature is that of the scene): it is entered here. */
            const double brought = q->heat + (all->burns[n] ? v->m[q->reactant].e[at] : 0.0);
            const double volume = v->volume[i] * (v->m[0].open ? v->m[0].open[at] : 1.0);
            ice_tile(s, v->b, i, j, k)[TILE_SOURCE_ENERGY] += reacted * brought * volume;
        }
    }
}

floe_status ice_mass_exchange_of(ice *s, const ice_region *g)
{
    ice_clear_tiles(s);
    ice_view v;
    for (int id = 0; ice_next_view(s, g, &id, &v);) {
        const ice_rows q = ice_rows_of(v.b, -1, 0);
        const int chunk = ice_rows_chunk(s, q);
#pragma omp parallel for schedule(static, chunk)
        for (int row = 0; row < q.n; ++row) exchange_row(s, &v, ice_row_j(q, row), ice_row_k(q, row));
    }
    ice_enter_tiles(s);
    return FLOE_OK;
}
