#include "material/barotropic.h"

void barotropic_dpde(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                     double *restrict dpde)
{
    (void)par;
    (void)rho;
    (void)e;
    for (size_t i = 0; i < n; i++) dpde[i] = 0.0;
}

void barotropic_heat(const void *par, size_t n, const double *restrict rho, const double *restrict e,
                     double *restrict cv, double *restrict alpha)
{
    const barotropic *a = par;
    (void)rho;
    (void)e;
    for (size_t i = 0; i < n; i++) {
        cv[i] = a->specific_heat;
        alpha[i] = 0.0;
    }
}
