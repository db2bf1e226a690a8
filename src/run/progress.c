#include "run/progress.h"

#include "base/timer.h"

#include <math.h>

void progress_begin(progress *p, FILE *file, const char *label, const sim *s)
{
    *p = (progress){
        .label = label, .started = wall_seconds(), .first_time = s->time, .drifts = ledger_quantity_name(LEDGER_MASS)};
    live_line_begin(&p->line, file, 0.2, 5.0);
}

void progress_show_ledger(progress *p, const ledger *l)
{
    p->drift = 0.0;
    for (int q = 0; q < LEDGER_QUANTITIES; q++) {
        const double drift = fabs(ledger_largest_drift(l, (ledger_quantity)q));
        if (drift <= p->drift) continue;
        p->drift = drift;
        p->drifts = ledger_quantity_name((ledger_quantity)q);
    }
}

static void write_progress_line(const progress *p, const sim *s, double now, char *line, size_t size)
{
    const double end = s->scene->time.end;
    const double share = fmin(1.0, fmax(0.0, s->time / end));
    const double pace = (now - p->started) / (s->time - p->first_time); /* s of wall time per s of the scene */
    const char *unit = scene_time_unit(s->scene);
    char bar[LIVE_LINE_BAR] = "", left[LIVE_LINE_DURATION];
    live_line_duration((end - s->time) * pace, left);
    if (p->line.live) live_line_bar(share, bar);
    (void)snprintf(line, size, "%s%s%s%3.0f %%  t = %.4g%s  step %ld  dt %.3g%s (%s)  ETA %s  drift of %s %.1e",
                   p->label ? p->label : "", p->label ? "  " : "", bar, 100.0 * share, s->time, unit, s->steps, s->dt,
                   unit, s->dt_reason, left, p->drifts, p->drift);
}

void progress_show(progress *p, const sim *s)
{
    char line[LIVE_LINE_SIZE];
    if (!live_line_is_due(&p->line)) return;
    write_progress_line(p, s, wall_seconds(), line, sizeof line);
    live_line_show(&p->line, line);
}

void progress_clear(progress *p)
{
    live_line_clear(&p->line);
}
