/* What laws of metals share: the return along the deviator, failure, and a Mie-Grueneisen pressure in place of the
 * linear one (theory 1.4). Only src/material includes this. */
#ifndef MATERIAL_METAL_H
#define MATERIAL_METAL_H

#include "material/elastic_moduli.h"
#include "material/hypoelastic.h"

#include <math.h>

/* The first member of such a law's parameters. */
typedef struct metal_par {
    elastic_moduli elastic;
    double shock_slope, grueneisen; /* s and Gamma of the Mie-Grueneisen pressure; 0: the pressure is linear */
} metal_par;

/* Its rows in the table of parameters, beside ELASTIC_MODULI. */
#define METAL_PRESSURE                                                                                                 \
    PAR_NONNEGATIVE(metal_par, shock_slope, "1", 0.0,                                                                  \
                    "s of u_shock = c_0 + s u, c_0^2 = K/density: Mie-Grueneisen pressure (copper: 1.489); 0: "        \
                    "pressure linear in the volume strain"),                                                           \
        PAR_NONNEGATIVE(metal_par, grueneisen, "1", 0.0,                                                               \
                        "Grueneisen coefficient, with shock_slope and less than twice it (copper: 1.99); 0: pressure " \
                        "linear in the volume strain")

/* The first history variables of such a law. */
enum { PLASTIC_STRAIN, FAILED, OPENING, METAL_HISTORY };

#define METAL_HISTORY_ROWS                                                   \
    [PLASTIC_STRAIN] = {"plastic_strain", "1", "equivalent plastic strain"}, \
    [FAILED] = {"failed", "1", "1 where the point has failed, else 0"},      \
    [OPENING] = {"opening", "1", "volume strain of what has opened since failure"}

/* The mean stress of point i as the batch has it. */
FLOE_ALWAYS_INLINE double mean_stress_at(const solid_batch *b, size_t i)
{
    return (b->stress[XX][i] + b->stress[YY][i] + b->stress[ZZ][i]) / 3.0;
}

/* A failed point: pressure, once the opening has closed. K opening is the tension that there would be without it. */
FLOE_ALWAYS_INLINE void bear_pressure_alone(double K, double s[6], double *opening)
{
    const double tension = mean_stress(s) + K * *opening;
    *opening = tension > 0.0 ? tension / K : 0.0;
    s[XX] = s[YY] = s[ZZ] = tension > 0.0 ? 0.0 : tension;
    s[XY] = s[YZ] = s[ZX] = 0.0;
}

/* Marks point i as failed; the strain energy (J per initial volume) that is lost by it. */
double metal_fail(const metal_par *a, solid_batch *b, size_t i);
/* With a Mie-Grueneisen pressure, after everything else has been added to `energy`: sets the mean stress at the end of
 * the step, and adds its work to `energy`. `before`: mean stresses at the start. Returns as solid_model.stress. */
size_t metal_shock_pressure(const metal_par *a, solid_batch *b, const double *before);

/* Entries of solid_model; par begins with a metal_par. */
void metal_wave_speed(const void *par, double p_ref, const solid_batch *b, double *c);
void metal_strain_energy(const void *par, const solid_batch *b, double *psi);
unsigned metal_depends(const void *par);
const char *metal_check(const void *par);

#endif
