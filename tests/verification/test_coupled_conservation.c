/* What coupled runs must keep: mass exactly, momentum with that of the walls to round-off for any strength of the exchange, rest
 * at the reference pressure; and how large the noise is of a solid that moves with the gas about it. */
#include "coupled_fixture.h"

/* What a scene lies in. */
typedef struct space {
    const char *name;
    int dim;
    bool radial; /* about an axis: radial momentum has no account */
} space;

static const space spaces[] = {{"1-D", 1, false}, {"2-D", 2, false}, {"r, z", 2, true}, {"3-D", 3, false}};

static void begin_in(trial *t, const space *in, double h)
{
    coupled_begin(t, in->dim, (const double[]){0.8, 0.7, 0.6}, h);
    if (!in->radial) return;
    t->scene->mesh.geometry = MESH_AXISYMMETRIC;
    set_sides(t, 0, BC_SYMMETRY, BC_SLIP);
}

/* A soft block, off the cells, that flies through the gas of a closed box; about an axis a ring. */
static void block_in_box(trial *t, const space *in, const char *basis, double exchange)
{
    const double lower[3] = {0.23, 0.17, 0.16}, upper[3] = {0.46, 0.43, 0.41};
    begin_in(t, in, in->dim == 3 ? 0.1 : 0.05);
    set_method(t, basis, STRESS_USL, 0.99);
    t->scene->method.exchange = exchange;
    scene_body *b = coupled_body(t, coupled_solid(t, 20e6, 8e6, 1000.0), make_box(t, lower, upper), 2);
    b->velocity[0] = 30.0;
    b->velocity[1] = -20.0;
    b->velocity[2] = 10.0;
    coupled_start(t);
}

static void test_closed_box(void **unused)
{
    (void)unused;
    static const double exchange[] = {0.0, 1e5, 1e20, 1e15};
    for (const space *in = spaces; in < spaces + sizeof spaces / sizeof *spaces; ++in)
        for (size_t i = 0; i < basis_registry_size; ++i)
            for (size_t k = 0; k < sizeof exchange / sizeof *exchange; ++k) {
                trial t;
                if (k % 2 && strcmp(basis_registry[i]->name, "quadratic") != 0)
                    continue; /* one shows what lies between */
                block_in_box(&t, in, basis_registry[i]->name, exchange[k]);
                trial_steps(&t, in->dim == 3 ? 20 : 100);
                const double mass = ledger_worst(&t, LEDGER_MASS, LEDGER_MASS),
                             momentum = ledger_worst(&t, in->radial ? LEDGER_MOMENTUM_Y : LEDGER_MOMENTUM_X,
                                                     (ledger_quantity)(LEDGER_MOMENTUM_X + in->dim - 1)),
                             energy = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
                print_message("%s %-9s K = %-6g drifts: mass %.1e, momentum %.1e, energy %.1e; rejected %ld\n",
                              in->name, basis_registry[i]->name, exchange[k], mass, momentum, energy, t.sim->rejected);
                check_true(mass <= 1e-15);
                check_true(momentum <= 1e-14);
                trial_end(&t);
            }
}

/* A block that compresses the gas ahead of it, in one dimension: what the block loses the gas gains, to an error that falls with the
 * spacing, while volumes are not relaxed. (Relaxed by 0.1 a step, volumes change without work: 0.8e-3, 0.8e-3, 1.1e-3, 1.6e-3 of
 * the energy at h = 0.025 to 0.0031, which is 5 % of the work at the last.) */
static double energy_drift(double h, double relaxation)
{
    trial t;
    coupled_begin(&t, 1, (const double[]){0.8, 0.0, 0.0}, h);
    set_method(&t, "quadratic", STRESS_USL, 0.99);
    t.scene->method.volume_relaxation = relaxation;
    const double lower[3] = {0.23, 0.0, 0.0}, upper[3] = {0.46, 1.0, 1.0};
    coupled_body(&t, coupled_solid(&t, 20e6, 8e6, 1000.0), make_box(&t, lower, upper), 2)->velocity[0] = 30.0;
    coupled_start(&t);
    trial_run(&t, 0.004);
    const double drift = ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY);
    print_message("1-D h %.5f relaxation %.1f: drift of the energy %.2e\n", h, relaxation, drift);
    trial_end(&t);
    return drift;
}

static void test_energy(void **unused)
{
    (void)unused;
    double before = 2e-3;
    for (int fine = 1; fine <= 8; fine *= 2) {
        const double drift = energy_drift(0.05 / fine, 0.0);
        check_true(drift <= 0.75 * before);
        before = drift;
    }
    check_true(before <= 2.5e-4);
    check_true(energy_drift(0.00625, 0.1) <= 1.5e-3);
}

/* Two solids of different stuff, each with a velocity field of its own at the nodes, that close in on each other through the gas. */
static void test_two_solids(void **unused)
{
    (void)unused;
    static const double exchange[] = {1e15, 1e7, 1e20};
    for (size_t i = 0; i < basis_registry_size; ++i)
        for (size_t k = 0; k < sizeof exchange / sizeof *exchange; ++k) {
            trial t;
            if (k > 0 && strcmp(basis_registry[i]->name, "quadratic") != 0) continue;
            block_in_box(&t, &spaces[1], basis_registry[i]->name, exchange[k]);
            sim_destroy(&t.sim);
            const int heavy = coupled_solid(&t, 50e6, 20e6, 3000.0);
            scene_body *b = coupled_body(&t, heavy, make_ball(&t, (const double[]){0.6, 0.27, 0.0}, 0.1), 2);
            b->velocity[0] = -30.0;
            coupled_start(&t);
            assert_int_equal(t.sim->mpm->n_groups, 2);
            trial_steps(&t, 200);
            const double mass = ledger_worst(&t, LEDGER_MASS, LEDGER_MASS),
                         momentum = ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y);
            print_message("two solids, %-9s K = %-6g drifts: mass %.1e, momentum %.1e; rejected %ld\n",
                          basis_registry[i]->name, exchange[k], mass, momentum, t.sim->rejected);
            check_true(mass <= 1e-15);
            check_true(momentum <= 1e-14);
            trial_end(&t);
        }
}

/* Largest deviations of the pressure (of the reference) in cells that hold gas alone and in all, of the gas's velocity (m/s), and of
 * the points' velocity and stress. */
typedef struct noise {
    double open, pressure, gas, solid, stress;
    double velocity[3];
} noise;

static double larger(double a, double b)
{
    return !(b <= a) ? b : a;
}

static void add_point(void *user, const fields *f, int body, size_t k)
{
    noise *n = user;
    for (int a = 0; a < 3 && field_get(f, P_VEL, body, a); ++a)
        n->solid = larger(n->solid, fabs(field_get(f, P_VEL, body, a)[k] - n->velocity[a]));
    for (int c = 0; c < 3; ++c) n->stress = larger(n->stress, fabs(field_get(f, P_STRESS, body, c)[k]));
}

static noise measure(const trial *t, const double velocity[3])
{
    noise n = {.pressure = 0.0};
    if (velocity) memcpy(n.velocity, velocity, sizeof n.velocity);
    visit_points(t, 0, add_point, &n);
    const mesh *m = &t->sim->mesh;
    const int gas = ice_material_of(t->sim->ice, t->scene->ambient_material);
    for (int id = 0; id < m->n_blocks; ++id) {
        const block *b = &m->block[id];
        const fields *f = t->sim->domain->fields[id];
        for (int k = 0; k < b->n[2]; ++k)
            for (int j = 0; j < b->n[1]; ++j)
                for (int i = 0; i < b->n[0]; ++i) {
                    const ptrdiff_t at = mesh_index(b, i, j, k);
                    const double off = fabs(field_get(f, C_PRESSURE, 0, 0)[at] / COUPLED_PRESSURE - 1.0);
                    n.pressure = larger(n.pressure, off);
                    if (field_get(f, C_MIXED, 0, 0)[at] < 2.0) n.open = larger(n.open, off);
                    for (int a = 0; a < m->dim && field_get(f, C_RHO, gas, 0)[at] > 0.0; ++a)
                        n.gas = larger(n.gas, fabs(field_get(f, C_VEL, gas, a)[at] - n.velocity[a]));
                }
    }
    return n;
}

/* A solid at rest in gas at rest at the reference pressure stays so, off the cells as it is. */
static void test_rest(void **unused)
{
    (void)unused;
    for (const space *in = spaces; in->dim < 3; ++in)
        for (size_t i = 0; i < basis_registry_size; ++i) {
            trial t;
            begin_in(&t, in, 0.05);
            set_method(&t, basis_registry[i]->name, STRESS_USL, 0.99);
            coupled_body(&t, coupled_solid(&t, 117e9, 43.8e9, 8900.0),
                         in->dim == 1 ? make_box(&t, (const double[]){0.23, 0.0, 0.0}, (const double[]){0.46, 1.0, 1.0})
                         : in->radial ? make_ball(&t, (const double[]){0.0, 0.36, 0.0}, 0.21)
                                      : make_ball(&t, (const double[]){0.35, 0.36, 0.0}, 0.21),
                         2);
            coupled_start(&t);
            trial_steps(&t, 200);
            const noise n = measure(&t, NULL);
            print_message("%s %-9s at rest: p %.1e, gas %.1e m/s, solid %.1e m/s, stress %.1e Pa\n", in->name,
                          basis_registry[i]->name, n.pressure, n.gas, n.solid, n.stress);
            check_true(n.pressure <= 1e-10);
            check_true(n.gas <= 1e-14 * 347.0);
            check_true(n.solid <= 1e-17 * 347.0);
            trial_end(&t);
        }
}

/* A solid that moves with the gas about it, through the mesh. Points and cells do not carry volume alike, so that this is not exact
 * (theory 5.5): measured without relaxation of volumes 1.4 % of the pressure anywhere, hardly less on finer meshes; with the
 * default of 0.1 a step the same 1.2 % in the gas, but 3 to 5 times the pressure in cells that are mostly solid. */
static noise move_together(const char *basis, double h, double relaxation)
{
    const double velocity[3] = {10.0, 0.0, 0.0};
    trial t;
    coupled_begin(&t, 2, (const double[]){1.0, 0.6, 0.0}, h);
    for (int a = 0; a < 2; ++a) set_sides(&t, a, BC_PERIODIC, BC_PERIODIC);
    set_method(&t, basis, STRESS_USL, 0.99);
    t.scene->method.volume_relaxation = relaxation;
    scene_body *b = coupled_body(&t, coupled_solid(&t, 20e6, 8e6, 1000.0),
                                 make_ball(&t, (const double[]){0.33, 0.31, 0.0}, 0.173), 2);
    memcpy(b->velocity, velocity, sizeof velocity);
    scene_body *gas =
        coupled_body(&t, t.scene->ambient_material,
                     make_box(&t, (const double[]){-1.0, -1.0, -1.0}, (const double[]){2.0, 2.0, 2.0}), 2);
    gas->pressure = COUPLED_PRESSURE;
    memcpy(gas->velocity, velocity, sizeof velocity);
    coupled_start(&t);
    trial_run(&t, 0.4 * h); /* by four cells */
    const noise n = measure(&t, velocity);
    print_message(
        "%-9s h %.3f relaxation %.1f, moving together: p %.1e (gas alone %.1e), gas %.1f m/s, solid %.2f m/s, "
        "stress %.1e Pa\n",
        basis, h, relaxation, n.pressure, n.open, n.gas, n.solid, n.stress);
    check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Y) <=
               4e-12); /* round-off of the stressed solid: 1.1e-12 */
    trial_end(&t);
    return n;
}

static void check_together(const char *basis, double h)
{
    const noise plain = move_together(basis, h, 0.0);
    check_true(plain.pressure <= 0.05);
    check_true(plain.gas <= 5.0 && plain.solid <= 0.08);
    const noise relaxed = move_together(basis, h, 0.1);
    check_true(relaxed.open <= 0.05);
    check_true(relaxed.gas <= 5.0 && relaxed.solid <= 2.0);
}

static void test_moving_together(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < basis_registry_size; ++i) check_together(basis_registry[i]->name, 0.05);
    check_together("linear", 0.025); /* that which has the most, on the coarse mesh */
}

/* What a scene at rest has in its cells after two steps, when all volumes of its mixed cells are `much` too large at the start. */
typedef struct relaxed {
    double defect[3];         /* TMV/V - 1 of three cells at a surface, as the second step finds it */
    double pressure[3], S[3]; /* the advanced pressure of the first, and what compresses */
    double shock[3];
} relaxed;

static relaxed relax(double rate, double much)
{
    static const int cell[3] = {3, 5, 8};
    trial t;
    relaxed out;
    coupled_begin(&t, 1, (const double[]){0.8, 0.0, 0.0}, 0.05);
    set_method(&t, "quadratic", STRESS_USL, 0.99);
    t.scene->method.volume_relaxation = rate;
    const double lower[3] = {0.23, 0.0, 0.0}, upper[3] = {0.46, 1.0, 1.0};
    const int solid = coupled_solid(&t, 20e6, 8e6, 1000.0);
    coupled_body(&t, solid, make_box(&t, lower, upper), 2);
    coupled_start(&t);
    const fields *f = t.sim->ice->domain->fields[0];
    const block *b = &t.sim->mesh.block[0];
    for (int m = 0; m < 2; ++m)
        for (int i = 0; i < b->n[0]; ++i) field_get(f, C_VOL, m, 0)[mesh_index(b, i, 0, 0)] *= 1.0 + much;
    check_ok(t.ctx, sim_step(t.sim, 1e-7));
    for (int k = 0; k < 3; ++k) {
        const ptrdiff_t at = mesh_index(b, cell[k], 0, 0);
        out.pressure[k] = field_get(f, C_PRESSURE_ADVANCED, 0, 0)[at];
        out.S[k] = field_get(f, C_KAPPA_SUM, 0, 0)[at];
        out.shock[k] = field_get(f, C_SHOCK, 0, 0)[at];
    }
    check_ok(t.ctx, sim_step(t.sim, 2e-7));
    for (int k = 0; k < 3; ++k) out.defect[k] = field_get(f, C_TMV_RATIO, 0, 0)[mesh_index(b, cell[k], 0, 0)] - 1.0;
    trial_end(&t);
    return out;
}

/* Of a volume in excess, and of one that is missing, the rate is taken back in a step, and pushes apart or together meanwhile by the
 * pressure that belongs to it: (1 + shock)/2 of rate times (TMV/V - 1) over S. */
static void test_relaxation(void **unused)
{
    (void)unused;
    static const double rate = 0.2, much[] = {1e-4, -1e-4};
    for (int sign = 0; sign < 2; ++sign) {
        const relaxed plain = relax(0.0, much[sign]), with = relax(rate, much[sign]);
        for (int k = 0; k < 3; ++k) {
            const double push = (with.pressure[k] - plain.pressure[k]) * plain.S[k];
            check_close((plain.defect[k] - with.defect[k]) / much[sign], rate, 1e-10);
            check_close(push / much[sign], 0.5 * (1.0 + plain.shock[k]) * rate, 1e-10);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_box), cmocka_unit_test(test_energy),          cmocka_unit_test(test_two_solids),
        cmocka_unit_test(test_rest),       cmocka_unit_test(test_moving_together), cmocka_unit_test(test_relaxation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
