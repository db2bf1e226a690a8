#include "surface/neighbours.h"

#include <math.h>

/* Neighbours found so far, in the order of their distance. */
typedef struct nearest_list {
    surface_neighbour *out;
    int n, most;
} nearest_list;

static void insert(nearest_list *l, const surface_neighbour *one)
{
    int at = l->n;
    if (l->n == l->most) {
        if (!(one->square < l->out[l->n - 1].square)) return;
        --at;
    } else {
        l->n++;
    }
    for (; at > 0 && one->square < l->out[at - 1].square; --at) l->out[at] = l->out[at - 1];
    l->out[at] = *one;
}

void surface_block_about(const surface_set *s, const int centre[3], int ring, surface_block *out)
{
    int reach[3], at[3];
    for (int a = 0; a < 3; ++a) reach[a] = a < s->mesh->dim ? ring : 0;
    out->ring = ring;
    out->n = 0;
    for (int k = -reach[2]; k <= reach[2]; ++k)
        for (int j = -reach[1]; j <= reach[1]; ++j)
            for (int i = -reach[0]; i <= reach[0]; ++i) {
                at[0] = centre[0] + i;
                at[1] = centre[1] + j;
                at[2] = centre[2] + k;
                const surface_cell *c = surface_cell_at(&s->points, at);
                if (c) out->cell[out->n++] = c;
            }
}

double surface_block_covers(const surface_set *s, const surface_entry *of, int ring)
{
    double least = INFINITY;
    for (int a = 0; a < s->mesh->dim; ++a) {
        const double h = s->mesh->h[a], inside = of->x[a] - mesh_node(s->mesh, a, of->cell[a]);
        least = fmin(least, ring * h + fmin(inside, h - inside));
    }
    return least;
}

static void visit_cell(const surface_set *s, const surface_cell *c, const surface_entry *of, nearest_list *l)
{
    for (size_t k = 0; k < c->n; ++k) {
        const surface_entry *e = &s->points.entry[c->first + k];
        if (e == of) continue;
        surface_neighbour one = {.number = e->number, .image = e->image};
        for (int a = 0; a < 3; ++a) {
            one.d[a] = e->x[a] - of->x[a];
            one.square += one.d[a] * one.d[a];
        }
        insert(l, &one);
    }
}

int surface_nearest_in(const surface_set *s, const surface_block *b, const surface_entry *of, int most,
                       surface_neighbour *out)
{
    nearest_list l = {.out = out, .most = most};
    for (int k = 0; k < b->n; ++k) visit_cell(s, b->cell[k], of, &l);
    return l.n;
}

int surface_nearest(const surface_set *s, const surface_entry *of, int most, surface_neighbour *out)
{
    int n = 0;
    for (int ring = 1; ring <= SURFACE_RINGS; ++ring) {
        surface_block b;
        surface_block_about(s, of->cell, ring, &b);
        n = surface_nearest_in(s, &b, of, most, out);
        const double reach = surface_block_covers(s, of, ring);
        if (n == most && out[most - 1].square <= reach * reach) break;
    }
    return n;
}
