/* The isentropic expansion or compression of a fluid in a mixed cell, from its state (v_0, e_0) at p_0 = p(v_0, e_0):
 *     (p - floor) v^G = (p_0 - floor) v_0^G,    G = rho c^2/(p_0 - floor), floor the law's least pressure,
 * which has the isentrope's slope at that state, and is the isentrope itself for ideal and stiffened gas, Tait's law
 * and the acoustic liquid. */
#ifndef COUPLING_ISENTROPE_H
#define COUPLING_ISENTROPE_H

#include "material/eos.h"

#include <stdbool.h>

typedef struct isentrope {
    double v, e;     /* m3/kg, J/kg: the state it goes through */
    double p;        /* Pa, there */
    double floor;    /* Pa */
    double exponent; /* G > 0; 0: there is none through that state */
} isentrope;

/* False, and an exponent of 0, where the law has no pressure over its floor or no sound speed at (v, e). */
bool isentrope_through(const eos *law, double v, double e, isentrope *out);
/* The same of n <= ISENTROPES_MOST states at once. */
enum { ISENTROPES_MOST = 64 };
void isentropes_through(const eos *law, int n, const double *v, const double *e, isentrope *out);
/* v at p > floor, and dv/dp < 0. */
double isentrope_volume(const isentrope *s, double p, double *dvdp);
/* e at v: e_0 - int p dv. */
double isentrope_energy(const isentrope *s, double v);

#endif
