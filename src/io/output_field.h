/* Which fields a simulation has for others to read, and under which names: of cells and points those of snapshots. */
#ifndef IO_OUTPUT_FIELD_H
#define IO_OUTPUT_FIELD_H

#include "io/names.h"

/* A field under its name. Texts are valid during the visit alone. */
typedef struct output_field {
    const char *name;           /* "density_gas", "stress_xx", "velocity" */
    const char *unit, *meaning; /* the unit in SI, whatever the scene's */
    field_id id;
    int instance, comp; /* the first array */
    int components;     /* arrays: 1, or of a vector the scene's dimension */
    double scale;       /* from what is stored to what is written: extent of the scene for masses and volumes, else 1 */
} output_field;

typedef floe_status output_field_visitor(void *user, const output_field *field);

/* Visits the fields of the cells: state, and what users ask for. */
floe_status output_fields_of_cells(const sim *s, output_field_visitor *visit, void *user);
/* Those of the points of a body, id and position among them. */
floe_status output_fields_of_points(const sim *s, int body, output_field_visitor *visit, void *user);
/* Those of the nodes, as the last step left them; "_1", "_2" ... after the names of other velocity groups than the
 * first. Snapshots do not have them. */
floe_status output_fields_of_nodes(const sim *s, output_field_visitor *visit, void *user);

#endif
