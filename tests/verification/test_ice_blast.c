/* Blasts about an axis (issue rows "spherical and cylindrical blasts"): a ball, or a cylinder, of dense hot gas that bursts (Toro, Riemann
 * Solvers and Numerical Methods for Fluid Dynamics, 3rd ed. 2009, section 17.1), on cells in (r, z), against a reference in one
 * dimension, along the radius, by another method: Godunov's with linear states in the cells, the HLLC solver, and 4000 cells. */
#include "ice_fixture.h"
#include "order_fixture.h"

enum { REFERENCE = 3000 };

static const double ratio = 1.4, burst = 0.4, end_time = 0.25;

/* Density, velocity along the radius, pressure. */
typedef struct radial_state {
    double rho, u, p;
} radial_state;

typedef struct flux {
    double mass, momentum, energy; /* momentum without the pressure */
    double pressure;
} flux;

/* The reference on n cells of [0, 1]: areas go with r^power. */
typedef struct radial {
    int n, power;
    radial_state cell[REFERENCE], left[REFERENCE + 1], right[REFERENCE + 1]; /* of each face */
    flux face[REFERENCE + 1];
} radial;

static double energy_of(radial_state w)
{
    return w.p / (ratio - 1.0) + 0.5 * w.rho * w.u * w.u;
}

static flux side_flux(radial_state w, double speed, double star)
{
    /* of the state behind the wave of that speed */
    const double rho = w.rho * (speed - w.u) / (speed - star);
    const double p = w.p + w.rho * (w.u - speed) * (w.u - star);
    const double energy = ((speed - w.u) * energy_of(w) - w.p * w.u + p * star) / (speed - star);
    return (flux){rho * star, rho * star * star, (energy + p) * star, p};
}

/* Toro, section 10.6, with Davis's speeds. */
static flux hllc(radial_state l, radial_state r)
{
    const double cl = sqrt(ratio * l.p / l.rho), cr = sqrt(ratio * r.p / r.rho);
    const double sl = fmin(l.u - cl, r.u - cr), sr = fmax(l.u + cl, r.u + cr);
    const double star =
        (r.p - l.p + l.rho * l.u * (sl - l.u) - r.rho * r.u * (sr - r.u)) / (l.rho * (sl - l.u) - r.rho * (sr - r.u));
    if (sl >= 0.0) return (flux){l.rho * l.u, l.rho * l.u * l.u, (energy_of(l) + l.p) * l.u, l.p};
    if (sr <= 0.0) return (flux){r.rho * r.u, r.rho * r.u * r.u, (energy_of(r) + r.p) * r.u, r.p};
    return star >= 0.0 ? side_flux(l, sl, star) : side_flux(r, sr, star);
}

static double limited(double a, double b)
{
    const double size = fmin(0.5 * fabs(a + b), 2.0 * fmin(fabs(a), fabs(b))); /* van Leer 1977, monotonised central */
    return a * b <= 0.0 ? 0.0 : copysign(size, a);
}

/* States on both faces of cell i at half the step (Hancock), from the cells beside it; the axis mirrors. */
static void reconstruct(radial *s, int i, double dt)
{
    const radial_state at = s->cell[i], after = s->cell[i + 1 < s->n ? i + 1 : i];
    radial_state before = s->cell[i > 0 ? i - 1 : 0];
    if (i == 0) before.u = -before.u;
    const double h = 1.0 / s->n;
    const radial_state d = {limited(at.rho - before.rho, after.rho - at.rho), limited(at.u - before.u, after.u - at.u),
                            limited(at.p - before.p, after.p - at.p)};
    const double half = 0.5 * dt / h, source = 0.5 * dt * s->power * at.u / ((i + 0.5) * h);
    const radial_state middle = {at.rho - half * (at.u * d.rho + at.rho * d.u) - source * at.rho,
                                 at.u - half * (at.u * d.u + d.p / at.rho),
                                 at.p - half * (at.u * d.p + ratio * at.p * d.u) - source * ratio * at.p};
    s->right[i] = (radial_state){middle.rho - 0.5 * d.rho, middle.u - 0.5 * d.u, middle.p - 0.5 * d.p};
    s->left[i + 1] = (radial_state){middle.rho + 0.5 * d.rho, middle.u + 0.5 * d.u, middle.p + 0.5 * d.p};
}

static double area_at(const radial *s, int face)
{
    return pow((double)face / s->n, s->power);
}

static void update(radial *s, int i, double dt)
{
    const double lower = area_at(s, i), upper = area_at(s, i + 1), k = s->power + 1.0;
    const double volume = (pow((i + 1.0) / s->n, k) - pow((double)i / s->n, k)) / k;
    const flux *a = &s->face[i], *b = &s->face[i + 1];
    radial_state *w = &s->cell[i];
    const double share = dt / volume, p = w->p; /* even pressure pushes nothing: its part is taken from both faces */
    const double rho = w->rho - share * (upper * b->mass - lower * a->mass);
    const double momentum =
        w->rho * w->u - share * (upper * (b->momentum + b->pressure - p) - lower * (a->momentum + a->pressure - p));
    const double energy = energy_of(*w) - share * (upper * b->energy - lower * a->energy);
    w->rho = rho;
    w->u = momentum / rho;
    w->p = (ratio - 1.0) * (energy - 0.5 * rho * w->u * w->u);
}

static void reference_run(radial *s, int n, int power)
{
    s->n = n;
    s->power = power;
    for (int i = 0; i < n; ++i)
        s->cell[i] = (i + 0.5) / n < burst ? (radial_state){1.0, 0.0, 1.0} : (radial_state){0.125, 0.0, 0.1};
    for (double time = 0.0; time < end_time;) {
        double fastest = 0.0;
        for (int i = 0; i < n; ++i)
            fastest = fmax(fastest, fabs(s->cell[i].u) + sqrt(ratio * s->cell[i].p / s->cell[i].rho));
        const double dt = fmin(0.5 / n / fastest, end_time - time);
        for (int i = 0; i < n; ++i) reconstruct(s, i, dt);
        s->left[0] = s->right[0];
        s->left[0].u = -s->right[0].u;
        s->right[n] = s->left[n]; /* free */
        for (int f = 0; f <= n; ++f) s->face[f] = hllc(s->left[f], s->right[f]);
        for (int i = 0; i < n; ++i) update(s, i, dt);
        time += dt;
    }
}

static double density_at(const radial *s, double radius)
{
    const double x = radius * s->n - 0.5;
    const int i = x < 0.0 ? 0 : x >= s->n - 1 ? s->n - 2 : (int)x;
    const double share = fmin(fmax(x - i, 0.0), 1.0);
    return (1.0 - share) * s->cell[i].rho + share * s->cell[i + 1].rho;
}

/* Mean of the reference's density over a cell in (r, z), of 6 x 6 parts. */
static double mean_density(const radial *s, const mesh *m, int i, int j)
{
    enum { PARTS = 6 };
    double sum = 0.0, volume = 0.0;
    for (int k = 0; k < PARTS * PARTS; ++k) {
        const double r = mesh_node(m, 0, i) + (k % PARTS + 0.5) / PARTS * m->h[0];
        const double z = mesh_node(m, 1, j) + (k / PARTS + 0.5) / PARTS * m->h[1];
        sum += r * density_at(s, s->power == 2 ? hypot(r, z) : r);
        volume += r;
    }
    return sum / volume;
}

static void place_charge(fixture *f, int gas, bool ball)
{
    const double lower[3] = {0.0, -1.0, 0.0}, upper[3] = {burst, 2.0, 0.0};
    scene_body *b = fixture_box(f, gas, lower, upper, 1.0, (double)NAN, 1.0);
    if (!ball) return;
    const shape_model *model = shape_find("ball");
    b->shape.model = model;
    check_ok(f->ctx, scene_allocate(f->scene, &b->shape.par, model->param_size));
    fixture_param(model->params, model->n_params, b->shape.par, "radius", 0, burst);
}

/* L1 of the density over the reference's mean, up to r = 1 along both axes. */
static double blast_error(const radial *s, int cells)
{
    fixture f;
    const bool ball = s->power == 2;
    fixture_create(&f, 2, (const int[]){cells, ball ? cells : 2}, (const double[]){1.0, ball ? 1.0 : 2.0 / cells},
                   false);
    f.scene->mesh.geometry = MESH_AXISYMMETRIC;
    f.scene->bc.side[0][1].kind = BC_FREE;
    if (ball) f.scene->bc.side[1][1].kind = BC_FREE;
    const int gas = fixture_fluid(&f, "ideal", ratio, 1.0, 0.0);
    place_charge(&f, gas, ball);
    fixture_fill(&f, gas, 0.1, (double)NAN, 0.125);
    fixture_start(&f);
    fixture_run(&f, end_time);
    const block *b = &f.mesh.block[0];
    const double *rho = fixture_array(&f, C_RHO, 0, 0);
    double off = 0.0, sum = 0.0;
    for (int j = 0; j < b->n[1]; ++j)
        for (int i = 0; i < b->n[0]; ++i) {
            if (hypot(mesh_node(&f.mesh, 0, i + 1), ball ? mesh_node(&f.mesh, 1, j + 1) : 0.0) > 1.0) continue;
            const double mean = mean_density(s, &f.mesh, i, j), volume = mesh_cell_volume(&f.mesh, i);
            off += volume * fabs(rho[mesh_index(b, i, j, 0)] - mean);
            sum += volume * mean;
        }
    const double drift = fmax(ledger_drift(&f.ledger, LEDGER_MASS), ledger_drift(&f.ledger, LEDGER_ENERGY));
    printf("%s, %3d cells a unit: L1 of the density %.3f %% of its mean, drifts of mass and energy %.1e\n",
           ball ? "ball" : "cylinder", cells, 100.0 * off / sum, drift);
    check_true(drift <= 1e-13);
    fixture_destroy(&f);
    return off / sum;
}

/* Measured: 0.61 % and order 0.88 (cylinder), 0.53 % and 1.04 (ball); the reference itself changes by 0.05 % from half its cells. */
static void check_blast(int power, double limit, double slope)
{
    radial *s = malloc(sizeof *s);
    double h[3], error[3], coarse[REFERENCE / 2];
    assert_non_null(s);
    reference_run(s, REFERENCE / 2, power);
    for (int i = 0; i < REFERENCE / 2; ++i) coarse[i] = s->cell[i].rho;
    reference_run(s, REFERENCE, power);
    double change = 0.0, sum = 0.0;
    for (int i = 0; i < REFERENCE / 2; ++i) {
        const double mean = 0.5 * (s->cell[2 * i].rho + s->cell[2 * i + 1].rho),
                     r = pow((2.0 * i + 1.0) / REFERENCE, power);
        change += r * fabs(mean - coarse[i]);
        sum += r * mean;
    }
    for (int k = 0; k < 3; ++k) {
        h[k] = 1.0 / (25 << k);
        error[k] = blast_error(s, 25 << k);
    }
    const double order = fitted_order(3, h, error);
    printf("order %.2f; the reference changes by %.3f %% from %d cells\n", order, 100.0 * change / sum, REFERENCE / 2);
    check_true(change / sum <= 0.125 * error[2]);
    check_true(error[2] <= limit);
    check_true(order >= slope);
    free(s);
}

static void cylinder(void **state)
{
    (void)state;
    check_blast(1, 0.01, 0.8);
}

static void ball(void **state)
{
    (void)state;
    check_blast(2, 0.01, 0.8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cylinder), cmocka_unit_test(ball)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
