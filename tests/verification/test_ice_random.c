/* Cells with random states in a periodic box: nothing is lost or made, and axes that are exchanged, or run the other way, exchange and turn the
 * results. One gas and two, in every number of dimensions, by every way to step them. */
#include "ice_fixture.h"

enum { MOST_CELLS = 12 * 12 };

typedef struct way {
    const char *name;
    ice_limiter limiter;
    pressure_scheme pressure;
    bool internal_energy;
    ice_centring centring;
    double viscosity, exchange; /* of both fluids, Pa s; between them */
    bool walls;                 /* about the box, which is periodic otherwise */
    bool open;                  /* these, some with a temperature, or sides of other kinds */
} way;

/* A turn of the axes: axis a of the new box is axis (a + shift) of the old one, the other way round where bit a of `mirrors` is set. */
typedef struct turn {
    int shift, mirrors;
} turn;

static bool mirrors(const turn *t, int a)
{
    return t->mirrors >> a & 1;
}

static void old_cell(const turn *t, int dim, int n, const int at[3], int old[3])
{
    old[0] = old[1] = old[2] = 0;
    for (int a = 0; a < dim; ++a) old[(a + t->shift) % dim] = mirrors(t, a) ? n - 1 - at[a] : at[a];
}

/* In [-1, 1), of a cell and a quantity. */
static double noise(const int cell[3], int what)
{
    uint64_t seed = (uint64_t)(cell[0] + 100 * (cell[1] + 100 * (cell[2] + 100 * what)) + 12345);
    return check_random(&seed, -1.0, 1.0);
}

static int cells_along(int dim)
{
    return dim == 1 ? 40 : dim == 2 ? 9 : 5;
}

/* Values of a quantity at each cell of the box. */
static void for_cells(const fixture *f,
                      void (*visit)(const fixture *f, const int at[3], ptrdiff_t index, const turn *t, double *out),
                      const turn *t, double *out)
{
    const block *b = &f->mesh.block[0];
    for (int k = 0; k < b->n[2]; ++k)
        for (int j = 0; j < b->n[1]; ++j)
            for (int i = 0; i < b->n[0]; ++i) visit(f, (const int[]){i, j, k}, mesh_index(b, i, j, k), t, out);
}

static const double heat_capacity[2] = {700.0, 900.0}, ratio[2] = {1.4, 1.25};

static void set_cell(const fixture *f, const int at[3], ptrdiff_t index, const turn *t, double *unused)
{
    const int dim = f->mesh.dim, fluids = f->ice->n_materials;
    int old[3];
    (void)unused;
    old_cell(t, dim, cells_along(dim), at, old);
    const double p = 1e5 * (1.0 + 0.2 * noise(old, 0)), T = 300.0 * (1.0 + 0.1 * noise(old, 1)),
                 share = 0.5 + 0.4 * noise(old, 2);
    for (int r = 0; r < fluids; ++r) {
        const double density = p / ((ratio[r] - 1.0) * heat_capacity[r] * T);
        const double fraction = fluids == 1 ? 1.0 : r == 0 ? share : 1.0 - share;
        fixture_array(f, C_RHO, r, 0)[index] = fraction * density;
        fixture_array(f, C_ENERGY, r, 0)[index] = heat_capacity[r] * T;
        if (fluids > 1) fixture_array(f, C_VOL, r, 0)[index] = 1.0 / density;
        for (int a = 0; a < dim; ++a) {
            const int from = (a + t->shift) % dim;
            fixture_array(f, C_VEL, r, a)[index] =
                (mirrors(t, a) ? -1.0 : 1.0) * (100.0 * noise(old, 3 + from) + 20.0 * r * noise(old, 6 + from));
        }
    }
    fixture_array(f, C_PRESSURE, 0, 0)[index] = p;
}

enum { HELD = 5 }; /* of a fluid: density, energy, velocities */

/* What a cell has come to, told in the first box. */
static void get_cell(const fixture *f, const int at[3], ptrdiff_t index, const turn *t, double *out)
{
    const int dim = f->mesh.dim, n = cells_along(dim);
    int old[3];
    old_cell(t, dim, n, at, old);
    double *cell = out + (size_t)HELD * 2 * (size_t)(old[0] + n * (old[1] + (dim > 2 ? n : 0) * old[2]));
    for (int r = 0; r < f->ice->n_materials; ++r) {
        cell[HELD * r] = fixture_array(f, C_RHO, r, 0)[index];
        cell[HELD * r + 1] = fixture_array(f, C_ENERGY, r, 0)[index] / 1e5;
        for (int a = 0; a < dim; ++a)
            cell[HELD * r + 2 + (a + t->shift) % dim] =
                (mirrors(t, a) ? -1.0 : 1.0) * fixture_array(f, C_VEL, r, a)[index] / 100.0;
    }
}

/* Sides of every kind, by axis and end of the first box. */
static void set_sides(fixture *f, const turn *t)
{
    static const bc_side kinds[3][2] = {
        {{.kind = BC_INLET, .velocity = {60.0, 10.0, -20.0}, .pressure = 1e5, .temperature = 320.0},
         {.kind = BC_OUTLET, .pressure = 0.9e5, .temperature = 290.0}},
        {{.kind = BC_NO_SLIP, .velocity = {30.0, 0.0, -10.0}, .temperature = 400.0},
         {.kind = BC_NON_REFLECTING, .velocity = {10.0, 20.0, 5.0}, .pressure = 1.1e5, .temperature = 280.0}},
        {{.kind = BC_VELOCITY, .velocity = {0.0, 0.0, 15.0}, .temperature = (double)NAN},
         {.kind = BC_RESERVOIR, .pressure = 1.2e5, .temperature = 310.0}}};
    const int dim = f->scene->mesh.dim;
    for (int a = 0; a < dim; ++a)
        for (int side = 0; side < 2; ++side) {
            const bc_side *old = &kinds[(a + t->shift) % dim][mirrors(t, a) ? 1 - side : side];
            bc_side *to = &f->scene->bc.side[a][side];
            *to = *old;
            to->material = old->kind == BC_NO_SLIP || old->kind == BC_VELOCITY ? -1 : 0;
            for (int c = 0; c < dim; ++c)
                to->velocity[c] = (mirrors(t, c) ? -1.0 : 1.0) * old->velocity[(c + t->shift) % dim];
        }
}

/* Edges of a cell of the first box, of a tenth. */
static const double edge[3] = {1.0, 1.3, 0.8};

/* Runs a few steps of a box; false: what it holds in all has changed. */
static void run_box(int dim, int fluids, const way *w, const turn *t, double *out)
{
    fixture f;
    const int n = cells_along(dim), cells[3] = {n, n, n};
    double length[3] = {0.0};
    for (int a = 0; a < dim; ++a) length[a] = 0.1 * n * edge[(a + t->shift) % dim];
    fixture_create(&f, dim, cells, length, !w->walls);
    if (w->open) set_sides(&f, t);
    for (int r = 0; r < fluids; ++r) fixture_fluid(&f, "ideal", ratio[r], heat_capacity[r], 0.0);
    for (int r = 0; r < fluids; ++r) { /* the states below stand for these */
        const double size = length[0], far = 2.0 * (length[0] + length[1] + length[2]);
        const double lo[3] = {r == 0 ? -1.0 : 0.5 * size, -1.0, -1.0},
                     hi[3] = {r + 1 == fluids ? far : 0.5 * size, far, far};
        scene_material *m = &f.scene->material[r];
        fixture_box(&f, r, lo, hi, 1e5, 300.0, (double)NAN);
        m->shear_viscosity = w->viscosity;
        m->bulk_viscosity = 0.5 * w->viscosity;
        m->conductivity = 1e3 * w->viscosity;
    }
    f.scene->method.limiter = w->limiter;
    f.scene->method.pressure = w->pressure;
    f.scene->method.conserve_energy = !w->internal_energy;
    f.scene->method.centring = w->centring;
    f.scene->method.exchange = w->exchange;
    fixture_start(&f);
    for_cells(&f, set_cell, t, NULL);
    fixture_account(&f, &f.ledger);
    memcpy(f.ledger.initial, f.ledger.total, sizeof f.ledger.initial);
    for (int k = 0; k < 3; ++k) check_ok(f.ctx, fixture_try(&f, 3e-5));
    fixture_account(&f, &f.ledger);
    for (int q = LEDGER_MASS; q <= LEDGER_ENERGY; ++q) {
        const bool kept = q != LEDGER_ENERGY || !w->internal_energy; /* what sides give is in the ledger */
        if (kept) check_close(ledger_drift(&f.ledger, (ledger_quantity)q), 0.0, 1e-14);
    }
    for_cells(&f, get_cell, t, out);
    fixture_destroy(&f);
}

static void boxes_keep_and_turn(void **unused)
{
    (void)unused;
    static const way ways[] = {
        {"waves", ICE_LIMITER_DEFAULT, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 0.0, 1e12, false, false},
        {"van Leer", ICE_LIMITER_VAN_LEER, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 0.0, 1e12, false, false},
        {"half", ICE_LIMITER_NONE, PRESSURE_EXPLICIT, false, ICE_CENTRING_HALF, 0.0, 1e12, false, false},
        {"first order", ICE_LIMITER_FIRST_ORDER, PRESSURE_EXPLICIT, false, ICE_CENTRING_FULL, 0.0, 1e12, false, false},
        {"internal", ICE_LIMITER_VAN_LEER, PRESSURE_EXPLICIT, true, ICE_CENTRING_AUTO, 0.0, 1e12, false, false},
        {"viscous", ICE_LIMITER_DEFAULT, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 1.0, 1e12, false, false},
        {"locked", ICE_LIMITER_DEFAULT, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 1.0, (double)NAN, false, false},
        {"locked, van Leer", ICE_LIMITER_VAN_LEER, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 1.0, (double)NAN, true,
         false},
        {"locked, implicit", ICE_LIMITER_VAN_LEER, PRESSURE_IMPLICIT, false, ICE_CENTRING_AUTO, 1.0, (double)NAN, true,
         false},
        {"drag", ICE_LIMITER_DEFAULT, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 0.0, 1e4, false, false},
        {"slip", ICE_LIMITER_VAN_LEER, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 0.0, 0.0, false, false},
        {"sides", ICE_LIMITER_DEFAULT, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 1.0, 1e12, true, true},
        {"sides, van Leer", ICE_LIMITER_VAN_LEER, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 0.5, 1e4, true, true},
        {"sides, implicit", ICE_LIMITER_VAN_LEER, PRESSURE_IMPLICIT, false, ICE_CENTRING_AUTO, 0.5, 1e12, true, true},
        {"walls", ICE_LIMITER_DEFAULT, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 1.0, 1e12, true, false},
        {"walls, van Leer", ICE_LIMITER_VAN_LEER, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 0.0, 1e4, true, false},
        {"implicit", ICE_LIMITER_VAN_LEER, PRESSURE_IMPLICIT, false, ICE_CENTRING_AUTO, 0.0, 1e12, false, false},
    };
    static double first[MOST_CELLS * 2 * HELD], turned[MOST_CELLS * 2 * HELD];
    for (int dim = 1; dim <= 3; ++dim)
        for (int fluids = 1; fluids <= 2; ++fluids)
            for (size_t k = 0; k < sizeof ways / sizeof *ways; ++k) {
                memset(first, 0, sizeof first);
                run_box(dim, fluids, &ways[k], &(const turn){0, 0}, first);
                /* Corners between sides of unlike kinds are those of the last axis: these are mirrored along each, and not exchanged. */
                for (int n = 0; n < (ways[k].open ? dim : 2 * dim); ++n) {
                    const turn t = {ways[k].open ? 0 : n / 2, ways[k].open ? 1 << n : n % 2};
                    double worst = 0.0;
                    memset(turned, 0, sizeof turned);
                    run_box(dim, fluids, &ways[k], &t, turned);
                    for (size_t i = 0; i < sizeof first / sizeof *first; ++i)
                        worst = fmax(worst, fabs(turned[i] - first[i]));
                    check_close(worst, 0.0,
                                ways[k].pressure == PRESSURE_IMPLICIT ? 4e-12
                                : ways[k].open                        ? 1e-13
                                                                      : 1e-14);
                }
            }
}

/* Amplitudes of pressure over rho c, and of velocity, of a wave of so many to the box, each as cosine and sine. */
static void wave_of(const fixture *f, int waves, double c, double out[4])
{
    const block *b = &f->mesh.block[0];
    for (int k = 0; k < 4; ++k) out[k] = 0.0;
    for (int i = 0; i < b->n[0]; ++i) {
        const ptrdiff_t at = mesh_index(b, i, 0, 0);
        const double angle = 2.0 * acos(-1.0) * waves * (i + 0.5) / b->n[0], part = 2.0 / b->n[0];
        const double rho = fixture_array(f, C_RHO, 0, 0)[at], e = fixture_array(f, C_ENERGY, 0, 0)[at],
                     u = fixture_array(f, C_VEL, 0, 0)[at];
        const double p = (0.4 * rho * e - 1e5) / (1e5 * 1.4 / c);
        out[0] += part * p * cos(angle);
        out[1] += part * p * sin(angle);
        out[2] += part * u * cos(angle);
        out[3] += part * u * sin(angle);
    }
}

/* The determinant of what a step does to a small wave of sound: 1 - 2 l^2 s^4 centred at half the step, 1 - 4 l^2 s^2 at its end, with l = c dt/h and s the sine of half
 * the angle between cells (theory 2.5); there the viscosity of shocks, 0.3 rho c of the velocity's jump over a cell, acts on the half of the wave that is
 * compressed (theory 2.8). */
static double determinant(pressure_scheme pressure, ice_centring centring, int waves, double courant)
{
    enum { CELLS = 24 };
    const double small = 1e-7, rho0 = 1.16, c = sqrt(1.4 * 1e5 / rho0), length = 1.0;
    double end[2][4], start[2][4];
    for (int kind = 0; kind < 2; ++kind) {
        fixture f;
        fixture_create(&f, 1, (const int[]){CELLS}, &length, true);
        fixture_fluid(&f, "ideal", 1.4, 717.5, 0.0);
        fixture_fill(&f, 0, 1e5, 300.0, rho0);
        f.scene->method.limiter = ICE_LIMITER_FIRST_ORDER;
        f.scene->method.centring = centring;
        f.scene->method.pressure = pressure;
        fixture_start(&f);
        for (int i = 0; i < CELLS; ++i) {
            const ptrdiff_t at = mesh_index(&f.mesh.block[0], i, 0, 0);
            const double angle = 2.0 * acos(-1.0) * waves * (i + 0.5) / CELLS,
                         p = kind == 0 ? 1.4 * small * cos(angle) : 0.0;
            const double rho = rho0 * pow(1.0 + p, 1.0 / 1.4);
            fixture_array(&f, C_RHO, 0, 0)[at] = rho;
            fixture_array(&f, C_ENERGY, 0, 0)[at] = 1e5 * (1.0 + p) / (0.4 * rho);
            fixture_array(&f, C_VEL, 0, 0)[at] = kind == 1 ? small * c * sin(angle) : 0.0;
        }
        wave_of(&f, waves, c, start[kind]);
        check_ok(f.ctx, fixture_try(&f, courant / CELLS / c));
        wave_of(&f, waves, c, end[kind]);
        fixture_destroy(&f);
    }
    return (end[0][0] * end[1][3] - end[0][3] * end[1][0]) / (start[0][0] * start[1][3]);
}

/* Of the implicit pressure: u* = (c u - 2 i s phi l p)/D, dP = -2 i s l u*, with D = 1 + (2 s phi l)^2 and c the cosine of half the angle. */
static double implicit_determinant(double phi, double s, double courant)
{
    const double x = 4.0 * s * s * courant * courant, D = 1.0 + x * phi * phi, c2 = 1.0 - s * s;
    return (1.0 - x * phi / D) * (1.0 - x * c2 * phi / D) + x * c2 / (D * D);
}

static void waves_are_centred(void **unused)
{
    (void)unused;
    for (int waves = 1; waves < 12; waves += 2)
        for (double courant = 0.1; courant < 0.7; courant += 0.25) {
            const double s = sin(acos(-1.0) * waves / 24.0), jump = sin(2.0 * acos(-1.0) * waves / 24.0),
                         l2 = courant * courant;
            for (int full = 0; full < 2; ++full) /* u* and the pressure solved for together (theory 3) */
                check_close(
                    determinant(PRESSURE_IMPLICIT, full ? ICE_CENTRING_FULL : ICE_CENTRING_HALF, waves, courant),
                    implicit_determinant(full ? 1.0 : 0.5, s, courant), 1.2e-7);
            /* To the size of the wave. */
            check_close(determinant(PRESSURE_EXPLICIT, ICE_CENTRING_HALF, waves, courant),
                        1.0 - 2.0 * l2 * s * s * s * s, 2.5e-6);
            check_close(determinant(PRESSURE_EXPLICIT, ICE_CENTRING_FULL, waves, courant),
                        1.0 - 4.0 * l2 * s * s - 0.5 * 0.3 * courant * jump * jump, 2e-6);
        }
}

/* What a step leaves of a shear wave along one axis, of the velocity along another: by the rule of the middle 1 - x + x^2/2, with x = 4 mu dt/(rho h^2) s^2
 * of second differences (theory 2.6). */
static double left_of_shear(int dim, int along, int component, const way *w, double dt)
{
    enum { CELLS = 8 };
    const double rho = 2.0, small = 1e-4, length[3] = {0.8, 0.8, 0.8};
    double before = 0.0, after = 0.0;
    fixture f;
    fixture_create(&f, dim, (const int[]){CELLS, CELLS, CELLS}, length, true);
    fixture_fluid(&f, "ideal", 1.4, 717.5, 0.0);
    f.scene->material[0].shear_viscosity = w->viscosity;
    fixture_fill(&f, 0, 1e5, 300.0, rho);
    f.scene->method.limiter = w->limiter;
    f.scene->method.pressure = w->pressure;
    fixture_start(&f);
    const block *b = &f.mesh.block[0];
    for (int pass = 0; pass < 2; ++pass) {
        for (int k = 0; k < b->n[2]; ++k)
            for (int j = 0; j < b->n[1]; ++j)
                for (int i = 0; i < b->n[0]; ++i) {
                    const double wave = sin(2.0 * acos(-1.0) * ((const int[]){i, j, k}[along] + 0.3) / CELLS);
                    double *u = &fixture_array(&f, C_VEL, 0, component)[mesh_index(b, i, j, k)];
                    if (pass == 0) *u = small * wave;
                    *(pass == 0 ? &before : &after) += *u * wave;
                }
        if (pass == 0) check_ok(f.ctx, fixture_try(&f, dt));
    }
    fixture_destroy(&f);
    return after / before;
}

static void shear_is_diffused(void **unused)
{
    (void)unused;
    static const way ways[] = {
        {"waves", ICE_LIMITER_DEFAULT, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 3.0, 0.0, false, false},
        {"van Leer", ICE_LIMITER_VAN_LEER, PRESSURE_EXPLICIT, false, ICE_CENTRING_AUTO, 3.0, 0.0, false, false},
        {"implicit", ICE_LIMITER_VAN_LEER, PRESSURE_IMPLICIT, false, ICE_CENTRING_AUTO, 3.0, 0.0, false, false},
    };
    const double dt = 1e-4, s = sin(acos(-1.0) / 8.0);
    for (int dim = 2; dim <= 3; ++dim)
        for (int along = 0; along < dim; ++along)
            for (int component = 0; component < dim; ++component)
                for (int k = 0; k < 3 && component != along; ++k) {
                    const double x = 4.0 * ways[k].viscosity * dt / (2.0 * 0.01) * s * s;
                    check_close(left_of_shear(dim, along, component, &ways[k], dt), 1.0 - x + 0.5 * x * x, 4e-15);
                }
}

/* What comes in through a side in a step is no more than a cell, at every side, by its own axis; the message says where. */
static void inlets_are_bounded(void **unused)
{
    (void)unused;
    const double dt = 1e-4, length[3] = {0.4, 0.6, 0.8};
    for (int dim = 1; dim <= 3; ++dim)
        for (int k = 0; k < 4 * dim; ++k) {
            const int axis = k / 4, side = k / 2 % 2;
            const bool fast = k % 2;
            fixture f;
            char where[64];
            fixture_create(&f, dim, (const int[]){4, 4, 4}, length, false);
            fixture_fluid(&f, "ideal", 1.4, 717.5, 0.0);
            fixture_fill(&f, 0, 1e5, 300.0, (double)NAN);
            bc_side *inlet = &f.scene->bc.side[axis][side];
            *inlet = (bc_side){.kind = BC_INLET, .pressure = 1e5, .temperature = 300.0, .material = 0};
            inlet->velocity[axis] = (side == 0 ? 1.0 : -1.0) * (fast ? 1.01 : 0.3) * length[axis] / 4.0 / dt;
            fixture_start(&f);
            const floe_status status = fixture_try(&f, dt);
            (void)snprintf(where, sizeof where, "%s side of axis %d crosses more than a cell",
                           side == 0 ? "lower" : "upper", axis);
            assert_int_equal(strstr(context_message(f.ctx), where) != NULL, fast);
            if (fast) assert_int_equal(status, FLOE_RETRY);
            context_clear(f.ctx);
            fixture_destroy(&f);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(boxes_keep_and_turn), cmocka_unit_test(waves_are_centred),
                                       cmocka_unit_test(shear_is_diffused), cmocka_unit_test(inlets_are_bounded)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
