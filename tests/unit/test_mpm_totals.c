/* What a body has in all: the sums over its points of mass, momentum, first moment and kinetic energy, along each axis; what
 * limits the step; and which gas lies outside a membrane. */
#include "verification/coupled_fixture.h"

#include "mpm/motion/motion.h"

static void test_sums(void **unused)
{
    (void)unused;
    for (int dim = 1; dim <= 3; ++dim) {
        trial t;
        uint64_t seed = 3;
        const double size[3] = {1.0, 0.8, 0.6}, lo[3] = {0.0, 0.0, 0.0}, hi[3] = {0.6, 0.6, 0.6};
        trial_begin(&t, dim, size, 0.1);
        for (int k = 0; k < 2; ++k) /* the second one overlaps none */
            add_body(
                &t, add_solid(&t, "linear_elastic", 3.0, 1.0, 1.0 + k),
                make_box(&t, (const double[3]){0.7 * k, lo[1], lo[2]}, (const double[3]){0.6 + 0.4 * k, hi[1], hi[2]}),
                2);
        trial_start(&t);
        const fields *f = t.sim->domain->fields[0];
        mpm_totals is, wanted = {.springs = 0.0};
        for (int body = 0; body < 2; ++body)
            for (size_t k = 0; k < t.sim->mpm->points[0][body].n; ++k) {
                const double mass = field_get(f, P_MASS, body, 0)[k];
                wanted.mass[body] += mass;
                for (int a = 0; a < dim; ++a) {
                    double *v = &field_get(f, P_VEL, body, a)[k];
                    *v = check_random(&seed, -1.0 - a, 2.0);
                    wanted.momentum[body][a] += mass * *v;
                    wanted.momentum_scale[a] += mass * fabs(*v);
                    wanted.moment[body][a] += mass * field_get(f, P_POS, body, a)[k];
                    wanted.kinetic[body] += 0.5 * mass * *v * *v;
                }
            }
        check_ok(t.ctx, mpm_sum(t.sim->mpm, &is));
        for (int body = 0; body < 2; ++body) {
            check_close_relative(is.mass[body], wanted.mass[body], 1e-13);
            check_close_relative(is.volume[body], wanted.mass[body] / (1.0 + body), 1e-13);
            check_close_relative(is.kinetic[body], wanted.kinetic[body], 1e-13);
            check_close(is.strain[body], 0.0, 0.0);
            check_close(is.internal[body], 0.0, 0.0);
            for (int a = 0; a < 3; ++a) {
                check_close(is.momentum[body][a], wanted.momentum[body][a], 1e-13);
                check_close(is.moment[body][a], wanted.moment[body][a], 1e-13);
                check_close(is.momentum_scale[a], wanted.momentum_scale[a], 1e-13);
            }
        }
        trial_end(&t);
    }
}

/* What limits the step: the speed of waves in uniaxial strain, with the linear term of artificial viscosity as much more on either side and the quadratic
 * one by sqrt(q/rho); and motion. Across the diagonal of a cell. */
static void test_step(void **unused)
{
    (void)unused;
    static const double linear[] = {0.0, 0.3}, pressure = 0.02, velocity[3] = {0.3, -0.2, 0.1}, bulk = 3.0, shear = 1.5;
    for (int dim = 1; dim <= 3; ++dim)
        for (int k = 0; k < 2; ++k) {
            trial t;
            step_limit limit;
            trial_begin(&t, dim, (const double[3]){0.4, 0.4, 0.4}, 0.1);
            set_method(&t, "gimp", STRESS_MUSL, 1.0); /* a share of one of the step of the bar */
            t.scene->time.cfl_mpm = 0.7;
            const int solid = add_solid(&t, "linear_elastic", bulk, shear, 2.0);
            t.scene->material[solid].artificial_linear = linear[k];
            t.scene->material[solid].artificial_quadratic = k;
            add_body(&t, solid, make_box(&t, (const double[3]){0.1, 0.1, 0.1}, (const double[3]){0.3, 0.3, 0.3}), 2);
            trial_start(&t);
            const fields *f = t.sim->domain->fields[0];
            double expected = sqrt((bulk + 4.0 / 3.0 * shear) / 2.0) * (1.0 + 2.0 * linear[k]) * sqrt(dim) / 0.1;
            const size_t last = t.sim->mpm->points[0][0].n - 1;
            if (k) field_get(f, P_VISCOUS_PRESSURE, 0, 0)[last] = pressure;
            if (k) expected += 2.0 * sqrt(pressure / 2.0) * sqrt(dim) / 0.1;
            for (int a = 0; a < dim; ++a) {
                field_get(f, P_VEL, 0, a)[last] = velocity[a];
                expected += fabs(velocity[a]) / 0.1;
            }
            check_ok(t.ctx, mpm_time_step(t.sim->mpm, &limit));
            check_close_relative(limit.dt, 0.7 / expected, 1e-13);
            trial_end(&t);
        }
}

/* Points that spin, of the quadratic basis, whose weights spread by h^2/4 along each axis: m w h^2/2 about each
 * axis, beside the moment of their motion; its size is taken about the middle of the mesh. */
static void test_spin(void **unused)
{
    (void)unused;
    for (int dim = 2; dim <= 3; ++dim) {
        trial t;
        const double h = 0.1, spin[3] = {3.0, -2.0, 5.0}, middle = 0.5;
        double out[3], size[3], moment[3] = {0.0}, scale[3] = {0.0};
        trial_begin(&t, dim, (const double[3]){1.0, 1.0, 1.0}, h);
        set_method(&t, "quadratic", STRESS_MUSL, (double)NAN);
        snprintf(t.scene->method.transfer, sizeof t.scene->method.transfer, "apic");
        add_body(&t, add_solid(&t, "linear_elastic", 3.0, 1.0, 2.0),
                 make_box(&t, (const double[3]){0.3, 0.3, 0.3}, (const double[3]){0.6, 0.7, 0.6}), 2);
        trial_start(&t);
        const fields *f = t.sim->domain->fields[0];
        for (size_t k = 0; k < t.sim->mpm->points[0][0].n; ++k) {
            const double sign = k % 3 ? 1.0 : -1.0, mass = field_get(f, P_MASS, 0, 0)[k];
            double x[3] = {0.0}, v[3] = {0.0};
            for (int e = dim == 2 ? 2 : 0; e < 3; ++e) {
                const int a = (e + 1) % 3, b = (e + 2) % 3;
                field_get(f, P_AFFINE, 0, dim * b + a)[k] = sign * spin[e];
                field_get(f, P_AFFINE, 0, dim * a + b)[k] = -sign * spin[e];
            }
            for (int a = 0; a < dim; ++a) {
                x[a] = field_get(f, P_POS, 0, a)[k];
                v[a] = field_get(f, P_VEL, 0, a)[k] = 0.01 * (double)((k + 5 * (size_t)a) % 7);
            }
            for (int e = dim == 2 ? 2 : 0; e < 3; ++e) {
                const int a = (e + 1) % 3, b = (e + 2) % 3;
                const double carried = sign * spin[e] * h * h / 2.0;
                moment[e] += mass * (x[a] * v[b] - x[b] * v[a] + carried);
                scale[e] += mass * fabs((x[a] - middle) * v[b] - (x[b] - middle) * v[a] + carried);
            }
        }
        mpm_angular_momentum(t.sim->mpm, 0, out, size);
        for (int e = 0; e < 3; ++e) {
            check_close(out[e], moment[e], 1e-14);
            check_close(size[e], scale[e], 1e-14);
        }
        trial_end(&t);
    }
}

/* Over the gas that is the sum of its pressures by volume; over the line the means of its stresses. */
typedef struct enclosure_means {
    double pressure, stress, hoop;
} enclosure_means;

static enclosure_means random_stresses(const trial *t, uint64_t *seed)
{
    const fields *f = t->sim->domain->fields[0];
    enclosure_means sum = {0.0, 0.0, 0.0};
    double all = 0.0;
    for (int body = 0; body < 2; ++body)
        for (size_t k = 0; k < t->sim->mpm->points[0][body].n; ++k) {
            const double volume = field_get(f, P_VOLUME0, body, 0)[k];
            double stress[3];
            for (int c = 0; c < 3; ++c)
                stress[c] = field_get(f, P_STRESS, body, c)[k] = check_random(seed, 1e3, 3e5) * (c + 1);
            if (body == 0) {
                field_get(f, P_J, 0, 0)[k] = check_random(seed, 0.5, 1.5);
                sum.pressure += volume * field_get(f, P_J, 0, 0)[k] *
                                (t->scene->reference_pressure - (stress[0] + stress[1] + stress[2]) / 3.0);
            } else {
                all += volume;
                sum.stress += volume * (stress[0] + stress[1]);
                sum.hoop += volume * stress[2];
            }
        }
    sum.stress /= all;
    sum.hoop /= all;
    return sum;
}

/* Degrees of freedom of a rigid body: along the axes, and about them; moments of inertia are the products of these motions over its masses. */
static void test_modes(void **unused)
{
    (void)unused;
    enum { MASSES = 20 };
    uint64_t seed = 8;
    double mass[MASSES], r[MASSES][3], inertia[3][3] = {{0.0}};
    body_motion m;
    memset(&m, 0, sizeof m);
    for (int k = 0; k < MASSES; ++k) {
        mass[k] = check_random(&seed, 1.0, 2.0);
        m.sums.mass += mass[k];
        for (int a = 0; a < 3; ++a) r[k][a] = check_random(&seed, -1.0, 2.0);
        for (int d = 0; d < 6; ++d) {
            const double turn[3] = {d == 3, d == 4, d == 5};
            double v[3];
            motion_unit(d, r[k], v);
            for (int a = 0; a < 3; ++a) {
                const int b = (a + 1) % 3, c = (a + 2) % 3;
                check_close(v[a], d < 3 ? (double)(a == d) : turn[b] * r[k][c] - turn[c] * r[k][b], 0.0);
            }
        }
        for (int d = 0; d < 3; ++d)
            for (int e = 0; e < 3; ++e)
                inertia[d][e] += mass[k] * ((d == e ? r[k][0] * r[k][0] + r[k][1] * r[k][1] + r[k][2] * r[k][2] : 0.0) -
                                            r[k][d] * r[k][e]);
    }
    for (int c = 0; c < 6; ++c) m.sums.inertia[c] = inertia[c < 3 ? c : c - 3][c < 3 ? c : (c - 2) % 3];
    for (int d = 0; d < 6; ++d)
        for (int e = 0; e < 6; ++e)
            check_close(motion_inertia(&m, d, e),
                        d >= 3 && e >= 3 ? inertia[d - 3][e - 3]
                        : d == e         ? m.sums.mass
                                         : 0.0,
                        0.0);
}

/* A quarter of a circle between mirrors: gas anywhere in the quadrant is outside where it is farther from the centre than the line. */
static void test_outside(void **unused)
{
    (void)unused;
    trial t;
    deck_begin(&t, "membrane_circle", NULL, 0);
    coupled_start(&t);
    const fields *f = t.sim->domain->fields[0];
    const size_t n = t.sim->mpm->points[0][0].n;
    double *x = field_get(f, P_POS, 0, 0), *y = field_get(f, P_POS, 0, 1);
    const double *mass = field_get(f, P_MASS, 0, 0);
    uint64_t seed = 11;
    check_true(mpm_membrane_encloses(t.sim->mpm, 1) && !mpm_membrane_encloses(t.sim->mpm, 0));
    for (int pass = 0; pass < 4; ++pass) {
        membrane_enclosure gas;
        double outside = 0.0;
        for (size_t k = 0; k < n; ++k) {
            double radius = check_random(&seed, 0.01, 0.99);
            const double angle = pass == 3 ? 0.3 : check_random(&seed, 0.01, 1.56);
            if (fabs(radius - 0.5) < 1e-3 || pass > 1)
                radius = 0.5 + (k % 2 ? 5e-5 : -5e-5); /* chords are 2e-5 inside */
            x[k] = radius * cos(angle);
            y[k] = radius * sin(angle);
            outside += radius > 0.5 ? mass[k] : 0.0;
        }
        const enclosure_means wanted = random_stresses(&t, &seed);
        mpm_membrane_enclosure(t.sim->mpm, 1, &gas);
        check_close_relative(gas.outside, outside, 1e-13);
        check_close_relative(gas.pressure * gas.size, wanted.pressure, 1e-13);
        check_close_relative(gas.stress, wanted.stress, 1e-13);
        check_close_relative(gas.hoop, wanted.hoop, 1e-13);
        check_close_relative(gas.size, 0.25 * acos(-1.0) * 0.25, 1e-4);
    }
    trial_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_sums), cmocka_unit_test(test_step),
                                       cmocka_unit_test(test_spin), cmocka_unit_test(test_outside),
                                       cmocka_unit_test(test_modes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
