/* Every exact solution of the registry, unasked: it gives what it says, and at its sample it solves the equations that it
 * names, by differences (its tables: unit/test_verify_exact.c). A new file src/verify/exact/exact_<name>.c is covered as it stands. */
#include "check.h"
#include "exact_values.h"

#include "math/tensor.h"
#include "verify/exact.h"

#include <math.h>
#include <string.h>

enum { POINTS = 24 };

/* Steps of the differences, over the size of the sample: fourth order, so that truncation is 1e-12 and round-off 1e-13
 * of the leading terms (1e-10 for second derivatives). */
static const double step = 1e-3;

typedef struct probe {
    exact solution;
    double x[3], t;
    double dx[3], dt;
} probe;

/* A parameter of the sample, by its key; NAN if the solution has none. */
static double parameter(const exact *solution, const char *key)
{
    const exact_model *model = solution->model;
    for (size_t i = 0; i < model->n_params; i++) {
        if (strcmp(model->params[i].key, key) == 0) {
            return *(const double *)(const void *)((const char *)solution->par + model->params[i].offset);
        }
    }
    return NAN;
}

/* A repeatable number in (0, 1) (van der Corput), so that points fall on no plane of symmetry. */
static double scattered(int i, int base)
{
    double sum = 0.0;
    double place = 1.0 / base;
    for (int n = i + 1; n > 0; n /= base, place /= base) sum += place * (n % base);
    return sum;
}

static void place(probe *p, int i)
{
    static const int base[3] = {2, 3, 5};
    const exact_sample *sample = &p->solution.model->sample;
    for (int axis = 0; axis < 3; axis++) {
        const double size = axis < sample->dim ? sample->hi[axis] - sample->lo[axis] : 0.0;
        p->dx[axis] = step * size;
        p->x[axis] = sample->lo[axis] + (0.01 + 0.98 * scattered(i, base[axis])) * size;
    }
    p->t = sample->t;
    p->dt = step * (sample->t > 0.0 ? sample->t : 1.0);
}

/* The compiler does not know that there are at most three. */
static int dimension(const probe *p)
{
    return p->solution.dim < 3 ? p->solution.dim : 3;
}

/* A function of the probe's place and time, of a kind that a balance law differentiates. */
typedef double field(const probe *p, const double x[3], double t, int i, int j);

enum { TIME = 3 };

static double at_offset(const probe *p, field *f, int i, int j, int axis, double steps)
{
    double x[3] = {p->x[0], p->x[1], p->x[2]};
    if (axis == TIME) return f(p, x, p->t + steps * p->dt, i, j);
    x[axis] += steps * p->dx[axis];
    return f(p, x, p->t, i, j);
}

static double step_of(const probe *p, int axis)
{
    return axis == TIME ? p->dt : p->dx[axis];
}

static double first(const probe *p, field *f, int i, int j, int axis)
{
    const double near = at_offset(p, f, i, j, axis, 1.0) - at_offset(p, f, i, j, axis, -1.0);
    const double far = at_offset(p, f, i, j, axis, 2.0) - at_offset(p, f, i, j, axis, -2.0);
    return (8.0 * near - far) / (12.0 * step_of(p, axis));
}

static double second(const probe *p, field *f, int i, int j, int axis)
{
    const double here = at_offset(p, f, i, j, axis, 0.0);
    const double near = at_offset(p, f, i, j, axis, 1.0) + at_offset(p, f, i, j, axis, -1.0);
    const double far = at_offset(p, f, i, j, axis, 2.0) + at_offset(p, f, i, j, axis, -2.0);
    return (16.0 * near - far - 30.0 * here) / (12.0 * step_of(p, axis) * step_of(p, axis));
}

/* A balance: terms that should add up to 0. */
typedef struct balance {
    double sum, size;
} balance;

static void add(balance *b, double term)
{
    b->sum += term;
    b->size += fabs(term);
}

/* `noise`: what round-off of the fields alone may make of the sum. */
static void check_balance(const probe *p, const char *law, balance b, double noise)
{
    if (fabs(b.sum) <= 1e-7 * b.size + noise) return;
    print_error("%s: %s is out by %.3g of terms of %.3g (noise %.3g) at (%g, %g, %g)\n", p->solution.model->name, law,
                b.sum, b.size, noise, p->x[0], p->x[1], p->x[2]);
    check_true(false);
}

static double value(const probe *p, exact_quantity quantity, const double x[3], double t)
{
    return exact_value(&p->solution, quantity, x, t);
}

static double velocity(const probe *p, const double x[3], double t, int i, int j)
{
    (void)j;
    return value(p, (exact_quantity)(EXACT_VELOCITY_X + i), x, t);
}

static double pressure(const probe *p, const double x[3], double t, int i, int j)
{
    (void)i;
    (void)j;
    return value(p, EXACT_PRESSURE, x, t);
}

static double displacement(const probe *p, const double x[3], double t, int i, int j)
{
    (void)j;
    return value(p, (exact_quantity)(EXACT_DISPLACEMENT_X + i), x, t);
}

static double stress(const probe *p, const double x[3], double t, int i, int j)
{
    static const exact_quantity component[3][3] = {{EXACT_STRESS_XX, EXACT_STRESS_XY, EXACT_STRESS_ZX},
                                                   {EXACT_STRESS_XY, EXACT_STRESS_YY, EXACT_STRESS_YZ},
                                                   {EXACT_STRESS_ZX, EXACT_STRESS_YZ, EXACT_STRESS_ZZ}};
    return value(p, component[i][j], x, t);
}

/* The conserved quantity i of the Euler equations: mass (0), momentum (1 to 3), total energy (4). */
static double conserved(const probe *p, const double x[3], double t, int i, int j)
{
    (void)j;
    const double density = value(p, EXACT_DENSITY, x, t);
    if (i == 0) return density;
    if (i < 4) return density * velocity(p, x, t, i - 1, 0);
    double energy = value(p, EXACT_INTERNAL_ENERGY, x, t);
    for (int k = 0; k < dimension(p); k++) energy += 0.5 * velocity(p, x, t, k, 0) * velocity(p, x, t, k, 0);
    return density * energy;
}

/* Its flux along axis j. */
static double flux(const probe *p, const double x[3], double t, int i, int j)
{
    const double across = velocity(p, x, t, j, 0);
    const double load = pressure(p, x, t, 0, 0);
    if (i == 4) return (conserved(p, x, t, i, 0) + load) * across;
    return conserved(p, x, t, i, 0) * across + (i - 1 == j ? load : 0.0);
}

/* A parameter that is zero where the solution has none. */
static double coefficient(const probe *p, const char *key)
{
    const double given = parameter(&p->solution, key);
    return isnan(given) ? 0.0 : given;
}

/* Derivative of a field at another place and time than the probe's. */
static double slope_at(const probe *p, field *f, int i, const double x[3], double t, int axis)
{
    probe there = *p;
    for (int a = 0; a < 3; a++) there.x[a] = x[a];
    there.t = t;
    return first(&there, f, i, 0, axis);
}

static double temperature(const probe *p, const double x[3], double t, int i, int j)
{
    (void)i;
    (void)j;
    return value(p, EXACT_TEMPERATURE, x, t);
}

/* The flux along axis j that viscosity and conduction add to a conserved quantity. */
static double diffusive_flux(const probe *p, const double x[3], double t, int i, int j)
{
    const double mu = coefficient(p, "viscosity"), zeta = coefficient(p, "bulk_viscosity");
    double power = coefficient(p, "conductivity") * slope_at(p, temperature, 0, x, t, j), div = 0.0;
    if (i == 0) return 0.0;
    for (int k = 0; k < dimension(p); k++) div += slope_at(p, velocity, k, x, t, k);
    for (int k = 0; k < dimension(p); k++) {
        const double traction = mu * (slope_at(p, velocity, k, x, t, j) + slope_at(p, velocity, j, x, t, k)) +
                                (k == j ? (zeta - 2.0 / 3.0 * mu) * div : 0.0);
        if (i == k + 1) return -traction;
        power += traction * velocity(p, x, t, k, 0);
    }
    return -power;
}

static void add_diffusion(const probe *p, balance *b, double *noise, int i)
{
    for (int axis = 0; axis < dimension(p); axis++) {
        const double d = p->dx[axis];
        add(b, first(p, diffusive_flux, i, axis, axis));
        for (int k = 0; k < dimension(p); k++)
            *noise += 1e-14 * coefficient(p, "viscosity") * fabs(velocity(p, p->x, p->t, k, 0)) / (d * d);
        *noise += 1e-14 * coefficient(p, "conductivity") * fabs(temperature(p, p->x, p->t, 0, 0)) / (d * d);
    }
    if (i == 4) add(b, -exact_heat_source(&p->solution, p->x, p->t));
}

static void check_euler(const probe *p)
{
    static const char *const law[] = {"mass", "x momentum", "y momentum", "z momentum", "energy"};
    double force[3];
    exact_body_force(&p->solution, p->x, p->t, force);
    for (int i = 0; i < 5; i++) {
        if (i > dimension(p) && i < 4) continue;
        balance b = {0.0, 0.0};
        double noise = 1e-13 * fabs(conserved(p, p->x, p->t, i, 0)) / p->dt;
        add(&b, first(p, conserved, i, 0, TIME));
        for (int axis = 0; axis < dimension(p); axis++) {
            add(&b, first(p, flux, i, axis, axis));
            noise += 1e-13 * fabs(flux(p, p->x, p->t, i, axis)) / p->dx[axis];
            const double density = value(p, EXACT_DENSITY, p->x, p->t);
            if (i - 1 == axis) add(&b, -density * force[axis]);
            if (i == 4) add(&b, -density * force[axis] * velocity(p, p->x, p->t, axis, 0));
        }
        if (p->solution.model->equations == EXACT_NAVIER_STOKES) add_diffusion(p, &b, &noise, i);
        check_balance(p, law[i], b, noise);
    }
}

static void add_convection(const probe *p, balance *b, field *f, int i, double factor)
{
    add(b, factor * first(p, f, i, 0, TIME));
    for (int axis = 0; axis < dimension(p); axis++) {
        const double speed = p->solution.model->equations == EXACT_LINEAR_ACOUSTICS
                                 ? (axis == 0 ? parameter(&p->solution, "velocity") : 0.0)
                                 : velocity(p, p->x, p->t, axis, 0);
        add(b, factor * speed * first(p, f, i, 0, axis));
    }
}

static void check_acoustics(const probe *p)
{
    const double density = parameter(&p->solution, "density");
    const double sound = parameter(&p->solution, "sound_speed");
    balance mass = {0.0, 0.0};
    double noise = 1e-13 * fabs(pressure(p, p->x, p->t, 0, 0)) / p->dt;
    add_convection(p, &mass, pressure, 0, 1.0);
    for (int i = 0; i < dimension(p); i++) {
        balance momentum = {0.0, 0.0};
        add_convection(p, &momentum, velocity, i, density);
        add(&momentum, first(p, pressure, 0, 0, i));
        const double scale = density * (fabs(velocity(p, p->x, p->t, i, 0)) + sound);
        check_balance(p, "momentum", momentum, 1e-13 * sound * scale / p->dx[i] + noise / sound);
        add(&mass, density * sound * sound * first(p, velocity, i, 0, i));
        noise += 1e-13 * sound * sound * scale / p->dx[i];
    }
    check_balance(p, "pressure", mass, noise);
}

static void check_incompressible(const probe *p)
{
    const double density = parameter(&p->solution, "density");
    const double viscosity = parameter(&p->solution, "viscosity");
    double force[3];
    exact_body_force(&p->solution, p->x, p->t, force);
    balance volume = {0.0, 0.0};
    for (int i = 0; i < dimension(p); i++) {
        balance momentum = {0.0, 0.0};
        double noise = 0.0;
        add_convection(p, &momentum, velocity, i, density);
        add(&momentum, first(p, pressure, 0, 0, i));
        add(&momentum, -density * force[i]);
        for (int axis = 0; axis < dimension(p); axis++) {
            add(&momentum, -viscosity * second(p, velocity, i, 0, axis));
            const double along = velocity(p, p->x, p->t, axis, 0);
            noise += 1e-13 * (density * along * along + fabs(pressure(p, p->x, p->t, 0, 0))) / p->dx[axis];
            noise += 1e-14 * viscosity * fabs(velocity(p, p->x, p->t, i, 0)) / (p->dx[axis] * p->dx[axis]);
        }
        check_balance(p, "momentum", momentum, noise);
        add(&volume, first(p, velocity, i, 0, i));
    }
    check_balance(p, "volume", volume, 0.0);
}

/* `noise`: of the sum of sizes. */
static void check_momentum(const probe *p, double density, field *stress_field, double noise)
{
    double force[3];
    exact_body_force(&p->solution, p->x, p->t, force);
    for (int i = 0; i < dimension(p); i++) {
        balance b = {0.0, 0.0};
        if (density > 0.0) add(&b, -density * second(p, displacement, i, 0, TIME));
        add(&b, density * force[i]);
        for (int axis = 0; axis < dimension(p); axis++) add(&b, first(p, stress_field, i, axis, axis));
        check_balance(p, "momentum", b, noise * b.size);
    }
}

static void check_solid(const probe *p)
{
    const double density = parameter(&p->solution, "density");
    check_momentum(p, isnan(density) ? 0.0 : density, stress, 0.0);
}

/* P = J sigma F^-T in the plane; F by differences of the displacement. */
static double nominal_stress(const probe *p, const double x[3], double t, int i, int j)
{
    double F[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, inverse[9], sum = 0.0;
    for (int a = 0; a < dimension(p); a++)
        for (int b = 0; b < dimension(p); b++) F[3 * a + b] += slope_at(p, displacement, a, x, t, b);
    const double J = tensor_inverse(F, inverse);
    for (int k = 0; k < 3; k++) sum += stress(p, x, t, i, k) * inverse[3 * j + k];
    return J * sum;
}

/* Differences of differences: a tenth of the others' digits. */
static void check_large_solid(const probe *p)
{
    check_momentum(p, coefficient(p, "density"), nominal_stress, 1e-6);
}

static double normal(const probe *p, const double x[3], double t, int i, int j)
{
    (void)j;
    return value(p, (exact_quantity)(EXACT_NORMAL_X + i), x, t);
}

static void check_outline(const probe *p)
{
    double square = 0.0;
    for (int i = 0; i < 3; i++) square += normal(p, p->x, p->t, i, 0) * normal(p, p->x, p->t, i, 0);
    check_close(square, 1.0, 1e-14);
    check_close(value(p, EXACT_NORMAL, p->x, p->t), 0.0, 0.0);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        check_close(first(p, normal, i, 0, j), first(p, normal, j, 0, i), 1e-9);
    }
}

static void check_equations(const probe *p)
{
    switch (p->solution.model->equations) {
    case EXACT_EULER:
    case EXACT_NAVIER_STOKES: check_euler(p); break;
    case EXACT_LINEAR_ACOUSTICS: check_acoustics(p); break;
    case EXACT_INCOMPRESSIBLE: check_incompressible(p); break;
    case EXACT_SOLID: check_solid(p); break;
    case EXACT_LARGE_SOLID: check_large_solid(p); break;
    case EXACT_OUTLINE: check_outline(p); break;
    case EXACT_ORDINARY: break; /* in the unit test of the solution */
    }
}

/* The displacement is a function of the place at rest, so its rate is the velocity there. */
static void check_motion(const probe *p)
{
    for (int i = 0; i < dimension(p); i++) {
        if (!exact_provides(&p->solution, (exact_quantity)(EXACT_DISPLACEMENT_X + i))) continue;
        balance b = {0.0, 0.0};
        add(&b, first(p, displacement, i, 0, TIME));
        add(&b, -velocity(p, p->x, p->t, i, 0));
        check_balance(p, "velocity", b, 1e-13 * fabs(displacement(p, p->x, p->t, i, 0)) / p->dt);
    }
}

static probe start(context *ctx, const exact_model *model)
{
    probe p = {.dt = 0.0};
    check_ok(ctx, exact_create(ctx, model, model->sample.par, model->sample.dim, &p.solution));
    return p;
}

static void test_equations(void **state)
{
    context *ctx = *state;
    for (size_t m = 0; m < exact_registry_size; m++) {
        probe p = start(ctx, exact_registry[m]);
        for (int i = 0; i < POINTS; i++) {
            place(&p, i);
            check_equations(&p);
            check_motion(&p);
        }
        exact_destroy(ctx, &p.solution);
    }
}

/* Components beyond the scene's dimension need not be given (the cross stresses of a bar are not). */
static bool within(int dim, exact_quantity quantity)
{
    static const int needs[EXACT_QUANTITY_COUNT] = {
        [EXACT_VELOCITY_Y] = 2, [EXACT_VELOCITY_Z] = 3,     [EXACT_STRESS_YY] = 2,
        [EXACT_STRESS_ZZ] = 3,  [EXACT_STRESS_XY] = 2,      [EXACT_STRESS_YZ] = 3,
        [EXACT_STRESS_ZX] = 3,  [EXACT_DISPLACEMENT_Y] = 2, [EXACT_DISPLACEMENT_Z] = 3};
    return dim >= needs[quantity];
}

static void check_given(const probe *p, exact_quantity quantity)
{
    const double x = value(p, quantity, p->x, p->t);
    if (!exact_provides(&p->solution, quantity)) {
        check_true(isnan(x));
    } else if (within(dimension(p), quantity) && !isfinite(x)) {
        print_error("%s: %s is %g at its sample\n", p->solution.model->name, exact_quantity_name(quantity), x);
        check_true(false);
    }
}

static void test_provides(void **state)
{
    context *ctx = *state;
    for (size_t m = 0; m < exact_registry_size; m++) {
        probe p = start(ctx, exact_registry[m]);
        for (int i = 0; i < POINTS; i++) {
            place(&p, i);
            for (int q = 0; q < EXACT_QUANTITY_COUNT; q++) check_given(&p, (exact_quantity)q);
        }
        for (size_t i = 0; i < p.solution.model->n_scalars; i++) {
            check_true(isfinite(exact_scalar_value(&p.solution, p.solution.model->scalars[i].name, p.t)));
        }
        check_true(isnan(exact_scalar_value(&p.solution, "no such scalar", 0.0)));
        exact_destroy(ctx, &p.solution);
    }
}

/* A cell's average is the mean of its halves' averages, and tends to the value at its centre. */
static void check_averages(const probe *p, exact_quantity quantity)
{
    const int dim = dimension(p);
    double lo[3], hi[3];
    double scale = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        lo[axis] = p->x[axis] - 4.0 * p->dx[axis];
        hi[axis] = p->x[axis] + 4.0 * p->dx[axis];
    }
    for (int i = 0; i < 1 << dim; i++) {
        const double corner[3] = {i & 1 ? lo[0] : hi[0], i & 2 ? lo[1] : hi[1], i & 4 ? lo[2] : hi[2]};
        scale = fmax(scale, fabs(value(p, quantity, corner, p->t)));
    }
    const double all = exact_cell_average(&p->solution, quantity, lo, hi, p->t, EXACT_PLAIN);
    const double middle[3] = {p->x[0], hi[1], hi[2]};
    const double other[3] = {p->x[0], lo[1], lo[2]};
    const double left = exact_cell_average(&p->solution, quantity, lo, middle, p->t, EXACT_PLAIN);
    const double right = exact_cell_average(&p->solution, quantity, other, hi, p->t, EXACT_PLAIN);
    check_close(all, 0.5 * (left + right), 1e-12 * scale);
    check_close(all, value(p, quantity, p->x, p->t), 0.02 * scale);
}

static void test_averages(void **state)
{
    context *ctx = *state;
    for (size_t m = 0; m < exact_registry_size; m++) {
        probe p = start(ctx, exact_registry[m]);
        for (int q = 0; q < EXACT_QUANTITY_COUNT; q++) {
            if (!exact_provides(&p.solution, (exact_quantity)q) || !within(p.solution.dim, (exact_quantity)q)) continue;
            place(&p, q);
            check_averages(&p, (exact_quantity)q);
        }
        exact_destroy(ctx, &p.solution);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_provides),
        cmocka_unit_test(test_equations),
        cmocka_unit_test(test_averages),
    };
    return cmocka_run_group_tests_name("exact solutions", tests, check_make_context, check_drop_context);
}
