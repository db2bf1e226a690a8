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

static double source(const fan_gas *gas, const point *p)
{
    return p->u == 0.0 ? 0.0 : gas->geometry * p->c * p->u / p->r;
}

/* The crossing of the outward characteristic through p with the inward one through q; at an infinite time where it comes later
 * than `latest`, if at all: in a cylinder or sphere an outward characteristic does not reach the edge. */
static point cross(const fan_gas *gas, const point *p, const point *q, double latest)
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
        const double plus = p->u + k * p->c - 0.5 * (source(gas, p) + source(gas, &last)) * (x.t - p->t);
        const double minus = q->u - k * q->c + 0.5 * (source(gas, q) + source(gas, &last)) * (x.t - q->t);
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
            row[j] =
                i == 0 ? plane_fan(gas, log_start, spacing * j) : cross(gas, &row[j - 1], &row[j], LATEST * out->limit);
        }
        for (int j = 0; j <= FAN_NODES && i % fine == 0; j++) {
            const point *x = &row[j * fine];
            out->node[i / fine][j] = (fan_node){log(x->t), x->r, x->u, log(x->c)};
        }
    }
    memory_free(ctx, &row);
    return FLOE_OK;
}

/* From errors in the second and fourth power of the spacing, on nets of 1, 1/2 and 1/4 of it. */
static double extrapolate(double coarse, double middle, double fine)
{
    return (64.0 * fine - 20.0 * middle + coarse) / 45.0;
}

static fan_node extrapolate_node(const fan_node *a, const fan_node *b, const fan_node *c)
{
    if (isinf(a->log_time) || isinf(b->log_time) || isinf(c->log_time)) return (fan_node){.log_time = INFINITY};
    return (fan_node){extrapolate(a->log_time, b->log_time, c->log_time), extrapolate(a->radius, b->radius, c->radius),
                      extrapolate(a->velocity, b->velocity, c->velocity),
                      extrapolate(a->log_sound, b->log_sound, c->log_sound)};
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
            out->node[i][j] = extrapolate_node(&net[0].node[i][j], &net[1].node[i][j], &out->node[i][j]);
        }
    }
    memory_free(ctx, &net);
    return status;
}

enum { STENCIL = 8 };

/* Weights of Lagrange's polynomial through STENCIL places. */
static void lagrange(const double at[STENCIL], double x, double weight[STENCIL])
{
    for (int i = 0; i < STENCIL; i++) {
        weight[i] = 1.0;
        for (int k = 0; k < STENCIL; k++) {
            if (k != i) weight[i] *= (x - at[k]) / (at[i] - at[k]);
        }
    }
}

static int clamp(int i, int lo, int hi)
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
        if (fan->node[middle][j].log_time <= log_time) {
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
    return next == 0 || (next >= STENCIL - 2 && next <= FAN_NODES && isfinite(fan->node[next][j].log_time));
}

/* The inward characteristic j at a time: by interpolation along it, before its first node by the plane fan. */
static fan_node on_inward(const radial_fan *fan, int j, double log_time)
{
    const int before = node_before(fan, j, log_time);
    if (before < 0) {
        fan_node first = fan->node[0][j];
        first.radius = fan->gas.radius + (first.velocity - exp(first.log_sound)) * exp(log_time);
        return first;
    }
    int known = before + 1;
    while (known <= FAN_NODES && known <= before + STENCIL / 2 && isfinite(fan->node[known][j].log_time)) known++;
    const int from = clamp(before - STENCIL / 2 + 1, 0, known - STENCIL);
    double at[STENCIL], weight[STENCIL];
    for (int i = 0; i < STENCIL; i++) at[i] = fan->node[from + i][j].log_time;
    lagrange(at, log_time, weight);
    fan_node x = {log_time, 0.0, 0.0, 0.0};
    for (int i = 0; i < STENCIL; i++) {
        const fan_node *node = &fan->node[from + i][j];
        x.radius += weight[i] * node->radius;
        x.velocity += weight[i] * node->velocity;
        x.log_sound += weight[i] * node->log_sound;
    }
    return x;
}

/* The outermost inward characteristic that is known at a time. */
static int outermost(const radial_fan *fan, double log_time)
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

/* Among the characteristics from `from` on, at the label (a number between theirs) whose radius is r: by the secant rule on
 * the polynomial in the label, which is nearly straight over one interval. */
static fan_state between(const fan_node node[STENCIL], int interval, double r)
{
    double at[STENCIL], weight[STENCIL];
    for (int k = 0; k < STENCIL; k++) at[k] = k;
    double lo = interval;
    double hi = interval + 1;
    for (int n = 0; n < 60 && hi - lo > 1e-15 * STENCIL; n++) {
        const double label = 0.5 * (lo + hi);
        double radius = 0.0;
        lagrange(at, label, weight);
        for (int k = 0; k < STENCIL; k++) radius += weight[k] * node[k].radius;
        if (radius <= r) {
            lo = label;
        } else {
            hi = label;
        }
    }
    lagrange(at, 0.5 * (lo + hi), weight);
    fan_node x = {0.0, 0.0, 0.0, 0.0};
    for (int k = 0; k < STENCIL; k++) {
        x.velocity += weight[k] * node[k].velocity;
        x.log_sound += weight[k] * node[k].log_sound;
    }
    return (fan_state){x.velocity, exp(x.log_sound)};
}

static fan_state in_fan(const radial_fan *fan, double r, double t)
{
    const double log_time = log(t);
    int lo = 0;
    int hi = outermost(fan, log_time);
    const int most = hi;
    const fan_node last = on_inward(fan, most, log_time);
    if (r >= last.radius) { /* a density of nearly nothing: straight to the edge */
        const double edge = fan->gas.radius + fan_front_speed(&fan->gas) * t;
        const double share = (r - last.radius) / (edge - last.radius);
        return (fan_state){last.velocity + share * (fan_front_speed(&fan->gas) - last.velocity),
                           (1.0 - share) * exp(last.log_sound)};
    }
    while (hi - lo > 1) {
        const int middle = (lo + hi) / 2;
        if (on_inward(fan, middle, log_time).radius <= r) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    const int from = clamp(lo - STENCIL / 2 + 1, 0, most + 1 - STENCIL);
    fan_node node[STENCIL];
    for (int k = 0; k < STENCIL; k++) node[k] = on_inward(fan, from + k, log_time);
    return between(node, lo - from, r);
}

fan_state radial_fan_at(const radial_fan *fan, double r, double t)
{
    const fan_gas *gas = &fan->gas;
    if (!(t >= 0.0 && t <= fan->limit)) return (fan_state){NAN, NAN};
    if (r <= gas->radius - gas->sound * t) return (fan_state){0.0, gas->sound};
    if (r >= gas->radius + fan_front_speed(gas) * t) return (fan_state){fan_front_speed(gas), 0.0};
    return in_fan(fan, r, t);
}
