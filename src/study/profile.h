/* Profiles of several runs beside their exact solution: profile.csv of each as one figure. */
#ifndef STUDY_PROFILE_H
#define STUDY_PROFILE_H

#include "plot/plot.h"

typedef struct profile_source {
    const char *name;
    int colour;      /* of the palette */
    double h;        /* m */
    char path[4096]; /* of a run's profile.csv; it need not be there */
} profile_source;

/* Writes DIR/profiles.csv, the rows of all sources with their names and h before them, and the data of a figure, DIR/profile.csv and
 * .json: a panel for every quantity that has an exact value. Nothing is done when no source is there, or none has such a
 * quantity. `exact` names the exact solution; `names` as in curves_write. */
floe_status profile_write(context *ctx, const char *dir, const char *exact, const profile_source *source, size_t n,
                          bool dimensionless, plot_names *names);

#endif
