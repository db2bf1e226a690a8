#include "mpm/surface/welded.h"

#include "base/memory.h"
#include "scene/scene_reach.h"

/* Solids that have the one velocity of the nodes. */
static bool may_weld(const scene *s, const scene_body *b)
{
    return b->shape.model && !scene_in_contact(s, (int)(b - s->body)) &&
           s->material[b->material].kind == MATERIAL_SOLID && !s->material[b->material].membrane &&
           !motion_is_given(&b->motion) && !b->initial_from_exact && !b->yields;
}

static bool start_alike(const scene_body *a, const scene_body *b)
{
    bool alike = true;
    for (int d = 0; d < 3; ++d) alike = alike && a->velocity[d] == b->velocity[d];
    return alike;
}

/* Bodies of two materials may be meant to part. A surface of bodies that only might touch is that of each of them. */
static bool are_welded(const scene *s, const scene_body *a, const scene_body *b)
{
    return a->material == b->material && may_weld(s, a) && may_weld(s, b) && start_alike(a, b) &&
           bodies_meet(s, a, b, BODIES_TOUCH);
}

bool welded_to_others(const scene *s, const mesh *m, const scene_body *body)
{
    bool of[SCENE_MAX_BODIES] = {false};
    return m->dim == 3 && scene_mark_group(s, (int)(body - s->body), are_welded, of) > 1;
}

floe_status welded_find(const scene *s, const mesh *m, const scene_body *body, welded *out)
{
    const int number = (int)(body - s->body);
    bool of[SCENE_MAX_BODIES] = {false};
    const int n = scene_mark_group(s, number, are_welded, of);
    int at = 0;
    *out = (welded){.shape = body->shape};
    if (n == 1) return FLOE_OK;
    for (int b = 0; b < number; ++b)
        if (of[b]) out->shape.model = NULL;
    if (!out->shape.model) return FLOE_OK;
    TRY(memory_new(s->ctx, &out->part, (size_t)n, sizeof *out->part));
    for (int b = 0; b < s->n_bodies; ++b)
        if (of[b]) out->part[at++] = s->body[b].shape;
    return shape_unite(s->ctx, out->part, (size_t)n, m->dim, &out->shape);
}

void welded_free(context *ctx, welded *w)
{
    if (w->part) memory_free(ctx, &w->shape.par);
    memory_free(ctx, &w->part);
}
