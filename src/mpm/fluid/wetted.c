/* Fluid points along walls (wetted.h). */
#include "mpm/fluid/wetted.h"

#include "base/memory.h"
#include "mpm/fluid/wetted_parts.h"

#include <math.h>

static size_t wetted_nodes(const mpm_wetted *w)
{
    return (size_t)w->nodes[0] * (size_t)w->nodes[1] * (size_t)w->nodes[2];
}

floe_status wetted_create(mpm *s)
{
    TRY(memory_new(s->ctx, &s->wetted, 1, sizeof *s->wetted));
    mpm_wetted *w = s->wetted;
    w->density = (double)INFINITY;
    for (int b = 0; b < s->n_bodies; ++b) {
        const scene_material *m = &s->scene->material[s->body[b].scene_material];
        if (s->body[b].fluid) {
            w->fluid = s->body[b].group;
            w->viscous = w->viscous || m->shear_viscosity > 0.0;
        } else {
            w->density = fmin(w->density, m->density);
        }
    }
    for (int a = 0; a < MESH_MAX_DIM; ++a) w->nodes[a] = a < s->mesh->dim ? s->mesh->n[a] + 1 : 1;
    TRY(memory_new(s->ctx, &w->index, wetted_nodes(w), sizeof *w->index));
    for (size_t k = 0; k < wetted_nodes(w); ++k) w->index[k] = -1;
    return FLOE_OK;
}

void wetted_free(mpm *s)
{
    if (!s->wetted) return;
    memory_free(s->ctx, &s->wetted->index);
    memory_free(s->ctx, &s->wetted->node);
    memory_free(s->ctx, &s->wetted->kept);
    memory_free(s->ctx, &s->wetted->member);
    memory_free(s->ctx, &s->wetted->first);
    memory_free(s->ctx, &s->wetted);
}

int wetted_fluid(const mpm *s)
{
    return s->wetted->fluid;
}

/* All that a block sees, ghosts too. */
static floe_status visit_all_shared(mpm *s, int blk, shared_visitor *visit)
{
    int lo[MESH_MAX_DIM] = {0, 0, 0}, end[MESH_MAX_DIM] = {1, 1, 1};
    for (int a = 0; a < s->mesh->dim; ++a) {
        lo[a] = -1;
        end[a] = s->mesh->block[blk].n[a] + 2;
    }
    return wetted_visit(s, blk, lo, end, visit);
}

static floe_status store_wetted_node(mpm *s, int blk, const int at[MESH_MAX_DIM], ptrdiff_t local)
{
    const mpm_wetted *w = s->wetted;
    const fields *f = s->domain->fields[blk];
    const int k = wetted_find(s, at);
    if (k < 0) return FLOE_OK; /* a ghost beyond the mesh */
    const wetted_node *n = &w->node[k];
    for (int g = 0; g < 2; ++g)
        for (int c = 0; c < s->mesh->dim; ++c) {
            const int group = g == FLUID ? w->fluid : n->solid;
            if (isinf(n->inertia[g])) { /* as impulses on other bodies stand (motion/motion.h) */
                field_get(f, N_VEL_L, group, c)[local] += n->taken[c] / n->mass[g];
                continue;
            }
            field_get(f, N_VEL_L, group, c)[local] = n->v[g][c];
            field_get(f, N_MOMENTUM, group, c)[local] = n->mass[g] * n->before[g][c];
        }
    return FLOE_OK;
}

floe_status mpm_constrain_wetted(mpm *s)
{
    mpm_wetted *w = s->wetted;
    TRY(wetted_list(s));
    if (w->n == 0) return FLOE_OK;
    TRY(wetted_move_free(s));
    wetted_constrain_lines(s);
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) TRY(visit_all_shared(s, blk, store_wetted_node));
    return FLOE_OK;
}

/* Beyond a side there is the image of what is inside. */
static int find_image(const mpm *s, const int at[MESH_MAX_DIM])
{
    int image[MESH_MAX_DIM] = {0, 0, 0};
    for (int a = 0; a < s->mesh->dim; ++a) {
        const int n = s->mesh->n[a];
        image[a] = s->mesh->periodic[a] || (at[a] >= 0 && at[a] <= n) ? at[a] : at[a] < 0 ? -at[a] : 2 * n - at[a];
    }
    return wetted_find(s, image);
}

static floe_status add_wall_heat(mpm *s, int blk, const int at[MESH_MAX_DIM], ptrdiff_t local)
{
    const mpm_wetted *w = s->wetted;
    const int k = find_image(s, at);
    if (k >= 0) field_get(s->domain->fields[blk], N_LOSS, w->fluid, 0)[local] += w->node[k].heat;
    return FLOE_OK;
}

floe_status wetted_add_losses(mpm *s)
{
    for (int blk = 0; blk < s->mesh->n_blocks; ++blk) TRY(visit_all_shared(s, blk, add_wall_heat));
    return FLOE_OK;
}
