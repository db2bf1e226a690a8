/* Metamorphic changes of a scene, which must not change its solution: mirrored, rotated, shifted, with its entries in
 * another order, or extended to more dimensions. */
#ifndef TESTS_VERIFICATION_TRANSFORMED_SCENES_FIXTURE_H
#define TESTS_VERIFICATION_TRANSFORMED_SCENES_FIXTURE_H

#include "holding_fixture.h"

/* Changes a scene, and its exact solution with it, and gives the transformation from the first; false where the change
 * is not possible. */
typedef bool transform_scene(scene *s, transformation *k);

FIXTURE bool mirror(scene *s, transformation *k, int axis)
{
    if (axis >= s->mesh.dim || (s->mesh.geometry == MESH_AXISYMMETRIC && axis == 0)) return false;
    k->map.sign[axis] = -1.0;
    k->map.shift[axis] = s->mesh.lower[axis] + s->mesh.upper[axis];
    map_scene(s, &k->map);
    return true;
}

FIXTURE bool mirror_x(scene *s, transformation *k)
{
    return mirror(s, k, 0);
}

FIXTURE bool mirror_y(scene *s, transformation *k)
{
    return mirror(s, k, 1);
}

FIXTURE bool mirror_z(scene *s, transformation *k)
{
    return mirror(s, k, 2);
}

FIXTURE bool swap_axes(scene *s, transformation *k)
{
    if (s->mesh.dim < 2 || s->mesh.geometry == MESH_AXISYMMETRIC) return false;
    k->map.from[0] = 1;
    k->map.from[1] = 0;
    map_scene(s, &k->map);
    return true;
}

/* By whole cells; mesh and all. */
FIXTURE bool move_all(scene *s, transformation *k)
{
    static const double cells[] = {7.0, -11.0, 5.0};
    for (int a = s->mesh.geometry == MESH_AXISYMMETRIC ? 1 : 0; a < s->mesh.dim; ++a)
        k->map.shift[a] = cells[a] * s->mesh.cell[a];
    map_scene(s, &k->map);
    return true;
}

FIXTURE void turn_index(int *index, int n)
{
    if (*index >= 0) *index = n - 1 - *index;
}

/* The last body first. Where bodies take a share of what is left, their order means something. */
FIXTURE bool turn_bodies(scene *s, transformation *k)
{
    const int n = s->n_bodies;
    for (int i = 0; i < n; ++i)
        if (s->body[i].fraction > 0.0 && s->body[i].fraction < 1.0) return false;
    if (n < 2) return false;
    map_scene(s, &k->map);
    for (int i = 0; i < n / 2; ++i) {
        const scene_body kept = s->body[i];
        s->body[i] = s->body[n - 1 - i];
        s->body[n - 1 - i] = kept;
    }
    for (int i = 0; i < s->n_loads; ++i) turn_index(&s->load[i].body, n);
    for (int i = 0; i < s->n_mass_sources; ++i) turn_index(&s->mass_source[i].inside, n);
    for (int i = 0; i < s->contact.n_bodies; ++i) turn_index(&s->contact.body[i], n);
    for (int i = 0; i < s->n_springs; ++i)
        for (int e = 0; e < 2; ++e) turn_index(&s->spring[i].end[e].body, n);
    turn_index(&s->verify.body, n);
    return true;
}

/* The last material first. */
FIXTURE bool turn_materials(scene *s, transformation *k)
{
    const int n = s->n_materials;
    if (n < 2) return false;
    map_scene(s, &k->map);
    for (int i = 0; i < n; ++i) k->material[i] = n - 1 - i;
    for (int i = 0; i < n / 2; ++i) {
        const scene_material kept = s->material[i];
        s->material[i] = s->material[n - 1 - i];
        s->material[n - 1 - i] = kept;
    }
    for (int i = 0; i < s->n_bodies; ++i) {
        turn_index(&s->body[i].material, n);
        turn_index(&s->body[i].membrane.encloses, n);
    }
    for (int i = 0; i < s->n_loads; ++i) turn_index(&s->load[i].material, n);
    for (int i = 0; i < s->n_mass_sources; ++i) turn_index(&s->mass_source[i].material, n);
    for (int i = 0; i < 2 * s->n_vents; ++i) turn_index(&s->vent[i / 2].side[i % 2].material, n);
    for (int i = 0; i < 2 * s->n_exchanges; ++i) turn_index(&s->exchange[i / 2].material[i % 2], n);
    for (int i = 0; i < s->n_reactions; ++i) {
        turn_index(&s->reaction[i].reactant, n);
        turn_index(&s->reaction[i].product, n);
    }
    for (int i = 0; i < 2 * MESH_MAX_DIM; ++i) turn_index(&s->bc.side[i / 2][i % 2].material, n);
    if (s->has_ambient) turn_index(&s->ambient_material, n);
    return true;
}

FIXTURE bool is_box(const shape *s)
{
    return s->model == &mapped_box;
}

/* A scene of boxes alone, which the mesh cuts exactly, whose solids the gas feels by the cells that they share with it. */
FIXTURE bool has_boxes_alone(const scene *s)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (!is_box(&s->body[b].shape)) return false;
    return s->method.interface == INTERFACE_SMEARED;
}

/* One side of a plane across the last axis of a body of its own: +1 above, -1 below. */
FIXTURE void halve(scene *s, scene_body *b, double side, double plane)
{
    mapped_par *half;
    check_ok(s->ctx, scene_allocate(s, &half, sizeof *half));
    *half = *(const mapped_par *)b->shape.par;
    half->half = side;
    half->plane = plane;
    b->shape.par = half;
}

/* Makes space for one more body after body b, the same as it is. */
FIXTURE void double_body(scene *s, int b)
{
    for (int i = s->n_bodies; i > b; --i) s->body[i] = s->body[i - 1];
    s->n_bodies++;
    for (int i = 0; i < s->n_loads; ++i)
        if (s->load[i].body > b) s->load[i].body++;
    if (s->verify.body == b) s->verify.body = -1;
    if (s->verify.body > b) s->verify.body++;
    snprintf(s->body[b + 1].name, SCENE_NAME, "other_half");
}

/* The first box, cut in two on a face of the mesh: two bodies of one material. Bodies in contact are not the same as one. */
FIXTURE bool split_body(scene *s, transformation *k)
{
    const int axis = s->mesh.dim - 1;
    const double h = s->mesh.cell[axis], lower = s->mesh.lower[axis];
    if (s->n_bodies == SCENE_MAX_BODIES || s->contact.enabled || s->n_springs > 0) return false;
    map_scene(s, &k->map);
    if (!has_boxes_alone(s)) return false;
    for (int b = 0; b < s->n_bodies; ++b) {
        double lo[3], hi[3];
        bool loaded = false;
        (void)mapped_bounds(s->body[b].shape.par, s->mesh.dim, lo, hi);
        const double middle = lower + h * floor((0.5 * (lo[axis] + hi[axis]) - lower) / h + 1e-6);
        for (int i = 0; i < s->n_loads; ++i) loaded = loaded || s->load[i].body == b;
        if (loaded || !(middle > lo[axis] + 1e-6 * h && middle < hi[axis] - 1e-6 * h)) continue;
        double_body(s, b);
        halve(s, &s->body[b], 1.0, middle);
        halve(s, &s->body[b + 1], -1.0, middle);
        return true;
    }
    return false;
}

/* One more fluid, of which there is nothing. A scene of one fluid is stepped in another way. */
FIXTURE bool add_absent(scene *s, transformation *k)
{
    if (s->n_materials < 2 || s->n_materials == SCENE_MAX_MATERIALS || s->coupling == COUPLING_MPM) return false;
    map_scene(s, &k->map);
    for (int i = 0; i < s->n_materials; ++i) {
        if (s->material[i].kind != MATERIAL_FLUID) continue;
        s->material[s->n_materials] = s->material[i];
        snprintf(s->material[s->n_materials].name, SCENE_NAME, "absent");
        k->material[s->n_materials++] = -1;
        return true;
    }
    return false;
}

/* A plane scene as a slab of one cell between mirrors, a line as a strip, so deep that its depth is nothing to the time step. */
FIXTURE bool thicken(scene *s, transformation *k)
{
    const int axis = s->mesh.dim;
    if (axis == 3 || s->mesh.geometry == MESH_AXISYMMETRIC || s->stress_state != STRESS_FULL) return false;
    map_scene(s, &k->map);
    if (!has_boxes_alone(s)) return false;
    s->mesh.dim = axis + 1;
    s->mesh.lower[axis] = 0.0;
    s->mesh.upper[axis] = s->mesh.cell[axis] = k->depth = 0x1p30;
    s->mesh.periodic[axis] = false;
    s->mesh.blocks[axis] = 1;
    for (int side = 0; side < 2; ++side)
        s->bc.side[axis][side] = (bc_side){.kind = BC_SYMMETRY, .temperature = (double)NAN, .material = -1};
    return true;
}

#endif
