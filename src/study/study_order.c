/* Orders of errors, and limits of quantities, over the axis `over`. */
#include "study/study_internal.h"

#include "verify/order.h"

#include <math.h>

/* Puts a value into its place, coarsest first. */
static void insert_by_spacing(study_order *o, double h, double value)
{
    if (!isfinite(h) || !(h > 0.0) || !isfinite(value) || o->n == SCENE_MAX_AXIS) return;
    size_t at = o->n++;
    for (; at > 0 && o->h[at - 1] < h; at--) {
        o->h[at] = o->h[at - 1];
        o->value[at] = o->value[at - 1];
    }
    o->h[at] = h;
    o->value[at] = value;
}

study_order study_order_of(const study *s, size_t group, const char *metric)
{
    study_order o = {.order = NAN, .standard_error = NAN};
    order_fit fit;
    for (size_t i = 0; i < s->n; i++) {
        const double error = study_error(&s->list[i], metric);
        if (s->list[i].group == group && error > 0.0) insert_by_spacing(&o, s->list[i].over, error);
    }
    for (size_t k = 0; k < SCENE_MAX_AXIS; k++) o.pair[k] = NAN;
    if (s->over < 0) return o;
    /* One spacing, or one case, has no order: that is no failure. */
    if (order_fit_power(NULL, o.n, o.h, o.value, &fit) == FLOE_OK) {
        o.order = fit.order;
        o.standard_error = fit.standard_error;
    }
    (void)order_pairwise(NULL, o.n, o.h, o.value, o.pair);
    return o;
}

bool study_limit_of(const study *s, size_t group, int quantity, study_limit *out)
{
    *out = (study_limit){0};
    for (size_t i = 0; i < s->n; i++) {
        if (s->list[i].group == group) insert_by_spacing(&out->values, s->list[i].over, s->list[i].quantity[quantity]);
    }
    const study_order *v = &out->values;
    if (s->over < 0 || v->n < 3) return false;
    if (richardson_estimate(NULL, v->n, v->h, v->value, NAN, &out->limit) != FLOE_OK) return false;
    if (v->n < 4 || richardson_fit_power(NULL, v->n, v->h, v->value, NAN, &out->fit) != FLOE_OK)
        out->fit = (richardson_fit){0};
    return true;
}
