/* Laws of material points: solids, and fluids carried by points. One file adds one: solid_<name>.c ends in a const
 * descriptor `solid_<name>`; the conformance battery covers it (objectivity, stress against the energy's derivative,
 * symmetry, wave speed).
 *
 * A law is a batch over at most SOLID_CHUNK points, always in three dimensions: the kernels unpack 1-D, plane and
 * axisymmetric points (F_zz, L_zz filled in), so that a law's author never sees the dimension. Plane stress and
 * uniaxial stress are solved around the law by solid_stress_state. */
#ifndef MATERIAL_SOLID_H
#define MATERIAL_SOLID_H

#include "base/param.h"
#include "floe/law.h"
#include "material/eos.h"

enum { SOLID_CHUNK = FLOE_LAW_POINTS, SOLID_MAX_HISTORY = FLOE_LAW_HISTORY };

/* A batch of points, as laws of a program see it, too. Index order of 3x3 tensors: xx xy xz yx yy yz zx zy zz
 * (row-major). Stress: xx yy zz xy yz zx, gauge to p_ref. */
typedef floe_solid_batch solid_batch;

typedef enum solid_needs {
    /* Keep F; without it J alone is kept. */
    SOLID_NEEDS_F = FLOE_NEEDS_F,
    /* Carries internal energy as state: of fluids all, of solids what is no strain energy; takes rho0 and q. */
    SOLID_HAS_ENERGY = FLOE_HAS_ENERGY,
    /* The stress depends on the temperature of the point. */
    SOLID_NEEDS_TEMPERATURE = FLOE_NEEDS_TEMPERATURE,
    /* The stress depends on time: steps that are solved for give their own, too. */
    SOLID_NEEDS_TIME = FLOE_NEEDS_TIME
} solid_needs;

/* What the stress depends on, with given parameters, beside strain and history; or-ed. */
typedef enum solid_dependence {
    SOLID_BY_TEMPERATURE = 1, /* points carry a temperature */
    SOLID_BY_ENERGY = 2,      /* the pressure is an equation of state: of volume and internal energy. Its work,
                                 -(p + p') (J' - J)/2 with the mean stresses before and after, is in `energy` */
    SOLID_BY_RATE = 4         /* of strain */
} solid_dependence;

/* A history variable of a law, which a point carries, as snapshots show it. */
typedef floe_history solid_history;

typedef struct solid_model {
    const char *name, *doc, *cite;
    size_t param_size;
    const param_spec *params;
    size_t n_params;
    unsigned needs;
    const solid_history *history; /* n_history of them: state of the points, from rest to checkpoint */
    int n_history;                /* <= SOLID_MAX_HISTORY */
    /* Stress at the end of the step. p_ref (Pa) is subtracted by fluids. Returns 0, or 1 + the first point that is
     * beyond the law (J <= 0, energy below its floor). */
    size_t (*stress)(const void *par, double p_ref, solid_batch *b);
    /* Longitudinal wave speed (m/s), for the time step: c2 = (K + 4G/3)/rho for a solid, of the EOS for a fluid. */
    void (*wave_speed)(const void *par, double p_ref, const solid_batch *b, double *c);
    /* Strain energy per initial volume (J/m3) of the state, NULL if the law has none (fluids use `energy`). */
    void (*strain_energy)(const void *par, const solid_batch *b, double *psi);
    /* Isothermal bulk modulus at rest (Pa): what the cells see of the solid (eos_bulk.c). 0 for fluids. */
    double (*bulk_modulus)(const void *par);
    /* Shear modulus at rest (Pa). 0 for fluids; NULL: membranes have none. */
    double (*shear_modulus)(const void *par);
    /* Stress (Pa) in uniaxial tension at which it first flows; NULL: it never does. */
    double (*yield_stress)(const void *par);
    /* Stretch along one axis beyond which the law may have no state of plane or uniaxial stress; 0: it has all. */
    double largest_stretch;
    /* Of solid_dependence; NULL: on none. */
    unsigned (*depends)(const void *par);
    /* What is wrong with parameters that each are in range, as the end of a sentence; NULL if nothing. NULL: nothing
     * can be. */
    const char *(*check)(const void *par);
} solid_model;

extern const solid_model *const solid_registry[];
extern const size_t solid_registry_size;
/* NULL if there is none of that name. */
const solid_model *solid_find(const char *name);
/* What the stress of a law depends on (solid_dependence). */
unsigned solid_depends_on(const solid_model *law, const void *par);

typedef enum stress_state {
    STRESS_FULL,    /* 3-D, plane strain, axisymmetric, uniaxial strain */
    STRESS_PLANE,   /* sigma_zz = 0 by the choice of L_zz; F_zz is kept */
    STRESS_UNIAXIAL /* sigma_yy = sigma_zz = 0 */
} stress_state;

/* Runs the law under a stress state: for STRESS_PLANE and STRESS_UNIAXIAL it solves, point by point, for the free
 * stretch rates that make the free stresses vanish (Broyden iterations on the law itself, two evaluations where it is
 * linear in the step). In: L, F and J of the step, the free axes as they were carried so far (L_zz is normally 0, F_zz
 * that of the step before). Out: a free axis a that stretches by exp(x) more has x/dt added to L_aa, and row a of F and
 * J times exp(x). F_aa is updated for every law, whether it needs F or not. Return value as solid_model.stress; also 1
 * + the point where the iteration fails, and 1 for a law without moduli (a fluid has no such state). */
size_t solid_stress_state(const solid_model *model, const void *par, double p_ref, stress_state state, solid_batch *b);

/* The fluid law: an equation of state, a shear and a bulk viscosity, carried by points (York 2000 section 3.3:
 * continuity for density, energy equation with p, viscous and artificial work). Parameters of the `solid` model
 * "fluid". */
typedef struct solid_fluid_par {
    eos eos;
    double shear_viscosity; /* Pa s */
    double bulk_viscosity;  /* Pa s: lambda + 2 mu / 3; 0 is Stokes' hypothesis */
} solid_fluid_par;
extern const solid_model point_fluid; /* not in the registry: made from a fluid material's eos and viscosity */

/* The cells' view of a solid: bulk response with a tension branch (eos_bulk.c). An eos like any other ("bulk"), built
 * from rho0, K, c_v, the reference pressure and the switch pressure. */
typedef struct eos_bulk_par {
    double density;            /* kg/m3 at p_ref */
    double bulk_modulus;       /* Pa */
    double specific_heat;      /* J/kg/K */
    double reference_pressure; /* Pa: where density holds; > 0 is not needed */
    double switch_pressure;    /* Pa, over least_pressure: below it the tension branch */
    double
        least_pressure; /* Pa, <= 0: lower bound of p; 0 beside gas, the tensile strength of a liquid beside a liquid */
} eos_bulk_par;

#endif
