#include "scene/scene_motion.h"

#include <math.h>
#include <string.h>

void motion_axis(const scene_motion *m, double out[3])
{
    double length = 0.0;
    for (int a = 0; a < 3; ++a) length = hypot(length, m->axis[a]);
    for (int a = 0; a < 3; ++a) out[a] = length > 0.0 ? m->axis[a] / length : a == 2 ? 1.0 : 0.0;
}

/* The knot at or before t, and the share of the way to the next; beyond the ends there is none. */
static int find_knot(const scene_motion *m, double t, double *share)
{
    int k = 0;
    while (k + 1 < m->n && t >= m->time[k + 1]) ++k;
    const bool between = k + 1 < m->n && t > m->time[k];
    *share = between ? (t - m->time[k]) / (m->time[k + 1] - m->time[k]) : 0.0;
    return k;
}

void motion_rates(const scene_motion *m, double t, double velocity[3], double *spin)
{
    memset(velocity, 0, 3 * sizeof *velocity);
    *spin = 0.0;
    if (m->kind != MOTION_DRIVEN) return;
    double share;
    const int k = find_knot(m, t, &share), next = share > 0.0 ? k + 1 : k;
    for (int a = 0; a < 3; ++a) velocity[a] = (1.0 - share) * m->velocity[k][a] + share * m->velocity[next][a];
    *spin = (1.0 - share) * m->spin[k] + share * m->spin[next];
}

/* Adds the integral over a part of the time in which rates are linear. */
static void add_part(const scene_motion *m, double from, double to, double way[3], double *angle)
{
    double v[3], spin;
    motion_rates(m, 0.5 * (from + to), v, &spin);
    for (int a = 0; a < 3; ++a) way[a] += (to - from) * v[a];
    *angle += (to - from) * spin;
}

void motion_travel(const scene_motion *m, double from, double to, double way[3], double *angle)
{
    memset(way, 0, 3 * sizeof *way);
    *angle = 0.0;
    if (m->kind != MOTION_DRIVEN) return;
    for (int k = 0; k < m->n; ++k) {
        if (!(m->time[k] > from && m->time[k] < to)) continue;
        add_part(m, from, m->time[k], way, angle);
        from = m->time[k];
    }
    add_part(m, from, to, way, angle);
}

bool motion_velocity_at_start(const scene_motion *m, const double velocity[3], const double x[3], double out[3])
{
    double v[3], w[3], spin, arm[3];
    motion_rates(m, 0.0, v, &spin);
    motion_axis(m, w);
    for (int a = 0; a < 3; ++a) {
        w[a] = m->kind == MOTION_RIGID ? m->turning[a] : spin * w[a];
        if (m->kind == MOTION_RIGID) v[a] = velocity[a];
        arm[a] = x[a] - m->about[a];
    }
    const bool turns = w[0] != 0.0 || w[1] != 0.0 || w[2] != 0.0;
    const bool known = !isnan(m->about[0]);
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = turns && known ? v[a] + w[b] * arm[c] - w[c] * arm[b] : v[a];
    }
    return known || !turns;
}

void motion_largest(const scene_motion *m, double t, double speed[3], double *spin)
{
    double v[3], share;
    motion_rates(m, t, v, spin);
    *spin = fabs(*spin);
    for (int a = 0; a < 3; ++a) speed[a] = fabs(v[a]);
    if (m->kind != MOTION_DRIVEN) return;
    const int k = find_knot(m, t, &share), next = k + 1 < m->n ? k + 1 : k;
    for (int a = 0; a < 3; ++a) speed[a] = fmax(speed[a], fabs(m->velocity[next][a]));
    *spin = fmax(*spin, fabs(m->spin[next]));
}
