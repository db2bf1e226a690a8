/* Tracers (docs/theory, 10.6): places of bodies that move with them, in free flight, in even strain, and beyond the body. */
#include "coupled_fixture.h"

#include "sim/tracer.h"

static scene_tracer *add_tracer(trial *t, const char *name, double x, double y)
{
    scene_tracer *tracer = &t->scene->tracer[t->scene->n_tracers++];
    (void)snprintf(tracer->name, sizeof tracer->name, "%s", name);
    tracer->position[0] = x;
    tracer->position[1] = y;
    return tracer;
}

/* A block that flies and turns no more than its points do: a corner, a place within and one between points go along with it. */
static void test_free_flight(void **unused)
{
    (void)unused;
    double first[3][2];
    for (int blocks = 1; blocks <= 2; ++blocks) {
        trial t;
        trial_begin(&t, 2, (const double[3]){2.0, 2.0, 0.0}, 0.125);
        for (int a = 0; a < 2; ++a) t.scene->mesh.blocks[a] = blocks;
        scene_body *b = add_body(&t, add_solid(&t, "linear_elastic", 6.0, 3.0, 1.0),
                                 make_box(&t, (const double[3]){0.3, 0.4, 0}, (const double[3]){0.9, 0.85, 0}), 2);
        b->velocity[0] = 0.5;
        b->velocity[1] = 0.25;
        add_tracer(&t, "corner", 0.9, 0.85);
        add_tracer(&t, "within", 0.61, 0.5);
        add_tracer(&t, "side", 0.3, 0.7);
        trial_start(&t);
        trial_run(&t, 1.0);
        tracer_value value[SCENE_MAX_TRACERS];
        tracers_read(t.sim, value);
        for (int n = 0; n < 3; ++n) {
            for (int a = 0; a < 2; ++a) {
                check_close(value[n].displacement[a], b->velocity[a] * t.sim->time, 1e-13);
                check_close(value[n].velocity[a], b->velocity[a], 1e-13);
                if (blocks == 1) first[n][a] = value[n].displacement[a];
                check_close(value[n].displacement[a], first[n][a], 0.0);
            }
            for (int c = 0; c < 4; ++c) check_close(value[n].stress[c], 0.0, 1e-12);
        }
        trial_end(&t);
    }
}

/* A block between a wall at rest and one that moves, in static equilibrium: the displacement is linear, the stress even, at the places
 * themselves and not at those of points. */
static void test_even_strain(void **unused)
{
    (void)unused;
    trial t;
    const double size[3] = {1.0, 0.5, 0.0}, from[3] = {0.0}, strain = 1e-5;
    trial_begin(&t, 2, size, 0.125);
    set_sides(&t, 0, BC_NO_SLIP, BC_NO_SLIP);
    set_sides(&t, 1, BC_PERIODIC, BC_PERIODIC);
    t.scene->bc.side[0][1].velocity[0] = strain;
    add_body(&t, add_solid(&t, "linear_elastic", 6e8, 3e8, 1000.0), make_box(&t, from, size), 2);
    const double at[3] = {0.0, 0.437, 1.0};
    for (int n = 0; n < 3; ++n) add_tracer(&t, "at", at[n], 0.2);
    t.scene->time.solver = SOLVER_STATIC;
    t.scene->time.increments = 1;
    t.scene->time.end = 1.0;
    trial_start(&t);
    trial_run(&t, 1.0);
    tracer_value value[SCENE_MAX_TRACERS];
    tracers_read(t.sim, value);
    for (int n = 0; n < 3; ++n) {
        check_close(value[n].displacement[0], strain * at[n], 2e-10); /* 1e-10: of the second order in the strain */
        check_close(value[n].displacement[1], 0.0, 1e-15);
        check_close_relative(value[n].stress[0], 1e9 * strain, 1e-5);
        check_close_relative(value[n].stress[1], 4e8 * strain, 1e-5);
    }
    trial_end(&t);
}

/* Points in one row define no plane: a tracer goes by the nearest of them. A place beside the body is refused. */
static void test_places_beside_the_body(void **unused)
{
    (void)unused;
    trial t;
    trial_begin(&t, 2, (const double[3]){2.0, 2.0, 0.0}, 0.125);
    add_body(&t, add_solid(&t, "linear_elastic", 6.0, 3.0, 1.0),
             make_box(&t, (const double[3]){0.25, 0.5, 0}, (const double[3]){1.5, 0.625, 0}), 2)
        ->velocity[1] = 0.5;
    t.scene->body[0].per_cell[1] = 1;
    add_tracer(&t, "tip", 1.5, 0.5625);
    trial_start(&t);
    trial_run(&t, 0.5);
    tracer_value value[SCENE_MAX_TRACERS];
    tracers_read(t.sim, value);
    check_close(value[0].displacement[1], 0.5 * t.sim->time, 1e-13);
    sim_destroy(&t.sim);
    add_tracer(&t, "lost", 1.75, 0.5625);
    assert_int_equal(sim_create(&t.sim, t.ctx, t.scene, t.scene->coupling), FLOE_BAD_INPUT);
    assert_non_null(strstr(context_message(t.ctx), "output.tracers.lost: body"));
    trial_end(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_free_flight),
        cmocka_unit_test(test_even_strain),
        cmocka_unit_test(test_places_beside_the_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
