#include "run/schedule.h"

#include <math.h>

static const double slack = 1e-9; /* of an interval */

static double last_output_time(double time, double interval)
{
    return floor(time / interval + slack);
}

double schedule_next(double time, double interval)
{
    return isfinite(interval) ? (last_output_time(time, interval) + 1.0) * interval : (double)INFINITY;
}

bool schedule_is_due(double time, double interval)
{
    if (!isfinite(interval)) return false;
    const double turns = time / interval;
    return fabs(turns - nearbyint(turns)) <= slack;
}

bool schedule_is_passed(double before, double after, double interval)
{
    if (!isfinite(interval)) return false;
    if (!(interval > 0.0)) return after > before;
    return last_output_time(after, interval) > last_output_time(before, interval);
}
