#include "material/membrane.h"

#include <math.h>
#include <string.h>

const membrane_model *membrane_find(const char *name)
{
    for (size_t i = 0; i < membrane_registry_size; i++) {
        if (strcmp(membrane_registry[i]->name, name) == 0) return membrane_registry[i];
    }
    return NULL;
}

/* Stress along a direction stretched by `strain` with none across it: what a wrinkled or free membrane bears. */
static double uniaxial_stress(const membrane_response *r, double strain)
{
    const double across = r->model->free_across(r->par, strain);
    double stress, none;
    r->model->stress(r->par, 1, &strain, &across, &stress, &none);
    return stress;
}

/* Taut in both directions, wrinkled along one, or slack (tension field; York's one-way law where there is one
 * direction). */
static void relax_stress(const membrane_response *r, double along, double across, double *stress_along,
                         double *stress_across)
{
    if (*stress_along >= 0.0 && *stress_across >= 0.0) return;
    const bool pulled_along = along > 0.0 && *stress_across < 0.0;
    const bool pulled_across = !pulled_along && across > 0.0 && *stress_along < 0.0;
    *stress_along = pulled_along ? fmax(uniaxial_stress(r, along), 0.0) : 0.0;
    double stress = 0.0, none;
    if (pulled_across) { /* the same with the directions exchanged */
        const double free_along = r->model->free_across(r->par, across);
        r->model->stress(r->par, 1, &free_along, &across, &none, &stress);
    }
    *stress_across = fmax(stress, 0.0);
}

void membrane_stress(const membrane_response *r, size_t n, const double *along, const double *across,
                     double *stress_along, double *stress_across)
{
    if (!r->free_across) {
        r->model->stress(r->par, n, along, across, stress_along, stress_across);
        for (size_t i = 0; r->one_way && i < n; i++)
            relax_stress(r, along[i], across[i], &stress_along[i], &stress_across[i]);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        stress_across[i] = 0.0;
        stress_along[i] = r->one_way && along[i] <= 0.0 ? 0.0 : uniaxial_stress(r, along[i]);
    }
}

double membrane_volume_ratio(membrane_section section, double along, double across)
{
    return section == SECTION_THICKNESS ? exp(along + across) : 1.0;
}

/* Gauss's rule of five points on the way from zero; laws are smooth on it. */
double membrane_energy(const membrane_response *r, double along, double across)
{
    static const double at[5] = {0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155,
                                 0.95308992296933200};
    static const double weight[5] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324,
                                     0.11846344252809454};
    double sum = 0.0;
    for (int k = 0; k < 5; k++) {
        const double e1 = at[k] * along, e2 = at[k] * across;
        double s1, s2;
        membrane_stress(r, 1, &e1, &e2, &s1, &s2);
        sum += weight[k] * membrane_volume_ratio(r->section, e1, e2) * (s1 * along + s2 * across);
    }
    return sum;
}
