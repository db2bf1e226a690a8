/* Remarks on bodies that stick to others which do not deform. */
#include "scene/remark_internal.h"

#include "geom/bounds.h"
#include "scene/scene_motion.h"
#include "scene/scene_reach.h"

static bool is_bounded(const scene *s, const scene_body *b)
{
    double lo[3], hi[3];
    return shape_bounds(&b->shape, s->mesh.dim, lo, hi);
}

static bool boxes_meet(const scene *s, const scene_body *a, const scene_body *b)
{
    return is_bounded(s, a) && is_bounded(s, b) && bodies_meet(s, a, b, 0.01);
}

static bool is_solid_body(const scene *s, const scene_body *b)
{
    return remark_is_solid(&s->material[b->material]) && b->shape.model;
}

/* Whether a fixed body constrains what sticks to it at their common surface, as supports do (theory 4.13). */
static bool is_led(const scene *s, int body, const scene_body *fixed)
{
    return fixed->motion.kind == MOTION_FIXED && !s->contact.enabled && !remark_is_among_fluids(s, body) &&
           !scene_drives_beside_implicit(s);
}

/* Nodes that a rigid body reaches have its velocity (theory 4.17): with splines one of them lies inside what sticks to it. */
static void remark_stiff_end(remark_speaker *w, int body)
{
    const scene *s = w->s;
    const scene_body *b = &s->body[body];
    if (!is_solid_body(s, b) || motion_is_given(&b->motion)) return;
    for (int r = 0; r < s->n_bodies; ++r) {
        const scene_body *rigid = &s->body[r];
        if (!is_solid_body(s, rigid) || !motion_is_given(&rigid->motion) || !boxes_meet(s, b, rigid)) continue;
        const bool parts = s->contact.kind != CONTACT_STICK;
        if ((parts && scene_in_contact(s, body) && scene_in_contact(s, r)) || is_led(s, body, rigid)) continue;
        remark_set_key(w, "bodies", b->name, "");
        remark_key(
            w,
            "body '%s' sticks to body '%s', which does not deform: with splines it is stiff to 0.76 of a cell from "
            "there. The stress of a bar of 10 cells that was drawn was 8 %% too large, of 20 cells 4 %%. Refine, "
            "take method.basis gimp (0.05 %%), or motion: fixed or a support where it is at rest",
            b->name, rigid->name);
        return;
    }
}

void remark_joints(const scene *s, remark_sink *say, void *user)
{
    remark_speaker w = {.s = s, .say = say, .user = user};
    const bool sticks = s->coupling == COUPLING_MPM || s->method.interface == INTERFACE_SHARP;
    for (int b = 0; sticks && remark_has_splines(s) && b < s->n_bodies; ++b) remark_stiff_end(&w, b);
}
