/* Cases in words and as a table. */
#include "base/memory.h"
#include "report/case_list.h"
#include "report/html.h"
#include "run/run_errors.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* The case of least error; NULL if none has one. */
static const case_entry *most_exact(const case_list *c, const char *metric)
{
    const case_entry *best = NULL;
    for (size_t i = 0; i < c->n; i++) {
        const case_entry *e = &c->list[i];
        if (isfinite(case_error(e, metric)) && (!best || case_error(e, metric) < case_error(best, metric))) best = e;
    }
    return best;
}

static void append_case(const case_list *c, const case_entry *e, strbuf *out)
{
    char title[PAGE_TEXT];
    case_title(c, e, title);
    html_text(out, "%s", title);
}

bool case_say_least(const case_list *c, const char *metric, strbuf *out)
{
    const case_entry *best = most_exact(c, metric);
    if (!best) return false;
    html_text(out, "Least %s: ", metric);
    strbuf_append(out, "<b>");
    html_error(out, metric, case_error(best, metric), c->dimensionless);
    strbuf_append(out, "</b> by ");
    append_case(c, best, out);
    strbuf_append(out, ", in ");
    html_seconds(out, best->wall);
    strbuf_append(out, ".");
    return true;
}

static void append_setting_cells(const case_list *c, size_t i, const char *name, strbuf *out)
{
    for (int k = 0; k < c->n_axes; k++) {
        strbuf_append(out, k == 0 ? "<td><a href=\"#%s-%zu\">" : "<td>", name, i + 1);
        html_text(out, "%s", case_setting(&c->list[i], c->axes[k]));
        strbuf_append(out, k == 0 ? "</a></td>" : "</td>");
    }
}

static void time_cell(const case_entry *e, strbuf *out)
{
    html_number_cell(out);
    html_seconds(out, e->wall);
    if (e->disturbed) strbuf_append(out, "<span title=\"others used the machine meanwhile\"> *</span>");
    html_cell_end(out);
}

static void table_row(const case_list *c, size_t i, const char *name, strbuf *out)
{
    const case_entry *e = &c->list[i];
    html_row_begin(out);
    append_setting_cells(c, i, name, out);
    html_cell_status(out, e->status);
    for (int k = 0; k < c->n_metrics; k++) {
        html_cell_error(out, c->metric[k], json_number_of(json_object_get(e->run, "errors"), c->metric[k]),
                        c->dimensionless);
    }
    for (int k = 0; k < c->n_quantities; k++)
        html_cell_number(out, json_number_of(json_object_get(e->run, "quantities"), c->quantity[k]), 6);
    time_cell(e, out);
    html_cell_count(out, json_number_of(e->run, "steps"));
    html_cell_count(out, json_number_of(e->run, "points"));
    html_cell_count(out, json_number_of(e->run, "cells"));
    html_cell_number(out, json_number_of(json_object_get(e->run, "conservation"), "energy"), 2);
    html_row_end(out);
}

void case_table(const case_list *c, const char *name, strbuf *out)
{
    bool disturbed = false;
    strbuf names;
    strbuf_init(&names, c->ctx);
    for (int k = 0; k < c->n_axes; k++) strbuf_append(&names, "%s|", c->axes[k]);
    strbuf_append(&names, "result");
    for (int k = 0; k < c->n_metrics; k++) strbuf_append(&names, "|#%s", c->metric[k]);
    for (int k = 0; k < c->n_quantities; k++) strbuf_append(&names, "|#%s", c->quantity[k]);
    strbuf_append(&names, "|#run time without outputs|#steps|#points|#cells|#energy drift");
    html_table_begin(out, strbuf_string(&names));
    strbuf_free(&names);
    for (size_t i = 0; i < c->n; i++) {
        table_row(c, i, name, out);
        disturbed = disturbed || c->list[i].disturbed;
    }
    html_table_end(out);
    if (disturbed)
        strbuf_append(out, "<p class=\"note\">* Other programs used the machine while this case was timed.</p>\n");
}
