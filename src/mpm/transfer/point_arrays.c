/* Views on the arrays of points. */
#include "mpm/transfer/point_arrays.h"

#include "grid/tile_box.h"
#include "mpm/membrane/enclosed_gas.h"
#include "mpm/nodes/sides.h"
#include "mpm/state/stress.h"

#include <math.h>
#include <string.h>

uint64_t cell_bit(const mesh *m, const tile_box *t, const point_arrays *p, size_t k)
{
    int bit = 0, row = 1;
    for (int a = 0; a < m->dim; ++a) {
        const int cell = mesh_cell_of(m, a, p->x[a][k]) - t->first[a];
        bit += row * (cell < 0 ? 0 : cell >= t->cells[a] ? t->cells[a] - 1 : cell);
        row *= mesh_tile_width(m->dim);
    }
    return UINT64_C(1) << bit;
}

uint64_t shared_cells(const mpm *s, int blk, int tile, const tile_box *t)
{
    bool any[2] = {false, false};
    for (int body = 0; body < s->n_bodies; ++body) {
        const size_t *at = s->points[blk][body].tile_start;
        if (at[tile] < at[tile + 1]) any[s->body[body].fluid] = true;
    }
    uint64_t shared = 0;
    for (int body = 0; any[0] && any[1] && body < s->n_bodies; ++body) {
        if (s->body[body].fluid) continue;
        const size_t *at = s->points[blk][body].tile_start;
        const point_arrays p = points_of(s, blk, body, false, false);
        for (size_t k = at[tile]; k < at[tile + 1]; ++k) shared |= cell_bit(s->mesh, t, &p, k);
    }
    return shared;
}

/* Sides beyond which velocities are extrapolated. */
static void set_sides(const mpm *s, int group, point_arrays *p)
{
    const mesh *m = s->mesh;
    for (int a = 0; a < m->dim; ++a) {
        const bool around = m->periodic[a];
        p->linear_side[a][SIDE_LOWER] =
            around || wall_mirrors(s, group, a, SIDE_LOWER) ? (double)-INFINITY : m->lower[a];
        p->linear_side[a][SIDE_UPPER] =
            around || wall_mirrors(s, group, a, SIDE_UPPER) ? (double)INFINITY : m->upper[a];
    }
}

/* What shapes the domains of points. */
static void set_domains(const mpm *s, const fields *f, int body, point_arrays *p)
{
    p->domain_limit = s->scene->method.domain_limit;
    for (int c = 0; keeps_shape(s, body) && c < field_component_count(FIELD_DEFORM, s->mesh->dim); ++c)
        p->deform[c] = field_get(f, P_F, body, c);
}

point_arrays points_of(const mpm *s, int blk, int body, bool next_stress, bool next_velocity)
{
    const fields *f = s->domain->fields[blk];
    point_arrays p = {0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        p.x[a] = field_get(f, P_POS, body, a);
        p.v[a] = next_velocity ? field_next(f, P_VEL, body, a) : field_get(f, P_VEL, body, a);
        p.half[a] = field_get(f, keeps_box(s, body) ? P_BOX : P_HALF, body, a);
    }
    for (int c = 0; c < field_component_count(FIELD_STRESS, s->mesh->dim); ++c)
        p.stress[c] = next_stress ? field_next(f, P_STRESS, body, c) : field_get(f, P_STRESS, body, c);
    p.all_mass = field_get(f, s->burnt && s->body[body].burns ? P_MASS_LEFT : P_MASS, body, 0);
    p.mass = fields_has(f, P_FREE_MASS, body) ? field_get(f, P_FREE_MASS, body, 0) : p.all_mass;
    p.volume0 = field_get(f, P_VOLUME0, body, 0);
    p.J = next_stress ? field_next(f, P_J, body, 0) : field_get(f, P_J, body, 0);
    p.q = next_stress ? field_next(f, P_VISCOUS_PRESSURE, body, 0) : field_get(f, P_VISCOUS_PRESSURE, body, 0);
    p.centred = s->body[body].fluid && s->basis->smoothness == 0;
    for (int c = 0; s->transfer->carry && c < s->mesh->dim * s->mesh->dim; ++c)
        p.affine[c] = next_velocity ? field_next(f, P_AFFINE, body, c) : field_get(f, P_AFFINE, body, c);
    if (s->basis->fact.shaped) set_domains(s, f, body, &p);
    set_sides(s, s->body[body].group, &p);
    p.enclosed_pressure = is_enclosed_gas(s, body) ? s->enclosure->pressure : 0.0;
    for (int a = 0; s->carries[P_DRIVE] && a < s->mesh->dim; ++a) p.drive[a] = field_get(f, P_DRIVE, body, a);
    p.grid_pressure = field_get(f, fields_has(f, P_MEAN_PRESSURE, body) ? P_MEAN_PRESSURE : P_GRID_PRESSURE, body, 0);
    memcpy(p.acceleration, s->acceleration[body], sizeof p.acceleration);
    return p;
}
