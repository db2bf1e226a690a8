/* `floe run`'s folder: what was run, and what came of it. */
#include "report/run_section.h"

#include "base/memory.h"
#include "report/html.h"

#include <jansson.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

enum { MAX_STAGES = 256 };

const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

void plot_name(const run_view *v, const char *name, char out[PLOT_STEM])
{
    (void)snprintf(out, PLOT_STEM, "%.80s-%.40s", v->stem, name);
}

/* The value of a key at the left of a deck as floe writes it, without its quotes; "" if there is none. */
static void top_key(const char *deck, const char *key, char out[PAGE_TEXT])
{
    const size_t length = strlen(key);
    out[0] = '\0';
    for (const char *line = deck; line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        if (strncmp(line, key, length) != 0 || strncmp(line + length, ": ", 2) != 0) continue;
        const char *value = line + length + 2;
        size_t n = 0;
        const bool quoted = *value == '"';
        for (value += quoted; *value && *value != '\n' && !(quoted && *value == '"') && n < PAGE_TEXT - 1; value++) {
            if (quoted && *value == '\\' && value[1]) value++;
            out[n++] = *value;
        }
        out[n] = '\0';
        return;
    }
}

floe_status run_title(page *p, const char *dir, char title[PAGE_TEXT])
{
    char *deck;
    TRY(page_read_text(p, dir, "deck.yaml", &deck));
    title[0] = '\0';
    if (deck) top_key(deck, "title", title);
    memory_free(p->ctx, &deck);
    if (!title[0]) (void)snprintf(title, PAGE_TEXT, "%s", base_name(dir));
    return FLOE_OK;
}

static bool is_end(const char *status)
{
    return strcmp(status, "done") == 0 || strcmp(status, "at_rest") == 0;
}

/* "     4.773 s  info     diverged at ...": what is said on the last line. */
static void last_message(const char *log, const char *status, char cause[PAGE_TEXT])
{
    size_t end = strlen(log), begin;
    while (end > 0 && log[end - 1] == '\n') end--;
    for (begin = end; begin > 0 && log[begin - 1] != '\n';) begin--;
    const char *text = strstr(log + begin, " s  ");
    if (!text) return;
    text += 4;
    text += strcspn(text, " ");
    text += strspn(text, " ");
    /* The status itself stands beside it. */
    if (strncmp(text, status, strlen(status)) == 0) text += strlen(status) + 1;
    if (text < log + end) (void)snprintf(cause, PAGE_TEXT, "%.*s", (int)(log + end - text), text);
}

/* Why a run has not come to its end, by its summary or, of older runs, its log; "" when it has, or neither says. */
static floe_status run_cause(page *p, const char *dir, const json_t *summary, char cause[PAGE_TEXT])
{
    const char *status = json_text_of(summary, "status");
    char *log;
    (void)snprintf(cause, PAGE_TEXT, "%.500s", json_text_of(summary, "message"));
    if (cause[0] || is_end(status)) return FLOE_OK;
    TRY(page_read_text(p, dir, "run.log", &log));
    if (log) last_message(log, status, cause);
    memory_free(p->ctx, &log);
    return FLOE_OK;
}

static void count_fact(strbuf *out, const json_t *summary, const char *key, const char *name)
{
    const double value = json_number_of(summary, key);
    if (!(value > 0.0)) return;
    html_fact(out, name);
    html_count(out, value);
    html_fact_end(out);
}

/* Updates a second: what a step costs. */
static void rate_fact(strbuf *out, const json_t *summary)
{
    const double points = json_number_of(summary, "point_updates"), cells = json_number_of(summary, "cell_updates");
    const double updates = (points > 0.0 ? points : 0.0) + (cells > 0.0 ? cells : 0.0);
    const double seconds = json_number_of(summary, "wall_seconds");
    if (!(updates > 0.0) || !(seconds > 0.0)) return;
    html_fact(out, "Updates per second");
    html_number(out, updates / seconds, 3);
    html_fact_end(out);
}

static void memory_fact(strbuf *out, const json_t *summary)
{
    const double bytes = json_number_of(json_object_get(summary, "memory"), "peak_rss_bytes");
    if (!(bytes > 0.0)) return;
    html_fact(out, "Memory, at most");
    html_bytes(out, bytes);
    html_fact_end(out);
}

/* When a file of the folder was written. */
static void date_fact(strbuf *out, const char *dir, const char *name)
{
    char path[PAGE_PATH + 64], text[64] = "";
    struct stat file;
    struct tm date;
    (void)snprintf(path, sizeof path, "%s/%s", dir, name);
    if (stat(path, &file) != 0 || !gmtime_r(&file.st_mtime, &date)) return;
    if (strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &date) > 0) html_fact_text(out, "Finished", text);
}

void run_build_facts(strbuf *out, const json_t *summary, const char *dir, const char *file)
{
    const json_t *build = json_object_get(summary, "floe");
    const double threads = json_number_of(build, "threads");
    if (threads > 0.0) {
        html_fact(out, "Threads");
        html_count(out, threads);
        html_fact_end(out);
    }
    html_fact_text(out, "Machine", json_text_of(build, "machine"));
    if (json_text_of(build, "version")[0]) {
        char text[PAGE_TEXT];
        (void)snprintf(text, sizeof text, "%.60s (%.60s)", json_text_of(build, "version"), json_text_of(build, "git"));
        html_fact_text(out, "floe", text);
        (void)snprintf(text, sizeof text, "%.100s, %.300s", json_text_of(build, "compiler"),
                       json_text_of(build, "flags"));
        html_fact_text(out, "Compiler", text);
    }
    date_fact(out, dir, file);
}

static void write_run_facts(const run_view *v)
{
    strbuf *out = &v->page->body;
    const json_t *s = v->summary;
    const double rejected = json_number_of(s, "rejected_steps");
    html_facts_begin(out);
    html_fact_text(out, "Coupling", json_text_of(s, "coupling"));
    html_fact(out, "Time reached");
    html_number(out, json_number_of(s, "time"), 4);
    if (!v->dimensionless) strbuf_append(out, " s");
    html_fact_end(out);
    html_fact(out, "Steps");
    html_count(out, json_number_of(s, "steps"));
    if (rejected > 0.0) {
        strbuf_append(out, ", and ");
        html_count(out, rejected);
        strbuf_append(out, " rejected");
    }
    html_fact_end(out);
    html_fact(out, "Run time");
    html_seconds(out, json_number_of(s, "wall_seconds"));
    html_fact_end(out);
    count_fact(out, s, "points", "Points");
    count_fact(out, s, "cells", "Cells");
    rate_fact(out, s);
    memory_fact(out, s);
    if (!v->brief) {
        run_build_facts(out, v->summary, v->dir, "summary.json");
        html_fact_text(out, "Deck", json_text_of(s, "deck"));
    }
    html_facts_end(out);
}

static void write_run_errors(const run_view *v)
{
    strbuf *out = &v->page->body;
    json_t *list = json_object_get(v->summary, "errors"), *value;
    const char *name;
    if (json_object_size(list) == 0) return;
    page_heading(v->page, "Errors against the exact solution");
    html_table_begin(out, "metric|#error");
    json_object_foreach(list, name, value)
    {
        html_row_begin(out);
        html_cell(out, name);
        html_cell_error(out, name, json_is_number(value) ? json_number_value(value) : (double)NAN, v->dimensionless);
        html_row_end(out);
    }
    html_table_end(out);
}

typedef struct stage_time {
    const char *name;
    double seconds;
} stage_time;

/* The stages in falling order of their times; returns how many. */
static size_t sort_stages(const json_t *summary, stage_time list[MAX_STAGES], double *sum)
{
    const char *name;
    json_t *value, *object = json_object_get(summary, "seconds_by_stage");
    size_t n = 0;
    *sum = 0.0;
    json_object_foreach(object, name, value)
    {
        if (n == MAX_STAGES || !(json_number_value(value) > 0.0)) continue;
        const stage_time one = {name, json_number_value(value)};
        size_t k = n++;
        for (; k > 0 && list[k - 1].seconds < one.seconds; k--) list[k] = list[k - 1];
        list[k] = one;
        *sum += one.seconds;
    }
    return n;
}

static void write_stage_times(const run_view *v)
{
    strbuf *out = &v->page->body;
    stage_time list[MAX_STAGES];
    double sum;
    const size_t n = sort_stages(v->summary, list, &sum);
    if (n == 0) return;
    page_heading(v->page, "Time by stage");
    html_table_begin(out, "stage|#time|#share|");
    for (size_t i = 0; i < n; i++) {
        html_row_begin(out);
        html_cell(out, list[i].name);
        html_number_cell(out);
        html_seconds(out, list[i].seconds);
        strbuf_append(out, "</td><td class=\"number\">%.1f %%</td>", 100.0 * list[i].seconds / sum);
        strbuf_append(out, "<td class=\"bar\"><span style=\"width:%.1f%%\"></span></td>",
                      100.0 * list[i].seconds / list[0].seconds);
        html_row_end(out);
    }
    html_table_end(out);
}

static void write_counters(const run_view *v)
{
    strbuf *out = &v->page->body;
    json_t *list = json_object_get(v->summary, "counters"), *value;
    const char *name;
    if (json_object_size(list) == 0) return;
    page_heading(v->page, "Counters");
    html_facts_begin(out);
    json_object_foreach(list, name, value)
    {
        html_fact(out, name);
        html_count(out, json_is_number(value) ? json_number_value(value) : (double)NAN);
        html_fact_end(out);
    }
    html_facts_end(out);
}

/* A text file of the folder, folded. */
static floe_status write_text_file(const run_view *v, const char *name, const char *title)
{
    char *text;
    TRY(page_read_text(v->page, v->dir, name, &text));
    if (text) {
        html_fold_begin(&v->page->body, title);
        html_verbatim(&v->page->body, text);
        html_fold_end(&v->page->body);
    }
    memory_free(v->page->ctx, &text);
    return FLOE_OK;
}

/* Whether the deck says `units: none`. */
static floe_status read_units(run_view *v)
{
    char *deck, units[PAGE_TEXT] = "";
    TRY(page_read_text(v->page, v->dir, "deck.yaml", &deck));
    if (deck) top_key(deck, "units", units);
    memory_free(v->page->ctx, &deck);
    v->dimensionless = strcmp(units, "none") == 0;
    return FLOE_OK;
}

floe_status run_view_write(run_view *v)
{
    strbuf *out = &v->page->body;
    const char *status = json_text_of(v->summary, "status");
    char cause[PAGE_TEXT];
    TRY(run_cause(v->page, v->dir, v->summary, cause));
    TRY(read_units(v));
    strbuf_append(out, "<p class=\"result\">");
    html_status(out, status);
    html_text(out, " %s", cause);
    strbuf_append(out, "</p>\n");
    write_run_facts(v);
    write_run_errors(v);
    TRY(run_pictures(v));
    TRY(run_profile(v->page, v->dir, "profile.csv", v->stem, NULL));
    TRY(run_history(v));
    write_stage_times(v);
    if (!v->brief) write_counters(v);
    return write_text_file(v, "deck.yaml", "The deck as resolved, every default filled in");
}

/* What the summary at the top says of a run. */
static void write_run_summary(page *p, const char *title, const json_t *summary, const char *cause)
{
    strbuf *out = &p->summary;
    json_t *errors_of = json_object_get(summary, "errors"), *value;
    const char *name;
    bool first = true;
    strbuf_append(out, "<li><a href=\"#s%d\">", p->sections);
    html_text(out, "%s, %s", title, json_text_of(summary, "coupling"));
    strbuf_append(out, "</a> ");
    html_status(out, json_text_of(summary, "status"));
    strbuf_append(out, "<br />");
    if (cause[0]) html_text(out, "%s", cause);
    json_object_foreach(errors_of, name, value)
    {
        html_text(out, "%s%s ", first ? "" : ", ", name);
        html_error(out, name, json_is_number(value) ? json_number_value(value) : (double)NAN,
                   strcmp(json_text_of(summary, "units"), "none") == 0);
        first = false;
    }
    strbuf_append(out, "%s", first ? "" : ", in ");
    if (!first) html_seconds(out, json_number_of(summary, "wall_seconds"));
    strbuf_append(out, "</li>\n");
}

static floe_status write_run_section(page *p, const char *dir, const json_t *summary)
{
    char title[PAGE_TEXT], full[PAGE_TEXT + 128], cause[PAGE_TEXT];
    run_view v = {.page = p, .dir = dir, .summary = summary};
    TRY(run_title(p, dir, title));
    TRY(run_cause(p, dir, summary, cause));
    (void)snprintf(full, sizeof full, "%s, %s", title, json_text_of(summary, "coupling"));
    page_section_begin(p, full);
    (void)snprintf(v.stem, sizeof v.stem, "%02d-%.100s", p->sections, base_name(dir));
    write_run_summary(p, title, summary, cause);
    TRY(run_view_write(&v));
    TRY(write_text_file(&v, "run.log", "What floe said while running"));
    page_section_end(p);
    return FLOE_OK;
}

floe_status report_run(page *p, const char *dir)
{
    json_t *summary;
    TRY(page_read_json(p, dir, "summary.json", &summary));
    const floe_status status = write_run_section(p, dir, summary);
    json_decref(summary);
    return status;
}
