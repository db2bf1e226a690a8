/* A block's arrays as the kernels see them, and the rows over which they run. Shared by all parts of the solver. */
#ifndef ICE_ICE_VIEW_H
#define ICE_ICE_VIEW_H

#include "coupling/reaction.h"
#include "ice/ice.h"
#include <math.h>

/* These do not treat NaN as fmin does, so that they vectorise. */
FLOE_ALWAYS_INLINE double least(double a, double b)
{
    return a < b ? a : b;
}

FLOE_ALWAYS_INLINE double most(double a, double b)
{
    return a > b ? a : b;
}

/* Cells [first, end) of a row, local i; none where end <= first. */
typedef struct ice_span {
    int first, end;
} ice_span;

/* A fluid, or what the cells see of a material that points carry: its arrays in one block; NULL where the plan has no such field. Face arrays hold one axis each. */
typedef struct ice_fluid {
    double *rho, *u[3], *e, *vol; /* current state; vol: incoming v */
    double *open, *open1;         /* open fraction of the cell, now and next; NULL: 1 */
    double *v;                    /* equilibrated v of this step (lies in the next array of C_VOL) */
    double *T, *theta, *c, *kappa;
    double *fu[3], *ft[3];            /* u*, theta at faces */
    double *ul[3], *el, *vl;          /* Lagrangian values */
    double *rho1, *u1[3], *e1, *vol1; /* next state; vol1 is v */
    double *e_found, *vol_found;      /* before the closure of mixed cells; NULL where that changes no state */
    double *rhol;                     /* after the mass exchange, of solids too; NULL without reactions */
    double *source[3], *mom[3], *dv[3], *stress[3]; /* materials carried by points; stress: C_STRESS_ACCEL */
    double *dT;                                     /* of these, by heat exchange; NULL: there is none */
    double *diff[3], *heat, *diffT;                 /* ice_diffusion.c */
    double *
        centred[3]; /* beside embedded boundaries: velocities at the centres of cells; NULL where no fluid is viscous */
    double *mobility[3];  /* at faces, of the implicit pressure */
    const ice_span *near; /* of each row, with ghosts: cells that may be near the material; NULL: all */
} ice_fluid;

/* View of a region in a block for kernels. With one fluid, rho_sum, mean and flux are rho, u and fu of that fluid. */
typedef struct ice_view {
    const block *b;
    const ice_material *material; /* of m[0] and on */
    int dim, n_materials;         /* those in m */
    int region, first;            /* the region's number, and the material of m[0] among all */
    bool multi;                   /* the region has several materials */
    double dt, h[3], inv_h[3], gravity[3];
    /* Face area over cell volume along axis 0 at the lower and upper face of local cell i, from -2 to n + 1; 1/h if plane. */
    const double *lower0, *upper0;
    const double *volume;    /* m3 of local cell i along axis 0 */
    const double *area0;     /* of its lower face along axis 0 */
    const double *radius0;   /* m: of that face */
    bool radial;             /* axis 0 is a radius */
    const double *interface; /* 1 at an interface between fluids, else 0; NULL: interfaces are not sought */
    const ice_span *sharp; /* of each row, cells from the first to the last at an interface; NULL: none are sharpened */
    double *p, *P, *dP, *shock, *contact, *rho_sum, *kappa_sum, *mean[3], *limiter, *mixed, *tmv, *wall, *owed;
    double *fp[3], *flux[3];
    double *flat[3]; /* by axis: 1 in a shock that stands on the mesh */
    double *donor_rho[3], *donor_e[3],
        *donor_u[3][3];        /* what crosses faces that are traced; u: by axis, then component */
    bool traced;               /* some are in this step (theory 2.17) */
    double *alone;             /* C_ALONE: which are; NULL: all */
    double base, slope;        /* shock sensor: s = base + slope * sensor */
    double limit_lo, limit_hi; /* limiter factors lie between these: none 1,1; default 0,1; first order 0,0 */
    double limit_beyond; /* share of their range by which velocities may go beyond those of the neighbours (theory 3) */
    double length, finest; /* m: the largest spacing and the smallest */
    double share[3];       /* ratio of each axis' spacing to the largest: one on square cells */
    bool uneven;           /* faces of 2.2 bear the weight of cells where it lies in them (ice_lean.h), not evenly */
    bool burns;            /* some solid on points reacts */
    bool reconcile;        /* cells are closed along isentropes (ice_follows_isentropes) */
    double
        advance; /* half time steps by which u* and P are ahead: 1; 2 where the implicit pressure is that of the end of the step */
    double *step, *last_step; /* implicit: phi dP of this step and of the last */
    double *reacted[REACTION_MAX];
    double *burnt_momentum[REACTION_MAX][3], *burnt_energy[REACTION_MAX]; /* NULL where the reactant is a fluid */
    ice_fluid m[ICE_MAX_MATERIALS];
} ice_view;

/* C_MIXED is the number of materials in a cell, plus this where one of them is carried by points. */
enum { ICE_WITH_POINTS = 64 };
static inline bool ice_holds_points(const ice_view *v, ptrdiff_t at)
{
    return v->mixed[at] >= ICE_WITH_POINTS;
}

/* Index of row (j, k) of a block with its ghosts. */
static inline int ice_row_number(const block *b, int j, int k)
{
    const int wide = b->dim > 1 ? b->n[1] + 2 * MESH_GHOST : 1;
    return (b->dim > 2 ? (k + MESH_GHOST) * wide : 0) + (b->dim > 1 ? j + MESH_GHOST : 0);
}

/* Of a row's values [lo, hi), those that may be non-zero for a material; `further` more at the upper end (1 for faces
 * along axis 0). */
static inline ice_span ice_near(const ice_view *v, const ice_fluid *m, int j, int k, int further, int lo, int hi)
{
    if (!m->near) return (ice_span){lo, hi};
    const ice_span s = m->near[ice_row_number(v->b, j, k)];
    const int first = s.first > lo ? s.first : lo, end = s.end + further < hi ? s.end + further : hi;
    return first < end ? (ice_span){first, end} : (ice_span){hi, hi};
}

/* A block of a region, or, where NULL is given for it, of all materials (with the common quantities of the first region). */
void ice_view_make(const ice *s, const ice_region *g, int block_id, ice_view *v);
/* All blocks of a region: for (int id = 0; ice_next_view(s, g, &id, &v);). */
bool ice_next_view(const ice *s, const ice_region *g, int *id, ice_view *v);
/* From the mass exchange on, rho is what it left. */
void ice_view_lagrangian(ice_view *v);

/* Kernels work along axis 0 at local (j, k). Each has one always-inline body, instantiated for dimension 1, 2, 3 and for one
 * fluid or several; the tables are indexed [dim - 1][multi]. */
typedef void ice_row(const ice_view *v, int j, int k);
typedef void ice_material_row(const ice_view *v, int r, int axis, int j, int k);

#define ICE_TABLE(name)                                     \
    {                                                       \
        {name##_1_0, name##_1_1}, {name##_2_0, name##_2_1}, \
        {                                                   \
            name##_3_0, name##_3_1                          \
        }                                                   \
    }
#define ICE_EACH(X) X(1, 0) X(1, 1) X(2, 0) X(2, 1) X(3, 0) X(3, 1)

/* Rows of a block with `ghost` layers about it (negative axis: cells), or of the faces normal to `axis`. */
typedef struct ice_rows {
    int j0, k0, nj, n;
} ice_rows;
ice_rows ice_rows_of(const block *b, int axis, int ghost);
static inline int ice_row_j(ice_rows q, int row)
{
    return q.j0 + row % q.nj;
}
static inline int ice_row_k(ice_rows q, int row)
{
    return q.k0 + row / q.nj;
}
/* Index of a row's local cell i = 0. */
static inline ptrdiff_t ice_row_start(const block *b, ice_rows q, int row)
{
    return mesh_index(b, 0, ice_row_j(q, row), ice_row_k(q, row));
}
/* Kernels over the rows of a view: cells with `ghost` layers, and faces of a material normal to `axis`. */
void ice_run_cells(const ice_view *v, int ghost, ice_row *kernel);
void ice_run_faces(const ice_view *v, int r, int axis, ice_material_row *kernel);

/* Least energy (J/kg) that a fluid may have, 0 where its law's depends on density. */
static inline double ice_least_energy(const ice_view *v, int r)
{
    const double floor = v->material[r].energy_floor;
    return isnan(floor) ? 0.0 : floor;
}

/* Whether cells bear a weight along an axis where it lies in them. Rows that need not find it are instances of their own: lanes evaluate both sides of a condition. */
static inline bool ice_weight_is_uneven(const ice_view *v, int axis)
{
    return v->uneven && v->gravity[axis] != 0.0;
}

/* The centring of the implicit pressure where the explicit one is phi. */
static inline double ice_implicit_phi(const ice_view *v, double phi)
{
    return most(phi, 0.5 * v->advance);
}

/* Whether some fluid of the cells is viscous. */
bool ice_is_viscous(const ice *s);

#endif
