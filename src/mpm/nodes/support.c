/* Supports: nodes inside a region whose velocity is prescribed, as walls prescribe it on the sides of the mesh. York's nets and pendulums are fixed at walls;
 * a support fixes bodies elsewhere. */
#include "base/memory.h"
#include "mpm/nodes/supports.h"

#include <string.h>

typedef struct support_list {
    support_node *node;
    size_t n, capacity;
} support_list;

static floe_status add_support_node(mpm *s, support_list *list, const int node[3], int support)
{
    if (list->n == list->capacity) {
        list->capacity = list->capacity ? 2 * list->capacity : 64;
        TRY(memory_resize(s->ctx, &list->node, list->capacity, sizeof *list->node));
        s->supports->node = list->node;
    }
    support_node *to = &list->node[list->n++];
    memcpy(to->node, node, sizeof to->node);
    to->support = support;
    return FLOE_OK;
}

static floe_status find_nodes(mpm *s, support_list *list, int support)
{
    const mesh *m = s->mesh;
    int end[3] = {1, 1, 1};
    for (int a = 0; a < m->dim; ++a) end[a] = m->n[a] + (m->periodic[a] ? 0 : 1);
    for (int k = 0; k < end[2]; ++k)
        for (int j = 0; j < end[1]; ++j)
            for (int i = 0; i < end[0]; ++i) {
                const int node[3] = {i, j, k};
                double x[3] = {0.0};
                for (int a = 0; a < m->dim; ++a) x[a] = mesh_node(m, a, node[a]);
                if (shape_inside(&s->scene->support[support].region, m->dim, x))
                    TRY(add_support_node(s, list, node, support));
            }
    return FLOE_OK;
}

floe_status start_supports(mpm *s)
{
    support_list list = {0};
    for (int k = 0; k < s->scene->n_supports; ++k) {
        const size_t before = list.n;
        TRY(find_nodes(s, &list, k));
        if (list.n == before)
            return fail_key(
                s->ctx, KEY("supports", s->scene->support[k].name),
                "holds nothing: no node of the mesh lies in its region; make it larger, or the cells smaller");
    }
    s->supports->n = list.n;
    return FLOE_OK;
}

/* A share of the impulse that a support is about to give, of the node's owner; `change`: the field is one, and is to be zero. */
static void enter_support_impulse(mpm *s, const support_node *node, int group, field_id velocity, double share,
                                  bool change)
{
    int cell[3];
    for (int a = 0; a < 3; ++a)
        cell[a] = node->node[a] == s->mesh->n[a] && a < s->mesh->dim ? node->node[a] - 1 : node->node[a];
    const int blk = mesh_block_of(s->mesh, cell);
    const block *b = &s->mesh->block[blk];
    const ptrdiff_t at = mesh_index(b, node->node[0] - b->lo[0], node->node[1] - b->lo[1], node->node[2] - b->lo[2]);
    const double mass = field_get(s->domain->fields[blk], N_MASS, group, 0)[at];
    double x[MESH_MAX_DIM];
    place_of_node(s->mesh, node->node, x);
    for (int c = 0; c < s->mesh->dim; ++c) {
        const double target = s->scene->support[node->support].velocity[c], wanted = change ? 0.0 : target;
        const double impulse = share * mass * (wanted - field_get(s->domain->fields[blk], velocity, group, c)[at]);
        ledger_push(s->ledger, LEDGER_BOUNDARY, c, impulse, x);
        ledger_add(s->ledger, LEDGER_ENERGY, LEDGER_BOUNDARY, impulse * target);
    }
}

static void hold_nodes(mpm *s, int group, field_id field, double entered, bool change)
{
    for (size_t k = 0; k < s->supports->n; ++k) {
        const support_node *node = &s->supports->node[k];
        if (entered != 0.0) enter_support_impulse(s, node, group, field, entered, change);
        for (int blk = 0; blk < s->mesh->n_blocks; ++blk) {
            const block *b = &s->mesh->block[blk];
            int local[3];
            bool in_block = true;
            for (int a = 0; a < 3; ++a) {
                local[a] = node->node[a] - b->lo[a];
                in_block = in_block && (a >= b->dim || (local[a] >= -1 && local[a] <= b->n[a] + 1));
            }
            for (int c = 0; in_block && c < s->mesh->dim; ++c)
                field_get(s->domain->fields[blk], field, group, c)[mesh_index(b, local[0], local[1], local[2])] =
                    change ? 0.0 : s->scene->support[node->support].velocity[c];
        }
    }
}

void impose_supports(mpm *s, int group, field_id velocity, double entered)
{
    hold_nodes(s, group, velocity, entered, false);
}

void constrain_supports(mpm *s, int group, field_id change, double share)
{
    hold_nodes(s, group, change, share, true);
}

void supports_free(mpm *s)
{
    if (s->supports) memory_free(s->ctx, &s->supports->node);
    memory_free(s->ctx, &s->supports);
}
