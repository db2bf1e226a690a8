/* The names of error metrics: `eq13`, and a norm with the quantity it is taken of, as `l1_density`. */
#ifndef VERIFY_METRIC_H
#define VERIFY_METRIC_H

#include "verify/exact.h"
#include "verify/norms.h"

/* X(enumerator, name, doc): what a metric computes. `NAME_X` in a deck; eq13 stands alone. */
#define METRIC_LIST(X)                                                                                   \
    X(METRIC_L1, "l1", "sum w |x - x_exact| / sum w, w the volume; in the unit of X")                    \
    X(METRIC_L1REL, "l1rel", "sum w |x - x_exact| / sum w |x_exact|")                                    \
    X(METRIC_L2, "l2", "sqrt(sum w (x - x_exact)^2 / sum w); in the unit of X")                          \
    X(METRIC_L2REL, "l2rel", "sqrt(sum w (x - x_exact)^2 / sum w x_exact^2)")                            \
    X(METRIC_LINF, "linf", "max |x - x_exact|; in the unit of X")                                        \
    X(METRIC_LINFREL, "linfrel", "max |x - x_exact| / max |x_exact|")                                    \
    X(METRIC_EQ13, "eq13",                                                                               \
      "unweighted mean over points of ||sigma_r + sigma_theta| - S| / S, S = 2 P r_i^2/(r_o^2 - r_i^2) " \
      "(Guilkey et al. 2003, eq. 13)")

typedef enum metric_kind {
#define METRIC_ENUM(enumerator, name, doc) enumerator,
    METRIC_LIST(METRIC_ENUM)
#undef METRIC_ENUM
        METRIC_COUNT
} metric_kind;

typedef struct metric {
    metric_kind kind;
    exact_quantity quantity; /* EXACT_QUANTITY_COUNT for eq13 */
} metric;

typedef struct metric_description {
    const char *name; /* "l1_X", "eq13" */
    const char *doc;  /* one line */
} metric_description;

/* For `floe list metrics`; empty strings out of range. The quantities that X may be: exact_quantity_name. Nothing is
 * smoothed and no point is excluded; cells are compared with exact cell averages, points with point values. */
metric_description metric_describe(metric_kind kind);
/* Reads "l1rel_sigma_r". Errors: FLOE_BAD_INPUT with a message that names the choices. */
floe_status metric_parse(context *ctx, const char *name, metric *out);
/* The number that the metric names; NAN for eq13, which is no norm (guilkey_eq13). */
double metric_pick(metric_kind kind, const norm_result *norms);

#endif
