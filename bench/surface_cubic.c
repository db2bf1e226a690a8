/* Normals to the cubic of Sulsky and York 2000, figure 10: y = c x2 (x - 1) + x + 0.5 with c = 2 and 4. The paper
 * prints angles (1 degree; 32, "rms" 5), but neither the number of the points nor their positions: readings of the
 * figure, and how the error goes with points and cells. `bench_surface_cubic NAME`, comma separated, angles in degrees;
 * scripts/results/normals.bash makes docs/results/normals.md of them. */
#include "surface_cloud.h"

static double height(double c, double x)
{
    return c * x * x * (x - 1.0) + x + 0.5;
}

/* Where the curve comes to a height at last. */
static double place_of(double c, double y)
{
    double low = 0.5, high = 1.0;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        if (height(c, middle) < y)
            low = middle;
        else
            high = middle;
    }
    return low;
}

typedef enum spacing { BY_ARC, BY_ABSCISSA, SIXTEENTHS } spacing;

static const char *const spacing_name[] = {"arc", "x", "x"};

enum { PIECES = 20000 };

/* A part of the curve's length from x = from on, in straight pieces; the x at which it ends. */
static double walk(double c, double from, double to, double length, double *whole)
{
    double gone = 0.0, x = from;
    for (int k = 1; k <= PIECES && gone < length; ++k) {
        const double next = from + (to - from) * k / PIECES;
        gone += hypot(next - x, height(c, next) - height(c, x));
        x = next;
    }
    *whole = gone;
    return x;
}

static void put_at(cloud *p, double c, double x)
{
    add(p, x, height(c, x), 0.0, -(c * (3.0 * x * x - 2.0 * x) + 1.0), 1.0, 0.0);
}

/* n points from x = from to x = to, ends included; of the sixteenths those in the cell, however many they are. */
static void put_cubic(cloud *p, double c, double from, double to, int n, spacing how)
{
    double whole = 0.0, part;
    p->n = 0;
    for (int k = 0; how == SIXTEENTHS && k < 16; ++k)
        if (height(c, (k + 0.5) / 16.0) < 1.0) put_at(p, c, (k + 0.5) / 16.0);
    if (how == SIXTEENTHS) return;
    (void)walk(c, from, to, INFINITY, &whole);
    for (int k = 0; k < n; ++k) {
        const double share = (double)k / (n - 1);
        put_at(p, c, how == BY_ARC ? walk(c, from, to, share * whole, &part) : from + share * (to - from));
    }
}

/* ---- readings of the figure ---- */

/* Points from x = from to y = upto (INFINITY: to x = 1), on one element from (0, lower) of `size`, or on two such, one
 * above the other. */
typedef struct reading {
    const char *what;
    double from, upto, lower, size;
    int elements, n, degree;
    spacing how;
    surface_solver solver;
} reading;

static void put_reading(cloud *p, const reading *r, double c)
{
    put_cubic(p, c, r->from, isinf(r->upto) ? 1.0 : place_of(c, r->upto), r->n, r->how);
}

/* Points of one of the elements. */
static void pick(const reading *r, const cloud *all, int element, cloud *part)
{
    part->n = 0;
    for (int i = 0; i < all->n; ++i) {
        const double *x = all->x[i], *n = all->normal[i];
        const int own = r->elements > 1 && x[1] >= r->lower + r->size ? 1 : 0;
        if (own == element) add(part, x[0], x[1], 0.0, n[0], n[1], 0.0);
    }
}

/* Angles with the k-th of the points off the surface. */
static errors errors_with(const reading *r, const cloud *all, int k)
{
    static cloud part;
    errors e = {0};
    for (int element = 0; element < r->elements; ++element) {
        const double lower[3] = {0.0, r->lower + element * r->size, 0.0}, size[3] = {r->size, r->size, r->size};
        isosurface f;
        double away[3], n[3];
        pick(r, all, element, &part);
        isosurface_begin(&f, r->solver, 2, r->degree, lower, size);
        for (int i = 0; i < part.n; ++i) isosurface_add(&f, part.x[i]);
        isosurface_away(&f, k, away);
        const bool solved = isosurface_solve(&f, away);
        for (int i = 0; i < part.n; ++i) {
            (void)isosurface_normal(&f, part.x[i], n);
            enter(&e, solved ? angle(n, part.normal[i]) : 90.0);
        }
    }
    return e;
}

static int by_most(const void *a, const void *b)
{
    return ascending(&((const errors *)a)->most, &((const errors *)b)->most);
}

/* Over a hundred points off the surface: quartiles of the worst angle, and the norm over N (what the paper's table III
 * calls rms) of the median. */
static void print_reading(const reading *r, double c)
{
    static cloud all;
    errors e[DRAWS];
    put_reading(&all, r, c);
    for (int k = 0; k < DRAWS; ++k) e[k] = errors_with(r, &all, k);
    qsort(e, DRAWS, sizeof *e, by_most);
    const errors *middle = &e[DRAWS / 2];
    printf(",%d,%.2f,%.2f,%.2f,%.2f", all.n, e[DRAWS / 4].most, middle->most, e[3 * DRAWS / 4].most,
           rms(middle) / sqrt(middle->n));
}

/* The first is the one that comes nearest; each of the others differs from it in the one thing that it names. */
static const reading readings[] = {
    {"nearest", 0.05, 0.85, 0.0, 1.0, 1, 8, 2, BY_ARC, SOLVE_QR},
    {"normal equations", 0.05, 0.85, 0.0, 1.0, 1, 8, 2, BY_ARC, SOLVE_NORMAL_EQUATIONS},
    {"linear splines", 0.05, 0.85, 0.0, 1.0, 1, 8, 1, BY_ARC, SOLVE_QR},
    {"evenly in x", 0.05, 0.85, 0.0, 1.0, 1, 8, 2, BY_ABSCISSA, SOLVE_QR},
    {"7 points", 0.05, 0.85, 0.0, 1.0, 1, 7, 2, BY_ARC, SOLVE_QR},
    {"9 points", 0.05, 0.85, 0.0, 1.0, 1, 9, 2, BY_ARC, SOLVE_QR},
    {"12 points", 0.05, 0.85, 0.0, 1.0, 1, 12, 2, BY_ARC, SOLVE_QR},
    {"16 points", 0.05, 0.85, 0.0, 1.0, 1, 16, 2, BY_ARC, SOLVE_QR},
    {"from x = 0.1 to y = 0.9", 0.1, 0.9, 0.0, 1.0, 1, 8, 2, BY_ARC, SOLVE_QR},
    {"9 points from x = 0.1 to y = 0.9", 0.1, 0.9, 0.0, 1.0, 1, 9, 2, BY_ARC, SOLVE_QR},
    {"from x = 0 to y = 1", 0.0, 1.0, 0.0, 1.0, 1, 8, 2, BY_ARC, SOLVE_QR},
    {"middles of sixteenths of x", 0.0, 1.0, 0.0, 1.0, 1, 16, 2, SIXTEENTHS, SOLVE_QR},
    {"x from 0 to 1 on one element from y = 0.5", 0.0, INFINITY, 0.5, 1.0, 1, 8, 2, BY_ARC, SOLVE_QR},
    {"x from 0 to 1 on one element of 2", 0.0, INFINITY, 0.0, 2.0, 1, 16, 2, BY_ARC, SOLVE_QR},
    {"x from 0 to 1 on two elements", 0.0, INFINITY, 0.0, 1.0, 2, 16, 2, BY_ARC, SOLVE_QR},
};

static void table_readings(void)
{
    printf("reading,splines,solver,spacing");
    for (int c = 2; c <= 4; c += 2)
        printf(",n %d,lower quartile %d,median %d,upper quartile %d,norm over N %d", c, c, c, c, c);
    printf("\n");
    for (size_t k = 0; k < sizeof readings / sizeof readings[0]; ++k) {
        const reading *r = &readings[k];
        printf("%s,%d,%s,%s", r->what, r->degree, r->solver == SOLVE_QR ? "QR" : "normal equations",
               spacing_name[r->how]);
        for (int c = 2; c <= 4; c += 2) print_reading(r, c);
        printf("\n");
    }
}

/* ---- what points and cells bring ---- */

static const char *const method_name[] = {"connectivity", "isosurface", "isosurface_quadratic", "quadric"};
enum { METHODS = sizeof method_name / sizeof method_name[0] };

static void print_methods(double c, double h, int n)
{
    static cloud p;
    static field f;
    const double par[] = {1.0};
    begin(&f, 2, 2.0, h);
    f.set.closed = false;
    put_cubic(&p, c, readings[0].from, place_of(c, readings[0].upto), n, BY_ARC);
    for (int m = 0; m < METHODS; ++m) {
        const errors e = measure(&f, &p, surface_find(method_name[m]), par);
        printf(",%.3g,%.3g", e.most, rms(&e));
    }
    end(&f);
}

static void print_head(const char *first)
{
    printf("c,%s", first);
    for (int m = 0; m < METHODS; ++m) printf(",%s most,%s rms", method_name[m], method_name[m]);
    printf("\n");
}

/* The same part of the curve, with more points on the one element. */
static void table_points(void)
{
    print_head("points");
    for (int c = 2; c <= 4; c += 2)
        for (int n = 6; n <= 192; n *= 2) {
            printf("%d,%d", c, n);
            print_methods(c, 1.0, n);
            printf("\n");
        }
}

/* Eight points to a cell's length along the curve, and smaller cells. */
static void table_cells(void)
{
    print_head("h");
    for (int c = 2; c <= 4; c += 2)
        for (int cells = 1; cells <= 16; cells *= 2) {
            printf("%d,%g", c, 1.0 / cells);
            print_methods(c, 1.0 / cells, 8 * cells);
            printf("\n");
        }
}

static const bench_table tables[] = {
    {"readings", "figure 10 by the ways to read it", table_readings},
    {"points_cubic", "error by points on the element", table_points},
    {"cells", "error by the size of cells", table_cells},
};

int main(int argc, char **argv)
{
    return print_table(argc, argv, sizeof tables / sizeof tables[0], tables);
}
