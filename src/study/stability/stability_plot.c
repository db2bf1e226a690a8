/* A search or a map as a figure. */
#include "study/crossed.h"
#include "study/curves.h"
#include "study/stability/stability.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The combination's values after the first key, which has a panel of its own where there are several. */
static void name_series(const stability *s, size_t set, char name[STABILITY_LABEL])
{
    const int first = s->n_each > 1 ? 1 : 0;
    size_t used = 0;
    name[0] = '\0';
    for (int i = first; i < s->n_each && used < STABILITY_LABEL; i++)
        used += (size_t)snprintf(name + used, STABILITY_LABEL - used, "%s%s", i > first ? ", " : "",
                                 s->each[i].value[s->set[set].value[i]]);
}

static bool is_positive(const stability *s)
{
    for (size_t i = 0; i < s->n_probes; i++) {
        if (!(s->probe[i].x[0] > 0.0)) return false;
    }
    return true;
}

/* The runs of a combination: their energies over the value that was tried. */
static void add_energies(const stability *s, curves *c, size_t set, int colour)
{
    const double scale = isfinite(s->relative_to) ? s->relative_to : 1.0;
    char *name = curves_text(c);
    name_series(s, set, name);
    curves_series(c, (plot_series){.name = name, .style = PLOT_LINES_POINTS, .colour = colour});
    for (size_t i = 0; i < s->n_probes; i++) {
        const stability_probe *p = &s->probe[i];
        if (p->set == set && p->energy.ratio > 0.0) curves_point_in_order(c, p->x[0] / scale, p->energy.ratio);
    }
}

static floe_status write_energy(const stability *s, plot_names *names)
{
    const size_t panels = s->n_each > 1 ? (size_t)s->each[0].n_values : 1, each = s->n_sets / panels;
    char x_label[256];
    curves c;
    if (isfinite(s->relative_to))
        (void)snprintf(x_label, sizeof x_label, "%s / %g%s", s->over[0].key, s->relative_to, s->unit);
    else
        (void)snprintf(x_label, sizeof x_label, "%s%s", s->over[0].key, s->unit);
    floe_status status = curves_make(&c, s->ctx, panels, s->n_sets, s->n_probes + 1, panels + s->n_sets);
    for (size_t k = 0; status == FLOE_OK && k < panels; k++) {
        char *title = curves_text(&c);
        if (panels > 1) (void)snprintf(title, CURVES_TEXT, "%s=%s", s->each[0].key, s->each[0].value[k]);
        curves_panel(
            &c,
            (plot_panel){
                .title = title, .x_label = x_label, .y_label = "energy ratio", .log_x = is_positive(s), .log_y = true});
        for (size_t i = 0; i < each; i++) add_energies(s, &c, k * each + i, (int)i);
    }
    if (status == FLOE_OK) status = curves_write(&c, s->dir, (plot_figure){.name = "energy", .title = s->title}, names);
    curves_free(&c);
    return status;
}

static bool is_numeric(const scene_axis *axis)
{
    for (int i = 0; i < axis->n_values; i++) {
        char *end;
        (void)strtod(axis->value[i], &end);
        if (end == axis->value[i]) return false;
    }
    return true;
}

/* Where a value stands on its axis: at its number, or, for words, at its place in the list from 1. */
static double place_of(const scene_axis *axis, int i)
{
    return is_numeric(axis) ? strtod(axis->value[i], NULL) : i + 1;
}

static bool is_logarithmic(const scene_axis *axis)
{
    double least = INFINITY, most = 0.0;
    for (int i = 0; i < axis->n_values; i++) {
        least = fmin(least, place_of(axis, i));
        most = fmax(most, place_of(axis, i));
    }
    return is_numeric(axis) && least > 0.0 && most / least > 10.0;
}

static void label_axis(const scene_axis *axis, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "%s", axis->key);
    if (is_numeric(axis)) return;
    for (int i = 0; i < axis->n_values && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s %d %s", i > 0 ? "," : ":", i + 1, axis->value[i]);
}

/* A series a verdict, in every panel. */
static void add_verdicts(const stability *s, curves *c, size_t set)
{
    for (int v = 0; v < VERDICT_COUNT; v++) {
        curves_series(c, (plot_series){.name = verdict_name((verdict)v), .style = PLOT_POINTS, .colour = v});
        for (size_t i = 0; i < crossed_count(s->over, 2); i++) {
            int at[2];
            crossed_pick(s->over, 2, i, at);
            const stability_probe *p = stability_cell(s, set, at[0], at[1]);
            if (p && p->verdict == (verdict)v)
                curves_point_in_order(c, place_of(&s->over[1], at[1]), place_of(&s->over[0], at[0]));
        }
    }
}

static floe_status write_map(const stability *s, plot_names *names)
{
    char label[2][512];
    curves c;
    for (int i = 0; i < 2; i++) label_axis(&s->over[i], label[i], sizeof label[i]);
    floe_status status = curves_make(&c, s->ctx, s->n_sets, s->n_sets * VERDICT_COUNT, s->n_probes + 1, s->n_sets);
    for (size_t k = 0; status == FLOE_OK && k < s->n_sets; k++) {
        char *title = curves_text(&c);
        stability_set_label(s, k, title);
        curves_panel(&c, (plot_panel){.title = title,
                                      .x_label = label[1],
                                      .y_label = label[0],
                                      .log_x = is_logarithmic(&s->over[1]),
                                      .log_y = is_logarithmic(&s->over[0])});
        add_verdicts(s, &c, k);
    }
    if (status == FLOE_OK) status = curves_write(&c, s->dir, (plot_figure){.name = "map", .title = s->title}, names);
    curves_free(&c);
    return status;
}

floe_status stability_plot(const stability *s)
{
    plot_names names = {0};
    if (s->n_probes == 0) return FLOE_OK;
    TRY(stability_is_map(s) ? write_map(s, &names) : write_energy(s, &names));
    return plots_draw(s->ctx, s->dir, &names);
}
