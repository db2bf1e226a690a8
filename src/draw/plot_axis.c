/* Ranges and tics of a plot's axes. */
#include "draw/plot_internal.h"

#include <math.h>

bool plot_drawable(bool log_axis, double value)
{
    return isfinite(value) && (!log_axis || value > 0.0);
}

size_t plot_points(const plot_panel *panel, const plot_series *series)
{
    size_t n = 0;
    for (size_t i = 0; i < series->n; i++)
        n += plot_drawable(panel->log_x, series->x[i]) && plot_drawable(panel->log_y, series->y[i]);
    return n;
}

static void widen_range(plot_axis *axis, double value)
{
    axis->lo = axis->any ? fmin(axis->lo, value) : value;
    axis->hi = axis->any ? fmax(axis->hi, value) : value;
    axis->any = true;
}

/* Margins around the data, as parts of the range below and above. */
static void add_margin(plot_axis *axis, double below, double above)
{
    if (!axis->any) {
        *axis = (plot_axis){.lo = 0.0, .hi = 1.0};
        return;
    }
    if (axis->log) {
        const double span = log10(axis->hi / axis->lo), missing = fmax(0.1 - span, 0.0);
        axis->lo *= pow(10.0, -0.5 * missing - below * fmax(span, 0.1));
        axis->hi *= pow(10.0, 0.5 * missing + above * fmax(span, 0.1));
        return;
    }
    /* A range that is all round-off would show nothing else, and its tics would all be named alike. */
    const double size = fmax(fabs(axis->lo), fabs(axis->hi));
    const double least = size > 0.0 ? 1e-4 * size : 1.0;
    const double span = axis->hi - axis->lo, missing = fmax(least - span, 0.0);
    axis->lo -= 0.5 * missing + below * fmax(span, least);
    axis->hi += 0.5 * missing + above * fmax(span, least);
}

/* Points touch the frame unless there is a margin; a curve may start at it. */
static bool has_points(const plot_panel *panel)
{
    for (size_t i = 0; i < panel->n_series; i++) {
        const plot_style style = panel->series[i].style;
        if (style == PLOT_POINTS || style == PLOT_LINES_POINTS) return true;
    }
    return false;
}

void plot_axes(const plot_panel *panel, plot_axis *x, plot_axis *y)
{
    *x = (plot_axis){.log = panel->log_x};
    *y = (plot_axis){.log = panel->log_y};
    for (size_t k = 0; k < panel->n_series; k++) {
        const plot_series *s = &panel->series[k];
        for (size_t i = 0; i < s->n; i++) {
            if (!plot_drawable(x->log, s->x[i]) || !plot_drawable(y->log, s->y[i])) continue;
            widen_range(x, s->x[i]);
            widen_range(y, s->y[i]);
        }
    }
    const double beside = has_points(panel) ? 0.08 : 0.0;
    add_margin(x, beside, beside);
    add_margin(y, panel->n_slopes > 0 ? 0.2 : 0.06, 0.08);
}

/* One tic: plain digits where they are short, else a power of ten. */
static void append_tic(strbuf *out, double value, int *tics)
{
    const int power = (int)floor(log10(value) + 1e-9);
    const double leading = value / pow(10.0, power);
    strbuf_append(out, "%s", (*tics)++ ? ", " : "");
    if (power >= -3 && power <= 4) {
        strbuf_append(out, "'%.6g' %.9g", value, value);
    } else if (fabs(leading - 1.0) < 1e-6) {
        strbuf_append(out, "'10^{%d}' %.9g", power, value);
    } else {
        strbuf_append(out, "'%.6g×10^{%d}' %.9g", leading, power, value);
    }
}

static bool is_in_range(const plot_axis *axis, double value)
{
    return value >= axis->lo * (1.0 - 1e-9) && value <= axis->hi * (1.0 + 1e-9);
}

/* A step of 1, 2 or 5 times a power of ten that makes three to eight steps of the range. */
static double even_step(const plot_axis *axis)
{
    const double raw = (axis->hi - axis->lo) / 5.0, power = pow(10.0, floor(log10(raw)));
    return power * (raw / power > 7.5 ? 10.0 : raw / power > 3.5 ? 5.0 : raw / power > 1.5 ? 2.0 : 1.0);
}

/* Tics at even steps, for less than about half a decade. */
static void append_even_tics(strbuf *out, const plot_axis *axis)
{
    const double step = even_step(axis);
    int tics = 0;
    for (double value = step * ceil(axis->lo / step - 1e-9); is_in_range(axis, value); value += step)
        append_tic(out, value, &tics);
}

/* Tics at 1, 2, 5 of every decade, or at decades alone; the further the range, the fewer. */
static void append_decade_tics(strbuf *out, const plot_axis *axis, double span, double most)
{
    static const double leading[] = {1.0, 2.0, 5.0};
    const int every = span > 8.0 ? (int)ceil(span / 6.0) : 1, each = span > most ? 1 : 3;
    int tics = 0;
    for (int power = (int)floor(log10(axis->lo)); power <= (int)ceil(log10(axis->hi)); power++) {
        if (((power % every) + every) % every != 0) continue;
        for (int k = 0; k < each; k++) {
            const double value = leading[k] * pow(10.0, power);
            if (is_in_range(axis, value)) append_tic(out, value, &tics);
        }
    }
}

void plot_append_axis(strbuf *out, char name, const plot_axis *axis)
{
    strbuf_append(out, "%s logscale %c\nset %crange [%.17g:%.17g]\nset %ctics nomirror enhanced scale 0.5",
                  axis->log ? "set" : "unset", name, name, axis->lo, axis->hi, name);
    if (axis->log) {
        const double span = log10(axis->hi / axis->lo);
        strbuf_append(out, " (");
        if (span < 0.6) {
            append_even_tics(out, axis);
        } else {
            append_decade_tics(out, axis, span, name == 'x' ? 1.8 : 2.6); /* labels side by side need more space */
        }
        strbuf_append(out, ")\n");
    } else {
        strbuf_append(out, " %.9g\nset format %c '%%h'\n", even_step(axis), name);
    }
}
