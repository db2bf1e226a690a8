/* The registry of fields, the domain's exchanges, the ledger and the stages. */
#include "check.h"

#include "grid/bc.h"
#include "grid/domain.h"
#include "grid/ledger.h"
#include "grid/stage.h"

#include <math.h>
#include <string.h>

typedef struct ground {
    context *ctx;
    mesh mesh;
    domain *domain;
} ground;

static ground make_ground(int dim, int cells, int blocks, bool periodic)
{
    ground g = {.ctx = context_create()};
    mesh_spec spec = {.dim = dim};
    for (int a = 0; a < dim; ++a) {
        spec.upper[a] = cells;
        spec.cell[a] = 1.0;
        spec.blocks[a] = blocks;
        spec.periodic[a] = periodic;
    }
    check_ok(g.ctx, mesh_init(&g.mesh, g.ctx, &spec));
    return g;
}

/* After the ground has its place: blocks point into the mesh. */
static void open_ground(ground *g)
{
    check_ok(g->ctx, domain_create(&g->domain, g->ctx, &g->mesh));
}

static void close_ground(ground *g)
{
    domain_destroy(&g->domain);
    context_destroy(&g->ctx);
}

static void test_registry(void **state)
{
    (void)state;
    ground g = make_ground(2, 8, 1, false);
    open_ground(&g);
    const fields *f = g.domain->fields[0];
    assert_null(field_get(f, C_RHO, 0, 0));
    check_ok(g.ctx, domain_add(g.domain, C_RHO, 1));
    check_ok(g.ctx, domain_add(g.domain, C_RHO, 1)); /* twice is fine */
    assert_true(fields_has(f, C_RHO, 1) && !fields_has(f, C_RHO, 0));
    assert_false(fields_has(f, C_RHO, -1) || fields_has(f, C_RHO, FIELD_MAX_INSTANCES));
    check_fails(g.ctx, domain_add(g.domain, C_RHO, FIELD_MAX_INSTANCES), FLOE_BAD_INPUT);
    check_ok(g.ctx, domain_add(g.domain, N_VEL, 0));
    assert_non_null(field_get(f, N_VEL, 0, 1));
    assert_null(field_get(f, N_VEL, 0, 2));  /* two dimensions have no third component */
    assert_null(field_next(f, N_VEL, 0, 0)); /* scratch has no next */
    const uint64_t size = g.mesh.block[0].size * sizeof(double);
    assert_int_equal(fields_bytes(f, C_RHO, C_RHO), 2 * size);
    assert_int_equal(fields_bytes(f, N_VEL, N_VEL), 2 * size);
    assert_int_equal(fields_bytes(f, P_ID, P_GRID_PRESSURE), 0);
    for (int id = 0; id < FIELD_COUNT; ++id) {
        const field_info *info = field_describe((field_id)id);
        assert_true(info->name[0] && info->unit[0] && info->meaning[0]);
        for (int dim = 1; dim <= 3; ++dim)
            assert_in_range(field_component_count(info->components, dim), 1, FIELD_MAX_COMPONENTS);
    }
    close_ground(&g);
}

static void test_points(void **state)
{
    (void)state;
    ground g = make_ground(1, 8, 1, false);
    open_ground(&g);
    fields *f = g.domain->fields[0];
    check_ok(g.ctx, domain_add(g.domain, P_ID, 0));
    check_ok(g.ctx, domain_add(g.domain, P_POS, 0));
    for (size_t n = 1; n <= 100; ++n) {
        check_ok(g.ctx, fields_reserve_points(f, 0, n));
        field_get(f, P_ID, 0, 0)[n - 1] = field_get(f, P_POS, 0, 0)[n - 1] = (double)n;
        field_next(f, P_POS, 0, 0)[n - 1] = -(double)n;
    }
    assert_in_range(fields_point_capacity(f, 0), 100, 151);
    fields_commit(f);
    for (int n = 0; n < 100; ++n) check_close(field_get(f, P_POS, 0, 0)[n], -(n + 1.0), 0.0);
    for (int n = 0; n < 100; ++n) check_close(field_get(f, P_ID, 0, 0)[n], n + 1.0, 0.0); /* fixed: not exchanged */
    uint32_t order[50];
    for (int n = 0; n < 50; ++n) order[n] = (uint32_t)(99 - 2 * n);
    fields_permute_points(f, 0, 50, order);
    for (int n = 0; n < 50; ++n) {
        check_close(field_get(f, P_ID, 0, 0)[n], 100.0 - 2 * n, 0.0);
        check_close(field_get(f, P_POS, 0, 0)[n], -(100.0 - 2 * n), 0.0);
    }
    close_ground(&g);
}

static double value_at(const mesh *m, int i, int j)
{
    const int n = m->n[0];
    if (m->periodic[0]) {
        i = (i + n) % n;
        j = (j + n) % n;
    }
    return 1000.0 * i + j;
}

/* Ghosts of every block hold what the neighbour owns, edges and corners included; beyond an open side they are left. */
static void check_fill(bool periodic, int blocks)
{
    ground g = make_ground(2, 24, blocks, periodic);
    open_ground(&g);
    check_ok(g.ctx, domain_add(g.domain, C_RHO, 0));
    for (int b = 0; b < g.mesh.n_blocks; ++b) {
        const block *k = &g.mesh.block[b];
        double *a = field_get(g.domain->fields[b], C_RHO, 0, 0);
        for (size_t n = 0; n < k->size; ++n) a[n] = -7.0;
        for (int j = 0; j < k->n[1]; ++j)
            for (int i = 0; i < k->n[0]; ++i) a[mesh_index(k, i, j, 0)] = value_at(&g.mesh, k->lo[0] + i, k->lo[1] + j);
    }
    domain_fill(g.domain, C_RHO, 0, FILL_CURRENT);
    for (int b = 0; b < g.mesh.n_blocks; ++b) {
        const block *k = &g.mesh.block[b];
        const double *a = field_get(g.domain->fields[b], C_RHO, 0, 0);
        for (int j = -MESH_GHOST; j < k->n[1] + MESH_GHOST; ++j)
            for (int i = -MESH_GHOST; i < k->n[0] + MESH_GHOST; ++i) {
                const int x = k->lo[0] + i, y = k->lo[1] + j;
                const bool beyond = !periodic && (x < 0 || y < 0 || x >= 24 || y >= 24);
                check_close(a[mesh_index(k, i, j, 0)], beyond ? -7.0 : value_at(&g.mesh, x, y), 0.0);
            }
    }
    close_ground(&g);
}

static void test_fill(void **state)
{
    (void)state;
    for (int blocks = 1; blocks <= 3; ++blocks) {
        check_fill(false, blocks);
        check_fill(true, blocks);
    }
}

/* The two images of each node at a periodic end get their sum, and no other node changes. */
static void test_fold(void **state)
{
    (void)state;
    ground g = make_ground(1, 128, 2, true);
    open_ground(&g);
    check_ok(g.ctx, domain_add(g.domain, N_MASS, 0));
    for (int b = 0; b < 2; ++b)
        for (int i = -1; i <= 65; ++i)
            field_get(g.domain->fields[b], N_MASS, 0, 0)[mesh_index(&g.mesh.block[b], i, 0, 0)] = 64.0 * b + i + 1.0;
    domain_fold_periodic(g.domain, N_MASS, 0);
    for (int image = -1; image <= 1; ++image) {
        const double sum = (image + 1.0) + (128 + image + 1.0);
        check_close(field_get(g.domain->fields[0], N_MASS, 0, 0)[mesh_index(&g.mesh.block[0], image, 0, 0)], sum, 0.0);
        check_close(field_get(g.domain->fields[1], N_MASS, 0, 0)[mesh_index(&g.mesh.block[1], 64 + image, 0, 0)], sum,
                    0.0);
    }
    for (int i = 2; i <= 64; ++i)
        check_close(field_get(g.domain->fields[0], N_MASS, 0, 0)[mesh_index(&g.mesh.block[0], i, 0, 0)], i + 1.0, 0.0);
    close_ground(&g);
}

static void test_sides(void **state)
{
    (void)state;
    ground g = make_ground(1, 8, 1, false);
    const block *b = &g.mesh.block[0];
    double a[16];
    for (int i = 0; i < 8; ++i) a[mesh_index(b, i, 0, 0)] = i + 1.0;
    bc_reflect(b, 0, SIDE_LOWER, BC_ODD, a);
    bc_extrapolate(b, 0, SIDE_UPPER, a);
    check_close(a[mesh_index(b, -1, 0, 0)], -1.0, 0.0);
    check_close(a[mesh_index(b, -2, 0, 0)], -2.0, 0.0);
    check_close(a[mesh_index(b, 8, 0, 0)], 8.0, 0.0);
    check_close(a[mesh_index(b, 9, 0, 0)], 8.0, 0.0);
    bc_reflect(b, 0, SIDE_UPPER, BC_EVEN, a);
    check_close(a[mesh_index(b, 9, 0, 0)], 7.0, 0.0);
    bc_constant(b, 0, SIDE_LOWER, 3.5, a);
    check_close(a[mesh_index(b, -2, 0, 0)], 3.5, 0.0);
    close_ground(&g);
}

/* Entries of a rejected step leave no trace; a million small ones beside a large one are not lost. */
static void test_ledger(void **state)
{
    (void)state;
    ledger l;
    memset(&l, 0, sizeof l);
    l.initial[LEDGER_ENERGY] = 1.0;
    l.scale[LEDGER_ENERGY] = 1e10;
    ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, 5.0);
    ledger_tally(&l, COUNT_FLOORS, 3);
    ledger_discard(&l);
    ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, 1e10);
    ledger_tally(&l, COUNT_FLOORS, 1);
    ledger_commit(&l);
    for (int k = 0; k < 1000000; ++k) {
        ledger_add(&l, LEDGER_ENERGY, LEDGER_SOURCE, 1e-7);
        ledger_commit(&l);
    }
    l.total[LEDGER_ENERGY] = 1.0 + 1e10 + 0.1;
    check_true(ledger_drift(&l, LEDGER_ENERGY) <= 1e-15);
    assert_int_equal(l.count[COUNT_FLOORS], 1);
    check_close(ledger_drift(&l, LEDGER_MASS), 0.0, 0.0); /* nothing there: no drift, not a NaN */
    l.total[LEDGER_ENERGY] = (double)NAN;
    check_true(isnan(ledger_drift(&l, LEDGER_ENERGY)));
    for (int q = 0; q < LEDGER_QUANTITIES; ++q) check_true(ledger_quantity_name((ledger_quantity)q)[0] != '\0');
    for (int c = 0; c < LEDGER_COUNTS; ++c) check_true(ledger_count_name((ledger_count)c)[0] != '\0');
}

typedef struct worker {
    stage_list *stages;
    domain *domain;
    bool stray;
    int calls;
} worker;

static floe_status fill_mass(worker *w)
{
    const size_t n = w->domain->mesh->block[0].size;
    for (size_t k = 0; k < n; ++k) field_get(w->domain->fields[0], N_MASS, 0, 0)[k] = 1.0;
    if (w->stray) field_get(w->domain->fields[0], N_PRESSURE, 0, 0)[0] = 4.0;
    w->calls++;
    return FLOE_OK;
}

static floe_status run_worker(worker *w)
{
    STAGE(w, ALWAYS, fill_mass, READS(NOTHING), WRITES(N_MASS));
    STAGE(w, false, fill_mass, READS(N_VEL), WRITES(N_ACCEL));
    return FLOE_OK;
}

/* Planned, a list records and does not run; checked, a stage that writes what it did not say fails by name. */
static void test_stages(void **state)
{
    (void)state;
    ground g = make_ground(1, 8, 1, false);
    open_ground(&g);
    stage_list list;
    stage_list_init(&list, g.ctx);
    worker w = {&list, g.domain, false, 0};
    list.planning = true;
    check_ok(g.ctx, run_worker(&w));
    assert_int_equal(w.calls, 0);
    assert_true(list.uses[N_MASS] && !list.uses[N_ACCEL] && list.n == 1);
    list.planning = false;
    list.domain = g.domain;
    list.checking = true;
    check_ok(g.ctx, domain_add(g.domain, N_MASS, 0));
    check_ok(g.ctx, domain_add(g.domain, N_PRESSURE, 0));
    check_ok(g.ctx, run_worker(&w));
    assert_int_equal(list.record[0].calls, 1);
    w.stray = true;
    const floe_status status = run_worker(&w);
    assert_int_equal(status, FLOE_INTERNAL);
    assert_non_null(strstr(context_message(g.ctx), "node_pressure"));
    stage_list_destroy(&list);
    close_ground(&g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_registry), cmocka_unit_test(test_points), cmocka_unit_test(test_fill),
        cmocka_unit_test(test_fold),     cmocka_unit_test(test_sides),  cmocka_unit_test(test_ledger),
        cmocka_unit_test(test_stages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
