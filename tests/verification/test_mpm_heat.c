/* Conduction of heat in solids on points against series (Carslaw and Jaeger 1959): bars between walls, at rest in the domain and heated by a
 * side, a disc about the axis, a sphere and a block in space. Errors fall with the square of the cells, and heat is kept to round-off. */
#include "mpm_fixture.h"
#include "order_fixture.h"

static const double PI = 3.14159265358979323846;
static const double level = 2.0; /* K: about which temperatures are */

typedef double solution(const double x[3], double t);

typedef struct heat_case {
    const char *basis;
    int dim;
    bool radial;
    double upper[3];
    bc_side side[2]; /* of axis 0, lower and upper; those of the others are mirrors */
    double lower_body[3], upper_body[3];
    double radius; /* of a ball about the origin instead of the box; 0: the box */
    double diffusivity, end;
    solution *exact;
} heat_case;

/* Density and specific heat: of their product the diffusivity is one part. */
static const double density = 2.0, specific_heat = 3.0;

/* ---- a scene ---- */

typedef struct point_error {
    const heat_case *c;
    double sum, largest, n;
} point_error;

static void place_of(const fields *f, int body, size_t k, double x[3])
{
    for (int a = 0; a < 3; ++a) x[a] = field_get(f, P_POS, body, a) ? field_get(f, P_POS, body, a)[k] : 0.0;
}

static void set_first(void *user, const fields *f, int body, size_t k)
{
    const heat_case *c = user;
    double x[3];
    place_of(f, body, k, x);
    field_get(f, P_TEMP, body, 0)[k] = c->exact(x, 0.0);
}

static void add_error(void *user, const fields *f, int body, size_t k)
{
    point_error *e = user;
    double x[3];
    place_of(f, body, k, x);
    const double error = field_get(f, P_TEMP, body, 0)[k] - e->c->exact(x, e->c->end);
    e->sum += error * error;
    e->n += 1.0;
    e->largest = fmax(e->largest, fabs(error));
}

static void begin(trial *t, const heat_case *c, double h)
{
    trial_begin(t, c->dim, c->upper, h);
    scene *s = t->scene;
    if (c->radial) s->mesh.geometry = MESH_AXISYMMETRIC;
    for (int a = 0; a < c->dim; ++a) set_sides(t, a, BC_SYMMETRY, BC_SYMMETRY);
    s->bc.side[0][0] = c->side[0];
    s->bc.side[0][1] = c->side[1];
    set_method(t, c->basis, STRESS_USL, 1.0);
    const int solid = add_solid(t, "linear_elastic", 1.0, 0.5, density);
    s->material[solid].specific_heat = specific_heat;
    s->material[solid].conductivity = density * specific_heat * c->diffusivity;
    const double middle[3] = {0.0, 0.0, 0.0};
    const shape box = make_box(t, c->lower_body, c->upper_body);
    scene_body *b = add_body(t, solid, c->radius > 0.0 ? make_ball(t, middle, c->radius) : box, 2);
    b->seeding = SEED_FITTED;
    b->temperature = level;
    trial_start(t);
    visit_points(t, 0, set_first, (void *)c);
    check_ok(t->ctx, sim_open_ledger(t->sim));
}

/* Root of the mean square of the error in temperature. */
static double error_of(const heat_case *c, double h)
{
    trial t;
    point_error e = {.c = c};
    begin(&t, c, h);
    trial_run(&t, c->end);
    visit_points(&t, 0, add_error, &e);
    check_true(ledger_worst(&t, LEDGER_ENERGY, LEDGER_ENERGY) <= 1e-13);
    trial_end(&t);
    return sqrt(e.sum / e.n);
}

/* Second order between h and h/2, and no more than `most` at h/2. */
static void check_case(const heat_case *c, double h, double most)
{
    const double each[2] = {h, 0.5 * h}, error[2] = {error_of(c, each[0]), error_of(c, each[1])};
    const double order = fitted_order(2, each, error);
    const bool good = error[1] <= most && order >= 1.7;
    if (!good || getenv("SHOW"))
        print_error("%s, %d-D: errors %g and %g, order %g\n", c->basis, c->dim, error[0], error[1], order);
    check_true(good);
}

static bc_side wall(bc_kind kind, double temperature, double flux)
{
    return (bc_side){.kind = kind, .temperature = temperature, .heat_flux = flux};
}

/* ---- bars ---- */

static double between_walls(const double x[3], double t)
{
    return level + sin(PI * x[0]) * exp(-0.1 * PI * PI * t);
}

static void test_between_walls(void **state)
{
    (void)state;
    static const struct {
        const char *basis;
        double most;
    } each[] = {{"quadratic", 5e-4}, {"cubic", 6.5e-4}, {"gimp", 8e-4}, {"cpdi", 8e-4}};
    for (size_t k = 0; k < sizeof each / sizeof *each; ++k) {
        heat_case c = {.basis = each[k].basis,
                       .dim = 1,
                       .upper = {1.0},
                       .side = {wall(BC_NO_SLIP, level, 0.0), wall(BC_SLIP, level, 0.0)},
                       .upper_body = {1.0},
                       .diffusivity = 0.1,
                       .end = 1.0,
                       .exact = between_walls};
        check_case(&c, 0.1, each[k].most);
    }
}

/* Ends that lie within cells, where no node is. */
static double insulated(const double x[3], double t)
{
    return level + cos(PI * (x[0] - 0.43)) * exp(-0.1 * PI * PI * t);
}

static void test_insulated(void **state)
{
    (void)state;
    static const char *const basis[] = {"quadratic", "gimp"};
    for (int k = 0; k < 2; ++k) {
        const heat_case c = {.basis = basis[k],
                             .dim = 1,
                             .upper = {2.0},
                             .side = {wall(BC_FREE, NAN, 0.0), wall(BC_FREE, NAN, 0.0)},
                             .lower_body = {0.43},
                             .upper_body = {1.43},
                             .diffusivity = 0.1,
                             .end = 1.0,
                             .exact = insulated};
        check_case(&c, 0.1, k == 0 ? 6e-4 : 9e-4);
    }
}

/* A wall gives 0.6 W/m2 at one end, the other has the first temperature: T = q x / k less a series (Carslaw and Jaeger, 3.8). */
static const double flux = 0.6;

static double heated_end(const double x[3], double t)
{
    const double k = density * specific_heat * 0.1;
    double sum = flux / k * x[0];
    for (int n = 0; n < 60; ++n) {
        const double m = (n + 0.5) * PI;
        sum -= 2.0 * flux / k * (n % 2 ? -1.0 : 1.0) / (m * m) * sin(m * x[0]) * exp(-0.1 * m * m * t);
    }
    return level + sum;
}

static void test_heated_end(void **state)
{
    (void)state;
    const heat_case c = {.basis = "quadratic",
                         .dim = 1,
                         .upper = {1.0},
                         .side = {wall(BC_NO_SLIP, level, 0.0), wall(BC_NO_SLIP, NAN, flux)},
                         .upper_body = {1.0},
                         .diffusivity = 0.1,
                         .end = 1.0,
                         .exact = heated_end};
    check_case(&c, 0.1, 2.8e-4);
}

/* ---- about an axis ---- */

static const double zero[] = {2.404825557695773, 5.520078110286311, 8.653727912911013, 11.791534439014281,
                              14.930917708487787};

/* J_n by its integral; the trapezoidal rule is exact to round-off. */
static double bessel(int n, double x)
{
    enum { PARTS = 40 };
    double sum = 0.0;
    for (int k = 0; k < PARTS; ++k) {
        const double angle = 2.0 * PI * k / PARTS;
        sum += cos(n * angle - x * sin(angle));
    }
    return sum / PARTS;
}

/* A disc of 1 K warmer than its rim (7.6). */
static double disc(const double x[3], double t)
{
    double sum = 0.0;
    for (int n = 0; n < 5; ++n)
        sum += 2.0 / (zero[n] * bessel(1, zero[n])) * bessel(0, zero[n] * x[0]) *
               exp(-0.1 * zero[n] * zero[n] * (t + 0.5));
    return level + sum;
}

static void test_disc(void **state)
{
    (void)state;
    const heat_case c = {.basis = "quadratic",
                         .dim = 2,
                         .radial = true,
                         .upper = {1.0, 0.4},
                         .side = {wall(BC_SYMMETRY, NAN, 0.0), wall(BC_NO_SLIP, level, 0.0)},
                         .upper_body = {1.0, 0.4},
                         .diffusivity = 0.1,
                         .end = 0.5,
                         .exact = disc};
    check_case(&c, 0.1, 8e-4);
}

/* Heat flows in at the rim of a disc (7.8). */
static double heated_rim(const double x[3], double t)
{
    static const double root[] = {3.8317059702075125, 7.015586669815619, 10.173468135062722, 13.323691936314223,
                                  16.470630050877634};
    const double k = density * specific_heat * 0.1, time = 0.1 * (t + 0.2), r = x[0];
    double sum = 2.0 * time + 0.5 * r * r - 0.25;
    for (int n = 0; n < 5; ++n)
        sum -= 2.0 * exp(-root[n] * root[n] * time) * bessel(0, root[n] * r) / (root[n] * root[n] * bessel(0, root[n]));
    return level + flux / k * sum;
}

static void test_heated_rim(void **state)
{
    (void)state;
    const heat_case c = {.basis = "quadratic",
                         .dim = 2,
                         .radial = true,
                         .upper = {1.0, 0.4},
                         .side = {wall(BC_SYMMETRY, NAN, 0.0), wall(BC_NO_SLIP, NAN, flux)},
                         .upper_body = {1.0, 0.4},
                         .diffusivity = 0.1,
                         .end = 0.5,
                         .exact = heated_rim};
    check_case(&c, 0.1, 5e-4);
}

/* A sphere that nothing heats: sin(m r)/(m r) with tan m = m (9.3). */
static double sphere(const double x[3], double t)
{
    const double m = 4.493409457909064, r = fmax(sqrt(x[0] * x[0] + x[1] * x[1]), 1e-9);
    return level + sin(m * r) / (m * r) * exp(-0.02 * m * m * t);
}

static void test_sphere(void **state)
{
    (void)state;
    const heat_case c = {.basis = "quadratic",
                         .dim = 2,
                         .radial = true,
                         .upper = {1.2, 1.2},
                         .side = {wall(BC_SYMMETRY, NAN, 0.0), wall(BC_FREE, NAN, 0.0)},
                         .radius = 1.0,
                         .diffusivity = 0.02,
                         .end = 1.0,
                         .exact = sphere};
    check_case(&c, 0.1, 2.4e-4);
}

static double cube(const double x[3], double t)
{
    return level + cos(PI * x[0]) * cos(PI * x[1]) * cos(PI * x[2]) * exp(-0.09 * PI * PI * t);
}

static void test_block(void **state)
{
    (void)state;
    const heat_case c = {.basis = "quadratic",
                         .dim = 3,
                         .upper = {1.0, 1.0, 1.0},
                         .side = {wall(BC_NO_SLIP, NAN, 0.0), wall(BC_FREE, NAN, 0.0)},
                         .upper_body = {1.0, 1.0, 1.0},
                         .diffusivity = 0.03,
                         .end = 1.0,
                         .exact = cube};
    check_case(&c, 0.25, 8e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_between_walls), cmocka_unit_test(test_insulated),  cmocka_unit_test(test_heated_end),
        cmocka_unit_test(test_disc),          cmocka_unit_test(test_heated_rim), cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_block),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
