/* Polygons, solids of revolution and compounds: volumes and centroids against exact ones, sides in common, what is refused, and the
 * points and surfaces that are made of them. */
#include "shape_fixture.h"

#include "geom/compound.h"
#include "geom/contour.h"
#include "geom/seed.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static int set_up(void **state)
{
    static maker m;
    maker_begin(&m);
    *state = &m;
    return 0;
}

static int tear_down(void **state)
{
    maker_end(*state);
    return 0;
}

static shape new_shape(maker *m, const char *name)
{
    shape s = {.model = shape_find(name)};
    check_true(s.model != NULL);
    check_ok(m->ctx, allocate(m, &s.par, s.model->param_size));
    param_fill_defaults(s.model->params, s.model->n_params, s.par);
    return s;
}

static void set_vector(shape *s, const char *key, int n, const double *x)
{
    memcpy(param_find(s->model->params, s->model->n_params, s->par, key), x, (size_t)n * sizeof *x);
}

static void set_field(shape *s, const char *key, const void *field, size_t size)
{
    for (size_t k = 0; k < s->model->n_params; k++) {
        const param_spec *spec = &s->model->params[k];
        if (spec->key ? key && strcmp(spec->key, key) == 0 : !key) memcpy((char *)s->par + spec->offset, field, size);
    }
}

static shape made_ready(maker *m, shape s, int dim)
{
    check_ok(m->ctx, shape_prepare(&s, dim, &(shape_memory){m->ctx, allocate, m}, m->why));
    return s;
}

static shape sound(maker *m, shape s, int dim)
{
    made_ready(m, s, dim);
    if (m->why[0]) print_error("%s\n", m->why);
    check_true(m->why[0] == '\0');
    return s;
}

static shape make_box(maker *m, int dim, const double *lower, const double *upper)
{
    shape s = new_shape(m, "box");
    set_vector(&s, "lower", dim, lower);
    set_vector(&s, "upper", dim, upper);
    return sound(m, s, dim);
}

#define BOX2(x0, y0, x1, y1) make_box(m, 2, (const double[]){x0, y0}, (const double[]){x1, y1})

static shape make_list(maker *m, const char *name, int dim, const shape *part, size_t n)
{
    shape s = new_shape(m, name);
    param_list list = {.n = n};
    check_ok(m->ctx, allocate(m, &list.item, n * sizeof *part));
    memcpy(list.item, part, n * sizeof *part);
    set_field(&s, NULL, &list, sizeof list);
    return sound(m, s, dim);
}

static shape make_difference(maker *m, int dim, shape of, shape without)
{
    shape s = new_shape(m, "difference");
    param_list list = {.n = 1};
    check_ok(m->ctx, allocate(m, &list.item, sizeof without));
    memcpy(list.item, &without, sizeof without);
    set_field(&s, "of", &of, sizeof of);
    set_field(&s, "without", &list, sizeof list);
    return sound(m, s, dim);
}

static shape unchecked_polygon(maker *m, const double (*x)[2], size_t n)
{
    shape s = new_shape(m, "polygon");
    double(*v)[3] = NULL;
    check_ok(m->ctx, allocate(m, &v, n * sizeof *v));
    for (size_t k = 0; k < n; k++) memcpy(v[k], x[k], sizeof x[k]);
    const param_list list = {v, n};
    set_field(&s, "vertices", &list, sizeof list);
    return made_ready(m, s, 2);
}

static shape make_polygon(maker *m, const double (*x)[2], size_t n)
{
    const shape s = unchecked_polygon(m, x, n);
    check_true(m->why[0] == '\0');
    return s;
}

static const double corners_of_l[6][2] = {{0.21, 0.2},  {0.83, 0.2},  {0.83, 0.41},
                                          {0.43, 0.41}, {0.43, 0.77}, {0.21, 0.77}};

enum { STAR = 14 };

static void make_star(double x[STAR][2])
{
    for (int k = 0; k < STAR; k++) {
        const double angle = 0.3 + 2.0 * pi * k / STAR, r = k % 2 ? 0.41 : 0.17;
        x[k][0] = 0.52 + r * cos(angle);
        x[k][1] = 0.49 + r * sin(angle);
    }
}

/* Integrals over the polygon of 1, x, y, x^2, x y by the sums over its sides. */
static void shoelace(const double (*x)[2], size_t n, double out[5])
{
    memset(out, 0, 5 * sizeof *out);
    for (size_t k = 0, last = n - 1; k < n; last = k++) {
        const double *a = x[last], *b = x[k], cross = a[0] * b[1] - b[0] * a[1];
        out[0] += cross / 2.0;
        out[1] += cross * (a[0] + b[0]) / 6.0;
        out[2] += cross * (a[1] + b[1]) / 6.0;
        out[3] += cross * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) / 12.0;
        out[4] += cross * (a[0] * b[1] + 2.0 * a[0] * a[1] + 2.0 * b[0] * b[1] + b[0] * a[1]) / 24.0;
    }
}

/* Sums over the boxes of a mesh of the unit square. */
static void sum_boxes(const shape *s, int n, bool radial, double out[3])
{
    memset(out, 0, 3 * sizeof *out);
    for (int k = 0; k < n * n; k++) {
        const double lo[3] = {(double)(k % n) / n, (double)(k / n) / n},
                     hi[3] = {(double)(k % n + 1) / n, (double)(k / n + 1) / n};
        double centroid[3];
        const double share = shape_fraction(s, 2, lo, hi, radial, 6, centroid);
        const double volume = share / n / n * (radial ? 0.5 * (lo[0] + hi[0]) : 1.0);
        check_true(share >= 0.0 && share <= 1.0 + 1e-13);
        out[0] += volume;
        out[1] += volume * centroid[0];
        out[2] += volume * centroid[1];
    }
}

static void check_polygon(maker *m, const double (*x)[2], size_t n)
{
    const shape s = make_polygon(m, x, n);
    double exact[5], plane[3], radial[3];
    shoelace(x, n, exact);
    const double sign = exact[0] < 0.0 ? -1.0 : 1.0;
    sum_boxes(&s, 9, false, plane);
    sum_boxes(&s, 9, true, radial);
    for (int k = 0; k < 3; k++) check_close(plane[k], sign * exact[k], 1e-15);
    check_close(radial[0], sign * exact[1], 1e-15);
    check_close(radial[1], sign * exact[3], 1e-15);
    check_close(radial[2], sign * exact[4], 1e-15);
}

/* Areas and centroids, in the plane and about an axis, to round-off: either way round. */
static void test_polygons(void **state)
{
    maker *m = *state;
    double star[STAR][2], back[STAR][2];
    make_star(star);
    for (int k = 0; k < STAR; k++) memcpy(back[k], star[STAR - 1 - k], sizeof back[k]);
    check_polygon(m, corners_of_l, 6);
    check_polygon(m, (const double(*)[2])star, STAR);
    check_polygon(m, (const double(*)[2])back, STAR);
    check_polygon(m, (const double[][2]){{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, 3);
}

/* Its sides are where they are: distances from a square and a star, by brute force. */
static void test_polygon_level(void **state)
{
    maker *m = *state;
    double x[STAR][2];
    make_star(x);
    const shape s = make_polygon(m, (const double(*)[2])x, STAR);
    for (int i = 0; i < 400; i++) {
        const double at[3] = {0.05 * (i % 20) + 0.013, 0.05 * (double)(i / 20) + 0.017, 0.0};
        double nearest = HUGE_VAL;
        for (int k = 0; k < STAR * 1000; k++) {
            const double *a = x[k / 1000], *b = x[(k / 1000 + 1) % STAR], t = (k % 1000) / 1000.0;
            nearest = fmin(nearest, hypot(a[0] + t * (b[0] - a[0]) - at[0], a[1] + t * (b[1] - a[1]) - at[1]));
        }
        check_close(fabs(s.model->level(s.par, 2, at)), nearest, 3e-4);
    }
}

typedef struct wrong_polygon {
    double x[6][2];
    size_t n;
    const char *word;
} wrong_polygon;

static void test_refused_polygons(void **state)
{
    static const wrong_polygon wrong[] = {
        {{{0, 0}, {1, 1}, {1, 0}, {0, 1}},
         4,
         "side 1, from (0, 0) to (1, 1), meets side 3, from (1, 0) to (0, 1), at (0.5, 0.5)"},
        {{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, 4, "vertices 2 and 3 are one, (1, 0)"},
        {{{0, 0}, {1, 0}, {1, 1}, {0, 0}}, 4, "vertices 4 and 1 are one, (0, 0)"},
        {{{0, 0}, {1, 0}, {0.5, 0}, {0, 1}}, 4, "runs back over itself at vertex 2, (1, 0)"},
        {{{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}, 5, "at (1, 0)"},
        {{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 0.5}, {0.5, 0.5}}, 6, "at (1, 0.5)"},
        {{{0, 0}, {1, 0}, {2, 0}}, 3, "runs back over itself"},
    };
    maker *m = *state;
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        unchecked_polygon(m, wrong[k].x, wrong[k].n);
        if (!strstr(m->why, wrong[k].word)) print_error("'%s' has no '%s'\n", m->why, wrong[k].word);
        check_true(strstr(m->why, wrong[k].word) != NULL);
    }
}

/* ---- compounds ---- */

static double area_of(const shape *s)
{
    double sum[3];
    sum_boxes(s, 10, false, sum);
    return sum[0];
}

/* Area that the closed chains of a contour surround. */
static double contour_area(maker *m, const shape *s, int cells, int *chains)
{
    const seed_spec grid = {.dim = 2, .h = {1.0 / cells, 1.0 / cells}, .n = {cells, cells, 1}};
    contour o;
    double area = 0.0;
    check_ok(m->ctx, contour_trace(&o, m->ctx, s, &grid, 2));
    for (size_t c = 0; c < o.n_chains; c++) {
        check_true(o.chain[c].closed);
        for (size_t k = 0; k < o.chain[c].n; k++) {
            const double *a = o.x[o.chain[c].first + k], *b = o.x[o.chain[c].first + (k + 1) % o.chain[c].n];
            area += 0.5 * (a[1] * b[0] - a[0] * b[1]);
        }
    }
    *chains = (int)o.n_chains;
    contour_free(m->ctx, &o);
    return area;
}

/* An L of two boxes that share a side, of a box without another that reaches its corner, and as a polygon: one area, one contour, one
 * number of points of a lattice on the side. */
static void test_sides_in_common(void **state)
{
    maker *m = *state;
    const double corners[6][2] = {{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.4}, {0.4, 0.4}, {0.4, 0.8}, {0.2, 0.8}};
    const shape l[3] = {
        make_polygon(m, corners, 6),
        make_list(m, "union", 2, (const shape[]){BOX2(0.2, 0.2, 0.8, 0.4), BOX2(0.2, 0.4, 0.4, 0.8)}, 2),
        make_difference(m, 2, BOX2(0.2, 0.2, 0.8, 0.8), BOX2(0.4, 0.4, 0.8, 0.8))};
    for (int k = 0; k < 3; k++) {
        int chains;
        check_close(area_of(&l[k]), 0.2, 1.8e-13);
        check_close(contour_area(m, &l[k], 10, &chains), 0.2, 1e-9);
        assert_int_equal(chains, 1);
        check_close(contour_area(m, &l[k], 7, &chains), 0.2, 1e-9);
        assert_int_equal(chains, 1);
        check_true(shape_inside(&l[k], 2, (const double[]){0.3, 0.4, 0.0}));
        check_true(!shape_inside(&l[k], 2, (const double[]){0.8, 0.6, 0.0}));
        check_true(l[k].model->level(l[k].par, 2, (const double[]){0.8, 0.6, 0.0}) > 1e-9);
    }
}

/* Four boxes about a point, and one cut in two beside another. */
static void test_corners_in_common(void **state)
{
    maker *m = *state;
    const shape four = make_list(
        m, "union", 2,
        (const shape[]){BOX2(0, 0, 0.5, 0.5), BOX2(0.5, 0, 1, 0.5), BOX2(0, 0.5, 0.5, 1), BOX2(0.5, 0.5, 1, 1)}, 4);
    const shape three =
        make_list(m, "union", 2, (const shape[]){BOX2(0, 0, 0.5, 1), BOX2(0.5, 0, 1, 0.5), BOX2(0.5, 0.5, 1, 1)}, 3);
    for (int k = 1; k < 8; k++)
        for (int j = 1; j < 8; j++) {
            const double x[3] = {k / 8.0, j / 8.0, 0.0};
            check_true(shape_inside(&four, 2, x) && shape_inside(&three, 2, x));
        }
    check_close(area_of(&four), 1.0, 1e-14);
    check_close(area_of(&three), 1.0, 1e-14);
    check_true(!shape_inside(&four, 2, (const double[]){0.5, 0.0, 0.0}));
}

/* Membership is that of the parts. */
static void test_membership(void **state)
{
    maker *m = *state;
    double star[STAR][2];
    make_star(star);
    const shape a = make_polygon(m, (const double(*)[2])star, STAR), b = BOX2(0.4, 0.1, 0.9, 0.55);
    const shape sum = make_list(m, "union", 2, (const shape[]){a, b}, 2),
                common = make_list(m, "intersection", 2, (const shape[]){a, b}, 2), rest = make_difference(m, 2, a, b);
    for (int i = 0; i < 900; i++) {
        const double x[3] = {(i % 30) / 29.3, (double)(i / 30) / 29.3, 0.0};
        const bool in_a = shape_inside(&a, 2, x), in_b = shape_inside(&b, 2, x);
        check_true(shape_inside(&sum, 2, x) == (in_a || in_b));
        check_true(shape_inside(&common, 2, x) == (in_a && in_b));
        check_true(shape_inside(&rest, 2, x) == (in_a && !in_b));
    }
    check_close(area_of(&sum), area_of(&a) + area_of(&b) - area_of(&common), 1e-5);
    check_close(area_of(&rest), area_of(&a) - area_of(&common), 1.6e-5);
}

/* A hollow box has the bits of what one body leaves of another. */
static void test_hollow_box(void **state)
{
    maker *m = *state;
    const double lo[3] = {0.11, 0.1, 0.13}, hi[3] = {0.9, 0.83, 0.87}, in_lo[3] = {0.3, 0.31, 0.3},
                 in_hi[3] = {0.7, 0.61, 0.7};
    for (int dim = 1; dim <= 3; dim++) {
        compound left = {.whole = make_box(m, dim, lo, hi), .n = 1, .less = {make_box(m, dim, in_lo, in_hi)}};
        const shape before = compound_shape(&left), now = make_difference(m, dim, left.whole, left.less[0]);
        const seed_spec spec = {.dim = dim,
                                .h = {0.125, 0.125, 0.125},
                                .n = {8, dim > 1 ? 8 : 1, dim > 2 ? 8 : 1},
                                .per_cell = {2, 2, 2},
                                .method = SEED_FITTED,
                                .merge = 0.3};
        seed_list a, b;
        check_ok(m->ctx, seed_shape(&a, m->ctx, &before, &spec));
        check_ok(m->ctx, seed_shape(&b, m->ctx, &now, &spec));
        assert_int_equal(a.n, b.n);
        assert_memory_equal(a.volume, b.volume, a.n * sizeof *a.volume);
        for (int k = 0; k < dim; k++) assert_memory_equal(a.x[k], b.x[k], a.n * sizeof *a.x[k]);
        seed_list_free(m->ctx, &a);
        seed_list_free(m->ctx, &b);
    }
}

/* ---- moved, extruded, revolved ---- */

static void test_moved(void **state)
{
    maker *m = *state;
    const shape box = BOX2(0.1, 0.2, 0.5, 0.3);
    double lo[3], hi[3];
    for (int quarter = 0; quarter < 4; quarter++) {
        shape s = new_shape(m, "moved");
        set_field(&s, "of", &box, sizeof box);
        set_vector(&s, "turned", 1, (const double[]){0.5 * pi * quarter});
        set_vector(&s, "about", 2, (const double[]){0.5, 0.5});
        sound(m, s, 2);
        check_true(shape_fills_bounds(&s, 2) && s.model->bounds(s.par, 2, lo, hi));
        static const double lower[4][2] = {{0.1, 0.2}, {0.7, 0.1}, {0.5, 0.7}, {0.2, 0.5}};
        for (int k = 0; k < 2; k++) check_close(lo[k], lower[quarter][k], 1e-15);
        check_close(area_of(&s), 0.04, 1e-15);
    }
    shape s = new_shape(m, "moved");
    set_field(&s, "of", &box, sizeof box);
    set_vector(&s, "turned", 1, (const double[]){0.4});
    set_vector(&s, "by", 2, (const double[]){0.1, 0.3});
    sound(m, s, 2);
    const double x[3] = {0.1 + 0.3 * cos(0.4) - 0.25 * sin(0.4), 0.3 + 0.3 * sin(0.4) + 0.25 * cos(0.4), 0.0};
    check_close(s.model->level(s.par, 2, x), -0.05, 1e-15);
    check_close(area_of(&s), 0.04, 2.4e-6); /* its corners */
}

static double volume_in_space(const shape *s, int n, double centroid[3])
{
    double sum = 0.0, first[3] = {0.0};
    for (int k = 0; k < n * n * n; k++) {
        const int at[3] = {k % n, k / n % n, k / n / n};
        double lo[3], hi[3], x[3];
        for (int a = 0; a < 3; a++) {
            lo[a] = (double)at[a] / n;
            hi[a] = (double)(at[a] + 1) / n;
        }
        const double volume = shape_fraction(s, 3, lo, hi, false, 4, x) / n / n / n;
        sum += volume;
        for (int a = 0; a < 3; a++) first[a] += volume * x[a];
    }
    for (int a = 0; a < 3; a++) centroid[a] = first[a] / sum;
    return sum;
}

/* A prism to round-off; a ring by Pappus: 2 pi times the first moment of its section. */
static void test_solids_of_sections(void **state)
{
    maker *m = *state;
    const shape l = make_polygon(m, corners_of_l, 6);
    const double ring[4][2] = {{0.0, 0.2}, {0.37, 0.3}, {0.25, 0.61}, {0.0, 0.8}};
    const shape section = make_polygon(m, ring, 4);
    double exact[5], x[3];
    shoelace(corners_of_l, 6, exact);
    shape prism = new_shape(m, "extruded"), top = new_shape(m, "revolved");
    set_field(&prism, "of", &l, sizeof l);
    set_vector(&prism, "from", 1, (const double[]){0.23});
    set_vector(&prism, "to", 1, (const double[]){0.71});
    sound(m, prism, 3);
    check_close(volume_in_space(&prism, 5, x), 0.48 * exact[0], 1e-14);
    check_close(x[0], exact[1] / exact[0], 1e-14);
    check_close(x[1], exact[2] / exact[0], 1e-14);
    check_close(x[2], 0.47, 1e-14);
    shoelace(ring, 4, exact);
    set_field(&top, "of", &section, sizeof section);
    set_vector(&top, "centre", 3, (const double[]){0.5, 0.47, 0.0});
    sound(m, top, 3);
    check_close(volume_in_space(&top, 10, x) / (2.0 * pi * exact[1]), 1.0, 1.4e-4); /* of its edges */
    check_close(x[0], 0.5, 1e-6);
    check_close(x[1], 0.47, 1e-6);
    check_close(x[2], exact[4] / exact[1], 1.1e-5);
    check_true(shape_inside(&top, 3, (const double[]){0.5, 0.47, 0.5})); /* on the axis */
    check_true(!shape_inside(&top, 3, (const double[]){0.5, 0.47, 0.81}));
    check_true(!shape_inside(&top, 3, (const double[]){0.5, 0.47, 0.19}));
}

/* The nearest of a million places of the surface. */
static void test_ellipsoids(void **state)
{
    maker *m = *state;
    shape s = new_shape(m, "ellipsoid");
    const double radii[3] = {0.4, 0.15, 0.3};
    set_vector(&s, "radii", 3, radii);
    sound(m, s, 2);
    for (int i = 0; i < 169; i++) {
        const double x[3] = {0.08 * (i % 13) - 0.48, 0.08 * (double)(i / 13) - 0.48, 0.0};
        double nearest = HUGE_VAL;
        for (int k = 0; k < 20000; k++) {
            const double angle = 2.0 * pi * k / 20000;
            nearest = fmin(nearest, hypot(radii[0] * cos(angle) - x[0], radii[1] * sin(angle) - x[1]));
        }
        const bool inside = pow(x[0] / radii[0], 2) + pow(x[1] / radii[1], 2) < 1.0;
        check_close(s.model->level(s.par, 2, x), inside ? -nearest : nearest, 2e-7);
    }
    check_close(s.model->level(s.par, 3, (const double[3]){0.0}), -0.15, 1e-15);
    check_close(s.model->level(s.par, 3, (const double[]){0.0, 0.0, 0.5}), 0.2, 1e-15);
    check_close(s.model->level(s.par, 3, (const double[]){0.0, 0.0, 0.3}), 0.0, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_polygons, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_polygon_level, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_refused_polygons, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_sides_in_common, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_corners_in_common, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_membership, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_hollow_box, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_moved, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_solids_of_sections, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_ellipsoids, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
