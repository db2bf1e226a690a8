/* Names, units and factors of what is written, the same in every output. */
#ifndef IO_NAMES_H
#define IO_NAMES_H

#include "sim/sim.h"

enum { NAME_SIZE = 160 }; /* characters of a dataset's or column's name */

/* What turns floe's inner volumes, masses, forces and energies into those of outputs: thickness in 2-D, 2 pi when
 * axisymmetric, else 1 (design, conventions). */
double output_scale(const sim *s);
/* The unit to be written: "1" where the scene is dimensionless. */
const char *output_unit(const sim *s, const char *unit);

/* Names of bodies, materials and probes as part of dataset and column names: what is not a letter, a digit, '_', '-' or
 * '.' becomes '_'; where two become the same, the later one carries its number. */
void body_label(const sim *s, int body, char label[NAME_SIZE]);
void material_label(const sim *s, int material, char label[NAME_SIZE]);
void probe_label(const sim *s, int probe, char label[NAME_SIZE]);
void tracer_label(const sim *s, int tracer, char label[NAME_SIZE]);

/* "xx", "yy", ... of a component of a stress or a deformation gradient; "rr", "zz", "tt", ... when axisymmetric. */
const char *component_name(const sim *s, field_components components, int comp);

/* A unit without '/', for viewers that take it for a folder: "kg/m3" becomes "kg m-3". */
void unit_without_slash(const char *unit, char plain[NAME_SIZE]);

#endif
