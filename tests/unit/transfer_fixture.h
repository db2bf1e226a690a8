/* Fields of nodes and cells that the transfers between them work on, without a simulation. */
#ifndef TESTS_UNIT_TRANSFER_FIXTURE_H
#define TESTS_UNIT_TRANSFER_FIXTURE_H

#include "check.h"

#include "coupling/node_cell_transfer.h"

#include <math.h>
#include <string.h>

/* Not every test uses all of it. */
#define FIXTURE __attribute__((unused)) static

enum { SOLIDS = 2 };

typedef struct rig {
    context *ctx;
    mesh mesh;
    domain *domain;
    stage_list stages;
    transfer t;
} rig;

typedef struct rig_case {
    int dim, blocks;
    unsigned periodic; /* a bit an axis */
    mesh_geometry geometry;
} rig_case;

FIXTURE void rig_make(rig *r, const rig_case *c)
{
    static const int cells[3][3] = {{150}, {19, 22}, {10, 9, 11}};
    static const double h[3] = {0.1, 0.2, 0.05};
    memset(r, 0, sizeof *r);
    r->ctx = context_create();
    mesh_spec spec = {.dim = c->dim, .geometry = c->geometry};
    for (int a = 0; a < c->dim; ++a) {
        spec.upper[a] = cells[c->dim - 1][a] * h[a];
        spec.cell[a] = h[a];
        spec.blocks[a] = c->blocks;
        spec.periodic[a] = (c->periodic >> a & 1u) != 0;
    }
    check_ok(r->ctx, mesh_init(&r->mesh, r->ctx, &spec));
    check_ok(r->ctx, domain_create(&r->domain, r->ctx, &r->mesh));
    static const field_id own[] = {N_MASS,         N_MOMENTUM, N_VEL_L,          C_RHO,
                                   C_VEL,          C_TEMP,     C_MOMENTUM_L,     C_VELOCITY_CHANGE,
                                   C_STRESS_ACCEL, C_REACTED,  C_BURNT_MOMENTUM, C_BURNT_ENERGY,
                                   C_TEMP_CHANGE,  N_BURNT,    N_BURNT_MOMENTUM, N_BURNT_ENERGY,
                                   N_BURNT_SHARE,  N_HEAT,     N_CAPACITY,       N_TEMP_CHANGE};
    for (size_t k = 0; k < sizeof own / sizeof *own; ++k)
        for (int i = 0; i < SOLIDS; ++i) check_ok(r->ctx, domain_add(r->domain, own[k], i));
    check_ok(r->ctx, domain_add(r->domain, C_PRESSURE_ADVANCED, 0));
    check_ok(r->ctx, domain_add(r->domain, N_PRESSURE, 0));
    stage_list_init(&r->stages, r->ctx);
    r->t = (transfer){.ctx = r->ctx, .mesh = &r->mesh, .domain = r->domain, .stages = &r->stages, .n_pairs = SOLIDS};
    for (int i = 0; i < SOLIDS; ++i)
        r->t.pair[i] =
            (transfer_pair){.group = i, .material = SOLIDS - 1 - i, .temperature = 300.0 + i, .reaction = -1};
    r->t.reference_pressure = 1e5;
}

FIXTURE void rig_free(rig *r)
{
    domain_destroy(&r->domain);
    stage_list_destroy(&r->stages);
    context_destroy(&r->ctx);
}

/* A number in [-1, 1) of a global cell or node alone; the two ends of a periodic axis are one. */
FIXTURE double noise(const mesh *m, const int at[3], int which)
{
    uint64_t seed = (uint64_t)which;
    for (int a = 0; a < 3; ++a) {
        const int n = m->n[a], i = a < m->dim && m->periodic[a] ? (at[a] % n + n) % n : at[a];
        seed = seed * 1000003u + (uint64_t)(i + 10);
    }
    return check_random(&seed, -1.0, 1.0);
}

/* Visits the owned cells of a block (extra 0), or its owned nodes and one layer about them (extra 1, all images). */
typedef void visitor(void *user, const rig *r, const fields *f, const block *b, const int global[3], ptrdiff_t at);

FIXTURE void visit(const rig *r, bool nodes, visitor *call, void *user)
{
    for (int id = 0; id < r->mesh.n_blocks; ++id) {
        const block *b = &r->mesh.block[id];
        int hi[3] = {1, 1, 1}, lo[3] = {0, 0, 0};
        for (int a = 0; a < r->mesh.dim; ++a) {
            hi[a] = nodes ? b->n[a] + 2 : b->n[a];
            lo[a] = nodes ? -1 : 0;
        }
        for (int k = lo[2]; k < hi[2]; ++k)
            for (int j = lo[1]; j < hi[1]; ++j)
                for (int i = lo[0]; i < hi[0]; ++i)
                    call(user, r, r->domain->fields[id], b, (const int[]){b->lo[0] + i, b->lo[1] + j, b->lo[2] + k},
                         mesh_index(b, i, j, k));
    }
}

/* A node counts once: for the block whose cell it begins, and at the domain's upper side for the last. */
FIXTURE bool counts(const rig *r, const block *b, const int node[3])
{
    for (int a = 0; a < r->mesh.dim; ++a) {
        const int end = b->lo[a] + b->n[a];
        const bool last = end == r->mesh.n[a] && !r->mesh.periodic[a];
        if (node[a] < b->lo[a] || node[a] > (last ? end : end - 1)) return false;
    }
    return true;
}

FIXTURE bool in_domain(const rig *r, const int node[3])
{
    for (int a = 0; a < r->mesh.dim; ++a)
        if (!r->mesh.periodic[a] && (node[a] < 0 || node[a] > r->mesh.n[a])) return false;
    return true;
}

#endif
