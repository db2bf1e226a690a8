/* Remarks on supports that constrain what passes their surface at the last nodes inside, not there (theory 4.13). */
#include "scene/remark_internal.h"

#include "geom/bounds.h"

#include <math.h>
#include <string.h>

/* Of a cell: as far behind a surface nodes are taken to lie on it. */
static const double close_enough = 0.15;

/* A place where a surface lies farthest beyond the last node inside. */
typedef struct support_depth {
    double cells, at[3];
} support_depth;

/* Nodes about a body; of a membrane, which has no shape, all. */
typedef struct node_range {
    int begin[3], end[3];
} node_range;

static node_range nodes_about(const scene *s, const scene_body *b)
{
    const mesh_spec *m = &s->mesh;
    node_range r = {.end = {1, 1, 1}};
    double lo[3] = {0.0}, hi[3] = {0.0};
    const bool bounded = b->shape.model && shape_bounds(&b->shape, m->dim, lo, hi);
    for (int a = 0; a < m->dim; ++a) {
        const double nodes = floor((m->upper[a] - m->lower[a]) / m->cell[a] + 0.5) + 1.0;
        const double first = bounded ? floor((lo[a] - m->lower[a]) / m->cell[a]) - 1.0 : 0.0;
        const double last = bounded ? ceil((hi[a] - m->lower[a]) / m->cell[a]) + 2.0 : nodes;
        r.begin[a] = (int)fmax(0.0, first);
        r.end[a] = (int)fmin(nodes, last);
    }
    return r;
}

/* Whether a body may pass a surface at x along an axis: lines of nodes pass by bodies thinner than a cell. */
static bool may_pass(const scene *s, const scene_body *b, const double x[3], int axis)
{
    double lo[3], hi[3];
    if (!b->shape.model || !shape_bounds(&b->shape, s->mesh.dim, lo, hi)) return true;
    for (int a = 0; a < s->mesh.dim; ++a) {
        const double beside = a == axis ? -1e-3 * s->mesh.cell[a] : s->mesh.cell[a];
        if (x[a] < lo[a] - beside || x[a] > hi[a] + beside) return false;
    }
    return true;
}

enum { CROSSING_PASSES = 20 }; /* halvings, to a millionth of a cell */

/* From a node inside along an axis to the surface, if that is nearer than the next node. */
static void look_along(const scene *s, const shape *region, const scene_body *b, const double node[3], int axis,
                       double step, support_depth *deepest)
{
    double next[3], x[3];
    memcpy(next, node, sizeof next);
    next[axis] += step;
    if (shape_inside(region, s->mesh.dim, next)) return;
    const double inside = shape_crossing(region, s->mesh.dim, 0.0, node, next, CROSSING_PASSES, x);
    if (inside <= deepest->cells || !may_pass(s, b, x, axis)) return;
    deepest->cells = inside;
    for (int a = 0; a < 3; ++a) deepest->at[a] = fabs(x[a]) > 1e-5 * fabs(step) ? x[a] : 0.0;
}

static support_depth find_depth(const scene *s, const shape *region, const scene_body *b)
{
    const mesh_spec *m = &s->mesh;
    const node_range r = nodes_about(s, b);
    support_depth deepest = {0.0, {0.0}};
    for (int k = r.begin[2]; k < r.end[2]; ++k)
        for (int j = r.begin[1]; j < r.end[1]; ++j)
            for (int i = r.begin[0]; i < r.end[0]; ++i) {
                const int node[3] = {i, j, k};
                double x[3] = {0.0};
                for (int a = 0; a < m->dim; ++a) x[a] = m->lower[a] + node[a] * m->cell[a];
                if (!shape_inside(region, m->dim, x)) continue;
                for (int a = 0; a < 2 * m->dim; ++a)
                    look_along(s, region, b, x, a / 2, a % 2 ? -m->cell[a / 2] : m->cell[a / 2], &deepest);
            }
    return deepest;
}

bool remark_is_among_fluids(const scene *s, int body)
{
    if (s->coupling != COUPLING_MPM || scene_fluids_apart(s) || scene_in_contact(s, body)) return false;
    for (int k = 0; k < s->n_bodies; ++k)
        if (s->material[s->body[k].material].kind == MATERIAL_FLUID && !scene_in_contact(s, k)) return true;
    return false;
}

static void remark_support(remark_speaker *w, const scene_support *support, int body)
{
    const scene *s = w->s;
    const scene_body *b = &s->body[body];
    const bool membrane = s->material[b->material].membrane != NULL;
    const support_depth d = find_depth(s, &support->region, b);
    if (d.cells < close_enough) return;
    remark_set_key(w, "supports", support->name, "");
    if (membrane)
        remark_key(w,
                   "membrane '%s' is constrained at the nodes inside the region, up to %.2g of a cell behind its "
                   "surface, as at (%.4g, %.4g, %.4g): a round one sagged by 24 %% too much with 5 cells of radius, by "
                   "13 with 10. Let the region end 0.01 to %.2g of a cell beyond nodes, or refine",
                   b->name, d.cells, d.at[0], d.at[1], d.at[2], close_enough);
    else
        remark_key(
            w,
            "body '%s' %s and is constrained at the nodes inside the region, up to %.2g of a cell behind its "
            "surface, as at (%.4g, %.4g, %.4g): it bends as a longer one, a cantilever of 20 cells by %.0f %% too "
            "much. Let the region end 0.01 to %.2g of a cell beyond nodes (4 to 7 %%), or refine",
            b->name,
            scene_drives_beside_implicit(s) ? "meets supports that move beside an implicit pressure"
                                            : "has one velocity with fluids on points",
            d.cells, d.at[0], d.at[1], d.at[2], 4.0 + 17.5 * d.cells, close_enough);
}

void remark_supports(const scene *s, remark_sink *say, void *user)
{
    remark_speaker w = {.s = s, .say = say, .user = user};
    for (int k = 0; k < s->n_supports; ++k)
        for (int body = 0; body < s->n_bodies; ++body) {
            const scene_material *m = &s->material[s->body[body].material];
            if (m->membrane ||
                (remark_is_solid(m) && (remark_is_among_fluids(s, body) || scene_drives_beside_implicit(s))))
                remark_support(&w, &s->support[k], body);
        }
}
