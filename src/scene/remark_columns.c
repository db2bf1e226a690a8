/* Remarks on fluid points that bear their own weight: they start without it, and liquids sink between each other. */
#include "scene/remark_internal.h"

#include "geom/bounds.h"
#include "scene/fluid_columns.h"
#include "scene/formula.h"
#include "scene/scene_reach.h"

#include <math.h>
#include <string.h>

static double height_of(const scene *s, const scene_body *b, int axis)
{
    double lo[3] = {0.0}, hi[3] = {0.0};
    const shape *region = &b->shape;
    if (!shape_bounds(region, s->mesh.dim, lo, hi)) return s->mesh.upper[axis] - s->mesh.lower[axis];
    return fmin(hi[axis], s->mesh.upper[axis]) - fmax(lo[axis], s->mesh.lower[axis]);
}

static double density_of(const scene *s, const scene_body *b)
{
    return isnan(b->density) ? eos_density(&s->material[b->material].eos, b->pressure, b->temperature) : b->density;
}

/* Whether a body stands on a closed side in the direction of a pull along an axis. */
static bool stands(const scene *s, const scene_body *b, int axis, double pull)
{
    const int floor = pull < 0.0 ? SIDE_LOWER : SIDE_UPPER;
    const bc_kind kind = s->bc.side[axis][floor].kind;
    return pull != 0.0 && kind != BC_FREE && kind != BC_PERIODIC && body_reaches_side(s, b, axis, floor);
}

/* Where its weight is not added (fluid_columns.h), a fluid on points starts to fall on its floor, and its pressure swings about that at rest. A gas is light
 * enough where its weight is a hundredth of its pressure. */
static void remark_column(remark_speaker *w, const scene_body *b, int axis, double pull)
{
    const scene *s = w->s;
    double falls[SCENE_MAX_BODIES];
    const double light = 0.01, weight = fabs(pull) * density_of(s, b) * height_of(s, b, axis);
    if (scene_point_columns(s, falls) >= 0 || b->initial_from_exact || scene_formula_of(s, &b->pressure) ||
        scene_formula_of(s, &b->density))
        return;
    if (!eos_is_liquid(&s->material[b->material].eos) && weight < light * b->pressure) return;
    if (strcmp(b->name, "ambient") == 0)
        remark_set_key(w, "ambient", "pressure", "");
    else
        remark_set_key(w, "bodies", b->name, "pressure");
    remark_key(
        w,
        "points of fluid start without the weight above them, %.3g%s at the lowest of '%s', and their pressure swings "
        "from none to twice that. Give the pressure as a formula of height, p0 + density * %g * depth, or take "
        "coupling ice-mpm, which adds the weight",
        weight, s->dimensionless ? "" : " Pa", b->name, fabs(pull));
}

/* Points keep with FLIP what the mesh does not see of their velocities. Under gravity they sink between each other, and what they lose of height
 * is noise of their velocities: no drift shows it. */
static void remark_sinking(remark_speaker *w, const scene_body *b)
{
    const char *transfer = scene_transfer(w->s);
    const bool keeps = strcmp(transfer, "flip") == 0 || strcmp(transfer, "afmpm") == 0;
    if (w->s->mesh.dim == 1 || !keeps || !eos_is_liquid(&w->s->material[b->material].eos)) return;
    remark_set_key(w, "method", "transfer", "");
    remark_key(
        w,
        "with '%s' the points of liquid '%s' sink between each other under gravity, and what they lose is noise "
        "of their velocities: a wave in a tank had 1.2 to 1.8 times its kinetic energy after two periods, and "
        "where two liquids meet 27 times. Take coupling ice-mpm, or apic (0.76 to 0.9; but a heavy cylinder sank "
        "a sixth to a third too little in it)",
        transfer, b->name);
}

void remark_columns(const scene *s, remark_sink *say, void *user)
{
    remark_speaker w = {.s = s, .say = say, .user = user};
    double pull[SCENE_MAX_BODIES][3];
    if (s->coupling != COUPLING_MPM || s->time.solver != SOLVER_DYNAMIC) return;
    scene_find_pulls(s, pull);
    for (int k = 0; k < s->n_bodies; ++k) {
        const scene_body *b = &s->body[k];
        if (s->material[b->material].kind != MATERIAL_FLUID) continue;
        for (int a = 0; a < s->mesh.dim; ++a) {
            if (!stands(s, b, a, pull[k][a])) continue;
            remark_column(&w, b, a, pull[k][a]);
            remark_sinking(&w, b);
        }
    }
}
