/* The exact Riemann problem between two Noble-Abel stiffened gases, p + gamma p_inf = (gamma - 1) e/(v - b), each with
 * its own gamma, p_inf and b (both 0: an ideal gas), vacuum included. Toro, Riemann Solvers, 3rd ed. (2009), chapter 4,
 * with p replaced by p + p_inf (Ivings, Causon & Toro 1998) and v by v - b in the relations across a wave: these hold
 * differences of v alone. A covolume only stretches the positions of waves, by v/(v - b). */
#ifndef VERIFY_RIEMANN_H
#define VERIFY_RIEMANN_H

#include "base/context.h"

#include <stdbool.h>

typedef struct riemann_side {
    double density;  /* kg/m3, >= 0; 0: vacuum */
    double velocity; /* m/s, along the axis */
    double pressure; /* Pa, > -p_inf (ignored for a vacuum) */
    double gamma;    /* > 1 */
    double p_inf;    /* Pa, >= 0 */
    double covolume; /* m3/kg, b, 0 <= b < 1/density */
} riemann_side;

/* The wave on one side of the contact. Speeds are signed, along the axis. */
typedef struct riemann_wave {
    bool shock;
    double density;  /* kg/m3: the star state's, next to the contact (0 in a vacuum) */
    double velocity; /* m/s: the star state's; the front's, where a vacuum opens */
    double head;     /* m/s: the shock's speed, or the fan's outer edge */
    double tail;     /* m/s: the shock's speed again, or the fan's inner edge */
} riemann_wave;

typedef struct riemann_solution {
    riemann_side left, right;
    bool vacuum;     /* between or beside the two gases */
    double pressure; /* Pa: between the waves */
    double contact;  /* m/s: the contact's speed; the middle of a vacuum */
    riemann_wave left_wave, right_wave;
} riemann_solution;

typedef struct riemann_state {
    double density, velocity, pressure;
    bool left_gas; /* the material that comes from the left */
    bool empty;    /* vacuum: density 0 */
} riemann_state;

/* Solves to round-off. Errors: FLOE_BAD_INPUT for states that are no gas (both sides vacuum included). */
floe_status riemann_solve(context *ctx, const riemann_side *left, const riemann_side *right, riemann_solution *out);
/* The state on the ray x/t = speed (m/s); on a discontinuity, the state to its left. */
riemann_state riemann_sample(const riemann_solution *solution, double speed);

#endif
