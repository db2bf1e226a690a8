/* The same bits for any blocks and threads: every point field, by id, after points have crossed cells, tiles and seams. */
#include "mpm_fixture.h"

enum { STEPS = 80, MAX_POINTS = 2000, MAX_WORDS = 48 };

typedef struct shot {
    size_t points[2];
    int words; /* doubles of a point */
    double (*value)[MAX_WORDS];
    long long reorders;
} shot;

/* All components of all point fields of a point, at the row of its id. */
static void keep_point(void *user, const fields *f, int body, size_t k)
{
    shot *s = user;
    const uint64_t id = (uint64_t)field_get(f, P_ID, body, 0)[k], row = id & ((UINT64_C(1) << 40) - 1);
    assert_true(row < MAX_POINTS);
    assert_int_equal(id >> 40, body);
    double *value = s->value[(size_t)body * MAX_POINTS + row];
    int word = 0;
    for (int field = 0; field < FIELD_COUNT; ++field) {
        const field_info *info = field_describe((field_id)field);
        if (info->centring != FIELD_POINT || info->class == FIELD_SCRATCH || !fields_has(f, (field_id)field, body))
            continue;
        for (int c = 0; c < FIELD_MAX_COMPONENTS && field_get(f, (field_id)field, body, c); ++c) {
            assert_true(word < MAX_WORDS);
            value[word++] = field_get(f, (field_id)field, body, c)[k];
        }
    }
    s->words = word;
    s->points[body]++;
}

typedef struct variant {
    const char *basis;
    stress_scheme stress;
    int blocks[2];
    int threads;
    bool periodic, axisymmetric, plastic, contact, edges, slip;
    point_density density;
} variant;

/* A fast elastic disc that crosses the seams, and one of another law in its way. */
static shot run(const variant *v)
{
    trial t;
    const double size[3] = {2.4, 1.6, 0.0};
    trial_begin(&t, 2, size, 0.1);
    if (v->axisymmetric) t.scene->mesh.geometry = MESH_AXISYMMETRIC;
    for (int a = 0; a < 2; ++a) {
        t.scene->mesh.blocks[a] = v->blocks[a];
        const bool around = v->periodic && !(v->axisymmetric && a == 0);
        set_sides(&t, a, around ? BC_PERIODIC : BC_SYMMETRY, around ? BC_PERIODIC : BC_NO_SLIP);
        if (v->slip && a == 1) set_sides(&t, a, BC_SLIP, BC_SLIP);
    }
    set_method(&t, v->basis, v->stress, 0.98);
    t.scene->damping.rate = 0.2;
    if (v->edges) t.scene->method.edge_penalty = 0.05;
    const int soft = add_solid(&t, v->plastic ? "j2" : "linear_elastic", 5.0, 2.0, 1.0);
    if (v->plastic) {
        scene_material *m = &t.scene->material[soft];
        set_param(m->law->params, m->law->n_params, m->law_par, "yield_stress", 0, 0.05);
        set_param(m->law->params, m->law->n_params, m->law_par, "tension_strength", 0, 0.2);
    }
    t.scene->method.density = v->density;
    const bool gas = v->density != DENSITY_CONTINUITY;
    const int rubber = gas ? add_gas(&t, 1.4, 2.5) : add_solid(&t, "neo_hookean", 3.0, 1.0, 2.0);
    t.scene->material[rubber].artificial_linear = 0.2;
    t.scene->material[rubber].artificial_quadratic = 1.0;
    scene_body *a = add_body(&t, soft, make_ball(&t, (const double[]){0.6, 0.55, 0.0}, 0.41), 3);
    a->velocity[0] = 0.9;
    a->velocity[1] = v->slip ? -0.63 : 0.63;
    scene_body *b = add_body(&t, rubber, make_ball(&t, (const double[]){1.7, 1.1, 0.0}, 0.37), 2);
    b->seeding = SEED_FITTED;
    b->density = b->pressure = gas ? 1.0 : (double)NAN;
    b->velocity[0] = -0.4;
    scene_load *gravity = add_load(&t, LOAD_BODY_FORCE, 0);
    gravity->vector[1] = -0.3;
    t.scene->contact.enabled = v->contact;
    t.scene->contact.kind = CONTACT_FRICTION;
    t.scene->contact.friction = 0.3;
    use_threads(v->threads);
    trial_start(&t);
    trial_steps(&t, STEPS);
    shot s = {.value = calloc(2 * MAX_POINTS, sizeof *s.value), .reorders = t.sim->ledger.count[COUNT_REORDERS]};
    for (int body = 0; body < 2; ++body) visit_points(&t, body, keep_point, &s);
    trial_end(&t);
    return s;
}

static void compare(const shot *a, const shot *b)
{
    assert_int_equal(a->points[0], b->points[0]);
    assert_int_equal(a->points[1], b->points[1]);
    assert_int_equal(a->words, b->words);
    assert_memory_equal(a->value, b->value, 2 * MAX_POINTS * sizeof *a->value);
}

static void check_variants(variant v)
{
    static const struct {
        int blocks[2], threads;
    } other[] = {{{2, 2}, 2}, {{3, 1}, 1}};
    v.blocks[0] = v.blocks[1] = v.threads = 1;
    shot one = run(&v);
    assert_true(one.points[0] > 300 && one.points[1] > 100);
    assert_true(one.reorders > 10);
    for (size_t k = 0; k < sizeof other / sizeof *other; ++k) {
        memcpy(v.blocks, other[k].blocks, sizeof v.blocks);
        v.threads = other[k].threads;
        shot s = run(&v);
        compare(&one, &s);
        free(s.value);
    }
    free(one.value);
}

/* Every basis, one of them with every stress scheme. */
static void test_blocks(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i) {
        const bool all = strcmp(basis_registry[i]->name, "quadratic") == 0;
        for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme)
            if (all || scheme == (int)(i % 3))
                check_variants((variant){.basis = basis_registry[i]->name, .stress = (stress_scheme)scheme});
    }
}

static void test_periodic(void **state)
{
    (void)state;
    for (size_t i = 0; i < basis_registry_size; ++i)
        check_variants((variant){.basis = basis_registry[i]->name, .periodic = true});
}

static void test_axisymmetric(void **state)
{
    (void)state;
    check_variants((variant){.basis = "quadratic", .axisymmetric = true, .periodic = true});
}

static void test_plastic(void **state)
{
    (void)state;
    check_variants((variant){.basis = "linear", .stress = STRESS_MUSL, .plastic = true});
    check_variants((variant){.basis = "quadratic", .plastic = true});
}

static void test_contact(void **state)
{
    (void)state;
    check_variants((variant){.basis = "linear", .stress = STRESS_USF, .contact = true});
    check_variants((variant){.basis = "quadratic", .stress = STRESS_MUSL, .contact = true, .periodic = true});
}

static void test_edges(void **state)
{
    (void)state;
    check_variants((variant){.basis = "quadratic", .edges = true, .periodic = true});
    check_variants((variant){.basis = "cubic", .edges = true, .axisymmetric = true});
    check_variants((variant){.basis = "linear", .stress = STRESS_MUSL, .edges = true, .contact = true});
}

static void test_cell_density(void **state)
{
    (void)state;
    for (int scheme = STRESS_USL; scheme <= STRESS_MUSL; ++scheme)
        check_variants((variant){.basis = "linear",
                                 .stress = (stress_scheme)scheme,
                                 .periodic = true,
                                 .density = scheme % 2 ? DENSITY_CELL : DENSITY_QUADRATIC});
}

/* Pressed on a side that lets go, at which it slides from block to block. */
static void test_slip(void **state)
{
    (void)state;
    check_variants((variant){.basis = "quadratic", .slip = true, .periodic = true});
    check_variants((variant){.basis = "linear", .stress = STRESS_MUSL, .slip = true, .plastic = true});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_blocks),  cmocka_unit_test(test_periodic), cmocka_unit_test(test_axisymmetric),
        cmocka_unit_test(test_plastic), cmocka_unit_test(test_contact),  cmocka_unit_test(test_cell_density),
        cmocka_unit_test(test_edges),   cmocka_unit_test(test_slip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
