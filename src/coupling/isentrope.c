#include "coupling/isentrope.h"

#include <math.h>

bool isentrope_through(const eos *law, double v, double e, isentrope *out)
{
    const double rho = 1.0 / v;
    double c2;
    *out = (isentrope){.v = v, .e = e, .floor = law->model->pressure_floor(law->par)};
    law->model->pressure(law->par, 1, &rho, &e, &out->p, &c2);
    out->exponent = rho * c2 / (out->p - out->floor);
    const bool good = v > 0.0 && out->p > out->floor && out->exponent > 0.0 && isfinite(out->exponent);
    if (!good) out->exponent = 0.0;
    return good;
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
