/* Strain, artificial viscosity, heating and the law, in batches of points unpacked to three dimensions. */
#include "mpm/state/stress.h"
#include "mpm/state/mean_strain.h"

#include "geom/compound.h"
#include "material/artificial_viscosity.h"
#include "mpm/membrane/enclosed_gas.h"
#include "mpm/state/region.h"
#include "mpm/thermal/thermal_stress.h"
#include "scene/state.h"

#include <math.h>
#include <string.h>

/* Where the stored components of the deformation gradient go in a batch; those of stress keep their place. */
static const int deform_slot[3][9] = {{0, 4, 8}, {0, 1, 3, 4, 8}, {0, 1, 2, 3, 4, 5, 6, 7, 8}};

/* Velocities are at n - 1/2, so that USF, which strains before the forces, advances the stress from n - 1 to n with the former
 * step, which is zero at first. (With the present step USF is first order in time.) Coupled to cells, all variables are at n. */
static bool strains_back(const mpm *s)
{
    return s->scene->method.stress == STRESS_USF && s->cells != CELLS_SMEARED;
}

double strain_step(const mpm *s)
{
    return strains_back(s) ? s->dt_previous : s->dt;
}

bool has_artificial(const mpm_body *b)
{
    return b->artificial[0] > 0.0 || b->artificial[1] > 0.0;
}

static field_id history_field(int k)
{
    return (field_id)(P_HISTORY_1 + k);
}

static void load_density(const fields *f, int body, size_t start, solid_batch *batch)
{
    const double *restrict mass = field_get(f, P_MASS, body, 0), *restrict volume = field_get(f, P_VOLUME0, body, 0);
    for (size_t k = 0; k < batch->n; ++k) batch->rho0[k] = mass[start + k] / volume[start + k];
}

void load_batch(const mpm *s, int blk, int body, size_t start, size_t end, bool next, solid_batch *batch)
{
    const fields *f = s->domain->fields[blk];
    const int dim = s->mesh->dim;
    const size_t n = end - start, bytes = n * sizeof(double);
    double *(*get)(const fields *, field_id, int, int) = next ? field_next : field_get;
    const mpm_body *b = &s->body[body];
    batch->n = n;
    batch->dt = strain_step(s);
    memcpy(batch->J, get(f, P_J, body, 0) + start, bytes);
    memcpy(batch->J_old, batch->J, bytes);
    for (int c = 0; c < field_component_count(FIELD_STRESS, dim); ++c)
        memcpy(batch->stress[c], get(f, P_STRESS, body, c) + start, bytes);
    if (keeps_F(s, body))
        for (int c = 0; c < field_component_count(FIELD_DEFORM, dim); ++c)
            memcpy(batch->F[deform_slot[dim - 1][c]], get(f, P_F, body, c) + start, bytes);
    else /* a stress state moves the free stretches of F, whether they are kept or not */
        for (size_t k = 0; k < n; ++k) batch->F[4][k] = batch->F[8][k] = 1.0;
    for (int k = 0; k < b->law->n_history; ++k)
        memcpy(batch->history[k], get(f, history_field(k), body, 0) + start, bytes);
    if (b->depends_on) load_heat(s, blk, body, start, batch);
    if (!(b->law->needs & SOLID_HAS_ENERGY) && !has_artificial(b)) return; /* other laws take neither */
    if (b->law->needs & SOLID_HAS_ENERGY) memcpy(batch->energy, get(f, P_ENERGY, body, 0) + start, bytes);
    load_density(f, body, start, batch);
    if (has_artificial(b))
        memcpy(batch->q, get(f, P_VISCOUS_PRESSURE, body, 0) + start, bytes);
    else
        memset(batch->q, 0, bytes);
}

void load_speed_batch(const mpm *s, int blk, int body, size_t start, size_t end, solid_batch *batch)
{
    const fields *f = s->domain->fields[blk];
    const mpm_body *b = &s->body[body];
    const size_t bytes = (end - start) * sizeof(double);
    const bool deformed = (b->law->needs & SOLID_NEEDS_F) != 0; /* the speeds of others are those at rest */
    batch->n = end - start;
    memcpy(batch->J, field_get(f, P_J, body, 0) + start, bytes);
    load_density(f, body, start, batch);
    for (int c = 0; deformed && c < field_component_count(FIELD_DEFORM, s->mesh->dim); ++c)
        memcpy(batch->F[deform_slot[s->mesh->dim - 1][c]], field_get(f, P_F, body, c) + start, bytes);
    for (int k = 0; deformed && k < b->law->n_history; ++k)
        memcpy(batch->history[k], field_get(f, history_field(k), body, 0) + start, bytes);
    if (b->law->needs & SOLID_HAS_ENERGY) memcpy(batch->energy, field_get(f, P_ENERGY, body, 0) + start, bytes);
    if (b->depends_on) load_heat(s, blk, body, start, batch);
    if (has_artificial(b)) memcpy(batch->q, field_get(f, P_VISCOUS_PRESSURE, body, 0) + start, bytes);
}

/* L += half L^2. */
FLOE_WIDE static void add_square(solid_batch *b, double half)
{
    for (size_t k = 0; k < b->n; ++k) {
        double G[9];
        for (int c = 0; c < 9; ++c) G[c] = b->L[c][k];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                b->L[3 * i + j][k] += half * (G[3 * i] * G[j] + G[3 * i + 1] * G[3 + j] + G[3 * i + 2] * G[6 + j]);
    }
}

/* The same where nothing leans out of the plane. */
FLOE_WIDE static void add_square_in_plane(solid_batch *b, double half)
{
    double *restrict xx = b->L[0], *restrict xy = b->L[1], *restrict yx = b->L[3], *restrict yy = b->L[4],
                     *restrict zz = b->L[8];
    for (size_t k = 0; k < b->n; ++k) {
        const double trace = xx[k] + yy[k], both = xy[k] * yx[k];
        xx[k] += half * (xx[k] * xx[k] + both);
        yy[k] += half * (yy[k] * yy[k] + both);
        xy[k] += half * trace * xy[k];
        yx[k] += half * trace * yx[k];
        zz[k] += half * zz[k] * zz[k];
    }
}

/* Nodes have their velocity of the middle of the step, v = (x' - x)/dt, and gradients are taken where points stand at its start, so that
 * x' - x = dt G x and F' = (I + dt G) F to round-off. Laws and F take the gradient with respect to the middle of the way,
 * L = G (I + dt G/2)^-1 = G - dt G^2/2 to second order; with G in its place large strains are first order in the step. USF looks back from
 * where points stand at the end, F' = (I - dt G)^-1 F: the sign turns. */
static void centre_rates(const mpm *s, solid_batch *b)
{
    const double half = (strains_back(s) ? 0.5 : -0.5) * b->dt;
    if (s->mesh->dim == 3)
        add_square(b, half);
    else
        add_square_in_plane(b, half);
}

void rates_of_volume(const mpm *s, solid_batch *b, double *out)
{
    b->dt = strain_step(s);
    centre_rates(s, b);
    for (size_t k = 0; k < b->n; ++k) out[k] = b->L[0][k] + b->L[4][k] + b->L[8][k];
}

/* F <- (I + A + A^2/2) F with A = dt L, and J = det F: second order, and exact in volume to third. */
FLOE_WIDE static void advance_F(solid_batch *b)
{
    for (size_t k = 0; k < b->n; ++k) {
        double A[9], B[9], F[9];
        for (int c = 0; c < 9; ++c) A[c] = b->dt * b->L[c][k];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                double square = 0.0;
                for (int l = 0; l < 3; ++l) square += A[3 * i + l] * A[3 * l + j];
                B[3 * i + j] = (i == j ? 1.0 : 0.0) + A[3 * i + j] + 0.5 * square;
            }
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                F[3 * i + j] = 0.0;
                for (int l = 0; l < 3; ++l) F[3 * i + j] += B[3 * i + l] * b->F[3 * l + j][k];
            }
        for (int c = 0; c < 9; ++c) b->F[c][k] = F[c];
        b->J[k] = F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
                  F[2] * (F[3] * F[7] - F[4] * F[6]);
    }
}

/* Volumes that places at the end of the step say, det(I + dt G), of fluids: whatever they do the work of p div v on the nodes is p dV then,
 * and a gas that turns keeps its volume. With exp(dt tr G) a shock that closes a point by dt D a step leaves it too large by (dt D)^2/2 each
 * time: a first-order error, which had 8 % of the pressure behind a reflected shock. USF looks back, 1/det(I - dt G). */
FLOE_WIDE static void find_growth(const mpm *s, const solid_batch *b, double *restrict growth)
{
    const bool back = strains_back(s);
    const double dt = back ? -b->dt : b->dt;
    for (size_t k = 0; k < b->n; ++k) {
        double A[9];
        for (int c = 0; c < 9; ++c) A[c] = (c % 4 == 0 ? 1.0 : 0.0) + dt * b->L[c][k];
        const double det = A[0] * (A[4] * A[8] - A[5] * A[7]) - A[1] * (A[3] * A[8] - A[5] * A[6]) +
                           A[2] * (A[3] * A[7] - A[4] * A[6]);
        growth[k] = back ? 1.0 / det : det;
    }
}

static void grow_volumes(solid_batch *b, const double *growth)
{
    for (size_t k = 0; k < b->n; ++k) b->J[k] = b->J_old[k] * growth[k];
}

static void advance_J(solid_batch *b)
{
    for (size_t k = 0; k < b->n; ++k) b->J[k] = b->J_old[k] * exp(b->dt * (b->L[0][k] + b->L[4][k] + b->L[8][k]));
}

/* Boxes of a fluid in GIMP swell along the axes, l <- l exp(dt L_aa): those of points side by side go on to meet, and their product
 * goes with the volume as advance_J has it. Boxes that kept their size would gape and overlap at first order, and a uniform pressure
 * pushes nodes by what overlaps: a force that has no energy of its own, and feeds on the gas's. (Measured on 8 x 8 cells of gas at rest
 * but for a sound of one in a thousand: 3000 times its energy within twelve crossings. In one dimension nothing grew.) */
static void swell_boxes(const mpm *s, int blk, int body, size_t start, const solid_batch *b)
{
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double *restrict now = field_get(s->domain->fields[blk], P_BOX, body, a) + start;
        double *restrict next = field_next(s->domain->fields[blk], P_BOX, body, a) + start;
        for (size_t k = 0; k < b->n; ++k) next[k] = now[k] * exp(b->dt * b->L[4 * a][k]);
    }
}

/* Puts the density of the cells in the place of continuity's: at the end of the step theirs, before it what becomes of it by the
 * divergence of velocity, so that energy takes p div v dt (Y97 eq. 4.10) and nothing of what the cells' densities jump. */
static void take_cell_density(const mpm *s, int blk, int body, size_t start, solid_batch *b)
{
    const double *density = field_get(s->domain->fields[blk], P_DENSITY, body, 0) + start;
    for (size_t k = 0; k < b->n; ++k) {
        const double growth = b->J[k] / b->J_old[k];
        b->J[k] = b->rho0[k] / density[k];
        b->J_old[k] = b->J[k] / growth;
    }
}

/* Wilkins' artificial viscosity over the step (Y00 eq. 24, with a pressure's units: theory 11). */
static void set_artificial(const mpm *s, const mpm_body *body, solid_batch *b)
{
    double c[SOLID_CHUNK], length = s->mesh->h[0];
    for (int a = 1; a < s->mesh->dim; ++a) length = fmin(length, s->mesh->h[a]);
    body->law->wave_speed(body->law_par, s->scene->reference_pressure, b, c);
    for (size_t k = 0; k < b->n; ++k)
        b->q[k] = artificial_pressure(b->rho0[k] / b->J[k], c[k], b->L[0][k] + b->L[4][k] + b->L[8][k], length,
                                      body->artificial[0], body->artificial[1]);
}

/* Of the box that the point had as its part of a cell, as large as it is now. */
double point_region_share(const mpm *s, const fields *f, int body, size_t k, const shape *region)
{
    const scene_body *given = &s->scene->body[s->body[body].scene_body];
    const bool radial = s->mesh->geometry == MESH_AXISYMMETRIC;
    double lo[3] = {0}, hi[3] = {0};
    if (!region || !region->model) return 1.0;
    const double stretch = pow(field_get(f, P_J, body, 0)[k], 1.0 / s->mesh->dim);
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double x = field_get(f, P_POS, body, a)[k], half = 0.5 * stretch * s->mesh->h[a] / given->per_cell[a];
        lo[a] = radial && a == 0 ? fmax(x - half, 0.0) : x - half;
        hi[a] = x + half;
    }
    return region_share(region, s->mesh->dim, lo, hi, radial);
}

/* Power (W/m3) of a load at a point, in the middle of the step. */
static double power_at(const mpm *s, const fields *f, int body, size_t k, const scene_load *load)
{
    double x[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, body, a)[k];
    return load_target(s->scene, load, x, s->time + 0.5 * s->dt);
}

/* Energy of the heating loads into points of a fluid: e += dp / (dp/de), or power dt / rho. Returns what was added (J). */
static double add_heat_of_work(const mpm *s, int blk, int body, size_t start, solid_batch *b)
{
    const mpm_body *m = &s->body[body];
    const fields *f = s->domain->fields[blk];
    const double *mass = field_get(f, P_MASS, body, 0);
    double added = 0.0;
    for (int l = 0; l < s->scene->n_loads; ++l) {
        const scene_load *load = &s->scene->load[l];
        if (s->heat[l] == 0.0 || load->material != m->scene_material) continue;
        double rho[SOLID_CHUNK], dpde[SOLID_CHUNK];
        for (size_t k = 0; k < b->n; ++k) rho[k] = b->rho0[k] / b->J_old[k];
        const bool by_power = load->kind == LOAD_HEAT;
        if (!by_power) m->fluid_par.eos.model->dpde(m->fluid_par.eos.par, b->n, rho, b->energy, dpde);
        for (size_t k = 0; k < b->n; ++k) {
            const double share = point_region_share(s, f, body, start + k, &load->region);
            if (!(share > 0.0)) continue;
            const double amount = by_power ? power_at(s, f, body, start + k, load) * s->heat[l] : s->heat[l];
            const double de = share * amount / (by_power ? rho[k] : dpde[k]);
            b->energy[k] += de;
            added += de * mass[start + k];
        }
    }
    return added;
}

void store_batch(const mpm *s, int blk, int body, size_t start, const solid_batch *b)
{
    const fields *f = s->domain->fields[blk];
    const int dim = s->mesh->dim;
    const size_t bytes = b->n * sizeof(double);
    const mpm_body *m = &s->body[body];
    memcpy(field_next(f, P_J, body, 0) + start, b->J, bytes);
    for (int c = 0; c < field_component_count(FIELD_STRESS, dim); ++c)
        memcpy(field_next(f, P_STRESS, body, c) + start, b->stress[c], bytes);
    if (keeps_F(s, body))
        for (int c = 0; c < field_component_count(FIELD_DEFORM, dim); ++c)
            memcpy(field_next(f, P_F, body, c) + start, b->F[deform_slot[dim - 1][c]], bytes);
    if (m->law->needs & SOLID_HAS_ENERGY) memcpy(field_next(f, P_ENERGY, body, 0) + start, b->energy, bytes);
    for (int k = 0; k < m->law->n_history; ++k)
        memcpy(field_next(f, history_field(k), body, 0) + start, b->history[k], bytes);
    if (fields_has(f, P_VISCOUS_PRESSURE, body))
        memcpy(field_next(f, P_VISCOUS_PRESSURE, body, 0) + start, b->q, bytes);
}

/* Says which point is beyond the law. */
static floe_status beyond_law(const mpm *s, int blk, int body, size_t point, const solid_batch *b, size_t k)
{
    const fields *f = s->domain->fields[blk];
    double x[3] = {0};
    for (int a = 0; a < s->mesh->dim; ++a) x[a] = field_get(f, P_POS, body, a)[point];
    return fail(s->ctx, FLOE_RETRY,
                "at t = %.6g s a point of body '%s' at (%g, %g, %g) is beyond its law %s: J = %g, energy %g J/kg",
                s->time, s->scene->body[s->body[body].scene_body].name, x[0], x[1], x[2], s->body[body].law->name,
                b->J[k], b->energy[k]);
}

/* What a fluid does against the reference pressure as it swells (J): its internal energy pays for the whole of p dV, and its
 * nodes are pushed by p - p_ref alone. */
static double reference_work(const mpm *s, int blk, int body, size_t start, const solid_batch *b)
{
    const double *volume = field_get(s->domain->fields[blk], P_VOLUME0, body, 0) + start;
    double swelling = 0.0;
    for (size_t k = 0; k < b->n; ++k) swelling += volume[k] * (b->J[k] - b->J_old[k]);
    return s->scene->reference_pressure * swelling;
}

/* Rates, deformation gradients and volumes over the step. */
static void advance_shape(const mpm *s, int blk, int body, size_t start, solid_batch *b)
{
    const mpm_body *m = &s->body[body];
    const bool placed =
        m->fluid && !s->cell_mass; /* where cells say the volume, energy takes p div v dt (Y97 eq. 4.10) */
    double growth[SOLID_CHUNK];
    if (placed) find_growth(s, b, growth);
    if (!s->cell_mass || !m->fluid) centre_rates(s, b);
    if (m->mean_strain) take_mean_rates(s, blk, body, start, b, placed ? growth : NULL);
    if (keeps_F(s, body)) advance_F(b);
    if (placed)
        grow_volumes(b, growth);
    else if (!(m->law->needs & SOLID_NEEDS_F))
        advance_J(b);
}

floe_status update_stress(mpm *s, int blk, int body, size_t start, size_t end, solid_batch *b, double gain[MPM_GAINS])
{
    const mpm_body *m = &s->body[body];
    load_batch(s, blk, body, start, end, false, b);
    advance_shape(s, blk, body, start, b);
    if (keeps_box(s, body)) swell_boxes(s, blk, body, start, b);
    scale_to_enclosed_volume(s, body, b);
    if (fields_has(s->domain->fields[blk], P_DENSITY, body)) take_cell_density(s, blk, body, start, b);
    if (fields_has(s->domain->fields[blk], P_VISCOUS_PRESSURE, body)) set_artificial(s, m, b);
    if (m->fluid) gain[GAIN_HEAT] += add_heat_of_work(s, blk, body, start, b);
    const stress_state state = m->fluid ? STRESS_FULL : s->scene->stress_state;
    thermal_batch thermal;
    if (m->warms) begin_thermal_stress(s, blk, body, start, b, &thermal);
    const size_t bad = solid_stress_state(m->law, m->law_par, s->scene->reference_pressure, state, b);
    if (bad) return beyond_law(s, blk, body, start + bad - 1, b, bad - 1);
    if (m->warms) end_thermal_stress(s, blk, body, start, b, &thermal);
    if (m->fluid) gain[GAIN_REFERENCE] -= reference_work(s, blk, body, start, b);
    store_batch(s, blk, body, start, b);
    return FLOE_OK;
}
