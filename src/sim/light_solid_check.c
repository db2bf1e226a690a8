#include "sim/light_solid_check.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Least density of the solid over that of the fluid. The smeared interface gives lighter ones the wrong share of the momentum of
 * their cells: of that which sound brings, 0.115 off at 0.01, 1.3 times as much at 0.001 (docs/results/extreme.md, impedance); with hat functions, GIMP and CPDI the sharp one
 * swings up, in steps a hundred times smaller than sound asks for at 1e-3, however small they are at 1e-4. With implicit
 * wall pressures (theory 7.6) a disc of 1e-5 of the fluid's density oscillates behind a shock that moves it at 0.17 of the speed of sound, and one of 1e-6 in
 * sound itself; one of 1e-4 does not. */
static const double least_share = 0.9e-2, least_share_implicit = 0.9e-4;

/* Of a cell: what smears into cells that solids fill, where they are squeezed or their motion spreads over cells, is no neighbour. */
static const double trace = 0.05;

/* Whether a fluid accelerates it. */
static bool is_moved_solid(const scene *s, int body)
{
    const scene_material *m = &s->material[s->body[body].material];
    return m->kind == MATERIAL_SOLID && m->law && !motion_is_prescribed(&s->body[body].motion);
}

static bool is_sharp(const sim *s)
{
    return s->scene->method.interface == INTERFACE_SHARP;
}

/* Whether the nodes' masses alone determine how the surface of a body responds to a force, as the implicit wall pressure assumes. With hat functions and GIMP
 * light nodes take the acceleration of their points, and CPDI's domains end at the surface, so that the response is not known before the body has moved. A
 * plate of 0.1 of the fluid's density is stable with them all the same; one of 0.01 is not, for some positions of its surface within a cell. */
static bool surface_follows_nodes(const sim *s, int body)
{
    const basis_model *b = s->mpm->basis;
    return motion_is_given(&s->scene->body[body].motion) || (!b->fact.hats && !b->fact.shaped);
}

static double least_share_of(const sim *s, int body)
{
    return is_sharp(s) && surface_follows_nodes(s, body) ? least_share_implicit : least_share;
}

static double density_of(const scene *s, int body)
{
    return s->material[s->body[body].material].density;
}

int lightest_moved_solid(const scene *s)
{
    int found = -1;
    for (int b = 0; b < s->n_bodies; ++b)
        if (is_moved_solid(s, b) && (found < 0 || density_of(s, b) < density_of(s, found))) found = b;
    return found;
}

/* Marks a cell and those about it. */
static void mark_about(const mesh *m, const int centre[MESH_MAX_DIM], unsigned char *const *mark)
{
    int step[MESH_MAX_DIM] = {0, 0, 0};
    const int all = m->dim == 1 ? 3 : m->dim == 2 ? 9 : 27;
    for (int k = 0; k < all; ++k) {
        int cell[MESH_MAX_DIM] = {0, 0, 0}, rest = k;
        bool inside = true;
        for (int a = 0; a < m->dim; ++a, rest /= 3) {
            step[a] = rest % 3 - 1;
            cell[a] = mesh_index_around(m, a, centre[a] + step[a]);
            inside = inside && cell[a] >= 0 && cell[a] < m->n[a];
        }
        if (!inside) continue;
        const int id = mesh_block_of(m, cell);
        const int *lo = m->block[id].lo;
        mark[id][mesh_index(&m->block[id], cell[0] - lo[0], cell[1] - lo[1], cell[2] - lo[2])] = 1;
    }
}

/* Marks the cells in which a body has points, and those about them: with these it shares the nodes. */
static void mark_body(const sim *s, int body, unsigned char *const *mark)
{
    const mesh *m = &s->mesh;
    for (int id = 0; id < m->n_blocks; ++id) {
        int last[MESH_MAX_DIM] = {-1, -1, -1};
        for (size_t k = 0; k < s->mpm->points[id][body].n; ++k) {
            int cell[MESH_MAX_DIM] = {0, 0, 0};
            for (int a = 0; a < m->dim; ++a)
                cell[a] = mesh_cell_of(m, a, field_get(s->domain->fields[id], P_POS, body, a)[k]);
            if (memcmp(cell, last, sizeof cell) != 0) mark_about(m, cell, mark);
            memcpy(last, cell, sizeof last);
        }
    }
}

static floe_status refuse_light_solid(const sim *s, int body, double fluid)
{
    const double rho = density_of(s->scene, body);
    const bool could = least_share_of(s, body) == least_share && rho >= least_share_implicit * fluid;
    char why[512];
    (void)snprintf(
        why, sizeof why,
        "body '%s' (%g kg/m3) is %.3g times as heavy as the fluid beside it (%g kg/m3), and %s bears no less "
        "than %.2g: %smake it heavier, or leave it out",
        s->scene->body[body].name, rho, rho / fluid, fluid,
        !is_sharp(s) ? "the smeared interface"
        : could      ? "a surface with this basis"
                     : "a surface",
        least_share_of(s, body), could ? "use method.interface: sharp with basis: quadratic, " : "");
    if (s->steps > 0) return fail(s->ctx, FLOE_DIVERGED, "at t = %.6g%s %s", s->time, scene_time_unit(s->scene), why);
    const scene_material *m = &s->scene->material[s->scene->body[body].material];
    return fail_key(s->ctx, KEY("materials", m->name, "density"), "%s", why);
}

/* Looks at the fluid beside one body. `mark`: per block, for each of its cells. */
static floe_status find_fluid_beside(sim *s, int b, unsigned char *const *mark)
{
    const int body = s->mpm->body[b].scene_body;
    for (int id = 0; id < s->mesh.n_blocks; ++id) memset(mark[id], 0, s->mesh.block[id].size);
    mark_body(s, b, mark);
    const double fluid = ice_densest(s->ice, (const unsigned char *const *)mark, trace);
    return density_of(s->scene, body) >= least_share_of(s, body) * fluid ? FLOE_OK : refuse_light_solid(s, body, fluid);
}

static bool is_light_solid(const sim *s, int b, double fluid)
{
    const int body = s->mpm->body[b].scene_body;
    return is_moved_solid(s->scene, body) && density_of(s->scene, body) < least_share_of(s, body) * fluid;
}

/* Checks the bodies that are too light for a fluid of the density `fluid` (kg/m3). */
static floe_status look_at_bodies(sim *s, double fluid)
{
    unsigned char *mark[MESH_MAX_BLOCKS] = {NULL};
    floe_status status = FLOE_OK;
    for (int id = 0; status == FLOE_OK && id < s->mesh.n_blocks; ++id)
        status = memory_new(s->ctx, &mark[id], s->mesh.block[id].size, 1);
    for (int b = 0; status == FLOE_OK && b < s->mpm->n_bodies; ++b)
        if (is_light_solid(s, b, fluid)) status = find_fluid_beside(s, b, mark);
    for (int id = 0; id < s->mesh.n_blocks; ++id) memory_free(s->ctx, &mark[id]);
    return status;
}

floe_status light_solid_check(sim *s)
{
    double range[2];
    const int body = s->mpm && s->ice ? lightest_moved_solid(s->scene) : -1;
    if (body < 0 || (s->embedded && !is_sharp(s)) || sim_is_static(s)) return FLOE_OK;
    ice_densities(s->ice, range);
    s->has_light = s->has_light || density_of(s->scene, body) < least_share * range[1];
    return s->has_light ? look_at_bodies(s, range[1]) : FLOE_OK;
}

/* Density of the lightest solid over that of the densest fluid; infinity where there is no such solid. */
static double least_ratio(const sim *s)
{
    double range[2];
    const int body = lightest_moved_solid(s->scene);
    if (body < 0) return INFINITY;
    ice_densities(s->ice, range);
    return density_of(s->scene, body) / range[1];
}

bool has_dense_fluid(const sim *s, double share)
{
    return share * least_ratio(s) < 1.0;
}

/* With explicit wall pressures, the pressure of a step follows from the surface's velocity before the step, and the surface has the inertia of the nodes next to
 * it: a layer of fluid heavier than these nodes makes it oscillate. In units of (h/c) (solid density / fluid density)^(1/2), at a hundredth of the fluid's density, a
 * surface in the middle of a cell is stable with steps of 0.2 and unstable with 0.28; elsewhere in the cell the limit is higher. At a CFL number of one sound
 * crosses a cell of equal sides in two steps (ice_limit.c). At equal densities a CFL number of 0.9 is too large, at twice the density it is not. */
double light_solid_step(const sim *s, double crossing)
{
    static const double share = 0.35;
    return is_sharp(s) && !wall_pressure_is_implicit(s) ? share * crossing * sqrt(least_ratio(s)) : (double)INFINITY;
}

/* For solids of up to 1.5 times the density of the fluid. From a ratio of 2 down, the bound of light_solid_step is active at the default CFL number, and the
 * fluid's impedance over the inertia of the nodes, dt A z/m, is a sixteenth to an eighth. Velocity errors of plates between liquids are as large or up to a third
 * smaller with implicit wall pressures (theory 7.6); heavier solids keep the explicit ones, which cost less. */
bool wall_pressure_is_implicit(const sim *s)
{
    static const double heaviest = 1.5;
    double range[2];
    if (is_sharp(s) && s->ice->implicit) return true; /* there walls are part of the system (theory 7.8) */
    if (!is_sharp(s) || sim_solves(s) || !(least_ratio(s) < heaviest)) return false;
    ice_densities(s->ice, range);
    for (int b = 0; b < s->scene->n_bodies; ++b)
        if (is_moved_solid(s->scene, b) && density_of(s->scene, b) < heaviest * range[1] &&
            !surface_follows_nodes(s, b))
            return false;
    return true;
}
