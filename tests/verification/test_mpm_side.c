/* Sides of the domain as solids meet them: slip lets go, a mirror does not. Free flight, gliding and falling bodies have exact
 * motions; two bodies that meet head-on are each other's wall. */
#include "mpm_fixture.h"

static const double bulk = 1000.0, shear = 500.0, gap = 0.05, h = 0.1;

typedef struct setting {
    int dim;
    bool axisymmetric;
    bool upper; /* the side at the upper end */
} setting;

static int axis_of(setting g)
{
    return g.axisymmetric ? 1 : g.dim - 1;
}

/* A block `away` from a side of the last axis, with a velocity out of the side. */
static scene_body *make_block(trial *t, setting g, bc_kind kind, double away, double outward)
{
    const double size[3] = {1.0, 1.0, 1.0};
    double lo[3] = {0.3, 0.3, 0.3}, hi[3] = {0.7, 0.7, 0.7};
    const int axis = axis_of(g);
    trial_begin(t, g.dim, size, h);
    if (g.axisymmetric) {
        t->scene->mesh.geometry = MESH_AXISYMMETRIC;
        set_sides(t, 0, BC_SYMMETRY, BC_FREE);
        lo[0] = 0.0;
    }
    set_sides(t, axis, g.upper ? BC_FREE : kind, g.upper ? kind : BC_FREE);
    lo[axis] = g.upper ? 0.6 - away : away;
    hi[axis] = lo[axis] + 0.4;
    scene_body *b = add_body(t, add_solid(t, "neo_hookean", bulk, shear, 1.0), make_box(t, lo, hi), 2);
    b->velocity[axis] = g.upper ? -outward : outward;
    return b;
}

static const setting settings[] = {{1, false, false}, {2, false, true}, {2, true, false}, {3, false, false}};

/* Thrown off a side that lets go, a block flies on as it was thrown, to round-off; a mirror holds it. */
static void test_thrown(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof settings / sizeof *settings; ++k)
        for (size_t i = 0; i < basis_registry_size; ++i)
            for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme) {
                if ((k + i + (size_t)scheme) % 3) continue; /* a Latin square */
                trial t;
                make_block(&t, settings[k], BC_SLIP, 0.0, 1.0);
                set_method(&t, basis_registry[i]->name, (stress_scheme)scheme, 0.99);
                trial_start(&t);
                const double energy = sum_body_points(&t, 0, NULL).kinetic;
                trial_run(&t, 0.3);
                const body_sums end = sum_body_points(&t, 0, NULL);
                const double way =
                    settings[k].upper ? 1.0 - end.place[axis_of(settings[k])] : end.place[axis_of(settings[k])];
                check_close(way, 0.2 + t.sim->time, 2e-12);
                check_close(end.kinetic, energy, 1e-9 * energy);
                trial_end(&t);
            }
    trial t;
    make_block(&t, settings[1], BC_SYMMETRY, 0.0, 1.0);
    trial_start(&t);
    trial_run(&t, 0.3);
    check_true(1.0 - sum_body_points(&t, 0, NULL).place[1] < 0.25); /* it hangs on its image */
    trial_end(&t);
}

/* Along a slip side nothing is lost. */
static void test_glides(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        trial t;
        scene_body *b = make_block(&t, settings[1], BC_SLIP, 0.0, 0.0);
        b->velocity[0] = 0.5;
        set_method(&t, basis_registry[i]->name, STRESS_USL, 0.99);
        trial_start(&t);
        const double energy = sum_body_points(&t, 0, NULL).kinetic;
        trial_run(&t, 0.4);
        check_close(sum_body_points(&t, 0, NULL).place[0], 0.5 + 0.5 * t.sim->time, 2e-12);
        check_close(sum_body_points(&t, 0, NULL).kinetic, energy, 1e-9 * energy);
        trial_end(&t);
    }
}

/* The same block above y = 1 in place of the side, and a second that comes the other way. */
static void make_twins(trial *t)
{
    const double size[3] = {1.0, 2.0, 1.0};
    trial_begin(t, 2, size, h);
    const int rubber = add_solid(t, "neo_hookean", bulk, shear, 1.0);
    for (int k = 0; k < 2; ++k) {
        const double lo[3] = {0.3, k ? 0.6 - gap : 1.0 + gap, 0.3}, hi[3] = {0.7, lo[1] + 0.4, 0.7};
        scene_body *b = add_body(t, rubber, make_box(t, lo, hi), 2);
        b->velocity[1] = k ? 1.0 : -1.0;
    }
    t->scene->contact.enabled = true;
    t->scene->contact.kind = CONTACT_FRICTION;
}

/* A block that is half a cell away flies on until it arrives, and leaves with its speed but for what is left as vibration; as fast as one
 * that its twin meets, at least (contact stops the nodes that touch). */
static void test_arrives(void **state)
{
    (void)state;
    static const char *const basis[] = {"linear", "quadratic", "gimp"};
    for (size_t i = 0; i < sizeof basis / sizeof *basis; ++i) {
        body_sums end[2];
        double start = 0.0;
        for (int twin = 0; twin < 2; ++twin) {
            trial t;
            if (twin)
                make_twins(&t);
            else
                make_block(&t, (setting){2, false, false}, BC_SLIP, gap, -1.0);
            set_method(&t, basis[i], STRESS_MUSL, 1.0);
            t.scene->time.fixed_step = 4e-4;
            trial_start(&t);
            start = sum_body_points(&t, 0, NULL).kinetic;
            trial_run(&t, 0.8 * gap);
            check_close(sum_body_points(&t, 0, NULL).kinetic, start, 1e-9 * start);
            trial_run(&t, 0.2);
            end[twin] = sum_body_points(&t, 0, NULL);
            if (!twin) check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_Y) <= 1e-13);
            trial_end(&t);
        }
        print_message("%s: velocity after the side %.4f, after its twin %.4f\n", basis[i],
                      end[0].momentum[1] / end[0].mass, end[1].momentum[1] / end[1].mass);
        check_true(end[0].momentum[1] > 0.9 * end[0].mass);
        check_true(end[0].momentum[1] > 0.98 * end[1].momentum[1]);
    }
}

/* A bar that meets a side leaves with the speed with which it came, pressed for 2 L/c in between, and with its energy: bars of 16 cells,
 * on and off the lattice of points. Where nodes at the side are stopped at once 0.93 of the energy is left and 0.93 of the speed. */
static void test_bar(void **state)
{
    (void)state;
    static const char *const basis[] = {"quadratic", "cubic"};
    const double speed = 0.01, cell = 0.025;
    for (size_t i = 0; i < 2 * sizeof basis / sizeof *basis; ++i) {
        trial t;
        double most = 0.0, energy = 0.0, pressed = 0.0, before = -1.0, spin[3], size[3];
        mpm_totals sum;
        trial_begin(&t, 1, (const double[]){1.0, 0.0, 0.0}, cell);
        t.scene->method.flip = NAN; /* the defaults */
        set_sides(&t, 0, BC_SLIP, BC_FREE);
        snprintf(t.scene->method.basis, sizeof t.scene->method.basis, "%s", basis[i / 2]);
        const double left = 0.0125 + 0.007 * (double)(i % 2);
        const scene_body *bar =
            add_body(&t, add_solid(&t, "linear_elastic", 1.0 / 3.0, 0.5, 1.0),
                     make_box(&t, (const double[]){left, 0.0, 0.0}, (const double[]){left + 0.4, 1.0, 1.0}), 2);
        ((scene_body *)bar)->velocity[0] = -speed;
        trial_start(&t);
        while (t.sim->time < 4.0) {
            check_ok(t.ctx, sim_step(t.sim, 4.0));
            check_ok(t.ctx, mpm_sum(t.sim->mpm, &sum));
            energy = (sum.kinetic[0] + sum.strain[0]) / (0.2 * speed * speed);
            most = fmax(most, energy);
            const double now = sum.momentum[0][0] / (0.4 * speed);
            if (now - before > 0.5 * 2.0 / 0.8 * t.sim->mpm->dt) pressed += t.sim->mpm->dt;
            before = now;
        }
        print_message("%s: speed %.4f, energy %.4f, at most %.4f, pressed %.4f (0.8)\n", basis[i / 2], before, energy,
                      most, pressed);
        check_true(energy >= 0.985 && most <= 1.005);
        check_close(before, 1.0, 0.02);
        check_close(pressed, 0.8, 2.0 * cell);
        check_true(ledger_worst(&t, LEDGER_MOMENTUM_X, LEDGER_MOMENTUM_X) <= 1e-13);
        mpm_angular_momentum(t.sim->mpm, 0, spin, size);
        check_true(spin[0] == 0.0 && spin[1] == 0.0 && spin[2] == 0.0);
        trial_end(&t);
    }
}

/* A block that rests on a side bears its weight on it, and is let go when the weight turns round. */
static void test_rests(void **state)
{
    (void)state;
    const double g = 4.0;
    trial t;
    make_block(&t, (setting){2, false, false}, BC_SLIP, 0.0, 0.0);
    set_method(&t, "quadratic", STRESS_USL, 0.99);
    scene_load *weight = add_load(&t, LOAD_BODY_FORCE, -1);
    weight->vector[1] = -g;
    weight->ramp = 0.1;
    t.scene->damping.rate = 30.0;
    t.scene->damping.end = 1.0;
    trial_start(&t);
    trial_run(&t, 0.6);
    const double before = t.sim->ledger.entry[LEDGER_MOMENTUM_Y][LEDGER_BOUNDARY].value, from = t.sim->time;
    trial_run(&t, 1.0);
    const body_sums rest = sum_body_points(&t, 0, NULL);
    const double borne =
        (t.sim->ledger.entry[LEDGER_MOMENTUM_Y][LEDGER_BOUNDARY].value - before) / (t.sim->time - from);
    print_message("borne %.9f of the weight, middle lower by %.3e\n", borne / (rest.mass * g), 0.2 - rest.place[1]);
    check_close(borne, rest.mass * g, 2.1e-6 * rest.mass * g); /* what is left of the swing */
    /* Pressed together above its middle and below it, 3 rho g L^2/(8 M), and at the side by the springs of half a cell and a node more. */
    const double modulus = bulk + 4.0 / 3.0 * shear, layer = h / (0.54 * 0.85 * 0.85);
    check_close(0.2 - rest.place[1], (0.375 * 0.4 + layer) * g * 0.4 / modulus, 3e-5);
    trial_end(&t);
}

/* Under its weight a block that slides by a length along a side, edges held and free, stays about as high as one that does not, and gets no
 * energy from the nodes that it comes to. */
static void test_slides_level(void **state)
{
    (void)state;
    const double g = 100.0, mass = 0.16;
    for (int held = 0; held < 2; ++held) {
        double height[2];
        for (int slides = 0; slides < 2; ++slides) {
            trial t;
            const double v = slides ? 2.0 : 0.0, box[2][3] = {{0.3, 0.0, 0.0}, {0.7, 0.4, 1.0}};
            double sum = 0.0, most = 0.0;
            trial_begin(&t, 2, (const double[]){2.0, 1.0, 1.0}, 0.5 * h);
            t.scene->method.flip = NAN; /* the defaults */
            if (held) t.scene->method.edge_penalty = NAN;
            set_sides(&t, 1, BC_SLIP, BC_FREE);
            scene_body *b =
                add_body(&t, add_solid(&t, "neo_hookean", bulk, shear, 1.0), make_box(&t, box[0], box[1]), 2);
            b->velocity[0] = v;
            add_load(&t, LOAD_BODY_FORCE, -1)->vector[1] = -g;
            trial_start(&t);
            for (int k = 1; k <= 100; ++k) { /* over some swings */
                mpm_totals total;
                trial_run(&t, 0.002 * k);
                const double y = sum_body_points(&t, 0, NULL).place[1];
                check_ok(t.ctx, mpm_sum(t.sim->mpm, &total));
                sum += y;
                most = fmax(most, total.kinetic[0] + total.strain[0] - 0.5 * mass * v * v + mass * g * (y - 0.2));
            }
            height[slides] = sum / 100.0;
            check_true(most <= 5e-3 * mass * g * (0.2 - height[slides]));
            trial_end(&t);
        }
        print_message("height %.5f at rest, %.5f sliding\n", height[0], height[1]);
        check_close(height[1], height[0], 0.05 * (0.2 - height[0]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_thrown), cmocka_unit_test(test_glides), cmocka_unit_test(test_arrives),
        cmocka_unit_test(test_rests),  cmocka_unit_test(test_bar),    cmocka_unit_test(test_slides_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
