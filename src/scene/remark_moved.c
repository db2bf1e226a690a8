/* Remarks on surfaces of solids that gas points push over their cells. */
#include "scene/remark_internal.h"

#include "geom/bounds.h"
#include "scene/scene_motion.h"

#include <math.h>

/* Cells that a pressure from inside moves the surface of a body by, as far as its size tells: p b / (4 G) of a thick sphere that keeps its
 * volume, and within a quarter that of a bar in uniaxial strain. */
static double cells_moved(const scene *s, const scene_body *b, double pressure)
{
    const scene_material *m = &s->material[b->material];
    const double shear = m->law->shear_modulus(m->law_par);
    double lo[3], hi[3], most = 0.0;
    if (!(shear > 0.0) || !shape_bounds(&b->shape, s->mesh.dim, lo, hi)) return 0.0;
    for (int a = 0; a < s->mesh.dim; ++a) {
        const double inside = fmin(hi[a], s->mesh.upper[a]) - fmax(lo[a], s->mesh.lower[a]);
        most = fmax(most, inside / s->mesh.cell[a]);
    }
    return most * pressure / (4.0 * shear);
}

/* The points of solid and gas that share the cells at a surface have one smooth motion with splines. While the surface stays where its points
 * were laid that motion fits both; later, stresses of single points change without a force on any node, and the gas's noise grows. */
void remark_moved(const scene *s, remark_sink *say, void *user)
{
    const double far = 0.3, pressure = fabs(scene_gas_pressure(s) - s->reference_pressure);
    remark_speaker w = {.s = s, .say = say, .user = user};
    if (!remark_has_splines(s) || s->time.solver != SOLVER_DYNAMIC || !(scene_gas_pressure(s) > 0.0)) return;
    for (int k = 0; k < s->n_bodies; ++k) {
        const scene_body *b = &s->body[k];
        if (!remark_is_solid(&s->material[b->material]) || !b->shape.model || b->motion.kind != MOTION_BY_LAW) continue;
        const double cells = cells_moved(s, b, pressure);
        if (!(cells > far)) continue;
        remark_set_key(&w, "bodies", b->name, "");
        remark_key(&w,
                   "the fluid's points may move the surface of body '%s' by some %.2g cells. With splines, beyond a "
                   "third of one, a thick sphere of rubber (K/G of 20) was strained 23 to 55 %% too little, and a bar "
                   "with one, three or four points a cell had 20 to 100 %% too little stress in its last points (two: "
                   "8 %%). Take coupling ice-mpm (1 %%), or method.basis gimp (2 and 8 %%)",
                   b->name, cells);
    }
}
