/* Sides of the domain: ghosts of the cells, what sides impose on faces, and what goes through them (theory 2.13). */
#ifndef ICE_SIDES_H
#define ICE_SIDES_H

#include "ice/ice_view.h"

/* Conditions of the faces, and the fluids at inlets, in reservoirs, and behind outlets that name one. */
floe_status ice_sides_create(ice *s);
void ice_sides_destroy(context *ctx, struct ice_side_table **w);

/* How ghost cells beyond a side are set. */
typedef enum ice_ghost {
    GHOST_EVEN,      /* mirrored; nearest cell at open sides */
    GHOST_ZERO_OPEN, /* mirrored; zero at open sides */
    GHOST_VELOCITY,  /* a vector: normal component odd at walls; values of the wall or inlet */
    GHOST_DENSITY,
    GHOST_ENERGY,
    GHOST_TEMPERATURE, /* temperature of walls and inlets */
    GHOST_VOLUME       /* as EVEN; the reservoir's value at inlets */
} ice_ghost;
/* instance: of the field, a region's number or a material's. */
void ice_fill_ghosts(const ice *s, field_id id, int instance, fill_which which, ice_ghost kind);
/* The same of density, velocity, energy and volume of materials [first, first + n). */
void ice_fill_state(const ice *s, int first, int n);
/* Sets ghost faces of F_VEL, so that the outflow of ghost cells is known. */
void ice_fill_faces(const ice *s, field_id id, int instance);
bool ice_is_wall(bc_kind kind);
/* The condition of the face of a side beside an owned cell, local; its numbers are those at the face, at the middle of the step. */
const bc_side *ice_condition_at(const ice *s, const block *b, int axis, mesh_side side, int i, int j, int k);
/* Whether the faces of a side have different conditions, so that each must be looked up. */
bool ice_side_differs(const ice *s, int axis, mesh_side side);
/* Whether any face of a side has one of these kinds of condition. */
bool ice_side_has(const ice *s, int axis, mesh_side side, bool (*kind)(bc_kind kind));
/* Values that the sides impose on faces. */
void ice_boundary_face_velocity(const ice *s, const ice_view *v, int r);
void ice_boundary_face_pressure(const ice *s, const ice_view *v);
/* One face on a side: the face's index, the owned cell beside it, and +1 where the axis points out of the domain. */
typedef struct side_face {
    ptrdiff_t face, cell;
    int i, j, k;
    double outward;
} side_face;
typedef void side_visitor(const ice *s, const ice_view *v, int axis, mesh_side side, int r, side_face at);
/* Visits the owned faces of every non-periodic side that the block touches. */
void ice_visit_sides(const ice *s, const ice_view *v, int r, side_visitor *visit);
/* Mobility of a material at the faces of the sides, and what the implicit centring adds to u* there. */
void ice_boundary_mobility(const ice *s, const ice_view *v, int r);
/* Momentum and work of the pressure of a region on the sides, into the ledger. */
void ice_boundary_work(ice *s, const ice_region *g);

/* Share of a face on a side of the domain that is open to the view's region. */
static inline double ice_side_aperture(const ice *s, const ice_view *v, const int local[3], int axis, int side)
{
    return s->cut ? s->cut->side_aperture(s, v->region, v->b, local, axis, side) : 1.0;
}

#endif
