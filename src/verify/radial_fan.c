#include "verify/radial_fan.h"

#include "base/memory.h"

#include <math.h>

double fan_front_speed(const fan_gas *gas)
{
    return 2.0 * gas->sound / (gas->gamma - 1.0);
}

/* Logarithm of the sound speed at rest over the smallest in the net, where the density has fallen by 1e20. */
static double depth_of(const fan_gas *gas)
{
    return 10.0 * log(10.0) * (gas->gamma - 1.0);
}

static double stretch_exponent(const fan_gas *gas)
{
    return 0.5 * (gas->gamma + 1.0) / (gas->gamma - 1.0);
}

/* A node with what the march needs at hand. */
typedef struct point {
    double t, r, u, c;
} point;

static double geometric_source(const fan_gas *gas, const point *p)
{
    return p->u == 0.0 ? 0.0 : gas->geometry * p->c * p->u / p->r;
}

/* The crossing of the outward characteristic through p with the inward one through q; at an infinite time where it
 * comes later than `latest`, if at all: in a cylinder or sphere an outward characteristic does not reach the edge. */
static point cross_characteristics(const fan_gas *gas, const point *p, const point *q, double latest)
{
    enum { ITERATIONS = 12 };
    const double k = 2.0 / (gas->gamma - 1.0);
    point x = *q;
    if (isinf(p->t) || isinf(q->t)) return (point){.t = INFINITY};
    for (int n = 0; n < ITERATIONS; n++) {
        const double outward = 0.5 * (p->u + p->c + x.u + x.c);
        const double inward = 0.5 * (q->u - q->c + x.u - x.c);
        const point last = x;
        x.t = (q->r - p->r + outward * p->t - inward * q->t) / (outward - inward);
        x.r = p->r + outward * (x.t - p->t);
        const double plus =
            p->u + k * p->c - 0.5 * (geometric_source(gas, p) + geometric_source(gas, &last)) * (x.t - p->t);
        const double minus =
            q->u - k * q->c + 0.5 * (geometric_source(gas, q) + geometric_source(gas, &last)) * (x.t - q->t);
        x.u = 0.5 * (plus + minus);
        x.c = 0.5 * (plus - minus) / k;
        if (!(x.t <= latest && x.c > 0.0)) return (point){.t = INFINITY};
        if (fabs(x.t - last.t) <= 1e-15 * x.t && fabs(x.c - last.c) <= 1e-15 * x.c) break;
    }
    return x;
}

/* The plane fan, with which all begins: node j of the first outward characteristic. */
static point plane_fan(const fan_gas *gas, double log_start, double level)
{
    const double c = gas->sound * exp(-level);
    const double u = 2.0 / (gas->gamma - 1.0) * (gas->sound - c);
    const double t = exp(log_start + stretch_exponent(gas) * level);
    return (point){t, gas->radius + (u - c) * t, u, c};
}

/* Over the limit: nodes a little later than it serve interpolation. */
#define LATEST 4.0

floe_status radial_fan_march(context *ctx, const fan_gas *gas, int halvings, radial_fan *out)
{
    const int fine = 1 << halvings;
    const int n = FAN_NODES * fine;
    const double spacing = depth_of(gas) / n;
    point *row;
    TRY(memory_new(ctx, &row, (size_t)n + 1, sizeof *row));
    out->gas = *gas;
    out->limit = 0.6 * gas->radius / gas->sound;
    const double log_start = log(out->limit) - stretch_exponent(gas) * depth_of(gas);
    for (int i = 0; i <= n; i++) {
        const double head = exp(log_start + stretch_exponent(gas) * spacing * i);
        row[0] = (point){head, gas->radius - gas->sound * head, 0.0, gas->sound};
        for (int j = 1; j <= n; j++) {
            row[j] = i == 0 ? plane_fan(gas, log_start, spacing * j)
                            : cross_characteristics(gas, &row[j - 1], &row[j], LATEST * out->limit);
        }
        for (int j = 0; j <= FAN_NODES && i % fine == 0; j++) {
            const point *x = &row[j * fine];
            out->node[j][i / fine] = (fan_node){log(x->t), x->r, x->u, log(x->c)};
        }
    }
    memory_free(ctx, &row);
    return FLOE_OK;
}

/* From errors in the second and fourth power of the spacing, on nets of 1, 1/2 and 1/4 of it. */
static double extrapolate_nets(double coarse, double middle, double fine)
{
    return (64.0 * fine - 20.0 * middle + coarse) / 45.0;
}

static fan_node extrapolate_node(const fan_node *a, const fan_node *b, const fan_node *c)
{
    if (isinf(a->log_time) || isinf(b->log_time) || isinf(c->log_time)) return (fan_node){.log_time = INFINITY};
    return (fan_node){extrapolate_nets(a->log_time, b->log_time, c->log_time),
                      extrapolate_nets(a->radius, b->radius, c->radius),
                      extrapolate_nets(a->velocity, b->velocity, c->velocity),
                      extrapolate_nets(a->log_sound, b->log_sound, c->log_sound)};
}

floe_status radial_fan_solve(context *ctx, const fan_gas *gas, radial_fan *out)
{
    radial_fan *net;
    TRY(memory_new(ctx, &net, 2, sizeof *net));
    floe_status status = radial_fan_march(ctx, gas, 0, &net[0]);
    if (status == FLOE_OK) status = radial_fan_march(ctx, gas, 1, &net[1]);
    if (status == FLOE_OK) status = radial_fan_march(ctx, gas, 2, out);
    for (int i = 0; i <= FAN_NODES && status == FLOE_OK; i++) {
        for (int j = 0; j <= FAN_NODES; j++) {
            out->node[j][i] = extrapolate_node(&net[0].node[j][i], &net[1].node[j][i], &out->node[j][i]);
        }
    }
    memory_free(ctx, &net);
    return status;
}

enum { STENCIL = 8 };

/* Weights of Lagrange's polynomial through STENCIL places. */
static void lagrange_weights(const double at[STENCIL], double x, double weight[STENCIL])
{
    double before = 1.0;
    for (int i = 0; i < STENCIL; i++) {
        double apart = 1.0;
        for (int k = 0; k < STENCIL; k++) apart *= k == i ? 1.0 : at[i] - at[k];
        weight[i] = before / apart;
        before *= x - at[i];
    }
    double after = 1.0;
    for (int i = STENCIL - 1; i >= 0; i--) {
        weight[i] *= after;
        after *= x - at[i];
    }
}

static int clamp_index(int i, int lo, int hi)
{
    return i < lo ? lo : i > hi ? hi : i;
}

/* The last node of the inward characteristic j that is not later than log_time; -1 if there is none. */
static int node_before(const radial_fan *fan, int j, double log_time)
{
    int lo = -1;
    int hi = FAN_NODES + 1;
    while (hi - lo > 1) {
        const int middle = (lo + hi) / 2;
        if (fan->node[j][middle].log_time <= log_time) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return lo;
}

/* Whether there are enough nodes about that time to interpolate. */
static bool is_known(const radial_fan *fan, int j, double log_time)
{
    const int next = node_before(fan, j, log_time) + 1;
    return next == 0 || (next >= STENCIL - 2 && next <= FAN_NODES && isfinite(fan->node[j][next].log_time));
}

/* The inward characteristic j at a time: by interpolation along it, before its first node by the plane fan. */
static fan_node on_inward(const radial_fan *fan, int j, double log_time)
{
    const int before = node_before(fan, j, log_time);
    if (before < 0) {
        fan_node first = fan->node[j][0];
        first.radius = fan->gas.radius + (first.velocity - exp(first.log_sound)) * exp(log_time);
        return first;
    }
    int known = before + 1;
    while (known <= FAN_NODES && known <= before + STENCIL / 2 && isfinite(fan->node[j][known].log_time)) known++;
    const int from = clamp_index(before - STENCIL / 2 + 1, 0, known - STENCIL);
    double at[STENCIL], weight[STENCIL];
    for (int i = 0; i < STENCIL; i++) at[i] = fan->node[j][from + i].log_time;
    lagrange_weights(at, log_time, weight);
    fan_node x = {log_time, 0.0, 0.0, 0.0};
    for (int i = 0; i < STENCIL; i++) {
        const fan_node *node = &fan->node[j][from + i];
        x.radius += weight[i] * node->radius;
        x.velocity += weight[i] * node->velocity;
        x.log_sound += weight[i] * node->log_sound;
    }
    return x;
}

/* The outermost inward characteristic that is known at a time. */
static int outermost_known(const radial_fan *fan, double log_time)
{
    int lo = 0;
    int hi = FAN_NODES + 1;
    while (hi - lo > 1) {
        const int middle = (lo + hi) / 2;
        if (is_known(fan, middle, log_time)) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return lo;
}

/* Newton's coefficients of the polynomial through value[k] at the numbers k = 0, 1 ...; `value` is overwritten by
 * them. */
static void divide_differences(double value[STENCIL])
{
    for (int order = 1; order < STENCIL; order++) {
        for (int k = STENCIL - 1; k >= order; k--) value[k] = (value[k] - value[k - 1]) / order;
    }
}

/* The polynomial of those coefficients, and its slope where `slope` is not NULL. */
static double evaluate_polynomial(const double coefficient[STENCIL], double x, double *slope)
{
    double value = coefficient[STENCIL - 1], rise = 0.0;
    for (int k = STENCIL - 2; k >= 0; k--) {
        rise = value + (x - k) * rise;
        value = coefficient[k] + (x - k) * value;
    }
    if (slope != NULL) *slope = rise;
    return value;
}

/* Among the characteristics from `from` on, at the label (a number between theirs) whose radius is r: by Newton's rule
 * on the polynomial in the label, which is nearly straight over one interval, within an interval that shrinks about
 * it. */
static fan_state interpolate_fan(const fan_node node[STENCIL], int interval, double r)
{
    double radius[STENCIL], velocity[STENCIL], log_sound[STENCIL];
    for (int k = 0; k < STENCIL; k++) {
        radius[k] = node[k].radius;
        velocity[k] = node[k].velocity;
        log_sound[k] = node[k].log_sound;
    }
    divide_differences(radius);
    divide_differences(velocity);
    divide_differences(log_sound);
    double lo = interval;
    double hi = interval + 1;
    double label = 0.5 * (lo + hi), last = hi;
    for (int n = 0; n < 60 && fabs(label - last) > 1e-15 * STENCIL; n++) {
        double slope;
        const double over = evaluate_polynomial(radius, label, &slope) - r;
        if (over <= 0.0) {
            lo = label;
        } else {
            hi = label;
        }
        last = label;
        label -= over / slope;
        if (!(label >= lo && label <= hi)) label = 0.5 * (lo + hi);
    }
    return (fan_state){evaluate_polynomial(velocity, label, NULL), exp(evaluate_polynomial(log_sound, label, NULL))};
}

/* The last inward characteristic whose radius is not above r, where that of `most` is, `last`: looked for where a
 * straight line between the ends of what is left has r, and in its middle, in turn. */
static int interval_of(const radial_fan *fan, double log_time, double r, int most, double last)
{
    int lo = 0, hi = most;
    double inner = on_inward(fan, lo, log_time).radius, outer = last;
    for (bool straight = true; hi - lo > 1; straight = !straight) {
        const double share = straight ? (r - inner) / (outer - inner) : 0.5;
        const int middle = clamp_index(lo + (int)(share * (hi - lo)), lo + 1, hi - 1);
        const double radius = on_inward(fan, middle, log_time).radius;
        if (radius <= r) {
            lo = middle;
            inner = radius;
        } else {
            hi = middle;
            outer = radius;
        }
    }
    return lo;
}

static fan_state in_fan(const radial_fan *fan, double r, double t)
{
    const double log_time = log(t);
    const int most = outermost_known(fan, log_time);
    const fan_node last = on_inward(fan, most, log_time);
    if (r >= last.radius) { /* a density of nearly nothing: straight to the edge */
        const double edge = fan->gas.radius + fan_front_speed(&fan->gas) * t;
        const double share = (r - last.radius) / (edge - last.radius);
        return (fan_state){last.velocity + share * (fan_front_speed(&fan->gas) - last.velocity),
                           (1.0 - share) * exp(last.log_sound)};
    }
    const int lo = interval_of(fan, log_time, r, most, last.radius);
    const int from = clamp_index(lo - STENCIL / 2 + 1, 0, most + 1 - STENCIL);
    fan_node node[STENCIL];
    for (int k = 0; k < STENCIL; k++) node[k] = on_inward(fan, from + k, log_time);
    return interpolate_fan(node, lo - from, r);
}

fan_state radial_fan_at(const radial_fan *fan, double r, double t)
{
    const fan_gas *gas = &fan->gas;
    if (!(t >= 0.0 && t <= fan->limit)) return (fan_state){NAN, NAN};
    if (r <= gas->radius - gas->sound * t) return (fan_state){0.0, gas->sound};
    if (r >= gas->radius + fan_front_speed(gas) * t) return (fan_state){fan_front_speed(gas), 0.0};
    return in_fan(fan, r, t);
}
