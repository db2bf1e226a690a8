/* Equations of state. One file adds one: eos_<name>.c ends in a const descriptor `eos_<name>`, and the conformance
 * battery covers it unasked (derivatives against differences, round trips, positivity).
 *
 * Nothing here assumes e = c_v T. All functions are batches over n points (SoA), pure, and take the material's
 * parameter struct. rho is the density of the pure material (rho = 1/v, kg/m3), e J/kg, p Pa absolute, T K. */
#ifndef MATERIAL_EOS_H
#define MATERIAL_EOS_H

#include "base/param.h"

typedef struct eos_model {
    const char *name; /* in the deck: eos: {ideal: {...}} */
    const char *doc;  /* one line */
    const char *cite;
    size_t param_size;
    const param_spec *params;
    size_t n_params;
    /* p(rho, e) and the squared isentropic sound speed c2 = (dp/drho)_e + (dp/de) p / rho^2 (m2/s2). */
    void (*pressure)(const void *par, size_t n, const double *rho, const double *e, double *p, double *c2);
    /* T(rho, e) */
    void (*temperature)(const void *par, size_t n, const double *rho, const double *e, double *T);
    /* e(rho, T) */
    void (*energy)(const void *par, size_t n, const double *rho, const double *T, double *e);
    /* v(p, T) and (dv/dp)_T < 0, defined for every p > pressure_floor */
    void (*volume)(const void *par, size_t n, const double *p, const double *T, double *v, double *dvdp);
    /* (dp/de)_rho, for energy addition and the partition of heat */
    void (*dpde)(const void *par, size_t n, const double *rho, const double *e, double *dpde);
    /* c_v (J/kg/K) and the thermal expansivity alpha = (dv/dT)_p / v (1/K) at (rho, e) */
    void (*heat)(const void *par, size_t n, const double *rho, const double *e, double *cv, double *alpha);
    /* infimum of p for which volume() is defined (0 for an ideal gas, -p_inf for a stiffened gas) */
    double (*pressure_floor)(const void *par);
    /* smallest admissible internal energy at rho (J/kg); below it the step is rejected */
    double (*energy_floor)(const void *par, double rho);
    /* density (kg/m3) at which the law ends: at it and beyond c2 and energy_floor() are NAN. NULL: it holds at any */
    double (*density_limit)(const void *par);
    /* what is wrong with parameters that each are in range, as the end of a sentence; NULL if nothing. NULL: nothing
     * can be */
    const char *(*check)(const void *par);
} eos_model;

/* All of them, made by the build from the file names. */
extern const eos_model *const eos_registry[];
extern const size_t eos_registry_size;
/* NULL if there is none of that name. */
const eos_model *eos_find(const char *name);

/* An equation of state with its parameters. */
typedef struct eos {
    const eos_model *model;
    void *par; /* model->param_size bytes, owned by the scene's material */
} eos;

/* Whether it bears tension. False where there is no law. */
static inline bool eos_is_liquid(const eos *law)
{
    return law->model && law->model->pressure_floor(law->par) < 0.0;
}

/* kg/m3, of a pressure (Pa) above the law's floor and a temperature (K). */
static inline double eos_density(const eos *law, double p, double T)
{
    double v, dvdp;
    law->model->volume(law->par, 1, &p, &T, &v, &dvdp);
    return 1.0 / v;
}

#endif
