/* A fluid carried by points: an equation of state, a shear and a bulk viscosity.
 *
 * York, Sulsky, Schreyer 2000, section 3.3: density from continuity (rho = rho0/J), stress by their eq. 21 (with a bulk
 * viscosity kappa besides Stokes' hypothesis), and energy by their eq. 23, here centred in time:
 *
 *   e1 - e0 = -[(p0 + p1)/2 + q] (v1 - v0) + dt v_mid [2 mu dev D : dev D + kappa (tr D)^2],  p1 = p(rho1, e1),
 *
 * second order in dt where the paper's eq. 23 is first. One Newton iteration from e0 solves it, exactly where p is
 * linear in e (every gas and liquid here), to fourth order in the change of volume elsewhere. */
#include "material/solid.h"
#include "material/solid_checks.h"

#include <math.h>

static const param_spec fluid_params[] = {
    PAR_NONNEGATIVE(solid_fluid_par, shear_viscosity, "Pa s", 0.0, "shear viscosity mu"),
    PAR_NONNEGATIVE(solid_fluid_par, bulk_viscosity, "Pa s", 0.0,
                    "bulk viscosity kappa = lambda + 2 mu / 3; 0 is Stokes' hypothesis"),
};

/* The viscous stress into b->stress; its power per volume (W/m3) into `heating`. */
static void viscous_stress(const solid_fluid_par *a, solid_batch *restrict b, double *restrict heating)
{
    const double mu = a->shear_viscosity, kappa = a->bulk_viscosity;
    for (size_t i = 0; i < b->n; i++) {
        const double trace = b->L[0][i] + b->L[4][i] + b->L[8][i], third = trace / 3.0;
        const double dx = b->L[0][i] - third, dy = b->L[4][i] - third, dz = b->L[8][i] - third;
        const double xy = 0.5 * (b->L[1][i] + b->L[3][i]), yz = 0.5 * (b->L[5][i] + b->L[7][i]),
                     zx = 0.5 * (b->L[2][i] + b->L[6][i]);
        const double volumetric = kappa * trace;
        heating[i] =
            2.0 * mu * (dx * dx + dy * dy + dz * dz + 2.0 * (xy * xy + yz * yz + zx * zx)) + volumetric * trace;
        b->stress[0][i] = 2.0 * mu * dx + volumetric;
        b->stress[1][i] = 2.0 * mu * dy + volumetric;
        b->stress[2][i] = 2.0 * mu * dz + volumetric;
        b->stress[3][i] = 2.0 * mu * xy;
        b->stress[4][i] = 2.0 * mu * yz;
        b->stress[5][i] = 2.0 * mu * zx;
    }
}

static void point_densities(const solid_batch *b, double *restrict rho_0, double *restrict rho_1)
{
    for (size_t i = 0; i < b->n; i++) {
        rho_0[i] = b->rho0[i] / b->J_old[i];
        rho_1[i] = b->rho0[i] / b->J[i];
    }
}

/* The energy at the end of the step. `heating` is the viscous power per volume. */
static void energy_step(const solid_fluid_par *a, solid_batch *restrict b, const double *restrict rho_1,
                        const double *restrict rho_0, const double *restrict heating)
{
    const eos_model *model = a->eos.model;
    double p_0[SOLID_CHUNK], p_1[SOLID_CHUNK], slope[SOLID_CHUNK], c2[SOLID_CHUNK];
    model->pressure(a->eos.par, b->n, rho_0, b->energy, p_0, c2);
    model->pressure(a->eos.par, b->n, rho_1, b->energy, p_1, c2);
    model->dpde(a->eos.par, b->n, rho_1, b->energy, slope);
    const double half_dt = 0.5 * b->dt;
    for (size_t i = 0; i < b->n; i++) {
        const double expansion = (b->J[i] - b->J_old[i]) / b->rho0[i];
        const double sum = (b->J[i] + b->J_old[i]) / b->rho0[i];
        const double work = (0.5 * (p_0[i] + p_1[i]) + b->q[i]) * expansion;
        b->energy[i] += (half_dt * sum * heating[i] - work) / (1.0 + 0.5 * slope[i] * expansion);
    }
}

/* 0, or 1 + the first point with J, energy or c2 beyond the equation of state. */
static size_t first_beyond(const solid_fluid_par *a, const solid_batch *b, const double *rho, const double *c2)
{
    for (size_t i = 0; i < b->n; i++) {
        const bool fine =
            b->J[i] > 0.0 && c2[i] > 0.0 && b->energy[i] >= a->eos.model->energy_floor(a->eos.par, rho[i]);
        if (FLOE_UNLIKELY(!fine)) return i + 1;
    }
    return 0;
}

static size_t fluid_stress(const void *par, double p_ref, solid_batch *restrict b)
{
    const solid_fluid_par *a = par;
    const size_t inverted = solid_first_inverted(b);
    if (inverted != 0) return inverted;

    double rho_0[SOLID_CHUNK], rho_1[SOLID_CHUNK], heating[SOLID_CHUNK], p[SOLID_CHUNK], c2[SOLID_CHUNK];
    point_densities(b, rho_0, rho_1);
    viscous_stress(a, b, heating);
    energy_step(a, b, rho_1, rho_0, heating);
    a->eos.model->pressure(a->eos.par, b->n, rho_1, b->energy, p, c2);
    for (size_t i = 0; i < b->n; i++) {
        const double gauge = p[i] - p_ref;
        b->stress[0][i] -= gauge;
        b->stress[1][i] -= gauge;
        b->stress[2][i] -= gauge;
    }
    return first_beyond(a, b, rho_1, c2);
}

static void fluid_wave_speed(const void *par, double p_ref, const solid_batch *b, double *restrict c)
{
    const solid_fluid_par *a = par;
    (void)p_ref;
    double rho[SOLID_CHUNK], p[SOLID_CHUNK], c2[SOLID_CHUNK];
    for (size_t i = 0; i < b->n; i++) rho[i] = b->rho0[i] / b->J[i];
    a->eos.model->pressure(a->eos.par, b->n, rho, b->energy, p, c2);
    for (size_t i = 0; i < b->n; i++) c[i] = sqrt(c2[i]);
}

static double fluid_no_modulus(const void *par)
{
    (void)par;
    return 0.0;
}

const solid_model point_fluid = {
    .name = "fluid",
    .doc = "compressible viscous fluid with an equation of state",
    .cite = "A. R. York, D. Sulsky, H. L. Schreyer, Int. J. Numer. Meth. Engng 48 (2000) 901, section 3.3",
    .param_size = sizeof(solid_fluid_par),
    .params = fluid_params,
    .n_params = sizeof fluid_params / sizeof *fluid_params,
    .needs = SOLID_HAS_ENERGY,
    .n_history = 0,
    .stress = fluid_stress,
    .wave_speed = fluid_wave_speed,
    .strain_energy = NULL,
    .bulk_modulus = fluid_no_modulus,
    .shear_modulus = fluid_no_modulus,
};
