#include "surface/colour.h"

#include "math/tensor.h"

#include <string.h>

enum { MOST_NODES = SPLINE_MOST * SPLINE_MOST * SPLINE_MOST };

/* What the nodes about a cell hold: colour, and its gradient (1/m). */
typedef struct colour_nodes {
    const surface_set *s;
    const colour_rule *rule;
    const surface_cell *c;
    double colour[MOST_NODES], gradient[MOST_NODES][3];
} colour_nodes;

/* Weight and gradient of the k-th product of splines, whose places along the axes come back in `at`. */
static double spline_product(const surface_set *s, const spline_values *along, int per_axis, int k, int at[3],
                             double gradient[3])
{
    double w = 1.0;
    for (int a = 0; a < 3; ++a) {
        at[a] = a < s->mesh->dim ? k % per_axis : 0;
        if (a < s->mesh->dim) k /= per_axis;
        gradient[a] = a < s->mesh->dim ? along[a].dw[at[a]] / s->mesh->h[a] : 0.0;
        w *= a < s->mesh->dim ? along[a].w[at[a]] : 1.0;
    }
    for (int a = 0; a < s->mesh->dim; ++a)
        for (int b = 0; b < s->mesh->dim; ++b)
            if (b != a) gradient[a] *= along[b].w[at[b]];
    return w;
}

static int integer_power(int base, int exponent)
{
    int r = 1;
    for (int k = 0; k < exponent; ++k) r *= base;
    return r;
}

static void splines_at(const surface_set *s, const surface_entry *e, spline_values (*spline)(double),
                       spline_values *along)
{
    for (int a = 0; a < s->mesh->dim; ++a)
        along[a] = spline((e->x[a] - mesh_node(s->mesh, a, e->cell[a])) / s->mesh->h[a]);
}

/* Number of a node among those about the cell; -1: it is none of them. */
static int node_number(const colour_nodes *n, const surface_entry *e, const spline_values *along, const int at[3])
{
    int number = 0;
    for (int a = n->s->mesh->dim - 1; a >= 0; --a) {
        const int from = e->cell[a] - n->c->at[a] + along[a].first + at[a] - n->rule->first;
        if (from < 0 || from >= n->rule->n) return -1;
        number = number * n->rule->n + from;
    }
    return number;
}

static void spread_point(colour_nodes *n, const surface_entry *e)
{
    spline_values along[3] = {{0}};
    splines_at(n->s, e, n->rule->spread, along);
    const int count = integer_power(along[0].n, n->s->mesh->dim);
    for (int k = 0; k < count; ++k) {
        int at[3];
        double gradient[3];
        const double w = spline_product(n->s, along, along[0].n, k, at, gradient);
        const int node = node_number(n, e, along, at);
        if (node < 0) continue;
        n->colour[node] += w;
        vec_add_scaled(1.0, gradient, n->gradient[node]);
    }
}

static void spread_cell(colour_nodes *n, const surface_bins *bins, const int at[3])
{
    const surface_cell *c = surface_cell_at(bins, at);
    for (size_t k = 0; c && k < c->n; ++k) spread_point(n, &bins->entry[c->first + k]);
}

/* All points that reach the nodes about the cell. */
static void gather_colour(colour_nodes *n)
{
    int reach[3], at[3];
    for (int a = 0; a < 3; ++a) reach[a] = a < n->s->mesh->dim ? SURFACE_HALO : 0;
    for (int z = -reach[2]; z <= reach[2]; ++z)
        for (int y = -reach[1]; y <= reach[1]; ++y)
            for (int x = -reach[0]; x <= reach[0]; ++x) {
                at[0] = n->c->at[0] + x;
                at[1] = n->c->at[1] + y;
                at[2] = n->c->at[2] + z;
                spread_cell(n, &n->s->points, at);
                spread_cell(n, &n->s->inside, at);
            }
}

static void read_normal(const colour_nodes *n, const surface_entry *e, double normal[3])
{
    spline_values along[3] = {{0}};
    splines_at(n->s, e, n->rule->of_nodes ? spline_linear : n->rule->spread, along);
    const int count = integer_power(along[0].n, n->s->mesh->dim);
    memset(normal, 0, 3 * sizeof *normal);
    for (int k = 0; k < count; ++k) {
        int at[3];
        double gradient[3];
        const double w = spline_product(n->s, along, along[0].n, k, at, gradient);
        const int node = node_number(n, e, along, at);
        if (n->rule->of_nodes)
            vec_add_scaled(-w, n->gradient[node], normal);
        else
            vec_add_scaled(-n->colour[node], gradient, normal);
    }
}

void colour_of_cell(const surface_set *s, const colour_rule *rule, const surface_cell *c, surface_estimate *out)
{
    colour_nodes n = {.s = s, .rule = rule, .c = c};
    gather_colour(&n);
    for (size_t k = 0; k < c->n; ++k) {
        const surface_entry *e = &s->points.entry[c->first + k];
        double normal[3];
        if (e->image != 0) continue;
        read_normal(&n, e, normal);
        if (!(vec_normalize(normal) > 0.0)) continue;
        memcpy(out[e->number].normal, normal, sizeof normal);
        out[e->number].basis = SURFACE_METHOD;
    }
}
