#include "scene/mass_source.h"

#include "scene/formula.h"
#include "scene/state.h"

#include <float.h>
#include <math.h>

/* What is integrated over a step: the rate of mass, and what it brings of temperature and velocity; or an area. */
enum { SUM_MASS, SUM_TEMPERATURE, SUM_VELOCITY, SUMS = SUM_VELOCITY + MESH_MAX_DIM };

typedef struct in_time {
    const scene *s;
    const scene_mass_source *source; /* NULL: a vent */
    const scene_vent *vent;
} in_time;

static const double nowhere[3] = {0.0, 0.0, 0.0};

static floe_status rates_at(const in_time *q, double t, double rate[SUMS])
{
    const scene_mass_source *source = q->source;
    for (int n = 0; n < SUMS; ++n) rate[n] = 0.0;
    if (!source) return scene_number(q->s, &q->vent->area, nowhere, t, &rate[SUM_MASS]);
    TRY(scene_number(q->s, &source->mass_rate, nowhere, t, &rate[SUM_MASS]));
    if (!(rate[SUM_MASS] > 0.0)) return FLOE_OK;
    TRY(scene_number(q->s, &source->temperature, nowhere, t, &rate[SUM_TEMPERATURE]));
    for (int a = 0; a < q->s->mesh.dim; ++a)
        TRY(scene_number(q->s, &source->velocity[a], nowhere, t, &rate[SUM_VELOCITY + a]));
    for (int n = SUM_TEMPERATURE; n < SUMS; ++n) rate[n] *= rate[SUM_MASS];
    return FLOE_OK;
}

/* Simpson's rule: with the ends, so that no corner or jump beside one is missed. */
static floe_status simpson(const in_time *q, double from, double to, double sum[SUMS])
{
    static const double weight[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
    for (int n = 0; n < SUMS; ++n) sum[n] = 0.0;
    for (int k = 0; k < 3; ++k) {
        double rate[SUMS];
        TRY(rates_at(q, k == 2 ? to : from + 0.5 * k * (to - from), rate));
        for (int n = 0; n < SUMS; ++n) sum[n] += weight[k] * (to - from) * rate[n];
    }
    return FLOE_OK;
}

/* The interval is halved until both ways agree: corners and steps of tables are found so. */
static floe_status integrate(const in_time *q, double from, double to, double sum[SUMS])
{
    enum { DEPTH = 40 };
    const double least = 1e-12 * (to - from), close = 1e-12;
    double end[DEPTH + 2] = {to}, start = from;
    int waiting = 1;
    for (int n = 0; n < SUMS; ++n) sum[n] = 0.0;
    while (waiting > 0) {
        const double stop = end[waiting - 1], middle = 0.5 * (start + stop);
        double whole[SUMS], half[2][SUMS], off = 0.0, size = 0.0;
        TRY(simpson(q, start, stop, whole));
        TRY(simpson(q, start, middle, half[0]));
        TRY(simpson(q, middle, stop, half[1]));
        for (int n = 0; n <= SUM_TEMPERATURE; ++n) {
            off = fmax(off, fabs(half[0][n] + half[1][n] - whole[n]) / (fabs(sum[n]) + fabs(whole[n]) + DBL_MIN));
            size = fmax(size, fabs(whole[n]) + fabs(half[0][n]) + fabs(half[1][n]));
        }
        if (off > close && size > 0.0 && waiting <= DEPTH && stop - start > least) {
            end[waiting++] = middle;
            continue;
        }
        for (int n = 0; n < SUMS; ++n) sum[n] += half[0][n] + half[1][n];
        start = stop;
        waiting--;
    }
    return FLOE_OK;
}

floe_status mass_source_intake(const scene *s, const scene_mass_source *source, double from, double to,
                               mass_intake *out)
{
    const double first = fmax(from, source->start), last = fmin(to, source->end);
    double sum[SUMS];
    *out = (mass_intake){.mass = 0.0};
    if (!(first < last)) return FLOE_OK;
    TRY(integrate(&(in_time){.s = s, .source = source}, first, last, sum));
    if (!(sum[SUM_MASS] > 0.0)) return FLOE_OK;
    out->mass = sum[SUM_MASS] / scene_extent(s);
    out->temperature = sum[SUM_TEMPERATURE] / sum[SUM_MASS];
    for (int a = 0; a < s->mesh.dim; ++a) out->velocity[a] = sum[SUM_VELOCITY + a] / sum[SUM_MASS];
    return FLOE_OK;
}

floe_status vent_opening(const scene *s, const scene_vent *vent, double from, double to, double *area, double *seconds)
{
    const double first = fmax(from, vent->start), last = fmin(to, vent->end);
    double sum[SUMS];
    *area = *seconds = 0.0;
    if (!(first < last)) return FLOE_OK;
    TRY(integrate(&(in_time){.s = s, .vent = vent}, first, last, sum));
    *seconds = last - first;
    *area = sum[SUM_MASS] * vent->discharge / (scene_extent(s) * *seconds);
    return FLOE_OK;
}

static bool is_elsewhere(const scene *s, int material)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].material == material) return true;
    return s->has_ambient && s->ambient_material == material;
}

bool mass_source_joins(const scene *s)
{
    for (int k = 0; k < s->n_mass_sources; ++k)
        if (!is_elsewhere(s, s->mass_source[k].material)) return true;
    return false;
}
