/* A polynomial over the tangent plane through the nearest points, weighted by distance: moving least squares (Lancaster
 * and Salkauskas 1981; Alexa et al. 2003). It goes by the spacing of the points and not by the mesh: cells only help to
 * find neighbours. In a plane the polynomial is cubic: with two neighbours on either side it has the slope of the
 * five-point formula, and where arcs and lines join errs less than the chord of the neighbours. In space it is
 * quadratic. */
#include "math/tensor.h"
#include "surface/height.h"

#include <math.h>
#include <string.h>

extern const surface_method surface_quadric;

typedef struct quadric_par {
    double spread;
} quadric_par;

static const param_spec params[] = {
    PAR_BETWEEN(quadric_par, spread, "1", 1.0, 6.0, 1.0,
                "how far it reaches, over the least that determines it; more of it smooths noisy positions"),
};

enum { FITS = 2 };

/* Neighbours that set the reach: two on either side, or the eight about a point of a lattice. */
static int scale_count(int dim)
{
    return dim == 3 ? 8 : 4;
}

static const double margin = 1.25; /* of the reach beyond them, so that they have weight */

/* A point's surroundings. */
typedef struct surroundings {
    int dim, n;
    double reach; /* m */
    surface_neighbour near[SURFACE_MOST_NEAR];
} surroundings;

/* Neighbours that may lie within the reach, where points stand three times as close on one side as on the other. */
static int most_near(int dim, double spread)
{
    const double n = 3.0 * scale_count(dim) * (dim == 3 ? spread * spread : spread);
    return n < SURFACE_MOST_NEAR ? (int)n : SURFACE_MOST_NEAR;
}

/* The cells about one, made as they are needed. */
typedef struct blocks {
    const surface_set *s;
    const surface_cell *c;
    int made;
    surface_block ring[SURFACE_RINGS];
} blocks;

static const surface_block *block_of(blocks *b, int ring)
{
    for (; b->made < ring; b->made++) surface_block_about(b->s, b->c->at, b->made + 1, &b->ring[b->made]);
    return &b->ring[ring - 1];
}

static void find_neighbours(blocks *b, const surface_entry *e, double spread, surroundings *out)
{
    const int wanted = scale_count(b->s->mesh->dim);
    int found = 0;
    out->dim = b->s->mesh->dim;
    for (int ring = 1; ring <= SURFACE_RINGS; ++ring) {
        const surface_block *about = block_of(b, ring);
        out->reach = margin * spread * surface_distance_in(b->s, about, e, wanted, &found);
        if (ring < SURFACE_RINGS && (found < wanted || out->reach > surface_block_covers(b->s, e, ring))) continue;
        out->n = surface_within_in(b->s, about, e, out->reach, most_near(out->dim, spread), out->near);
        return;
    }
}

/* Sum of the principal curvatures of the height about the point, along the frame's normal side: x holds 1, u, (v,) u2,
 * (uv, v2). */
static double curvature_of(int dim, const double *x, double reach)
{
    if (dim < 3) return -2.0 * x[2] / reach / pow(1.0 + x[1] * x[1], 1.5);
    const double p = x[1], q = x[2], r = 2.0 * x[3], s = x[4], t = 2.0 * x[5], g = 1.0 + p * p + q * q;
    return -((1.0 + q * q) * r - 2.0 * p * q * s + (1.0 + p * p) * t) / (g * sqrt(g)) / reach;
}

/* Half of the way to the next point on either side of the normal; at a free end that of the other side. */
static double share_of_line(const surroundings *about, const double u[3])
{
    double before = INFINITY, after = INFINITY;
    for (int k = 0; k < about->n; ++k) {
        const double along = vec_dot(about->near[k].d, u), length = sqrt(about->near[k].square);
        if (along > 0.0) after = fmin(after, length);
        if (along < 0.0) before = fmin(before, length);
    }
    if (isinf(before) && isinf(after)) return NAN;
    return isinf(before) ? after : isinf(after) ? before : 0.5 * (before + after);
}

/* Corners of a polygon in the tangent plane. */
enum { MOST_CORNERS = 32 };
typedef struct polygon {
    double x[MOST_CORNERS][2];
    int n;
} polygon;

/* What lies nearer to 0 than to (u, v). */
static void clip_polygon(polygon *p, double u, double v)
{
    polygon kept = {.n = 0};
    const double level = 0.5 * (u * u + v * v);
    for (int k = 0; k < p->n && kept.n + 2 <= MOST_CORNERS; ++k) {
        const double *a = p->x[k], *b = p->x[(k + 1) % p->n];
        const double fa = a[0] * u + a[1] * v - level, fb = b[0] * u + b[1] * v - level;
        if (fa <= 0.0) memcpy(kept.x[kept.n++], a, sizeof kept.x[0]);
        if ((fa < 0.0 && fb > 0.0) || (fa > 0.0 && fb < 0.0)) {
            const double share = fa / (fa - fb);
            for (int c = 0; c < 2; ++c) kept.x[kept.n][c] = a[c] + share * (b[c] - a[c]);
            kept.n++;
        }
    }
    *p = kept;
}

/* Of the corner that is farthest from 0. */
static double square_about(const polygon *p)
{
    double most = 0.0;
    for (int k = 0; k < p->n; ++k) most = fmax(most, p->x[k][0] * p->x[k][0] + p->x[k][1] * p->x[k][1]);
    return most;
}

static double area_of(const polygon *p)
{
    double twice = 0.0;
    for (int k = 0; k < p->n; ++k) {
        const double *a = p->x[k], *b = p->x[(k + 1) % p->n];
        twice += a[0] * b[1] - a[1] * b[0];
    }
    return 0.5 * twice;
}

/* Area of the part of the tangent plane that is nearer to the point than to any other (Voronoi), within the reach. */
static double share_of_plane(const surroundings *about, const surface_frame *f)
{
    const double r = 0.5 * about->reach, u = r, v = r;
    polygon p = {.x = {{-u, -v}, {u, -v}, {u, v}, {-u, v}}, .n = 4};
    for (int k = 0; k < about->n && p.n > 2; ++k) {
        const double a = vec_dot(about->near[k].d, f->u), b = vec_dot(about->near[k].d, f->v), square = a * a + b * b;
        /* A point twice as far as all corners cuts none of them. */
        if (square > 1e-12 * about->reach * about->reach && square < 4.0 * square_about(&p)) clip_polygon(&p, a, b);
    }
    return area_of(&p);
}

static bool fit_quadric(const surroundings *about, bool measures, surface_estimate *out)
{
    surface_frame f;
    height_fit found;
    if (!surface_plane(about->dim, about->n, about->near, about->reach, &f)) return false;
    for (int k = 0; k < FITS; ++k) {
        if (!height_find(about->dim, about->n, about->near, about->reach, &f, &found)) return false;
        double n[3];
        for (int a = 0; a < 3; ++a) n[a] = f.n[a] - found.x[1] * f.u[a] - (about->dim == 3 ? found.x[2] * f.v[a] : 0.0);
        vec_normalize(n);
        if (measures) out->curvature = curvature_of(about->dim, found.x, about->reach);
        surface_frame_about(about->dim, n, &f);
    }
    memcpy(out->normal, f.n, sizeof f.n);
    out->condition = found.condition;
    if (measures) out->area = about->dim == 3 ? share_of_plane(about, &f) : share_of_line(about, f.u);
    out->basis = SURFACE_METHOD;
    return true;
}

static void estimate_by_quadric(const surface_set *s, const void *par, const surface_cell *c, surface_estimate *out)
{
    const quadric_par *q = par;
    blocks b = {.s = s, .c = c};
    for (size_t k = 0; k < c->n; ++k) {
        const surface_entry *e = &s->points.entry[c->first + k];
        if (e->image != 0) continue;
        surroundings about;
        find_neighbours(&b, e, q->spread, &about);
        (void)fit_quadric(&about, s->measures, &out[e->number]);
    }
}

const surface_method surface_quadric = {
    .name = "quadric",
    .doc = "polynomial over the tangent plane through the nearest points, weighted by their distance; with curvature "
           "and area",
    .cite = "moving least squares: Alexa et al. 2003",
    .min_dim = 2,
    .param_size = sizeof(quadric_par),
    .params = params,
    .n_params = sizeof params / sizeof *params,
    .exact = true,
    .cell = estimate_by_quadric,
};
