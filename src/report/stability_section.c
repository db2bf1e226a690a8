/* The folder of `floe stability`. */
#include "base/memory.h"
#include "base/text.h"
#include "report/html.h"
#include "report/page.h"
#include "report/run_section.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CURVES = 24 };

typedef struct stability_view {
    page *page; /* not owned */
    const char *dir;
    const json_t *object; /* not owned */
    json_t *runs, *limits, *each, *over;
    bool is_map;
} stability_view;

/* The first key of `over`, "" if none. */
static const char *first_key(json_t *object)
{
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value) return key;
    return "";
}

/* "method.stress = usl, domain.lattice_offset = 0", or the values alone. */
static void settings_text(json_t *settings, bool keys, char *text, size_t size)
{
    const char *key;
    json_t *value;
    text[0] = '\0';
    json_object_foreach(settings, key, value)
    {
        const char *word = json_string_value(value);
        text_add(text, size, "%s%s%s%s", text[0] ? ", " : "", keys ? key : "", keys ? " = " : "", word ? word : "");
    }
}

/* A cell for each key of the settings that the search was made for. */
static void append_setting_cells(const stability_view *v, const json_t *settings, strbuf *out)
{
    const char *key;
    json_t *value;
    json_object_foreach(v->each, key, value) html_cell(out, json_text_of(settings, key));
}

static void settings_names(const stability_view *v, strbuf *names)
{
    const char *key;
    json_t *value;
    json_object_foreach(v->each, key, value) strbuf_append(names, "%s|", key);
}

static void limits_table(const stability_view *v)
{
    strbuf *out = &v->page->body;
    const double reference = json_number_of(v->object, "relative_to");
    strbuf names;
    strbuf_init(&names, v->page->ctx);
    settings_names(v, &names);
    strbuf_append(&names, "outcome|#stable at|#unstable at|%s#runs",
                  isfinite(reference) ? "#stable, relative|#unstable, relative|" : "");
    page_heading(v->page, "Limits");
    html_table_begin(out, strbuf_string(&names));
    strbuf_free(&names);
    for (size_t i = 0; i < json_array_size(v->limits); i++) {
        const json_t *limit = json_array_get(v->limits, i);
        html_row_begin(out);
        append_setting_cells(v, json_object_get(limit, "each"), out);
        html_cell_status(out, json_text_of(limit, "outcome"));
        html_cell_number(out, json_number_of(limit, "stable"), 5);
        html_cell_number(out, json_number_of(limit, "unstable"), 5);
        if (isfinite(reference)) {
            html_cell_number(out, json_number_of(limit, "stable_over_reference"), 5);
            html_cell_number(out, json_number_of(limit, "unstable_over_reference"), 5);
        }
        html_cell_count(out, json_number_of(limit, "runs"));
        html_row_end(out);
    }
    html_table_end(out);
    if (isfinite(reference)) {
        strbuf_append(out, "<p class=\"note\">Relative to ");
        html_number(out, reference, 6);
        strbuf_append(out, ".</p>\n");
    }
}

/* The verdict on one pair of values; "" where there is none. */
static const char *verdict_at(const stability_view *v, const json_t *each, const char *const key[2],
                              const char *const value[2])
{
    for (size_t i = 0; i < json_array_size(v->runs); i++) {
        const json_t *run = json_array_get(v->runs, i), *over = json_object_get(run, "over");
        if (strcmp(json_text_of(over, key[0]), value[0]) == 0 && strcmp(json_text_of(over, key[1]), value[1]) == 0 &&
            json_equal(json_object_get(run, "each"), each))
            return json_text_of(run, "verdict");
    }
    return "";
}

static const char *text_at(const json_t *list, size_t i)
{
    const char *text = json_string_value(json_array_get(list, i));
    return text ? text : "";
}

static void map_table(const stability_view *v, json_t *each, const char *const key[2])
{
    strbuf *out = &v->page->body;
    const json_t *rows = json_object_get(v->over, key[0]), *columns = json_object_get(v->over, key[1]);
    strbuf names;
    strbuf_init(&names, v->page->ctx);
    strbuf_append(&names, "%s ↓ %s →", key[0], key[1]);
    for (size_t k = 0; k < json_array_size(columns); k++) strbuf_append(&names, "|%s", text_at(columns, k));
    html_table_begin(out, strbuf_string(&names));
    strbuf_free(&names);
    for (size_t i = 0; i < json_array_size(rows); i++) {
        html_row_begin(out);
        html_cell(out, text_at(rows, i));
        for (size_t k = 0; k < json_array_size(columns); k++) {
            const char *const value[] = {text_at(rows, i), text_at(columns, k)};
            const char *verdict = verdict_at(v, each, key, value);
            strbuf_append(out, "<td>");
            if (verdict[0]) html_status(out, verdict);
            strbuf_append(out, "</td>");
        }
        html_row_end(out);
    }
    html_table_end(out);
}

/* A map for each combination of the other keys, in the order in which runs have them. */
static void write_stability_maps(const stability_view *v)
{
    const char *key[2] = {"", ""}, *name;
    json_t *values;
    size_t n = 0;
    json_object_foreach(v->over, name, values)
    {
        if (n < 2) key[n++] = name;
    }
    page_heading(v->page, "Map");
    for (size_t i = 0; i < json_array_size(v->runs); i++) {
        json_t *each = json_object_get(json_array_get(v->runs, i), "each");
        bool known = false;
        for (size_t k = 0; k < i && !known; k++)
            known = json_equal(each, json_object_get(json_array_get(v->runs, k), "each"));
        if (known) continue;
        char text[PAGE_TEXT];
        settings_text(each, true, text, sizeof text);
        if (text[0]) {
            strbuf_append(&v->page->body, "<p>");
            html_text(&v->page->body, "%s", text);
            strbuf_append(&v->page->body, "</p>\n");
        }
        map_table(v, each, key);
    }
}

static void runs_table(const stability_view *v)
{
    strbuf *out = &v->page->body;
    const char *key;
    json_t *value;
    strbuf names;
    strbuf_init(&names, v->page->ctx);
    settings_names(v, &names);
    json_object_foreach(v->over, key, value) strbuf_append(&names, "#%s|", key);
    strbuf_append(&names, "verdict|#energy, largest ratio|#steps|#rejected|cause");
    html_fold_begin(out, "All runs");
    html_table_begin(out, strbuf_string(&names));
    strbuf_free(&names);
    for (size_t i = 0; i < json_array_size(v->runs); i++) {
        const json_t *run = json_array_get(v->runs, i), *over = json_object_get(run, "over");
        html_row_begin(out);
        append_setting_cells(v, json_object_get(run, "each"), out);
        json_object_foreach(v->over, key, value)
        {
            html_number_cell(out);
            html_text(out, "%s", json_text_of(over, key));
            html_cell_end(out);
        }
        html_cell_status(out, json_text_of(run, "verdict"));
        html_cell_number(out, json_number_of(run, "energy_ratio"), 5);
        html_cell_count(out, json_number_of(run, "steps"));
        html_cell_count(out, json_number_of(run, "rejected_steps"));
        strbuf_append(out, "<td class=\"wide\">");
        html_text(out, "%s", json_text_of(run, "cause"));
        strbuf_append(out, "</td>");
        html_row_end(out);
    }
    html_table_end(out);
    html_fold_end(out);
}

/* The largest ratio of energy over the value, a curve for each combination. */
typedef struct energy_plot {
    char name[MAX_CURVES][PAGE_TEXT];
    plot_series series[MAX_CURVES];
    double *x, *y; /* counted memory: a row of all runs for each curve */
    size_t n;
} energy_plot;

static void add_point(energy_plot *e, size_t reserved, const char *name, double x, double y)
{
    size_t k = 0;
    while (k < e->n && strcmp(e->name[k], name) != 0) k++;
    if (k == MAX_CURVES) return;
    plot_series *s = &e->series[k];
    if (k == e->n) {
        e->n++;
        (void)snprintf(e->name[k], PAGE_TEXT, "%s", name);
        *s = (plot_series){.name = e->name[k],
                           .style = PLOT_POINTS,
                           .colour = (int)k,
                           .x = e->x + k * reserved,
                           .y = e->y + k * reserved};
    }
    e->x[k * reserved + s->n] = x;
    e->y[k * reserved + s->n] = y;
    s->n++;
}

static void fill_energy_plot(energy_plot *e, const stability_view *v, const char *key)
{
    for (size_t i = 0; i < json_array_size(v->runs); i++) {
        const json_t *run = json_array_get(v->runs, i);
        const char *value = json_text_of(json_object_get(run, "over"), key);
        char name[PAGE_TEXT], *end;
        const double x = strtod(value, &end);
        if (end == value) continue;
        settings_text(json_object_get(run, "each"), false, name, sizeof name);
        add_point(e, json_array_size(v->runs), name[0] ? name : key, x, json_number_of(run, "energy_ratio"));
    }
}

static floe_status energy_figure(const stability_view *v, const char *stem)
{
    page *p = v->page;
    energy_plot *e;
    const size_t reserved = json_array_size(v->runs);
    const char *key = first_key(v->over);
    char name[PLOT_STEM];
    if (v->is_map || reserved == 0) return FLOE_OK;
    TRY(memory_new(p->ctx, &e, 1, sizeof *e));
    floe_status status = memory_new(p->ctx, &e->x, MAX_CURVES * reserved, sizeof *e->x);
    if (status == FLOE_OK) status = memory_new(p->ctx, &e->y, MAX_CURVES * reserved, sizeof *e->y);
    if (status == FLOE_OK) {
        fill_energy_plot(e, v, key);
        (void)snprintf(name, sizeof name, "%.90s-energy", stem);
        const plot_panel panel = {.x_label = key,
                                  .y_label = "energy over what there can be",
                                  .log_y = true,
                                  .series = e->series,
                                  .n_series = e->n};
        const plot_figure figure = {
            .name = name, .title = "Growth of energy", .untitled = true, .panel = &panel, .n_panels = 1};
        status = page_figures(p, &figure, 1);
    }
    memory_free(p->ctx, &e->y);
    memory_free(p->ctx, &e->x);
    memory_free(p->ctx, &e);
    return status;
}

/* The first limit, or how many there are. */
static void write_stability_summary(const stability_view *v, const char *title)
{
    strbuf *out = &v->page->summary;
    const json_t *limit = json_array_get(v->limits, 0);
    const size_t n = json_array_size(v->limits);
    strbuf_append(out, "<li><a href=\"#s%d\">", v->page->sections);
    html_text(out, "%s", title);
    strbuf_append(out, "</a><br />%zu runs", json_array_size(v->runs));
    if (v->is_map) strbuf_append(out, ", a map of two keys");
    if (n > 1) strbuf_append(out, ", %zu limits", n);
    if (n == 1 && isfinite(json_number_of(limit, "stable"))) {
        html_text(out, "; stable at %s = ", first_key(v->over));
        html_number(out, json_number_of(limit, "stable"), 5);
        strbuf_append(out, ", unstable at ");
        html_number(out, json_number_of(limit, "unstable"), 5);
    }
    strbuf_append(out, "</li>\n");
}

static floe_status write_stability_section(const stability_view *v)
{
    char title[PAGE_TEXT], stem[PLOT_STEM];
    page *p = v->page;
    strbuf *out = &p->body;
    (void)snprintf(title, sizeof title, "%.400s", json_text_of(v->object, "title"));
    if (!title[0]) (void)snprintf(title, sizeof title, "%.400s", base_name(v->dir));
    page_section_begin(p, title);
    (void)snprintf(stem, sizeof stem, "%02d-%.90s", p->sections, base_name(v->dir));
    write_stability_summary(v, title);
    strbuf_append(out, "<p>%zu runs of <code>", json_array_size(v->runs));
    html_text(out, "%s", json_text_of(v->object, "deck"));
    strbuf_append(out, "</code>. What counts as ");
    html_text(out, "%s", json_text_of(v->object, "criterion"));
    strbuf_append(out, ".</p>\n");
    if (v->is_map) {
        write_stability_maps(v);
    } else {
        limits_table(v);
    }
    TRY(energy_figure(v, stem));
    runs_table(v);
    page_section_end(p);
    return FLOE_OK;
}

floe_status report_stability(page *p, const char *dir)
{
    json_t *object;
    TRY(page_read_json(p, dir, "stability.json", &object));
    const stability_view v = {.page = p,
                              .dir = dir,
                              .object = object,
                              .runs = json_object_get(object, "runs"),
                              .limits = json_object_get(object, "limits"),
                              .each = json_object_get(object, "each"),
                              .over = json_object_get(object, "over"),
                              .is_map = json_object_size(json_object_get(object, "over")) > 1};
    const floe_status status = write_stability_section(&v);
    json_decref(object);
    return status;
}
