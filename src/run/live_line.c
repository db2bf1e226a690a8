#include "run/live_line.h"

#include "base/timer.h"

#include <math.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

void live_line_begin(live_line *l, FILE *file, double live_interval, double plain_interval)
{
    *l = (live_line){.file = file,
                     .live = file && isatty(fileno(file)),
                     .last = wall_seconds(),
                     .live_interval = live_interval,
                     .plain_interval = plain_interval};
}

bool live_line_is_due(live_line *l)
{
    if (!l->file) return false;
    const double now = wall_seconds();
    if (now - l->last < (l->live ? l->live_interval : l->plain_interval)) return false;
    l->last = now;
    return true;
}

/* A live line that is longer than the terminal is wide would leave its rest behind. */
static void cut_to_width(FILE *file, char *line)
{
    struct winsize window;
    if (ioctl(fileno(file), TIOCGWINSZ, &window) != 0 || window.ws_col < 2) return;
    if (strlen(line) >= window.ws_col) line[window.ws_col - 1] = '\0';
}

void live_line_show(live_line *l, char *text)
{
    if (!l->file) return;
    if (l->live) cut_to_width(l->file, text);
    (void)fprintf(l->file, l->live ? "\r%s\033[K" : "%s\n", text);
    (void)fflush(l->file);
    l->shown = l->live;
}

void live_line_clear(live_line *l)
{
    if (!l->shown) return;
    (void)fprintf(l->file, "\r\033[K");
    (void)fflush(l->file);
    l->shown = false;
}

void live_line_duration(double seconds, char text[LIVE_LINE_DURATION])
{
    const long s = isfinite(seconds) && seconds < 1e9 ? lround(seconds) : -1;
    if (s < 0) {
        (void)snprintf(text, LIVE_LINE_DURATION, "?");
    } else if (s < 3600) {
        (void)snprintf(text, LIVE_LINE_DURATION, "%ld:%02ld", s / 60, s % 60);
    } else {
        (void)snprintf(text, LIVE_LINE_DURATION, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    }
}

void live_line_bar(double share, char text[LIVE_LINE_BAR])
{
    enum { WIDTH = 20 };
    const int full = (int)(share * WIDTH);
    for (int i = 0; i < WIDTH; i++) text[i + 1] = i < full ? '#' : '.';
    text[0] = '[';
    memcpy(text + WIDTH + 1, "] ", 3);
}
