/* Laws of membranes and strings: one layer of points, with stress along its curve and, where the scene has a second
 * direction in the surface, across it (York 1997, chapter 5). One file adds one: membrane_<name>.c ends in a const
 * descriptor `membrane_<name>`; the conformance battery covers it (energy, wave speed, one-way response).
 *
 * A law sees the total logarithmic strains in the local frame (section 5.4.2) and answers with the stresses there. */
#ifndef MATERIAL_MEMBRANE_H
#define MATERIAL_MEMBRANE_H

#include "base/param.h"

typedef struct membrane_model {
    const char *name, *doc, *cite;
    size_t param_size;
    const param_spec *params;
    size_t n_params;
    bool isotropic; /* isotropic in the surface, as a surface in three dimensions requires (sheet.h) */
    /* Cauchy stresses (Pa) of n points from their strains along the line and across it. */
    void (*stress)(const void *par, size_t n, const double *along, const double *across, double *stress_along,
                   double *stress_across);
    /* The strain across a line stretched by `along` at which the stress across vanishes. */
    double (*free_across)(const void *par, double along);
    /* Largest slope of the stresses against strain (Pa) at a stretch of one, for the time step: along a single strain,
     * or for two. */
    double (*modulus)(const void *par, bool biaxial);
} membrane_model;

extern const membrane_model *const membrane_registry[];
extern const size_t membrane_registry_size;
/* NULL if there is none of that name. */
const membrane_model *membrane_find(const char *name);

/* What becomes of the section as the membrane is stretched: its thickness stays (the volume grows as the area), or its
 * volume. */
typedef enum membrane_section { SECTION_THICKNESS, SECTION_VOLUME } membrane_section;

/* A law as a body has it. */
typedef struct membrane_response {
    const membrane_model *model;
    const void *par;
    bool one_way;     /* wrinkles instead of bearing compression: York 1997, section 5.2 */
    bool free_across; /* no stress across: strings in space, scenes of plane stress */
    bool biaxial;     /* strain across may change */
    membrane_section section;
} membrane_response;

/* Stresses of n points. Where the law is one-way no stress is compressive: negative strain is slack, which must be
 * taken up before there is tension again; stretched along one direction and slack along the other, the membrane bears
 * uniaxial tension (tension field). */
void membrane_stress(const membrane_response *r, size_t n, const double *along, const double *across,
                     double *stress_along, double *stress_across);
/* Present volume over that at rest: of the section's rule. */
double membrane_volume_ratio(membrane_section section, double along, double across);
/* Strain energy (J/m3 of the volume at rest) along a straight path from zero strain to these strains: exact with one
 * strain alone, and for `SECTION_VOLUME`; for two strains and constant thickness no potential exists, and the energy
 * depends on the path. */
double membrane_energy(const membrane_response *r, double along, double across);

#endif
