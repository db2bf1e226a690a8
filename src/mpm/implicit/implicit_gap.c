/* Gaps between bodies in contact, from surfaces that move with the bodies' displacements. A node sees the surface elements of each body with its own weights
 * w_i:
 *
 *     n ~ sum_a w_i A - sum_b w_i A,     g = mean_b x . n - mean_a x . n,
 *
 * summed over elements that face the other body, with means weighted by w_i (A . n). This is the gap for conditions at nodes, to second order in the spacing;
 * from the points alone it is known to a tenth of a cell. */
#include "mpm/implicit/implicit_constants.h"
#include "mpm/implicit/implicit_contact.h"
#include "mpm/implicit/implicit_view.h"
#include "mpm/mpm_constants.h"
#include "mpm/nodes/sides.h"
#include "mpm/surface/surface_facets.h"
#include "mpm/surface/surfaces.h"
#include "mpm/transfer/stencil.h"

#include <math.h>
#include <string.h>

bool implicit_measures_gaps(const mpm *s)
{
    return s->implicit && s->contact && s->scene->contact.touch == CONTACT_AT_POINTS;
}

/* A surface element as a node sees it: turned where the node is an image in a mirror. */
typedef struct seen_element {
    int node, layer;
    double weight, x[3], area[3];
} seen_element;

typedef enum gap_pass { GAP_NORMAL, GAP_PLACE } gap_pass;

/* Maps a node beyond a mirror or a periodic end to the node inside; false: there is none. */
static bool bring_inside(const mpm *s, int node[3], seen_element *e)
{
    for (int a = 0; a < s->mesh->dim; ++a) {
        const int n = s->mesh->n[a];
        if (s->mesh->periodic[a]) {
            node[a] = (node[a] + n) % n;
            continue;
        }
        if (node[a] >= 0 && node[a] <= n) continue;
        const int side = node[a] < 0 ? SIDE_LOWER : SIDE_UPPER, wall = side == SIDE_LOWER ? 0 : n;
        if (!wall_mirrors(s, 0, a, side)) return false;
        node[a] = 2 * wall - node[a];
        e->x[a] = 2.0 * mesh_node(s->mesh, a, wall) - e->x[a];
        e->area[a] = -e->area[a];
    }
    return true;
}

/* Elements whose normal is within 37 degrees of that of a condition face the other body; the sides of a block and its
 * corners do not. */
static bool faces_condition(const mpm *s, const seen_element *e, const contact_row *r, int side, double *along)
{
    double square = 0.0;
    *along = 0.0;
    for (int a = 0; a < s->mesh->dim; ++a) {
        *along += (side == 0 ? 1.0 : -1.0) * e->area[a] * r->along[a];
        square += e->area[a] * e->area[a];
    }
    return *along > 0.8 * sqrt(square);
}

static void add_to_row(const mpm *s, const seen_element *e, gap_pass pass, contact_row *r)
{
    double facing;
    const int side = e->layer == r->layer[0] ? 0 : 1;
    if (r->bound || r->lead >= 0 || e->layer != r->layer[side] || !faces_condition(s, e, r, side, &facing)) return;
    for (int a = 0; a < s->mesh->dim; ++a) {
        if (pass == GAP_NORMAL)
            r->area[side][a] += e->weight * e->area[a];
        else
            r->sum[side] += e->weight * facing * e->x[a] * r->along[a];
    }
    if (pass == GAP_PLACE) r->weight[side] += e->weight * facing;
}

static void add_gap_element(mpm *s, const seen_element *e, gap_pass pass)
{
    struct implicit_contact *c = s->implicit->contact;
    if (c->spot_of[e->node] < 0) return;
    const contact_spot *spot = &c->spot[c->spot_of[e->node]];
    for (int i = 0; i < spot->rows; ++i) add_to_row(s, e, pass, &c->row[spot->first + (size_t)i]);
}

static void for_elements(mpm *s, gap_pass pass)
{
    for (size_t k = 0; k < s->surfaces->n_facets; ++k) {
        const surface_facet *f = &s->surfaces->facet[k];
        double x[3];
        if (f->use != SURFACE_IN_CONTACT) continue;
        centre_of_facet(s, s->surfaces->corner, f, x);
        for (int a = 0; a < 3; ++a) x[a] += f->offset[a];
        const place_stencil st = stencil_at(s, x);
        for (int i = 0; i < st.n; ++i) {
            int node[3] = {st.node[i][0], st.node[i][1], st.node[i][2]};
            seen_element e = {.layer = implicit_layer(s, s->body_group[f->body]), .weight = st.w[i]};
            memcpy(e.x, x, sizeof e.x);
            memcpy(e.area, f->area, sizeof e.area);
            if (e.weight == 0.0 || !bring_inside(s, node, &e)) continue;
            e.node = (int)solve_index(&s->implicit->grid, node[0], node[1], node[2]);
            add_gap_element(s, &e, pass);
        }
    }
}

/* Removes the components of t along n other vectors and normalises it. */
static void remove_components(const contact_row *n, int others, double t[3])
{
    double square = 0.0;
    for (int k = 0; k < others; ++k) {
        double part = 0.0;
        for (int a = 0; a < 3; ++a) part += t[a] * n[k].along[a];
        for (int a = 0; a < 3; ++a) t[a] -= part * n[k].along[a];
    }
    for (int a = 0; a < 3; ++a) square += t[a] * t[a];
    for (int a = 0; a < 3; ++a) t[a] /= sqrt(square);
}

/* The normal of a condition from the area vectors, and the directions of its tangential conditions. */
static void turn_condition(const mpm *s, const contact_spot *spot, int i)
{
    contact_row *r = &s->implicit->contact->row[spot->first + (size_t)i];
    double n[3] = {0.0, 0.0, 0.0}, square[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        if (!s->implicit->constrained[implicit_index(s->implicit, 0, a, spot->node)])
            n[a] = r->area[0][a] - r->area[1][a];
        square[0] += n[a] * n[a];
        for (int side = 0; side < 2; ++side) square[1 + side] += r->area[side][a] * r->area[side][a];
    }
    if (!(square[0] > 0.0) || !(square[1] > 0.0) || !(square[2] > 0.0)) return;
    for (int a = 0; a < 3; ++a) r->along[a] = n[a] / sqrt(square[0]);
    for (int k = 1; i + k < spot->rows && r[k].lead == i; ++k) remove_components(r, k, r[k].along);
}

/* Rows that are bound or led have no weights (add_to_row). */
static void set_gap(const mpm *s, contact_row *r)
{
    if (!(r->weight[0] > 0.0) || !(r->weight[1] > 0.0)) return;
    const double gap = r->sum[1] / r->weight[1] - r->sum[0] / r->weight[0];
    r->active = gap <= MPM_CLOSED_GAP * s->contact->h;
    r->gap = r->active ? 0.0 : gap;
}

void implicit_contact_measure_gaps(mpm *s)
{
    struct implicit_contact *c = s->implicit->contact;
    if (!c->spot_of) return;
    for (size_t k = 0; k < s->implicit->grid.size; ++k) c->spot_of[k] = -1;
    for (size_t k = 0; k < c->spots; ++k) c->spot_of[c->spot[k].node] = (int)k;
    for_elements(s, GAP_NORMAL);
    for (size_t k = 0; k < c->spots; ++k)
        for (int i = 0; i < c->spot[k].rows; ++i)
            if (c->row[c->spot[k].first + (size_t)i].lead < 0) turn_condition(s, &c->spot[k], i);
    for_elements(s, GAP_PLACE);
    for (size_t k = 0; k < c->rows; ++k) set_gap(s, &c->row[k]);
}
