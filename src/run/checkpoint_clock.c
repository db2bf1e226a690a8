#include "run/checkpoint_clock.h"

#include <math.h>

checkpoint_clock checkpoint_clock_start(double interval, double now, double cost)
{
    return (checkpoint_clock){.interval = interval, .started = now, .last = now, .cost = cost};
}

void checkpoint_clock_see_snapshot(checkpoint_clock *c)
{
    if (c->snapshot) c->passed++;
    c->snapshot = true;
}

bool checkpoint_clock_is_due(const checkpoint_clock *c, double now)
{
    if (!isnan(c->interval)) return now - c->last >= c->interval;
    if (!c->snapshot && now - c->last < CHECKPOINT_CLOCK_LONGEST) return false;
    return c->spent + c->cost <= CHECKPOINT_CLOCK_SHARE * (now - c->started);
}

void checkpoint_clock_count(checkpoint_clock *c, double begun, double now)
{
    c->last = begun;
    c->cost = now - begun;
    c->spent += c->cost;
    c->written++;
    c->snapshot = false;
}
