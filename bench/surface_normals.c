/* Normals to unconnected points: the tables of Sulsky and York 2000 (S00) and of chapter 7 of York 1997 (Y97), and how
 * the error of each method goes with points a cell, noise and curvature. One table, comma separated:
 * `bench_surface_normals NAME`; without a name the names are listed. Angles in degrees. scripts/results/normals.bash
 * makes docs/results/normals.md of them.
 *
 * Where the papers do not print the positions of their points, they are chosen here, and said in the comment of the
 * table. */
#include "surface_cloud.h"

#include "base/timer.h"

/* Points evenly along the part of a line through the middle of the element, in the middle of equal pieces. */
static void put_line(cloud *c, double slope, int n)
{
    const double half = fabs(slope) > 1.0 ? 0.5 / fabs(slope) : 0.5;
    c->n = 0;
    for (int k = 0; k < n; ++k) {
        const double x = half * ((2.0 * k + 1.0) / n - 1.0);
        add(c, 0.5 + x, 0.5 + slope * x, 0.0, -slope, 1.0, 0.0);
    }
}

/* S00 tables I and II: condition of the normal equations' matrix over random points. */
static void table_lines(void)
{
    static const double slope[] = {0.1, 0.5, 1.0, 2.0, 10.0, -10.0, -2.0, -1.0, -0.5, -0.1};
    static cloud c;
    printf("points,slope,least,most,median,worst angle\n");
    for (int n = 3; n <= 8; n = n == 3 ? 4 : 2 * n)
        for (int s = 0; s < 10; ++s) {
            double condition[DRAWS], worst = 0.0;
            put_line(&c, slope[s], n);
            for (int k = 0; k < DRAWS; ++k) {
                isosurface f;
                double away[3], row[SURFACE_MAX_FUNCTIONS];
                (void)solve(&c, 2, 1, SOLVE_QR, NULL, &f);
                isosurface_away(&f, k, away);
                (void)solve(&c, 2, 1, SOLVE_QR, away, &f);
                worst = fmax(worst, errors_of(&c, &f).most);
                isosurface_row(&f, away, row);
                least_squares_add(&f.rows, row, 0.0);
                condition[k] = pow(least_squares_condition(&f.rows), 2.0);
            }
            const double middle = median(condition, DRAWS);
            printf("%d,%g,%.1e,%.1e,%.1e,%.1e\n", n, slope[s], condition[0], condition[DRAWS - 1], middle, worst);
        }
}

static void put_arc(cloud *c, double x, double y, double radius, double from, double to, int n)
{
    c->n = 0;
    for (int k = 0; k < n; ++k) {
        const double a = from + (to - from) * k / (n - 1), u = cos(a), v = sin(a);
        add(c, x + radius * u, y + radius * v, 0.0, u, v, 0.0);
    }
}

/* S00 table III: a circle of radius 0.8 about the corner, in radians. N points evenly from 0.1 to pi/2 - 0.1; point off
 * it (0.18, 0.93). */
static void table_circle(void)
{
    static const double away[3] = {0.18, 0.93, 0.0};
    static cloud c;
    printf("points,most,rms,norm over N\n");
    for (int n = 3; n <= 32; n = n == 3 ? 4 : 2 * n) {
        isosurface f;
        put_arc(&c, 0.0, 0.0, 0.8, 0.1, 0.5 * pi - 0.1, n);
        (void)solve(&c, 2, 1, SOLVE_QR, away, &f);
        const errors e = errors_of(&c, &f);
        const double root = rms(&e) * pi / 180.0;
        printf("%d,%.4f,%.4f,%.4f\n", n, e.most * pi / 180.0, root, root / sqrt(n));
    }
}

/* Largest error over the points, for each of a hundred points off the surface. */
static void print_draws(const char *what, const cloud *c, int dim, int degree, surface_solver solver)
{
    double most[DRAWS];
    isosurface f;
    for (int k = 0; k < DRAWS; ++k) {
        double away[3];
        (void)solve(c, dim, degree, solver, NULL, &f);
        isosurface_away(&f, k, away);
        most[k] = solve(c, dim, degree, solver, away, &f) ? errors_of(c, &f).most : 90.0;
    }
    const double middle = median(most, DRAWS);
    (void)solve(c, dim, degree, SOLVE_QR, NULL, &f);
    const errors e = errors_of(c, &f);
    printf("%s,%d,%d,%s,%.3g,%.3g,%.3g,", what, c->n, degree, solver == SOLVE_QR ? "QR" : "normal equations", most[0],
           middle, most[DRAWS - 1]);
    printf(solver == SOLVE_QR ? "%.3g,%.3g\n" : ",\n", e.most, rms(&e));
}

static const char draws_head[] = "set,points,degree,solver,least,median,most,as floe draws,rms\n";

/* S00 figures 7 and 9: a circle of radius 0.3 about the middle. (a) four points over 77 degrees about the diagonal,
 * which have places of their own along both axes; (b) four over 64 degrees about the vertical, in pairs; (c), (d) eight
 * over 100 degrees. */
static void table_arcs(void)
{
    static const struct {
        const char *name;
        int n;
        double middle, span;
    } set[] = {{"a", 4, 45, 77}, {"b", 4, 90, 64}, {"c", 8, 45, 100}, {"d", 8, 80, 100}};
    static cloud c;
    printf("%s", draws_head);
    for (int k = 0; k < 4; ++k) {
        put_arc(&c, 0.5, 0.5, 0.3, (set[k].middle - 0.5 * set[k].span) * pi / 180.0,
                (set[k].middle + 0.5 * set[k].span) * pi / 180.0, set[k].n);
        if (k < 2) print_draws(set[k].name, &c, 2, 1, SOLVE_QR);
        print_draws(set[k].name, &c, 2, 2, SOLVE_NORMAL_EQUATIONS);
        print_draws(set[k].name, &c, 2, 2, SOLVE_QR);
    }
}

/* Rows of points on the plane, or on the sphere by equal steps of both angles. */
static void put_plane(cloud *c, int rows, int columns)
{
    c->n = 0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double x = (i + 0.5) / rows, y = (j + 0.5) / columns;
            add(c, x, y, 0.5 * x + 0.25 * y, 0.5, 0.25, -1.0);
        }
}

static void put_sphere(cloud *c, int n)
{
    c->n = 0;
    for (int k = 0; k < n; ++k) { /* evenly over the octant: by equal areas, and by the golden section */
        const double z = (k + 0.5) / n, phi = 0.5 * pi * fmod((k + 0.5) * 0.61803398874989485, 1.0),
                     r = sqrt(1.0 - z * z);
        add(c, 0.8 * r * cos(phi), 0.8 * r * sin(phi), 0.8 * z, r * cos(phi), r * sin(phi), z);
    }
}

/* S00 figures 5 and 11: the plane 0.5 x + 0.25 y - z = 0, and the sphere of radius 0.8 about the corner. */
static void table_space(void)
{
    static cloud c;
    printf("%s", draws_head);
    put_plane(&c, 3, 3);
    print_draws("plane", &c, 3, 1, SOLVE_QR);
    put_sphere(&c, 8);
    print_draws("sphere", &c, 3, 1, SOLVE_QR);
    put_plane(&c, 5, 6);
    print_draws("plane", &c, 3, 2, SOLVE_QR);
    put_sphere(&c, 29);
    print_draws("sphere", &c, 3, 2, SOLVE_QR);
}

/* Y97 sections 7.6 and 7.7: lines at 45 and (unevenly) 80 degrees, xy + 0.1 x + 0.3 = 0 (moved into the element), a
 * circle of 0.4 about the corner, and an arc of 0.3 about the middle, turned. */
static void table_thesis(void)
{
    static const double uneven[] = {0.05, 0.1, 0.4, 0.55, 0.9};
    static cloud c;
    printf("%s", draws_head);
    put_line(&c, 1.0, 5);
    print_draws("45 degrees", &c, 2, 1, SOLVE_QR);
    c.n = 0;
    for (int k = 0; k < 5; ++k)
        add(&c, 0.5 + (uneven[k] - 0.5) / tan(80.0 * pi / 180.0), uneven[k], 0.0, -tan(80.0 * pi / 180.0), 1.0, 0.0);
    print_draws("80 degrees", &c, 2, 1, SOLVE_QR);
    print_draws("80 degrees", &c, 2, 1, SOLVE_NORMAL_EQUATIONS);
    c.n = 0;
    for (int k = 0; k < 3; ++k) {
        const double x = -0.3 - 0.3 * k, y = -0.1 - 0.3 / x;
        add(&c, 1.0 + x, y, 0.0, y + 0.1, x, 0.0);
    }
    print_draws("xy + 0.1 x + 0.3 = 0", &c, 2, 1, SOLVE_QR);
    put_arc(&c, 0.0, 0.0, 0.4, 0.1, 0.5 * pi - 0.1, 5);
    print_draws("circle 0.4", &c, 2, 1, SOLVE_QR);
    for (int turn = 45; turn <= 90; turn += 15) {
        char name[32];
        put_arc(&c, 0.5, 0.5, 0.3, (turn - 35) * pi / 180.0, (turn + 35) * pi / 180.0, 6);
        (void)snprintf(name, sizeof name, "arc about %d degrees", turn);
        print_draws(name, &c, 2, 1, SOLVE_QR);
        print_draws(name, &c, 2, 2, SOLVE_QR);
    }
}

/* ---- whole methods, on a mesh ---- */

/* Methods with their parameters. */
typedef struct contender {
    const char *label, *method;
    double par;
} contender;

/* How errors go is shown of all of them; those by colours have 16 points a cell inside, and are left out where there
 * are none. */
static const contender contenders[] = {
    {"connectivity", "connectivity", 0},
    {"isosurface", "isosurface", 0},
    {"isosurface_linear", "isosurface_linear", 0},
    {"isosurface_quadratic", "isosurface_quadratic", 0},
    {"quadric", "quadric", 1},
    {"quadric spread 2", "quadric", 2},
    {"quadric spread 3", "quadric", 3},
    {"colour", "colour", 0},
    {"colour_quadratic", "colour_quadratic", 0},
    {"colour_cubic", "colour_cubic", 0},
};
enum { ALL_METHODS = sizeof contenders / sizeof contenders[0], WITHOUT_COLOURS = ALL_METHODS - 3, MOST_INSIDE = 24000 };

/* A closed circle; the noise moves points along the normal. */
static void put_circle(cloud *c, double x, double y, double radius, int n, double noise, int seed)
{
    uint64_t state = (uint64_t)seed * UINT64_C(2654435761) + 12345;
    c->n = 0;
    for (int k = 0; k < n; ++k) {
        const double a = 2.0 * pi * (k + 0.5) / n, u = cos(a), v = sin(a);
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        const double r = radius + noise * (2.0 * (double)(state >> 11) * 0x1p-53 - 1.0);
        add(c, x + r * u, y + r * v, 0.0, u, v, 0.0);
    }
}

/* Y97 section 7.5.1: a cylinder of radius 1, with 180 points a quarter and cells of 0.1, of which the middle quarter of
 * the circle is looked at; with points of a fluid inside, none, 2 x 2 or 4 x 4 a cell. */
static void table_cylinder(void)
{
    static cloud c;
    static field f;
    static double inside[3 * 16 * 400];
    printf("method,vacuum most,vacuum rms,4 most,4 rms,16 most,16 rms\n");
    begin(&f, 2, 1.5, 0.1);
    put_circle(&c, 0.0, 0.0, 1.0, 720, 0.0, 0);
    for (size_t m = 0; m < surface_registry_size; ++m) {
        const surface_method *method = surface_registry[m];
        const double par[] = {1.0};
        printf("%s", method->name);
        for (int per_axis = 0; per_axis <= 4; per_axis = per_axis == 0 ? 2 : 2 * per_axis) {
            size_t n = 0;
            const int cells = 20;
            for (int i = 0; i < cells * per_axis; ++i)
                for (int j = 0; j < cells * per_axis; ++j) {
                    const double x = -1.0 + 0.1 * (i + 0.5) / per_axis, y = -1.0 + 0.1 * (j + 0.5) / per_axis;
                    if (x * x + y * y >= 1.0) continue;
                    inside[3 * n] = x;
                    inside[3 * n + 1] = y;
                    inside[3 * n++ + 2] = 0.0;
                }
            if (surface_set_inside(&f.set, n, inside) != FLOE_OK) exit(1);
            const errors e = measure(&f, &c, method, par);
            printf(",%.3g,%.3g", e.most, rms(&e));
        }
        printf("\n");
    }
    end(&f);
}

/* Y97 figures 80 to 84, S00 section 4 and figure 6: sets with which linear splines on one element fail. Raw: the
 * element alone. */
static void table_degenerate(void)
{
    static const char *const name[] = {
        "on a vertical line",         "on a horizontal line",  "one of them 1e-3 off", "one of them 1e-8 off",
        "two with equal coordinates", "on a face of the cell", "two points",           "one point"};
    static cloud c;
    static field f;
    printf("set,raw linear,isosurface_linear,isosurface,isosurface_quadratic,quadric,basis\n");
    for (int k = 0; k < 8; ++k) {
        isosurface raw;
        c.n = 0;
        const int n = k == 6 ? 2 : k == 7 ? 1 : 5;
        for (int i = 0; i < n; ++i) {
            const double s = 0.1 + 0.2 * i, off = i == 2 && k == 2 ? 1e-3 : i == 2 && k == 3 ? 1e-8 : 0.0;
            if (k == 1)
                add(&c, s, 0.37, 0.0, 0.0, 1.0, 0.0);
            else if (k == 4)
                add(&c, 0.5 + 0.3 * cos(0.8 * i), 0.5 + 0.3 * sin(0.8 * i), 0.0, cos(0.8 * i), sin(0.8 * i), 0.0);
            else
                add(&c, (k == 5 ? 0.0 : 0.37) + off, s, 0.0, 1.0, 0.0, 0.0);
        }
        if (k == 4) put_arc(&c, 0.5, 0.5, 0.3, pi / 3.0, 2.0 * pi / 3.0, 4);
        printf("%s", name[k]);
        if (solve(&c, 2, 1, SOLVE_NORMAL_EQUATIONS, NULL, &raw))
            printf(",%.2g", errors_of(&c, &raw).most);
        else
            printf(",singular");
        static const char *const method[] = {"isosurface_linear", "isosurface", "isosurface_quadratic", "quadric"};
        const double par[] = {1.0};
        begin(&f, 2, 2.0, 1.0);
        for (int m = 0; m < 4; ++m) {
            const errors e = measure(&f, &c, surface_find(method[m]), par);
            if (f.estimate[0].basis == SURFACE_NONE)
                printf(",none");
            else
                printf(",%.2g", e.most);
        }
        printf(",%s\n", f.estimate[0].basis == SURFACE_NONE ? "none: the former is kept" : "found");
        end(&f);
    }
}

/* S00 figures 1 and 8: one point in a cell of one axis, with the point off it and without. */
static void table_line(void)
{
    printf("place,degree,gradient with,gradient of least norm without\n");
    for (int degree = 1; degree <= 2; ++degree)
        for (int k = 1; k <= 3; ++k) {
            const double lower[3] = {0}, size[3] = {1, 1, 1}, x[3] = {0.25 * k, 0.0, 0.0};
            isosurface f;
            double n[3];
            isosurface_begin(&f, SOLVE_QR, 1, degree, lower, size);
            isosurface_add(&f, x);
            least_squares_solution alone;
            (void)least_squares_solve(&f.rows, &alone);
            const bool found = isosurface_find(&f);
            const double with = found ? isosurface_normal(&f, x, n) : 0.0, unit = with > 0.0 ? n[0] : 0.0;
            memcpy(f.chi, alone.x, sizeof f.chi);
            const double without = isosurface_normal(&f, x, n);
            printf("%g,%d,%.3g (normal %+g),%.3g\n", x[0], degree, with, unit, without < 1e-14 ? 0.0 : without);
        }
}

/* ---- the dog-bone ---- */

/* Straight pieces and arcs, one after the other, of the quarter of the deck `membrane_dogbone`, and how far along
 * them. */
typedef struct piece {
    double x[2], to[2]; /* straight: from, to; arc: centre, and radius with the sign of its turn */
    double from, upto;  /* arc: angles in degrees */
} piece;

static const double slope = 71.3479; /* degrees: of the normal of the shoulder, across (0.426, 0.9) to (0.9, 0.74) */
static const double top = 83.3290;   /* of the top, across (0, 0.95) to (0.426, 0.9) */

static double length_of(const piece *p)
{
    if (p->from == p->upto) return hypot(p->to[0] - p->x[0], p->to[1] - p->x[1]);
    return fabs(p->to[0]) * fabs(p->upto - p->from) * pi / 180.0;
}

static void put_on(cloud *c, const piece *p, double along)
{
    const double share = along / length_of(p);
    if (p->from == p->upto) {
        const double u = p->to[0] - p->x[0], v = p->to[1] - p->x[1];
        add(c, p->x[0] + share * u, p->x[1] + share * v, 0.0, v, -u, 0.0);
        return;
    }
    const double a = (p->from + share * (p->upto - p->from)) * pi / 180.0;
    add(c, p->x[0] + fabs(p->to[0]) * cos(a), p->x[1] + fabs(p->to[0]) * sin(a), 0.0, cos(a), sin(a), 0.0);
}

/* The quarter and its images: a closed contour in order. */
static void close_contour(cloud *c)
{
    static const double sign[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    const int n = c->n;
    for (int q = 1; q < 4; ++q)
        for (int k = 0; k < n; ++k) {
            const int of = q % 2 == 1 ? n - 1 - k : k;
            add(c, sign[q][0] * c->x[of][0], sign[q][1] * c->x[of][1], 0.0, sign[q][0] * c->normal[of][0],
                sign[q][1] * c->normal[of][1], 0.0);
        }
}

/* n points a quarter, in the middle of equal pieces. */
static void put_dogbone(cloud *c, int n)
{
    const double r = 0.074, fillet = 0.066, s = slope * pi / 180.0, t = top * pi / 180.0;
    const double shoulder[2] = {0.9 + r * cos(s), 0.74 + r * sin(s)}, knee[2] = {0.426 + r * cos(s), 0.9 + r * sin(s)};
    const double bend[2] = {0.426 + r * cos(t), 0.9 + r * sin(t)};
    const piece p[] = {{{0.5, 0.0}, {0.5, 0.51}, 0, 0},
                       {{0.566, 0.51}, {fillet, 0}, 180, 90},
                       {{0.566, 0.576}, {0.9, 0.576}, 0, 0},
                       {{0.9, 0.65}, {r, 0}, -90, 0},
                       {{0.974, 0.65}, {0.974, 0.74}, 0, 0},
                       {{0.9, 0.74}, {r, 0}, 0, slope},
                       {{shoulder[0], shoulder[1]}, {knee[0], knee[1]}, 0, 0},
                       {{0.426, 0.9}, {r, 0}, slope, top},
                       {{bend[0], bend[1]}, {0.0, bend[1] + bend[0] / tan(t)}, 0, 0}};
    const int pieces = sizeof p / sizeof p[0];
    double whole = 0.0;
    for (int k = 0; k < pieces; ++k) whole += length_of(&p[k]);
    c->n = 0;
    for (int k = 0; k < n; ++k) {
        double along = whole * (k + 0.5) / n;
        int at = 0;
        for (; at < pieces - 1 && along > length_of(&p[at]); ++at) along -= length_of(&p[at]);
        put_on(c, &p[at], along);
    }
    close_contour(c);
}

/* Normals of the exact initial contour (lines and arcs) and of the exact final circle, at the four meshes of Y97 table
 * 5; and of that circle with points moved along the normal by up to a twentieth of their spacing. */
static void table_dogbone(void)
{
    static const double cell[] = {0.4, 0.2, 0.1, 0.05};
    static const int number[] = {56, 100, 200, 600};
    static cloud c;
    static field f;
    printf("h,points,method,contour most,contour rms,circle most,circle rms,noisy circle most,noisy circle rms\n");
    for (int k = 0; k < 4; ++k)
        for (int m = 0; m < WITHOUT_COLOURS; ++m) {
            const surface_method *method = surface_find(contenders[m].method);
            const double radius = 1.4006, spacing = 0.5 * pi * radius / number[k];
            begin(&f, 2, 1.6, cell[k]);
            put_dogbone(&c, number[k]);
            const errors contour = measure(&f, &c, method, &contenders[m].par);
            put_circle(&c, 0.0, 0.0, radius, 4 * number[k], 0.0, 0);
            const errors circle = measure(&f, &c, method, &contenders[m].par);
            put_circle(&c, 0.0, 0.0, radius, 4 * number[k], 0.05 * spacing, 1);
            const errors noisy = measure(&f, &c, method, &contenders[m].par);
            printf("%g,%d,%s,%.3g,%.3g,%.2g,%.2g,%.3g,%.3g\n", cell[k], number[k], contenders[m].label, contour.most,
                   rms(&contour), circle.most, rms(&circle), noisy.most, rms(&noisy));
            end(&f);
        }
}

/* ---- how errors go ---- */

/* A lattice of 16 points a cell within the circle of radius 1. */
static void put_inside(field *f, double h, double x, double y)
{
    static double inside[3 * MOST_INSIDE];
    size_t n = 0;
    const double step = 0.25 * h;
    const int most = (int)(1.5 / step);
    for (int i = -most; i < most; ++i)
        for (int j = -most; j < most; ++j) {
            const double at[3] = {(i + 0.5) * step, (j + 0.5) * step, 0.0};
            if (hypot(at[0] - x, at[1] - y) >= 1.0 || n == MOST_INSIDE) continue;
            memcpy(inside + 3 * n++, at, sizeof at);
        }
    if (surface_set_inside(&f->set, n, inside) != FLOE_OK) exit(1);
}

/* Mean over places of the mesh of the root mean square on a circle of radius 1. */
static double circle_error(const contender *who, double h, double per_cell, double noise)
{
    static cloud c;
    static field f;
    const int n = (int)(2.0 * pi / h * per_cell + 0.5);
    errors all = {0};
    for (int k = 0; k < 8; ++k) {
        begin(&f, 2, h * ceil(1.5 / h), h);
        put_circle(&c, h * k / 8.0, h * fmod(k * 0.618, 1.0), 1.0, n, noise * 2.0 * pi / n, k);
        const surface_method *method = surface_find(who->method);
        if (method->needs_inside) put_inside(&f, h, h * k / 8.0, h * fmod(k * 0.618, 1.0));
        const errors e = measure(&f, &c, method, &who->par);
        all.square += e.square;
        all.n += e.n;
        end(&f);
    }
    return rms(&all);
}

static void print_row(double x, double h, double per_cell, double noise)
{
    printf("%g", x);
    for (int m = 0; m < ALL_METHODS; ++m) printf(",%.3g", circle_error(&contenders[m], h, per_cell, noise));
    printf("\n");
}

static void print_head(const char *first)
{
    printf("%s", first);
    for (int m = 0; m < ALL_METHODS; ++m) printf(",%s", contenders[m].label);
    printf("\n");
}

static void table_points(void)
{
    static const double per_cell[] = {1.3, 2, 3, 4, 6, 8, 12, 16};
    print_head("points a cell");
    for (int k = 0; k < 8; ++k) print_row(per_cell[k], 0.2, per_cell[k], 0.01);
}

static void table_noise(void)
{
    static const double noise[] = {1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2};
    print_head("noise over spacing");
    for (int k = 0; k < 8; ++k) print_row(noise[k], 0.2, 7.0, noise[k]);
}

static void table_curvature(void)
{
    static const double h[] = {0.05, 0.1, 0.2, 0.4, 0.7, 1.0, 1.5};
    print_head("h over radius");
    for (int k = 0; k < 7; ++k) print_row(h[k], h[k], 7.0, 1e-3);
}

/* Microseconds of one core a point, binning included: a circle and a sphere, 4, 8 and 16 points a cell. */
static void table_cost(void)
{
    static cloud c;
    static field f;
    const double par[] = {1.0};
    printf("method");
    for (int dim = 2; dim <= 3; ++dim)
        for (int per_cell = 4; per_cell <= 16; per_cell *= 2) printf(",%d-D: %d a cell", dim, per_cell);
    printf("\n");
    for (size_t m = 0; m < surface_registry_size; ++m) {
        const surface_method *method = surface_registry[m];
        printf("%s", method->name);
        for (int dim = 2; dim <= 3; ++dim)
            for (int per_cell = 4; per_cell <= 16; per_cell *= 2) {
                if (method->connected && dim == 3) {
                    printf(",-");
                    continue;
                }
                const double radius =
                    dim == 2 ? 0.1 * 4000.0 / per_cell / (2.0 * pi) : 0.1 * sqrt(4000.0 / per_cell / (4.0 * pi));
                if (dim == 2) put_circle(&c, 0.01, 0.02, radius, 4000, 0.0, 0);
                for (c.n = dim == 2 ? c.n : 0; c.n < 4000;) {
                    const double z = 1.0 - (2.0 * c.n + 1.0) / 4000.0, phi = pi * (1.0 + sqrt(5.0)) * c.n,
                                 r = sqrt(1.0 - z * z);
                    add(&c, radius * r * cos(phi), radius * r * sin(phi), radius * z, r * cos(phi), r * sin(phi), z);
                }
                begin(&f, dim, 0.1 * ceil(10.0 * radius + 3.0), 0.1);
                f.set.measures = false; /* as in a run */
                double best = INFINITY;
                for (int repeat = 0; repeat < 5; ++repeat) {
                    const double start = cpu_seconds();
                    (void)measure(&f, &c, method, par);
                    best = fmin(best, cpu_seconds() - start);
                }
                printf(",%.2g", 1e6 * best / c.n);
                end(&f);
            }
        printf("\n");
    }
}

static const bench_table tables[] = {
    {"lines", "S00 tables I and II: condition over 100 random points", table_lines},
    {"circle", "S00 table III", table_circle},
    {"arcs", "S00 figures 7 and 9", table_arcs},
    {"space", "S00 figures 5 and 11", table_space},
    {"line", "S00 figures 1 and 8: one axis", table_line},
    {"thesis", "Y97 figures 76 to 79, 83 to 85", table_thesis},
    {"cylinder", "Y97 section 7.5.1", table_cylinder},
    {"degenerate", "Y97 figures 80 to 84, S00 section 4", table_degenerate},
    {"dogbone", "exact contour and circle of the dog-bone, four meshes", table_dogbone},
    {"points", "error by points a cell", table_points},
    {"noise", "error by noise of positions", table_noise},
    {"cost", "microseconds a point", table_cost},
    {"curvature", "error by curvature times h", table_curvature},
};

int main(int argc, char **argv)
{
    return print_table(argc, argv, sizeof tables / sizeof tables[0], tables);
}
