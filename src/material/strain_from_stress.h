/* The deformation at which a law that keeps F has a given stress: what a body starts with whose stress is known. */
#ifndef MATERIAL_STRAIN_FROM_STRESS_H
#define MATERIAL_STRAIN_FROM_STRESS_H

#include "material/solid.h"

/* F without rotation. False where the law has no such state, or it is too far from rest to be found. Stress: xx yy zz xy yz zx, Pa. */
bool strain_from_stress(const solid_model *law, const void *par, const double stress[6], double F[9]);

#endif
