#include "run/progress.h"

#include "base/timer.h"

#include <math.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static const double live_interval = 0.2, plain_interval = 5.0; /* s of wall time between lines */

void progress_begin(progress *p, FILE *file, const char *label, const sim *s)
{
    *p = (progress){.file = file,
                    .label = label,
                    .started = wall_seconds(),
                    .first_time = s->time,
                    .drifts = ledger_quantity_name(LEDGER_MASS)};
    p->last = p->started;
    p->live = file && isatty(fileno(file));
}

/* "1:02:03" */
static void write_duration(double seconds, char text[32])
{
    const long s = isfinite(seconds) && seconds < 1e9 ? lround(seconds) : -1;
    if (s < 0) {
        (void)snprintf(text, 32, "?");
    } else if (s < 3600) {
        (void)snprintf(text, 32, "%ld:%02ld", s / 60, s % 60);
    } else {
        (void)snprintf(text, 32, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    }
}

void progress_account(progress *p, const ledger *l)
{
    p->drift = 0.0;
    for (int q = 0; q < LEDGER_QUANTITIES; q++) {
        const double drift = ledger_drift(l, (ledger_quantity)q);
        if (drift <= p->drift) continue;
        p->drift = drift;
        p->drifts = ledger_quantity_name((ledger_quantity)q);
    }
}

static void write_bar(double share, char bar[32])
{
    enum { WIDTH = 20 };
    const int full = (int)(share * WIDTH);
    for (int i = 0; i < WIDTH; i++) bar[i + 1] = i < full ? '#' : '.';
    bar[0] = '[';
    memcpy(bar + WIDTH + 1, "] ", 3);
}

static void write_line(const progress *p, const sim *s, double now, char *line, size_t size)
{
    const double end = s->scene->time.end;
    const double share = fmin(1.0, fmax(0.0, s->time / end));
    const double pace = (now - p->started) / (s->time - p->first_time); /* s of wall time per s of the scene */
    char bar[32] = "", left[32];
    write_duration((end - s->time) * pace, left);
    if (p->live) write_bar(share, bar);
    (void)snprintf(line, size, "%s%s%s%3.0f %%  t = %.4g s  step %ld  dt %.3g s (%s)  ETA %s  drift of %s %.1e",
                   p->label ? p->label : "", p->label ? "  " : "", bar, 100.0 * share, s->time, s->steps, s->dt,
                   s->dt_reason, left, p->drifts, p->drift);
}

/* A live line that is longer than the terminal is wide would leave its rest behind. */
static void cut_to_width(FILE *file, char *line)
{
    struct winsize window;
    if (ioctl(fileno(file), TIOCGWINSZ, &window) != 0 || window.ws_col < 2) return;
    if (strlen(line) >= window.ws_col) line[window.ws_col - 1] = '\0';
}

void progress_show(progress *p, const sim *s)
{
    if (!p->file) return;
    const double now = wall_seconds();
    if (now - p->last < (p->live ? live_interval : plain_interval)) return;
    char line[512];
    p->last = now;
    write_line(p, s, now, line, sizeof line);
    if (p->live) cut_to_width(p->file, line);
    (void)fprintf(p->file, p->live ? "\r%s\033[K" : "%s\n", line);
    (void)fflush(p->file);
    p->shown = p->live;
}

void progress_clear(progress *p)
{
    if (!p->shown) return;
    (void)fprintf(p->file, "\r\033[K");
    (void)fflush(p->file);
    p->shown = false;
}

void progress_end(progress *p, const char *text)
{
    progress_clear(p);
    if (p->file) (void)fprintf(p->file, "%s%s%s\n", p->label ? p->label : "", p->label ? "  " : "", text);
}
