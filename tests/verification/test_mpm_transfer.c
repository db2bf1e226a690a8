/* Transfers, each with every basis: what they must keep, what they claim to keep, and what they lose. */
#include "mpm_fixture.h"

#include "mpm/transfer/transfer.h"

/* The first from `i` on that is asked for. */
static size_t next_asked(size_t i)
{
    while (i < transfer_registry_size && !check_asks_for(transfer_registry[i]->name)) ++i;
    return i;
}

static void set_transfer(trial *t, const transfer_model *model)
{
    snprintf(t->scene->method.transfer, sizeof t->scene->method.transfer, "%s", model->name);
}

/* A ball of radius 0.3 in a box of size 1, in no hold of anything. */
static scene_body *make_free_ball(trial *t, int dim, const char *basis, const transfer_model *model, double bulk)
{
    const double upper[3] = {1.0, 1.0, 1.0}, centre[3] = {0.47, 0.52, 0.5};
    trial_begin(t, dim, upper, 0.1);
    set_method(t, basis, STRESS_MUSL, 1.0);
    set_transfer(t, model);
    const int solid = add_solid(t, "neo_hookean", bulk, 0.6 * bulk, 1000.0);
    return add_body(t, solid, make_ball(t, centre, 0.3), 2);
}

/* ---- uniform motion, momentum ---- */

static double uniform(void *user, initial_quantity quantity, int component, const double x[3])
{
    static const double v[3] = {1.0, -0.5, 0.25};
    (void)user;
    (void)x;
    return quantity == INITIAL_VELOCITY ? v[component] : quantity == INITIAL_STRESS ? 0.0 : (double)NAN;
}

static void check_uniform(void *user, const fields *f, int body, size_t k)
{
    const int dim = *(const int *)user;
    for (int a = 0; a < dim; ++a)
        check_close(field_get(f, P_VEL, body, a)[k], uniform(NULL, INITIAL_VELOCITY, a, NULL), 1e-12);
}

static void test_uniform_motion(void **state)
{
    (void)state;
    for (size_t i = next_asked(0); i < transfer_registry_size; i = next_asked(i + 1))
        for (size_t b = 0; b < basis_registry_size; ++b)
            for (int dim = 1; dim <= 3; ++dim) {
                trial t;
                scene_body *body = make_free_ball(&t, dim, basis_registry[b]->name, transfer_registry[i], 1e4);
                body->initial_from_exact = true;
                t.scene->initial = uniform;
                t.scene->time.fixed_step = 1e-3;
                trial_start(&t);
                trial_steps(&t, 60);
                visit_points(&t, 0, check_uniform, &dim);
                check_true(ledger_worst(&t, LEDGER_MASS, LEDGER_ENERGY) <= 1e-12);
                trial_end(&t);
            }
}

/* ---- a body that turns ---- */

static const double spin = 2.0; /* rad/s */

static double turning(void *user, initial_quantity quantity, int component, const double x[3])
{
    (void)user;
    if (quantity == INITIAL_STRESS) return 0.0;
    if (quantity != INITIAL_VELOCITY) return (double)NAN;
    return component == 0 ? -spin * (x[1] - 0.52) : component == 1 ? spin * (x[0] - 0.47) : 0.0;
}

typedef struct turning_sum {
    double moment, scale; /* kg m2/s about the z axis through the middle */
    double spread;        /* m2: D of the basis, equal everywhere for the splines */
    double worst;         /* m/s: velocity off a rigid body's */
} turning_sum;

static void add_turning(void *user, const fields *f, int body, size_t k)
{
    turning_sum *s = user;
    const double m = field_get(f, P_MASS, body, 0)[k], x = field_get(f, P_POS, body, 0)[k] - 0.47,
                 y = field_get(f, P_POS, body, 1)[k] - 0.52, u = field_get(f, P_VEL, body, 0)[k],
                 v = field_get(f, P_VEL, body, 1)[k];
    s->moment += m * (x * v - y * u);
    s->scale += m * spin * (x * x + y * y);
    if (fields_has(f, P_AFFINE, body))
        s->moment += m * s->spread * (field_get(f, P_AFFINE, body, 2)[k] - field_get(f, P_AFFINE, body, 1)[k]);
    s->worst = fmax(s->worst, hypot(u + spin * y, v - spin * x));
}

static turning_sum turning_of(const trial *t, const basis_model *basis)
{
    turning_sum s = {.spread = (basis_is(basis, "cubic") ? 1.0 / 3.0 : 0.25) * 0.01};
    visit_points(t, 0, add_turning, &s);
    return s;
}

/* A stiff disc over a tenth of a turn: moment of momentum is kept to round-off where it is claimed, for bases of which D is the
 * same everywhere; the loss of the others is shown. */
static void test_spin(void **state)
{
    (void)state;
    for (size_t i = next_asked(0); i < transfer_registry_size; i = next_asked(i + 1))
        for (size_t b = 0; b < basis_registry_size; ++b) {
            const transfer_model *model = transfer_registry[i];
            const basis_model *basis = basis_registry[b];
            trial t;
            scene_body *body = make_free_ball(&t, 2, basis->name, model, 1e5);
            body->initial_from_exact = true;
            t.scene->initial = turning;
            trial_start(&t);
            const turning_sum before = turning_of(&t, basis);
            trial_run(&t, 0.3);
            const turning_sum after = turning_of(&t, basis);
            const double lost = 1.0 - after.moment / before.moment;
            print_message("%-5s %-9s loses %8.1e of its moment of momentum in %ld steps\n", model->name, basis->name,
                          lost, t.sim->steps);
            /* Forces on nodes of next to no mass are dropped (theory 4.4), which is all that is lost. */
            const bool even = basis_is(basis, "quadratic") || basis_is(basis, "cubic");
            if (model->keeps_spin && even) check_true(fabs(lost) <= 1e-9);
            check_true(isfinite(lost));
            trial_end(&t);
        }
}

/* One step of a turning body. */
static void test_rigid_motion(void **state)
{
    (void)state;
    for (size_t i = next_asked(0); i < transfer_registry_size; i = next_asked(i + 1))
        for (size_t b = 0; b < basis_registry_size; ++b) {
            const transfer_model *model = transfer_registry[i];
            trial t;
            scene_body *body = make_free_ball(&t, 2, basis_registry[b]->name, model, 1e-6);
            body->initial_from_exact = true;
            t.scene->initial = turning;
            t.scene->time.fixed_step = 1e-9;
            trial_start(&t);
            trial_steps(&t, 1);
            const turning_sum s = turning_of(&t, basis_registry[b]);
            print_message("%-5s %-9s off by %.1e of the rim's velocity after one step\n", model->name,
                          basis_registry[b]->name, s.worst / (0.3 * spin));
            if (model->keeps_rigid_motion) check_true(s.worst <= 4e-9 * 0.3 * spin);
            trial_end(&t);
        }
}

/* ---- a body that flies apart ---- */

static const double rate[3] = {1.5, -0.5, 0.25}; /* 1/s, along the axes */
static const double middle[3] = {0.47, 0.52, 0.5};

static double parting(void *user, initial_quantity quantity, int component, const double x[3])
{
    (void)user;
    if (quantity == INITIAL_STRESS) return 0.0;
    return quantity == INITIAL_VELOCITY ? rate[component] * (x[component] - middle[component]) : (double)NAN;
}

typedef struct parting_sum {
    int dim;
    double time, worst; /* s; m/s: velocity off that of the same points in free flight */
} parting_sum;

static void add_parting(void *user, const fields *f, int body, size_t k)
{
    parting_sum *s = user;
    for (int a = 0; a < s->dim; ++a) {
        const double start = (field_get(f, P_POS, body, a)[k] - middle[a]) / (1.0 + rate[a] * s->time);
        s->worst = fmax(s->worst, fabs(field_get(f, P_VEL, body, a)[k] - rate[a] * start));
    }
}

static parting_sum part(const char *basis, const transfer_model *model, int dim)
{
    trial t;
    scene_body *body = make_free_ball(&t, dim, basis, model, 1e-12);
    body->initial_from_exact = true;
    t.scene->initial = parting;
    t.scene->method.stress = STRESS_USL;
    t.scene->time.fixed_step = 5e-3;
    trial_start(&t);
    trial_steps(&t, 60);
    parting_sum s = {.dim = dim, .time = t.sim->time};
    visit_points(&t, 0, add_parting, &s);
    trial_end(&t);
    return s;
}

/* A ball without stiffness that grows to 1.45 times its length along one axis and shrinks along another, each point in free flight: what carries
 * the motion about its points keeps it even, to the ends of the body, which others do not. */
static void test_even_motion(void **state)
{
    (void)state;
    for (size_t i = next_asked(0); i < transfer_registry_size; i = next_asked(i + 1))
        for (size_t b = 0; b < basis_registry_size; ++b)
            for (int dim = 1; dim <= 2; ++dim) {
                const transfer_model *model = transfer_registry[i];
                const parting_sum s = part(basis_registry[b]->name, model, dim);
                print_message("%-5s %-9s in %d dimensions off by %.1e of the largest velocity after growing by 45 %%\n",
                              model->name, basis_registry[b]->name, dim, s.worst / 0.45);
                if (model->carry != CARRY_NOTHING) check_true(s.worst <= 2e-12 * 0.45);
            }
}

/* ---- walls ---- */

/* A ball thrown into two walls, a mirror and one that holds all components, bounces: what they have given it is in the ledger. */
static void test_walls(void **state)
{
    (void)state;
    for (size_t i = next_asked(0); i < transfer_registry_size; i = next_asked(i + 1))
        for (size_t b = 0; b < basis_registry_size; ++b) {
            trial t;
            scene_body *body = make_free_ball(&t, 2, basis_registry[b]->name, transfer_registry[i], 1e4);
            if (transfer_registry[i]->filter) t.scene->method.filter_order = 3;
            body->velocity[0] = -0.5;
            body->velocity[1] = -0.4;
            set_sides(&t, 0, BC_SLIP, BC_FREE);
            set_sides(&t, 1, BC_NO_SLIP, BC_FREE);
            trial_start(&t);
            trial_run(&t, 0.8);
            check_true(fabs(t.sim->ledger.entry[LEDGER_MOMENTUM_X][LEDGER_BOUNDARY].value) >
                       1.0); /* it was met: m v is 140 */
            const double worst = ledger_worst(&t, LEDGER_MASS, LEDGER_MOMENTUM_Y);
            print_message("%-5s %-9s off walls: mass and momentum %.1e\n", transfer_registry[i]->name,
                          basis_registry[b]->name, worst);
            /* Cubic splines beside a wall that does not mirror lose 2e-9 where velocities are taken from the nodes. */
            check_true(worst <= (basis_is(basis_registry[b], "cubic") ? 1e-8 : 1e-12));
            trial_end(&t);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniform_motion), cmocka_unit_test(test_rigid_motion), cmocka_unit_test(test_spin),
        cmocka_unit_test(test_even_motion),    cmocka_unit_test(test_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
