/* What the pressurised thick cylinder and the thick sphere share: parameters, their check and a case. Only src/verify
 * includes this. */
#ifndef VERIFY_ANNULUS_H
#define VERIFY_ANNULUS_H

#include "verify/verify_internal.h"

typedef struct annulus_par {
    double inner_radius, outer_radius, inner_pressure, outer_pressure;
    double bulk_modulus, shear_modulus;
    double centre[3];
} annulus_par;

/* The parameter table; `hollow` and `centre_doc` say in words what is empty inside, and where the centre is. */
#define ANNULUS_PARAMS(hollow, centre_doc)                                                                    \
    {                                                                                                         \
        PAR_POSITIVE(annulus_par, inner_radius, "m", NAN, "radius of the " hollow),                           \
            PAR_POSITIVE(annulus_par, outer_radius, "m", NAN, "outer radius"),                                \
            PAR_ANY(annulus_par, inner_pressure, "Pa", NAN,                                                   \
                    "pressure in the " hollow ", less the reference pressure"),                               \
            PAR_ANY(annulus_par, outer_pressure, "Pa", 0.0, "pressure outside, less the reference pressure"), \
            PAR_POSITIVE(annulus_par, bulk_modulus, "Pa", NAN, "bulk modulus K"),                             \
            PAR_POSITIVE(annulus_par, shear_modulus, "Pa", NAN, "shear modulus G"),                           \
            PAR_VECTOR(annulus_par, centre, "m", PARAM_ANY, 0.0, centre_doc),                                 \
    }

/* Guilkey et al. (2003), section 3. */
#define ANNULUS_SAMPLE                                                                             \
    {                                                                                              \
        .inner_radius = 0.5, .outer_radius = 1.0, .inner_pressure = 19.4e6, .bulk_modulus = 117e9, \
        .shear_modulus = 43.8e9                                                                    \
    }

/* Errors: FLOE_BAD_INPUT unless the outer radius is the larger one. */
static inline floe_status annulus_check(context *ctx, const annulus_par *p)
{
    if (p->outer_radius > p->inner_radius) return FLOE_OK;
    return fail_key(ctx, KEY("outer_radius"), "%g m: must be over inner_radius = %g m", p->outer_radius,
                    p->inner_radius);
}

#endif
