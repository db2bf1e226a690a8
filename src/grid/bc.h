/* Boundary conditions as data: one table (axis, side) -> kind and values; one loop applies a kind to a field. */
#ifndef GRID_BC_H
#define GRID_BC_H

#include "grid/domain.h"
#include "math/swing.h"

typedef enum bc_kind {
    BC_SYMMETRY, /* mirror: normal velocity odd, everything else even; to fluids a slip wall is the same */
    BC_SLIP,     /* impermeable, free tangential velocity; solids leave it as they come (mpm/nodes/wall_side.c) */
    BC_NO_SLIP,  /* impermeable, tangential velocity of the wall */
    BC_PERIODIC,
    BC_INLET,          /* fluids: density, velocity, temperature given; points: prescribed velocity */
    BC_OUTLET,         /* fluids: zero gradient, face pressure given */
    BC_VELOCITY,       /* points: prescribed velocity; fluids: moving impermeable wall */
    BC_FREE,           /* points: nothing is imposed; fluids: zero gradient (supersonic outlet) */
    BC_NON_REFLECTING, /* fluids: waves leave; pressure and velocity far outside given; points: as free */
    BC_RESERVOIR       /* fluids: enter from rest at total pressure and temperature; points: as free */
} bc_kind;

/* Whether fluid leaves and enters a side against a given pressure: an outlet, a reservoir, a non-reflecting side. */
static inline bool bc_gives_pressure(bc_kind kind)
{
    return kind == BC_OUTLET || kind == BC_NON_REFLECTING || kind == BC_RESERVOIR;
}

const char *bc_name(bc_kind kind); /* name in the deck: symmetry, slip, no_slip, periodic, inlet ... */

typedef struct bc_side {
    bc_kind kind;
    double velocity[MESH_MAX_DIM]; /* m/s: of the wall, the inlet, the prescribed nodes, or far outside */
    double pressure;               /* Pa: outlet, inlet, outside a non-reflecting side; total, of a reservoir */
    double temperature;            /* K: inlet, reservoir behind an outlet, wall; NAN: not given */
    double heat_flux;              /* W/m2: out of a wall into the fluid */
    int material;                  /* fluid that enters (index in the scene's materials) */
    swing course;                  /* of the velocity of BC_VELOCITY, over time */
} bc_side;

/* Velocity component that a BC_VELOCITY side imposes at t. */
static inline double bc_velocity(const bc_side *side, int component, double t)
{
    return side->velocity[component] * swing_at(&side->course, t);
}

typedef struct bc_table {
    bc_side side[MESH_MAX_DIM][2];
} bc_table;

typedef enum bc_parity { BC_EVEN, BC_ODD } bc_parity;

/* Local indices lo to hi (not included), MESH_MAX_DIM each, of the layers `from` to `to` of a side, counted outwards: 0
 * is the last of the block's own cells, 1 to MESH_GHOST the ghosts beyond it. All transverse ghosts are covered. */
void bc_layers(const block *b, int axis, mesh_side side, int from, int to, int lo[], int hi[]);

/* Fills the ghost cells of one array beyond one non-periodic side of a block by reflection about the wall:
 * even copies, odd changes sign. All transverse ghosts are covered, so that sides applied axis by axis fill corners. */
void bc_reflect(const block *b, int axis, mesh_side side, bc_parity parity, double *a);
/* Fills the ghost cells with the value of the nearest owned cell. */
void bc_extrapolate(const block *b, int axis, mesh_side side, double *a);
/* Fills the ghost cells with a constant. */
void bc_constant(const block *b, int axis, mesh_side side, double value, double *a);

#endif
