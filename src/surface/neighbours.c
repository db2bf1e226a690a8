#include "surface/neighbours.h"

#include <math.h>
#include <string.h>

/* Entries found so far, in the order of their distance: no more than what tells them apart, for most are replaced by nearer
 * ones. */
typedef struct nearest_list {
    double square[SURFACE_MOST_NEAR];
    const surface_entry *entry[SURFACE_MOST_NEAR];
    int n, most;
} nearest_list;

/* Of equally near ones the first in the order of cells and numbers, in which entries stand. */
static bool comes_before(double square, const surface_entry *one, const nearest_list *l, int at)
{
    return square < l->square[at] || (square == l->square[at] && one < l->entry[at]);
}

static void insert_neighbour(nearest_list *l, const surface_entry *one, double square)
{
    int at = l->n;
    if (l->n == l->most) {
        if (!comes_before(square, one, l, at - 1)) return;
        --at;
    } else {
        l->n++;
    }
    for (; at > 0 && comes_before(square, one, l, at - 1); --at) {
        l->square[at] = l->square[at - 1];
        l->entry[at] = l->entry[at - 1];
    }
    l->square[at] = square;
    l->entry[at] = one;
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

static double square_between(const surface_entry *a, const surface_entry *b)
{
    const double x = b->x[0] - a->x[0], y = b->x[1] - a->x[1], z = b->x[2] - a->x[2];
    return x * x + y * y + z * z;
}

/* Of the nearest place of a cell: a point that lies in it by round-off alone is told apart by none. */
static double square_to_cell(const mesh *m, const surface_entry *of, const int at[3])
{
    double sum = 0.0;
    for (int a = 0; a < m->dim; ++a) {
        const int steps = at[a] - of->cell[a];
        if (steps == 0) continue;
        const double gap = steps > 0 ? mesh_node(m, a, at[a]) - of->x[a] : of->x[a] - mesh_node(m, a, at[a] + 1);
        const double safe = gap - 1e-9 * m->h[a];
        if (safe > 0.0) sum += safe * safe;
    }
    return sum;
}

/* Those of a cell that are nearer than `within` (a square). */
static void find_in_cell(const surface_set *s, const surface_cell *c, const surface_entry *of, double within,
                         nearest_list *l)
{
    const surface_entry *first = &s->points.entry[c->first];
    if (square_to_cell(s->mesh, of, c->at) > (l->n == l->most ? l->square[l->n - 1] : within)) return;
    for (size_t k = 0; k < c->n; ++k) {
        const double square = square_between(of, &first[k]);
        if (square < within && &first[k] != of) insert_neighbour(l, &first[k], square);
    }
}

/* The cell of the point itself first: what is found there leaves others out. */
static void find_in(const surface_set *s, const surface_block *b, const surface_entry *of, double within,
                    nearest_list *l)
{
    int own = 0;
    while (own < b->n && memcmp(b->cell[own]->at, of->cell, sizeof of->cell) != 0) ++own;
    if (own < b->n) find_in_cell(s, b->cell[own], of, within, l);
    for (int c = 0; c < b->n; ++c)
        if (c != own) find_in_cell(s, b->cell[c], of, within, l);
}

static int hand_over(const nearest_list *l, const surface_entry *of, surface_neighbour *out)
{
    for (int k = 0; k < l->n; ++k) {
        const surface_entry *e = l->entry[k];
        out[k] = (surface_neighbour){.square = l->square[k], .number = e->number, .image = e->image};
        for (int a = 0; a < 3; ++a) out[k].d[a] = e->x[a] - of->x[a];
    }
    return l->n;
}

static int nearest_within(const surface_set *s, const surface_block *b, const surface_entry *of, double within,
                          int most, surface_neighbour *out)
{
    nearest_list l = {.most = most};
    find_in(s, b, of, within, &l);
    return hand_over(&l, of, out);
}

double surface_distance_in(const surface_set *s, const surface_block *b, const surface_entry *of, int count, int *found)
{
    nearest_list l = {.most = count};
    find_in(s, b, of, INFINITY, &l);
    *found = l.n;
    return l.n > 0 ? sqrt(l.square[l.n - 1]) : 0.0;
}

int surface_within_in(const surface_set *s, const surface_block *b, const surface_entry *of, double reach, int most,
                      surface_neighbour *out)
{
    return nearest_within(s, b, of, reach * reach, most, out);
}

int surface_nearest(const surface_set *s, const surface_entry *of, int most, surface_neighbour *out)
{
    int n = 0;
    for (int ring = 1; ring <= SURFACE_RINGS; ++ring) {
        surface_block b;
        surface_block_about(s, of->cell, ring, &b);
        n = nearest_within(s, &b, of, INFINITY, most, out);
        const double reach = surface_block_covers(s, of, ring);
        if (n == most && out[most - 1].square <= reach * reach) break;
    }
    return n;
}
