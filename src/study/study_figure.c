/* Figures of a study: errors against spacing, work and time; quantities against spacing. */
#include "study/study_internal.h"

#include "run/run_errors.h"
#include "study/curves.h"
#include "study/profile.h"

#include <math.h>
#include <string.h>

enum { PANELS = STUDY_COSTS };

/* The next case of a group in the order of `over`, so that a curve goes from the coarsest case to the finest; NULL: no
 * more. */
static const study_case *next_case_drawn(const study *s, size_t group, const study_case *last)
{
    const study_case *next = NULL;
    for (size_t i = 0; i < s->n; i++) {
        const study_case *one = &s->list[i];
        if (one->group != group || (last && !(one->over < last->over))) continue;
        if (!next || one->over > next->over) next = one;
    }
    return next;
}

static floe_status make_study_curves(curves *c, const study *s, size_t panels)
{
    return curves_make(c, s->ctx, panels, panels * (s->n_groups + 1), 2 * panels * s->n, panels);
}

/* The marked set: what is neither beaten in error nor in cost. */
static void add_pareto_front(const study *s, curves *c, const char *metric, study_cost cost, double scale)
{
    curves_series(c, (plot_series){.name = "Pareto front", .style = PLOT_POINTS, .emphasis = true});
    for (size_t i = 0; i < s->n; i++) {
        if (study_is_on_front(s, i, metric, cost))
            curves_point(c, study_cost_of(&s->list[i], cost), scale * study_error(&s->list[i], metric));
    }
}

static void begin_group(const study *s, curves *c, size_t group)
{
    curves_series(c, (plot_series){.name = s->group[group], .style = PLOT_LINES_POINTS, .colour = (int)group});
}

static void add_error_panel(const study *s, curves *c, const char *metric, study_cost cost)
{
    const char *const x_label[] = {"processor time without outputs (s)", "updates of points and cells",
                                   study_over_label(s)};
    const double scale = error_is_relative(metric) ? 100.0 : 1.0;
    plot_panel *panel =
        curves_panel(c, (plot_panel){.x_label = x_label[cost],
                                     .y_label = curves_label(c, metric, error_unit(metric, s->dimensionless)),
                                     .log_x = true,
                                     .log_y = true});
    for (size_t g = 0; g < s->n_groups; g++) {
        begin_group(s, c, g);
        for (const study_case *one = next_case_drawn(s, g, NULL); one; one = next_case_drawn(s, g, one)) {
            const double error = study_error(one, metric);
            if (error > 0.0) curves_point(c, study_cost_of(one, cost), scale * error);
        }
    }
    if (cost == STUDY_H) {
        panel->slope[0] = 1.0;
        panel->slope[1] = 2.0;
        panel->n_slopes = 2;
    } else {
        add_pareto_front(s, c, metric, cost, scale);
    }
}

static bool has_data(const study *s, const char *metric)
{
    for (size_t i = 0; i < s->n; i++) {
        if (study_error(&s->list[i], metric) > 0.0) return true;
    }
    return false;
}

static floe_status write_errors(const study *s, plot_names *names)
{
    static const study_cost order[PANELS] = {STUDY_H, STUDY_UPDATES, STUDY_SECONDS};
    curves c;
    floe_status status = make_study_curves(&c, s, (size_t)s->n_metrics * PANELS);
    for (int m = 0; m < s->n_metrics && status == FLOE_OK; m++) {
        for (int k = 0; k < PANELS && has_data(s, s->metric[m]); k++) add_error_panel(s, &c, s->metric[m], order[k]);
    }
    const plot_figure figure = {.name = "errors", .title = s->title, .columns = PANELS};
    if (status == FLOE_OK) status = curves_write(&c, s->options->batch.dir, figure, names);
    curves_free(&c);
    return status;
}

static void add_quantity_panel(const study *s, curves *c, int q)
{
    curves_panel(c, (plot_panel){.x_label = study_over_label(s), .y_label = curves_label(c, s->plan.quantity[q], "")});
    for (size_t g = 0; g < s->n_groups; g++) {
        begin_group(s, c, g);
        for (const study_case *one = next_case_drawn(s, g, NULL); one; one = next_case_drawn(s, g, one)) {
            if (isfinite(one->quantity[q])) curves_point(c, one->over, one->quantity[q]);
        }
    }
}

static floe_status write_quantities(const study *s, plot_names *names)
{
    curves c;
    floe_status status = make_study_curves(&c, s, (size_t)s->plan.n_quantities);
    for (int q = 0; q < s->plan.n_quantities && status == FLOE_OK; q++) add_quantity_panel(s, &c, q);
    const plot_figure figure = {.name = "quantities", .title = s->title};
    if (status == FLOE_OK) status = curves_write(&c, s->options->batch.dir, figure, names);
    curves_free(&c);
    return status;
}

/* The finest case of a group that has come to its end with a profile; NULL if none. */
static const study_case *finest_profile(const study *s, size_t group)
{
    const study_case *best = NULL;
    for (size_t i = 0; i < s->n; i++) {
        const study_case *one = &s->list[i];
        if (one->group == group && study_is_done(one) && (!best || one->h < best->h)) best = one;
    }
    return best;
}

static floe_status write_profile(const study *s, plot_names *names)
{
    profile_source source[PLOT_COLOURS];
    size_t n = 0;
    if (s->n_groups > PLOT_COLOURS) return FLOE_OK; /* nobody could tell them apart */
    for (size_t g = 0; g < s->n_groups; g++) {
        const study_case *one = finest_profile(s, g);
        if (!one) continue;
        source[n].name = s->group[g];
        source[n].colour = (int)g;
        source[n].h = one->h;
        (void)snprintf(source[n].path, sizeof source[n].path, "%s/%s/profile.csv", s->options->batch.dir,
                       one->run->folder);
        n++;
    }
    return profile_write(s->ctx, s->options->batch.dir, s->exact, source, n, s->dimensionless, names);
}

floe_status study_write_figures(const study *s)
{
    plot_names names = {0};
    TRY(write_errors(s, &names));
    TRY(write_quantities(s, &names));
    TRY(write_profile(s, &names));
    return plots_draw(s->ctx, s->options->batch.dir, &names);
}
