/* Bodies in contact, by the whole solver: momentum in any geometry, what a contact that always sticks is, bodies that part, blocks on
 * slopes, three bodies, energy. */
#include "mpm_fixture.h"
#include "reference_values.h"

#include "mpm/normal/normal.h"
#include "verify/reference.h"

static const double bulk = 5.0, shear = 2.0;

static void touch(trial *t, contact_kind kind, double friction)
{
    t->scene->contact.enabled = true;
    t->scene->contact.kind = kind;
    t->scene->contact.friction = friction;
}

/* Two balls that hit each other off centre; on the axis where there is one. */
static void make_balls(trial *t, int dim, bool axisymmetric, double h)
{
    const double size[3] = {1.2, 1.2, 0.8};
    trial_begin(t, dim, size, h);
    if (axisymmetric) t->scene->mesh.geometry = MESH_AXISYMMETRIC;
    if (axisymmetric) set_sides(t, 0, BC_SYMMETRY, BC_FREE);
    const int along = axisymmetric ? 1 : 0;
    for (int k = 0; k < 2; ++k) {
        double centre[3] = {axisymmetric ? 0.0 : 0.6, 0.55 + 0.1 * k, 0.38};
        centre[along] = k ? 0.85 : 0.35;
        scene_body *b = add_body(t, add_solid(t, k ? "neo_hookean" : "linear_elastic", bulk, shear, 1.0 + k),
                                 make_ball(t, centre, 0.22), 2);
        b->velocity[along] = k ? -0.3 : 0.5;
        if (dim > 1 && !axisymmetric) b->velocity[1] = 0.1;
    }
}

/* Momentum to round-off of the sum of its sizes, in every geometry, with every two of basis, stress scheme and kind of contact; and that
 * the balls do meet. */
static void test_momentum(void **state)
{
    (void)state;
    static const struct {
        int dim;
        bool axisymmetric;
        double h;
        long steps;
    } sort[] = {{1, false, 0.025, 150}, {2, false, 0.1, 80}, {2, true, 0.1, 80}, {3, false, 0.1, 60}};
    for (size_t g = 0; g < sizeof sort / sizeof *sort; ++g) FOR_CONTACT_BASES(i)
    for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme)
        for (int kind = CONTACT_STICK; kind <= CONTACT_FRICTION; ++kind) {
            if ((kind + scheme + (int)i) % 3 != 0) continue; /* a Latin square */
            trial t;
            make_balls(&t, sort[g].dim, sort[g].axisymmetric, sort[g].h);
            set_method(&t, basis_registry[i]->name, (stress_scheme)scheme, 0.99);
            touch(&t, (contact_kind)kind, 0.3);
            t.scene->contact.criterion = (contact_criterion)(i % 3);
            t.scene->contact.touch = kind == scheme ? CONTACT_AT_NODES : CONTACT_AT_POINTS;
            trial_start(&t);
            trial_steps(&t, sort[g].steps);
            const long long *count = t.sim->ledger.count;
            check_true(ledger_worst(&t, sort[g].axisymmetric ? LEDGER_MOMENTUM_Y : LEDGER_MOMENTUM_X,
                                    LEDGER_MOMENTUM_Z) <= 1e-13);
            check_true(count[COUNT_CONTACT_STICK] + count[COUNT_CONTACT_SLIP] > 0);
            trial_end(&t);
        }
}

typedef struct place {
    double *x;
    size_t n;
} place;

static void keep_place(void *user, const fields *f, int body, size_t k)
{
    place *p = user;
    const size_t row = (size_t)field_get(f, P_ID, body, 0)[k] & 0xffffff;
    for (int a = 0; a < 2; ++a) p->x[2 * row + (size_t)a] = field_get(f, P_POS, body, a)[k];
    p->n++;
}

/* A contact that always sticks is the one field that bodies share without it: the points go the same way but for round-off (which
 * grows where a point crosses a cell a step sooner), and for the linear basis under USL but for its rule on light nodes, which looks
 * at the mass of a field. */
static void test_stick_is_no_slip(void **state)
{
    (void)state;
    FOR_CONTACT_BASES(i)
    for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme) {
        place p[2];
        for (int apart = 0; apart < 2; ++apart) {
            trial t;
            make_balls(&t, 2, false, 0.1);
            set_method(&t, basis_registry[i]->name, (stress_scheme)scheme, 1.0);
            t.scene->time.fixed_step = 0.01;
            if (apart) touch(&t, CONTACT_STICK, 0.0);
            t.scene->contact.touch = CONTACT_AT_NODES;
            trial_start(&t);
            assert_int_equal(t.sim->mpm->n_groups, 1 + apart);
            p[apart] = (place){calloc(2 * mpm_count(t.sim->mpm), sizeof(double)), 0};
            trial_steps(&t, 60);
            visit_points(&t, 1, keep_place, &p[apart]);
            trial_end(&t);
        }
        double worst = 0.0;
        for (size_t k = 0; k < 2 * p[0].n; ++k) worst = fmax(worst, fabs(p[0].x[k] - p[1].x[k]));
        print_message("%s, scheme %d: %.1e\n", basis_registry[i]->name, scheme, worst);
        check_true(worst <= (basis_is(basis_registry[i], "linear") ? 2e-3 : 1e-8));
        free(p[0].x);
        free(p[1].x);
    }
}

/* Blocks that touch and move apart: each flies on as if alone, to round-off; without a contact they stick. */
static void test_parting(void **state)
{
    (void)state;
    const double size[3] = {2.0, 1.0, 0.0}, va[3] = {-0.3, 0.1, 0.0}, vb[3] = {0.4, 0.1, 0.0};
    FOR_CONTACT_BASES(i)
    for (int kind = CONTACT_STICK; kind <= CONTACT_FRICTION; ++kind) {
        trial t;
        trial_begin(&t, 2, size, 0.1);
        set_method(&t, basis_registry[i]->name, STRESS_USL, 1.0);
        const int solid = add_solid(&t, "linear_elastic", bulk, shear, 1.0);
        scene_body *a =
            add_body(&t, solid, make_box(&t, (const double[]){0.6, 0.3, 0.0}, (const double[]){1.0, 0.7, 0.0}), 2);
        memcpy(a->velocity, va, sizeof va);
        scene_body *b =
            add_body(&t, solid, make_box(&t, (const double[]){1.0, 0.3, 0.0}, (const double[]){1.4, 0.7, 0.0}), 2);
        memcpy(b->velocity, vb, sizeof vb);
        touch(&t, (contact_kind)kind, 0.5);
        if (kind == CONTACT_STICK) t.scene->contact.touch = CONTACT_AT_NODES;
        trial_start(&t);
        trial_run(&t, 0.5);
        const double error = fmax(sum_body_points(&t, 0, va).largest_error, sum_body_points(&t, 1, vb).largest_error);
        if (kind == CONTACT_STICK)
            check_true(error > 0.1);
        else
            check_true(error <= 1e-12);
        trial_end(&t);
    }
}

/* A layer on a fixed one, periodic along x, under gravity that leans by `slope`: no edges, so that normals are exact. */
static void make_slope(trial *t, const char *basis, const char *normals, double slope, double friction, double speed,
                       double ramp)
{
    const double size[3] = {0.6, 1.4, 0.0}, g = 0.05;
    trial_begin(t, 2, size, 0.1);
    set_sides(t, 0, BC_PERIODIC, BC_PERIODIC);
    set_sides(t, 1, BC_NO_SLIP, BC_FREE);
    set_method(t, basis, STRESS_USL, 1.0);
    t->scene->time.fixed_step = 0.008;
    const int solid = add_solid(t, "linear_elastic", bulk, shear, 1.0);
    add_body(t, solid, make_box(t, (const double[]){0.0, 0.0, 0.0}, (const double[]){0.6, 0.4, 0.0}), 2);
    add_body(t, solid, make_box(t, (const double[]){0.0, 0.4, 0.0}, (const double[]){0.6, 0.8, 0.0}), 2)->velocity[0] =
        speed;
    scene_load *gravity = add_load(t, LOAD_BODY_FORCE, -1);
    gravity->vector[0] = g * sin(slope);
    gravity->vector[1] = -g * cos(slope);
    gravity->ramp = ramp;
    touch(t, CONTACT_FRICTION, friction);
    snprintf(t->scene->contact.normals, sizeof t->scene->contact.normals, "%s", normals);
    trial_start(t);
}

/* A block that slides loses g (sin a - mu cos a) per time along the slope, and what it gains or loses across it by bouncing
 * comes with mu times as much: p_x + mu p_y = m (v_0 + g (sin a - mu cos a) t), exactly, at any step. */
static void test_slope_slides(void **state)
{
    (void)state;
    const double slope = 0.5, friction = 0.3, speed = 0.4;
    FOR_CONTACT_BASES(i)
    for (size_t n = 0; n < normal_registry_size; ++n) {
        trial t;
        make_slope(&t, basis_registry[i]->name, normal_registry[n]->name, slope, friction, speed, 0.0);
        trial_steps(&t, 500);
        /* Velocities live half a step behind. */
        const double kicked = t.sim->time - 0.5 * t.scene->time.fixed_step;
        const body_sums s = sum_body_points(&t, 1, NULL);
        const double expected = speed + 0.05 * (sin(slope) - friction * cos(slope)) * kicked;
        const double got = (s.momentum[0] + friction * s.momentum[1]) / s.mass;
        print_message("%s, %s: v = %.6f, exact %.6f, across %.1e\n", basis_registry[i]->name, normal_registry[n]->name,
                      got, expected, s.momentum[1] / s.mass);
        const long long *count = t.sim->ledger.count;
        print_message("    slips %lld, sticks %lld, light nodes %lld\n", count[COUNT_CONTACT_SLIP],
                      count[COUNT_CONTACT_STICK], count[COUNT_SMALL_NODES]);
        /* Forces on nodes that hardly have mass are dropped, into the ledger. */
        check_close(got, expected, count[COUNT_SMALL_NODES] ? 4e-10 : 1e-12);
        check_true(count[COUNT_CONTACT_SLIP] > 0 && count[COUNT_CONTACT_STICK] == 0);
        check_true(fabs(s.momentum[1] / s.mass) < 0.011); /* it stays on the slope */
        trial_end(&t);
    }
}

/* Where tan a < mu the block stays, under a gravity that comes slowly: over the time in which a free one would slide by 0.1 its points
 * move by what shear gives way, of order rho g H^2 / G = 0.002. */
static void test_slope_sticks(void **state)
{
    (void)state;
    FOR_CONTACT_BASES(i)
    {
        trial t;
        make_slope(&t, basis_registry[i]->name, "colour", 0.3, 0.5, 0.0, 2.0);
        place start = {calloc(2 * mpm_count(t.sim->mpm), sizeof(double)), 0}, end = start;
        end.x = calloc(2 * mpm_count(t.sim->mpm), sizeof(double));
        visit_points(&t, 1, keep_place, &start);
        trial_steps(&t, 500);
        visit_points(&t, 1, keep_place, &end);
        double moved = 0.0;
        for (size_t k = 0; k < start.n; ++k) moved = fmax(moved, fabs(remainder(end.x[2 * k] - start.x[2 * k], 0.6)));
        print_message("%s: moved %.2e\n", basis_registry[i]->name, moved);
        check_true(moved > 0.0 && moved <= 0.004);
        print_message("    slips %lld, sticks %lld\n", t.sim->ledger.count[COUNT_CONTACT_SLIP],
                      t.sim->ledger.count[COUNT_CONTACT_STICK]);
        free(start.x);
        free(end.x);
        trial_end(&t);
    }
}

/* Bars in a row, the second and third touching at rest: the first stops, the third leaves with the momentum (equal elastic bars hand
 * their velocity on). With bars of 20 cells 96 % and more of it is in the third. */
static void test_three_bodies(void **state)
{
    (void)state;
    const double size[3] = {4.0, 0.0, 0.0};
    for (int kind = CONTACT_RELEASE; kind <= CONTACT_FRICTION; ++kind) {
        trial t;
        trial_begin(&t, 1, size, 0.025);
        set_method(&t, "linear", STRESS_MUSL, 1.0);
        const int solid = add_solid(&t, "linear_elastic", 1.0 / 3.0, 0.5, 1.0);
        for (int k = 0; k < 3; ++k) {
            const double left[] = {0.4, 1.0, 1.5};
            add_body(&t, solid,
                     make_box(&t, (const double[]){left[k], 0.0, 0.0}, (const double[]){left[k] + 0.5, 1.0, 1.0}), 2)
                ->velocity[0] = k == 0 ? 0.01 : 0.0;
        }
        touch(&t, (contact_kind)kind, 0.0);
        trial_start(&t);
        trial_run(&t, 25.0);
        const double total = 0.5 * 0.01;
        const double share[] = {sum_body_points(&t, 0, NULL).momentum[0] / total,
                                sum_body_points(&t, 1, NULL).momentum[0] / total,
                                sum_body_points(&t, 2, NULL).momentum[0] / total};
        print_message("kind %d: shares of the momentum %.4f %.4f %.4f\n", kind, share[0], share[1], share[2]);
        check_close(share[0] + share[1] + share[2], 1.0, 1e-12);
        check_true(share[2] >= 0.9);
        trial_end(&t);
    }
}

/* ---- the stages, at nodes whose velocities and forces are set ---- */

/* Two blocks, side by side along x and as long as the periodic domain along y: normals are along x, to the bit. */
static void make_pair(trial *t)
{
    const double size[3] = {2.0, 0.8, 0.0};
    trial_begin(t, 2, size, 0.1);
    set_sides(t, 1, BC_PERIODIC, BC_PERIODIC);
    set_method(t, "quadratic", STRESS_MUSL, 1.0);
    const int solid = add_solid(t, "linear_elastic", bulk, shear, 1.0),
              heavy = add_solid(t, "linear_elastic", 9.0, 4.0, 3.0);
    add_body(t, solid, make_box(t, (const double[]){0.6, 0.0, 0.0}, (const double[]){1.0, 0.8, 0.0}), 2);
    add_body(t, heavy, make_box(t, (const double[]){1.0, 0.0, 0.0}, (const double[]){1.4, 0.8, 0.0}), 2);
    touch(t, CONTACT_FRICTION, 0.0);
    t->scene->contact.touch = CONTACT_AT_NODES;
    snprintf(t->scene->method.transfer, sizeof t->scene->method.transfer,
             "afmpm"); /* it adds to velocities (restore.c) */
    t->scene->method.filter_order = 2;
    t->scene->method.flip = (double)NAN;
    trial_start(t);
    trial_steps(t, 1);
}

/* At every node each block gets a velocity along x before (v) and in `id`, and a force that adds `kicked` to it; along y each has its own. */
static void set_nodes(const trial *t, field_id id, const double v[2], const double kicked[2])
{
    const fields *f = t->sim->domain->fields[0];
    for (int g = 0; g < 2; ++g)
        for (size_t k = 0; k < t->sim->mesh.block[0].size; ++k) {
            const double mass = field_get(f, N_MASS, g, 0)[k], along = 0.5 - g;
            for (int a = 0; a < 2; ++a) {
                field_get(f, N_MOMENTUM, g, a)[k] = mass * (a == 0 ? v[g] : along);
                field_get(f, N_FORCE, g, a)[k] = a == 0 ? mass * kicked[g] / t->sim->mpm->kick : 0.0;
                field_get(f, id, g, a)[k] = a == 0 ? v[g] : along;
            }
        }
}

/* Where blocks meet they have one velocity along x, that of the centre of mass, or each its own; along y each its own. Returns how many meet. */
static int check_nodes(const trial *t, field_id id, bool met, const double v[2])
{
    const fields *f = t->sim->domain->fields[0];
    const double *mass[2] = {field_get(f, N_MASS, 0, 0), field_get(f, N_MASS, 1, 0)};
    int meetings = 0;
    for (size_t k = 0; k < t->sim->mesh.block[0].size; ++k) {
        if (!(mass[0][k] > 0.0 && mass[1][k] > 0.0)) continue;
        const double common = (mass[0][k] * v[0] + mass[1][k] * v[1]) / (mass[0][k] + mass[1][k]);
        ++meetings;
        for (int g = 0; g < 2; ++g) {
            check_close(field_get(f, id, g, 0)[k], met ? common : v[g], met ? 1e-15 : 0.0);
            check_close(field_get(f, id, g, 1)[k], 0.5 - g, met ? 1e-15 : 0.0);
        }
    }
    return meetings;
}

/* Without friction: what v^L decides binds the velocities of which MUSL takes strains, and what is added to either, whether those approach or part;
 * USF decides by what the forces so far will do, and binds the velocities before them. */
static void test_stages(void **state)
{
    (void)state;
    const double closing[2] = {0.3, -0.2}, parting[2] = {-0.2, 0.3}, none[2] = {0.0, 0.0};
    trial t;
    make_pair(&t);
    mpm *s = t.sim->mpm;
    for (int met = 0; met < 2; ++met) {
        const double *decided = met ? closing : parting, *other = met ? parting : closing;
        const double forced[2] = {2.0 * decided[0], 2.0 * decided[1]};
        set_nodes(&t, N_VEL_L, decided, none);
        contact_velocities(s, CONTACT_DECIDE);
        const int meetings = check_nodes(&t, N_VEL_L, met, decided);
        check_true(meetings >= 8);
        set_nodes(&t, N_VEL, other, none);
        contact_velocities(s, CONTACT_REPEAT);
        check_nodes(&t, N_VEL, met, other);
        set_nodes(&t, N_RESIDUAL, other, none);
        contact_velocities(s, CONTACT_RESTORE);
        check_nodes(&t, N_RESIDUAL, met, other);
        set_nodes(&t, N_VEL, other, forced);
        contact_velocities(s, CONTACT_FORESEE);
        check_nodes(&t, N_VEL, met, other);
        set_nodes(&t, N_VEL, decided, (const double[]){1.5 * other[0], 1.5 * other[1]});
        contact_velocities(s, CONTACT_FORESEE);
        check_nodes(&t, N_VEL, !met, decided);
    }
    trial_end(&t);
}

typedef struct impact {
    double meet, part, restitution;
} impact;

/* Two bars of unit length and speed of waves along a line, the left one at `speed`, a gap of 0.1 between them. */
static const double speed = 0.01, gap = 0.1;

static impact collide(const char *basis, contact_kind kind, double h)
{
    trial t;
    const double size[3] = {4.0, 0.0, 0.0};
    impact r = {0.0, 0.0, 0.0};
    trial_begin(&t, 1, size, h);
    set_method(&t, basis, STRESS_MUSL, 1.0);
    const int solid = add_solid(&t, "linear_elastic", 1.0 / 3.0, 0.5, 1.0);
    for (int k = 0; k < 2; ++k) {
        const double left = k == 0 ? 0.5 : 1.5 + gap;
        add_body(&t, solid, make_box(&t, (const double[]){left, 0.0, 0.0}, (const double[]){left + 1.0, 1.0, 1.0}), 2)
            ->velocity[0] = k == 0 ? speed : 0.0;
    }
    touch(&t, kind, 0.0);
    trial_start(&t);
    double before = 0.0;
    while (t.sim->time < 15.0) {
        check_ok(t.ctx, sim_step(t.sim, 15.0));
        const double now = sum_body_points(&t, 1, NULL).momentum[0];
        if (r.meet == 0.0 && now > 1e-3 * speed) r.meet = t.sim->time;
        if (fabs(now - before) > 1e-3 * speed * t.sim->dt) r.part = t.sim->time;
        before = now;
    }
    r.restitution = (sum_body_points(&t, 1, NULL).momentum[0] - sum_body_points(&t, 0, NULL).momentum[0]) / speed;
    trial_end(&t);
    return r;
}

/* Against the waves in both bars (verify's bar_impact): they meet when their surfaces do, press for 2 L/c, and part with a restitution of 1.
 * Release, quadratic basis, at h = 0.05, 0.025, 0.0125: they meet late by 0.05, 0.025, 0.012, press too long by 0.13, 0.08, 0.05, and are
 * short of 1 by 0.10, 0.06, 0.035; friction: 0.09, 0.05, 0.03. */
static void test_impact(void **state)
{
    (void)state;
    const reference_model *model = reference_find("bar_impact");
    assert_non_null(model);
    context *ctx = context_create();
    double *par = calloc(1, model->param_size);
    const struct {
        const char *key;
        double value;
    } given[] = {{"left_length", 1.0},     {"left_density", 1.0}, {"left_modulus", 1.0},  {"left_area", 1.0},
                 {"left_velocity", speed}, {"right_length", 1.0}, {"right_density", 1.0}, {"right_modulus", 1.0},
                 {"right_area", 1.0},      {"gap", gap}};
    for (size_t k = 0; k < sizeof given / sizeof *given; ++k)
        set_param(model->params, model->n_params, par, given[k].key, 0, given[k].value);
    reference waves;
    check_ok(ctx, reference_create(ctx, model, par, &waves));
    const double meet = reference_scalar_value(&waves, "contact"), part = reference_scalar_value(&waves, "release");
    const double restitution = reference_scalar_value(&waves, "restitution");
    for (int kind = CONTACT_RELEASE; kind <= CONTACT_FRICTION; ++kind) {
        double last = 1.0;
        for (double h = 0.05; h > 0.01; h *= 0.5) {
            const impact r = collide("quadratic", (contact_kind)kind, h);
            print_message("kind %d, h = %g: meet %.3f (%.3f), part %.3f (%.3f), restitution %.4f (%.4f)\n", kind, h,
                          r.meet, meet, r.part, part, r.restitution, restitution);
            check_close(r.meet, meet, 2.0 * h);
            check_close(r.part - r.meet, part - meet, 5.0 * h);
            check_true(fabs(r.restitution - restitution) < fmin(0.9 * last, 2.5 * h + 0.03));
            last = fabs(r.restitution - restitution);
        }
    }
    reference_destroy(ctx, &waves);
    free(par);
    context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_momentum),     cmocka_unit_test(test_stick_is_no_slip),
        cmocka_unit_test(test_parting),      cmocka_unit_test(test_slope_slides),
        cmocka_unit_test(test_slope_sticks), cmocka_unit_test(test_three_bodies),
        cmocka_unit_test(test_impact),       cmocka_unit_test(test_stages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
