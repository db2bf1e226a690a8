/* Laws of exchange between two materials. One file adds one: exchange_<name>.c ends in a const descriptor
 * `exchange_<name>`.
 *
 * A law gives the coefficient K of the momentum or R of the heat that two interpenetrating materials exchange,
 *     theta_r theta_s K_rs (u_s - u_r) per volume and time,    theta_r theta_s R_rs (T_s - T_r),
 * at a place. It must not be negative, and may depend on the state there, which is then taken as it is before the
 * exchange. */
#ifndef COUPLING_EXCHANGE_LAW_H
#define COUPLING_EXCHANGE_LAW_H

#include "base/param.h"

/* What it is the law of; a model may serve both, with parameters of its own for each. */
typedef enum exchange_role {
    EXCHANGE_MOMENTUM, /* K, kg/(m3 s) */
    EXCHANGE_HEAT,     /* R, W/(m3 K) */
    EXCHANGE_ROLES
} exchange_role;

/* Stands for any strength that leaves no difference; beyond 1e12 of the masses nothing changes (exchange.h). */
#define EXCHANGE_LOCKED 1e100

/* Two materials at one place. Index 0: the first that the deck names (the one that is dispersed), 1: the other. */
typedef struct exchange_pair {
    double theta[2];     /* volume fractions */
    double density[2];   /* of the pure materials, kg/m3 */
    double viscosity[2]; /* shear, Pa s */
    double slip;         /* |u_0 - u_1|, m/s */
} exchange_pair;

typedef struct exchange_law {
    size_t param_size;
    const param_spec *params;
    size_t n_params;
    bool uniform; /* the coefficient is a constant: it is evaluated once, with no pair (NULL) */
    /* NULL: the model has no law for this. */
    double (*coefficient)(const void *par, const exchange_pair *pair);
    /* What the pair lacks, in words; NULL if nothing. May be NULL. viscosity: of both materials, Pa s. */
    const char *(*check)(const void *par, const double viscosity[2]);
} exchange_law;

typedef struct exchange_model {
    const char *name; /* in the deck */
    const char *doc;  /* one line */
    const char *cite; /* NULL: none is needed */
    exchange_law law[EXCHANGE_ROLES];
} exchange_model;

/* All of them, in alphabetical order, made by the build from the file names. */
extern const exchange_model *const exchange_registry[];
extern const size_t exchange_registry_size;
/* NULL if there is none of that name. */
const exchange_model *exchange_find(const char *name);

#endif
