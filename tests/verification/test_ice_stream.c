/* What must hold to round-off (theory 2.12): free streams of one and of several materials, closed boxes, blocks and threads. */
#include "ice_fixture.h"

#ifdef _OPENMP
#include <omp.h>
#endif

/* A number in [0, 1) that depends on a global cell alone. */
static double noise(const int *cell, int which)
{
    unsigned long long x = (unsigned long long)(cell[0] + 1000 * cell[1] + 1000000 * cell[2]) * 0x9E3779B97F4A7C15ull +
                           (unsigned long long)which;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

/* Sets every owned cell: fractions from noise (some cells pure), one pressure, one velocity, own temperatures. */
static void set_mixture(fixture *f, double p, const double *T, const double *velocity)
{
    const int n = f->ice->n_materials;
    for (int id = 0; id < f->mesh.n_blocks; ++id) {
        const block *b = &f->mesh.block[id];
        const fields *q = f->domain->fields[id];
        for (int k = 0; k < b->n[2]; ++k)
            for (int j = 0; j < b->n[1]; ++j)
                for (int i = 0; i < b->n[0]; ++i) {
                    const int cell[3] = {b->lo[0] + i, b->lo[1] + j, b->lo[2] + k};
                    const ptrdiff_t at = mesh_index(b, i, j, k);
                    double theta[8], sum = 0.0;
                    for (int r = 0; r < n; ++r) {
                        theta[r] = fmax(0.0, noise(cell, r) - 0.3);
                        sum += theta[r];
                    }
                    if (!(sum > 0.0)) sum = theta[0] = 1.0;
                    field_get(q, C_PRESSURE, 0, 0)[at] = p;
                    for (int r = 0; r < n; ++r) {
                        const eos *law = &f->ice->material[r].eos;
                        double v, dvdp, rho, e;
                        law->model->volume(law->par, 1, &p, &T[r], &v, &dvdp);
                        rho = 1.0 / v;
                        law->model->energy(law->par, 1, &rho, &T[r], &e);
                        field_get(q, C_RHO, r, 0)[at] = theta[r] / sum * rho;
                        field_get(q, C_ENERGY, r, 0)[at] = e;
                        if (n > 1) field_get(q, C_VOL, r, 0)[at] = v;
                        for (int a = 0; a < f->mesh.dim; ++a) field_get(q, C_VEL, r, a)[at] = velocity[a];
                    }
                }
    }
}

/* Largest deviation of the velocities from `velocity`, over the sound speed, and of the last pressures from p, relative. */
static void deviation(const fixture *f, const double *velocity, double p, double c, double *du, double *dp)
{
    *du = *dp = 0.0;
    for (int id = 0; id < f->mesh.n_blocks; ++id) {
        const block *b = &f->mesh.block[id];
        const fields *q = f->domain->fields[id];
        for (int k = 0; k < b->n[2]; ++k)
            for (int j = 0; j < b->n[1]; ++j)
                for (int i = 0; i < b->n[0]; ++i) {
                    const ptrdiff_t at = mesh_index(b, i, j, k);
                    const double rel = fabs(field_get(q, C_PRESSURE, 0, 0)[at] / p - 1.0);
                    *dp = !(rel <= *dp) ? rel : *dp;
                    for (int r = 0; r < f->ice->n_materials; ++r)
                        for (int a = 0; a < f->mesh.dim && field_get(q, C_RHO, r, 0)[at] > 0.0; ++a) {
                            const double off = fabs(field_get(q, C_VEL, r, a)[at] - velocity[a]) / c;
                            *du = !(off <= *du) ? off : *du;
                        }
                }
    }
}

static void steps(fixture *f, int n)
{
    for (int k = 0; k < n; ++k) {
        step_limit limit;
        check_ok(f->ctx, ice_time_step(f->ice, &limit));
        check_ok(f->ctx, fixture_try(f, limit.dt));
    }
    fixture_account(f, &f->ledger);
}

static void make_gas(fixture *f, int dim, bool periodic)
{
    const int cells[3][3] = {{64}, {32, 24}, {12, 10, 14}};
    fixture_create(f, dim, cells[dim - 1], (const double[]){1.0, 0.75, 1.1}, periodic);
    const int gas = fixture_fluid(f, "ideal", 1.4, 717.5, 0.0);
    fixture_fill(f, gas, 1e5, 300.0, (double)NAN);
}

static void one_fluid_stream(void **state)
{
    (void)state;
    const double velocity[3] = {120.0, -45.0, 80.0};
    for (int dim = 1; dim <= 3; ++dim) {
        fixture f;
        make_gas(&f, dim, true);
        memcpy(f.scene->body[0].velocity, velocity, sizeof velocity);
        fixture_start(&f);
        steps(&f, 50);
        double du, dp;
        deviation(&f, velocity, 1e5, 347.0, &du, &dp);
        printf("free stream, one gas, %d-D: du/c %.1e, dp/p %.1e\n", dim, du, dp);
        check_true(du <= 1e-13);
        check_true(dp <= 1e-13);
        fixture_destroy(&f);
    }
}

/* Uniform p, u and T stay so whatever the fractions do. Newton closes volumes to 1e-13, which is 1e-13 K/p in pressure. */
static void several_fluids_stream(void **state)
{
    (void)state;
    const double velocity[3] = {12.0, -4.5, 8.0}, T[3] = {300.0, 300.0, 300.0};
    for (int dim = 1; dim <= 3; ++dim)
        for (int materials = 2; materials <= 3; ++materials) {
            fixture f;
            make_gas(&f, dim, true);
            fixture_fluid(&f, "ideal", 1.67, 312.0, 0.0);
            fixture_fill(&f, 1, 1e5, 300.0, (double)NAN);
            if (materials == 3) {
                fixture_fluid(&f, "ideal", 1.3, 1500.0, 0.0);
                fixture_fill(&f, 2, 1e5, 300.0, (double)NAN);
            }
            f.scene->method.exchange = materials == 2 ? 0.0 : 1e15;
            fixture_start(&f);
            set_mixture(&f, 1e5, T, velocity);
            steps(&f, 30);
            double du, dp;
            deviation(&f, velocity, 1e5, 347.0, &du, &dp);
            printf("free stream, %d gases, %d-D: du/c %.1e, dp/p %.1e\n", materials, dim, du, dp);
            check_true(du <= 1e-11);
            check_true(dp <= 1e-11);
            fixture_destroy(&f);
        }
}

static void axisymmetric_rest(void **state)
{
    (void)state;
    fixture f;
    make_gas(&f, 2, false);
    f.scene->mesh.geometry = MESH_AXISYMMETRIC;
    f.scene->mesh.periodic[1] = true;
    f.scene->bc.side[1][0].kind = f.scene->bc.side[1][1].kind = BC_PERIODIC;
    const double velocity[3] = {0.0, 75.0, 0.0};
    memcpy(f.scene->body[0].velocity, velocity, sizeof velocity);
    fixture_start(&f);
    steps(&f, 50);
    double du, dp;
    deviation(&f, velocity, 1e5, 347.0, &du, &dp);
    printf("free stream along the axis: du/c %.1e, dp/p %.1e\n", du, dp);
    check_true(du <= 1e-13);
    check_true(dp <= 1e-13);
    check_true(ledger_drift(&f.ledger, LEDGER_MASS) <= 1e-13);
    fixture_destroy(&f);
}

/* A hot corner in a closed box: mass, momentum (with the walls' push) and energy to round-off, one gas and two. */
static void closed_box(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; ++dim)
        for (int two = 0; two < 2; ++two) {
            fixture f;
            make_gas(&f, dim, false);
            f.scene->n_bodies = 0;
            const int other = two ? fixture_fluid(&f, "ideal", 1.67, 312.0, 0.0) : 0;
            fixture_box(&f, other, (const double[]){-1.0, -1.0, -1.0}, (const double[]){0.42, 0.33, 0.51}, 5e5, 600.0,
                        (double)NAN);
            fixture_fill(&f, 0, 1e5, 300.0, (double)NAN);
            f.scene->method.exchange = 1e15;
            fixture_start(&f);
            f.stages.checking = true; /* poison, and no stage touches what it does not say */
            steps(&f, 60);
            printf("closed box, %d-D, %d material(s): drifts", dim, two + 1);
            for (int q = 0; q < LEDGER_QUANTITIES; ++q) {
                if (q == LEDGER_ENERGY || q == LEDGER_MASS || q - LEDGER_MOMENTUM_X < dim) {
                    const double drift = ledger_drift(&f.ledger, (ledger_quantity)q);
                    printf(" %s %.1e", ledger_quantity_name((ledger_quantity)q), drift);
                    check_true(drift <= 1e-12);
                }
            }
            printf(" guards %lld newton %lld/%lld\n", f.ledger.count[COUNT_ENERGY_GUARDS],
                   f.ledger.count[COUNT_NEWTON_ITERATIONS], f.ledger.count[COUNT_NEWTON_CELLS]);
            fixture_destroy(&f);
        }
}

static void copy_state(const fixture *f, double *out)
{
    for (int id = 0; id < f->mesh.n_blocks; ++id) {
        const block *b = &f->mesh.block[id];
        for (int r = 0; r < f->ice->n_materials; ++r)
            for (int what = 0; what < 2 + f->mesh.dim; ++what)
                for (int k = 0; k < b->n[2]; ++k)
                    for (int j = 0; j < b->n[1]; ++j)
                        for (int i = 0; i < b->n[0]; ++i) {
                            const field_id fid = what == 0 ? C_RHO : what == 1 ? C_ENERGY : C_VEL;
                            const double *a = field_get(f->domain->fields[id], fid, r, what < 2 ? 0 : what - 2);
                            const size_t cell = (size_t)(b->lo[0] + i) +
                                                (size_t)f->mesh.n[0] * ((size_t)(b->lo[1] + j) +
                                                                        (size_t)f->mesh.n[1] * (size_t)(b->lo[2] + k));
                            out[((size_t)r * 5 + (size_t)what) * mesh_cells(&f->mesh) + cell] =
                                a[mesh_index(b, i, j, k)];
                        }
    }
}

/* 1 and 2 threads, 1 and 2x2 blocks, under gravity: the same bits in every cell and in the ledger. */
static void same_bits(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; ++dim)
        for (int two = 0; two < 2; ++two) {
            double *reference = NULL;
            ledger first = {0};
            for (int variant = 0; variant < 4; ++variant) {
                fixture f;
                make_gas(&f, dim, false);
                f.scene->mesh.periodic[0] = true;
                f.scene->bc.side[0][0].kind = f.scene->bc.side[0][1].kind = BC_PERIODIC;
                f.scene->n_bodies = 0;
                const int other = two ? fixture_fluid(&f, "ideal", 1.67, 312.0, 0.0) : 0;
                fixture_box(&f, other, (const double[]){-1.0, -1.0, -1.0}, (const double[]){0.42, 0.33, 0.51}, 5e5,
                            600.0, (double)NAN);
                fixture_fill(&f, 0, 1e5, 300.0, (double)NAN)->velocity[0] = 80.0;
                f.scene->method.exchange = 1e3;
                fixture_gravity(&f, dim - 1);
                for (int a = 0; a < 2; ++a) f.scene->mesh.blocks[a] = variant >= 2 ? 2 : 1;
#ifdef _OPENMP
                omp_set_num_threads(variant % 2 ? 2 : 1);
#endif
                fixture_start(&f);
                steps(&f, 20);
                const size_t size = mesh_cells(&f.mesh) * 10;
                double *now = calloc(size, sizeof *now);
                copy_state(&f, now);
                if (!reference) {
                    reference = now;
                    first = f.ledger;
                } else {
                    check_true(memcmp(reference, now, size * sizeof *now) == 0);
                    check_true(memcmp(first.total, f.ledger.total, sizeof first.total) == 0);
                    check_true(memcmp(first.entry, f.ledger.entry, sizeof first.entry) == 0);
                    free(now);
                }
                fixture_destroy(&f);
            }
            free(reference);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_fluid_stream),  cmocka_unit_test(several_fluids_stream),
        cmocka_unit_test(axisymmetric_rest), cmocka_unit_test(closed_box),
        cmocka_unit_test(same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
