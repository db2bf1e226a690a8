/* Remarks on shapes: bodies that the mesh cannot carry, or that lie elsewhere, and probes beside smeared solids. */
#include "scene/remark_internal.h"

#include "geom/bounds.h"
#include "geom/compound.h"
#include "scene/slender.h"
#include "scene/state.h"

#include <math.h>
#include <stdio.h>

enum { TEXT_SIZE = 512, PIECES = 24 /* that a body is cut into along an axis, to be measured */ };

static bool is_solid(const scene *s, const scene_body *b)
{
    return s->material[b->material].kind == MATERIAL_SOLID && b->shape.model;
}

static bool is_wall_or_mirror(const scene *s, int axis, int end)
{
    const bc_kind kind = s->bc.side[axis][end].kind;
    const bool on_axis = s->mesh.geometry == MESH_AXISYMMETRIC && axis == 0 && end == SIDE_LOWER;
    return kind == BC_SYMMETRY || kind == BC_SLIP || kind == BC_PERIODIC || kind == BC_NO_SLIP || kind == BC_VELOCITY ||
           on_axis;
}

/* What lies beyond a mirror or a wall is no part of the scene; what lies beyond other sides is lost. */
static void remark_outside(const scene *s, const scene_body *b, remark_sink *say, void *user)
{
    const int dim = s->mesh.dim;
    const bool radial = s->mesh.geometry == MESH_AXISYMMETRIC;
    double lo[3] = {0}, hi[3] = {0}, h[3] = {1, 1, 1}, from[3] = {0}, to[3] = {0};
    if (!shape_bounds(&b->shape, dim, lo, hi)) return;
    for (int a = 0; a < dim; ++a) {
        if (is_wall_or_mirror(s, a, SIDE_LOWER)) lo[a] = fmax(lo[a], s->mesh.lower[a]);
        if (is_wall_or_mirror(s, a, SIDE_UPPER)) hi[a] = fmin(hi[a], s->mesh.upper[a]);
        if (!(lo[a] < hi[a])) return;
        h[a] = (hi[a] - lo[a]) / PIECES;
    }
    const double all = compound_volume(&b->shape, dim, lo, hi, h, radial);
    for (int a = 0; a < dim; ++a) {
        from[a] = fmax(lo[a], s->mesh.lower[a]);
        to[a] = fmin(hi[a], s->mesh.upper[a]);
        if (!(from[a] < to[a])) return; /* refused: it lies outside */
        h[a] = (to[a] - from[a]) / PIECES;
    }
    const double inside = compound_volume(&b->shape, dim, from, to, h, radial);
    const double meant = 0.1; /* decks cut bodies on purpose, too: pressed_cylinder.yaml has 14 % of a disc */
    if (!(inside < meant * all)) return;
    char text[TEXT_SIZE];
    (void)snprintf(text, sizeof text, "only %.3g %% of body '%s' lies in the domain: the rest is left out",
                   100.0 * inside / all, b->name);
    say(user, text);
}

/* The largest share of a cell that a body fills. */
static double largest_fill(const scene *s, const scene_body *b)
{
    enum { DEPTH = 4 };
    const mesh_spec *m = &s->mesh;
    double lo[3] = {0}, hi[3] = {0}, most = 0.0;
    int first[3] = {0, 0, 0}, last[3] = {1, 1, 1};
    if (!shape_bounds(&b->shape, m->dim, lo, hi)) return 1.0;
    for (int a = 0; a < m->dim; ++a) {
        first[a] = (int)fmax(floor((fmax(lo[a], m->lower[a]) - m->lower[a]) / m->cell[a]), 0.0);
        last[a] = (int)ceil((fmin(hi[a], m->upper[a]) - m->lower[a]) / m->cell[a]);
    }
    for (int k = first[2]; k < last[2]; ++k)
        for (int j = first[1]; j < last[1]; ++j)
            for (int i = first[0]; i < last[0]; ++i) {
                const int at[3] = {i, j, k};
                double from[3] = {0}, to[3] = {0}, centroid[3];
                for (int a = 0; a < m->dim; ++a) {
                    from[a] = m->lower[a] + at[a] * m->cell[a];
                    to[a] = from[a] + m->cell[a];
                }
                most = fmax(most, shape_fraction(&b->shape, m->dim, from, to, false, DEPTH, centroid));
                if (most > 0.98) return most;
            }
    return most;
}

static void remark_thin(const scene *s, const scene_body *b, remark_sink *say, void *user)
{
    const double most = largest_fill(s, b);
    if (most > 0.98) return;
    char text[TEXT_SIZE];
    (void)snprintf(
        text, sizeof text,
        "body '%s' is thinner than its cells: it fills %.3g %% of one at most, so that no cell is its own and "
        "its bending and its stress are not resolved. Refine domain.cell",
        b->name, 100.0 * most);
    say(user, text);
}

static void remark_bending(const scene *s, const scene_body *b, remark_sink *say, void *user)
{
    int axis;
    const double across = slender_across(s, b, b->per_cell, &axis);
    if (s->coupling == COUPLING_ICE || !(across < SLENDER_ENOUGH - 0.5)) return;
    for (int a = 0; a < s->mesh.dim; ++a)
        if ((axis < 0 || axis == a) && b->per_cell[a] >= SLENDER_POINTS) return;
    remark_speaker w = {.s = s, .say = say, .user = user};
    remark_set_key(&w, "bodies", b->name, "points");
    remark_key(&w,
               "body '%s' has %.0f points across: where it bends it is %.2g %% too soft, one part in their number "
               "squared. Leave its points out, and it gets more",
               b->name, across, 100.0 / (across * across));
}

/* Points of a membrane along an axis of a cell; INFINITY where they are listed. */
static double membrane_density(const scene *s, const scene_body *b)
{
    const scene_membrane *m = &b->membrane;
    const bool curve = m->surface.kind == SHEET_NONE;
    double h = INFINITY;
    for (int a = 0; a < s->mesh.dim; ++a) h = fmin(h, s->mesh.cell[a]);
    if (curve ? m->curve.kind == CURVE_POINTS : m->surface.kind == SHEET_POINTS) return INFINITY;
    if (m->number == 0) return b->per_cell[0];
    return curve ? m->number * h / curve_length(&m->curve, s->mesh.dim) : (double)INFINITY;
}

/* Too few points do not balance a gas at the nodes, and strains by rate creep with what is left (theory 8.1). */
static void remark_creep(const scene *s, const scene_body *b, remark_sink *say, void *user)
{
    const scene_membrane *m = &b->membrane;
    const bool curve = m->surface.kind == SHEET_NONE;
    const double points = membrane_density(s, b), enough = curve ? 5.9 : 2.9;
    bool fluids = false;
    for (int k = 0; k < s->n_materials; ++k) fluids = fluids || s->material[k].kind == MATERIAL_FLUID;
    if (!m->present || !fluids || m->strain == STRAIN_BY_POSITIONS || !(m->slack < 0.0) || !(points < enough)) return;
    remark_speaker w = {.s = s, .say = say, .user = user};
    remark_set_key(&w, "bodies", b->name, "membrane");
    remark_key(
        &w,
        "membrane '%s' is taut at the start and has %.2g points a cell: its strain creeps, since so few do not "
        "balance a fluid at each node. A round one of ten cells of radius lost 5.7, 1.3, 1.1, 0.2 and 0.06 %% of "
        "its strain in three breaths with 2, 3, 4, 6 and 8 points, one of 20 cells all of it, 5.4, 1.4, 0.3 and "
        "0.08 %%. Take %d%s",
        b->name, points, curve ? MEMBRANE_CURVE_POINTS : MEMBRANE_SURFACE_POINTS,
        curve ? ", or `strain: positions`" : "");
}

/* Points spread a solid over the cells about its surface, where the fluid is not what it is beside a wall. */
static void remark_probe(const scene *s, const scene_probe *p, remark_sink *say, void *user)
{
    double h = INFINITY;
    for (int a = 0; a < s->mesh.dim; ++a) h = fmin(h, s->mesh.cell[a]);
    for (int b = 0; b < s->n_bodies; ++b) {
        if (!is_solid(s, &s->body[b])) continue;
        const shape *of = &s->body[b].shape;
        const double distance = of->model->level(of->par, s->mesh.dim, p->position);
        if (!(fabs(distance) < h)) continue;
        char text[TEXT_SIZE];
        (void)snprintf(text, sizeof text,
                       "probe '%s' is %.2g cells %s the surface of body '%s', which the smeared interface spreads over "
                       "that cell: what it shows is of neither. Move it by a cell, or take interface: sharp",
                       p->name, fabs(distance) / h, distance < 0.0 ? "inside" : "outside", s->body[b].name);
        say(user, text);
    }
}

void remark_shapes(const scene *s, remark_sink *say, void *user)
{
    for (int b = 0; b < s->n_bodies; ++b) {
        if (s->coupling != COUPLING_ICE) remark_creep(s, &s->body[b], say, user);
        if (!s->body[b].shape.model) continue;
        remark_outside(s, &s->body[b], say, user);
        if (s->mesh.dim == 1 || !is_solid(s, &s->body[b])) continue;
        remark_thin(s, &s->body[b], say, user);
        remark_bending(s, &s->body[b], say, user);
    }
    if (s->coupling != COUPLING_ICE_MPM || s->method.interface != INTERFACE_SMEARED) return;
    for (int p = 0; p < s->n_probes; ++p) remark_probe(s, &s->probe[p], say, user);
}
