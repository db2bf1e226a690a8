/* Field pictures of a run, as files beside the page and in it, for light pages and dark ones. */
#include "report/html.h"
#include "report/run_section.h"

#include "base/memory.h"
#include "draw/field_picture.h"
#include "io/file.h"

#include <math.h>
#include <string.h>

enum { MAX_PICTURES = 32 };

/* The snapshot nearest to a time. */
static size_t nearest_snapshot(const snapshot_times *all, double time)
{
    size_t best = 0;
    for (size_t i = 0; i < all->n; i++) {
        if (fabs(all->entry[i].time - time) < fabs(all->entry[best].time - time)) best = i;
    }
    return best;
}

static void add_snapshot_time(snapshot_time *chosen, size_t *n, snapshot_time one)
{
    for (size_t i = 0; i < *n; i++) {
        if (chosen[i].number == one.number) return;
    }
    if (*n < MAX_PICTURES) chosen[(*n)++] = one;
}

/* The snapshots nearest to the wanted times, else the first and the last. */
static floe_status choose_times(const run_view *v, snapshot_time chosen[MAX_PICTURES], size_t *n)
{
    const report_options *o = v->page->options;
    snapshot_times all;
    *n = 0;
    TRY(snapshot_times_read(&all, v->page->ctx, v->dir));
    for (size_t i = 0; i < o->n_times; i++) add_snapshot_time(chosen, n, all.entry[nearest_snapshot(&all, o->time[i])]);
    if (o->n_times == 0) {
        add_snapshot_time(chosen, n, all.entry[0]);
        add_snapshot_time(chosen, n, all.entry[all.n - 1]);
    }
    snapshot_times_free(v->page->ctx, &all);
    return FLOE_OK;
}

/* Of one case among many the last snapshot is enough, and to find it not all need to be read. */
static floe_status choose_snapshots(const run_view *v, snapshot_time chosen[MAX_PICTURES], size_t *n)
{
    if (!v->brief || v->page->options->n_times > 0) return choose_times(v, chosen, n);
    *n = 1;
    return snapshot_last(&chosen[0], v->page->ctx, v->dir);
}

/* Draws one snapshot to FILES/NAME.png and reads it back. */
static floe_status draw_snapshot(const run_view *v, long number, const field_picture_options *o, char **png,
                                 size_t *size, char *caption)
{
    page *p = v->page;
    char text[64], name[PLOT_STEM], stem[PLOT_STEM], path[PAGE_PATH + PLOT_STEM + 8];
    (void)snprintf(text, sizeof text, "%06ld%s", number, o->dark ? "-dark" : "");
    plot_name(v, text, name);
    plot_stem(name, stem);
    (void)snprintf(path, sizeof path, "%s/%s.png", p->files, stem);
    TRY(folder_make(p->ctx, p->files));
    TRY(field_picture_write(p->ctx, v->dir, number, o, path, caption));
    return file_read(p->ctx, path, png, size);
}

static floe_status add_picture(const run_view *v, long number, field_picture_options o)
{
    page *p = v->page;
    char *light = NULL, *dark = NULL;
    size_t light_solid_size = 0, dark_size = 0;
    char caption[FIELD_CAPTION] = "";
    floe_status status = draw_snapshot(v, number, &o, &light, &light_solid_size, caption);
    o.dark = true;
    if (status == FLOE_OK) status = draw_snapshot(v, number, &o, &dark, &dark_size, NULL);
    if (status == FLOE_OK)
        page_picture(p, &(page_image){light, light_solid_size}, &(page_image){dark, dark_size}, caption);
    memory_free(p->ctx, &dark);
    memory_free(p->ctx, &light);
    return status;
}

static floe_status add_pictures(const run_view *v)
{
    page *p = v->page;
    snapshot_time chosen[MAX_PICTURES];
    snapshot_times times = {.entry = chosen};
    field_picture_options o = {0};
    TRY(choose_snapshots(v, chosen, &times.n));
    /* Pictures beside each other have the same colours for the same values. */
    TRY(field_picture_common_range(p->ctx, v->dir, &times, &o));
    page_heading(p, "Fields");
    strbuf_append(&p->body, "<div class=\"pictures\">\n");
    floe_status status = FLOE_OK;
    for (size_t i = 0; i < times.n && status == FLOE_OK; i++) status = add_picture(v, chosen[i].number, o);
    strbuf_append(&p->body, "</div>\n");
    return status;
}

floe_status run_pictures(const run_view *v)
{
    page *p = v->page;
    char path[PAGE_PATH + 32];
    (void)snprintf(path, sizeof path, "%s/fields", v->dir);
    if (!file_exists(path)) return FLOE_OK;
    const floe_status status = add_pictures(v);
    if (status == FLOE_OK || status == FLOE_NO_MEMORY) return status;
    /* A page without a picture is better than no page. */
    context_log(p->ctx, LOG_WARNING, "no pictures of '%s': %s", v->dir, context_message(p->ctx));
    strbuf_append(&p->body, "<p class=\"note\">");
    html_text(&p->body, "No pictures: %s", context_message(p->ctx));
    strbuf_append(&p->body, "</p>\n");
    context_clear(p->ctx);
    return FLOE_OK;
}
