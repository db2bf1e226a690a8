/* How what is imposed follows time: nothing before `start`, then up to one along half a cosine of length `ramp` (0: at
 * once), times a sine of `frequency` (0: none) that begins at `start`. */
#ifndef MATH_SWING_H
#define MATH_SWING_H

#include <math.h>

typedef struct swing {
    double start, ramp; /* s */
    double frequency;   /* Hz */
} swing;

static inline double swing_at(const swing *s, double t)
{
    const double pi = 3.14159265358979323846, past = t - s->start;
    if (past < 0.0) return 0.0;
    const double rise = s->ramp > past ? 0.5 - 0.5 * cos(pi * past / s->ramp) : 1.0;
    return s->frequency > 0.0 ? rise * sin(2.0 * pi * s->frequency * past) : rise;
}

/* Its rate (1/s); none at a jump. */
static inline double swing_rate(const swing *s, double t)
{
    const double pi = 3.14159265358979323846, past = t - s->start, w = 2.0 * pi * s->frequency;
    if (past < 0.0) return 0.0;
    const double rise = s->ramp > past ? 0.5 - 0.5 * cos(pi * past / s->ramp) : 1.0;
    const double slope = s->ramp > past ? 0.5 * pi / s->ramp * sin(pi * past / s->ramp) : 0.0;
    return s->frequency > 0.0 ? slope * sin(w * past) + rise * w * cos(w * past) : slope;
}

#endif
