/* From folders to the page. */
#include "report/report.h"

#include "base/memory.h"
#include "floe_build.h"
#include "io/file.h"
#include "report/html.h"
#include "report/page.h"

#include <math.h>
#include <string.h>
#include <time.h>

/* report.css, made a C array by the build. */
extern const unsigned char report_css[];
extern const size_t report_css_size;

/* What kinds of folders there are, by the file that tells; of several, the first. */
typedef struct folder_kind {
    const char *file;
    floe_status (*write)(page *p, const char *dir);
} folder_kind;

static const folder_kind kinds[] = {
    {"stability.json", report_stability},
    {"study.json", report_study},
    {"compare.json", report_compare},
    {"summary.json", report_run},
};
enum { N_KINDS = sizeof kinds / sizeof kinds[0] };

static bool folder_has_file(const char *dir, const char *name)
{
    char path[PAGE_PATH + 64];
    (void)snprintf(path, sizeof path, "%s/%s", dir, name);
    return file_exists(path);
}

static const folder_kind *kind_of_folder(const char *dir)
{
    for (size_t k = 0; k < N_KINDS; k++) {
        if (folder_has_file(dir, kinds[k].file)) return &kinds[k];
    }
    return NULL;
}

static floe_status check_folders(context *ctx, const report_options *o)
{
    for (size_t i = 0; i < o->n_dirs; i++) {
        const char *dir = o->dir[i];
        if (strlen(dir) >= PAGE_PATH - 512) return fail(ctx, FLOE_BAD_INPUT, "the path '%.100s...' is too long", dir);
        if (kind_of_folder(dir)) continue;
        if (!file_exists(dir))
            return fail(ctx, FLOE_BAD_INPUT,
                        "there is no folder '%s': name one that floe run, compare, study or stability has written",
                        dir);
        if (folder_has_file(dir, "checkpoint.h5") || folder_has_file(dir, "history.csv"))
            return fail(ctx, FLOE_BAD_INPUT,
                        "the run in '%s' has not ended, so it has no summary.json: wait for it, or go on with floe run "
                        "--resume",
                        dir);
        return fail(
            ctx, FLOE_BAD_INPUT,
            "'%s' holds no results (no summary.json, compare.json, study.json or stability.json): name a folder "
            "that floe run, compare, study or stability has written",
            dir);
    }
    return FLOE_OK;
}

/* "a/b.html" gives "a/b_files". */
static floe_status name_files(page *p)
{
    const char *file = p->options->file;
    const size_t length = strlen(file);
    const bool html = length > 5 && strcmp(file + length - 5, ".html") == 0;
    if (length >= sizeof p->files - 512) return fail(p->ctx, FLOE_BAD_INPUT, "the path '%.100s...' is too long", file);
    (void)snprintf(p->files, sizeof p->files, "%.*s_files", (int)(html ? length - 5 : length), file);
    return FLOE_OK;
}

static void append_head(const page *p, const char *title, strbuf *out)
{
    strbuf_append(out, "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
                       "<meta charset=\"utf-8\" />\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n"
                       "<meta name=\"color-scheme\" content=\"light dark\" />\n<title>");
    strbuf_append_xml(out, title);
    strbuf_append(out, "</title>\n");
    if (p->plots > 0 && !p->no_gnuplot) plot_append_style(out);
    strbuf_append(out, "<style>\n%.*s</style>\n</head>\n", (int)report_css_size, (const char *)report_css);
}

static void append_foot(strbuf *out)
{
    char date[64] = "";
    const time_t now = time(NULL);
    struct tm parts;
    if (gmtime_r(&now, &parts)) (void)strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", &parts);
    strbuf_append(out, "<footer>Made by floe %s (%s), %s.</footer>\n</body>\n</html>\n", FLOE_VERSION, FLOE_GIT, date);
}

/* The page around its sections. */
static void append_page(const page *p, const char *title, strbuf *out)
{
    append_head(p, title, out);
    strbuf_append(out, "<body>\n<header>\n<h1>");
    strbuf_append_xml(out, title);
    strbuf_append(out, "</h1>\n<ul class=\"summary\">\n%s</ul>\n", strbuf_string(&p->summary));
    if (p->no_gnuplot) {
        strbuf_append(out,
                      "<p class=\"warning\">gnuplot was not there when this page was made, so there are no drawings: "
                      "the data and the script of each are linked in its place. In the folder <code>");
        const char *slash = strrchr(p->files, '/');
        strbuf_append_xml(out, slash ? slash + 1 : p->files);
        strbuf_append(out, "</code>, <code>gnuplot *.gp</code> makes them.</p>\n");
    }
    strbuf_append(out,
                  "</header>\n<div class=\"columns\">\n<nav aria-label=\"Contents\">\n<ol>\n%s</ol>\n</nav>\n<main>\n%s"
                  "</main>\n</div>\n",
                  strbuf_string(&p->contents), strbuf_string(&p->body));
    append_foot(out);
}

static floe_status append_sections(page *p)
{
    for (size_t i = 0; i < p->options->n_dirs; i++)
        TRY(kind_of_folder(p->options->dir[i])->write(p, p->options->dir[i]));
    if (p->body.status != FLOE_OK) return p->body.status;
    return p->summary.status != FLOE_OK ? p->summary.status : p->contents.status;
}

static floe_status write_page(page *p)
{
    char title[PAGE_TEXT];
    const report_options *o = p->options;
    strbuf out;
    TRY(name_files(p));
    TRY(append_sections(p));
    if (o->title) {
        (void)snprintf(title, sizeof title, "%s", o->title);
    } else {
        TRY(report_title(p, o->dir[0], title));
        if (o->n_dirs > 1) (void)snprintf(title, sizeof title, "%zu results of floe", o->n_dirs);
    }
    strbuf_init(&out, p->ctx);
    append_page(p, title, &out);
    const floe_status status =
        out.status == FLOE_OK ? file_replace_text(p->ctx, o->file, strbuf_string(&out)) : out.status;
    strbuf_free(&out);
    return status;
}

floe_status report_write(context *ctx, const report_options *options)
{
    page p = {.ctx = ctx, .options = options};
    if (options->n_dirs == 0) return fail(ctx, FLOE_BAD_INPUT, "a report needs at least one folder of results");
    TRY(check_folders(ctx, options));
    strbuf_init(&p.body, ctx);
    strbuf_init(&p.contents, ctx);
    strbuf_init(&p.summary, ctx);
    const floe_status status = write_page(&p);
    strbuf_free(&p.summary);
    strbuf_free(&p.contents);
    strbuf_free(&p.body);
    return status;
}
