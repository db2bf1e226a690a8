/* A run's history.csv: plots of what goes together, and the ledger at its end. */
#include "report/html.h"
#include "report/run_section.h"

#include "base/memory.h"
#include "io/file.h"

#include <math.h>
#include <string.h>

enum { MAX_SERIES = 16 };

/* What stands in one plot: columns by their full names ("=dt") or by how they begin, separated by '|'. */
typedef struct history_group {
    const char *name, *title, *columns;
    bool log;   /* always; otherwise only where sizes differ by more than a thousand */
    bool brief; /* also for one of many runs */
} history_group;

static const history_group groups[] = {
    {"energies", "Energies", "=kinetic|=strain|=internal", false, true},
    {"drifts", "Drift of what is conserved", "drift_", true, true},
    {"materials", "Energies by material", "kinetic_|strain_|internal_", false, false},
    {"pressure", "Mean pressure", "pressure_", false, true},
    {"momentum", "Momentum", "momentum_", false, false},
    {"mass", "Mass", "=mass|mass_", false, false},
    {"step", "Time step", "=dt", true, false},
};
/* Columns that no plot is made of; the rest belongs to probes. */
static const char not_plotted[] = "=time|=steps|=rejected_steps|=dt_limit|ledger_";

static bool is_listed(const char *list, const char *name)
{
    while (*list) {
        const size_t length = strcspn(list, "|");
        const bool whole = *list == '=';
        const size_t part = length - whole;
        if (strncmp(name, list + whole, part) == 0 && (!whole || name[part] == '\0')) return true;
        list += length + (list[length] == '|');
    }
    return false;
}

static double largest_of_column(const csv_table *t, const csv_column *c)
{
    double most = 0.0;
    for (size_t i = 0; i < t->n_rows; i++) {
        if (isfinite(c->value[i])) most = fmax(most, fabs(c->value[i]));
    }
    return most;
}

/* A column is worth a curve when it is not all zero or missing; a mass only when it changes. */
static bool is_worth(const csv_table *t, const csv_column *c, const char *group)
{
    const double most = largest_of_column(t, c);
    if (!(most > 0.0)) return false;
    if (strcmp(group, "mass") != 0) return true;
    for (size_t i = 1; i < t->n_rows; i++) {
        if (fabs(c->value[i] - c->value[0]) > 1e-9 * most) return true;
    }
    return false;
}

static void add_series(plot_series *list, size_t *n, const csv_table *t, const csv_column *c)
{
    list[*n] = (plot_series){.name = c->name,
                             .style = PLOT_LINES,
                             .colour = (int)*n,
                             .x = t->column[0].value,
                             .y = c->value,
                             .n = t->n_rows};
    ++*n;
}

/* One plot; the figure refers to `panel`, `series` and the texts, which live with the caller. */
typedef struct history_plot {
    char name[PLOT_STEM], x_label[CSV_NAME], y_label[CSV_NAME], title[CSV_NAME];
    plot_series series[MAX_SERIES];
    size_t n;
    double most, least; /* of the curves' largest values */
    plot_panel panel;
} history_plot;

static void label_with_unit(char out[CSV_NAME], const char *name, const char *unit)
{
    const bool both = name[0] && unit[0];
    (void)snprintf(out, CSV_NAME, "%.100s%s%s%s", name, both ? " (" : "", unit, both ? ")" : "");
}

static void take_column(history_plot *h, const csv_table *t, const csv_column *c, const char *group)
{
    if (h->n == MAX_SERIES || !is_worth(t, c, group)) return;
    const double size = largest_of_column(t, c);
    h->most = h->n ? fmax(h->most, size) : size;
    h->least = h->n ? fmin(h->least, size) : size;
    if (h->n == 0) label_with_unit(h->y_label, "", c->unit);
    add_series(h->series, &h->n, t, c);
}

static void finish_history_plot(history_plot *h, const run_view *v, const csv_table *t, const char *name,
                                const char *title, bool log)
{
    plot_name(v, name, h->name);
    label_with_unit(h->x_label, t->column[0].name, t->column[0].unit);
    (void)snprintf(h->title, sizeof h->title, "%s", title);
    h->panel = (plot_panel){.x_label = h->x_label,
                            .y_label = h->y_label,
                            .log_y = log || h->most > 1e3 * h->least,
                            .series = h->series,
                            .n_series = h->n};
}

static plot_figure figure_of(const history_plot *h)
{
    return (plot_figure){.name = h->name, .title = h->title, .panel = &h->panel, .untitled = true, .n_panels = 1};
}

static bool is_of_probe(const csv_column *c)
{
    for (size_t g = 0; g < sizeof groups / sizeof groups[0]; g++) {
        if (is_listed(groups[g].columns, c->name)) return false;
    }
    return !is_listed(not_plotted, c->name);
}

/* Probes: a plot for each unit, in the order in which units come. */
static size_t probe_plots(const run_view *v, const csv_table *t, history_plot *list, size_t reserved)
{
    size_t n = 0;
    for (size_t k = 1; k < t->n_columns; k++) {
        const csv_column *c = &t->column[k];
        bool known = !is_of_probe(c);
        for (size_t i = 1; i < k && !known; i++)
            known = is_of_probe(&t->column[i]) && strcmp(t->column[i].unit, c->unit) == 0;
        if (known || n == reserved) continue;
        history_plot *h = &list[n];
        for (size_t i = k; i < t->n_columns; i++) {
            if (is_of_probe(&t->column[i]) && strcmp(t->column[i].unit, c->unit) == 0)
                take_column(h, t, &t->column[i], "probes");
        }
        char name[CSV_NAME];
        (void)snprintf(name, sizeof name, "probes-%zu", n);
        finish_history_plot(h, v, t, name, "Probes", false);
        n += h->n > 0;
    }
    return n;
}

static size_t group_plots(const run_view *v, const csv_table *t, history_plot *list)
{
    size_t n = 0;
    for (size_t g = 0; g < sizeof groups / sizeof groups[0]; g++) {
        history_plot *h = &list[n];
        if (v->brief && !groups[g].brief) continue;
        for (size_t k = 1; k < t->n_columns; k++) {
            if (is_listed(groups[g].columns, t->column[k].name)) take_column(h, t, &t->column[k], groups[g].name);
        }
        finish_history_plot(h, v, t, groups[g].name, groups[g].title, groups[g].log);
        n += h->n > 0;
    }
    return n;
}

enum { MAX_PROBE_PLOTS = 6, MAX_PLOTS = sizeof groups / sizeof groups[0] + MAX_PROBE_PLOTS };

static floe_status draw_histories(const run_view *v, const csv_table *t)
{
    history_plot *list;
    plot_figure figure[MAX_PLOTS];
    TRY(memory_new(v->page->ctx, &list, MAX_PLOTS, sizeof *list));
    size_t n = group_plots(v, t, list);
    if (!v->brief) n += probe_plots(v, t, list + n, MAX_PROBE_PLOTS);
    for (size_t i = 0; i < n; i++) figure[i] = figure_of(&list[i]);
    if (n > 0) page_heading(v->page, "History");
    const floe_status status = page_figures(v->page, figure, n);
    memory_free(v->page->ctx, &list);
    return status;
}

/* The ledger: what there was, what came and went, what there is. */
static const char *const kinds[] = {"boundary", "source", "damping", "defect"};
enum { N_KINDS = sizeof kinds / sizeof kinds[0] };

static double at_row(const csv_table *t, const char *name, size_t row)
{
    const csv_column *c = csv_find(t, name);
    return c ? c->value[row] : (double)NAN;
}

/* Energy is the sum of three columns. */
static double ledger_amount(const csv_table *t, const char *quantity, size_t row)
{
    if (strcmp(quantity, "energy") != 0) return at_row(t, quantity, row);
    return at_row(t, "kinetic", row) + at_row(t, "strain", row) + at_row(t, "internal", row);
}

static void ledger_row(strbuf *out, const csv_table *t, const char *quantity)
{
    char name[CSV_NAME];
    const size_t last = t->n_rows - 1;
    (void)snprintf(name, sizeof name, "ledger_%s_boundary", quantity);
    const csv_column *first = csv_find(t, name);
    if (!first) return;
    char text[CSV_NAME];
    label_with_unit(text, quantity, first->unit);
    for (char *c = text; *c; c++) {
        if (*c == '_') *c = ' ';
    }
    html_row_begin(out);
    html_cell(out, text);
    html_cell_number(out, ledger_amount(t, quantity, 0), 6);
    for (int k = 0; k < N_KINDS; k++) {
        (void)snprintf(name, sizeof name, "ledger_%s_%s", quantity, kinds[k]);
        html_cell_number(out, at_row(t, name, last), 4);
    }
    html_cell_number(out, ledger_amount(t, quantity, last), 6);
    (void)snprintf(name, sizeof name, "drift_%s", quantity);
    html_cell_number(out, at_row(t, name, last), 2);
    html_row_end(out);
}

static void write_ledger_table(const run_view *v, const csv_table *t)
{
    static const char *const quantity[] = {"mass",       "momentum_x", "momentum_y", "momentum_z",
                                           "momentum_r", "momentum_t", "energy"};
    strbuf *out = &v->page->body;
    if (!csv_find(t, "ledger_mass_boundary")) return;
    page_heading(v->page, "Conservation");
    html_table_begin(out, "|#at the start|#through the boundary|#from sources|#taken by damping|#lost to floors and "
                          "guards|#at the end|#drift");
    for (size_t i = 0; i < sizeof quantity / sizeof quantity[0]; i++) ledger_row(out, t, quantity[i]);
    html_table_end(out);
    strbuf_append(out,
                  "<p class=\"note\">The drift is what the ledger does not explain, relative to what was there at the "
                  "start and came in.</p>\n");
}

/* Which bound the time step had, by the number of steps. */
static void write_step_limits(const run_view *v, const csv_table *t)
{
    strbuf *out = &v->page->body;
    const csv_column *limit = csv_find(t, "dt_limit"), *steps = csv_find(t, "steps");
    const char *name[32];
    double taken[32], sum = 0.0;
    int n = 0;
    if (!limit || !steps || t->n_rows < 2) return;
    for (size_t i = 1; i < t->n_rows; i++) {
        int k = 0;
        while (k < n && strcmp(name[k], limit->text[i]) != 0) k++;
        if (k == 32) continue;
        if (k == n) {
            name[n] = limit->text[i];
            taken[n++] = 0.0;
        }
        taken[k] += steps->value[i] - steps->value[i - 1];
        sum += steps->value[i] - steps->value[i - 1];
    }
    if (!(sum > 0.0)) return;
    page_heading(v->page, "What bounded the time step");
    html_table_begin(out, "bound|#share|");
    for (int k = 0; k < n; k++) {
        html_row_begin(out);
        html_cell(out, name[k]);
        strbuf_append(out,
                      "<td class=\"number\">%.0f %%</td><td class=\"bar\"><span style=\"width:%.1f%%\"></span></td>",
                      100.0 * taken[k] / sum, 100.0 * taken[k] / sum);
        html_row_end(out);
    }
    html_table_end(out);
}

floe_status run_history(const run_view *v)
{
    char path[PAGE_PATH + 32];
    csv_table t;
    (void)snprintf(path, sizeof path, "%s/history.csv", v->dir);
    if (!file_exists(path)) return FLOE_OK;
    floe_status status = csv_read(&t, v->page->ctx, path);
    if (status == FLOE_OK && t.n_rows > 0) {
        write_ledger_table(v, &t);
        if (!v->brief) write_step_limits(v, &t);
        status = draw_histories(v, &t);
    }
    csv_free(&t);
    return status;
}
