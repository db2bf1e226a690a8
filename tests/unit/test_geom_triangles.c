/* Bodies from STL files: volumes and centroids, distances, either format, either sense, cavities; and what is refused, with its place. */
#include "shape_fixture.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 20000, TEXT = 4 << 20 };

static const double pi = 3.14159265358979323846;

/* What a test makes, and the triangles of the file that it is at. */
typedef struct stl_maker {
    maker shapes;
    double x[3 * MOST][3];
    int n_triangles;
    char text[TEXT];
} stl_maker;

static stl_maker the_maker;

static int set_up(void **state)
{
    memset(&the_maker, 0, sizeof the_maker);
    maker_begin(&the_maker.shapes);
    *state = &the_maker;
    return 0;
}

static int tear_down(void **state)
{
    maker_end(&((stl_maker *)*state)->shapes);
    return 0;
}

static void add_triangle(stl_maker *m, const double *a, const double *b, const double *c)
{
    check_true(m->n_triangles < MOST);
    memcpy(m->x[3 * m->n_triangles], a, sizeof *m->x);
    memcpy(m->x[3 * m->n_triangles + 1], b, sizeof *m->x);
    memcpy(m->x[3 * m->n_triangles++ + 2], c, sizeof *m->x);
}

/* A box of twelve triangles that faces out, or in. */
static void add_box(stl_maker *m, const double lo[3], const double hi[3], bool in)
{
    static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    double v[8][3];
    for (int k = 0; k < 24; k++) v[k / 3][k % 3] = k / 3 >> k % 3 & 1 ? hi[k % 3] : lo[k % 3];
    for (int f = 0; f < 6; f++)
        for (int half = 0; half < 2; half++) {
            const double *a = v[face[f][0]], *b = v[face[f][half + 1]], *c = v[face[f][half + 2]];
            add_triangle(m, a, in ? c : b, in ? b : c);
        }
}

#define BOX(m, from, to, in) \
    add_box(m, (const double[]){(from), (from), (from)}, (const double[]){(to), (to), (to)}, in)

static void put_on_ball(const double *a, const double *b, double out[3])
{
    double size = 0.0;
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] + b[k];
        size += out[k] * out[k];
    }
    for (int k = 0; k < 3; k++) out[k] /= sqrt(size);
}

static void add_patch(stl_maker *m, const double *a, const double *b, const double *c, int level)
{
    double ab[3], bc[3], ca[3];
    if (level == 0) {
        add_triangle(m, a, b, c);
        return;
    }
    put_on_ball(a, b, ab);
    put_on_ball(b, c, bc);
    put_on_ball(c, a, ca);
    add_patch(m, a, ab, ca, level - 1);
    add_patch(m, ab, b, bc, level - 1);
    add_patch(m, ca, bc, c, level - 1);
    add_patch(m, ab, bc, ca, level - 1);
}

/* A ball of radius 1, of 8 4^level triangles. */
static void add_ball(stl_maker *m, int level)
{
    for (int k = 0; k < 8; k++) {
        const double a[3] = {k & 1 ? -1.0 : 1.0, 0.0, 0.0}, b[3] = {0.0, k & 2 ? -1.0 : 1.0, 0.0},
                     c[3] = {0.0, 0.0, k & 4 ? -1.0 : 1.0};
        const bool turn = ((k & 1) + (k >> 1 & 1) + (k >> 2)) % 2;
        add_patch(m, a, turn ? c : b, turn ? b : c, level);
    }
}

static size_t write_words(stl_maker *m)
{
    size_t n = (size_t)snprintf(m->text, TEXT, "solid a body\n");
    for (int t = 0; t < m->n_triangles; t++) {
        n += (size_t)snprintf(m->text + n, TEXT - n, "  facet normal 0 0 0\n    outer loop\n");
        for (int k = 3 * t; k < 3 * t + 3; k++)
            n += (size_t)snprintf(m->text + n, TEXT - n, "      vertex %.17g %.17g %.17g\n", m->x[k][0], m->x[k][1],
                                  m->x[k][2]);
        n += (size_t)snprintf(m->text + n, TEXT - n, "    endloop\n  endfacet\n");
    }
    return n + (size_t)snprintf(m->text + n, TEXT - n, "endsolid a body\n");
}

static size_t write_binary(stl_maker *m)
{
    memset(m->text, 0, 84);
    memcpy(m->text, "solid as some name it", 21);
    for (int k = 0; k < 4; k++) m->text[80 + k] = (char)(m->n_triangles >> 8 * k & 255);
    for (int k = 0; k < 9 * m->n_triangles; k++) {
        const float x = (float)m->x[k / 3][k % 3];
        uint32_t bits;
        memcpy(&bits, &x, sizeof bits);
        for (int b = 0; b < 4; b++) m->text[84 + 50 * (k / 9) + 12 + 4 * (k % 9) + b] = (char)(bits >> 8 * b & 255u);
    }
    return 84 + 50 * (size_t)m->n_triangles;
}

/* The shape of the file in m->text. */
static shape read_text(stl_maker *m, size_t size, double scale, double shift)
{
    shape s = {.model = shape_find("stl")};
    check_ok(m->shapes.ctx, allocate(&m->shapes, &s.par, s.model->param_size));
    param_fill_defaults(s.model->params, s.model->n_params, s.par);
    const param_file file = {.path = "body.stl", .bytes = m->text, .size = size};
    memcpy((char *)s.par + s.model->params[0].offset, &file, sizeof file);
    *param_find(s.model->params, s.model->n_params, s.par, "scale") = scale;
    for (int a = 0; a < 3; a++) param_find(s.model->params, s.model->n_params, s.par, "shift")[a] = shift;
    check_ok(m->shapes.ctx, shape_prepare(&s, 3, &(shape_memory){m->shapes.ctx, allocate, &m->shapes}, m->shapes.why));
    m->n_triangles = 0;
    return s;
}

static shape sound(stl_maker *m, size_t size, double scale, double shift)
{
    const shape s = read_text(m, size, scale, shift);
    if (m->shapes.why[0]) print_error("%s\n", m->shapes.why);
    check_true(m->shapes.why[0] == '\0');
    return s;
}

static double volume_of(const shape *s, double centroid[3])
{
    const double lo[3] = {-1.1, -1.1, -1.1}, hi[3] = {1.13, 1.12, 1.1};
    return shape_fraction(s, 3, lo, hi, false, 6, centroid) * 2.23 * 2.22 * 2.2;
}

/* A cube in either format and either sense; and moved and made smaller. Its edges cost what those of any shape do. */
static void test_cubes(void **state)
{
    stl_maker *m = *state;
    double x[3];
    const double lo[3] = {-0.5, -0.4, -0.6}, hi[3] = {0.7, 0.8, 0.5};
    for (int k = 0; k < 4; k++) {
        add_box(m, lo, hi, k % 2);
        const size_t size = k / 2 ? write_binary(m) : write_words(m);
        const shape s = sound(m, size, 1.0, 0.0);
        check_close(volume_of(&s, x), 1.2 * 1.2 * 1.1, 3e-3);
        check_close(x[0], 0.1, 1e-3);
        check_close(s.model->level(s.par, 3, (const double[]){1.7, 0.0, 0.0}), 1.0, 1e-7);
        check_close(s.model->level(s.par, 3, (const double[]){0.1, 0.2, 0.3}), -0.2, 1e-7);
        check_close(s.model->level(s.par, 3, (const double[]){1.0, 1.2, 0.5}), 0.5, 1e-7);
        check_close(s.model->level(s.par, 3, (const double[]){-0.7, -0.6, -0.7}), 0.3, 1e-7);
    }
    add_box(m, lo, hi, false);
    const shape s = sound(m, write_words(m), 0.5, 0.25);
    check_close(s.model->level(s.par, 3, (const double[]){0.3, 0.35, 0.4}), -0.1, 1e-15);
}

/* Balls of triangles have the ball's volume but for what lies over them, to the second order. */
static void test_balls(void **state)
{
    stl_maker *m = *state;
    double x[3], off[2];
    for (int k = 0; k < 2; k++) {
        add_ball(m, 3 + k);
        double exact = 0.0;
        for (int t = 0; t < m->n_triangles; t++) {
            const double *a = m->x[3 * t], *b = m->x[3 * t + 1], *c = m->x[3 * t + 2];
            exact += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                      a[2] * (b[0] * c[1] - b[1] * c[0])) /
                     6.0;
        }
        const shape s = sound(m, write_words(m), 1.0, 0.01);
        const double volume = volume_of(&s, x);
        check_close_relative(volume, exact, 1e-4);
        off[k] = 4.0 / 3.0 * pi - exact;
        for (int a = 0; a < 3; a++) check_close(x[a], 0.01, 1e-4);
        for (int i = 0; i < 300; i++) {
            const double at[3] = {1.4 * sin(1.0 + i), 1.4 * sin(2.0 + 2.3 * i), 1.4 * sin(3.1 * i)};
            const double r = sqrt((at[0] - 0.01) * (at[0] - 0.01) + (at[1] - 0.01) * (at[1] - 0.01) +
                                  (at[2] - 0.01) * (at[2] - 0.01));
            const double level = s.model->level(s.par, 3, at);
            check_true(level >= r - 1.0 - 1e-12 && level <= r - 1.0 + (k ? 4e-3 : 1.6e-2));
        }
    }
    check_true(off[1] < 0.26 * off[0]);
}

/* A box in a box is a cavity where it faces in. */
static void test_cavities(void **state)
{
    stl_maker *m = *state;
    for (int turned = 0; turned < 2; turned++) {
        BOX(m, -0.9, 0.9, turned);
        BOX(m, -0.5, 0.5, !turned);
        BOX(m, -0.2, 0.2, turned);
        const shape s = sound(m, write_words(m), 1.0, 0.0);
        for (int k = 0; k < 11; k++) {
            const double at = 0.1 * k;
            const bool inside = at < 0.15 || (at > 0.5 && at < 0.85);
            if (k == 2 || k == 5 || k == 9) continue;
            check_true(shape_inside(&s, 3, (const double[]){at, 0.03, 0.02}) == inside);
        }
    }
}

static void refuse(stl_maker *m, size_t size, const char *word)
{
    read_text(m, size, 1.0, 0.0);
    if (!strstr(m->shapes.why, word)) print_error("'%s' has no '%s'\n", m->shapes.why, word);
    check_true(strstr(m->shapes.why, word) != NULL);
    check_true(strstr(m->shapes.why, "body.stl") != NULL);
}

static void test_refused_surfaces(void **state)
{
    stl_maker *m = *state;
    BOX(m, 0.0, 1.0, false);
    m->n_triangles--;
    refuse(m, write_words(m), "it is open at the side from (1, 0, 0) to (1, 0, 1)");
    BOX(m, 0.0, 1.0, false);
    double swap[3];
    memcpy(swap, m->x[0], sizeof swap);
    memcpy(m->x[0], m->x[1], sizeof swap);
    memcpy(m->x[1], swap, sizeof swap);
    refuse(m, write_words(m), "two triangles face opposite ways at the side from (0, 0, 0)");
    BOX(m, 0.0, 1.0, false);
    BOX(m, 0.5, 1.5, false);
    refuse(m, write_words(m), "it meets itself at (");
    BOX(m, 0.0, 1.0, false);
    add_box(m, (const double[]){0.2, 0.3, 1.0}, (const double[]){0.4, 0.5, 2.0}, false);
    refuse(m, write_words(m), "it meets itself at (");
    BOX(m, 0.0, 1.0, false);
    add_box(m, (const double[]){1.0, 1.0, 0.0}, (const double[]){2.0, 2.0, 1.0}, false);
    refuse(m, write_words(m), "more than two triangles meet at the side from (1, 1, 0) to (1, 1, 1)");
    BOX(m, 0.0, 1.0, false);
    BOX(m, 0.25, 0.75, false);
    refuse(m, write_words(m), "faces the wrong way: pieces within others are cavities");
    BOX(m, 0.0, 1.0, false);
    BOX(m, 2.0, 2.5, true);
    refuse(m, write_words(m), "the piece at (2, 2, 2) faces the wrong way");
    add_triangle(m, (const double[]){0, 0, 0}, (const double[]){1, 0, 0}, (const double[]){0, 1, 0});
    add_triangle(m, (const double[]){0, 0, 0}, (const double[]){0, 1, 0}, (const double[]){1, 0, 0});
    refuse(m, write_words(m), "it meets itself at (0, 1, 0)");
}

typedef struct wrong_text {
    const char *text, *word;
} wrong_text;

static void test_refused_files(void **state)
{
    static const wrong_text wrong[] = {
        {"", "it is no STL"},
        {"solid\nendsolid\n", "it has no triangle"},
        {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 x 0\n", "line 5: 'x' is no number"},
        {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 nan 0\n", "line 5: 'nan' is no number"},
        {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\n",
         "line 5: 'endloop' where 'vertex' should be"},
        {"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "'the end' where 'vertex' should be"},
        {"solid x\nface\n", "line 2: 'face' where 'facet' should be"},
        {"solid x\nfacet normal 0 0", "'the end' where 'outer' should be"},
    };
    stl_maker *m = *state;
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        strcpy(m->text, wrong[k].text);
        refuse(m, strlen(m->text), wrong[k].word);
    }
    BOX(m, 0.0, 1.0, false);
    refuse(m, write_binary(m) - 1, "it is no STL");
    m->x[0][0] = 0.0;
    BOX(m, 0.0, 1.0, false);
    m->x[3 * 4][1] = NAN;
    refuse(m, write_binary(m), "triangle 5 has a corner that is no number");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_cubes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_balls, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_cavities, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_refused_surfaces, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_refused_files, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
