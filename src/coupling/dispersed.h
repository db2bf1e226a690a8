/* Spheres dispersed in a carrier: what their laws of drag and heat share. The spheres are the first material of the
 * pair. */
#ifndef COUPLING_DISPERSED_H
#define COUPLING_DISPERSED_H

#include "coupling/coupling_constants.h"
#include "coupling/exchange_law.h"

#include <math.h>

typedef struct dispersed_par {
    double diameter;  /* m */
    double viscosity; /* Pa s of the carrier; 0: that of its material */
} dispersed_par;

/* The rows of a parameter table whose struct begins with a dispersed_par. */
#define DISPERSED_PARAMS                                                                            \
    PAR_POSITIVE(dispersed_par, diameter, "m", NAN, "diameter of the spheres, the first material"), \
        PAR_NONNEGATIVE(dispersed_par, viscosity, "Pa s", 0.0,                                      \
                        "shear viscosity of the carrier, the second material; 0: by its own `viscosity`")

static inline double dispersed_viscosity(const dispersed_par *a, const exchange_pair *q)
{
    return a->viscosity > 0.0 ? a->viscosity : q->viscosity[1];
}

/* Re = rho_c |u_c - u_d| d / mu, of one sphere. */
static inline double dispersed_reynolds(const dispersed_par *a, const exchange_pair *q)
{
    return q->density[1] * q->slip * a->diameter / dispersed_viscosity(a, q);
}

/* There are 6 theta_d/(pi d^3) spheres in a volume. What goes to one sphere alone in the carrier, times that, is
 * theta_d theta_c K: the fraction of the carrier is taken out here. It is kept from 0, where nothing is exchanged
 * anyway. */
static inline double dispersed_share(const exchange_pair *q)
{
    return 1.0 / fmax(q->theta[1], DISPERSED_LEAST_CARRIER);
}

/* Stokes' 3 pi mu d u per sphere as K, without the correction for inertia. */
static inline double dispersed_stokes(const dispersed_par *a, const exchange_pair *q)
{
    return 18.0 * dispersed_viscosity(a, q) / (a->diameter * a->diameter) * dispersed_share(q);
}

static inline const char *dispersed_check(const dispersed_par *a, const double viscosity[2])
{
    if (a->viscosity > 0.0 || viscosity[1] > 0.0) return NULL;
    return "the carrier (the second of `between`) has no viscosity: give `viscosity` here or to its material";
}

#endif
