/* Points as samples. */
#include "base/memory.h"
#include "math/tensor.h"
#include "run/samples.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

static const uint64_t ordinal_mask = (UINT64_C(1) << 40) - 1; /* of a point's id (design, conventions) */

static floe_status gather_point_values(point_samples *p, field_id id, int comp, double **out)
{
    TRY(memory_new(p->s->ctx, out, p->list.n, sizeof **out));
    gather_points(p->s, &p->list, id, comp, 1, *out);
    return FLOE_OK;
}

static floe_status gather_motion(point_samples *p)
{
    const int dim = p->s->mesh.dim;
    for (int a = 0; a < dim; a++) {
        TRY(gather_point_values(p, P_POS, a, &p->x[a]));
        TRY(gather_point_values(p, P_VEL, a, &p->v[a]));
    }
    for (int c = 0; c < field_component_count(FIELD_STRESS, dim); c++)
        TRY(gather_point_values(p, P_STRESS, c, &p->stress[c]));
    return FLOE_OK;
}

/* Volume and density now, from those at the start. */
static floe_status gather_volume(point_samples *p)
{
    double *J, *mass;
    TRY(gather_point_values(p, P_VOLUME0, 0, &p->volume));
    TRY(gather_point_values(p, P_MASS, 0, &p->density));
    TRY(gather_point_values(p, P_J, 0, &J));
    mass = p->density;
    for (size_t i = 0; i < p->list.n; i++) {
        p->volume[i] *= J[i];
        p->density[i] = mass[i] / p->volume[i];
    }
    memory_free(p->s->ctx, &J);
    return FLOE_OK;
}

/* Solutions of solids are given at the place before the load: seeding again tells it, for an id names its place in the
 * seeding. */
static floe_status find_start(point_samples *p)
{
    const sim *s = p->s;
    const scene_body *b = &s->scene->body[s->mpm->body[p->body].scene_body];
    const seed_spec spec = body_seed_spec(s->scene, &s->mesh, b);
    seed_list seeds;
    for (int a = 0; a < s->mesh.dim; a++) TRY(memory_new(s->ctx, &p->start[a], p->list.n, sizeof(double)));
    TRY(body_points(b, s->ctx, &spec, &seeds));
    for (size_t i = 0; i < p->list.n; i++) {
        const uint64_t ordinal = p->list.place[i].id & ordinal_mask;
        for (int a = 0; a < s->mesh.dim; a++) p->start[a][i] = ordinal < seeds.n ? seeds.x[a][ordinal] : (double)NAN;
    }
    seed_list_free(s->ctx, &seeds);
    return FLOE_OK;
}

/* Normals that a membrane's points hold, or, of a connected line in a plane, those across its tangents. */
static floe_status gather_normals(point_samples *p)
{
    const fields *f = p->s->domain->fields[0];
    const int dim = p->s->mesh.dim;
    if (fields_has(f, P_NORMAL, p->body)) {
        for (int a = 0; a < dim; a++) TRY(gather_point_values(p, P_NORMAL, a, &p->normal[a]));
    } else if (dim == 2 && fields_has(f, P_TANGENT, p->body)) {
        for (int a = 0; a < dim; a++) TRY(gather_point_values(p, P_TANGENT, 1 - a, &p->normal[a]));
        for (size_t i = 0; i < p->list.n; i++) p->normal[1][i] = -p->normal[1][i];
    }
    return FLOE_OK;
}

static floe_status take_point_samples(point_samples *p)
{
    TRY(point_list_make(&p->list, p->s, p->body));
    TRY(gather_motion(p));
    TRY(gather_volume(p));
    if (exact_provides(p->solution, EXACT_NORMAL)) TRY(gather_normals(p));
    if (fields_has(p->s->domain->fields[0], P_ENERGY, p->body)) TRY(gather_point_values(p, P_ENERGY, 0, &p->energy));
    return exact_is_solid(p->solution) ? find_start(p) : FLOE_OK;
}

floe_status point_samples_take(point_samples *p, const sim *s, const exact *solution, int body)
{
    *p = (point_samples){.s = s, .solution = solution, .body = body};
    const floe_status status = take_point_samples(p);
    if (status != FLOE_OK) point_samples_free(p);
    return status;
}

void point_samples_free(point_samples *p)
{
    context *ctx = p->s->ctx;
    for (int a = 0; a < 3; a++) {
        memory_free(ctx, &p->x[a]);
        memory_free(ctx, &p->start[a]);
        memory_free(ctx, &p->v[a]);
        memory_free(ctx, &p->normal[a]);
    }
    for (int c = 0; c < 6; c++) memory_free(ctx, &p->stress[c]);
    memory_free(ctx, &p->volume);
    memory_free(ctx, &p->density);
    memory_free(ctx, &p->energy);
    point_list_free(ctx, &p->list);
}

static void point_position(double *const from[3], int dim, size_t i, double x[3])
{
    for (int a = 0; a < 3; a++) x[a] = a < dim ? from[a][i] : 0.0;
}

/* A solution of a plane across an axis, in a scene (r, z) about that axis: its x is r, its z is z, and its yy the hoop
 * stress. */
static bool is_turned(const point_samples *p)
{
    return p->s->mesh.geometry == MESH_AXISYMMETRIC && strcmp(p->solution->model->name, "lame") == 0;
}

/* The place as the solution has it. */
static void solution_place(const point_samples *p, size_t i, double x[3])
{
    point_position(p->start[0] ? p->start : p->x, p->s->mesh.dim, i, x);
    if (!is_turned(p)) return;
    x[2] = x[1];
    x[1] = 0.0;
}

/* Component of a vector of the scene that is component a of the solution's; -1: it has none. */
static int vector_component(const point_samples *p, int a)
{
    if (is_turned(p)) return a == 0 ? 0 : a == 2 ? 1 : -1;
    return a < p->s->mesh.dim ? a : -1;
}

static double stress_at(const point_samples *p, int c, size_t i)
{
    static const int turned[6] = {0, 2, 1, 4, 5, 3};
    const int own = is_turned(p) ? turned[c] : c;
    /* 1-D keeps xx yy zz, 2-D adds xy. */
    return p->stress[own] ? p->stress[own][i] : 0.0;
}

/* The solution's centre; the origin if it has none. */
static void centre_of(const exact *solution, double centre[3])
{
    /* exact_param gives a way to write; here it is read only. */
    const double *value = exact_param(solution->model, (void *)solution->par, "centre");
    for (int a = 0; a < 3; a++) centre[a] = value ? value[a] : 0.0;
}

/* Radial stress about the solution's centre, and the hoop stress: in the plane about an axis, or, of a sphere, the mean
 * of the two tangential ones. */
static void polar_stress(const point_samples *p, size_t i, double *radial, double *hoop)
{
    const bool sphere = strcmp(p->solution->model->name, "lame_sphere") == 0;
    const int dim = p->s->mesh.dim, axes = sphere ? dim : dim < 2 ? dim : 2;
    double x[3], centre[3], n[3], square = 0.0;
    solution_place(p, i, x);
    centre_of(p->solution, centre);
    for (int a = 0; a < 3; a++) {
        n[a] = a < axes ? x[a] - centre[a] : 0.0;
        square += n[a] * n[a];
    }
    for (int a = 0; a < 3; a++) n[a] /= sqrt(square);
    const double xx = stress_at(p, 0, i), yy = stress_at(p, 1, i), zz = stress_at(p, 2, i);
    const double xy = stress_at(p, 3, i), yz = stress_at(p, 4, i), zx = stress_at(p, 5, i);
    *radial = n[0] * n[0] * xx + n[1] * n[1] * yy + n[2] * n[2] * zz +
              2.0 * (n[0] * n[1] * xy + n[1] * n[2] * yz + n[2] * n[0] * zx);
    *hoop = sphere ? 0.5 * (xx + yy + zz - *radial) : n[1] * n[1] * xx + n[0] * n[0] * yy - 2.0 * n[0] * n[1] * xy;
}

static double polar_value(const point_samples *p, exact_quantity quantity, size_t i)
{
    double radial, hoop;
    polar_stress(p, i, &radial, &hoop);
    return quantity == EXACT_SIGMA_R ? radial : hoop;
}

/* Absolute as fluids have it; solutions of solids are relative to the reference pressure. */
static double point_pressure_at(const point_samples *p, size_t i)
{
    const double gauge = -(stress_at(p, 0, i) + stress_at(p, 1, i) + stress_at(p, 2, i)) / 3.0;
    return exact_is_solid(p->solution) ? gauge : gauge + p->s->scene->reference_pressure;
}

static double point_temperature_at(const point_samples *p, size_t i)
{
    const mpm_body *b = &p->s->mpm->body[p->body];
    double T = NAN;
    if (b->fluid && p->energy)
        b->fluid_par.eos.model->temperature(b->fluid_par.eos.par, 1, &p->density[i], &p->energy[i], &T);
    return T;
}

/* A surface has two sides: the point's normal on that of the exact one, and the angle (degrees) from there. */
static double normal_value(const point_samples *p, exact_quantity quantity, size_t i)
{
    double own[3], wanted[3], across[3];
    if (!p->normal[0]) return NAN;
    point_position(p->normal, p->s->mesh.dim, i, own);
    for (int a = 0; a < 3; a++) wanted[a] = point_exact(p, (exact_quantity)(EXACT_NORMAL_X + a), i);
    const double along = vec_dot(own, wanted);
    if (quantity != EXACT_NORMAL) return copysign(1.0, along) * own[quantity - EXACT_NORMAL_X];
    vec_cross(own, wanted, across);
    return atan2(vec_norm(across), fabs(along)) * 180.0 / acos(-1.0);
}

double point_value(const point_samples *p, exact_quantity quantity, size_t i)
{
    if (quantity >= EXACT_VELOCITY_X && quantity <= EXACT_VELOCITY_Z) {
        const int a = vector_component(p, (int)(quantity - EXACT_VELOCITY_X));
        return a >= 0 ? p->v[a][i] : 0.0;
    }
    if (quantity >= EXACT_STRESS_XX && quantity <= EXACT_STRESS_ZX)
        return stress_at(p, (int)(quantity - EXACT_STRESS_XX), i);
    if (quantity >= EXACT_DISPLACEMENT_X && quantity <= EXACT_DISPLACEMENT_Z) {
        const int a = vector_component(p, (int)(quantity - EXACT_DISPLACEMENT_X));
        if (a < 0) return 0.0;
        return p->start[a] ? p->x[a][i] - p->start[a][i] : (double)NAN;
    }
    if (quantity >= EXACT_NORMAL_X && quantity <= EXACT_NORMAL) return normal_value(p, quantity, i);
    switch (quantity) {
    case EXACT_DENSITY: return p->density[i];
    case EXACT_PRESSURE: return point_pressure_at(p, i);
    case EXACT_INTERNAL_ENERGY: return p->energy ? p->energy[i] : (double)NAN;
    case EXACT_TEMPERATURE: return point_temperature_at(p, i);
    case EXACT_SIGMA_R:
    case EXACT_SIGMA_THETA: return polar_value(p, quantity, i);
    default: return NAN;
    }
}

double point_exact(const point_samples *p, exact_quantity quantity, size_t i)
{
    const sim *s = p->s;
    const bool velocity = quantity >= EXACT_VELOCITY_X && quantity <= EXACT_VELOCITY_Z;
    double x[3], t = s->time;
    solution_place(p, i, x);
    /* In pure MPM velocities are those of half a step ago (design, conventions). */
    if (velocity && s->mpm->cells != CELLS_SMEARED && !sim_solves(s)) t -= 0.5 * s->mpm->dt_previous;
    return exact_value(p->solution, quantity, x, t);
}

bool point_inside(const point_samples *p, const shape *region, size_t i)
{
    double x[3];
    if (!region->model) return true;
    point_position(p->x, p->s->mesh.dim, i, x);
    return shape_inside(region, p->s->mesh.dim, x);
}
