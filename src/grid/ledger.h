/* The ledger: nothing is silently lost (theory 10.1). Every flux through a boundary, source, work and defect is entered;
 * a drift is |Q - Q0 - entries| over a scale that does not grow with the error: what was there at the start and what
 * boundaries and sources have let in. Entries of a step are pending until it is committed, so that a rejected step
 * leaves none. Sums are compensated. */
#ifndef GRID_LEDGER_H
#define GRID_LEDGER_H

#include "grid/mesh.h"

typedef enum ledger_quantity {
    LEDGER_MASS,
    LEDGER_MOMENTUM_X,
    LEDGER_MOMENTUM_Y,
    LEDGER_MOMENTUM_Z,
    LEDGER_ENERGY,
    LEDGER_MOMENT_X, /* of momentum about the origin; in the plane that about z alone */
    LEDGER_MOMENT_Y,
    LEDGER_MOMENT_Z,
    LEDGER_QUANTITIES
} ledger_quantity;

typedef enum ledger_kind {
    LEDGER_BOUNDARY, /* through the sides of the domain, inward positive */
    LEDGER_SOURCE,   /* heating, body forces, tractions, prescribed motion */
    LEDGER_DAMPING,  /* removed by viscous damping and by FLIP/PIC blending, where it is known */
    LEDGER_DEFECT,   /* floors, clamps, guards, deleted points */
    LEDGER_CONTACT,  /* work of the forces between bodies in contact */
    LEDGER_KINDS
} ledger_kind;

typedef enum ledger_count {
    COUNT_NEWTON_CELLS,
    COUNT_NEWTON_ITERATIONS,
    COUNT_NEWTON_FALLBACKS,
    COUNT_FLOORS,
    COUNT_ENERGY_GUARDS,
    COUNT_POINTS_LOST,
    COUNT_POINTS_BURNT, /* points that a reaction has consumed entirely */
    COUNT_SMALL_NODES,
    COUNT_REORDERS,
    COUNT_CONTACT_STICK, /* pairs of bodies at nodes, over the steps: that move as one, slide, or part */
    COUNT_CONTACT_SLIP,
    COUNT_CONTACT_RELEASE,
    COUNT_NORMALS_PLAIN, /* points of membranes, over the steps, for which a method found no normal: that of the nearest points */
    COUNT_NORMALS_KEPT,    /* nor they one: the former */
    COUNT_PRESSURE_SOLVES, /* implicit pressure: steps, their outer iterations, iterations of conjugate gradients */
    COUNT_OUTER_ITERATIONS,
    COUNT_CG_ITERATIONS,
    COUNT_BALANCE_ITERATIONS, /* steps of points that are solved for: of Newton's method, of conjugate gradients in them */
    COUNT_BALANCE_KRYLOV,
    COUNT_CELLS_MERGED, /* small cut cells that shared a larger one's state, over the steps */
    LEDGER_COUNTS
} ledger_count;

typedef struct ledger_sum {
    double value, carry;
} ledger_sum; /* compensated (Neumaier) */

enum { LEDGER_INPUTS = LEDGER_SOURCE + 1 }; /* the kinds that let something in: boundary and source */

/* Energy of motion and strain, and what it can have (J). */
typedef struct ledger_motion {
    double start;     /* of motion and strain at the start */
    double internal;  /* of heat and pressure at the start */
    double available; /* the most so far of: start, what internal energy has lost, and what has come in */
    double beyond;    /* looks in a row, at different times, by which more than that has come from nothing */
    double last_look; /* s */
    double stored;    /* what fluids could set in motion by themselves at the start; below 0: not known */
    double most;      /* the most so far of motion and strain */
} ledger_motion;

typedef struct ledger {
    double initial[LEDGER_QUANTITIES]; /* Q0 */
    double total[LEDGER_QUANTITIES];   /* Q now */
    double scale[LEDGER_QUANTITIES];   /* what drifts are measured against; of momentum the largest among the axes */
    double extent[LEDGER_QUANTITIES];  /* sum of |q|: of mass and energy at the start, of momentum the most so far */
    double let_in[LEDGER_QUANTITIES][LEDGER_INPUTS]; /* the most so far that boundaries and sources had brought */
    double worst[LEDGER_QUANTITIES];                 /* the largest excess so far, with its sign */
    double worst_time[LEDGER_QUANTITIES];            /* s: when */
    double arm;                                      /* m: the farthest from the middle of the mesh that momentum is */
    double elasticity; /* J: sum of m c^2 of the solids; a share of it is the round-off of one at rest */
    ledger_motion motion;
    bool not_conserved[LEDGER_QUANTITIES]; /* not a balance in this scene (ledger_choose) */
    ledger_sum entry[LEDGER_QUANTITIES][LEDGER_KINDS];
    double pending[LEDGER_QUANTITIES][LEDGER_KINDS];
    long long count[LEDGER_COUNTS], pending_count[LEDGER_COUNTS];
} ledger;

void ledger_add(ledger *l, ledger_quantity q, ledger_kind kind, double amount);
/* An impulse along an axis at x (zero along axes that the scene does not have), and its moment. */
void ledger_push(ledger *l, ledger_kind kind, int axis, double impulse, const double x[MESH_MAX_DIM]);
/* Moments that were added up, times `share`. */
void ledger_turn(ledger *l, ledger_kind kind, const double moment[3], double share);
void ledger_tally(ledger *l, ledger_count what, long long n);
void ledger_commit(ledger *l);  /* adds the pending entries to the ledger */
void ledger_discard(ledger *l); /* the step was rejected */
/* Relative drift of a quantity, with entries of all kinds; 0 where it is not conserved. */
double ledger_drift(const ledger *l, ledger_quantity q);
/* What is there and should not be: total less the start and all entries; negative where something is lost. */
double ledger_excess(const ledger *l, ledger_quantity q);

/* Whether open sides fed motion that nothing in the scene could have: by more than half of what it could, and a hundredth of all energy. */
bool ledger_is_fed(const ledger *l);
/* J: motion and strain that there can be of what is stored, was there at the start, and what sources have brought. */
double ledger_possible_motion(const ledger *l);

/* The largest of the run so far, with the sign of its excess, against the scale as it is now: what has come in by then is
 * what an error of the first steps is small beside. */
double ledger_largest_drift(const ledger *l, ledger_quantity q);

/* The same as a share of what has come in, too: of moments of momentum, which walls and weight give and take all along. */
double ledger_largest_share(const ledger *l, ledger_quantity q);

/* Current totals of the scene, for a check of the ledger. */
typedef struct ledger_state {
    double total[LEDGER_QUANTITIES];
    double extent[LEDGER_QUANTITIES]; /* sum of |q|; of moments about the middle of the mesh */
    bool turns;                       /* moments are known: they cost a pass of their own */
    double motion;                    /* J: kinetic and strain energy */
    double internal;                  /* J */
} ledger_state;
/* Quantities that are conserved on a mesh: momentum along its axes except a radius, and moments of momentum unless an
 * axis of their plane is periodic; in axisymmetric scenes there is no rotation about the axis. */
void ledger_choose(ledger *l, const mesh *m);
/* No account of moments of momentum: beside cut cells, where what a side and a wall give a merged cell has no one place. */
void ledger_leave_moments(ledger *l);
/* Starts the ledger. `elasticity` (J): sum of m c^2 of the solids. */
void ledger_open(ledger *l, const ledger_state *now, double elasticity);
/* Brings totals, scales and the largest drifts up to date. */
void ledger_look(ledger *l, const ledger_state *now, double time);

/* Adds the moment about the origin of an impulse along an axis at x. */
static inline void add_moment(double moment[3], const double x[MESH_MAX_DIM], int axis, double impulse)
{
    const int next = axis == 2 ? 0 : axis + 1, last = axis == 0 ? 2 : axis - 1;
    moment[next] += x[last] * impulse;
    moment[last] -= x[next] * impulse;
}

const char *ledger_quantity_name(ledger_quantity q);
const char *ledger_count_name(ledger_count c);

#endif
