/* Nodes beside fixed bodies that lead what sticks to them. Both bodies reach nodes up to a cell and a half beyond the surface; if what sticks had the fixed body's velocity at all of
 * them, it would be stiff to three quarters of a cell from there. */
#include "mpm/nodes/support_beyond.h"

#include "base/memory.h"
#include "mpm/nodes/supports.h"

#include <stdlib.h>

/* Nodes from a master to the farthest one that points of the fixed body reach. */
enum { BODY_REACH = 2 };

/* Number of a node, or of its image where the mesh is periodic. */
static long long number_of_node(const mesh *m, const int node[MESH_MAX_DIM])
{
    long long number = 0;
    for (int a = m->dim - 1; a >= 0; --a) number = number * (m->n[a] + 1) + mesh_index_around(m, a, node[a]);
    return number;
}

static int compare_node_numbers(const void *a, const void *b)
{
    const long long x = *(const long long *)a, y = *(const long long *)b;
    return (x > y) - (x < y);
}

bool clear_of_bodies(const mpm *s, int group, const int node[MESH_MAX_DIM])
{
    const struct mpm_supports *p = s->supports;
    if (p->n_clear == 0 || !supports_lead_group(s, group)) return false;
    const long long number = number_of_node(s->mesh, node);
    return bsearch(&number, p->clear, p->n_clear, sizeof number, compare_node_numbers) != NULL;
}

static bool is_led_by_body(const struct mpm_supports *p, const support_node *n)
{
    return n->led && p->region[n->support].body >= 0;
}

static bool in_mesh(const mesh *m, const int node[MESH_MAX_DIM])
{
    for (int a = 0; a < m->dim; ++a)
        if (!m->periodic[a] && (node[a] < 0 || node[a] > m->n[a])) return false;
    return true;
}

/* A led node, and all about its master. */
static void add_clear_nodes(const mesh *m, const support_node *led, struct mpm_supports *p)
{
    int reach[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < m->dim; ++a) reach[a] = BODY_REACH;
    p->clear[p->n_clear++] = number_of_node(m, led->node);
    for (int k = -reach[2]; k <= reach[2]; ++k)
        for (int j = -reach[1]; j <= reach[1]; ++j)
            for (int i = -reach[0]; i <= reach[0]; ++i) {
                const int node[MESH_MAX_DIM] = {led->master[0] + i, led->master[1] + j, led->master[2] + k};
                if (in_mesh(m, node)) p->clear[p->n_clear++] = number_of_node(m, node);
            }
}

floe_status find_clear_nodes(mpm *s)
{
    struct mpm_supports *p = s->supports;
    size_t led = 0, about = 1, kept = 0;
    for (int a = 0; a < s->mesh->dim; ++a) about *= 2 * BODY_REACH + 1;
    for (size_t k = 0; k < p->n; ++k) led += is_led_by_body(p, &p->node[k]) ? 1 : 0;
    memory_free(s->ctx, &p->clear);
    p->n_clear = 0;
    if (led == 0) return FLOE_OK;
    TRY(memory_new(s->ctx, &p->clear, led * (1 + about), sizeof *p->clear));
    for (size_t k = 0; k < p->n; ++k)
        if (is_led_by_body(p, &p->node[k])) add_clear_nodes(s->mesh, &p->node[k], p);
    qsort(p->clear, p->n_clear, sizeof *p->clear, compare_node_numbers);
    for (size_t k = 0; k < p->n_clear; ++k)
        if (kept == 0 || p->clear[k] != p->clear[kept - 1]) p->clear[kept++] = p->clear[k];
    p->n_clear = kept;
    return FLOE_OK;
}
