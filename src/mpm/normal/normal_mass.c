#include "mpm/normal/normal.h"

extern const normal_model normal_mass;

static normal_weights mass_weights(const basis_model *basis, double xi, double half, double inv_h)
{
    normal_weights r = {.n = basis->support};
    r.first = basis->weights(xi, half, inv_h, r.w, r.dw);
    return r;
}

const normal_model normal_mass = {
    .name = "mass",
    .doc = "gradient of the body's mass by the basis of the method, divided by its density",
    .cite = "Bardenhagen, Brackbill, Sulsky 2000",
    .reach = 1,
    .weights = mass_weights,
};
