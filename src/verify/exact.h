/* Exact solutions. One file adds one: exact_<name>.c ends in a const descriptor `exact_<name>`, the build lists it in
 * exact_registry, and the conformance battery covers it unasked (it solves its equations at the sample it carries).
 *
 * Conventions: SI; stress is Cauchy, tension positive; pressure is compression positive; x is always double[3], of
 * which the first `dim` are used. Axisymmetric scenes call with dim 2 and x = (r, z, 0). */
#ifndef VERIFY_EXACT_H
#define VERIFY_EXACT_H

#include "base/context.h"
#include "base/param.h"

#include <stdbool.h>
#include <stdint.h>

/* X(enumerator, name, unit, doc): the quantities that a run can be compared in. The name is the X of `l1_X`. */
#define EXACT_QUANTITY_LIST(X)                                                                                   \
    X(EXACT_DENSITY, "density", "kg/m3", "mass per volume")                                                      \
    X(EXACT_VELOCITY_X, "velocity_x", "m/s", "velocity, first component (radial when axisymmetric)")             \
    X(EXACT_VELOCITY_Y, "velocity_y", "m/s", "velocity, second component (axial when axisymmetric)")             \
    X(EXACT_VELOCITY_Z, "velocity_z", "m/s", "velocity, third component")                                        \
    X(EXACT_PRESSURE, "pressure", "Pa", "pressure, compression positive")                                        \
    X(EXACT_INTERNAL_ENERGY, "internal_energy", "J/kg", "internal energy per mass")                              \
    X(EXACT_TEMPERATURE, "temperature", "K", "temperature")                                                      \
    X(EXACT_STRESS_XX, "stress_xx", "Pa", "Cauchy stress xx, tension positive")                                  \
    X(EXACT_STRESS_YY, "stress_yy", "Pa", "Cauchy stress yy, tension positive")                                  \
    X(EXACT_STRESS_ZZ, "stress_zz", "Pa", "Cauchy stress zz (out of plane in two dimensions), tension positive") \
    X(EXACT_STRESS_XY, "stress_xy", "Pa", "Cauchy stress xy")                                                    \
    X(EXACT_STRESS_YZ, "stress_yz", "Pa", "Cauchy stress yz")                                                    \
    X(EXACT_STRESS_ZX, "stress_zx", "Pa", "Cauchy stress zx")                                                    \
    X(EXACT_SIGMA_R, "sigma_r", "Pa", "radial stress about the solution's centre, tension positive")             \
    X(EXACT_SIGMA_THETA, "sigma_theta", "Pa", "hoop stress about the solution's centre, tension positive")       \
    X(EXACT_DISPLACEMENT_X, "displacement_x", "m", "displacement, first component")                              \
    X(EXACT_DISPLACEMENT_Y, "displacement_y", "m", "displacement, second component")                             \
    X(EXACT_DISPLACEMENT_Z, "displacement_z", "m", "displacement, third component")                              \
    X(EXACT_VOLUME_FRACTION, "volume_fraction", "1", "volume fraction of the solution's first material")         \
    X(EXACT_NORMAL_X, "normal_x", "1", "unit normal of a membrane, first component, on the solution's side")     \
    X(EXACT_NORMAL_Y, "normal_y", "1", "unit normal, second component")                                          \
    X(EXACT_NORMAL_Z, "normal_z", "1", "unit normal, third component")                                           \
    X(EXACT_NORMAL, "normal", "degrees", "angle between a membrane's normal and the solution's, which has 0")

typedef enum exact_quantity {
#define EXACT_QUANTITY_ENUM(enumerator, name, unit, doc) enumerator,
    EXACT_QUANTITY_LIST(EXACT_QUANTITY_ENUM)
#undef EXACT_QUANTITY_ENUM
        EXACT_QUANTITY_COUNT
} exact_quantity;

/* A set of quantities, for exact_model.provides. */
#define EXACT_BIT(quantity) (UINT32_C(1) << (quantity))
#define EXACT_VELOCITIES (EXACT_BIT(EXACT_VELOCITY_X) | EXACT_BIT(EXACT_VELOCITY_Y) | EXACT_BIT(EXACT_VELOCITY_Z))
#define EXACT_FLUID_STATE                                                                                         \
    (EXACT_BIT(EXACT_DENSITY) | EXACT_VELOCITIES | EXACT_BIT(EXACT_PRESSURE) | EXACT_BIT(EXACT_INTERNAL_ENERGY) | \
     EXACT_BIT(EXACT_TEMPERATURE))
#define EXACT_DISPLACEMENTS \
    (EXACT_BIT(EXACT_DISPLACEMENT_X) | EXACT_BIT(EXACT_DISPLACEMENT_Y) | EXACT_BIT(EXACT_DISPLACEMENT_Z))
#define EXACT_STRESSES                                                                      \
    (EXACT_BIT(EXACT_STRESS_XX) | EXACT_BIT(EXACT_STRESS_YY) | EXACT_BIT(EXACT_STRESS_ZZ) | \
     EXACT_BIT(EXACT_STRESS_XY) | EXACT_BIT(EXACT_STRESS_YZ) | EXACT_BIT(EXACT_STRESS_ZX))

#define EXACT_NORMALS \
    (EXACT_BIT(EXACT_NORMAL_X) | EXACT_BIT(EXACT_NORMAL_Y) | EXACT_BIT(EXACT_NORMAL_Z) | EXACT_BIT(EXACT_NORMAL))

/* The balance laws that a solution satisfies where it is smooth: what the conformance battery tests by differences. */
typedef enum exact_equations {
    EXACT_EULER,            /* mass, momentum and total energy of an inviscid fluid, with body_force */
    EXACT_NAVIER_STOKES,    /* the same, with viscosity, bulk_viscosity, conductivity (absent: 0) and heat_source */
    EXACT_LINEAR_ACOUSTICS, /* rho0 Du + grad p = 0, Dp + rho0 c^2 div u = 0; parameters density, sound_speed */
    EXACT_INCOMPRESSIBLE,   /* div u = 0, rho Du + grad p = mu lap u + rho b; parameters density, viscosity */
    EXACT_SOLID,            /* rho0 d2u/dt2 = div sigma + rho0 b; parameter density (absent: at rest) */
    EXACT_LARGE_SOLID, /* rho0 d2u/dt2 = Div P + rho0 b, P = J sigma F^-T, x the place before the load (density absent: at rest) */
    EXACT_OUTLINE, /* a surface: normals of length one that lead along a gradient, without a curl */
    EXACT_ORDINARY /* an ordinary differential equation in t, tested by itself */
} exact_equations;

enum { EXACT_MAX_BREAKS = 8 };

/* Planes x[axis] = position across which a solution jumps, in value or in slope. */
typedef struct exact_breaks {
    int axis;                          /* 0, 1 or 2 */
    int count;                         /* 0 ... EXACT_MAX_BREAKS */
    double position[EXACT_MAX_BREAKS]; /* m, ascending */
} exact_breaks;

/* A named number of a solution that is no field: a star pressure, a period, a shock's position. */
typedef struct exact_scalar {
    const char *name, *unit, *doc;
} exact_scalar;

/* A typical use, where the solution is smooth: a fixed parameter set, a box and a time. */
typedef struct exact_sample {
    const void *par;     /* param_size bytes */
    int dim;             /* 1, 2 or 3 */
    double lo[3], hi[3]; /* m */
    double t;            /* s */
} exact_sample;

typedef struct exact_model {
    const char *name;     /* in the deck: verify: {exact: lame, ...} */
    const char *doc;      /* one line */
    const char *cite;     /* source, with the equation where it has one */
    const char *validity; /* under which conditions it is exact for what floe solves, and its error otherwise */
    bool of_solids_too;   /* fluid's equations, and a solid's as well */
    exact_equations equations;
    size_t param_size;
    const param_spec *params;
    size_t n_params;
    int min_dim, max_dim;
    uint32_t provides;           /* EXACT_BIT of each quantity that value() gives */
    const exact_scalar *scalars; /* NULL if none */
    size_t n_scalars;
    exact_sample sample;
    size_t prepared_size; /* bytes that prepare() fills, 0: prepare only checks, or is NULL */
    /* Checks the parameters against each other and fills `prepared` (zeroed before). Errors: FLOE_BAD_INPUT with a
     * message. NULL: nothing to do. */
    floe_status (*prepare)(context *ctx, const void *par, int dim, void *prepared);
    /* The quantity at x (m) and t (s); NAN where the solution does not hold (after shock formation, say). */
    double (*value)(const void *par, const void *prepared, exact_quantity quantity, int dim, const double x[3],
                    double t);
    /* Body force per mass (m/s2) that the solution needs; NULL: none. x is the place that value() takes. */
    void (*body_force)(const void *par, const void *prepared, int dim, const double x[3], double t, double force[3]);
    /* Heat per volume (W/m3) that the solution needs; NULL: none. */
    double (*heat_source)(const void *par, const void *prepared, int dim, const double x[3], double t);
    /* Where it jumps at time t; NULL: nowhere. */
    void (*breaks)(const void *par, const void *prepared, double t, exact_breaks *out);
    /* The relative error with which it stands for what floe solves (of small strains, of its own nets); NULL: none that is
     * known. */
    double (*accuracy)(const void *par, const void *prepared);
    /* The i-th of `scalars` at time t (most do not depend on it); NULL if none. */
    double (*scalar)(const void *par, const void *prepared, size_t i, double t);
} exact_model;

/* All of them, in alphabetical order, made by the build from the file names. */
extern const exact_model *const exact_registry[];
extern const size_t exact_registry_size;
/* NULL if there is none of that name. */
const exact_model *exact_find(const char *name);

/* "density"; "" out of range. */
const char *exact_quantity_name(exact_quantity quantity);
const char *exact_quantity_unit(exact_quantity quantity);
const char *exact_quantity_doc(exact_quantity quantity);
/* EXACT_QUANTITY_COUNT if there is none of that name. */
exact_quantity exact_quantity_find(const char *name);

/* The (first) double of the parameter `key` inside `par`; NULL if there is none of that key. */
double *exact_param(const exact_model *model, void *par, const char *key);

/* A solution with its parameters, ready to be evaluated (by any number of threads). */
typedef struct exact {
    const exact_model *model;
    int dim;         /* of the scene: 1, 2 (plane or axisymmetric) or 3 */
    const void *par; /* model->param_size bytes; borrowed: must outlive this */
    void *prepared;  /* owned */
} exact;

/* Prepares `model` with parameters `par` (borrowed; already in the ranges of its table) for a scene of `dim`
 * dimensions. Errors: FLOE_BAD_INPUT, FLOE_NO_MEMORY; then *out is empty. */
floe_status exact_create(context *ctx, const exact_model *model, const void *par, int dim, exact *out);
/* Frees what *solution owns and empties it; NULL and an empty solution are fine. */
void exact_destroy(context *ctx, exact *solution);

bool exact_provides(const exact *solution, exact_quantity quantity);
/* Whether it is a solution for a solid: a function of the undeformed position, with stress relative to the reference pressure. */
bool exact_is_solid(const exact *solution);
/* Of fluids, and of nothing else: a state that is the same everywhere may be a solid's too. */
bool exact_is_fluid(const exact *solution);
/* The quantity at x and t; NAN when the solution does not provide it or does not hold there. */
double exact_value(const exact *solution, exact_quantity quantity, const double x[3], double t);
/* Body force per mass at x and t; zero for a solution without one. */
void exact_body_force(const exact *solution, const double x[3], double t, double force[3]);
/* Heat per volume at x and t; zero for a solution without one. */
double exact_heat_source(const exact *solution, const double x[3], double t);
/* Planes of discontinuity at t; count is 0 when there are none. */
exact_breaks exact_find_breaks(const exact *solution, double t);
/* The relative error that the solution itself may have; 0: it is exact, as far as is known. */
double exact_accuracy(const exact *solution);

/* How a cell average weighs the volume of the cell. */
typedef enum exact_average {
    EXACT_PLAIN = 0,        /* dV: what a volume-weighted cell value (density, pressure) is */
    EXACT_RADIAL = 1,       /* r dr dz, r = x[0] >= 0: axisymmetric scenes (may be or-ed) */
    EXACT_MASS_WEIGHTED = 2 /* rho dV: what a cell's velocity or energy per mass is; needs EXACT_DENSITY (or-ed) */
} exact_average;

/* The average of the quantity over the box [lo, hi] at t: Gauss-Legendre, split at the solution's breaks, then halved
 * until 4 and 6 points an axis agree to 1e-13 of the largest value met (1e-12 in two and three dimensions: the 6 are
 * right to round-off by then), or to the depth's end (kinks off the breaks). `flags` is a sum of exact_average. NAN for
 * an empty box, or when any value met is NAN. */
double exact_cell_average(const exact *solution, exact_quantity quantity, const double lo[3], const double hi[3],
                          double t, int flags);

#endif
