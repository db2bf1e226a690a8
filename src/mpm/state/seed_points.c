/* Seeding: the points of every body, with their initial state. */
#include "base/memory.h"
#include "geom/seed.h"
#include "material/strain_from_stress.h"
#include "math/tensor.h"
#include "mpm/edge/edge.h"
#include "mpm/loads/spring.h"
#include "mpm/membrane/membrane_points.h"
#include "mpm/motion/motion.h"
#include "mpm/nodes/support_points.h"
#include "mpm/state/seed_fill.h"
#include "mpm/state/seed_hydrostatic.h"
#include "mpm/state/stress.h"
#include "mpm/surface/surface_markers.h"
#include "mpm/surface/traction.h"
#include "scene/formula.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

/* The key that gives a body its first stress, and who says so. */
static const char *stress_key(const scene_body *b)
{
    return b->initial_from_exact ? "state" : "stress";
}

static const char *stress_source(const scene_body *b)
{
    return b->initial_from_exact ? "exact: the solution starts from" : "it starts from";
}

/* With a law that depends on F, the strain determines the initial stress of the point. */
static floe_status set_strain(mpm *s, int blk, int body, size_t k, const double stress[6])
{
    static const int slot[3][9] = {{0, 4, 8}, {0, 1, 3, 4, 8}, {0, 1, 2, 3, 4, 5, 6, 7, 8}};
    const fields *f = s->domain->fields[blk];
    const mpm_body *b = &s->body[body];
    double F[9];
    const scene_body *given = &s->scene->body[b->scene_body];
    if (!strain_from_stress(b->law, b->law_par, stress, F))
        return fail_key(s->ctx, KEY("bodies", given->name, stress_key(given)),
                        "%s stresses up to %g Pa, and law '%s' has no strain with them; "
                        "give stiffer moduli, or a "
                        "smaller load",
                        stress_source(given), fmax(fmax(fabs(stress[0]), fabs(stress[1])), fabs(stress[2])),
                        b->law->name);
    for (int c = 0; c < field_component_count(FIELD_DEFORM, s->mesh->dim); ++c)
        field_get(f, P_F, body, c)[k] = F[slot[s->mesh->dim - 1][c]];
    field_get(f, P_J, body, 0)[k] = tensor_det(F);
    if (!given->initial_from_exact)
        field_get(f, P_VOLUME0, body, 0)[k] /= tensor_det(F); /* the shape is as it is now */
    return FLOE_OK;
}

/* A pressure that is an equation of state is that of the volume, which starts as that at rest. */
static floe_status refuse_first_pressure(const mpm *s, int body, const double stress[6])
{
    const mpm_body *b = &s->body[body];
    const scene_body *given = &s->scene->body[b->scene_body];
    if (stress[0] + stress[1] + stress[2] == 0.0) return FLOE_OK;
    return fail_key(s->ctx, KEY("bodies", given->name, stress_key(given)),
                    "%s a pressure, and the Mie-Grueneisen pressure of law '%s' is that of "
                    "its volume and energy: leave shock_slope and grueneisen out",
                    stress_source(given), b->law->name);
}

/* Unless the deck says at which temperature it is without stress, a solid that expands is so at the start. */
static floe_status set_temperature(mpm *s, int blk, int body, size_t k, const double x[3])
{
    const fields *f = s->domain->fields[blk];
    const mpm_body *b = &s->body[body];
    double T;
    if (!fields_has(f, P_TEMP, body)) return FLOE_OK;
    TRY(scene_number(s->scene, &s->scene->body[b->scene_body].temperature, x, 0.0, &T));
    field_get(f, P_TEMP, body, 0)[k] = T;
    if (fields_has(f, P_THERMAL_STRETCH, body)) field_get(f, P_THERMAL_STRETCH, body, 0)[k] = 1.0;
    if (!fields_has(f, P_STRESS_FREE, body)) return FLOE_OK;
    field_get(f, P_STRESS_FREE, body, 0)[k] = isnan(b->stress_free_temperature) ? T : b->stress_free_temperature;
    return FLOE_OK;
}

/* Density at rest and state of one point. Fluids: stress -(p - p_ref) I; weight: Pa, of the fluid above. */
static floe_status set_state(mpm *s, int blk, int body, size_t k, const double x[3], double volume, double weight)
{
    const fields *f = s->domain->fields[blk];
    const mpm_body *b = &s->body[body];
    double velocity[3], stress[6] = {0}, density = s->scene->material[b->scene_material].density;
    if (b->fluid) {
        fluid_state state;
        TRY(fluid_state_below(s, body, x, weight, &state, velocity));
        density = state.density;
        stress[0] = stress[1] = stress[2] = -(state.pressure - s->scene->reference_pressure);
        field_get(f, P_ENERGY, body, 0)[k] = state.energy;
    } else {
        TRY(body_solid_state(s->scene, b->scene_body, x, velocity, stress));
        if (supports_take_points(s, body) && support_with(s, x) >= 0) memset(stress, 0, sizeof stress);
        if (fields_has(f, P_ENERGY, body)) field_get(f, P_ENERGY, body, 0)[k] = 0.0;
        if (b->law->needs & SOLID_NEEDS_F) TRY(set_strain(s, blk, body, k, stress));
        if (b->depends_on & SOLID_BY_ENERGY) TRY(refuse_first_pressure(s, body, stress));
        TRY(set_temperature(s, blk, body, k, x));
    }
    const double mass = density * (b->fluid ? volume : field_get(f, P_VOLUME0, body, 0)[k]);
    field_get(f, P_MASS, body, 0)[k] = mass;
    for (int a = 0; a < s->mesh->dim; ++a) field_get(f, P_VEL, body, a)[k] = velocity[a];
    for (int c = 0; c < field_component_count(FIELD_STRESS, s->mesh->dim); ++c)
        field_get(f, P_STRESS, body, c)[k] = stress[c];
    if (body < s->n_deforming) s->reference_mass = fmax(s->reference_mass, mass);
    s->group_mass[b->group] = fmax(s->group_mass[b->group], mass);
    return FLOE_OK;
}

static floe_status velocity_at(const mpm *s, const mpm_body *b, const double x[3], double velocity[3])
{
    double stress[6];
    fluid_state state;
    return b->fluid ? body_fluid_state(s->scene, b->scene_body, x, &state, velocity)
                    : body_solid_state(s->scene, b->scene_body, x, velocity, stress);
}

/* C_p is the gradient of the velocity that the body starts with, by differences over half a cell, or over the half of that where the
 * velocity is known: a motion that is linear in space begins without an error. */
static floe_status set_affine(const mpm *s, int blk, int body, size_t k, const double x[3])
{
    const int dim = s->mesh->dim;
    for (int c = 0; c < dim; ++c) {
        const double step = 0.25 * s->mesh->h[c];
        double ahead[3] = {x[0], x[1], x[2]}, behind[3] = {x[0], x[1], x[2]}, v[2][3];
        ahead[c] += step;
        behind[c] -= step;
        if (!body_velocity_known(s->scene, s->body[body].scene_body, ahead)) ahead[c] = x[c];
        if (!body_velocity_known(s->scene, s->body[body].scene_body, behind)) behind[c] = x[c];
        TRY(velocity_at(s, &s->body[body], ahead, v[1]));
        TRY(velocity_at(s, &s->body[body], behind, v[0]));
        for (int a = 0; a < dim; ++a)
            field_get(s->domain->fields[blk], P_AFFINE, body, dim * a + c)[k] =
                ahead[c] > behind[c] && body < s->n_deforming ? (v[1][a] - v[0][a]) / (ahead[c] - behind[c]) : 0.0;
    }
    return FLOE_OK;
}

/* How much larger than the sub-cell of a point its domain is: where domains deform they have the volumes of their
 * points, which at a fitted surface are parts of sub-cells or joined ones. Boxes stay sub-cells. */
static double domain_scale(const mpm *s, int body, const seed_list *list, size_t n)
{
    double box = s->mesh->geometry == MESH_AXISYMMETRIC ? list->x[0][n] : 1.0;
    for (int a = 0; a < s->mesh->dim; ++a) box *= 2.0 * list->half[a][n];
    return keeps_shape(s, body) ? pow(list->volume[n] / box, 1.0 / s->mesh->dim) : 1.0;
}

static void set_shape(mpm *s, int blk, int body, size_t k, const seed_list *list, size_t n)
{
    static const int unit[3][3] = {{0, 1, 2}, {0, 3, 4}, {0, 4, 8}};
    const fields *f = s->domain->fields[blk];
    const int dim = s->mesh->dim;
    const double scale = domain_scale(s, body, list, n);
    /* Exact in a double: ids below 2^53. */
    field_get(f, P_ID, body, 0)[k] = (double)(((unsigned long long)body << 40) | n);
    field_get(f, P_VOLUME0, body, 0)[k] = list->volume[n];
    field_get(f, P_J, body, 0)[k] = 1.0;
    if (fields_has(f, P_SHARE, body)) field_get(f, P_SHARE, body, 0)[k] = 1.0;
    for (int h = 0; h < s->body[body].law->n_history; ++h) field_get(f, (field_id)(P_HISTORY_1 + h), body, 0)[k] = 0.0;
    for (int a = 0; a < dim; ++a) {
        field_get(f, P_POS, body, a)[k] = list->x[a][n];
        if (fields_has(f, P_REST, body)) field_get(f, P_REST, body, a)[k] = list->x[a][n];
        if (fields_has(f, P_HALF, body)) field_get(f, P_HALF, body, a)[k] = scale * list->half[a][n];
        if (fields_has(f, P_BOX, body)) field_get(f, P_BOX, body, a)[k] = list->half[a][n];
    }
    if (fields_has(f, P_F, body))
        for (int a = 0; a < 3; ++a) field_get(f, P_F, body, unit[dim - 1][a])[k] = 1.0;
}

static floe_status place_point(mpm *s, int body, const seed_list *list, size_t n, double weight)
{
    const int cell[3] = {list->cell[0][n], s->mesh->dim > 1 ? list->cell[1][n] : 0,
                         s->mesh->dim > 2 ? list->cell[2][n] : 0};
    const int blk = mesh_block_of(s->mesh, cell);
    mpm_points *points = &s->points[blk][body];
    TRY(fields_reserve_points(s->domain->fields[blk], body, points->n + 1));
    set_shape(s, blk, body, points->n, list, n);
    double x[3] = {0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = list->x[a][n];
    TRY(set_state(s, blk, body, points->n, x, list->volume[n], weight));
    if (fields_has(s->domain->fields[blk], P_AFFINE, body)) TRY(set_affine(s, blk, body, points->n, x));
    if (s->body[body].membrane.model) TRY(set_membrane(s, blk, body, points->n, n));
    points->n++;
    return FLOE_OK;
}

static floe_status seed_body(const mpm *s, int body, seed_list *list)
{
    const scene_body *b = &s->scene->body[s->body[body].scene_body];
    const seed_spec spec = body_seed_spec(s->scene, s->mesh, b);
    if (b->membrane.present)
        TRY(seed_membrane(s, b, &spec, list));
    else if (supports_lead(s, body))
        TRY(seed_supported(s, body, &spec, list));
    else
        TRY(body_points(b, s->ctx, &spec, list));
    if (list->n > 0) return FLOE_OK;
    return fail_key(
        s->ctx, KEY("bodies", b->name, "shape"),
        "no point lies in it: it is outside the domain, or between the points; move it, or make the cells smaller");
}

static floe_status seed_bodies(mpm *s, seed_list *list, double *weight[SCENE_MAX_BODIES])
{
    for (int body = 0; body < s->n_bodies; ++body) TRY(seed_body(s, body, &list[body]));
    TRY(fill_cells(s, list));
    TRY(find_hydrostatic_pressures(s, list, weight));
    for (int body = 0; body < s->n_bodies; ++body) {
        for (size_t n = 0; n < list[body].n; ++n)
            TRY(place_point(s, body, &list[body], n, weight[body] ? weight[body][n] : 0.0));
        seed_list_free(s->ctx, &list[body]);
        memory_free(s->ctx, &weight[body]);
    }
    return FLOE_OK;
}

floe_status mpm_seed(mpm *s)
{
    seed_list list[SCENE_MAX_BODIES] = {0};
    double *weight[SCENE_MAX_BODIES] = {NULL};
    const floe_status status = seed_bodies(s, list, weight);
    for (int body = 0; body < s->n_bodies; ++body) {
        seed_list_free(s->ctx, &list[body]);
        memory_free(s->ctx, &weight[body]);
    }
    TRY(status);
    TRY(seed_surfaces(s));
    if (s->cells == CELLS_CUT && scene_enclosing_body(s->scene) < 0) TRY(seed_markers(s));
    TRY(mpm_resort(s));
    TRY(start_membranes(s));
    motions_start(s);
    TRY(start_springs(s));
    return edges_start(s);
}
