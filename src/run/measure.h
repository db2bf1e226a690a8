/* Errors of a run against its exact solution (docs/outputs.md): nothing smoothed, no point or cell excluded inside the
 * region. */
#ifndef RUN_MEASURE_H
#define RUN_MEASURE_H

#include "io/csv.h"
#include "io/summary.h"
#include "run/samples.h"

/* Adds the scene's metrics, measured on the present state, to the summary's errors; `solution` may be empty. Points are
 * compared with point values, weighted by their volume; cells with exact averages over the cell, weighted by the volume
 * that the material has in it. With verify.pressure also `rel_gas_pressure`, |p - p_ref - P| / P of the fluid that a
 * load pressurises. */
floe_status measure_errors(sim *s, const exact *solution, run_summary *r);

/* Refuses columns of verify.history that the history of `s` does not have. Errors: FLOE_BAD_INPUT with the names that
 * it has. */
floe_status measure_history_check(const sim *s);
/* Adds the scene's metrics of histories, measured on all rows of the history at `path`, to the summary's errors. */
floe_status measure_history(sim *s, const char *path, run_summary *r);
/* The same, of a history in memory. */
floe_status measure_history_rows(sim *s, const csv_table *rows, run_summary *r);

/* DIR/profile.csv, the run beside its exact solution: in one dimension every quantity of verify.metrics along x; in
 * more, where the solution has a radial stress, the stresses of the row of points nearest the x axis through its
 * centre, in the order of r. Else nothing is done. */
floe_status measure_profile(sim *s, const exact *solution, const char *path);

#endif
