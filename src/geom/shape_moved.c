/* A shape elsewhere: turned about a point, then moved. */
#include "geom/shape.h"

#include <math.h>

typedef struct moved_par {
    shape of;
    double by[3], about[3], turned, axis[3]; /* m, m, rad, no unit */
    double turn[3][3], shift[3];             /* x = turn y + shift, of the shape's own y; m */
} moved_par;

static const param_spec moved_params[] = {
    PAR_MODEL(moved_par, of, 0, "the shape as it is before"),
    PAR_VECTOR(moved_par, by, "m", PARAM_ANY, 0.0, "how far it is moved, after it is turned"),
    PAR_ANY(moved_par, turned, "rad", 0.0, "angle by which it is turned, counterclockwise; `30 degree` is 30 degrees"),
    PAR_VECTOR(moved_par, about, "m", PARAM_ANY, 0.0, "point about which it is turned"),
    PAR_VECTOR(moved_par, axis, "1", PARAM_ANY, 0.0,
               "in space: direction of the axis through that point, of any length; without it that of z"),
};

/* Sine and cosine, exact for right angles. */
static void angle_functions(double angle, double *sine, double *cosine)
{
    static const double round_off = 1e-15;
    *sine = sin(angle);
    *cosine = cos(angle);
    if (fabs(*sine) < round_off || fabs(*cosine) < round_off) {
        *sine = nearbyint(*sine);
        *cosine = nearbyint(*cosine);
    }
}

/* Rodrigues' formula; the axis is z unless it is given. */
static void make_turn(moved_par *m, int dim)
{
    double sine, cosine, n[3] = {0.0, 0.0, 1.0};
    const double length = sqrt(m->axis[0] * m->axis[0] + m->axis[1] * m->axis[1] + m->axis[2] * m->axis[2]);
    angle_functions(m->turned, &sine, &cosine);
    for (int a = 0; a < 3 && dim == 3 && length > 0.0; a++) n[a] = m->axis[a] / length;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) m->turn[a][b] = (1.0 - cosine) * n[a] * n[b] + (a == b ? cosine : 0.0);
    for (int a = 0; a < 3; a++) {
        m->turn[a][(a + 1) % 3] -= sine * n[(a + 2) % 3];
        m->turn[a][(a + 2) % 3] += sine * n[(a + 1) % 3];
    }
    for (int a = 0; a < 3; a++) {
        m->shift[a] = m->by[a] + m->about[a];
        for (int b = 0; b < 3; b++) m->shift[a] -= m->turn[a][b] * m->about[b];
    }
}

static double moved_level(const void *par, int dim, const double x[3])
{
    const moved_par *m = par;
    double y[3] = {0.0};
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) y[a] += m->turn[b][a] * (x[b] - m->shift[b]);
    return shape_level(&m->of, dim, y);
}

static bool moved_bounds(const void *par, int dim, double lo[3], double hi[3])
{
    const moved_par *m = par;
    double from[3], to[3];
    if (!m->of.model->bounds(m->of.par, dim, from, to)) return false;
    for (int a = 0; a < dim; a++) {
        lo[a] = hi[a] = m->shift[a];
        for (int b = 0; b < dim; b++) {
            lo[a] += fmin(m->turn[a][b] * from[b], m->turn[a][b] * to[b]);
            hi[a] += fmax(m->turn[a][b] * from[b], m->turn[a][b] * to[b]);
        }
    }
    return true;
}

/* Axes that go over into axes keep boxes boxes. */
static bool moved_fills(const void *par, int dim)
{
    const moved_par *m = par;
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++)
            if (m->turn[a][b] != nearbyint(m->turn[a][b])) return false;
    return shape_fills_bounds(&m->of, dim);
}

/* Known where it is not turned, nor moved from or to the axis of the volumes that are weighted by the radius. */
static bool moved_moments(const void *par, int dim, const double lo[3], const double hi[3], bool weight_by_radius,
                          shape_moments *out)
{
    const moved_par *m = par;
    double from[3] = {0.0}, to[3] = {0.0};
    shape_moments own;
    if (weight_by_radius && m->shift[0] != 0.0) return false;
    for (int a = 0; a < dim; a++) {
        if (m->turn[a][a] != 1.0) return false;
        from[a] = lo[a] - m->shift[a];
        to[a] = hi[a] - m->shift[a];
    }
    if (!shape_exact_moments(&m->of, dim, from, to, weight_by_radius, &own)) return false;
    for (int a = 0; a < dim; a++) own.first[a] += own.volume * m->shift[a];
    *out = own;
    return true;
}

static const char *moved_check(const void *par, int dim)
{
    const moved_par *m = par;
    bool axis = false;
    for (int a = 0; a < dim; a++) axis = axis || m->axis[a] != 0.0;
    if (dim == 1 && m->turned != 0.0) return "on a line nothing can be turned";
    if (dim < 3 && axis) return "'axis' is of scenes in space: in the plane a shape is turned about a point";
    return NULL;
}

static floe_status moved_prepare(void *par, int dim, const shape_memory *memory, char why[SHAPE_WHY])
{
    (void)memory;
    (void)why;
    make_turn(par, dim);
    return FLOE_OK;
}

const shape_model shape_moved = {
    .name = "moved",
    .doc = "a shape turned and moved",
    .param_size = sizeof(moved_par),
    .params = moved_params,
    .n_params = sizeof moved_params / sizeof *moved_params,
    .min_dim = 1,
    .max_dim = 3,
    .level = moved_level,
    .bounds = moved_bounds,
    .fills = moved_fills,
    .moments = moved_moments,
    .check = moved_check,
    .prepare = moved_prepare,
};
