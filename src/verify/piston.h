/* A piston of a mass between a column of fluid, closed at the far end, and a spring, held at the far end: the
 * frequencies
 *     m omega^2 = rho c A omega cot(omega L/c) + sqrt(K M) omega cot(omega sqrt(M/K))
 * of linear acoustics, the last term being that of a spring of stiffness K and mass M (K alone if M = 0). York (1997),
 * eq. 6.2 is the massless spring. Only src/verify includes this. */
#ifndef VERIFY_PISTON_H
#define VERIFY_PISTON_H

#include "base/context.h"

typedef struct piston {
    double mass;                  /* kg, > 0 */
    double stiffness;             /* N/m, >= 0; > 0 if the spring has a mass */
    double spring_mass;           /* kg, >= 0 */
    double area, length;          /* of the fluid column, m2 and m */
    double density, bulk_modulus; /* of the fluid, kg/m3 and Pa */
} piston;

/* Parameters of a solution whose struct begins with a piston. */
#define PISTON_PARAMS                                                                                  \
    PAR_POSITIVE(piston, mass, "kg", NAN, "mass of the piston"),                                       \
        PAR_NONNEGATIVE(piston, stiffness, "N/m", NAN, "stiffness of the spring behind it"),           \
        PAR_NONNEGATIVE(piston, spring_mass, "kg", 0.0, "mass of the spring, spread evenly along it"), \
        PAR_POSITIVE(piston, area, "m2", 1.0, "area of the piston"),                                   \
        PAR_POSITIVE(piston, length, "m", NAN, "length of the fluid column at rest"),                  \
        PAR_POSITIVE(piston, density, "kg/m3", NAN, "density of the fluid at rest"),                   \
        PAR_POSITIVE(piston, bulk_modulus, "Pa", NAN, "isentropic bulk modulus of the fluid, rho c^2")

/* York's (1997, section 6.1): a fluid of c = 1.26e5, the smaller of his two masses. */
#define PISTON_OF_YORK                                                                                        \
    {                                                                                                         \
        .mass = 0.1, .stiffness = 100.0, .area = 1.0, .length = 20.0, .density = 1e-4, .bulk_modulus = 1.58e6 \
    }

/* Errors: FLOE_BAD_INPUT for a spring with a mass but no stiffness. */
floe_status piston_check(context *ctx, const piston *p);

/* The angular frequency (rad/s) of the mode-th mode (from 1) in which the piston moves; NAN if it is not found. There
 * is one between any two neighbours of the frequencies at which fluid or spring alone vibrate between fixed ends. */
double piston_frequency(const piston *p, int mode);

/* Mass (kg) that would have the kinetic energy of the mode at the piston's velocity: piston, fluid and spring. */
double piston_modal_mass(const piston *p, double omega);

#endif
