#include "coupling/hugoniot.h"

#include <math.h>

enum { MOST_STEPS = 60 };
#define CLOSE 1e-9 /* of the pressure's rise */

/* Newton's method in v from the solution of ideal and stiffened gas; halves the bracket where a step would leave it, or the law ends. */
bool hugoniot_state(const eos *law, double v0, double e0, double p0, double p1, double *v, double *e)
{
    const double floor = law->model->pressure_floor(law->par), rise = p1 - p0;
    double rho = 1.0 / v0, p, c2, push, lo = 0.0, hi = v0;
    law->model->pressure(law->par, 1, &rho, &e0, &p, &c2);
    const double stiff = rho * c2, G = stiff / (p0 - floor);
    double x = v0 * (1.0 - rise / (stiff + 0.5 * (G + 1.0) * rise));
    for (int n = 0; n < MOST_STEPS; ++n) {
        if (!(x > lo && x < hi)) x = 0.5 * (lo + hi);
        const double energy = e0 + 0.5 * (p1 + p0) * (v0 - x);
        rho = 1.0 / x;
        law->model->pressure(law->par, 1, &rho, &energy, &p, &c2);
        law->model->dpde(law->par, 1, &rho, &energy, &push);
        const bool defined = isfinite(p) && c2 > 0.0;
        if (defined && fabs(p - p1) <= CLOSE * rise) {
            *v = x;
            *e = energy;
            return true;
        }
        if (defined && p < p1)
            hi = x;
        else
            lo = x;
        /* dp/dv along the curve: -rho^2 (c^2 - p_e p/rho^2) - p_e (p1 + p0)/2 */
        const double slope = -rho * rho * c2 + push * (p - 0.5 * (p1 + p0));
        x = defined && slope < 0.0 ? x - (p - p1) / slope : hi;
    }
    return false;
}
