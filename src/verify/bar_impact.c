#include "verify/bar_impact.h"

static double transit_time(const impact_bar *bar)
{
    return 2.0 * bar->length / bar->speed;
}

/* The step in force at t; -1 before the first. */
static int step_at(const bar_impact *b, double t)
{
    int lo = -1;
    int hi = b->n;
    while (hi - lo > 1) {
        const int middle = (lo + hi) / 2;
        if (b->step[middle] <= t) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return lo;
}

/* The wave that leaves the face at t, and its integrals from 0. */
static double out_at(const bar_impact *b, int which, double t)
{
    const int i = step_at(b, t);
    return i < 0 ? 0.5 * b->bar[which].velocity : b->bar[which].wave[i];
}

static double once_at(const bar_impact *b, int which, double t)
{
    const impact_bar *bar = &b->bar[which];
    const int i = step_at(b, t);
    if (i < 0) return 0.5 * bar->velocity * t;
    return bar->once[i] + bar->wave[i] * (t - b->step[i]);
}

static double twice_at(const bar_impact *b, int which, double t)
{
    const impact_bar *bar = &b->bar[which];
    const int i = step_at(b, t);
    if (i < 0) return 0.25 * bar->velocity * t * t;
    const double since = t - b->step[i];
    return bar->twice[i] + bar->once[i] * since + 0.5 * bar->wave[i] * since * since;
}

static double square_at(const bar_impact *b, int which, double t)
{
    const impact_bar *bar = &b->bar[which];
    const int i = step_at(b, t);
    if (i < 0) return 0.25 * bar->velocity * bar->velocity * t;
    return bar->square[i] + bar->wave[i] * bar->wave[i] * (t - b->step[i]);
}

double bar_impact_velocity(const bar_impact *b, int which, double depth, double t)
{
    const impact_bar *bar = &b->bar[which];
    const double back = transit_time(bar) - depth / bar->speed;
    return out_at(b, which, t - depth / bar->speed) + out_at(b, which, t - back);
}

double bar_impact_displacement(const bar_impact *b, int which, double depth, double t)
{
    const impact_bar *bar = &b->bar[which];
    const double delay[2] = {depth / bar->speed, transit_time(bar) - depth / bar->speed};
    double sum = 0.0;
    for (int i = 0; i < 2; i++) sum += once_at(b, which, t - delay[i]) - once_at(b, which, -delay[i]);
    return sum;
}

double bar_impact_force(const bar_impact *b, int which, double depth, double t)
{
    const impact_bar *bar = &b->bar[which];
    const double back = transit_time(bar) - depth / bar->speed;
    const double excess = out_at(b, which, t - depth / bar->speed) - out_at(b, which, t - back);
    return which == 0 ? bar->impedance * excess : -bar->impedance * excess;
}

double bar_impact_mean_velocity(const bar_impact *b, int which, double t)
{
    const double whole_lap = transit_time(&b->bar[which]);
    return 2.0 * (once_at(b, which, t) - once_at(b, which, t - whole_lap)) / whole_lap;
}

double bar_impact_mean_displacement(const bar_impact *b, int which, double t)
{
    const double whole_lap = transit_time(&b->bar[which]);
    const double now = twice_at(b, which, t) - twice_at(b, which, t - whole_lap);
    return 2.0 * (now + twice_at(b, which, -whole_lap)) / whole_lap;
}

double bar_impact_restitution(const bar_impact *b)
{
    const double after = bar_impact_mean_velocity(b, 1, b->release) - bar_impact_mean_velocity(b, 0, b->release);
    return after / (b->bar[0].velocity - b->bar[1].velocity);
}

double bar_impact_energy(const bar_impact *b, int which, double t)
{
    const impact_bar *bar = &b->bar[which];
    return bar->impedance * (square_at(b, which, t) - square_at(b, which, t - transit_time(bar)));
}

/* The faces while the steps are found. */
typedef struct faces {
    bar_impact *b;
    double t, gap;
    double in[2], out[2];
    bool touching;
    int echo[2];  /* the next step whose echo is to come back, of each bar */
    double still; /* m/s: below this a difference is round-off */
} faces;

static void note_step(faces *f)
{
    bar_impact *b = f->b;
    const bool again = b->n > 0 && b->step[b->n - 1] == f->t;
    const int i = again ? b->n - 1 : b->n;
    for (int k = 0; k < 2; k++) {
        impact_bar *bar = &b->bar[k];
        bar->once[i] = i > 0 ? once_at(b, k, f->t) : 0.0;
        bar->twice[i] = i > 0 ? twice_at(b, k, f->t) : 0.0;
        bar->square[i] = i > 0 ? square_at(b, k, f->t) : 0.0;
    }
    for (int k = 0; k < 2; k++) b->bar[k].wave[i] = f->out[k];
    b->step[i] = f->t;
    b->touching[i] = f->touching;
    b->n = i + 1;
    if (f->touching) b->largest_force = fmax(b->largest_force, b->bar[0].impedance * (f->in[0] - f->out[0]));
}

/* Speed at which free faces approach. */
static double closing_speed(const faces *f)
{
    const double speed = f->in[0] - f->in[1];
    return !f->touching && speed > f->still ? 2.0 * speed : 0.0;
}

static double next_time(const faces *f)
{
    double at = closing_speed(f) > 0.0 ? f->t + f->gap / closing_speed(f) : (double)INFINITY;
    for (int k = 0; k < 2; k++) {
        if (f->echo[k] < f->b->n) at = fmin(at, f->b->step[f->echo[k]] + transit_time(&f->b->bar[k]));
    }
    return at;
}

/* What comes back, and what the faces make of it. */
static void reflect_at_faces(faces *f, double at)
{
    const bar_impact *b = f->b;
    const double moment = 1e-12 * (transit_time(&b->bar[0]) + transit_time(&b->bar[1]));
    const double approach = closing_speed(f);
    const double drift = f->touching ? 0.0 : 2.0 * (f->in[1] - f->in[0]);
    const bool arrives = approach > 0.0 && at >= f->t + f->gap / approach - moment;
    f->gap = arrives ? 0.0 : fmax(f->gap + drift * (at - f->t), 0.0);
    f->t = at;
    for (int k = 0; k < 2; k++) {
        while (f->echo[k] < b->n && b->step[f->echo[k]] + transit_time(&b->bar[k]) <= at + moment) {
            f->in[k] = b->bar[k].wave[f->echo[k]++];
        }
    }
    f->touching = f->gap == 0.0 && f->in[0] - f->in[1] > f->still;
    const double z[2] = {b->bar[0].impedance, b->bar[1].impedance};
    const double v = 2.0 * (z[0] * f->in[0] + z[1] * f->in[1]) / (z[0] + z[1]);
    for (int k = 0; k < 2; k++) f->out[k] = f->touching ? v - f->in[k] : f->in[k];
}

static bool contact_changed(const faces *f, const double before[2], bool touching)
{
    return f->touching != touching || fabs(f->out[0] - before[0]) > f->still || fabs(f->out[1] - before[1]) > f->still;
}

static void follow_waves(faces *f)
{
    bar_impact *b = f->b;
    note_step(f);
    for (;;) {
        const double at = next_time(f);
        if (isinf(at) || b->n == BAR_IMPACT_STEPS) {
            b->horizon = at;
            return;
        }
        const double before[2] = {f->out[0], f->out[1]};
        const bool touching = f->touching;
        reflect_at_faces(f, at);
        if (!contact_changed(f, before, touching)) continue;
        note_step(f);
        if (f->touching && !touching) b->contact = fmin(b->contact, at);
        if (touching && !f->touching) b->release = fmin(b->release, at);
    }
}

static impact_bar bar_of(double length, double density, double modulus, double area, double velocity, double face)
{
    return (impact_bar){.length = length,
                        .speed = sqrt(modulus / density),
                        .impedance = area * sqrt(modulus * density),
                        .velocity = velocity,
                        .mass = density * area * length,
                        .face = face};
}

floe_status bar_impact_solve(context *ctx, const bar_impact_par *p, bar_impact *out)
{
    if (!(p->left_velocity > p->right_velocity)) {
        return fail_key(ctx, KEY("left_velocity"),
                        "%g m/s: must be over right_velocity = %g m/s, or the bars do not meet", p->left_velocity,
                        p->right_velocity);
    }
    const double face = p->origin + p->left_length;
    out->bar[0] = bar_of(p->left_length, p->left_density, p->left_modulus, p->left_area, p->left_velocity, face);
    out->bar[1] =
        bar_of(p->right_length, p->right_density, p->right_modulus, p->right_area, p->right_velocity, face + p->gap);
    out->n = 0;
    out->contact = out->release = INFINITY;
    out->largest_force = 0.0;
    faces f = {.b = out,
               .gap = p->gap,
               .in = {0.5 * p->left_velocity, 0.5 * p->right_velocity},
               .out = {0.5 * p->left_velocity, 0.5 * p->right_velocity},
               .echo = {0, 0},
               .still = 1e-13 * fmax(fabs(p->left_velocity), fabs(p->right_velocity))};
    follow_waves(&f);
    return FLOE_OK;
}
