#include "verify/verify_internal.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

floe_status check_whole(context *ctx, const char *key, double x)
{
    if (x == floor(x)) return FLOE_OK;
    return fail_key(ctx, KEY(key), "%g: must be a whole number", x);
}

floe_status check_axis(context *ctx, double axis, int dim)
{
    TRY(check_whole(ctx, "axis", axis));
    if (axis >= 0.0 && axis < dim) return FLOE_OK;
    return fail_key(ctx, KEY("axis"), "%g: must be 0 to %d, the scene has dimension %d", axis, dim - 1, dim);
}

floe_status simple_wave_check(context *ctx, const char *key, double velocity, double sound, double gamma)
{
    if (sound > 0.5 * (gamma - 1.0) * fabs(velocity)) return FLOE_OK;
    return fail_key(ctx, KEY(key), "%g m/s: must be below 2 c/(gamma - 1) = %g m/s, or a vacuum opens", velocity,
                    2.0 * sound / (gamma - 1.0));
}

double hot_walls_value(const hot_walls *w, exact_quantity quantity, double s)
{
    const double T = w->first + (w->second - w->first) * s + w->heating * s * (1.0 - s);
    switch (quantity) {
    case EXACT_PRESSURE: return w->pressure;
    case EXACT_DENSITY: return w->pressure / ((w->gamma - 1.0) * w->heat_capacity * T);
    case EXACT_INTERNAL_ENERGY: return w->heat_capacity * T;
    case EXACT_TEMPERATURE: return T;
    default: return NAN;
    }
}

/* A function that GSL never sees fail: a value that is not finite is noted and taken for a root, which ends the search.
 * GSL's own answer to it would be its error handler, which ends the process unless floe_init has switched it off. */
typedef struct guarded {
    root_function *f;
    void *user;
    bool failed;
} guarded;

static double guarded_value(double x, void *user)
{
    guarded *g = user;
    const double value = g->f(x, g->user);
    if (isfinite(value)) return value;
    g->failed = true;
    return 0.0;
}

double find_root(root_function *f, void *user, double lo, double hi)
{
    const double at_lo = f(lo, user);
    const double at_hi = f(hi, user);
    if (at_lo == 0.0) return lo;
    if (at_hi == 0.0) return hi;
    if (!(isfinite(at_lo) && isfinite(at_hi)) || !(lo < hi) || (at_lo > 0.0) == (at_hi > 0.0)) return NAN;

    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    if (solver == NULL) return NAN;
    guarded guard = {f, user, false};
    gsl_function function = {.function = guarded_value, .params = &guard};
    int status = gsl_root_fsolver_set(solver, &function, lo, hi);
    for (int i = 0; i < 500 && status == GSL_SUCCESS && !guard.failed; i++) {
        /* Brent's interval collapses onto the root once it is known to a few units of round-off. */
        if (gsl_root_fsolver_x_lower(solver) == gsl_root_fsolver_x_upper(solver)) break;
        status = gsl_root_fsolver_iterate(solver);
    }
    const bool found = status == GSL_SUCCESS && !guard.failed;
    const double root = found ? gsl_root_fsolver_root(solver) : (double)NAN;
    gsl_root_fsolver_free(solver);
    return root;
}

enum { IMAGES = 2 }; /* with width <= period/4 the first one left out is 10 standard deviations away: 2e-22 */

double profile_value(const profile *f, double x)
{
    if (f->sine) return sin(2.0 * VERIFY_PI * (x - f->centre) / f->width);
    double distance = x - f->centre;
    if (!(f->period > 0.0)) return exp(-0.5 * distance * distance / (f->width * f->width));
    distance -= f->period * round(distance / f->period);
    double sum = 0.0;
    for (int image = -IMAGES; image <= IMAGES; image++) {
        const double s = (distance + image * f->period) / f->width;
        sum += exp(-0.5 * s * s);
    }
    return sum;
}

double profile_largest_slope(const profile *f)
{
    return f->sine ? 2.0 * VERIFY_PI / f->width : exp(-0.5) / f->width;
}

floe_status profile_check(context *ctx, const profile *f)
{
    if (!(f->period > 0.0)) return FLOE_OK;
    if (f->sine) {
        const double waves = f->period / f->width;
        if (fabs(waves - round(waves)) <= 1e-9 * waves) return FLOE_OK;
        return fail_key(ctx, KEY("period"), "%g m holds %g wavelengths of width = %g m: must be a whole number",
                        f->period, waves, f->width);
    }
    if (f->width <= 0.25 * f->period) return FLOE_OK;
    return fail_key(ctx, KEY("width"), "%g m: a Gaussian on a period of %g m must be at most a quarter of it wide",
                    f->width, f->period);
}
