/* The folders of `floe compare` and `floe study`. */
#include "base/memory.h"
#include "report/case_list.h"
#include "report/html.h"
#include "report/run_section.h"

#include <ctype.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

/* What the sections of one study share. */
typedef struct study_view {
    page *page; /* not owned */
    const char *dir, *file;
    const json_t *object; /* not owned */
    case_list cases;      /* owned */
    char name[32];        /* before the names that links refer to */
    char stem[PLOT_STEM]; /* before the names of its plots */
} study_view;

/* A number with its standard error. */
static void number_with_error_cells(strbuf *out, double value, double error)
{
    html_number_cell(out);
    if (isfinite(value)) strbuf_append(out, "%.2f", value);
    html_cell_end(out);
    html_number_cell(out);
    if (isfinite(error)) {
        strbuf_append(out, "±%.2f", error);
    } else {
        strbuf_append(out, "–");
    }
    html_cell_end(out);
}

/* Orders of neighbouring cases, "1.92, 1.98". */
static void pairs_cell(strbuf *out, const json_t *pairs)
{
    html_number_cell(out);
    for (size_t i = 0; i < json_array_size(pairs); i++) {
        const json_t *pair = json_array_get(pairs, i);
        strbuf_append(out, "%s", i ? ", " : "");
        if (json_is_number(pair)) {
            strbuf_append(out, "%.2f", json_number_value(pair));
        } else {
            strbuf_append(out, "–");
        }
    }
    html_cell_end(out);
}

static void order_row(strbuf *out, const char *group, const char *metric, const json_t *fit)
{
    const double order = json_number_of(fit, "order");
    if (!isfinite(order)) return;
    html_row_begin(out);
    html_cell(out, metric);
    html_cell(out, group);
    number_with_error_cells(out, order, json_number_of(fit, "stderr"));
    pairs_cell(out, json_object_get(fit, "pairs"));
    html_row_end(out);
}

/* {group: {metric: {order, stderr, pairs}}} as one table, metric by metric. */
static void write_orders(const study_view *v)
{
    strbuf *out = &v->page->body;
    const case_list *c = &v->cases;
    json_t *list = json_object_get(v->object, "orders"), *fits;
    const char *group;
    bool any = false;
    for (int k = 0; k < c->n_metrics; k++) {
        json_object_foreach(list, group, fits) any =
            any || isfinite(json_number_of(json_object_get(fits, c->metric[k]), "order"));
    }
    if (!any) return;
    page_heading(v->page, "Order of accuracy");
    html_table_begin(out, "metric|cases|#order|#standard error|#by pairs");
    for (int k = 0; k < c->n_metrics; k++) {
        json_object_foreach(list, group, fits) order_row(out, group, c->metric[k], json_object_get(fits, c->metric[k]));
    }
    html_table_end(out);
    if (c->axis[0] && strcmp(c->axis, "domain.cell") != 0) {
        strbuf_append(out, "<p class=\"note\">In ");
        html_text(out, "%s", c->axis);
        strbuf_append(out, ".</p>\n");
    }
}

static void limit_row(strbuf *out, const char *group, const char *quantity, const json_t *limit)
{
    if (!json_is_object(limit)) return;
    html_row_begin(out);
    html_cell(out, quantity);
    html_cell(out, group);
    html_cell_number(out, json_number_of(limit, "value"), 6);
    html_cell_number(out, json_number_of(limit, "order"), 3);
    html_number_cell(out);
    html_number(out, 100.0 * json_number_of(limit, "gci_relative"), 3);
    strbuf_append(out, " %%");
    html_cell_end(out);
    html_cell(out, json_text_of(limit, "kind"));
    html_row_end(out);
}

/* {group: {quantity: Richardson's extrapolation}} */
static void write_extrapolations(const study_view *v)
{
    strbuf *out = &v->page->body;
    json_t *list = json_object_get(v->object, "limits"), *found;
    const char *group;
    if (v->cases.n_quantities == 0 || json_object_size(list) == 0) return;
    page_heading(v->page, "Limits for ever finer cases");
    html_table_begin(out, "quantity|cases|#extrapolated|#order|#grid convergence index|convergence");
    for (int k = 0; k < v->cases.n_quantities; k++) {
        json_object_foreach(list, group, found)
            limit_row(out, group, v->cases.quantity[k], json_object_get(found, v->cases.quantity[k]));
    }
    html_table_end(out);
    strbuf_append(out, "<p class=\"note\">By Richardson extrapolation; the index is that of the finest case.</p>\n");
}

static void bar_row(const study_view *v, const json_t *bar)
{
    strbuf *out = &v->page->body;
    const char *metric = json_text_of(bar, "metric");
    const bool order = strcmp(json_text_of(bar, "of"), "order") == 0;
    html_row_begin(out);
    html_cell_status(out, json_is_true(json_object_get(bar, "met")) ? "met" : "missed");
    strbuf_append(out, "<td>");
    html_text(out, "%s %s", order ? "order of" : "error", metric);
    strbuf_append(out, "</td>");
    html_cell(out, json_text_of(bar, "where"));
    html_number_cell(out);
    strbuf_append(out, order ? "at least " : "at most ");
    if (order) {
        html_number(out, json_number_of(bar, "required"), 3);
    } else {
        html_error(out, metric, json_number_of(bar, "required"), v->cases.dimensionless);
    }
    html_cell_end(out);
    html_number_cell(out);
    if (order) {
        html_number(out, json_number_of(bar, "value"), 3);
    } else {
        html_error(out, metric, json_number_of(bar, "value"), v->cases.dimensionless);
    }
    html_cell_end(out);
    html_row_end(out);
}

static void write_bars(const study_view *v)
{
    const json_t *list = json_object_get(v->object, "bars");
    if (json_array_size(list) == 0) return;
    page_heading(v->page, "What the deck requires");
    html_table_begin(&v->page->body, "|what|of|#required|#measured");
    for (size_t i = 0; i < json_array_size(list); i++) bar_row(v, json_array_get(list, i));
    html_table_end(&v->page->body);
}

/* One case, folded; the place that the table's link names is inside, so that following the link opens it. */
static floe_status write_case(const study_view *v, size_t i)
{
    page *p = v->page;
    const case_entry *e = &v->cases.list[i];
    char title[PAGE_TEXT], folder[PAGE_PATH + PAGE_TEXT];
    run_view run = {.page = p, .dir = folder, .summary = e->run, .brief = true};
    case_title(&v->cases, e, title);
    (void)snprintf(folder, sizeof folder, "%s/%.500s", v->dir, e->directory);
    (void)snprintf(run.stem, sizeof run.stem, "%s-%.90s", v->name, e->directory);
    html_fold_begin(&p->body, title);
    strbuf_append(&p->body, "<div id=\"%s-%zu\">\n", v->name, i + 1);
    TRY(run_view_write(&run));
    strbuf_append(&p->body, "</div>\n");
    html_fold_end(&p->body);
    return FLOE_OK;
}

static floe_status write_cases(const study_view *v)
{
    page_heading(v->page, "Each case");
    v->page->folded = true;
    floe_status status = FLOE_OK;
    for (size_t i = 0; i < v->cases.n && status == FLOE_OK; i++) status = write_case(v, i);
    v->page->folded = false;
    return status;
}

/* The answers that the study itself has come to, by interpolation between its timed cases. */
static const json_t *answers_of(const study_view *v)
{
    return json_object_get(json_object_get(v->object, "timing"), "answers");
}

/* A sentence of the study's, with a capital and a full stop. */
static void append_sentence(const char *text, strbuf *out)
{
    html_text(out, "%c%s.", toupper((unsigned char)text[0]), text[0] ? text + 1 : "");
}

/* The answers of one metric; with `all` false, only the one of the least error that is reached. */
static void own_answers(const study_view *v, const char *metric, bool all, strbuf *out)
{
    const json_t *list = answers_of(v), *last = NULL;
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *one = json_array_get(list, i);
        if (strcmp(json_text_of(one, "metric"), metric) != 0) continue;
        if (json_is_string(json_object_get(one, "best"))) last = one;
        if (!all) continue;
        strbuf_append(out, "<br />");
        append_sentence(json_text_of(one, "text"), out);
    }
    if (all || !last) return;
    strbuf_append(out, "<br />");
    append_sentence(json_text_of(last, "text"), out);
}

/* What a person wants first, an item for each of the first metrics. */
static void append_answers(const study_view *v, int metrics, bool all, strbuf *out)
{
    const case_list *c = &v->cases;
    for (int k = 0; k < c->n_metrics && k < metrics; k++) {
        strbuf_append(out, "<li>");
        if (!case_say_least(c, c->metric[k], out)) html_text(out, "No case has a %s.", c->metric[k]);
        own_answers(v, c->metric[k], all, out);
        strbuf_append(out, "</li>\n");
    }
}

static size_t count_status(const case_list *c, bool done)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n; i++) n += case_is_done(&c->list[i]) == done;
    return n;
}

static size_t count_missed(const study_view *v)
{
    const json_t *list = json_object_get(v->object, "bars");
    size_t n = 0;
    for (size_t i = 0; i < json_array_size(list); i++)
        n += !json_is_true(json_object_get(json_array_get(list, i), "met"));
    return n;
}

static void write_study_summary(const study_view *v, const char *title)
{
    page *p = v->page;
    strbuf *out = &p->summary;
    const size_t bad = count_status(&v->cases, false), missed = count_missed(v);
    const size_t required = json_array_size(json_object_get(v->object, "bars"));
    strbuf_append(out, "<li><a href=\"#s%d\">", p->sections);
    html_text(out, "%s", title);
    strbuf_append(out, "</a> ");
    if (required > 0) html_status(out, missed > 0 ? "missed" : "met");
    strbuf_append(out, "<br />%zu cases", v->cases.n);
    if (bad > 0) strbuf_append(out, ", of which %zu did not come to an end", bad);
    if (required > 0) strbuf_append(out, "; %zu of %zu requirements met", required - missed, required);
    strbuf_append(out, "<ul>\n");
    append_answers(v, 1, false, out);
    strbuf_append(out, "</ul></li>\n");
}

static void write_introduction(const study_view *v)
{
    strbuf *out = &v->page->body;
    const case_list *c = &v->cases;
    strbuf_append(out, "<p>%zu cases of <code>", c->n);
    html_text(out, "%s", json_text_of(v->object, "deck"));
    strbuf_append(out, "</code>, over ");
    for (int k = 0; k < c->n_axes; k++) html_text(out, "%s%s", k ? ", " : "", c->axes[k]);
    strbuf_append(out, ".</p>\n");
}

static void write_study_facts(const study_view *v)
{
    strbuf *out = &v->page->body;
    const double repeat = json_number_of(json_object_get(v->object, "timing"), "repeat");
    html_facts_begin(out);
    if (v->cases.n > 0) run_build_facts(out, v->cases.list[0].run, v->dir, v->file);
    char text[PAGE_TEXT];
    (void)snprintf(text, sizeof text, "the best of %.0f, alone on one thread", repeat);
    if (isfinite(repeat))
        html_fact_text(out, "Times", repeat > 0.0 ? text : "of one run each, beside whatever else ran");
    html_facts_end(out);
}

static floe_status write_study_section(study_view *v)
{
    char title[PAGE_TEXT];
    page *p = v->page;
    (void)snprintf(title, sizeof title, "%.400s", json_text_of(v->object, "title"));
    if (!title[0]) (void)snprintf(title, sizeof title, "%.400s", base_name(v->dir));
    page_section_begin(p, title);
    (void)snprintf(v->name, sizeof v->name, "%02d", p->sections);
    (void)snprintf(v->stem, sizeof v->stem, "%02d-%.90s", p->sections, base_name(v->dir));
    write_study_summary(v, title);
    write_introduction(v);
    strbuf_append(&p->body, "<ul class=\"answers\">\n");
    append_answers(v, CASE_MAX_METRICS, true, &p->body);
    strbuf_append(&p->body, "</ul>\n");
    write_bars(v);
    TRY(case_plots(p, &v->cases, v->stem));
    page_heading(p, "Cases");
    case_table(&v->cases, v->name, &p->body);
    write_study_facts(v);
    write_orders(v);
    write_extrapolations(v);
    TRY(run_profile(p, v->dir, "profiles.csv", v->stem, "group"));
    TRY(write_cases(v));
    page_section_end(p);
    return FLOE_OK;
}

static floe_status report_cases(page *p, const char *dir, const char *file)
{
    json_t *object;
    TRY(page_read_json(p, dir, file, &object));
    study_view v = {.page = p, .dir = dir, .file = file, .object = object};
    floe_status status = case_list_read(&v.cases, p->ctx, object);
    if (status == FLOE_OK) status = write_study_section(&v);
    case_list_free(&v.cases);
    json_decref(object);
    return status;
}

floe_status report_compare(page *p, const char *dir)
{
    return report_cases(p, dir, "compare.json");
}

floe_status report_study(page *p, const char *dir)
{
    return report_cases(p, dir, "study.json");
}

floe_status report_title(page *p, const char *dir, char title[PAGE_TEXT])
{
    static const char *const files[] = {"stability.json", "study.json", "compare.json"};
    title[0] = '\0';
    for (size_t i = 0; i < sizeof files / sizeof files[0] && !title[0]; i++) {
        json_t *object;
        TRY(page_read_json(p, dir, files[i], &object));
        (void)snprintf(title, PAGE_TEXT, "%.400s", json_text_of(object, "title"));
        json_decref(object);
    }
    return title[0] ? FLOE_OK : run_title(p, dir, title);
}
