#include "coupling/isentrope.h"

#include <math.h>

/* The isentrope through the state (v, e), where the law gives the pressure p and the squared speed of sound c2; false where that is no state. */
static bool pass_isentrope_through(double floor, double v, double e, double p, double c2, isentrope *out)
{
    *out = (isentrope){.v = v, .e = e, .p = p, .floor = floor, .exponent = 1.0 / v * c2 / (p - floor)};
    const bool good = v > 0.0 && out->p > out->floor && out->exponent > 0.0 && isfinite(out->exponent);
    if (!good) out->exponent = 0.0;
    return good;
}

bool isentrope_through(const eos *law, double v, double e, isentrope *out)
{
    const double rho = 1.0 / v;
    double p, c2;
    law->model->pressure(law->par, 1, &rho, &e, &p, &c2);
    return pass_isentrope_through(law->model->pressure_floor(law->par), v, e, p, c2, out);
}

void isentropes_through(const eos *law, int n, const double *v, const double *e, isentrope *out)
{
    const double floor = law->model->pressure_floor(law->par);
    double rho[ISENTROPES_MOST], p[ISENTROPES_MOST], c2[ISENTROPES_MOST];
    for (int i = 0; i < n; ++i) rho[i] = 1.0 / v[i];
    law->model->pressure(law->par, (size_t)n, rho, e, p, c2);
    for (int i = 0; i < n; ++i) pass_isentrope_through(floor, v[i], e[i], p[i], c2[i], &out[i]);
}

double isentrope_volume(const isentrope *s, double p, double *dvdp)
{
    const double stiff = p - s->floor;
    const double v = s->v * exp(-log1p((p - s->p) / (s->p - s->floor)) / s->exponent);
    *dvdp = -v / (s->exponent * stiff);
    return v;
}

double isentrope_energy(const isentrope *s, double v)
{
    const double L = -log1p((v - s->v) / s->v), rest = s->exponent - 1.0; /* L = ln(v_0/v) */
    const double sum = fabs(rest * L) > 1e-12 ? expm1(rest * L) / rest : L;
    return s->e + (s->p - s->floor) * s->v * sum - s->floor * (v - s->v);
}
