/* Laws of a program's own: a solid's stress and an equation of state, given by functions, which decks then name like
 * floe's own:
 *
 *     typedef struct spring { double stiffness; } spring;
 *     static const floe_parameter spring_parameters[] = {
 *         {.key = "stiffness", .unit = "Pa", .range = FLOE_POSITIVE, .fallback = NAN, .offset = offsetof(spring, stiffness),
 *          .count = 1, .doc = "Young's modulus"}};
 *     static const floe_solid_law law = {.size = sizeof law, .name = "spring", ...};
 *     floe_add_solid_law(floe, &law);
 *
 *     law: {spring: {stiffness: 1 MPa}}          (in a deck that is read with the same context)
 *
 * Laws are functions of what they are handed, and of nothing else: several threads call them at once, a rejected step
 * calls them again, and the same numbers must give the same bits. They must not call floe. */
#ifndef FLOE_LAW_H
#define FLOE_LAW_H

#include <stddef.h>

enum {
    FLOE_LAW_POINTS = 64, /* the most points in a batch */
    FLOE_LAW_HISTORY = 24 /* the most history variables of a law */
};

/* What a number of a deck may be. */
typedef enum floe_range {
    FLOE_ANY,         /* any finite number */
    FLOE_POSITIVE,    /* > 0 */
    FLOE_NONNEGATIVE, /* >= 0 */
    FLOE_BETWEEN      /* lo <= x <= hi */
} floe_range;

/* A parameter of a law: a double in the law's parameter struct, read from the deck. */
typedef struct floe_parameter {
    const char *key; /* its name in the deck: letters, digits, '_'; not empty */
    const char *
        unit; /* in SI, as udunits2 spells it ("Pa", "kg/m^3"); "1" where it has none. Decks may use any unit of that kind */
    floe_range range; /* what the deck may say, in `unit`; anything else is refused with its line and column */
    double lo, hi;    /* of FLOE_BETWEEN */
    double fallback;  /* what holds where the deck says nothing; NAN: the deck must say it */
    size_t offset;    /* of the double in the parameter struct, in bytes */
    int count;        /* 1: a number; n > 1: a list of n numbers, double[n] */
    const char *doc;  /* one line for messages */
} floe_parameter;

/* A batch of points, always in three dimensions: point i of component k is [k][i], 0 <= i < n. Of a plane scene the
 * entries across the plane are filled in. Components of tensors: xx xy xz yx yy yz zx zy zz (row-major); of stresses:
 * xx yy zz xy yz zx. The caller owns it; entries from n on have no meaning. */
typedef struct floe_solid_batch {
    size_t n;                      /* points, 1 to FLOE_LAW_POINTS */
    double dt;                     /* s, the step */
    double L[9][FLOE_LAW_POINTS];  /* 1/s, velocity gradient over the step (in) */
    double F[9][FLOE_LAW_POINTS];  /* 1, deformation gradient at the end of the step (in, with FLOE_NEEDS_F alone) */
    double J[FLOE_LAW_POINTS];     /* 1, volume over that at rest, at the end of the step (in) */
    double J_old[FLOE_LAW_POINTS]; /* 1, the same at its start (in) */
    double rho0[FLOE_LAW_POINTS];  /* kg/m3, density at rest (in) */
    double stress[6][FLOE_LAW_POINTS]; /* Pa, Cauchy, tension positive: at the start of the step in, at its end out */
    double energy[FLOE_LAW_POINTS];    /* J/kg, internal energy: start in, end out (with FLOE_HAS_ENERGY alone) */
    double q[FLOE_LAW_POINTS];         /* Pa, artificial viscous pressure over the step, compression positive (in) */
    double history[FLOE_LAW_HISTORY][FLOE_LAW_POINTS]; /* the law's own numbers: start in, end out; 0 at first */
    /* with FLOE_NEEDS_TEMPERATURE alone, of the start of the step (in); 0 where the points have no temperature */
    double temperature[FLOE_LAW_POINTS]; /* K */
    double heat[FLOE_LAW_POINTS];        /* J/kg, specific heat times the temperature over that without stress */
} floe_solid_batch;

/* What a law of solids asks for; or-ed. */
enum {
    FLOE_NEEDS_F = 1,           /* the deformation gradient is kept; without it only its determinant is */
    FLOE_HAS_ENERGY = 2,        /* internal energy is state of the points: what is no strain energy */
    FLOE_NEEDS_TEMPERATURE = 4, /* points have a temperature, which the stress depends on */
    FLOE_NEEDS_TIME = 8         /* dt is the time of the step also where steps are solved for; 1 s without it */
};

/* A number that each point carries for a law: in snapshots, checkpoints and fields by its name. */
typedef struct floe_history {
    const char *name; /* letters, digits, '_' */
    const char *unit; /* as udunits2 spells it; "1" where it has none */
    const char *doc;  /* one line */
} floe_history;

/* A law of solids. par is the parameter struct, filled from the deck. */
typedef struct floe_solid_law {
    size_t size;           /* sizeof(floe_solid_law): tells the library which header the program was built with */
    const char *name;      /* in the deck, unlike that of any other law: letters, digits, '_' */
    const char *doc;       /* one line; may be NULL */
    size_t parameter_size; /* bytes of the parameter struct; 0 where there are no parameters */
    const floe_parameter *parameters; /* n_parameters of them */
    size_t n_parameters;
    unsigned needs;              /* of FLOE_NEEDS_F, _TEMPERATURE, _TIME and FLOE_HAS_ENERGY */
    const floe_history *history; /* n_history of them, 0 to FLOE_LAW_HISTORY */
    int n_history;
    /* Sets stress (and energy, history) at the end of the step. Returns 0, or 1 + the first point that is beyond the law
     * (J <= 0): the step is then repeated with half its length. p_ref: Pa, the pressure at which stress is zero; laws of
     * solids need not look at it. Needed. */
    size_t (*stress)(const void *par, double p_ref, floe_solid_batch *b);
    /* c[i]: m/s, speed of the fastest wave in each point as it is now, > 0. The time step follows from it: one that is
     * too small lets the run diverge. Needed. */
    void (*wave_speed)(const void *par, double p_ref, const floe_solid_batch *b, double *c);
    /* psi[i]: J/m3 of the volume at rest, strain energy of each point. NULL: the law has no potential, and totals leave
     * it out. */
    void (*strain_energy)(const void *par, const floe_solid_batch *b, double *psi);
    /* Pa, > 0: isothermal bulk modulus at rest; cells that the solid shares with a fluid see it. Needed. */
    double (*bulk_modulus)(const void *par);
    /* Pa, >= 0: shear modulus at rest. Needed. */
    double (*shear_modulus)(const void *par);
    /* Pa: stress in uniaxial tension at which it first flows; NULL: it never does. */
    double (*yield_stress)(const void *par);
} floe_solid_law;

/* An equation of state of fluids. par is the parameter struct, filled from the deck; every function but the last four
 * works on n states at once. rho: kg/m3 of the pure fluid; e: J/kg; p: Pa, absolute; T: K. */
typedef struct floe_equation_of_state {
    size_t size;      /* sizeof(floe_equation_of_state) */
    const char *name; /* in the deck, unlike that of any other equation of state: letters, digits, '_' */
    const char *doc;  /* one line; may be NULL */
    size_t parameter_size;
    const floe_parameter *parameters; /* n_parameters of them */
    size_t n_parameters;
    /* p(rho, e), and c2 = (dp/drho)_e + (dp/de)_rho p / rho^2, the square of the speed of sound, m2/s2. Needed. */
    void (*pressure)(const void *par, size_t n, const double *rho, const double *e, double *p, double *c2);
    /* T(rho, e). Needed. */
    void (*temperature)(const void *par, size_t n, const double *rho, const double *e, double *T);
    /* e(rho, T), the inverse. Needed. */
    void (*energy)(const void *par, size_t n, const double *rho, const double *T, double *e);
    /* v(p, T), m3/kg, and dvdp = (dv/dp)_T < 0, for every p above pressure_floor. Needed. */
    void (*volume)(const void *par, size_t n, const double *p, const double *T, double *v, double *dvdp);
    /* (dp/de)_rho, kg/m3. Needed. */
    void (*dpde)(const void *par, size_t n, const double *rho, const double *e, double *dpde);
    /* cv, J/kg/K, and alpha = (dv/dT)_p / v, 1/K, at (rho, e). Needed. */
    void (*heat)(const void *par, size_t n, const double *rho, const double *e, double *cv, double *alpha);
    /* Pa: volume() is defined above it (0 for an ideal gas). Needed. */
    double (*pressure_floor)(const void *par);
    /* J/kg: the least internal energy at rho; a step that goes below is rejected. Needed. */
    double (*energy_floor)(const void *par, double rho);
    /* kg/m3: the law ends there; NULL: it holds at any density. */
    double (*density_limit)(const void *par);
    /* What is wrong with parameters that each are in range, as the end of a sentence; NULL if nothing is. The pointer may
     * be NULL. */
    const char *(*check)(const void *par);
} floe_equation_of_state;

#endif
