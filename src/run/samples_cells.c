/* Cells as samples. */
#include "base/memory.h"
#include "run/samples.h"

#include <math.h>

static floe_status gather_cell_values(cell_samples *c, field_id id, int instance, int comp, double **out)
{
    TRY(memory_new(c->s->ctx, out, c->n, sizeof **out));
    gather_cells(c->s, id, instance, comp, 1, *out);
    return FLOE_OK;
}

/* Where a material is alone, its pressure now is its law's; the field holds the one in equilibrium at the start of the
 * last step. */
static void set_own_pressure(cell_samples *c, const cell_samples *part)
{
    const eos *law = &c->s->ice->material[part->material].eos;
    for (size_t i = 0; i < c->n; i++) {
        double p, c2;
        if (!(part->rho[i] > 0.0) || part->rho[i] < c->rho[i]) continue;
        law->model->pressure(law->par, 1, &part->rho[i], &part->energy[i], &p, &c2);
        c->pressure[i] = p;
    }
}

/* Volume fraction: mass per cell volume times the volume of a mass, or what a membrane leaves. */
static double cell_fraction(const cell_samples *c, size_t i)
{
    if (c->fraction) return c->fraction[i];
    if (c->open) return c->open[i];
    return c->volume ? c->rho[i] * c->volume[i] : 1.0;
}

static void add_part(cell_samples *c, const cell_samples *part)
{
    for (size_t i = 0; i < c->n; i++) {
        const double rho = part->rho[i];
        if (!(rho > 0.0)) continue;
        c->rho[i] += rho;
        c->energy[i] += rho * part->energy[i];
        for (int a = 0; a < c->s->mesh.dim; a++) c->v[a][i] += rho * part->v[a][i];
        if (part->material == 0) c->fraction[i] = cell_fraction(part, i);
    }
}

static floe_status new_sums(cell_samples *c)
{
    context *ctx = c->s->ctx;
    TRY(memory_new(ctx, &c->rho, c->n, sizeof *c->rho));
    TRY(memory_new(ctx, &c->energy, c->n, sizeof *c->energy));
    TRY(memory_new(ctx, &c->fraction, c->n, sizeof *c->fraction));
    for (int a = 0; a < c->s->mesh.dim; a++) TRY(memory_new(ctx, &c->v[a], c->n, sizeof *c->v[a]));
    return gather_cell_values(c, C_PRESSURE, 0, 0, &c->pressure);
}

static floe_status take_all(cell_samples *c)
{
    const int n = c->s->ice->n_materials;
    TRY(new_sums(c));
    for (int pass = 0; pass < 2; pass++)
        for (int r = 0; r < n; r++) {
            cell_samples part;
            TRY(cell_samples_take(&part, c->s, c->solution, r));
            if (pass == 0)
                add_part(c, &part);
            else
                set_own_pressure(c, &part);
            cell_samples_free(&part);
        }
    for (size_t i = 0; i < c->n; i++) {
        c->energy[i] /= c->rho[i];
        for (int a = 0; a < c->s->mesh.dim; a++) c->v[a][i] /= c->rho[i];
    }
    return FLOE_OK;
}

static floe_status take_cell_samples(cell_samples *c)
{
    if (c->material == CELLS_OF_ALL) return take_all(c);
    const fields *f = c->s->domain->fields[0];
    TRY(gather_cell_values(c, C_RHO, c->material, 0, &c->rho));
    if (fields_has(f, C_ENERGY, c->material)) TRY(gather_cell_values(c, C_ENERGY, c->material, 0, &c->energy));
    if (fields_has(f, C_VOL, c->material)) TRY(gather_cell_values(c, C_VOL, c->material, 0, &c->volume));
    if (fields_has(f, C_OPEN, c->material)) TRY(gather_cell_values(c, C_OPEN, c->material, 0, &c->open));
    if (fields_has(f, C_PRESSURE, 0)) TRY(gather_cell_values(c, C_PRESSURE, 0, 0, &c->pressure));
    for (int a = 0; a < c->s->mesh.dim; a++) TRY(gather_cell_values(c, C_VEL, c->material, a, &c->v[a]));
    return FLOE_OK;
}

floe_status cell_samples_take(cell_samples *c, const sim *s, const exact *solution, int material)
{
    *c = (cell_samples){.s = s, .solution = solution, .material = material, .n = mesh_cells(&s->mesh)};
    const floe_status status = take_cell_samples(c);
    if (status != FLOE_OK) cell_samples_free(c);
    return status;
}

void cell_samples_free(cell_samples *c)
{
    context *ctx = c->s->ctx;
    memory_free(ctx, &c->rho);
    memory_free(ctx, &c->energy);
    memory_free(ctx, &c->pressure);
    memory_free(ctx, &c->volume);
    memory_free(ctx, &c->fraction);
    memory_free(ctx, &c->open);
    for (int a = 0; a < 3; a++) memory_free(ctx, &c->v[a]);
}

/* Cells in the order z, y, x, the last fastest. */
static void index_of(const mesh *m, size_t i, int cell[3])
{
    cell[0] = (int)(i % (size_t)m->n[0]);
    cell[1] = (int)(i / (size_t)m->n[0] % (size_t)m->n[1]);
    cell[2] = (int)(i / (size_t)m->n[0] / (size_t)m->n[1]);
}

/* The corners of a cell; 0 along axes that the mesh does not have. */
static void corners_of(const mesh *m, size_t i, double lo[3], double hi[3])
{
    int cell[3];
    index_of(m, i, cell);
    for (int a = 0; a < 3; a++) {
        lo[a] = a < m->dim ? mesh_node(m, a, cell[a]) : 0.0;
        hi[a] = a < m->dim ? mesh_node(m, a, cell[a] + 1) : 0.0;
    }
}

static double density_at(const cell_samples *c, size_t i)
{
    return c->volume ? 1.0 / c->volume[i] : c->rho[i];
}

static double cell_temperature_at(const cell_samples *c, size_t i)
{
    if (c->material == CELLS_OF_ALL) return (double)NAN; /* each material has its own */
    const eos *law = &c->s->ice->material[c->material].eos;
    const double rho = density_at(c, i);
    double T = NAN;
    if (c->energy) law->model->temperature(law->par, 1, &rho, &c->energy[i], &T);
    return T;
}

/* The field holds the pressure in equilibrium at the start of the last step; one fluid alone tells its own at the
 * end. */
static double cell_pressure_at(const cell_samples *c, size_t i)
{
    if (c->volume || c->fraction || !c->energy) return c->pressure ? c->pressure[i] : (double)NAN;
    const eos *law = &c->s->ice->material[c->material].eos;
    double p, c2;
    law->model->pressure(law->par, 1, &c->rho[i], &c->energy[i], &p, &c2);
    return p;
}

double cell_value(const cell_samples *c, exact_quantity quantity, size_t i)
{
    if (quantity >= EXACT_VELOCITY_X && quantity <= EXACT_VELOCITY_Z) {
        const int a = (int)(quantity - EXACT_VELOCITY_X);
        return a < c->s->mesh.dim ? c->v[a][i] : 0.0;
    }
    switch (quantity) {
    case EXACT_DENSITY: return density_at(c, i);
    case EXACT_PRESSURE: return cell_pressure_at(c, i);
    case EXACT_INTERNAL_ENERGY: return c->energy ? c->energy[i] : (double)NAN;
    case EXACT_TEMPERATURE: return cell_temperature_at(c, i);
    case EXACT_VOLUME_FRACTION: return cell_fraction(c, i);
    default: return NAN;
    }
}

static bool is_per_mass(exact_quantity quantity)
{
    return quantity == EXACT_INTERNAL_ENERGY || (quantity >= EXACT_VELOCITY_X && quantity <= EXACT_VELOCITY_Z);
}

double cell_exact(const cell_samples *c, exact_quantity quantity, size_t i)
{
    const mesh *m = &c->s->mesh;
    int flags = EXACT_PLAIN;
    double lo[3], hi[3];
    corners_of(m, i, lo, hi);
    if (m->geometry == MESH_AXISYMMETRIC) flags |= EXACT_RADIAL;
    if (is_per_mass(quantity) && exact_provides(c->solution, EXACT_DENSITY)) flags |= EXACT_MASS_WEIGHTED;
    return exact_cell_average(c->solution, quantity, lo, hi, c->s->time, flags);
}

double cell_weight(const cell_samples *c, size_t i)
{
    int cell[3];
    index_of(&c->s->mesh, i, cell);
    return (c->fraction ? 1.0 : cell_fraction(c, i)) * mesh_cell_volume(&c->s->mesh, cell[0]);
}

bool cell_inside(const cell_samples *c, const shape *region, size_t i)
{
    const mesh *m = &c->s->mesh;
    double lo[3], hi[3], x[3];
    if (!region->model) return true;
    corners_of(m, i, lo, hi);
    for (int a = 0; a < 3; a++) x[a] = 0.5 * (lo[a] + hi[a]);
    return shape_inside(region, m->dim, x);
}
