/* What the sections of a report share. */
#include "report/page.h"

#include "base/memory.h"
#include "io/file.h"
#include "report/html.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

static void list_title(page *p, int level, const char *id, const char *title)
{
    strbuf_append(&p->contents, "<li class=\"level%d\"><a href=\"#%s\">", level, id);
    strbuf_append_xml(&p->contents, title);
    strbuf_append(&p->contents, "</a></li>\n");
}

void page_section_begin(page *p, const char *title)
{
    char id[32];
    (void)snprintf(id, sizeof id, "s%d", ++p->sections);
    strbuf_append(&p->body, "<section id=\"%s\">\n<h2>", id);
    strbuf_append_xml(&p->body, title);
    strbuf_append(&p->body, "</h2>\n");
    list_title(p, 2, id, title);
    p->headings = 0;
}

void page_section_end(page *p)
{
    strbuf_append(&p->body, "</section>\n");
}

void page_heading(page *p, const char *title)
{
    char id[64];
    (void)snprintf(id, sizeof id, "s%d-%d", p->sections, ++p->headings);
    strbuf_append(&p->body, "<h3 id=\"%s\">", id);
    strbuf_append_xml(&p->body, title);
    strbuf_append(&p->body, "</h3>\n");
    if (!p->folded) list_title(p, 3, id, title);
}

double json_number_of(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

const char *json_text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

floe_status page_read_text(page *p, const char *dir, const char *name, char **out)
{
    char path[PAGE_PATH + 64];
    *out = NULL;
    (void)snprintf(path, sizeof path, "%s/%s", dir, name);
    return file_exists(path) ? file_read(p->ctx, path, out, NULL) : FLOE_OK;
}

floe_status page_read_json(page *p, const char *dir, const char *name, json_t **out)
{
    json_error_t error;
    char *text;
    *out = NULL;
    TRY(page_read_text(p, dir, name, &text));
    if (!text) return FLOE_OK;
    *out = json_loads(text, 0, &error);
    memory_free(p->ctx, &text);
    if (json_is_object(*out)) return FLOE_OK;
    json_decref(*out);
    *out = NULL;
    return fail(p->ctx, FLOE_IO, "'%s/%s' is not what floe writes (line %d: %s): make it anew, or leave the folder out",
                dir, name, error.line, error.text);
}

/* The picture, without what stands before its <svg> and without its style, which the page has once for all. */
static void append_svg(strbuf *out, const char *text)
{
    static const char style[] = "<style>", style_end[] = "</style>\n";
    const char *svg = strstr(text, "<svg"), *begin = strstr(text, style),
               *end = begin ? strstr(begin, style_end) : NULL;
    if (!svg) return;
    if (!end) {
        strbuf_append(out, "%s", svg);
        return;
    }
    strbuf_append(out, "%.*s%s", (int)(begin - svg), svg, end + strlen(style_end));
}

static floe_status append_download(page *p, const char *words, const char *stem, const char *extension,
                                   const char *type)
{
    char name[PLOT_STEM + 16];
    char *text;
    (void)snprintf(name, sizeof name, "%s.%s", stem, extension);
    TRY(page_read_text(p, p->files, name, &text));
    if (text) html_download(&p->body, words, name, type, text, strlen(text));
    memory_free(p->ctx, &text);
    return FLOE_OK;
}

/* Points of a curve: about one for each of a plot's pixels; in folded boxes, of which a page has many, fewer. */
enum { PAGE_POINTS = 400, FOLDED_POINTS = 200 };

static floe_status append_figure(page *p, const plot_figure *figure)
{
    char stem[PLOT_STEM], name[PLOT_STEM + 16];
    char *svg;
    plot_stem(figure->name, stem);
    (void)snprintf(name, sizeof name, "%s.svg", stem);
    TRY(page_read_text(p, p->files, name, &svg));
    strbuf_append(&p->body, "<figure class=\"plot\">\n<figcaption><b>");
    strbuf_append_xml(&p->body, figure->title ? figure->title : "");
    strbuf_append(&p->body, "</b> ");
    floe_status status = append_download(p, "CSV", stem, "csv", "text/csv");
    strbuf_append(&p->body, " ");
    if (status == FLOE_OK && !svg) status = append_download(p, "script", stem, "gp", "text/plain");
    strbuf_append(&p->body, "</figcaption>\n");
    if (svg) {
        append_svg(&p->body, svg);
    } else {
        strbuf_append(&p->body, "<p class=\"missing\">no drawing</p>\n");
    }
    strbuf_append(&p->body, "</figure>\n");
    memory_free(p->ctx, &svg);
    return status;
}

floe_status page_figures(page *p, const plot_figure *figure, size_t n)
{
    const size_t most = p->folded ? FOLDED_POINTS : PAGE_POINTS;
    bool thinned = false;
    if (n == 0) return FLOE_OK;
    for (size_t i = 0; i < n; i++) {
        plot_figure thin = figure[i];
        thin.most = most;
        thinned = thinned || plot_is_thinned(&thin);
        TRY(plot_write_data(p->ctx, p->files, &thin));
    }
    if (!p->no_gnuplot) TRY(plots_draw(p->ctx, p->files, figure, n, &p->no_gnuplot));
    strbuf_append(&p->body, "<div class=\"plots\">\n");
    for (size_t i = 0; i < n; i++) TRY(append_figure(p, &figure[i]));
    strbuf_append(&p->body, "</div>\n");
    p->plots += (int)n;
    if (thinned)
        strbuf_append(
            &p->body,
            "<p class=\"note\">Of curves of more than %zu points, %zu are drawn and handed out as CSV: corners, "
            "peaks and ends of lines, an even choice of clouds. The files of the results' folder hold all.</p>\n",
            most, most);
    return FLOE_OK;
}

void page_picture(page *p, const page_image *light, const page_image *dark, const char *caption)
{
    strbuf *out = &p->body;
    strbuf_append(out, "<figure class=\"picture\">\n<picture><source media=\"(prefers-color-scheme: dark)\" "
                       "srcset=\"data:image/png;base64,");
    strbuf_append_base64(out, dark->png, dark->size);
    strbuf_append(out, "\" /><img alt=\"");
    strbuf_append_xml(out, caption);
    strbuf_append(out, "\" src=\"data:image/png;base64,");
    strbuf_append_base64(out, light->png, light->size);
    strbuf_append(out, "\" /></picture>\n<figcaption>");
    strbuf_append_xml(out, caption);
    strbuf_append(out, "</figcaption>\n</figure>\n");
}
