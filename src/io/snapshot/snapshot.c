#include "io/snapshot/snapshot.h"

#include "base/memory.h"
#include "base/sha256.h"
#include "base/strbuf.h"
#include "floe_build.h"
#include "io/file.h"
#include "io/hdf.h"
#include "io/names.h"
#include "io/sealed_file.h"
#include "io/snapshot/snapshot_content.h"
#include "io/snapshot/snapshot_folder.h"
#include "io/xdmf.h"

#include <math.h>
#include <string.h>

struct snapshot_series {
    context *ctx; /* not owned */
    char *dir;    /* owned */
    char deck_sha256[SHA256_TEXT];
    strbuf times;     /* XDMF of the snapshots so far */
    long next;        /* number of the next one */
    double last_time; /* s */
};

/* The time of a snapshot and its part of the XDMF page. */
static floe_status read_parts(hdf_file *hdf, double *time, char **page)
{
    TRY(hdf_read(hdf, "/time", HDF_DOUBLE, (hdf_shape){0}, time));
    return hdf_read_text(hdf, "/xdmf", page);
}

static floe_status read_snapshot(context *ctx, const char *path, double *time, char **page)
{
    hdf_file hdf;
    *page = NULL;
    floe_status status = snapshot_file_open(ctx, path, &hdf);
    if (status == FLOE_OK) status = read_parts(&hdf, time, page);
    hdf_close(&hdf);
    return status;
}

/* A damaged snapshot must not keep a run from resuming: it is left where it is, out of the page, and said so. */
static floe_status skip_damaged(snapshot_series *series, floe_status status)
{
    if (status != FLOE_IO) return status;
    context_log(series->ctx, LOG_WARNING, "left out of fields.xdmf: %s", context_message(series->ctx));
    context_clear(series->ctx);
    return FLOE_OK;
}

static floe_status keep_or_remove(snapshot_series *series, const char *path, long number, double keep_until)
{
    double time = INFINITY;
    char *page = NULL;
    if (keep_until > -(double)INFINITY) {
        const floe_status status = read_snapshot(series->ctx, path, &time, &page);
        if (status != FLOE_OK) {
            series->next = number + 1;
            return skip_damaged(series, status);
        }
    }
    if (!(time <= keep_until)) {
        memory_free(series->ctx, &page);
        return file_remove(series->ctx, path);
    }
    strbuf_append(&series->times, "%s", page);
    memory_free(series->ctx, &page);
    series->next = number + 1;
    series->last_time = time;
    return series->times.status;
}

/* Keeps the snapshots up to a time, whose parts of the XDMF page are collected, and removes the others. */
static floe_status keep_earlier(snapshot_series *series, const snapshot_numbers *list, double keep_until)
{
    for (size_t i = 0; i < list->n; i++) {
        char name[SNAPSHOT_NAME];
        char *path;
        snapshot_file_name(name, list->number[i]);
        TRY(snapshot_join(series->ctx, &path, series->dir, name));
        const floe_status status = keep_or_remove(series, path, list->number[i], keep_until);
        memory_free(series->ctx, &path);
        TRY(status);
    }
    return FLOE_OK;
}

static floe_status write_page(snapshot_series *series)
{
    char *path;
    TRY(snapshot_join(series->ctx, &path, series->dir, "fields.xdmf"));
    const floe_status status = xdmf_write(series->ctx, path, "floe", strbuf_string(&series->times));
    memory_free(series->ctx, &path);
    return status;
}

static floe_status take_over_folder(snapshot_series *series, const char *folder, double keep_until)
{
    snapshot_numbers list = {0};
    TRY(folder_make(series->ctx, folder));
    floe_status status = snapshot_numbers_list(series->ctx, folder, &list);
    if (status == FLOE_OK) status = keep_earlier(series, &list, keep_until);
    if (status == FLOE_OK) status = folder_sync(series->ctx, folder);
    memory_free(series->ctx, &list.number);
    return status;
}

static floe_status resume_series(snapshot_series *series, const char *dir, double keep_until)
{
    char *folder;
    TRY(memory_string(series->ctx, &series->dir, dir));
    TRY(snapshot_join(series->ctx, &folder, dir, "fields"));
    const floe_status status = take_over_folder(series, folder, keep_until);
    memory_free(series->ctx, &folder);
    TRY(status);
    return write_page(series);
}

floe_status snapshot_open(snapshot_series **out, context *ctx, const char *dir, const char *deck, double keep_until)
{
    snapshot_series *series;
    *out = NULL;
    TRY(memory_new(ctx, &series, 1, sizeof *series));
    series->ctx = ctx;
    series->last_time = -INFINITY;
    strbuf_init(&series->times, ctx);
    floe_status status = sha256_of(ctx, deck, strlen(deck), series->deck_sha256);
    if (status == FLOE_OK) status = resume_series(series, dir, keep_until);
    if (status != FLOE_OK) snapshot_close(&series);
    *out = series;
    return status;
}

floe_status snapshot_move(snapshot_series *s, const char *dir)
{
    char *copy;
    TRY(memory_string(s->ctx, &copy, dir));
    memory_free(s->ctx, &s->dir);
    s->dir = copy;
    return FLOE_OK;
}

void snapshot_close(snapshot_series **s)
{
    if (!s || !*s) return;
    context *ctx = (*s)->ctx;
    strbuf_free(&(*s)->times);
    memory_free(ctx, &(*s)->dir);
    memory_free(ctx, s);
}

/* The domain, which a snapshot of points alone would not tell otherwise. */
static floe_status write_domain(const sim *s, hdf_file *hdf)
{
    const mesh *m = &s->mesh;
    const double scale = output_scale(s);
    TRY(hdf_attribute(hdf, "/", "domain_lower", HDF_DOUBLE, m->dim, m->lower));
    TRY(hdf_attribute(hdf, "/", "domain_upper", HDF_DOUBLE, m->dim, m->upper));
    TRY(hdf_attribute(hdf, "/", "cell", HDF_DOUBLE, m->dim, m->h));
    TRY(hdf_attribute(hdf, "/", "volume_scale", HDF_DOUBLE, 1, &scale));
    TRY(hdf_attribute_text(hdf, "/", "length_unit", output_unit(s, "m")));
    return hdf_attribute_text(hdf, "/", "geometry", m->geometry == MESH_AXISYMMETRIC ? "axisymmetric" : "cartesian");
}

static floe_status write_head(const snapshot_series *series, const sim *s, hdf_file *hdf)
{
    const int64_t schema = 1;
    const int64_t step = s->steps;
    const char *const text[][2] = {{"content", "floe snapshot"},
                                   {"title", s->scene->title},
                                   {"source", s->scene->source},
                                   {"coupling", coupling_name(s->coupling)},
                                   {"deck_sha256", series->deck_sha256},
                                   {"floe_version", FLOE_VERSION},
                                   {"floe_git", FLOE_GIT}};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) TRY(hdf_attribute_text(hdf, "/", text[i][0], text[i][1]));
    TRY(hdf_attribute(hdf, "/", "schema", HDF_INT64, 1, &schema));
    TRY(hdf_attribute(hdf, "/", "step", HDF_INT64, 1, &step));
    TRY(hdf_attribute(hdf, "/", "time", HDF_DOUBLE, 1, &s->time));
    TRY(write_domain(s, hdf));
    TRY(hdf_write(hdf, "/time", HDF_DOUBLE, (hdf_shape){0}, &s->time));
    return hdf_attribute_text(hdf, "/time", "unit", s->scene->dimensionless ? "1" : "s");
}

static floe_status fill_snapshot(const snapshot_series *series, const sim *s, hdf_file *hdf, strbuf *page,
                                 const char *name)
{
    TRY(write_head(series, s, hdf));
    xdmf_begin_time(page, series->next, s->time);
    TRY(snapshot_content(s, hdf, page, name));
    xdmf_end(page);
    TRY(page->status);
    return hdf_write_text(hdf, "/xdmf", strbuf_string(page));
}

static floe_status fill_file(const snapshot_series *series, const sim *s, new_file *file, strbuf *page,
                             const char *name)
{
    hdf_file hdf;
    TRY(hdf_create(&hdf, file, SEALED_HEADER));
    return hdf_finish(&hdf, fill_snapshot(series, s, &hdf, page, name));
}

static floe_status write_file(const snapshot_series *series, const sim *s, const char *path, strbuf *page,
                              const char *name)
{
    new_file file;
    floe_status status = new_file_begin(&file, series->ctx, path);
    if (status == FLOE_OK) status = fill_file(series, s, &file, page, name);
    return sealed_finish(&file, status, SEALED_SNAPSHOT, SNAPSHOT_FORMAT, NULL);
}

/* The next snapshot, and its part of the XDMF page. */
static floe_status write_next(snapshot_series *series, const sim *s, strbuf *page)
{
    char name[SNAPSHOT_NAME];
    char *path;
    snapshot_file_name(name, series->next);
    TRY(snapshot_join(series->ctx, &path, series->dir, name));
    const floe_status status = write_file(series, s, path, page, name);
    memory_free(series->ctx, &path);
    TRY(status);
    strbuf_append(&series->times, "%s", strbuf_string(page));
    return series->times.status;
}

floe_status snapshot_write(snapshot_series *series, const sim *s)
{
    strbuf page;
    strbuf_init(&page, series->ctx);
    const floe_status status = write_next(series, s, &page);
    strbuf_free(&page);
    TRY(status);
    series->next++;
    series->last_time = s->time;
    return write_page(series);
}

double snapshot_last_time(const snapshot_series *series)
{
    return series->last_time;
}
