/* Every way of the registry to make normals: exact on lines and planes, a defined answer for any set of points, the same wherever on the
 * mesh and in whatever order the points stand, one side for all. */
#include "check.h"

#include "base/memory.h"
#include "math/tensor.h"
#include "surface/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* A set of points on a unit mesh of ten cells along each axis, and what a method makes of it. */
typedef struct trial {
    context *ctx;
    mesh m;
    surface_set set;
    const surface_method *method;
    double par[8];
    double *x;
    surface_estimate *e;
    size_t n;
} trial;

static void set_up(trial *t, const surface_method *method, int dim, size_t n)
{
    memset(t, 0, sizeof *t);
    t->ctx = context_create();
    mesh_spec spec = {.dim = dim};
    for (int a = 0; a < 3; ++a) {
        spec.upper[a] = 1.0;
        spec.cell[a] = 0.1;
    }
    check_ok(t->ctx, mesh_init(&t->m, t->ctx, &spec));
    surface_set_init(&t->set, t->ctx, &t->m);
    t->method = method;
    for (size_t k = 0; k < method->n_params; ++k)
        t->par[method->params[k].offset / sizeof(double)] = method->params[k].fallback;
    check_ok(t->ctx, memory_new(t->ctx, &t->x, 3 * n, sizeof *t->x));
    check_ok(t->ctx, memory_new(t->ctx, &t->e, n, sizeof *t->e));
    t->n = n;
}

static void find(trial *t)
{
    check_ok(t->ctx, surface_set_points(&t->set, t->n, t->x));
    surface_normals(&t->set, t->method, t->par, t->e);
    check_ok(t->ctx, surface_orient(&t->set, NULL, t->e));
}

static void tear_down(trial *t)
{
    memory_free(t->ctx, &t->x);
    memory_free(t->ctx, &t->e);
    surface_set_free(&t->set);
    context_destroy(&t->ctx);
}

typedef void method_test(const surface_method *m, int dim);

/* In a plane, and in space for those that need no connections. */
static void on_each(method_test *test)
{
    check_true(surface_registry_size > 0);
    for (size_t k = 0; k < surface_registry_size; ++k) {
        const surface_method *m = surface_registry[k];
        assert_ptr_equal(surface_find(m->name), m);
        assert_true(m->doc && m->cite && m->cite[0]);
        assert_true(m->param_size <= sizeof((trial *)0)->par);
        test(m, 2);
        if (!m->connected) test(m, 3);
    }
    assert_null(surface_find("no such way"));
}

/* Angle between two lines, whichever way they point. */
static double angle(const double a[3], const double b[3])
{
    double c[3];
    vec_cross(a, b, c);
    return atan2(vec_norm(c), fabs(vec_dot(a, b)));
}

/* ---- lines and planes ---- */

static void check_plane(const surface_method *m, int dim, const double normal[3])
{
    enum { ROW = 36 };
    trial t;
    double n[3], u[3], v[3] = {0.0, 0.0, 0.0}, worst = 0.0;
    memcpy(n, normal, sizeof n);
    vec_normalize(n);
    const double other[3] = {n[1], -n[0], dim == 3 ? 0.3 : 0.0};
    if (dim == 3) vec_cross(n, other, v);
    vec_normalize(v);
    if (dim == 3)
        vec_cross(v, n, u);
    else
        memcpy(u, other, sizeof u);
    vec_normalize(u);
    set_up(&t, m, dim, dim == 3 ? ROW * ROW : ROW);
    for (size_t k = 0; k < t.n; ++k) {
        double *x = t.x + 3 * k;
        for (int a = 0; a < dim; ++a) x[a] = 0.503 + 0.004 * a;
        vec_add_scaled((double)(k % ROW) / ROW - 0.49, u, x);
        if (dim == 3) vec_add_scaled((double)(k / ROW) / ROW - 0.49, v, x);
    }
    find(&t);
    for (size_t k = 0; k < t.n; ++k) worst = fmax(worst, angle(t.e[k].normal, n));
    if (!(worst < 1e-9)) print_error("%s in %d-D: %g rad\n", m->name, dim, worst);
    check_true(worst < 1e-9);
    tear_down(&t);
}

static void lines(const surface_method *m, int dim)
{
    if (!m->exact) return;
    static const double normal[][3] = {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.1, 1, 0}, {-10, 1, 0}, {2, 1, 0}};
    for (size_t k = 0; k < sizeof normal / sizeof normal[0]; ++k) {
        double n[3] = {normal[k][0], normal[k][1], dim == 3 ? 0.7 : 0.0};
        check_plane(m, dim, n);
        n[2] = 0.0;
        if (dim == 3) check_plane(m, dim, n);
    }
}

static void test_lines(void **unused)
{
    (void)unused;
    on_each(lines);
}

/* ---- sets that have no direction, or hardly one ---- */

enum { DEGENERATE_SETS = 11, DEGENERATE_POINTS = 25 };

/* Fills points of a set; how many they are. */
static size_t degenerate(int which, int dim, double x[][3])
{
    static const size_t count[DEGENERATE_SETS] = {1, 2, 12, 12, 12, 12, 12, 12, 3, 25, 13};
    uint64_t seed = 7;
    for (size_t k = 0; k < count[which]; ++k) {
        const double s = 0.01 * (double)k;
        for (int a = 0; a < 3; ++a) x[k][a] = a < dim ? 0.43 : 0.0;
        switch (which) {
        case 2: break;                                          /* all on one spot */
        case 3: x[k][0] = 0.401 + 0.5 * s; break;               /* along the mesh */
        case 4: x[k][0] = 0.4, x[k][1] = 0.41 + 0.5 * s; break; /* on a face of the cells */
        case 5: x[k][0] = x[k][1] = 0.4 + s; break;             /* along a diagonal, through corners */
        case 6: x[k][1] = 0.41 + s, x[k][0] += 1e-13 * (double)(k % 3); break;
        case 7: /* a heap */
            for (int a = 0; a < dim; ++a) x[k][a] += check_random(&seed, -0.02, 0.02);
            break;
        case 8: x[k][0] += 0.3 * (double)k; break; /* far from each other */
        case 9:                                    /* all over a face between cells */
            x[k][0] = 0.4;
            x[k][1] = dim == 3 ? 0.41 + 0.02 * (double)(k % 5) : 0.41 + 0.004 * (double)k;
            if (dim == 3) x[k][2] = 0.41 + 0.02 * (double)(k / 5);
            break;
        default: /* on a line, each twice but for the last */
            x[k][0] = 0.41 + 2.0 * 0.01 * (double)(k / 2);
            x[k][1] += x[k][0];
            break;
        }
    }
    return count[which];
}

static void degenerates(const surface_method *m, int dim)
{
    for (int which = 0; which < DEGENERATE_SETS; ++which) {
        double x[DEGENERATE_POINTS][3];
        const size_t n = degenerate(which, dim, x);
        trial t;
        set_up(&t, m, dim, n + 1);
        memcpy(t.x, x, n * sizeof x[0]);
        for (int a = 0; a < 3; ++a) t.x[3 * n + (size_t)a] = NAN; /* a point that is lost */
        find(&t);
        assert_int_equal(t.e[n].basis, SURFACE_NONE);
        for (size_t k = 0; k < n; ++k) {
            const double length = vec_norm(t.e[k].normal);
            check_close(length, t.e[k].basis == SURFACE_NONE ? 0.0 : 1.0, 1e-12);
            static const double none[3] = {0, 0, 0},
                                across[DEGENERATE_SETS][3] = {[3] = {0, 1, 0}, [4] = {1, 0, 0}, [5] = {1, -1, 0},
                                                              [6] = {1, 0, 0}, [9] = {1, 0, 0}, [10] = {1, -1, 0}};
            const bool known = memcmp(across[which], none, sizeof none) != 0 && (dim == 2 || which == 9);
            if (!known || !m->exact || (m->connected && which > 8)) continue; /* in no order */
            const bool right = t.e[k].basis != SURFACE_NONE && angle(t.e[k].normal, across[which]) < 1e-6;
            if (!right)
                print_error("%s in %d-D, set %d: %g rad off\n", m->name, dim, which,
                            angle(t.e[k].normal, across[which]));
            check_true(right);
        }
        tear_down(&t);
    }
}

static void test_degenerate(void **unused)
{
    (void)unused;
    on_each(degenerates);
}

/* ---- circles and spheres ---- */

/* Points on a circle or a sphere, evenly (the sphere by Fibonacci's spiral), in the order `step` k modulo n. */
static void put_sphere(trial *t, int dim, const double centre[3], double radius, size_t step)
{
    for (size_t k = 0; k < t->n; ++k) {
        const double i = (double)(k * step % t->n) + 0.5, n = (double)t->n;
        double *x = t->x + 3 * k, z = 1.0 - 2.0 * i / n;
        const double phi = dim == 3 ? pi * (1.0 + sqrt(5.0)) * i : 2.0 * pi * i / n,
                     r = dim == 3 ? sqrt(1.0 - z * z) : 1.0;
        x[0] = centre[0] + radius * r * cos(phi);
        x[1] = centre[1] + radius * r * sin(phi);
        x[2] = dim == 3 ? centre[2] + radius * z : 0.0;
    }
}

/* All point outwards, or with the reference, inwards; and are within half a right angle. */
static void sides(const surface_method *m, int dim)
{
    const double centre[3] = {0.513, 0.491, 0.502};
    trial t;
    set_up(&t, m, dim, dim == 3 ? 2400 : 140);
    put_sphere(&t, dim, centre, 0.31, 1);
    find(&t);
    double *inwards;
    check_ok(t.ctx, memory_new(t.ctx, &inwards, 3 * t.n, sizeof *inwards));
    for (int turn = 0; turn < 2; ++turn) {
        size_t wrong = 0;
        double area = 0.0;
        for (size_t k = 0; k < t.n; ++k) {
            double out[3];
            for (int a = 0; a < 3; ++a) out[a] = a < dim ? (t.x[3 * k + (size_t)a] - centre[a]) / 0.31 : 0.0;
            const double along = vec_dot(out, t.e[k].normal) * (turn == 0 ? 1.0 : -1.0);
            if (!(along > 0.0)) wrong++;
            if (!isnan(t.e[k].curvature)) {
                check_close_relative(t.e[k].curvature * (turn == 0 ? 1.0 : -1.0), (dim - 1) / 0.31, 0.02);
                area += t.e[k].area;
            }
            /* one point in three says what it was */
            for (int a = 0; a < 3; ++a) inwards[3 * k + (size_t)a] = k % 3 == 0 ? -out[a] : 0.0;
        }
        if (m->exact) assert_int_equal(wrong, 0);
        if (area > 0.0) check_close_relative(area, dim == 3 ? 4.0 * pi * 0.31 * 0.31 : 2.0 * pi * 0.31, 0.01);
        if (turn == 0) check_ok(t.ctx, surface_orient(&t.set, inwards, t.e));
    }
    memory_free(t.ctx, &inwards);
    tear_down(&t);
}

static void test_sides(void **unused)
{
    (void)unused;
    on_each(sides);
}

/* A cell further on, and in another order. The bound is round-off times the worst condition that is taken for fair. */
static void places(const surface_method *m, int dim)
{
    const double centre[3] = {0.513, 0.491, 0.502}, moved[3] = {0.613, 0.391, 0.502};
    const size_t n = dim == 3 ? 801 : 101; /* no multiple of the step */
    for (int change = 0; change < 2; ++change) {
        if (change == 1 && m->connected) continue;
        trial a, b;
        set_up(&a, m, dim, n);
        set_up(&b, m, dim, n);
        const size_t step = change == 1 ? 2 : 1;
        put_sphere(&a, dim, centre, 0.29, 1);
        put_sphere(&b, dim, change == 0 ? moved : centre, 0.29, step);
        find(&a);
        find(&b);
        for (size_t k = 0; k < n; ++k)
            for (int c = 0; c < 3; ++c) check_close(b.e[k].normal[c], a.e[k * step % n].normal[c], 1e-6);
        tear_down(&a);
        tear_down(&b);
    }
}

static void test_places(void **unused)
{
    (void)unused;
    on_each(places);
}

/* A quarter between two mirrors has the normals of the whole. */
static void test_mirrors(void **unused)
{
    (void)unused;
    static const char *const name[] = {"quadric"};
    trial whole, quarter;
    set_up(&whole, surface_find(name[0]), 2, 160);
    set_up(&quarter, surface_find(name[0]), 2, 40);
    const double middle[3] = {0.5, 0.5, 0.0}, corner[3] = {0.0, 0.0, 0.0};
    put_sphere(&whole, 2, middle, 0.45, 1);
    put_sphere(&quarter, 2, corner, 0.45, 1);
    for (size_t k = 0; k < 40; ++k)
        for (int a = 0; a < 2; ++a) quarter.x[3 * k + (size_t)a] = whole.x[3 * k + (size_t)a] - 0.5;
    quarter.set.mirror[0][SIDE_LOWER] = quarter.set.mirror[1][SIDE_LOWER] = true;
    find(&whole);
    find(&quarter);
    for (size_t k = 0; k < 40; ++k) {
        for (int a = 0; a < 2; ++a) check_close(quarter.e[k].normal[a], whole.e[k].normal[a], 1e-12);
        check_close_relative(quarter.e[k].curvature, 1.0 / 0.45, 1e-2);
    }
    tear_down(&whole);
    tear_down(&quarter);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines),  cmocka_unit_test(test_degenerate), cmocka_unit_test(test_sides),
        cmocka_unit_test(test_places), cmocka_unit_test(test_mirrors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
