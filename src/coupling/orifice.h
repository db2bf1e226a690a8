/* Gas that passes through an orifice between two volumes (theory 2.19). */
#ifndef COUPLING_ORIFICE_H
#define COUPLING_ORIFICE_H

#include <stdbool.h>

/* The ideal gas on one side: all of it has one pressure and one temperature. */
typedef struct orifice_side {
    double gamma;        /* ratio of specific heats */
    double mass, energy; /* kg, J: internal */
    double volume;       /* m3 */
    bool endless;        /* nothing changes its state */
} orifice_side;

/* What has passed in one direction. */
typedef struct orifice_flow {
    double mass, enthalpy; /* kg, J: of the gas that leaves */
} orifice_flow;

/* Surroundings of a pressure (Pa) in which p v = `work` (J/kg). */
orifice_side orifice_surroundings(double gamma, double pressure, double work);
double orifice_pressure(const orifice_side *side);
/* Mass per time and area (kg/s/m2) of an ideal nozzle from gas at rest at a pressure, in which p v = `work`, into a
 * lower pressure. */
double orifice_mass_flux(double gamma, double pressure, double work, double behind);
/* What passes in `dt` (s) through `area` (m2, times the coefficient of discharge) from side 0 (out[0]) and from side 1
 * (out[1], nothing where one_way). */
void orifice_pass(const orifice_side side[2], double area, bool one_way, double dt, orifice_flow out[2]);

#endif
